"""A smoothed file is its input with the coordinates of moved vertices in other digits, and no mesh gets worse.

All is judged by the readers and the geometry beside this file, none of which the program uses. The folder that the
environment variable TRISMOOTH_EXTRA_MESHES names is tested as well.
"""

import gzip
import os
import types

import compare
import fem_samples
import mesh_reader
import planar_geometry
import sample_meshes
import tool

EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "data")
EXTENSIONS = (".off", ".obj", ".ply", ".stl", ".vtk", ".vtu", ".vtp")


def mesh_files(folder):
    return sorted(os.path.join(folder, name) for name in os.listdir(folder) if name.lower().endswith(EXTENSIONS))


class SmoothedFile(tool.ToolTest):
    """What holds for every file."""

    def smooth(self, path, read=mesh_reader.read):
        """Smooths a file; checks all that is true of any; returns what more can be asked about."""
        output = self.path("smoothed" + os.path.splitext(path)[1])
        report = self.report("smooth", path, output)
        self.assert_no_temporary_files()
        before, after = read(path), read(output)
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
        triangles = [t for _, t in before.triangles()]
        points = planar_geometry.flat(before.points)
        orientation = planar_geometry.Orientation(triangles, points)
        old = orientation.shapes(points)
        new = orientation.shapes(planar_geometry.flat(after.points))
        inverted = [sum(shape < 0 for shape in shapes) for shapes in (old, new)]
        self.assertLessEqual(inverted[1], inverted[0], "inverted triangles")
        rounding = 1e-12
        self.assertGreaterEqual(min(new), min(old) - rounding, "smallest shape")
        for stage, count, shapes in (("before", inverted[0], old), ("after", inverted[1], new)):
            self.assertEqual(report[stage]["inverted"], count)
            self.assertEqual(report[stage]["triangles"], len(triangles))
            self.assertAlmostEqual(report[stage]["metrics"]["shape"]["min"], min(shapes), delta=1e-9)
            self.assertAlmostEqual(report[stage]["metrics"]["shape"]["mean"], sum(shapes) / len(shapes), delta=1e-9)
        self.assertEqual(report["input"]["reoriented_triangles"], orientation.reoriented)
        self.assertEqual(report["input"]["components"], orientation.components)


class EveryFormat(SmoothedFile):

    def test_changes_nothing_but_the_coordinates_of_moved_vertices(self):
        for name, content in sample_meshes.every_sample().items():
            with self.subTest(name):
                result = self.smooth(self.write(name, content))
                self.assertGreater(len(result.moved), 10)

    def test_a_second_run_over_the_result_has_the_same_layout(self):
        for name, content in sample_meshes.every_sample().items():
            with self.subTest(name):
                self.write(name, content)
                self.run_tool("smooth", name, "once" + os.path.splitext(name)[1], "--max-sweeps", 1)
                self.smooth(self.path("once" + os.path.splitext(name)[1]))

    def test_nothing_moved_gives_the_same_bytes(self):
        # The XML formats are written by a library, which may space its tags in its own way.
        samples = {name: content for name, content in sample_meshes.every_sample().items()
                   if not name.endswith((".vtu", ".vtp"))}
        for name, content in samples.items():
            with self.subTest(name):
                path = self.write(name, content)
                count = len(mesh_reader.read(path).points)
                self.write("all.txt", "\n".join(map(str, range(count))))
                output = "same" + os.path.splitext(name)[1]
                self.run_tool("smooth", name, output, "--fixed-ids", "all.txt")
                self.assertEqual(self.read(output), content)

    def test_formats_of_one_mesh_give_the_same_coordinates(self):
        hashes = {}
        for name, content in sample_meshes.every_sample().items():
            # In the others regions or quads hold some vertices, or points are numbered or rounded in another way.
            if name.endswith(".off") and name != "quads.off":
                self.write(name, content)
                hashes[name] = self.report("smooth", name, "out" + os.path.splitext(name)[1])["coordinates_hash"]
        self.assertEqual(len(set(hashes.values())), 1, hashes)


