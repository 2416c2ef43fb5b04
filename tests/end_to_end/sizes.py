# SPDX-License-Identifier: BSD-3-Clause
"""Sizes of the user's own: an array of the file says how long edges, or how large cells, are to be.

How near sizes are to them is worked out here, from the files alone.
"""

import math
import random

import mesh_reader
import tool
POINTS_WIDE = 25


class Sizes(tool.ToolTest):

    def setUp(self):
        super().setUp()
        draw = random.Random(4)
        n = POINTS_WIDE - 1
        inside = lambda i: 0 < i < n
        self.points = [[x + (0.25 * draw.uniform(-1, 1) if inside(x) and inside(y) else 0),
                        y + (0.25 * draw.uniform(-1, 1) if inside(x) and inside(y) else 0), 0.0]
                       for y in range(n + 1) for x in range(n + 1)]
        self.triangles = []
        for y in range(n):
            for x in range(n):
                a = y * (n + 1) + x
                self.triangles += [(a, a + 1, a + n + 2), (a, a + n + 2, a + n + 1)]
        self.lengths = [1 + abs(math.hypot(x - n / 2, y - n / 2) - n / 3) / 6 for x, y, _ in self.points]
        self.areas = [sum(self.lengths[v] for v in t) ** 2 / 9 for t in self.triangles]

    def vtk(self):
        numbers = lambda values: "".join(f"{value!r}\n" for value in values)
        rows = lambda cells: "".join(" ".join(map(str, cell)) + "\n" for cell in cells)
        return ("# vtk DataFile Version 3.0\nsizes\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                f"POINTS {len(self.points)} double\n{rows(self.points)}"
                f"CELLS {len(self.triangles)} {4 * len(self.triangles)}\n{rows((3, *t) for t in self.triangles)}"
                f"CELL_TYPES {len(self.triangles)}\n{rows((5,) for _ in self.triangles)}"
                f"CELL_DATA {len(self.triangles)}\nSCALARS area double 1\nLOOKUP_TABLE default\n{numbers(self.areas)}"
                f"POINT_DATA {len(self.points)}\nSCALARS edge_length double 1\nLOOKUP_TABLE default\n"
                f"{numbers(self.lengths)}SCALARS bad double 1\nLOOKUP_TABLE default\n"
                f"{numbers([1.0] * 7 + [-2.0] * (len(self.points) - 7))}"
                f"VECTORS velocity double\n{rows(self.points)}")

    def off_by(self, name):
        """Root mean square of ln(area / area asked for), by the best factor, but for triangles of the boundary alone."""
        points = mesh_reader.read(self.path(name)).points
        n = POINTS_WIDE - 1
        on_boundary = lambda v: v % (n + 1) in (0, n) or v // (n + 1) in (0, n)
        logs = []
        for t in self.triangles:
            if not all(map(on_boundary, t)):
                (ax, ay, _), (bx, by, _), (cx, cy, _) = (points[v] for v in t)
                asked = 3 / sum(1 / self.lengths[v] ** 2 for v in t)
                logs.append(math.log(((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)) / asked))
        mean = sum(logs) / len(logs)
        return math.sqrt(sum((log - mean) ** 2 for log in logs) / len(logs))

    def test_sizes_get_nearer_to_lengths_at_points_and_areas_of_cells_and_every_report_says_how_far_they_are(self):
        self.write("in.vtk", self.vtk())
        for array in ("edge_length", "Edge Length", "area"):
            with self.subTest(array=array):
                arguments = ("smooth", "in.vtk", "out.vtk", "--method", "mean-ratio", "--size-array", array, "--size-weight", "3")
                report = self.report(*arguments)
                self.assertLess(1.5 * self.off_by("out.vtk"), self.off_by("in.vtk"))
                fit = report["size_fit"]
                self.assertEqual(report["options"]["size_array"], array)
                self.assertEqual(report["size_array"], {
                    "name": "edge_length" if array == "Edge Length" else array,
                    "values": "areas_of_cells" if array == "area" else "lengths_at_points"})
                self.assertEqual(fit["before"]["left_out"], 0)
                self.assertEqual(fit["after"]["elements"], fit["before"]["elements"])
                if array != "area":  # whose vertices have means
                    self.assertAlmostEqual(fit["before"]["rms_log_ratio"], self.off_by("in.vtk"), delta=0.02)
                    self.assertAlmostEqual(fit["after"]["rms_log_ratio"], self.off_by("out.vtk"), delta=0.02)
                line = "off areas '.*' of cells: rms" if array == "area" else "off edge lengths '.*' of points: rms"
                self.assertRegex(self.run_tool(*arguments).out, line)
                self.run_tool(*arguments, "--report", "run.html")
                self.assertIn("Sizes off those asked for", self.read("run.html").decode())

    def test_materials_whose_array_has_the_name_of_the_sizes_at_points_keep_their_interface(self):
        n = POINTS_WIDE - 1
        materials = [1 + (t // 2 % n >= n // 2) for t in range(len(self.triangles))]
        values = "".join(f"{material}\n" for material in materials)
        self.write("in.vtk", self.vtk().replace("SCALARS edge_length", "SCALARS material").replace(
            "\nPOINT_DATA", f"\nSCALARS material int 1\nLOOKUP_TABLE default\n{values}POINT_DATA"))
        report = self.report("smooth", "in.vtk", "out.vtk", "--method", "mean-ratio", "--size-array", "material")
        self.assertEqual(report["size_array"], {"name": "material", "values": "lengths_at_points"})
        self.assertEqual(report["input"]["regions"], 2)
        smoothed = mesh_reader.read(self.path("out.vtk")).points
        interface = range(n // 2, len(self.points), n + 1)
        self.assertEqual([list(smoothed[v]) for v in interface], [self.points[v] for v in interface])
        self.assertNotEqual(list(smoothed[n + 2]), self.points[n + 2])

    def test_regions_whose_array_has_the_sizes_are_said_not_to_be_held(self):
        n = POINTS_WIDE - 1
        values = "".join(f"{1 + (t // 2 % n >= n // 2)}\n" for t in range(len(self.triangles)))
        self.write("in.vtk", self.vtk().replace(
            "\nPOINT_DATA", f"\nSCALARS material int 1\nLOOKUP_TABLE default\n{values}POINT_DATA"))
        arguments = ("smooth", "in.vtk", "out.vtk", "--method", "mean-ratio", "--size-array", "material")
        self.assertIn("the cell array 'material' has sizes (--size-array), so it is not taken for regions: what is between its "
                      "values may move; --region-array material holds it", self.run_tool(*arguments).err)
        said = self.run_tool(*arguments, "--region-array", "material")
        self.assertNotIn("has sizes", said.err)
        self.assertIn("interface", said.out)

    def test_another_method_takes_no_notice_and_says_so(self):
        self.write("in.vtk", self.vtk())
        plain = self.report("smooth", "in.vtk", "out.vtk")
        self.assertEqual((plain["warnings"], plain["size_array"]), ([], None))
        for options in (("--size-array", "edge_length"), ("--size-array", "no such array"), ("--target", "input-shape"),
                        ("--size-weight", "2"), ("--size-array", "edge_length", "--power", "4")):
            with self.subTest(options):
                report = self.report("smooth", "in.vtk", "out.vtk", *options)
                self.assertEqual(report["coordinates_hash"], plain["coordinates_hash"])
                self.assertIsNone(report["size_array"])
                self.assertEqual(report["warnings"], [
                    f"the method smart takes no notice of {', '.join(options[::2])}; --method mean-ratio does"])


if __name__ == "__main__":
    tool.main()
