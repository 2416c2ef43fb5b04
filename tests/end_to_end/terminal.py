# SPDX-License-Identifier: BSD-3-Clause
"""What a terminal gets: lines that fit, a clock that runs, and no control characters."""

import os
import signal
import unicodedata

import sample_meshes
import terminal_screen
import tool

DONE, BAD_INPUT, CANCELLED = 0, 3, 130
WIDTHS = (20, 40, 80, 200)


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


if __name__ == "__main__":
    tool.main()
