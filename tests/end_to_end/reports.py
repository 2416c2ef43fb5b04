"""The reports of whole runs: warnings, numbers that agree with each other, and the command that was run."""

import json
import os
import random
import subprocess

import page_parser
import sample_meshes
import tool


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
