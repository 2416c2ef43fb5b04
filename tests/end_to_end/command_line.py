"""The command line: exit codes, messages, outputs, and what every combination of options must keep."""

import os
import re
import resource
import signal
import subprocess
import time

import mesh_reader
import planar_geometry
import sample_meshes
import tool
from reports import METRICS

DONE, GATE_FAILED, WRONG_USAGE, BAD_INPUT, NOT_WRITTEN, CANCELLED = 0, 1, 2, 3, 4, 130


class CommandLineTest(tool.ToolTest):

    def setUp(self):
        super().setUp()
        self.write("plate.off", sample_meshes.off(sample_meshes.Grid()))

    def assert_usage(self, *arguments, says):
        """Wrong usage: two lines, the error and where to find help; nothing written."""
        outcome = self.run_tool(*arguments, expect=WRONG_USAGE)
        lines = outcome.err.splitlines()
        self.assertTrue(lines[0].startswith("trismooth: error: "), outcome)
        self.assertRegex(lines[0], says)
        self.assertLessEqual(len(lines), 2, outcome)
        self.assertEqual(outcome.out, "")
        self.assertEqual(os.listdir(self.folder), ["plate.off"])
        return lines


class Usage(CommandLineTest):

    def test_wrong_usage_says_what_was_wrong(self):
        for arguments, says in {
                (): "no command",
                ("smoth",): "smoth",
                ("smooth",): "INPUT",
                ("smooth", "plate.off"): "OUTPUT",
                ("smooth", "plate.off", "out.off", "more.off"): "more.off",
                ("smooth", "plate.off", "out.off", "--no-such"): "--no-such",
                ("smooth", "plate.off", "out.off", "--method"): "--method",
                ("smooth", "plate.off", "out.off", "--form", "a", "--form", "b"): "--form",
                ("smooth", "plate.off", "out.off", "--threads", "two"): "--threads.*'two'",
                ("smooth", "plate.off", "out.off", "--threads", "-1"): "--threads.*'-1'",
                ("smooth", "plate.off", "out.off", "--max-sweeps", "1.5"): "--max-sweeps.*'1.5'",
                ("smooth", "plate.off", "out.off", "--tolerance", "nan"): "--tolerance.*'nan'",
                ("smooth", "plate.off", "out.off", "--tolerance", "-1"): "tolerance",
                ("smooth", "plate.off", "out.off", "--tolerance", "1,5"): "--tolerance.*'1,5'",
                ("smooth", "plate.off", "out.off", "--time-limit", "-1"): "--time-limit: expected a number from 0",
                ("smooth", "plate.off", "out.off", "--target-quality", "2"): "quality",
                ("smooth", "plate.off", "out.off", "--report", "report.txt"): "report.txt.*json.*html",
                ("smooth", "plate.off", "out.off", "--require", "min_shape"): "min_shape",
                ("smooth", "plate.off", "out.off", "--require", "beauty>=1"): "beauty.*shape.*min_angle",
                ("smooth", "plate.off", "out.off", "--require", "min_shape>=much"): "min_shape>=much",
                ("smooth", "plate.off", "out.off", "--quiet", "--verbose"): "--quiet.*--verbose",
                ("smooth", "plate.off", "out.off", "--region-array", "steel"): "steel",
                ("smooth", "plate.off", "out.off", "--fixed-array", "anchor"): "anchor",
                ("smooth", "plate.off", "out.off", "--order", "unordered"): "unordered.*single-block.*cdp",
                ("smooth", "plate.off", "out.off", "--layout", "soa"): "soa.*single-block.*cdp",
                ("smooth", "none.off", "out.off", "--execution", "single-block", "--method", "weighted"):
                    "single-block.*smart and laplacian only.*resident",
                ("quality",): "INPUT",
                ("quality", "plate.off", "out.off"): "out.off",
                ("generate", "out.off"): "--vertices",
                ("generate", "out.off", "--vertices", "3"): "--vertices.*'3'",
                ("generate", "out.off", "--vertices", "0K"): "--vertices.*'0K'",
                ("smooth", "plate.off", "out.off", "--methd", "smart"): "'--methd' .did you mean '--method'",
                ("smooth", "plate.off", "out.off", "c", "b", "a"): "'c', 'b', 'a'",
                ("generate", "out.off", "--vertices", "99", "--seed", "-1"): "--seed.*'-1'"}.items():
            with self.subTest(" ".join(arguments)):
                self.assert_usage(*arguments, says=says)

    def test_an_unknown_value_is_answered_with_the_valid_ones(self):
        for option, valid in {"--method": ["smart", "laplacian"], "--form": ["a", "b"],
                              "--layout": ["aos", "soa"], "--backend": ["auto", "cpu", "cuda"],
                              "--execution": ["resident", "single-block", "cdp"], "--order": ["colour", "unordered"],
                              "--topology": ["auto", "host", "halfedge", "device"], "--guard": ["on", "off"],
                              "--precision": ["double", "single"], "--target": ["uniform", "input-shape"]}.items():
            with self.subTest(option):
                arguments = ("smooth", "plate.off", "out.off", option, "bogus")
                line = self.assert_usage(*arguments, says=f"{option}.*'bogus'")[0]
                self.assertRegex(line, "valid are " + ", ".join(valid))

    def test_every_documented_value_is_taken(self):
        for option, values in {"--method": self.methods(), "--form": ["a", "b"],
                               "--layout": ["aos"], "--backend": ["auto", "cpu"],
                               "--execution": ["resident", "single-block", "cdp"], "--order": ["colour"],
                               "--topology": ["auto", "host", "halfedge", "device"], "--guard": ["on", "off"],
                               "--precision": ["double", "single"], "--threads": ["1", "2"],
                               "--max-sweeps": ["0", "3"], "--tolerance": ["0", "1e-3"], "--time-limit": ["5"],
                               "--target-quality": ["0.5"], "--size-weight": ["0", "2.5"], "--power": ["1", "8"],
                               "--target": ["uniform", "input-shape"]}.items():
            for value in values:
                with self.subTest(f"{option} {value}"):
                    self.run_tool("smooth", "plate.off", "out.off", option, value)

    def test_help_and_version_go_to_standard_output(self):
        for arguments in (("--help",), ("--version",), ("info",), ("smooth", "--help"), ("quality", "--help"),
                          ("generate", "--help")):
            with self.subTest(arguments):
                outcome = self.run_tool(*arguments)
                self.assertEqual(outcome.err, "")
                self.assertRegex(outcome.out, r"(?i)trismooth")
                self.assertLessEqual(max(map(len, outcome.out.splitlines())), 80)


