"""The reports: promised keys, numbers that agree with each other, pages that stand alone."""

import datetime
import json
import math
import os
import random
import re
import subprocess
import xml.etree.ElementTree as ElementTree

import mesh_reader
import page_parser
import planar_geometry
import sample_meshes
import tool

METRICS = {"shape", "area", "min_angle", "max_angle", "aspect_ratio", "radius_ratio", "edge_ratio", "condition",
           "scaled_jacobian", "equiangle_skew", "size_ratio"}
REPORT_KEYS = {
    "": {"trismooth", "date", "command", "input", "options", "before", "after", "size_change", "size_array",
         "size_fit", "fields", "areas", "gates", "smoothing", "coordinates_hash", "uncommitted_hash", "warnings", "timings_ms",
         "peak_memory_bytes"},
    "input": {"path", "format", "vertices", "triangles", "other_cells", "regions", "components", "fixed_vertices",
              "free_vertices", "reoriented_triangles", "region_arrays", "fixed_array", "fixed_array_vertices",
              "fixed_ids_vertices", "held"},
    "options": {"method", "form", "layout", "backend", "execution", "order", "topology", "precision", "threads",
                "max_sweeps", "tolerance", "size_weight", "power", "target", "size_array", "fields",
                "field_arrays", "project", "geographic", "slide", "corner_angle", "deviation", "curve", "slide_coincident"},
    "smoothing": {"sweeps", "stop_reason", "vertex_updates", "moved_vertices", "reverted_vertices", "device",
                  "topology", "backend_note", "reproducible", "kernel_launches", "child_launches", "device_memory_bytes",
                  "guard_rounds", "untangling", "sliding", "history"},
    "timings_ms": {"read", "topology", "check_before", "transfer_in", "untangle", "smooth", "transfer_out", "commit",
                   "fields", "check_after", "write", "total"},
}
# What a report may hold beyond the keys that are promised.
MORE_KEYS = {"input": {"region_array", "quadratic_triangles", "middle_nodes", "merged_vertices", "point_sets", "cell_sets", "line_groups"},
             "options": {"output", "guard", "untangle", "layers", "time_limit", "target_quality", "region_array", "region_arrays", "fixed_array",
                         "fixed_ids", "fixed_ids_are_labels", "fixed_sets", "merge", "annotate", "annotated_metrics"}}


