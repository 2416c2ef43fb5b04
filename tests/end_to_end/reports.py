"""The reports: promised keys, numbers that agree with each other, pages that stand alone."""

import json
import os
import re
import subprocess
import xml.etree.ElementTree as ElementTree

import mesh_reader
import page_parser
import planar_geometry
import sample_meshes
import tool

METRICS = {"shape", "area", "min_angle", "max_angle", "aspect_ratio", "radius_ratio", "edge_ratio", "condition",
           "scaled_jacobian", "equiangle_skew"}
REPORT_KEYS = {
    "": {"trismooth", "input", "options", "before", "after", "smoothing", "coordinates_hash", "uncommitted_hash",
         "warnings", "timings_ms", "peak_memory_bytes"},
    "input": {"path", "format", "vertices", "triangles", "other_cells", "regions", "components", "fixed_vertices",
              "free_vertices", "reoriented_triangles", "region_arrays", "fixed_array", "fixed_array_vertices",
              "fixed_ids_vertices", "held"},
    "options": {"method", "form", "layout", "backend", "execution", "order", "topology", "precision", "threads",
                "max_sweeps", "tolerance"},
    "smoothing": {"sweeps", "stop_reason", "vertex_updates", "moved_vertices", "reverted_vertices", "device",
                  "backend_note", "reproducible", "kernel_launches", "child_launches", "device_memory_bytes",
                  "guard_rounds", "history"},
    "timings_ms": {"read", "topology", "check_before", "transfer_in", "smooth", "transfer_out", "commit",
                   "check_after", "write", "total"},
}
# What a report may hold beyond the keys that are promised.
MORE_KEYS = {"input": {"region_array"},
             "options": {"output", "guard", "time_limit", "target_quality", "region_array", "region_arrays", "fixed_array", "fixed_ids",
                         "annotate"}}


class Reports(tool.ToolTest):

    def setUp(self):
        super().setUp()
        self.write("plate.off", sample_meshes.off(sample_meshes.Grid()))

    def assert_keys(self, part, name):
        self.assertEqual(REPORT_KEYS[name] - {*part}, set(), name)
        self.assertEqual({*part} - REPORT_KEYS[name] - MORE_KEYS.get(name, set()), set(), name)

    def assert_quality(self, quality):
        self.assertEqual({*quality}, {"triangles", "inverted", "metrics", "histogram", "worst", "regions"})
        self.assertEqual({*quality["metrics"]}, METRICS)
        for metric in quality["metrics"].values():
            self.assertEqual({*metric}, {"min", "mean", "max", "stddev", "acceptable_fraction"})
        self.assertEqual(len(quality["histogram"]["shape"]), 20)
        self.assertEqual(sum(quality["histogram"]["shape"]) + quality["inverted"], quality["triangles"])
        for element in quality["worst"]:
            self.assertEqual({*element}, {"cell", "shape", "centroid"})

    def test_the_json_report_has_the_promised_keys(self):
        report = self.report("smooth", "plate.off", "out.off")
        self.assert_keys(report, "")
        for name in ("input", "options", "smoothing", "timings_ms"):
            self.assert_keys(report[name], name)
        self.assert_quality(report["before"])
        self.assert_quality(report["after"])
        self.assertEqual(report["smoothing"]["sweeps"], len(report["smoothing"]["history"]))
        for i, sweep in enumerate(report["smoothing"]["history"]):
            self.assertEqual({*sweep}, {"sweep", "evaluated", "moved", "max_relative_move", "min_shape"})
            self.assertEqual(sweep["sweep"], i + 1)
            self.assertIsNone(sweep["min_shape"])
        self.assertEqual(report["input"]["path"], "plate.off")
        self.assertEqual(report["input"]["format"], "off")
        self.assertRegex(report["coordinates_hash"], "^[0-9a-f]{16}$")
        self.assertGreater(report["peak_memory_bytes"], 1 << 20)

    def test_the_smallest_shape_of_each_sweep_is_there_where_it_is_wanted(self):
        report = self.report("smooth", "plate.off", "out.off", "--target-quality", "0.7")
        self.assertEqual(report["smoothing"]["stop_reason"], "quality_target")
        self.assertGreaterEqual(report["smoothing"]["history"][-1]["min_shape"], 0.7)
        self.assertGreaterEqual(report["after"]["metrics"]["shape"]["min"], 0.7 - 1e-12)

    def test_the_hash_is_that_of_the_written_coordinates(self):
        report = self.report("smooth", "plate.off", "out.off")
        self.assertEqual(planar_geometry.coordinates_hash(mesh_reader.read(self.path("out.off")).points),
                         report["coordinates_hash"])

    def test_the_uncommitted_hash_is_that_without_the_guard(self):
        self.run_tool("generate", "random.off", "--vertices", "2000")
        options = ("--method", "laplacian", "--form", "a", "--max-sweeps", "3")
        guarded = self.report("smooth", "random.off", "out.off", *options)
        free = self.report("smooth", "random.off", "out.off", *options, "--guard", "off")
        self.assertGreater(guarded["smoothing"]["reverted_vertices"], 0)
        self.assertNotEqual(guarded["coordinates_hash"], guarded["uncommitted_hash"])
        self.assertEqual(guarded["uncommitted_hash"], free["coordinates_hash"])

    def test_the_quality_command_reports_the_same_numbers(self):
        smoothed = self.report("smooth", "plate.off", "out.off")
        self.assertEqual(self.report("quality", "plate.off")["before"], smoothed["before"])
        checked = self.report("quality", "out.off")
        self.assertEqual(checked["before"], smoothed["after"])
        self.assertIsNone(checked["coordinates_hash"])
        self.assert_keys(checked, "")
        self.assertIsNone(checked["after"])
        self.assertIsNone(checked["smoothing"])

    def test_the_html_report_is_well_formed_and_stands_alone(self):
        self.write("a&b <c>.off", self.read("plate.off"))
        self.run_tool("smooth", "a&b <c>.off", "out.off", "--report", "run.html", "--report", "run.json")
        page = self.read("run.html").decode()
        parser = page_parser.PageParser()
        parser.feed(page)
        self.assertEqual((parser.mistakes, parser.open), ([], []))
        self.assertEqual(parser.outside, [])
        self.assertIn("a&b <c>.off", parser.text)
        json.loads(self.read("run.json"))
        for picture in re.findall(r"<svg.*?</svg>", page, re.DOTALL):
            ElementTree.fromstring(picture)

    def test_a_path_that_is_no_text_is_no_trouble(self):
        name = os.fsencode(self.folder) + b"/caf\xe9.off"
        with open(name, "wb") as file:
            file.write(self.read("plate.off"))
        done = subprocess.run([tool.program, "smooth", name, "out.off", "--report", "r.json", "--report", "r.html"],
                              cwd=self.folder, check=False, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        json.loads(self.read("r.json"))


if __name__ == "__main__":
    tool.main()
