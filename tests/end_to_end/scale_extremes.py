# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of extreme places, sizes and gradings. What came out is judged in exact arithmetic (fractions), on the
coordinates as they stand in the file: never worse than what went in, in double and in single precision."""

import math
import random
from fractions import Fraction

import mesh_reader
import planar_geometry
import tool


def off(points, triangles):
    return (f"OFF\n{len(points)} {len(triangles)} 0\n" + "".join(f"{x!r} {y!r} 0\n" for x, y in points)
            + "".join(f"3 {a} {b} {c}\n" for a, b, c in triangles))


def disturbed_grid(n=9, seed=3):
    """Unit edges, diagonals either way; interior vertices up to 0.35 off their place."""
    noise = random.Random(seed)
    points, triangles = [], []
    for j in range(n):
        for i in range(n):
            inside = 0 < i < n - 1 and 0 < j < n - 1
            points.append((i + inside * noise.uniform(-0.35, 0.35), j + inside * noise.uniform(-0.35, 0.35)))
    for j in range(n - 1):
        for i in range(n - 1):
            a, b, c, d = j * n + i, j * n + i + 1, (j + 1) * n + i + 1, (j + 1) * n + i
            triangles += [(a, b, c), (a, c, d)] if noise.random() < 0.5 else [(a, b, d), (b, c, d)]
    return points, triangles


def graded_disc(grading, sectors=12, growth=1.4, seed=4):
    """Rings around a point off the origin; the elements at the rim are `grading` times as large as those inside."""
    noise = random.Random(seed)
    rings = 1 + math.ceil(math.log(grading) / math.log(growth))
    centre = (1 / 3, 0.2)
    points, triangles = [centre], []
    for ring in range(rings):
        radius = growth ** (ring + 1 - rings)
        for s in range(sectors):
            inside = ring < rings - 1
            angle = 2 * math.pi * (s + inside * noise.uniform(-0.3, 0.3) + 0.5 * (ring % 2)) / sectors
            r = radius * (1 + inside * noise.uniform(-0.1, 0.1))
            points.append((centre[0] + r * math.cos(angle), centre[1] + r * math.sin(angle)))
    at = lambda ring, s: 1 + ring * sectors + s % sectors
    for s in range(sectors):
        triangles.append((0, at(0, s), at(0, s + 1)))
        for ring in range(rings - 1):
            ahead = ring % 2  # rings of odd number are turned by half a sector
            triangles.append((at(ring, s), at(ring + 1, s + ahead), at(ring, s + 1)))
            triangles.append((at(ring, s), at(ring + 1, s - 1 + ahead), at(ring + 1, s + ahead)))
    return points, triangles


class Exact:
    """The shapes of counter-clockwise triangles without rounding: alpha / (2 sqrt(3)) is rational."""

    def __init__(self, points, triangles):
        exact = [(Fraction(x), Fraction(y)) for x, y, *_ in points]
        self.quotients = [self.quotient(*(exact[v] for v in triangle)) for triangle in triangles]
        self.inverted = sum(q < 0 for q in self.quotients)

    @staticmethod
    def quotient(a, b, c):
        sides = [(q[0] - p[0], q[1] - p[1]) for p, q in ((a, b), (b, c), (c, a))]
        lengths = sum(x * x + y * y for x, y in sides)
        return (sides[2][0] * sides[0][1] - sides[2][1] * sides[0][0]) / lengths if lengths else Fraction(0)


class ScaleTest(tool.ToolTest):
    rounding = Fraction(1, 10 ** 13)

    def assert_never_worse(self, points, after, triangles):
        """The contract's check, up to the rounding of the tool's own evaluation. Returns the vertices that moved."""
        self.assertTrue(all(math.isfinite(x) for p in after for x in p))
        moved = {v for v, (p, q) in enumerate(zip(points, after)) if tuple(p[:2]) != tuple(q[:2])}
        was, now = Exact(points, triangles), Exact(after, triangles)
        touched = [t for t, corners in enumerate(triangles) if moved & set(corners)]
        worst = min((was.quotients[t] for t in touched), default=0)
        for t in touched:
            old, new = was.quotients[t], now.quotients[t]
            self.assertFalse(old > 0 >= new, f"triangle {t} was valid")
            self.assertFalse(new < worst - self.rounding and new < old - self.rounding,
                             f"triangle {t}: {float(old)} -> {float(new)}, the worst was {float(worst)}")
        self.assertLessEqual(now.inverted, was.inverted)
        return moved

    def smooth(self, points, triangles, *options):
        """Returns the points that came out, and the outcome."""
        self.write("in.off", off(points, triangles))
        outcome = self.run_tool("smooth", "in.off", "out.off", *options)
        before, after = mesh_reader.read(self.path("in.off")), mesh_reader.read(self.path("out.off"))
        self.assertEqual(before.cells, after.cells)
        moved = self.assert_never_worse(points, after.points, triangles)
        self.assertEqual(moved & planar_geometry.fixed_vertices(before), set())
        return after.points, moved, outcome

    def for_every_way(self, points, triangles, check):
        """Calls check(precision, form, what smooth() returned)."""
        for precision in ("double", "single"):
            for form in ("a", "b"):
                with self.subTest(precision=precision, form=form, extent=points[-1]):
                    check(precision, form, self.smooth(points, triangles, "--precision", precision, "--form", form))

    def assert_smoothed(self, points, triangles, result):
        after, moved, outcome = result
        self.assertGreater(len(moved), 40)
        self.assertNotIn("warning", outcome.err)
        self.assertGreater(min(Exact(after, triangles).quotients), min(Exact(points, triangles).quotients))

    def test_edges_of_a_third_at_forty_million_from_the_origin(self):
        grid, triangles = disturbed_grid()
        points = [(4e7 + 0.3 * x, 5.5e6 + 0.3 * y) for x, y in grid]
        # The same mesh, rounded as it is out there, brought back to the origin without rounding.
        near = [(x - 4e7, y - 5.5e6) for x, y in points]

        def check(precision, form, result):
            self.assert_smoothed(points, triangles, result)
            beside, _, _ = self.smooth(near, triangles, "--precision", precision, "--form", form)
            for p, q in zip(result[0], beside):
                # The last digit out there is 7.5e-9. The tolerance stops each within 1e-6 of an edge, or of float32.
                self.assertAlmostEqual(p[0] - 4e7, q[0], delta=1e-5)
                self.assertAlmostEqual(p[1] - 5.5e6, q[1], delta=1e-5)

        self.for_every_way(points, triangles, check)

    def test_subnormal_coordinates_do_not_get_worse(self):
        grid, triangles = disturbed_grid()
        for size in (1e-310, 1e-321, 5e-324):
            # smooth() judges.
            self.for_every_way([(size * x, size * y) for x, y in grid], triangles, lambda *result: None)

    def test_a_grading_of_a_million_and_more_is_smoothed_in_double_and_not_worse_in_single(self):
        for grading in (1e6, 1e9):
            points, triangles = graded_disc(grading)
            before = min(Exact(points, triangles).quotients)

            def check(precision, form, result):
                after, moved, outcome = result
                if precision == "double":
                    self.assertNotIn("warning", outcome.err)
                    self.assertGreater(len(moved), 0.5 * len(points))
                    self.assertGreater(min(Exact(after, triangles).quotients), before)
                else:
                    self.assertIn("single precision cannot hold this mesh", outcome.err)

            self.for_every_way(points, triangles, check)

    def test_single_precision_says_before_smoothing_that_it_cannot_hold_the_grading(self):
        points, triangles = graded_disc(1e9)
        _, _, outcome = self.smooth(points, triangles, "--precision", "single", "--verbose")
        lines = outcome.err.splitlines()
        warned = [i for i, line in enumerate(lines) if line.startswith(
            "trismooth: warning: single precision cannot hold this mesh; rounded to it, ")]
        first_sweep = next(i for i, line in enumerate(lines) if line.startswith("sweep 1:"))
        self.assertEqual(len(warned), 1, outcome.err)
        self.assertLess(warned[0], first_sweep)
        self.assertIn("; the guard checks the result in double; --precision double", lines[warned[0]])
        report = self.report("smooth", "in.off", "out.off", "--precision", "single")
        self.assertEqual(["trismooth: warning: " + text for text in report["warnings"]], [lines[warned[0]]])

    def test_no_guard_is_promised_where_it_is_off(self):
        points, triangles = graded_disc(1e9)
        _, _, outcome = self.smooth(points, triangles, "--precision", "single", "--guard", "off")
        self.assertIn("single precision cannot hold this mesh", outcome.err)
        self.assertNotIn("guard", outcome.err)


if __name__ == "__main__":
    tool.main()
