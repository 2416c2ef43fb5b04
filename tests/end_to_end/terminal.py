"""What a terminal gets: lines that fit, a clock that runs, help with what was misspelt, and no control characters."""

import os
import re
import signal
import unicodedata

import planar_geometry
import mesh_reader
import sample_meshes
import terminal_screen
import tool

DONE, WRONG_USAGE, BAD_INPUT, CANCELLED = 0, 2, 3, 130
WIDTHS = (20, 40, 80, 200)
COMMANDS = ("smooth", "quality", "generate", "bench", "info")


class Width(tool.ToolTest):

    def setUp(self):
        super().setUp()
        self.write("plate.vtu", sample_meshes.vtu(sample_meshes.Grid(others=True)))

    def assert_fits(self, screen, columns):
        for drawn in screen.progress():
            self.assertLess(terminal_screen.width(drawn), columns, drawn)
        for line in screen.lines():
            if not line.startswith("trismooth: "):  # messages are for programs to find, too: one a line
                self.assertLessEqual(terminal_screen.width(line), 80, line)
                self.assertNotRegex(line, "[\r\x1b]")

    def test_every_command_fits_every_terminal(self):
        for columns in WIDTHS:
            for arguments in (("smooth", "plate.vtu", "out.off", "--report", "r.json"),
                              ("smooth", "plate.vtu", "out.vtu", "--verbose"), ("quality", "plate.vtu"),
                              ("generate", "random.off", "--vertices", "5K"), ("info",),
                              ("bench", "--sizes", "300,1K", "--runs", "2", "--versions", "serial,cpu")):
                with self.subTest(" ".join(arguments), columns=columns):
                    screen = terminal_screen.Screen(self, columns, *arguments)
                    self.assertEqual(screen.finish(), DONE, screen.text)
                    self.assert_fits(screen, columns)
                    self.assertEqual(bool(screen.progress()), arguments[0] != "info" and "--verbose" not in arguments)

    def test_every_help_page_fits_80_columns(self):
        for arguments in (("--help",), *((command, "--help") for command in COMMANDS)):
            with self.subTest(arguments):
                outcome = self.run_tool(*arguments)
                for line in outcome.out.splitlines():
                    self.assertLessEqual(len(line), 80)
                    self.assertEqual(line, line.rstrip())

    def test_the_clock_runs_while_a_stage_reports_nothing_and_the_line_follows_the_width(self):
        os.mkfifo(self.path("slow.off"))
        screen = terminal_screen.Screen(self, 80, "smooth", "slow.off", "out.off")
        with open(self.path("slow.off"), "wb") as pipe:
            first = screen.wait_for(" s")
            self.assertRegex(first, r"reading \.\.\., 0\.\d s")
            for tenth in (1, 2, 3):
                self.assertIn(f"0.{tenth} s", screen.wait_for(f"0.{tenth} s"))
            for columns in (20, 12, 5, 200):
                screen.resize(columns)
                for _ in range(3):  # the first was perhaps drawn before the width changed, the last perhaps not whole
                    screen.wait_for(terminal_screen.ERASE)
                drawn = screen.text.split(terminal_screen.ERASE)[-2]
                self.assertTrue(drawn)
                self.assertLess(terminal_screen.width(drawn), columns)
            pipe.write(sample_meshes.off(sample_meshes.Grid()))
        self.assertEqual(screen.finish(), DONE)
        self.assert_fits(screen, 200)
        self.assertRegex(screen.lines()[0], "^input: +slow.off")

    def test_sweeps_are_counted_and_an_interrupt_leaves_a_clean_line(self):
        self.run_tool("generate", "random.off", "--vertices", "5K")
        screen = terminal_screen.Screen(self, 80, "smooth", "random.off", "out.off", "--tolerance", "0", "--method",
                                        "laplacian", "--max-sweeps", "900000000")
        screen.wait_for("of at most 900000000")
        screen.process.send_signal(signal.SIGINT)
        self.assertEqual(screen.finish(), CANCELLED)
        self.assertRegex(screen.text, r"smoothing: sweep \d+ of at most 900000000, \d+ vert\w+ moved, \d\.\d s")
        self.assertEqual(screen.lines()[-2:], ["trismooth: error: cancelled", ""])
        self.assert_fits(screen, 80)

    def test_without_a_terminal_there_is_no_progress(self):
        outcome = self.run_tool("smooth", "plate.vtu", "out.vtu")
        self.assertNotRegex(outcome.out + outcome.err, "[\r\x1b]|reading|sweep 1 ")