class Output(CommandLineTest):

    def test_a_target_that_cannot_be_written_is_told_and_nothing_is_left(self):
        os.mkdir(self.path("folder.off"))
        for target, says in {"no/such/folder/out.off": "no/such/folder/out.off: .*No such file",
                             "folder.off": "folder.off: is a folder", "out.xyz": "out.xyz: .*'.xyz'.*\\(\\.off\\), .*\\(\\.vtu\\)",
                             "out": "out: .*extension"}.items():
            with self.subTest(target):
                outcome = self.run_tool("smooth", "plate.off", target, expect=NOT_WRITTEN)
                self.assertRegex(outcome.err, f"^trismooth: error: {says}")
                self.assertEqual(len(outcome.err.splitlines()), 1)
                self.assertEqual(sorted(os.listdir(self.folder)), ["folder.off", "plate.off"])

    def test_a_full_disk_leaves_the_old_output(self):
        for extension in ("off", "vtk", "vtu"):
            with self.subTest(extension):
                self.write(f"out.{extension}", "precious")
                outcome = self.run_tool("smooth", "plate.off", f"out.{extension}", expect=NOT_WRITTEN,
                                        limits={resource.RLIMIT_FSIZE: 2000})
                self.assertRegex(outcome.err, f"^trismooth: error: out.{extension}: ")
                self.assertEqual(len(outcome.err.splitlines()), 1, outcome)
                self.assertEqual(self.read(f"out.{extension}"), b"precious")
                self.assert_no_temporary_files()

    def test_a_device_that_takes_no_bytes_is_told(self):
        if not os.path.exists("/dev/full"):
            self.skipTest("no /dev/full here")
        os.symlink("/dev/full", self.path("full.off"))
        outcome = self.run_tool("smooth", "plate.off", "full.off", expect=NOT_WRITTEN)
        self.assertRegex(outcome.err, "full.off: .*No space left")

    def test_a_report_that_cannot_be_written_is_told(self):
        outcome = self.run_tool("smooth", "plate.off", "out.off", "--report", "no/folder/r.json", expect=NOT_WRITTEN)
        self.assertRegex(outcome.err, "trismooth: error: no/folder/r.json: ")

    def test_a_missing_input_is_told(self):
        outcome = self.run_tool("smooth", "missing.off", "out.off", expect=BAD_INPUT)
        self.assertRegex(outcome.err, "^trismooth: error: missing.off: .*No such file")

    def test_the_input_itself_may_be_the_output(self):
        self.run_tool("smooth", "plate.off", "out.off")
        self.run_tool("smooth", "plate.off", "plate.off")
        self.assertEqual(self.read("plate.off"), self.read("out.off"))
        self.assert_no_temporary_files()

    def test_a_link_stays_a_link_and_the_mode_stays(self):
        os.chmod(self.path("plate.off"), 0o640)
        os.symlink("plate.off", self.path("link.off"))
        self.run_tool("smooth", "link.off", "link.off")
        self.assertTrue(os.path.islink(self.path("link.off")))
        self.assertEqual(os.stat(self.path("plate.off")).st_mode & 0o777, 0o640)

    def test_quality_changes_nothing_and_writes_nothing(self):
        before = self.read("plate.off")
        outcome = self.run_tool("quality", "plate.off")
        self.assertRegex(outcome.out, "min_angle")
        self.assertEqual(self.read("plate.off"), before)
        self.assertEqual(os.listdir(self.folder), ["plate.off"])

    def test_quiet_prints_nothing(self):
        outcome = self.run_tool("smooth", "plate.off", "out.off", "--quiet")
        self.assertEqual((outcome.out, outcome.err), ("", ""))

    def test_no_progress_bar_is_drawn_where_there_is_no_terminal(self):
        outcome = self.run_tool("smooth", "plate.off", "out.off")
        self.assertEqual(outcome.err, "")
        self.assertNotIn("\r", outcome.out)
        self.assertNotIn("\x1b", outcome.out)

    def test_another_format_gets_the_mesh_and_is_told_what_it_cannot_hold(self):
        self.write("mixed.vtu", sample_meshes.vtu(sample_meshes.Grid(others=True)))
        source = self.report("smooth", "mixed.vtu", "same.vtu")
        expected = mesh_reader.read(self.path("same.vtu"))
        for extension, lost in {"off": ["depth", "region", "load", "line"], "obj": ["depth", "load"], "ply": [],
                                "stl": ["depth", "region", "load", "line", "quad"], "vtk": [], "vtp": []}.items():
            with self.subTest(extension):
                output = f"out.{extension}"
                outcome = self.run_tool("smooth", "mixed.vtu", output, "--verbose")
                for what in lost:
                    self.assertIn(what, outcome.err)
                written = mesh_reader.read(self.path(output))
                if extension != "stl":
                    self.assertEqual(planar_geometry.coordinates_hash(written.points), source["coordinates_hash"])
                triangles = [cell for kind, cell in expected.cells if kind == mesh_reader.TRIANGLE]
                place = lambda mesh, cell: tuple(mesh.points[v] for v in cell)
                self.assertEqual([place(written, cell) for kind, cell in written.cells
                                  if kind == mesh_reader.TRIANGLE], [place(expected, cell) for cell in triangles])
                if extension in ("vtk", "vtp"):
                    self.assertEqual(written.point_arrays, expected.point_arrays)
                    self.assertEqual(sorted(written.cell_arrays), sorted(expected.cell_arrays))

    def test_annotations_are_no_error_where_they_cannot_be_held(self):
        outcome = self.run_tool("smooth", "plate.off", "out.off", "--annotate")
        self.assertRegex(outcome.err, "note: --annotate")
        self.assertTrue(os.path.exists(self.path("out.off")))


