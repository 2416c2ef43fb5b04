# SPDX-License-Identifier: BSD-3-Clause
"""The HTML report in a real browser: nothing fails, and it can be read in every window, a telephone's too.

Exits with 77 where there is no browser, which ctest shows as skipped.
"""

import sys

import browser
import sample_meshes
import tool

WIDTHS = (320, 390, 601, 768, 961, 1200)

# What a reader with a narrow window would miss: what goes beyond it, letters that are too small or cut off, labels of a
# chart that lie on each other, rows of a table whose cells do.
MEASURE = """(() => {
  const shown = element => {
    const box = element.getBoundingClientRect();
    return box.width > 0 && box.height > 0;
  };
  const texts = [...document.querySelectorAll('body *')].filter(
      element => shown(element) && element.closest('title, style') === null &&
                 [...element.childNodes].some(node => node.nodeType === 3 && node.textContent.trim()));
  const name = element => element.textContent.trim().slice(0, 40);
  const overlap = (a, b) => Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1 &&
                            Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 1;
  const colliding = elements => elements.flatMap((a, i) => elements.slice(i + 1).filter(
      b => overlap(a.getBoundingClientRect(), b.getBoundingClientRect())).map(b => name(a) + ' / ' + name(b)));
  return {
    width: document.documentElement.scrollWidth,
    texts: texts.length,
    beyond: texts.filter(element => element.getBoundingClientRect().right > innerWidth + 0.5 ||
                                    element.getBoundingClientRect().left < -0.5).map(name),
    small: texts.filter(element => element.getBoundingClientRect().height < 10 ||
                                   parseFloat(getComputedStyle(element).fontSize) < 12).map(name),
    cut: [...document.querySelectorAll('td, th')].filter(cell => cell.scrollWidth > cell.clientWidth + 1).map(name),
    colliding: [...document.querySelectorAll('svg.chart')].flatMap(
        svg => colliding([...svg.querySelectorAll('text')])).concat(
        [...document.querySelectorAll('tr')].flatMap(row => colliding([...row.children].filter(shown)))),
    bars: [...document.querySelectorAll('svg.chart rect')].filter(shown).length,
    charts: [...document.querySelectorAll('svg.chart')].map(svg => svg.getBoundingClientRect().width),
    labels: [...document.querySelectorAll('td[data-label]')].filter(
        cell => getComputedStyle(cell, '::before').content.includes(cell.dataset.label)).length
  };
})()"""


class Page(tool.ToolTest):

    def test_it_can_be_read_in_windows_of_any_width(self):
        self.write("tangled mesh of a long name.vtk", sample_meshes.legacy_vtk(sample_meshes.Grid(20)))
        self.run_tool("generate", "random.off", "--vertices", "20000")
        self.run_tool("smooth", "random.off", "out.off", "--report", "smooth.html", "--require", "min_shape>=0.99",
                      "--require", "degenerate==0", expect=1)
        self.run_tool("smooth", "tangled mesh of a long name.vtk", "out.vtk", "--report", "regions.html")
        self.run_tool("quality", "random.off", "--report", "quality.html")
        window = browser.Browser()
        self.addCleanup(window.close)
        # One page in windows of all widths; of the others the narrowest, and that in which tables first have their heads.
        for page, charts, widths in (("smooth.html", 2, WIDTHS), ("regions.html", 2, (320, 961)),
                                     ("quality.html", 1, (320, 961))):
            for width in widths:
                with self.subTest(page=page, width=width):
                    window.open(self.path(page), width)
                    self.assertEqual(window.complaints(), [])
                    found = window.evaluate(MEASURE)
                    self.assertLessEqual(found["width"], width)
                    self.assertGreater(found["texts"], 80)
                    for fault in ("beyond", "small", "cut", "colliding"):
                        self.assertEqual(found[fault], [], fault)
                    self.assertGreaterEqual(found["bars"], 10)
                    self.assertEqual(len(found["charts"]), charts)
                    self.assertGreater(min(found["charts"]), 0.65 * min(width, 1016))
                    # In a narrow window the tables of many columns have no head: every value says what it is.
                    self.assertEqual(found["labels"] > 0, width <= 960)
        # What the test looks for is found where it is.
        begin, end = self.read("smooth.html").decode().split("</body>")
        self.write("bad.html", begin + "<style>svg.chart text { font-size: 30px } td, th { white-space: nowrap ! important;"
                   " font-size: 8px }</style><p style='width: 900px'>wide</p></body>" + end)
        window.open(self.path("bad.html"), 390)
        found = window.evaluate(MEASURE)
        self.assertGreater(found["width"], 390)
        for fault in ("beyond", "small", "colliding"):
            self.assertNotEqual(found[fault], [], fault)


if __name__ == "__main__":
    if browser.find() is None:
        print(f"skipped: there is none of {', '.join(browser.NAMES)}")
        sys.exit(77)
    tool.main()