class Summary(tool.ToolTest):

    def setUp(self):
        super().setUp()
        self.write("plate.off", sample_meshes.off(sample_meshes.Grid()))

    def test_smooth_is_brief_unless_asked(self):
        brief = self.run_tool("smooth", "plate.off", "out.off").out
        verbose = self.run_tool("smooth", "plate.off", "out.off", "-v").out
        self.assertLess(len(brief.splitlines()), 16)
        for word in ("input:", "smoothing:", "result:", "shape", "min_angle", "max_angle", "inverted", "written:"):
            self.assertRegex(brief, f"(?m)^{word} ")
            self.assertRegex(verbose, f"(?m)^{word} ")
        for word in ("aspect_ratio", "centroid", "0.95 to 1.00"):
            self.assertNotIn(word, brief)
            self.assertIn(word, verbose)

    def test_the_worst_elements_that_nothing_can_change_are_marked(self):
        report = self.report("quality", "plate.off")
        mesh = mesh_reader.read(self.path("plate.off"))
        fixed = planar_geometry.fixed_vertices(mesh)
        for element in report["before"]["worst"]:
            corners = mesh.cells[element["cell"]][1]
            self.assertEqual(element["all_fixed"], all(v in fixed for v in corners))
        # Two corners of the square have a triangle with no free vertex; hold some more.
        worst = [element["cell"] for element in report["before"]["worst"]]
        held = mesh.cells[worst[0]][1]
        self.write("ids.txt", " ".join(map(str, held)))
        again = self.report("quality", "plate.off", "--fixed-ids", "ids.txt")["before"]["worst"]
        self.assertTrue(again[0]["all_fixed"])
        text = self.run_tool("quality", "plate.off", "--fixed-ids", "ids.txt").out
        self.assertRegex(text, rf"(?m)^ +1 +{worst[0]} .*\) +all fixed$")
        self.assertEqual(len(re.findall("all fixed$", text, re.M)), sum(element["all_fixed"] for element in again))
        self.run_tool("quality", "plate.off", "--fixed-ids", "ids.txt", "--report", "r.html")
        self.assertEqual(self.read("r.html").count(b"all corners fixed"), sum(e["all_fixed"] for e in again))