class Constraints(CommandLineTest):

    def moved(self, *arguments):
        self.run_tool("smooth", "plate.off", "out.off", *arguments)
        before, after = (mesh_reader.read(self.path(name)).points for name in ("plate.off", "out.off"))
        return {v for v, (p, q) in enumerate(zip(before, after)) if p != q}

    def test_vertices_named_in_a_file_stay(self):
        free = sorted(self.moved())
        self.write("ids.txt", f"{free[0]} {free[3]}\n{free[5]}\n")
        self.assertEqual(self.moved("--fixed-ids", "ids.txt") & {free[0], free[3], free[5]}, set())

    def test_a_bad_file_of_vertices_is_told_with_its_line(self):
        for content, says in {"5\n999\n": ":2: .*'999'", "5\nx\n": ":2: .*'x'", "-1\n": ":1: .*'-1'"}.items():
            with self.subTest(content):
                self.write("ids.txt", content)
                outcome = self.run_tool("smooth", "plate.off", "out.off", "--fixed-ids", "ids.txt", expect=BAD_INPUT)
                self.assertRegex(outcome.err, "trismooth: error: ids.txt" + says)

    def test_arrays_named_by_the_user_hold_vertices(self):
        self.write("plate.vtk", sample_meshes.legacy_vtk(sample_meshes.Grid()))
        self.run_tool("smooth", "plate.vtk", "annotated.vtk", "--annotate")
        region = self.report("quality", "plate.vtk", "--region-array", "region")["input"]
        region["region_arrays"][0]["reason"] = "known_name"
        self.assertEqual(region, self.report("quality", "plate.vtk")["input"])
        displaced = self.report("quality", "annotated.vtk", "--fixed-array", "trismooth:displacement")["input"]
        self.assertGreater(displaced["fixed_vertices"], region["fixed_vertices"])
        outcome = self.run_tool("smooth", "plate.vtk", "out.vtk", "--region-array", "load", expect=WRONG_USAGE)
        self.assertRegex(outcome.err, "load.*2 components")