class Reports(tool.ToolTest):

    def setUp(self):
        super().setUp()
        self.write("plate.off", sample_meshes.off(sample_meshes.Grid()))

    def assert_keys(self, part, name):
        self.assertEqual(REPORT_KEYS[name] - {*part}, set(), name)
        self.assertEqual({*part} - REPORT_KEYS[name] - MORE_KEYS.get(name, set()), set(), name)

    def assert_quality(self, quality):
        self.assertEqual({*quality}, {"triangles", "inverted", "degenerate", "metrics", "histogram", "worst", "regions",
                                       "quadratic"})
        self.assertEqual({*quality["metrics"]}, METRICS)
        for metric in quality["metrics"].values():
            self.assertEqual({*metric}, {"min", "mean", "max", "stddev", "acceptable_fraction"})
        self.assertEqual(len(quality["histogram"]["shape"]), 20)
        self.assertEqual(sum(quality["histogram"]["shape"]) + quality["inverted"], quality["triangles"])
        for element in quality["worst"]:
            self.assertEqual({*element}, {"cell", "shape", "centroid", "region", "all_fixed"})

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

    def test_the_change_of_sizes_is_that_of_the_two_files(self):
        self.run_tool("generate", "random.off", "--vertices", "2000")
        change = self.report("smooth", "random.off", "out.off")["size_change"]

        def areas(name):
            mesh = mesh_reader.read(self.path(name))
            corners = [[mesh.points[v] for v in triangle] for _, triangle in mesh.triangles()]
            return [((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2 for a, b, c in corners]

        ratios = sorted(after / before for before, after in zip(areas("random.off"), areas("out.off")))
        squares = [math.log(ratio) ** 2 for ratio in ratios]
        self.assertEqual(change["triangles"], len(ratios))
        self.assertEqual(change["left_out"], 0)
        self.assertAlmostEqual(change["rms_log_ratio"], math.sqrt(math.fsum(squares) / len(squares)), delta=1e-9)
        self.assertAlmostEqual(change["ratio_p1"], ratios[math.ceil(0.01 * len(ratios)) - 1], delta=1e-9)
        self.assertAlmostEqual(change["ratio_p99"], ratios[math.ceil(0.99 * len(ratios)) - 1], delta=1e-6)

    def test_a_boundary_that_is_much_coarser_than_the_inside_is_warned_of(self):
        for boundary, words in (("random", "boundary edges more than 4 times as long"), ("resolved", None)):
            self.run_tool("generate", "random.off", "--vertices", "2000", "--boundary", boundary)
            outcome = self.run_tool("smooth", "random.off", "out.off", "--report", "r.json")
            warnings = json.loads(self.read("r.json"))["warnings"]
            self.assertEqual(["trismooth: warning: " + text for text in warnings], outcome.err.splitlines())
            self.assertEqual([words in text for text in warnings], [True] if words else [])
        self.assertEqual(self.report("smooth", "plate.off", "out.off")["warnings"], [])

    def test_folds_that_the_guard_puts_back_are_warned_of(self):
        # An L of three quarters of a grid, and a vertex held where the fourth was: some triangles stay folded.
        n = 10
        column = lambda v: v % (n + 1)
        row = lambda v: v // (n + 1)
        in_fourth = lambda v: column(v) >= n // 2 and row(v) >= n // 2
        grid = sample_meshes.Grid(n)
        grid.cells = [cell for cell in grid.cells if not all(map(in_fourth, cell[1]))]
        draw = random.Random(8)
        for v, (x, y, _) in enumerate(grid.points):
            if 0 < column(v) < n and 0 < row(v) < n and not in_fourth(v):
                grid.points[v] = (x + draw.gauss(0, 1), y + draw.gauss(0, 1), 0.0)
        held = (n + 1) + 6
        grid.points[held] = (n - 1.0, n - 1.0, 0.0)
        self.write("held.txt", f"{held}")
        self.write("folded.off", sample_meshes.off(grid))
        arguments = ("smooth", "folded.off", "out.off", "--method", "mean-ratio", "--fixed-ids", "held.txt")
        guarded = self.report(*arguments)
        found = guarded["smoothing"]["untangling"]
        self.assertGreater(found["inverted_after"], found["inverted_untangled"])
        words = f"{found['inverted_after']} triangles are not valid now, {found['inverted_untangled']} were after the untangling"
        self.assertEqual([words in text for text in guarded["warnings"]].count(True), 1)
        free = self.report(*arguments, "--guard", "off")
        self.assertFalse([text for text in free["warnings"] if "were after the untangling" in text])
        self.assertLess(free["after"]["inverted"], guarded["after"]["inverted"])

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
        self.assertIsNone(checked["size_change"])

    def test_reports_hold_the_gates_and_how_they_went(self):
        outcome = self.run_tool("smooth", "plate.off", "out.off", "--require", "min_shape>=0.999", "--require",
                                "triangles == 128", "--report", "r.json", "--report", "r.html", expect=1)
        report = json.loads(self.read("r.json"))
        smallest = report["after"]["metrics"]["shape"]["min"]
        self.assertEqual(report["gates"],
                         [{"gate": "min_shape >= 0.999", "name": "min_shape", "comparison": ">=", "bound": 0.999,
                           "value": smallest, "passed": False},
                          {"gate": "triangles == 128", "name": "triangles", "comparison": "==", "bound": 128,
                           "value": 128, "passed": True}])
        parser = page_parser.PageParser()
        parser.feed(self.read("r.html").decode())
        self.assertIn("1 of 2 gates failed.", parser.text)
        self.assertRegex(parser.text, r"min_shape >= 0\.999\s*0\.\d+\s*failed")
        self.assertRegex(parser.text, r"triangles == 128\s*128\s*passed")
        self.assertIn(report["date"], parser.text)
        self.assertIn(report["command"], parser.text)
        self.assertRegex(outcome.err, "gate failed: min_shape >= 0.999")
        self.assertEqual(self.report("quality", "plate.off")["gates"], [])

    def test_the_date_is_that_of_the_run_with_its_zone(self):
        before = datetime.datetime.now(datetime.timezone.utc).replace(microsecond=0)
        self.run_tool("quality", "plate.off", "--report", "r.json", environment={"TZ": "XXX-5:30"})
        date = json.loads(self.read("r.json"))["date"]
        self.assertRegex(date, r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\+05:30$")
        self.assertLessEqual(before, datetime.datetime.fromisoformat(date))
        self.assertLessEqual(datetime.datetime.fromisoformat(date), datetime.datetime.now(datetime.timezone.utc))

    def test_a_shell_that_is_given_the_command_line_makes_the_same_run(self):
        every_byte = bytes(c for c in range(1, 256) if c != ord("/"))
        names = [b"it's a mesh", b"$HOME `id` \\ \"x\" * ~ !! #", b"\x1b[31mred\n\r\t", "Größe".encode(), b"=x", b"-",
                 every_byte[:120], every_byte[120:]]
        os.symlink(tool.program, self.path("trismooth"))
        environment = {**os.environ, "PATH": self.folder + os.pathsep + os.environ["PATH"]}
        for name in names:
            with self.subTest(name):
                path = b"./" + name + b".off"
                with open(os.fsencode(self.folder) + b"/" + path, "wb") as file:
                    file.write(self.read("plate.off"))
                arguments = [b"quality", path, b"--require", b"min_shape >= -1", b"--report", b"r.json"]
                subprocess.run([tool.program, *arguments], cwd=self.folder, check=True, capture_output=True)
                first = json.loads(self.read("r.json"))
                os.remove(self.path("r.json"))
                self.assertTrue(first["command"].isprintable(), first["command"])
                subprocess.run(["bash", "-c", first["command"]], cwd=self.folder, env=environment, check=True,
                               capture_output=True)
                again = json.loads(self.read("r.json"))
                for key in ("command", "input", "options", "before", "gates"):
                    self.assertEqual(again[key], first[key])

    def test_triangles_without_area_are_counted_everywhere_and_a_gate_finds_them(self):
        flat = "OFF\n6 5 0\n0 0 0\n1 0 0\n2 0 0\n2 2 0\n0 2 0\n1 1 0\n"
        good = ["3 0 1 5", "3 1 2 3", "3 1 3 5"]
        for cells, count in ((good, 0), ([*good, "3 0 1 2"], 1), ([*good, "3 0 2 1", "3 4 3 4"], 2),
                             ([*good, "3 3 3 3"], 1)):
            with self.subTest(count):
                self.write("flat.off", flat.replace("6 5 0", f"6 {len(cells)} 0") + "\n".join(cells) + "\n")
                self.write("all.txt", "0 1 2 3 4 5")  # smoothing would mend them
                for arguments in (("quality", "flat.off"), ("smooth", "flat.off", "out.off", "--fixed-ids", "all.txt")):
                    outcome = self.run_tool(*arguments, "--require", "inverted==0", "--require", "degenerate==0",
                                            "--verbose", "--report", "r.json", "--report", "r.html",
                                            expect=1 if count else 0)
                    self.assertEqual("gate failed: degenerate == 0" in outcome.err, count > 0)
                    self.assertRegex(outcome.out, rf"(?m)^degenerate +{count}\b")
                    report = json.loads(self.read("r.json"))
                    for stage in filter(None, (report["before"], report["after"])):
                        self.assertEqual((stage["degenerate"], stage["inverted"]), (count, 0))
                        self.assert_quality(stage)
                    parser = page_parser.PageParser()
                    parser.feed(self.read("r.html").decode())
                    self.assertIn(f"{count} degenerate", parser.text)

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
        pictures = re.findall(r"<figure.*?</figure>", page, re.DOTALL)
        self.assertEqual(len(pictures), 2)
        for picture in pictures:
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