class ControlCharacters(tool.ToolTest):
    """No name, path or argument steers the terminal or forges a line, whoever says it."""

    # Every control character of one byte and of two, what turns the direction of writing, separators of lines, bytes
    # that are no UTF-8, and the words of an error.
    CONTROLS = [chr(code) for code in (*range(1, 32), *range(127, 160), 0x61c, 0x200e, 0x200f, *range(0x2028, 0x202f),
                                       *range(0x2066, 0x206a))]
    FORGED = "\ntrismooth: error: forged\r\x1b[2J"

    def assert_harmless(self, outcome):
        for text in (outcome.out, outcome.err):
            for character in text:
                harmful = (unicodedata.category(character) in ("Cc", "Zl", "Zp") and character != "\n" or
                           unicodedata.category(character) == "Cf" or character == "\N{REPLACEMENT CHARACTER}")
                self.assertFalse(harmful, f"U+{ord(character):04x} in {outcome}")
            self.assertNotRegex(text, r"(?m)^trismooth: error: forged")

    def named_meshes(self, without=""):
        """Small meshes of every format with such names where it has names: {file name: bytes}."""
        square = "0 0 0 1 0 0 1 1 0 0 1 0 .6 .7 0"
        corners = ((0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4))
        name = "".join(c for c in self.CONTROLS if c not in without)
        escaped = "".join(f"%{byte:02X}" for byte in (name + self.FORGED).encode())
        values = "0 0 1 1\n"
        legacy = (f"# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 double\n{square}\n"
                  "CELLS 4 16\n" + "".join(f"3 {a} {b} {c}\n" for a, b, c in corners) + "CELL_TYPES 4\n5 5 5 5\n"
                  f"CELL_DATA 4\nFIELD F 1\n{escaped} 1 4 int\n{values}")
        references = "".join(f"&#{ord(c)};" for c in name + "\ntrismooth: error: forged\r" if ord(c) >= 32 or
                             c in "\t\n\r")
        xml = ('<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian"><UnstructuredGrid>'
               '<Piece NumberOfPoints="5" NumberOfCells="4"><Points><DataArray type="Float64" NumberOfComponents="3" '
               f'format="ascii">{square}</DataArray></Points><Cells><DataArray type="Int32" Name="connectivity" '
               f'format="ascii">{" ".join(str(v) for t in corners for v in t)}</DataArray><DataArray type="Int32" '
               'Name="offsets" format="ascii">3 6 9 12</DataArray><DataArray type="UInt8" Name="types" format="ascii">'
               f'5 5 5 5</DataArray></Cells><CellData><DataArray type="Int32" Name="{references}" format="ascii">'
               f'{values}</DataArray></CellData></Piece></UnstructuredGrid></VTKFile>\n')
        word = "".join(c for c in name if not c.isspace() and c not in "\x0b\x0c\x1c\x1d\x1e\x1f\x85")
        points = "".join(f"{x} {y} 0\n" for x, y in ((0, 0), (1, 0), (1, 1), (0, 1), (.6, .7)))
        ply = (f"ply\nformat ascii 1.0\ncomment {word}\nelement vertex 5\nproperty double x\nproperty double y\n"
               f"property double z\nelement face 4\nproperty list uchar int vertex_indices\nproperty int {word}\n"
               f"end_header\n{points}" + "".join(f"3 {a} {b} {c} 1\n" for a, b, c in corners))
        obj = "".join(f"v {line}\n" for line in points.splitlines()) + f"g {word}\n" + "".join(
            f"usemtl {word}{a // 2}\nf {a + 1} {b + 1} {c + 1}\n" for a, b, c in corners)
        return {"a.vtk": legacy.encode(), "a.vtu": xml.encode(), "a.ply": ply.encode(), "a.obj": obj.encode()}

    def test_names_in_files(self):
        for name, content in self.named_meshes().items():
            self.write(name, content)
            for target in ("out.off", "out.vtk", "out.vtu"):
                with self.subTest(name, target=target):
                    outcome = self.run_tool("smooth", name, target, "--verbose", expect=None)
                    self.assert_harmless(outcome)
                    self.assertIn(outcome.code, (DONE, BAD_INPUT))
            outcome = self.run_tool("quality", name, "--region-array", "none such", expect=None)  # lists what there is
            self.assert_harmless(outcome)
            self.assertNotEqual(outcome.code, DONE)

    def test_a_name_that_is_said_stands_with_its_escapes(self):
        self.write("a.vtk", self.named_meshes()["a.vtk"])
        err = self.run_tool("smooth", "a.vtk", "out.off", "--verbose").err
        self.assertIn(r"\x01\x02", err)
        self.assertIn(r"\u009b", err)
        self.assertIn(r"\u202e", err)
        self.assertIn(r"\x0atrismooth: error: forged\x0d\x1b[2J", err)

    def test_damaged_files_that_quote_what_they_hold(self):
        controls = "".join(self.CONTROLS).encode() + b"\xff\xfe\x9b"
        for extension, head in {"off": b"OFF ", "obj": b"v 0 0 0\nf ", "ply": b"ply\nformat ", "stl": b"solid\nfacet ",
                                "vtk": b"# vtk DataFile Version 3.0\nt\nASCII\nDATASET ", "vtu": b"<VTKFile type='",
                                "vtp": b"<a ", "xyz": b""}.items():
            for pause in (b"", b" "):
                with self.subTest(extension, pause=pause):
                    separated = pause.join(controls[i:i + 1] for i in range(len(controls)))
                    self.write("a." + extension, head + separated + b"\n")
                    self.assert_harmless(self.run_tool("quality", "a." + extension, expect=None))
        self.write("plate.off", sample_meshes.off(sample_meshes.Grid()))
        for content in (controls, b"1 \x1b[2J", b"1 2 \xc2\x9b"):
            self.write("ids.txt", content)
            self.assert_harmless(self.run_tool("quality", "plate.off", "--fixed-ids", "ids.txt", expect=BAD_INPUT))

    def test_file_names(self):
        for name in ("".join(c for c in self.CONTROLS if ord(c) < 0x100) + self.FORGED,
                     "\u202e\u2066\u2028" + b"\xff\x9b".decode(errors="surrogateescape")):
            mesh, other = name + ".off", name + "2.vtk"
            self.write(mesh, sample_meshes.off(sample_meshes.Grid(3)))
            for arguments in (("smooth", mesh, other, "--report", name + ".json", "--report", name + ".html"),
                              ("quality", mesh, "--fixed-ids", mesh), ("quality", other + "x"), ("smooth", other + "x", mesh),
                              ("smooth", mesh, name + "/out.off"), ("generate", other, "--vertices", "9"), (name,),
                              ("generate", name, "--vertices", name), ("--" + name,), ("smooth", mesh, other, name),
                              ("smooth", mesh, other, "--region-array", name), ("smooth", mesh, other, "--method", name),
                              ("smooth", mesh, other, "--require", name + ">=1"), ("smooth", mesh, mesh, "--report", mesh),
                              ("bench", "--report", name)):
                with self.subTest(name=name, arguments=arguments):
                    self.assert_harmless(self.run_tool(*arguments, expect=None))
            page = self.read(name + ".html").decode()
            self.assertFalse([c for c in page if unicodedata.category(c) in ("Cc", "Cf", "Zl", "Zp") and c != "\n"])