class Gates(CommandLineTest):

    def test_a_gate_that_is_missed_gives_1_and_the_output_is_written_still(self):
        outcome = self.run_tool("smooth", "plate.off", "out.off", "--require", "min_shape>=0.99", "--require",
                                "inverted==0", "--require", "max_angle<=60", expect=GATE_FAILED)
        lines = [line for line in outcome.err.splitlines() if "gate failed" in line]
        self.assertEqual(len(lines), 2)
        self.assertRegex(lines[0], r"min_shape >= 0.99, is 0\.\d+")
        self.assertRegex(lines[1], r"max_angle <= 60, is \d+")
        self.assertTrue(os.path.exists(self.path("out.off")))

    def test_gates_are_told_even_where_the_rest_is_quiet(self):
        outcome = self.run_tool("smooth", "plate.off", "out.off", "--quiet", "--require", "inverted>0",
                                expect=GATE_FAILED)
        self.assertEqual(len(outcome.err.splitlines()), 1)
        self.assertEqual(outcome.out, "")

    def test_gates_judge_the_result_of_smoothing_and_for_quality_the_input(self):
        quality = self.report("quality", "plate.off")["before"]["metrics"]["shape"]["min"]
        gate = f"min_shape>{quality!r}"
        self.run_tool("quality", "plate.off", "--require", gate, expect=GATE_FAILED)
        self.run_tool("smooth", "plate.off", "out.off", "--require", gate)
        self.run_tool("quality", "out.off", "--require", gate)

    def test_every_metric_and_comparison_can_be_asked_for(self):
        prefixes = ("min_", "mean_", "max_", "stddev_", "acceptable_")
        names = ["triangles", "inverted", "degenerate", "min_angle", "max_angle"]
        for name in names + [prefix + metric for prefix in prefixes for metric in sorted(METRICS)]:
            with self.subTest(name):
                code = self.run_tool("quality", "plate.off", "--quiet", "--require", f"{name}<1e300").code
                self.assertEqual(code, DONE)
        for comparison, code in {">=": DONE, "<=": DONE, "==": DONE, ">": GATE_FAILED, "<": GATE_FAILED}.items():
            with self.subTest(comparison):
                self.run_tool("quality", "plate.off", "--quiet", "--require", f"triangles{comparison}128", expect=code)


