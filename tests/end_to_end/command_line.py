# SPDX-License-Identifier: BSD-3-Clause
"""The command line: outputs, and what combinations of options must keep."""

import itertools
import os

import mesh_reader
import planar_geometry
import sample_meshes
import tool

BAD_INPUT = 3


class CommandLineTest(tool.ToolTest):

    def setUp(self):
        super().setUp()
        self.write("plate.off", sample_meshes.off(sample_meshes.Grid()))


class Output(CommandLineTest):

    def test_a_missing_input_is_told(self):
        outcome = self.run_tool("smooth", "missing.off", "out.off", expect=BAD_INPUT)
        self.assertRegex(outcome.err, "^trismooth: error: missing.off: .*No such file")

    def test_quality_changes_nothing_and_writes_nothing(self):
        before = self.read("plate.off")
        outcome = self.run_tool("quality", "plate.off")
        self.assertRegex(outcome.out, "min_angle")
        self.assertEqual(self.read("plate.off"), before)
        self.assertEqual(os.listdir(self.folder), ["plate.off"])

    def test_another_format_gets_the_mesh_and_is_told_what_it_cannot_hold(self):
        self.write("mixed.vtu", sample_meshes.vtu(sample_meshes.Grid(others=True)))
        source = self.report("smooth", "mixed.vtu", "same.vtu")
        expected = mesh_reader.read(self.path("same.vtu"))
        for extension, lost in {"off": ["depth", "region", "load", "line"], "obj": ["depth", "load"], "ply": [],
                                "stl": ["depth", "region", "load", "line", "quad"], "vtk": [], "vtp": []}.items():
            with self.subTest(extension):
                output = f"out.{extension}"
                outcome = self.run_tool("smooth", "mixed.vtu", output, "--verbose")
                for what in lost:
                    self.assertIn(what, outcome.err)
                if extension in ("obj", "ply", "stl"):
                    continue  # no reader of them is here
                written = mesh_reader.read(self.path(output))
                self.assertEqual(planar_geometry.coordinates_hash(written.points), source["coordinates_hash"])
                triangles = [cell for kind, cell in expected.cells if kind == mesh_reader.TRIANGLE]
                place = lambda mesh, cell: tuple(mesh.points[v] for v in cell)
                self.assertEqual([place(written, cell) for kind, cell in written.cells
                                  if kind == mesh_reader.TRIANGLE], [place(expected, cell) for cell in triangles])
                if extension in ("vtk", "vtp"):
                    self.assertEqual(written.point_arrays, expected.point_arrays)
                    self.assertEqual(sorted(written.cell_arrays), sorted(expected.cell_arrays))


class Constraints(CommandLineTest):

    def moved(self, *arguments):
        self.run_tool("smooth", "plate.off", "out.off", *arguments)
        before, after = (mesh_reader.read(self.path(name)).points for name in ("plate.off", "out.off"))
        return {v for v, (p, q) in enumerate(zip(before, after)) if p != q}

    def test_vertices_named_in_a_file_stay(self):
        free = sorted(self.moved())
        self.write("ids.txt", f"{free[0]} {free[3]}\n{free[5]}\n")
        self.assertEqual(self.moved("--fixed-ids", "ids.txt") & {free[0], free[3], free[5]}, set())


class SameResult(CommandLineTest):

    def setUp(self):
        super().setUp()
        self.run_tool("generate", "random.off", "--vertices", "3000", "--seed", "4")

    def test_threads_layouts_and_executions_give_the_same_coordinates(self):
        ways = (("--threads", "2"), ("--threads", "3"), ("--threads", "16"),
                ("--layout", "soa", "--execution", "single-block"), ("--execution", "cdp"), ("--topology", "device"))
        found = set()
        # Each way twice, with one form and precision and with another. (All with all: tests/smoothing, tests/properties.)
        for number, (form, precision) in enumerate(itertools.product("ab", ("double", "single"))):
            hashes = set()
            for more in (("--threads", "1"), *ways[number % 2::2]):
                report = self.report("smooth", "random.off", "out.off", "--form", form, "--precision", precision, *more)
                hashes.add((report["coordinates_hash"], report["uncommitted_hash"]))
            with self.subTest(form=form, precision=precision):
                self.assertEqual(len(hashes), 1)
            found |= hashes
        self.assertEqual(len(found), 4)  # forms and precisions are really different

    def test_stops_are_told_by_their_reason(self):
        for arguments, reason in {("--max-sweeps", "2"): "sweep_limit", ("--tolerance", "0.5"): "tolerance",
                                  ("--tolerance", "0", "--max-sweeps", "0"): "fixed_point",
                                  ("--method", "mean-ratio"): "few_moves",
                                  ("--target-quality", "-1"): "quality_target"}.items():
            with self.subTest(reason):
                report = self.report("smooth", "random.off", "out.off", *arguments)
                self.assertEqual(report["smoothing"]["stop_reason"], reason)
                if reason == "fixed_point":
                    self.assertEqual(report["smoothing"]["history"][-1]["moved"], 0)


if __name__ == "__main__":
    tool.main()
