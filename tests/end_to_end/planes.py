"""In which plane a mesh is, as users meet it: meshes inclined much or little, narrow strips, vertices that no cell uses,
curved surfaces. Distances are judged in exact arithmetic on the coordinates as they stand in the file."""

import random
from fractions import Fraction

import mesh_reader
import tool


def off(points, triangles):
    return (f"OFF\n{len(points)} {len(triangles)} 0\n" + "".join(f"{x!r} {y!r} {z!r}\n" for x, y, z in points)
            + "".join(f"3 {a} {b} {c}\n" for a, b, c in triangles))


def grid(n=6, seed=3):
    """Unit edges; interior vertices up to 0.4 off their place."""
    noise = random.Random(seed)
    points, triangles = [], []
    for j in range(n):
        for i in range(n):
            inside = 0 < i < n - 1 and 0 < j < n - 1
            points.append((i + inside * noise.uniform(-0.4, 0.4), j + inside * noise.uniform(-0.4, 0.4)))
    for j in range(n - 1):
        for i in range(n - 1):
            a = j * n + i
            triangles += [(a, a + 1, a + n + 1), (a, a + n + 1, a + n)]
    return points, triangles


def inclined(points, slope=1):
    """Exactly in the plane z = slope * y, for a slope that is a power of two."""
    return [(x, y, slope * y) for x, y in points]


class Planes(tool.ToolTest):

    def smoothed(self, points, triangles, *options):
        """The points after smoothing."""
        self.write("in.off", off(points, triangles))
        self.run_tool("smooth", "in.off", "out.off", "--quiet", *options)
        return mesh_reader.read_off(self.read("out.off")).points

    def assert_in_plane(self, before, after, slope, rounding):
        moved = 0
        for old, new in zip(before, after):
            moved += tuple(old) != tuple(new)
            distance = abs(Fraction(new[2]) - Fraction(slope) * Fraction(new[1]))
            self.assertLessEqual(distance, rounding)
        self.assertGreater(moved, 10)

    def test_a_plane_inclined_by_little_is_kept_as_one_inclined_by_much(self):
        flat, triangles = grid()
        for power in (0, -10, -21, -30, -40):
            points = inclined(flat, 2.0 ** power)
            self.assert_in_plane(points, self.smoothed(points, triangles), 2.0 ** power, 1e-14)

    def test_far_from_the_origin_what_was_written_is_accepted_again(self):
        """There the rounding of coordinates alone takes vertices farther out of the plane than 1e-6 of its size."""
        flat, triangles = grid(9)
        for offset in (2.0 ** 30, 2.0 ** 35, 2.0 ** 40):
            # In the plane z = y + offset / 2 - x / 2, after rounding to the numbers that there are.
            points = [(x + offset, y, y + offset / 2 - (x + offset) / 2) for x, y in flat]
            with self.subTest(offset):
                self.smoothed(points, triangles)
                self.run_tool("smooth", "out.off", "again.off", "--quiet")

    def test_a_strip_a_million_times_longer_than_wide_stays_in_its_plane(self):
        flat, triangles = grid()
        n = 6
        points = inclined(flat) + [(1.2e7, 2.5, 2.5)]
        triangles += [(j * n + n - 1, n * n, j * n + 2 * n - 1) for j in range(n - 1)]
        self.assert_in_plane(points, self.smoothed(points, triangles), 1, 1e-9)

    def test_vertices_of_no_cell_change_nothing(self):
        flat, triangles = grid()
        for slope in (0, 1):
            points = inclined(flat, slope)
            expected = self.judged(points, triangles)
            for far in (1e7, 4e161, 2e162, 1.7e308):
                unused = [(far, 0.3 * far, 0.0), (-far, 5.0, far)]
                after, *reported = self.judged(points + unused, triangles)
                self.assertEqual(after, expected[0] + unused)
                self.assertEqual(tuple(reported), expected[1:])

    def judged(self, points, triangles):
        """The points after smoothing, and what is reported of it and of single precision, which warns of what it cannot
        hold."""
        after = self.smoothed(points, triangles)
        report = self.report("smooth", "in.off", "single.off", "--precision", "single")
        return after, report["before"], report["after"], report["warnings"]

    def test_a_curved_surface_is_refused_whatever_is_far_away(self):
        flat, triangles = grid(8)
        dome = [(x, y, 0.05 * x * (7 - x) * y * (7 - y) / 12) for x, y in flat]
        far_unused = dome + [(3e6, 0.0, 0.0)]
        far_used = dome + [(3e6, 3.5, 0.0)]
        fan = [(8 * j + 7, 64, 8 * j + 15) for j in range(7)]
        for points, more in ((dome, []), (far_unused, []), (far_used, fan)):
            self.write("dome.off", off(points, triangles + more))
            outcome = self.run_tool("smooth", "dome.off", "out.off", expect=3)
            self.assertRegex(outcome.err, r"dome\.off: the mesh is not planar: vertex \d+ is ")

    def test_a_vertex_far_outside_comes_home_into_the_plane_of_the_boundary(self):
        flat, triangles = grid(4)
        points = inclined(flat, 0)
        points[5] = (1114.0, 0.0, 0.1)
        once = self.smoothed(points, triangles)
        self.assertNotEqual(once[5], points[5])
        self.assertEqual({z for _, _, z in once}, {0.0})
        self.smoothed(once, triangles)


if __name__ == "__main__":
    tool.main()