class SameResult(CommandLineTest):

    def setUp(self):
        super().setUp()
        self.run_tool("generate", "random.off", "--vertices", "3000", "--seed", "4")

    def test_generate_gives_the_same_bytes_for_a_seed(self):
        for extension in ("off", "obj", "ply", "stl", "vtk", "vtu", "vtp"):
            with self.subTest(extension):
                for name, seed in (("a", 7), ("b", 7), ("c", 8)):
                    self.run_tool("generate", f"{name}.{extension}", "--vertices", "500", "--seed", seed)
                self.assertEqual(self.read(f"a.{extension}"), self.read(f"b.{extension}"))
                self.assertNotEqual(self.read(f"a.{extension}"), self.read(f"c.{extension}"))
                mesh = mesh_reader.read(self.path(f"a.{extension}"))
                self.assertEqual(len(mesh.points), 500)

    def test_a_generated_mesh_fills_the_unit_square(self):
        mesh = mesh_reader.read(self.path("random.off"))
        self.assertEqual(len(mesh.points), 3000)
        points = [p[:2] for p in mesh.points]
        areas = [planar_geometry.cross(points, *t) / 2 for _, t in mesh.triangles()]
        self.assertGreater(min(areas), 0)
        self.assertTrue(all(0 <= x <= 1 for p in points for x in p))
        self.assertLessEqual(sum(areas), 1 + 1e-12)
        self.assertGreater(sum(areas), 0.9)

    def test_threads_layouts_and_executions_give_the_same_coordinates(self):
        for form in "ab":
            for precision in ("double", "single"):
                hashes = set()
                for more in (("--threads", "1"), ("--threads", "2"), ("--threads", "3"), ("--threads", "16"),
                             ("--layout", "soa", "--execution", "single-block"), ("--execution", "cdp"),
                             ("--topology", "device")):
                    report = self.report("smooth", "random.off", "out.off", "--form", form, "--precision", precision,
                                         *more)
                    hashes.add((report["coordinates_hash"], report["uncommitted_hash"]))
                with self.subTest(form=form, precision=precision):
                    self.assertEqual(len(hashes), 1)

    def test_forms_and_precisions_are_really_different(self):
        hashes = [self.report("smooth", "random.off", "out.off", "--form", form, "--precision", precision)
                  ["coordinates_hash"] for form in "ab" for precision in ("double", "single")]
        self.assertEqual(len(set(hashes)), 4)

    def test_no_method_form_or_precision_makes_the_mesh_worse(self):
        before = planar_geometry.flat(mesh_reader.read(self.path("random.off")).points)
        triangles = [t for _, t in mesh_reader.read(self.path("random.off")).triangles()]
        orientation = planar_geometry.Orientation(triangles, before)
        old = min(orientation.shapes(before))
        for method in self.methods():
            for form in "ab":
                for precision in ("double", "single"):
                    with self.subTest(method=method, form=form, precision=precision):
                        report = self.report("smooth", "random.off", "out.off", "--method", method, "--form", form,
                                             "--precision", precision, "--max-sweeps", "30")
                        new = orientation.shapes(planar_geometry.flat(mesh_reader.read(self.path("out.off")).points))
                        self.assertGreaterEqual(min(new), old - 1e-12)
                        self.assertEqual(report["after"]["inverted"], 0)
                        self.assertGreater(report["smoothing"]["moved_vertices"], 1000)

    def locale_with_comma(self):
        """The environment that chooses one; it is made where it is not installed and can be."""
        if "de_DE.utf8" in subprocess.run(["locale", "-a"], capture_output=True, text=True, check=False).stdout.split():
            return {"LC_ALL": "de_DE.utf8"}
        try:
            # It warns of what this test does not need: whether it has made the locale is seen in the end.
            subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", self.path("de_DE.utf8")], capture_output=True,
                           check=False)
        except FileNotFoundError:
            pass
        if not os.path.exists(self.path("de_DE.utf8")):
            self.skipTest("no locale with a decimal comma can be had")
        environment = {"LC_ALL": "de_DE.utf8", "LOCPATH": self.folder}
        sample = subprocess.run(["locale", "decimal_point"], capture_output=True, text=True, check=False,
                                env={**os.environ, **environment}).stdout.strip()
        self.assertEqual(sample, ",")
        return environment

    def test_a_locale_with_a_decimal_comma_gives_the_same_bytes(self):
        locale = self.locale_with_comma()
        self.write("plate.vtu", sample_meshes.vtu(sample_meshes.Grid()))
        for name in ("plate.off", "plate.vtu"):
            outputs = [f"{number}{os.path.splitext(name)[1]}" for number in range(2)]
            prints = [self.run_tool("smooth", name, output, "--threads", "1", environment=chosen).out
                      for output, chosen in zip(outputs, ({"LC_ALL": "C"}, locale))]
            self.assertEqual(self.read(outputs[0]), self.read(outputs[1]))
            self.assertEqual(re.findall(r"^shape .*", prints[0], re.M), re.findall(r"^shape .*", prints[1], re.M))

    def test_stops_are_told_by_their_reason(self):
        for arguments, reason in {("--max-sweeps", "2"): "sweep_limit", ("--tolerance", "0.5"): "tolerance",
                                  ("--tolerance", "0", "--max-sweeps", "0"): "fixed_point",
                                  ("--method", "mean-ratio"): "few_moves",
                                  ("--target-quality", "-1"): "quality_target"}.items():
            with self.subTest(reason):
                report = self.report("smooth", "random.off", "out.off", *arguments)
                self.assertEqual(report["smoothing"]["stop_reason"], reason)
                if reason == "fixed_point":
                    self.assertEqual(report["smoothing"]["history"][-1]["moved"], 0)


