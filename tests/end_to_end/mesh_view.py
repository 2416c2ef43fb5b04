# SPDX-License-Identifier: BSD-3-Clause
"""The view of the mesh in the HTML report, in a real browser: what a reader sees, clicks and turns.

Exits with 77 where there is no browser, which ctest shows as skipped.
"""

import base64
import json
import pathlib
import sys
import time

import browser
import mesh_reader
import png
import tool

COUNT = 9  # squares along a side
SECONDS = 30
# Names that would run as a script, were they not text.
HOSTILE = ("</script><script>window.planted = 1</script>", "<img src=x onerror='window.planted = 2'/>]]>&amp;\"'")


def msh(cells, names, points):
    """A Gmsh file of cells (type, region, corners from 0) in regions of these names."""
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names))]
    lines += [f'2 {i + 1} "{name}"' for i, name in enumerate(names)]
    lines += ["$EndPhysicalNames", "$Nodes", str(len(points))]
    lines += [f"{i + 1} {x!r} {y!r} 0" for i, (x, y) in enumerate(points)]
    lines += ["$EndNodes", "$Elements", str(len(cells))]
    lines += [f"{i + 1} {kind} 2 {region + 1} {region + 1} {' '.join(str(v + 1) for v in corners)}"
              for i, (kind, region, corners) in enumerate(cells)]
    return "\n".join([*lines, "$EndElements", ""])


def squares(place=lambda x, y: (x, y)):
    """Quadrilaterals on the left half of a grid, two triangles a square on the right one, each half a region."""
    points = [place(float(x), float(y)) for y in range(COUNT + 1) for x in range(COUNT + 1)]
    cells = []
    for y in range(COUNT):
        for x in range(COUNT):
            a = y * (COUNT + 1) + x
            b, c, d = a + 1, a + COUNT + 2, a + COUNT + 1
            if x < COUNT // 2:
                cells.append((3, 0, (a, b, c, d)))
            else:
                cells += [(2, 1, (a, b, c)), (2, 1, (a, c, d))]
    return cells, points


def shaken(x, y):
    inside = 0 < x < COUNT and 0 < y < COUNT and x != COUNT // 2
    return (x + inside * 0.3 * ((7 * x + 3 * y) % 5 - 2) / 2, y + inside * 0.3 * ((3 * x + 11 * y) % 7 - 3) / 3)


