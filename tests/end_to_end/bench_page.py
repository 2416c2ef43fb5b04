# SPDX-License-Identifier: BSD-3-Clause
"""The page of `trismooth bench` in a real browser: nothing fails, the figures are drawn, it can be printed, and
read in windows of any width.

Exits with 77 where there is no browser, which ctest shows as skipped.
"""

import json
import math
import re
import shutil
import sys
import tempfile
import zlib

import browser
import png
import report_page
import tool

WIDTH = 1200  # of the window
NARROW = (320, 390, 601, 700, 960)

# Of a figure: its place, what is drawn in it, its texts that another one or the border cuts.
MEASURE = """(id => {
  const place = element => {
    const box = element.getBoundingClientRect();
    return {left: box.left + scrollX, top: box.top + scrollY, right: box.right + scrollX, bottom: box.bottom + scrollY};
  };
  const svg = document.getElementById(id);
  const whole = place(svg);
  const texts = [...svg.querySelectorAll('text')].map(text => ({name: text.textContent, ...place(text)}));
  const overlap = (a, b) => Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1 &&
                            Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 1;
  return {
    ...whole,
    lines: [...svg.querySelectorAll('polyline')].map(
        line => ({colour: getComputedStyle(line).stroke, width: parseFloat(getComputedStyle(line).strokeWidth),
                  ...place(line)})),
    markers: svg.querySelectorAll('path').length,
    texts: texts.map(text => text.name),
    outside: texts.filter(text => text.left < whole.left - 0.5 || text.right > whole.right + 0.5 ||
                                  text.top < whole.top - 0.5 || text.bottom > whole.bottom + 0.5)
                 .map(text => text.name),
    overlapping: texts.flatMap((a, i) => texts.slice(i + 1).filter(b => overlap(a, b))
                                              .map(b => a.name + ' / ' + b.name))
  };
})"""


def numbers(colour):
    """The three of "rgb(0, 158, 115)"."""
    return tuple(map(int, re.findall(r"\d+", colour)[:3]))