class Interrupted(CommandLineTest):

    def interrupt(self, *arguments, after=1.0, number=signal.SIGINT):
        process = subprocess.Popen([tool.program, *arguments], cwd=self.folder, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        time.sleep(after)
        self.assertIsNone(process.poll(), "ended before it was interrupted")
        process.send_signal(number)
        out, err = process.communicate(timeout=60)
        return tool.Outcome(process.returncode, out, err)

    def test_an_interrupted_run_writes_nothing_and_leaves_the_old_output(self):
        self.run_tool("generate", "large.vtk", "--vertices", "300000", "--boundary", "resolved")
        for number in (signal.SIGINT, signal.SIGTERM):
            for pause in (0.3, 1.5):
                with self.subTest(number.name, after=pause):
                    self.write("out.vtk", "precious")
                    outcome = self.interrupt("smooth", "large.vtk", "out.vtk", "--backend", "cpu", "--max-sweeps", "0",
                                             "--tolerance", "0", "--method", "laplacian", "--guard", "off",
                                             "--report", "r.json", after=pause, number=number)
                    self.assertEqual(outcome.code, CANCELLED, outcome)
                    self.assertRegex(outcome.err, "cancelled")
                    self.assertEqual(len(outcome.err.splitlines()), 1)
                    self.assertEqual(self.read("out.vtk"), b"precious")
                    self.assertFalse(os.path.exists(self.path("r.json")))
                    self.assert_no_temporary_files()

    def test_an_interrupt_at_any_time_leaves_the_old_output_or_the_whole_new_one(self):
        self.run_tool("generate", "large.off", "--vertices", "100000")
        begin = time.monotonic()
        self.run_tool("smooth", "large.off", "whole.off", "--backend", "cpu")
        duration = time.monotonic() - begin
        codes = set()
        for part in range(12):
            with self.subTest(part=part):
                self.write("out.off", "precious")
                arguments = ("smooth", "large.off", "out.off", "--backend", "cpu", "--quiet")
                process = subprocess.Popen([tool.program, *arguments], cwd=self.folder, stderr=subprocess.DEVNULL)
                time.sleep(0.02 + duration * part / 10)
                process.send_signal(signal.SIGINT)
                codes.add(process.wait(timeout=60))
                content = self.read("out.off")
                self.assertEqual(content, self.read("whole.off") if process.returncode == DONE else b"precious")
                self.assert_no_temporary_files()
        # The last: interrupted before the program could ask to be told.
        self.assertLessEqual(codes, {DONE, CANCELLED, -signal.SIGINT})

    def test_interrupting_generate_leaves_nothing(self):
        outcome = self.interrupt("generate", "out.off", "--vertices", "3000000", after=0.5)
        self.assertEqual(outcome.code, CANCELLED, outcome)
        self.assertEqual(os.listdir(self.folder), ["plate.off"])


if __name__ == "__main__":
    tool.main()