class View(tool.ToolTest):

    @classmethod
    def setUpClass(cls):
        cls.browser = browser.Browser()
        cls.addClassCleanup(cls.browser.close)

    def setUp(self):
        super().setUp()
        cells, points = squares(shaken)
        self.write("in.msh", msh(cells, HOSTILE, points))
        self.points = points
        self.cells = cells

    def state(self):
        return json.loads(self.browser.evaluate("JSON.stringify(document.getElementById('mesh-view').dataset)"))

    def wait_for(self, holds):
        """Until the view's state is as asked."""
        deadline = time.monotonic() + SECONDS
        while not holds(self.state()):
            self.assertLess(time.monotonic(), deadline, self.state())
            time.sleep(0.05)
        return self.state()

    def show(self, report, width=1200, state="live"):
        self.browser.open(self.path(report), width)
        self.wait_for(lambda now: now.get("state") == state)
        self.browser.evaluate("document.querySelector('.view-stage').scrollIntoView({block: 'center'})")
        self.assertEqual(self.browser.complaints(), [])

    def box(self):
        """Where the picture is in the window."""
        return json.loads(self.browser.evaluate(
            "(b => JSON.stringify([b.left, b.top, b.width, b.height]))(document.querySelector('.view-stage').getBoundingClientRect())"))

    def mouse(self, kind, x, y, **more):
        self.browser.ask("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)

    def click(self, x, y):
        for kind in ("mousePressed", "mouseReleased"):
            self.mouse(kind, x, y, button="left", clickCount=1, buttons=1)

    def press(self, key, text=""):
        for kind in ("keyDown", "keyUp"):
            self.browser.ask("Input.dispatchKeyEvent", type=kind, key=key, **({"text": text} if text and kind == "keyDown" else {}))

    def in_window(self, x, y):
        """Where a place of the whole mesh is: the picture shows 0 to COUNT in its middle, whole, not squeezed."""
        left, top, width, height = self.box()
        scale = min(width, height) / COUNT / 1.06
        return left + width / 2 + (x - COUNT / 2) * scale, top + height / 2 - (y - COUNT / 2) * scale

    def colour_at(self, x, y):
        left, top = self.in_window(x, y)
        # (Of the window as it is: browser.screenshot() shows a window as high as the page.)
        shot = self.browser.ask("Page.captureScreenshot", format="png", clip={
            "x": round(left), "y": round(top + self.browser.evaluate("scrollY")), "width": 1, "height": 1, "scale": 1})
        return png.Picture(base64.b64decode(shot["data"])).colour(0, 0)

    def test_a_click_tells_of_the_element_under_it_and_a_row_leads_to_its_element(self):
        self.run_tool("smooth", "in.msh", "out.msh", "--report", "out.html", "--report", "out.json", "--max-sweeps", "0")
        self.show("out.html")
        for x, y in ((2.5, 3.5), (0.5, 0.4), (6.8, 4.3), (8.4, 8.7)):
            # (The shaken places of the input, which are those that no sweep has moved.)
            found = [i for i, (_, _, corners) in enumerate(self.cells) if self.is_inside([self.points[v] for v in corners], x, y)]
            self.click(*self.in_window(x, y))
            if len(found) == 1:
                self.wait_for(lambda now, number=found[0]: now.get("chosen") == str(number))
                text = self.browser.evaluate("document.querySelector('.view-info').textContent")
                kind, region, _ = self.cells[found[0]]
                self.assertIn("quadrilateral" if kind == 3 else "triangle", text)
                self.assertIn(HOSTILE[region], text)
        worst = json.loads(self.read("out.json"))["before"]["worst"][3]
        zoom = json.loads(self.state()["view"])["zoom"]
        self.browser.evaluate("[...document.querySelectorAll('button[data-element]')][3].click()")
        now = self.wait_for(lambda now: now.get("chosen") == str(worst["cell"]) and json.loads(now["view"])["zoom"] > 1.5 * zoom)
        self.assertEqual(json.loads(now["view"])["now"], 0)
        self.assertIsNone(self.browser.evaluate("window.planted ?? null"))
        self.assertEqual([address for address in self.browser.requests() if not address.startswith("data:")],
                         [pathlib.Path(self.path("out.html")).as_uri()])

    @staticmethod
    def is_inside(corners, x, y):
        inside = False
        for (ax, ay), (bx, by) in zip(corners, corners[1:] + corners[:1]):
            if (ay > y) != (by > y) and x < (bx - ax) * (y - ay) / (by - ay) + ax:
                inside = not inside
        return inside

    def test_values_are_those_of_the_program(self):
        metrics = ("shape,area,min_angle,max_angle,aspect_ratio,radius_ratio,edge_ratio,condition,scaled_jacobian,"
                   "equiangle_skew,skew,taper")
        self.run_tool("quality", "in.msh", "--report", "in.html", "--annotate", "in.vtu", "--annotate-metrics", metrics)
        self.show("in.html")
        read = mesh_reader.read(self.path("in.vtu")).cell_arrays
        arrays = {metric: [row[0] for row in read[f"trismooth:{metric}"]] for metric in metrics.split(",")}
        checked = 0
        for metric, values in arrays.items():
            shown = json.loads(self.browser.evaluate(
                f"JSON.stringify([...Array({len(values)}).keys()].map(i => trismooth.valueOf('{metric}', i, 0)))"))
            for i, (value, seen) in enumerate(zip(values, shown)):
                if value == value:
                    self.assertAlmostEqual(seen, value, delta=0.01 * max(abs(value), 1), msg=f"{metric} of {i}")
                    checked += 1
        self.assertGreater(checked, 10 * len(self.cells))

    def test_before_and_after_by_slider_and_key_zoom_by_wheel_and_touch(self):
        # One vertex far to the side of where it belongs: elements that are inverted before, and not after.
        folded = {(6.0, 4.0): (7.6, 4.0)}
        cells, points = squares(lambda x, y: folded.get((x, y), (x, y)))
        self.write("folded.msh", msh(cells, ("left", "right"), points))
        self.run_tool("smooth", "folded.msh", "out.msh", "--report", "out.html")
        self.show("out.html")
        after = self.colour_at(7.3, 4.1)
        self.browser.evaluate("document.querySelector('.view-stage').focus()")
        frames = self.state()["frames"]
        self.press(" ")
        self.wait_for(lambda now: json.loads(now["view"])["now"] == 0 and now["frames"] != frames)
        before = self.colour_at(7.3, 4.1)
        self.assertLess(sum(before), 150)
        self.assertGreater(sum(after), 400)
        self.browser.evaluate("(s => { s.value = 1; s.dispatchEvent(new Event('input')); })(document.querySelector('.view-slider'))")
        self.wait_for(lambda now: json.loads(now["view"])["now"] == 1)
        x, y = self.in_window(2, 7)
        whole = json.loads(self.state()["view"])
        self.mouse("mouseWheel", x, y, deltaX=0, deltaY=-400)
        near = json.loads(self.wait_for(lambda now: json.loads(now["view"])["zoom"] > 1.5 * whole["zoom"])["view"])
        # What was under the pointer stays there.
        self.assertLess(near["x"], whole["x"])
        self.assertGreater(near["y"], whole["y"])
        self.mouse("mousePressed", x, y, button="left", clickCount=1, buttons=1)
        self.mouse("mouseMoved", x + 60, y, button="left", buttons=1)
        self.mouse("mouseReleased", x + 60, y, button="left", clickCount=1)
        self.wait_for(lambda now: abs(json.loads(now["view"])["x"] - (near["x"] - 60 / near["zoom"])) < 2)
        # A page that is hidden and shown again shows what it did.
        for display in ("none", ""):
            self.browser.evaluate(f"document.querySelector('main').style.display = '{display}'")
            time.sleep(0.3)
        self.assertLess(abs(json.loads(self.state()["view"])["x"] - (near["x"] - 60 / near["zoom"])), 2)
        self.browser.evaluate("document.querySelector('.view-stage').scrollIntoView({block: 'center'})")
        self.browser.evaluate("document.querySelector('.view-stage').focus()")
        self.assertAlmostEqual(json.loads(self.state()["view"])["zoom"] / near["zoom"], 1, delta=1e-6)
        self.press("0", "0")
        self.wait_for(lambda now: abs(json.loads(now["view"])["zoom"] / whole["zoom"] - 1) < 1e-6)
        left, top, width, height = self.box()
        touch = [left + width / 2, top + height / 2]
        fingers = lambda apart: [{"x": touch[0] + side * apart, "y": touch[1], "id": side + 1} for side in (-1, 1)]
        self.browser.ask("Emulation.setTouchEmulationEnabled", enabled=True)
        self.browser.ask("Input.dispatchTouchEvent", type="touchStart", touchPoints=fingers(30))
        self.browser.ask("Input.dispatchTouchEvent", type="touchMove", touchPoints=fingers(60))
        self.browser.ask("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
        self.browser.ask("Emulation.setTouchEmulationEnabled", enabled=False)
        self.wait_for(lambda now: 1.7 < json.loads(now["view"])["zoom"] / whole["zoom"] < 2.3)

    def test_colours_by_every_metric_and_switches_change_what_is_seen(self):
        self.run_tool("smooth", "in.msh", "out.msh", "--report", "out.html")
        self.show("out.html")
        choices = json.loads(self.browser.evaluate(
            "JSON.stringify([...document.querySelector('.view-metric').options].map(option => option.value))"))
        self.assertLessEqual({"shape", "min_angle", "skew", "radius_ratio", "region", "moved"}, set(choices))
        seen = set()
        for choice in choices:
            self.browser.evaluate(f"(s => {{ s.value = '{choice}'; s.dispatchEvent(new Event('change')); }})"
                                  "(document.querySelector('.view-metric'))")
            self.wait_for(lambda now, choice=choice: now["metric"] == choice)
            time.sleep(0.2)
            seen.add((self.colour_at(2.5, 2.6), self.colour_at(6.3, 6.2)))
            if choice == "region":
                self.assertNotEqual(self.colour_at(2.5, 2.6), self.colour_at(6.3, 6.2))
        self.assertGreater(len(seen), len(choices) // 2)
        frames = self.state()["frames"]
        self.browser.evaluate("document.querySelector('.view-held').click()")
        self.wait_for(lambda now: now["frames"] != frames)
        red, green, blue = self.colour_at(0, 0)
        self.assertTrue(red > 200 and 120 < green < 200 and blue < 60, (red, green, blue))
        self.assertEqual(self.browser.complaints(), [])

    def test_without_webgl_and_without_script_there_is_a_still_picture(self):
        self.run_tool("quality", "in.msh", "--report", "in.html")
        identifier = self.browser.ask("Page.addScriptToEvaluateOnNewDocument",
                                      source="HTMLCanvasElement.prototype.getContext = () => null")["identifier"]
        self.show("in.html", state="still")
        self.browser.ask("Page.removeScriptToEvaluateOnNewDocument", identifier=identifier)
        self.assertIn("WebGL 2", self.browser.evaluate("document.querySelector('.view-note').textContent"))
        self.check_still()
        self.browser.ask("Emulation.setScriptExecutionDisabled", value=True)
        self.browser.load(pathlib.Path(self.path("in.html")).as_uri())
        self.browser.ask("Emulation.setScriptExecutionDisabled", value=False)
        self.check_still()

    def check_still(self):
        size = json.loads(self.browser.evaluate(
            "(i => JSON.stringify([i.naturalWidth, i.naturalHeight, i.getBoundingClientRect().width]))(document.querySelector('.view-still'))"))
        self.assertGreater(min(size), 300)

    def test_dark_windows_are_dark_and_paper_has_the_still_picture(self):
        self.run_tool("smooth", "in.msh", "out.msh", "--report", "out.html")
        self.browser.ask("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark"}])
        self.show("out.html", width=390)
        self.assertLess(sum(png.Picture(self.browser.screenshot(2, 2, 1, 1)).colour(0, 0)), 150)
        self.assertLessEqual(self.browser.evaluate("document.documentElement.scrollWidth"), 390)
        self.browser.ask("Emulation.setEmulatedMedia", media="print", features=[])
        shown = "getComputedStyle(document.querySelector('.{}')).display"
        self.assertEqual(self.browser.evaluate(shown.format("view-canvas")), "none")
        self.assertEqual(self.browser.evaluate(shown.format("view-still")), "block")
        self.assertGreater(len(self.browser.print()), 20000)
        self.browser.ask("Emulation.setEmulatedMedia", media="", features=[])


if __name__ == "__main__":
    if browser.find() is None:
        print(f"skipped: there is none of {', '.join(browser.NAMES)}")
        sys.exit(77)
    tool.main()