class Page(tool.ToolTest):

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="trismooth-")
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        # Lines need two sizes, the paper's own too.
        cls().run_tool("bench", "--sizes", "200,1K,5K", "--runs", "2", "--report", "bench.html", "--report", "bench.json")
        cls.browser = browser.Browser()
        cls.addClassCleanup(cls.browser.close)

    def setUp(self):
        """All have the folder and the window of the class."""

    def page_with(self, addition):
        """A copy of the page with this at its end."""
        begin, end = self.read("bench.html").decode().split("</body>")
        return self.write("changed.html", f"{begin}{addition}</body>{end}")

    def figure(self, name):
        return self.browser.evaluate(f"{MEASURE}('{name}')")

    def measured(self):
        """The rows of the report that are there."""
        return [row for row in json.loads(self.read("bench.json"))["rows"] if row["measured"]]

    def lines_seen(self, figure):
        """How many of the figure's lines show on the screen in their place, and how many there are; no faint ones."""
        left, top = math.floor(figure["left"]), math.floor(figure["top"])
        size = math.ceil(figure["right"]) - left, math.ceil(figure["bottom"]) - top
        picture = png.Picture(self.browser.screenshot(left, top, *size))
        self.assertEqual((picture.width, picture.height), size)
        lines = [line for line in figure["lines"] if line["width"] >= 2]
        seen = 0
        for line in lines:
            columns = range(math.floor(line["left"]) - left, math.ceil(line["right"]) - left)
            rows = range(math.floor(line["top"]) - top - 1, math.ceil(line["bottom"]) - top + 1)
            colour = numbers(line["colour"])
            pixels = sum(max(abs(a - b) for a, b in zip(picture.colour(x, y), colour)) <= 8
                         for y in rows for x in columns)
            seen += pixels >= 10
        return seen, len(lines)

    def test_nothing_fails_and_nothing_else_is_loaded(self):
        self.browser.open(self.path("bench.html"), WIDTH)
        self.assertEqual(self.browser.complaints(), [])
        self.assertEqual(self.browser.requests(), [f"file://{self.path('bench.html')}"])

    def test_what_fails_in_a_page_is_noticed(self):
        for addition, says in {"<script>console.error('planted')</script>": "planted",
                               "<script>console.warn('planted')</script>": "planted",
                               "<script>planted()</script>": "planted is not defined",
                               "<script>Promise.reject(new Error('planted'))</script>": "planted",
                               "<img src='planted.png'/>": "ERR_FILE_NOT_FOUND",
                               "<link rel='stylesheet' href='planted.css'/>": "ERR_FILE_NOT_FOUND",
                               "<img src='https://planted.invalid/x.png'/>": "net::ERR"}.items():
            with self.subTest(addition):
                self.browser.open(self.page_with(addition), WIDTH)
                self.assertIn(says, " ".join(self.browser.complaints()))
                self.assertEqual(len(self.browser.requests()), 1 if "script" in addition else 2)

    def test_both_figures_are_drawn_and_can_be_read(self):
        self.browser.open(self.path("bench.html"), WIDTH)
        self.assertLessEqual(self.browser.evaluate("document.documentElement.scrollWidth"), WIDTH)
        # Two panels each; the paper's own lines are those of two versions, in Figure 3 in two forms.
        lines = {"figure-3": 2 * (len({(row["version"], row["form"]) for row in self.measured()}) + 4),
                 "figure-4": 2 * (len({row["version"] for row in self.measured()} - {"serial"}) + 2)}
        for name, count in lines.items():
            with self.subTest(name):
                figure = self.figure(name)
                self.assertGreater(figure["right"] - figure["left"], 200)
                self.assertGreater(figure["bottom"] - figure["top"], 100)
                self.assertEqual(len(figure["lines"]), count)
                self.assertGreaterEqual(figure["markers"], 2 * count)
                self.assertLessEqual({"200", "1K", "5K", "optimised CPU" if name == "figure-4" else
                                      "optimised CPU, Form A"}, {*figure["texts"]})
                self.assertEqual((figure["outside"], figure["overlapping"]), ([], []))
                seen, there = self.lines_seen(figure)
                self.assertGreater(there, 0)
                self.assertEqual(seen, there)

    def full_page(self):
        """The page as if all had been measured, with its details open."""
        page, count = re.subn("(<td(?! class=.[a-z ]*paper)[^>]*>)-</td>",
                              r"\g<1>0.412 <small>(0.410-0.419)</small></td>", self.read("bench.html").decode())
        if any(row["missing_reason"] for row in json.loads(self.read("bench.json"))["rows"]):
            self.assertGreater(count, 4 * 3 * 4)  # four tables of three sizes, two times and two speedups
        return self.write("full.html", page.replace("<details>", "<details open=''>"))

    def test_the_window_has_room_for_what_a_device_measures(self):
        self.browser.open(self.full_page(), WIDTH)
        self.assertLessEqual(self.browser.evaluate("document.documentElement.scrollWidth"), WIDTH)

    def test_it_can_be_read_in_narrow_windows(self):
        page = self.full_page()
        for width in NARROW:
            with self.subTest(width):
                self.browser.open(page, width)
                found = self.browser.evaluate(report_page.MEASURE)
                self.assertLessEqual(found["width"], width)
                self.assertGreater(found["texts"], 300)
                for fault in ("beyond", "small", "cut", "colliding"):
                    self.assertEqual(found[fault], [], fault)
                # The tables have no head: every value says what it is.
                self.assertGreater(found["labels"], 100)
                for name in ("figure-3-narrow", "figure-4-narrow"):
                    figure = self.figure(name)
                    self.assertGreater(figure["right"] - figure["left"], 0.85 * min(width, 520))
                    self.assertEqual((figure["outside"], figure["overlapping"]), ([], []))
                    seen, there = self.lines_seen(figure)
                    self.assertGreater(there, 0)
                    self.assertEqual(seen, there)
        # What the test looks for is found where it is.
        wide = self.page_with("<style>table.stack { width: 800px ! important }</style>")
        self.browser.open(wide, 390)
        self.assertGreater(self.browser.evaluate(report_page.MEASURE)["width"], 390)

    def test_figures_that_are_not_drawn_well_are_noticed(self):
        self.browser.open(self.page_with("<style>polyline, svg path { visibility: hidden }</style>"), WIDTH)
        self.assertEqual(self.lines_seen(self.figure("figure-3"))[0], 0)
        self.browser.open(self.page_with("<style>svg text { font-size: 40px }</style>"), WIDTH)
        figure = self.figure("figure-4")
        self.assertNotEqual(figure["outside"], [])
        self.assertNotEqual(figure["overlapping"], [])

    def test_it_prints_with_its_figures(self):
        self.browser.open(self.path("bench.html"), WIDTH)
        colours = {line["colour"] for name in ("figure-3", "figure-4") for line in self.figure(name)["lines"]}
        pdf = self.browser.print()
        self.assertTrue(pdf.startswith(b"%PDF-"))
        self.assertGreater(len(re.findall(rb"/Type\s*/Page\b(?!s)", pdf)), 1)
        drawn = set()
        for stream in re.findall(rb"\bstream\r?\n(.*?)\r?\nendstream", pdf, re.DOTALL):
            try:
                content = zlib.decompress(stream)
            except zlib.error:
                continue  # one of another kind
            # Colours of lines, from 0 to 1.
            drawn |= {tuple(round(255 * float(part)) for part in colour)
                      for colour in re.findall(rb"([\d.]+) ([\d.]+) ([\d.]+) RG\b", content)}
        self.assertGreater(len(colours), 1)
        self.assertLessEqual({*map(numbers, colours)}, drawn)
        self.assertEqual(self.browser.complaints(), [])


if __name__ == "__main__":
    if browser.find() is None:
        print(f"skipped: there is none of {', '.join(browser.NAMES)}")
        sys.exit(77)
    tool.main()
