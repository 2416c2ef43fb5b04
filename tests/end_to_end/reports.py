# SPDX-License-Identifier: BSD-3-Clause
"""The reports of whole runs: warnings, numbers that agree with each other, and the command that was run."""

import html
import json
import math
import os
import random
import re
import subprocess

import mesh_reader
import page_parser
import planar_geometry
import sample_meshes
import tool

METRICS = {"shape", "area", "min_angle", "max_angle", "aspect_ratio", "radius_ratio", "edge_ratio", "condition",
           "scaled_jacobian", "equiangle_skew", "size_ratio"}


class Reports(tool.ToolTest):

    def setUp(self):
        super().setUp()
        self.write("plate.off", sample_meshes.off(sample_meshes.Grid()))

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

    def test_all_metrics_are_there_and_every_sweep(self):
        report = self.report("smooth", "plate.off", "out.off")
        for stage in ("before", "after"):
            self.assertEqual({*report[stage]["metrics"]}, METRICS)
            self.assertEqual(sum(report[stage]["histogram"]["shape"]) + report[stage]["inverted"], 128)
        history = report["smoothing"]["history"]
        self.assertEqual([sweep["sweep"] for sweep in history], [*range(1, report["smoothing"]["sweeps"] + 1)])
        self.assertEqual(history[0]["min_shape"], None)
        report = self.report("smooth", "plate.off", "out.off", "--target-quality", "0.7", "--require", "size_ratio<1e9")
        self.assertEqual(report["smoothing"]["stop_reason"], "quality_target")
        self.assertGreaterEqual(report["smoothing"]["history"][-1]["min_shape"], 0.7)

    def test_the_change_of_sizes_is_that_of_the_two_files(self):
        self.run_tool("generate", "random.off", "--vertices", "2000")
        change = self.report("smooth", "random.off", "out.off")["size_change"]
        areas = []
        for mesh in (mesh_reader.read(self.path(name)) for name in ("random.off", "out.off")):
            points = planar_geometry.flat(mesh.points)
            areas.append([planar_geometry.doubled_area(points, *corners) for _, corners in mesh.elements()])
        ratios = sorted(after / before for before, after in zip(*areas))
        self.assertEqual((change["elements"], change["left_out"]), (len(ratios), 0))
        squares = math.fsum(math.log(ratio) ** 2 for ratio in ratios)
        self.assertAlmostEqual(change["rms_log_ratio"], math.sqrt(squares / len(ratios)), delta=1e-9)
        self.assertAlmostEqual(change["ratio_p1"], ratios[math.ceil(0.01 * len(ratios)) - 1], delta=1e-9)
        self.assertAlmostEqual(change["ratio_p99"], ratios[math.ceil(0.99 * len(ratios)) - 1], delta=1e-6)

    def test_the_worst_elements_that_nothing_can_change_are_marked(self):
        mesh = mesh_reader.read(self.path("plate.off"))
        fixed = planar_geometry.fixed_vertices(mesh)
        worst = self.report("quality", "plate.off")["before"]["worst"]
        for element in worst:
            self.assertEqual(element["all_fixed"], all(v in fixed for v in mesh.cells[element["cell"]][1]))
        self.write("ids.txt", " ".join(map(str, mesh.cells[worst[0]["cell"]][1])))
        arguments = ("quality", "plate.off", "--fixed-ids", "ids.txt")
        again = self.report(*arguments)["before"]["worst"]
        self.assertTrue(again[0]["all_fixed"])
        count = sum(element["all_fixed"] for element in again)
        text = self.run_tool(*arguments, "--report", "r.html").out
        self.assertRegex(text, rf"(?m)^ +1 +{worst[0]['cell']} .*\) +all fixed$")
        self.assertEqual(len(re.findall("all fixed$", text, re.M)), count)
        self.assertEqual(self.read("r.html").count(b"all corners fixed"), count)

    def test_triangles_without_area_are_counted_everywhere_and_a_gate_finds_them(self):
        flat = "OFF\n6 5 0\n0 0 0\n1 0 0\n2 0 0\n2 2 0\n0 2 0\n1 1 0\n"
        good = ["3 0 1 5", "3 1 2 3", "3 1 3 5"]
        self.write("all.txt", "0 1 2 3 4 5")  # smoothing would mend them
        for cells, count in ((good, 0), ([*good, "3 0 1 2"], 1), ([*good, "3 0 2 1", "3 4 3 4"], 2),
                             ([*good, "3 3 3 3"], 1)):
            self.write("flat.off", flat.replace("6 5 0", f"6 {len(cells)} 0") + "\n".join(cells) + "\n")
            for arguments in (("quality", "flat.off"), ("smooth", "flat.off", "out.off", "--fixed-ids", "all.txt")):
                with self.subTest(arguments, cells=cells):
                    outcome = self.run_tool(*arguments, "--require", "inverted==0", "--require", "degenerate==0", "-v",
                                            "--report", "r.json", "--report", "r.html", expect=1 if count else 0)
                    self.assertEqual("gate failed: degenerate == 0" in outcome.err, count > 0)
                    self.assertRegex(outcome.out, rf"(?m)^degenerate +{count}\b")
                    report = json.loads(self.read("r.json"))
                    for stage in filter(None, (report["before"], report["after"])):
                        self.assertEqual((stage["degenerate"], stage["inverted"]), (count, 0))
                    parser = page_parser.PageParser()
                    parser.feed(self.read("r.html").decode())
                    self.assertIn(f"{count} degenerate", parser.text)

    def test_the_quality_of_each_region_is_that_of_its_triangles(self):
        self.write("in.vtk", sample_meshes.legacy_vtk(sample_meshes.Grid()))
        report = self.report("smooth", "in.vtk", "out.vtk")
        for stage, name in (("before", "in.vtk"), ("after", "out.vtk")):
            mesh = mesh_reader.read(self.path(name))
            self.assertEqual([region["region"] for region in report[stage]["regions"]], ["1", "2"])
            for region in report[stage]["regions"]:
                shapes = [planar_geometry.raw_shape(planar_geometry.flat(mesh.points), *corners)
                          for (_, corners), (value,) in zip(mesh.cells, mesh.cell_arrays["region"])
                          if str(value) == region["region"]]
                self.assertEqual((region["triangles"], region["inverted"]), (64, 0))
                self.assertAlmostEqual(region["shape"]["min"], min(map(abs, shapes)), places=12)
                self.assertAlmostEqual(region["shape"]["mean"], sum(map(abs, shapes)) / 64, places=12)

    def test_what_holds_vertices_is_named_and_counted(self):
        grid = sample_meshes.Grid(others=True)
        array = "".join(f"{int(v in (20, 21, 30))}\n" for v in range(len(grid.points)))
        self.write("in.vtk", sample_meshes.legacy_vtk(grid) + f"FIELD own 1\nFixed 1 81 int\n{array}".encode())
        mesh = mesh_reader.read(self.path("in.vtk"))
        outcome = self.run_tool("quality", "in.vtk", "--report", "r.json", "--report", "r.html")
        found = json.loads(self.read("r.json"))["input"]
        self.assertEqual((found["fixed_array"], found["fixed_array_vertices"]), ("Fixed", 3))
        self.assertIn("3 by the array 'Fixed'", " ".join(outcome.out.split()))
        self.assertIn("by the point array 'Fixed'", html.unescape(self.read("r.html").decode()))
        self.assertEqual(found["held"]["interface"], len(planar_geometry.interface_vertices(mesh)))
        self.assertEqual(found["held"]["other_cells"], len(planar_geometry.other_cell_vertices(mesh)))

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