class FormatsWithGroups(SmoothedFile):
    """Files that are read by the pattern that they were made from: all but coordinates is known to be the same."""

    def reader_of(self, sample):
        def read(path):
            with open(path, "rb") as file:
                return sample.read(file.read())
        return read

    def test_change_nothing_but_the_coordinates_of_moved_vertices(self):
        for name, sample in fem_samples.every_sample().items():
            with self.subTest(name):
                path = self.write("plate" + sample.extension, sample.content())
                self.assertGreater(len(self.smooth(path, self.reader_of(sample)).moved), 10)

    def test_compressed_ones_are_the_same_inside(self):
        for name, sample in fem_samples.every_sample().items():
            with self.subTest(name):
                self.write("plate" + sample.extension, sample.content())
                self.run_tool("smooth", "plate" + sample.extension, "plain" + sample.extension)
                self.write("plate" + sample.extension + ".gz", gzip.compress(sample.content()))
                self.run_tool("smooth", "plate" + sample.extension + ".gz", "packed" + sample.extension + ".gz")
                self.assertEqual(gzip.decompress(self.read("packed" + sample.extension + ".gz")),
                                 self.read("plain" + sample.extension))

    def test_nothing_moved_gives_the_same_bytes(self):
        self.write("all.txt", "\n".join(map(str, range(81))))
        for name, sample in fem_samples.every_sample().items():
            with self.subTest(name):
                path = self.write("plate" + sample.extension, sample.content())
                self.run_tool("smooth", path, "same" + sample.extension, "--fixed-ids", "all.txt")
                self.assertEqual(self.read("same" + sample.extension), sample.content())

    def test_the_two_files_of_triangle(self):
        sample, elements = fem_samples.triangle()
        path = self.write("plate.node", sample.content())
        self.write("plate.ele", elements)
        self.assertGreater(len(self.smooth(path, self.reader_of(sample)).moved), 10)
        self.assertEqual(self.read("smoothed.ele"), elements)


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


class OrientationAndConstraints(SmoothedFile):

    def test_regions_listed_in_opposite_orientation_hold_no_inverted_triangle(self):
        grid = sample_meshes.Grid()
        grid.cells = [(kind, cell[::-1] if region == 2 and i % 8 else cell)
                      for i, ((kind, cell), region) in enumerate(zip(grid.cells, grid.regions))]
        turned = sum(region == 2 and i % 8 != 0 for i, region in enumerate(grid.regions))
        result = self.smooth(self.write("mixed.vtk", sample_meshes.legacy_vtk(grid)))
        self.assertEqual(result.report["before"]["inverted"], 0)
        self.assertEqual(result.report["input"]["reoriented_triangles"], turned)

    def test_vertices_between_two_regions_stay(self):
        result = self.smooth(self.write("two.vtk", sample_meshes.legacy_vtk(sample_meshes.Grid())))
        self.assertEqual(result.report["input"]["regions"], 2)
        self.assertEqual(len(planar_geometry.interface_vertices(result.before)), 9)
        # The same mesh without its regions moves them.
        free = self.smooth(self.write("one.off", sample_meshes.off(sample_meshes.Grid())))
        self.assertGreater(len(free.moved & planar_geometry.interface_vertices(result.before)), 3)

    def test_quads_are_kept_and_their_vertices_stay(self):
        result = self.smooth(self.write("quads.vtk", sample_meshes.legacy_vtk(sample_meshes.Grid(others=True))))
        others = planar_geometry.other_cell_vertices(result.before)
        self.assertEqual(len(others), 18 + 2)  # two columns of the grid and a line
        self.assertEqual(result.moved & others, set())
        self.assertEqual(result.report["input"]["other_cells"], 9)

    def test_a_tangled_mesh_does_not_get_more_inverted_triangles(self):
        grid = sample_meshes.Grid(12, seed=3)
        inside = [v for v, (x, y, _) in enumerate(grid.points) if 0 < x < 12 and 0 < y < 12]
        for v in inside[::4]:
            x, y, z = grid.points[v]
            grid.points[v] = (x + 0.9, y - 0.8, z)
        result = self.smooth(self.write("tangled.off", sample_meshes.off(grid)))
        self.assertGreater(result.report["before"]["inverted"], 20)
        self.assertLess(result.report["after"]["inverted"], result.report["before"]["inverted"])


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
