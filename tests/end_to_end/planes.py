# SPDX-License-Identifier: BSD-3-Clause
"""In which plane a mesh is, as users meet it. Distances are judged in exact arithmetic on the coordinates as they stand in the file."""

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


if __name__ == "__main__":
    tool.main()
