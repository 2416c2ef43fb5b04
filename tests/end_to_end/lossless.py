# SPDX-License-Identifier: BSD-3-Clause
"""A smoothed file is its input with the coordinates of moved vertices in other digits, and no mesh gets worse.

Examples: that all formats and dialects are written so is in tests/mesh_io and tests/bad_input. All is judged by the readers and the geometry beside this file, none of which the program uses. The folder that the
environment variable TRISMOOTH_EXTRA_MESHES names is tested as well.
"""

import os
import types

import compare
import mesh_reader
import planar_geometry
import sample_meshes
import tool

EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "data")
EXTENSIONS = (".off", ".vtk", ".vtu", ".vtp")


def mesh_files(folder):
    return sorted(os.path.join(folder, name) for name in os.listdir(folder) if name.lower().endswith(EXTENSIONS))


class SmoothedFile(tool.ToolTest):
    """What holds for every file."""

    def smooth(self, path):
        """Smooths a file; checks all that is true of any; returns what more can be asked about."""
        output = self.path("smoothed" + os.path.splitext(path)[1])
        report = self.report("smooth", path, output)
        self.assert_no_temporary_files()
        before, after = mesh_reader.read(path), mesh_reader.read(output)
        moved = {v for v, (p, q) in enumerate(zip(before.points, after.points)) if p != q}
        self.assertEqual(len(after.points), len(before.points))
        self.assertEqual(after.cells, before.cells)
        compare.assert_same_but_coordinates(self, path, output, before, after, moved)
        self.assert_fixed_vertices_stay(before, moved, report)
        self.assert_quality(before, after, report)
        self.assertEqual(planar_geometry.coordinates_hash(after.points), report["coordinates_hash"])
        self.assertEqual(len(moved), report["smoothing"]["moved_vertices"])
        return types.SimpleNamespace(before=before, after=after, moved=moved, report=report)

    def assert_fixed_vertices_stay(self, before, moved, report):
        fixed = planar_geometry.fixed_vertices(before)
        self.assertEqual(sorted(moved & fixed), [])
        self.assertEqual(report["input"]["fixed_vertices"], len(fixed))
        self.assertEqual(report["input"]["free_vertices"], len(before.points) - len(fixed))

    def assert_quality(self, before, after, report):
        elements = [corners for _, corners in before.elements()]
        points = planar_geometry.flat(before.points)
        orientation = planar_geometry.Orientation(elements, points)
        old = orientation.shapes(points)
        new = orientation.shapes(planar_geometry.flat(after.points))
        inverted = [sum(shape < 0 for shape in shapes) for shapes in (old, new)]
        self.assertLessEqual(inverted[1], inverted[0], "inverted elements")
        rounding = 1e-12
        self.assertGreaterEqual(min(new), min(old) - rounding, "smallest shape")
        for stage, count, shapes in (("before", inverted[0], old), ("after", inverted[1], new)):
            self.assertEqual(report[stage]["inverted"], count)
            self.assertEqual(report[stage]["triangles"], sum(len(corners) == 3 for corners in elements))
            self.assertEqual(report[stage]["quadrilaterals"], sum(len(corners) == 4 for corners in elements))
            self.assertAlmostEqual(report[stage]["metrics"]["shape"]["min"], min(shapes), delta=1e-9)
            self.assertAlmostEqual(report[stage]["metrics"]["shape"]["mean"], sum(shapes) / len(shapes), delta=1e-9)
        self.assertEqual(report["input"]["reoriented_triangles"], orientation.reoriented)
        self.assertEqual(report["input"]["components"], orientation.components)


class Samples(SmoothedFile):

    def test_changes_nothing_but_the_coordinates_of_moved_vertices(self):
        mixed = sample_meshes.Grid(others=True)
        fields = lambda i: f" 0 0 1 {i % 256} {i * 7 % 256} 9 255 0.5 0.125"
        for name, content in {
                "fields.off": sample_meshes.off(sample_meshes.Grid(), "STCNOFF", fields, newline="\r\n", comment=True),
                "grid.vtk": sample_meshes.legacy_vtk(mixed, False, "2.0"),
                "poly.vtk": sample_meshes.legacy_vtk(mixed, True, "5.1", True, "float"),
                "inline.vtu": sample_meshes.vtu(mixed, "binary", compressed=True, word="UInt64"),
                "appended.vtp": sample_meshes.vtp(mixed, "appended base64", order=">")}.items():
            with self.subTest(name):
                result = self.smooth(self.write(name, content))
                self.assertGreater(len(result.moved), 10)


class ExampleMeshes(SmoothedFile):

    def test_come_back_better_and_complete(self):
        files = mesh_files(EXAMPLES)
        self.assertGreaterEqual(len(files), 4)
        for path in files:
            with self.subTest(os.path.basename(path)):
                result = self.smooth(path)
                shapes = [result.report[stage]["metrics"]["shape"] for stage in ("before", "after")]
                self.assertGreater(shapes[1]["min"], shapes[0]["min"])
                self.assertGreater(shapes[1]["mean"], shapes[0]["mean"])


class ExtraMeshes(SmoothedFile):

    def test_come_back_complete_and_no_worse(self):
        folder = os.environ.get("TRISMOOTH_EXTRA_MESHES")
        if not folder:
            self.skipTest("TRISMOOTH_EXTRA_MESHES names no folder of meshes")
        for path in mesh_files(folder):
            with self.subTest(os.path.basename(path)):
                report = self.smooth(path).report
                shape = lambda stage: report[stage]["metrics"]["shape"]["min"]
                print(f"\n{os.path.basename(path)}: reoriented {report['input']['reoriented_triangles']}, "
                      f"other cells {report['input']['other_cells']}, inverted {report['before']['inverted']} -> "
                      f"{report['after']['inverted']}, smallest shape {shape('before'):.5f} -> {shape('after'):.5f}",
                      end="")


if __name__ == "__main__":
    tool.main()
