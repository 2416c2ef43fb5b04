# SPDX-License-Identifier: BSD-3-Clause
"""Pictures in files, as the program draws them: read by a PNG reader and an XML parser of Python's."""

import os
import xml.etree.ElementTree

import png
import sample_meshes
import tool

# Four triangles that meet in the middle of a square; the one below is flat, all others are the same at their corner.
SQUARE = """OFF
5 4 0
0 0 0
4 0 0
4 4 0
0 4 0
2 {height} 0
3 0 1 4
3 1 2 4
3 2 3 4
3 3 0 4
"""
SVG = "{http://www.w3.org/2000/svg}"
RIGHT_ANGLED = (228, 234, 237)  # 0.87: on the way from (253, 219, 199) at 0.75 to (222, 238, 246) at 0.9
FLAT = (193, 51, 56)  # 0.12: from (178, 24, 43) at 0 to (239, 138, 98) at 0.5


class Pictures(tool.ToolTest):

    def setUp(self):
        super().setUp()
        self.write("square.off", SQUARE.format(height=2))
        self.write("plate.off", sample_meshes.off(sample_meshes.Grid()))

    def draw(self, *arguments, mesh="square.off", **options):
        return self.run_tool("quality", mesh, *arguments, **options)

    def test_known_colours_are_at_known_pixels(self):
        self.draw("--picture", "p.png", "--picture-window", "0,0,4,4")
        picture = png.Picture(self.read("p.png"))
        # The square is 900 pixels, 8 from the rims; what is far from edges is of one colour.
        self.assertGreater(picture.height, 900)
        for x, y in ((458, 700), (700, 458), (458, 200), (200, 458)):
            self.assertEqual(picture.colour(x, y), RIGHT_ANGLED)
        self.assertLess(max(picture.colour(458, 907)), 60)  # the boundary
        self.assertEqual(picture.colour(2, 2), (255, 255, 255))
        self.write("square.off", SQUARE.format(height=0.2))
        self.draw("--picture", "p.png", "--picture-window", "0,0,4,4")
        self.assertEqual(png.Picture(self.read("p.png")).colour(458, 890), FLAT)

    def test_svg_is_xml_whose_paths_are_the_elements(self):
        self.draw("--picture", "p.svg", "--picture-worst", "2", mesh="plate.off")
        root = xml.etree.ElementTree.fromstring(self.read("p.svg"))
        self.assertEqual([child.tag for child in root][:2], [SVG + "title", SVG + "desc"])
        panels = root.findall(SVG + "svg")
        self.assertEqual(len(panels), 3)
        drawn = sum(path.get("d").lower().count("m") for path in panels[0].iter(SVG + "path") if path.get("fill") != "none")
        self.assertEqual(drawn, len(sample_meshes.Grid().cells))
        words = " ".join("".join(text.itertext()) for text in root.iter(SVG + "text"))
        worst = self.report("quality", "plate.off")["before"]["worst"]
        self.assertIn(f"1: element {worst[0]['cell']} ", words)

    def test_smooth_draws_its_result_and_quality_its_input(self):
        self.run_tool("smooth", "plate.off", "out.off", "--picture", "smoothed.svg")
        self.draw("--picture", "checked.svg", mesh="out.off")
        self.draw("--picture", "before.svg", mesh="plate.off")
        self.assertEqual(self.read("smoothed.svg"), self.read("checked.svg"))
        self.assertNotEqual(self.read("smoothed.svg"), self.read("before.svg"))
        self.run_tool("smooth", "plate.off", "out.off", "--picture", "m.svg", "--picture-metric", "moved")
        self.assertIn(b"moved, in the unit of length", self.read("m.svg"))

    def test_several_pictures_and_no_output_line_too_few(self):
        outcome = self.draw("--picture", "a.svg", "--picture", "b.PNG")
        self.assertIn("picture:    a.svg\npicture:    b.PNG\n", outcome.out)
        first = self.read("b.PNG")
        self.draw("--picture", "b.PNG", "--threads", "1")
        self.assertEqual(self.read("b.PNG"), first)

    def test_longitudes_and_latitudes_are_those_of_windows(self):
        self.draw("--geographic", "--picture", "p.svg", "--picture-window", "1,1,3,3")
        self.assertEqual(self.draw("--geographic", "--picture", "p.svg", "--picture-window", "1,1,3,3").err, "")
        outcome = self.draw("--geographic", "--picture", "p.svg", "--picture-window", "10,10,30,30")
        self.assertIn("the mesh spans 0,", outcome.err)

    def test_a_window_where_nothing_is_is_told(self):
        outcome = self.draw("--picture", "p.png", "--picture-window", "10,10,11,11")
        self.assertIn("p.png: it is empty: nothing of the mesh is in the window 10,10,11,11; the mesh spans 0,0,4,4",
                      outcome.err)
        self.assertEqual(self.draw("-q", "--picture", "p.png", "--picture-window", "10,10,11,11").err, "")

    def test_what_cannot_be_drawn_is_refused_before_anything_is_written(self):
        for arguments, words in (
            (("--picture", "p.jpg"), "'p.jpg' is no picture file; its name must end in .svg or .png"),
            (("--picture", "-"), "'-' is no picture file"),
            (("--picture", "p.svg", "--picture-window", "1,2,3"), "expected four numbers, x0,y0,x1,y1"),
            (("--picture", "p.svg", "--picture-window", "1,1,1,2"), "is empty"),
            (("--picture", "p.svg", "--picture-worst", "-1"), "expected a whole number from 0 to 24"),
            (("--picture", "p.svg", "--picture-metric", "beauty"), "they show shape, area, "),
            (("--picture", "p.svg", "--picture-metric", "skew"), "no element of the mesh has skew: all are triangles"),
            (("--picture", "p.svg", "--picture-metric", "moved"), "nothing has moved"),
            (("--picture", "p.svg", "--picture", "./p.svg"), "--picture ./p.svg: is given twice"),
            (("--picture", "p.svg", "--report", "p.svg"), "is no report file"),
        ):
            outcome = self.draw(*arguments, expect=2)
            self.assertIn(words, " ".join(outcome.err.split()))
            self.assertEqual(outcome.out, "")
            self.assertFalse(os.path.exists(self.path("p.svg")))
        self.run_tool("smooth", "square.off", "out.off", "--picture", "p.svg", "--picture-metric", "taper", expect=2)
        self.assertFalse(os.path.exists(self.path("out.off")))
        self.assert_no_temporary_files()

    def test_a_picture_overwrites_no_other_file_of_the_run(self):
        os.link(self.path("square.off"), self.path("square.svg"))
        outcome = self.draw("--picture", "square.svg", expect=2)
        self.assertIn("--picture square.svg: is the same file as square.off", outcome.err)
        self.write("old.svg", "old")
        self.run_tool("smooth", "missing.off", "out.off", "--picture", "old.svg", expect=None)
        self.assertEqual(self.read("old.svg"), b"old")

    def test_nor_one_that_is_to_be_made(self):
        for name, options in (("out.vtu", ("--picture", "link.svg")), ("new.svg", ("--format", "off", "--picture", "./new.svg")),
                              ("page.html", ("--format", "off", "--report", "page.html"))):
            if not os.path.lexists(self.path("link.svg")):
                os.symlink("out.vtu", self.path("link.svg"))
            done = self.run_tool("smooth", "plate.off", name, *options, expect=2)
            self.assertIn("is the same file as " + name, done.err)
            self.assertFalse(os.path.exists(self.path(name)))
        os.symlink("a.png", self.path("b.png"))
        done = self.run_tool("quality", "plate.off", "--picture", "a.png", "--picture", "b.png", expect=2)
        self.assertIn("--picture b.png: is given twice", done.err)
        self.assertFalse(os.path.exists(self.path("a.png")))

    def test_all_of_it_is_written_or_nothing(self):
        outcome = self.run_tool("smooth", "square.off", "out.off", "--picture", "nowhere/p.svg", expect=4)
        self.assertIn("nowhere/p.svg", outcome.err)
        self.assertFalse(os.path.exists(self.path("out.off")))

    def test_options_without_a_picture_are_said_to_have_no_effect(self):
        outcome = self.draw("--picture-metric", "area", "--picture-worst", "3")
        self.assertIn("--picture-metric, --picture-worst has no effect: it is for pictures, which --picture FILE asks for",
                      " ".join(outcome.err.split()))
        self.assertNotIn("no effect", self.draw("-q", "--picture-worst", "3").err)

    def test_deform_draws_the_last_step(self):
        self.write("moves.csv", "\n".join(f"{v},0.1,0" for v in range(4)) + "\n")
        self.run_tool("deform", "square.off", "out.off", "--displacement-file", "moves.csv", "--picture", "p.svg",
                      "--picture-metric", "moved")
        self.assertIn(b"0.1<", self.read("p.svg"))


if __name__ == "__main__":
    tool.main()