class Misspelt(tool.ToolTest):

    def test_what_may_have_been_meant_is_named(self):
        for arguments, meant in {("smoth", "a.off", "b.off"): "smooth", ("--vresion",): "--version",
                                 ("quality", "a.off", "--requrie", "inverted==0"): "--require",
                                 ("smooth", "--tolerence", "1e-3", "a.off", "b.off"): "--tolerance",
                                 ("smooth", "a.off", "b.off", "--execution", "single_block"): "single-block",
                                 ("smooth", "a.off", "b.off", "--topology", "Device"): "device",
                                 ("smooth", "a.off", "b.off", "--require", "mean_shap>=0.9"): "mean_shape",
                                 ("generate", "a.off", "--vertice", "9"): "--vertices"}.items():
            with self.subTest(" ".join(arguments)):
                outcome = self.run_tool(*arguments, expect=WRONG_USAGE)
                self.assertIn(f"(did you mean '{meant}'?)", outcome.err)
                self.assertEqual(len(outcome.err.splitlines()), 1)
        for arguments in (("plate.off",), ("smooth", "a", "b", "--zzz"), ("smooth", "a", "b", "--backend", "gpu")):
            self.assertNotIn("mean", self.run_tool(*arguments, expect=WRONG_USAGE).err)

    def test_stray_arguments_are_told_in_their_order(self):
        outcome = self.run_tool("quality", "a.off", "first", "second", "third", expect=WRONG_USAGE)
        self.assertIn("unexpected arguments 'first', 'second', 'third'", outcome.err)


if __name__ == "__main__":
    tool.main()
