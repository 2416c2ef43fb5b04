# SPDX-License-Identifier: BSD-3-Clause
"""No interface moves unseen: which cell arrays hold what is between their values, and what the output says of it.

What must stay is worked out here, from the file's triangles and values alone.
"""

import os
import shlex
from urllib.parse import quote

import mesh_reader
import planar_geometry
import sample_meshes
import tool

EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "data")


def ends_between(mesh, values):
    """The vertices of edges whose two triangles differ in `values`, which has one for every cell."""
    numbered = mesh.elements()
    edges = planar_geometry.edges_of([t for _, t in numbered])
    return {v for edge, users in edges.items()
            if len(users) == 2 and values[numbered[users[0]][0]] != values[numbered[users[1]][0]] for v in edge}


class Machine(tool.ToolTest):
    """The example of an electrical machine: ten regions, 672 vertices between them."""

    def setUp(self):
        super().setUp()
        with open(os.path.join(EXAMPLES, "machine.vtu"), "rb") as file:
            self.content = file.read()
        self.write("in.vtu", self.content)
        mesh = mesh_reader.read(self.path("in.vtu"))
        self.interface = ends_between(mesh, mesh.cell_arrays["region"])
        self.assertEqual(len(self.interface), 672)

    def moved(self, *arguments, name="in.vtu"):
        """The vertices that a run on `name` moves, and what it says: (vertices, standard output, standard error)."""
        outcome = self.run_tool("smooth", name, "out.vtu", *arguments)
        before, after = mesh_reader.read(self.path(name)), mesh_reader.read(self.path("out.vtu"))
        vertices = {v for v, (p, q) in enumerate(zip(before.points, after.points)) if p != q}
        return vertices, outcome.out, outcome.err

    def rename(self, name):
        self.assertEqual(self.content.count(b'"region"'), 1)
        self.write("named.vtu", self.content.replace(b'"region"', f'"{name}"'.encode()))

    def test_under_every_known_name_the_interfaces_stay(self):
        moved, out, _ = self.moved()
        self.assertEqual(moved & self.interface, set())
        self.assertRegex(out, "672 interface.*'region'")
        expected = self.report("smooth", "in.vtu", "out.vtu")["coordinates_hash"]
        for name in ("attribute", "Material ID", "GeometryIds", "gmsh:physical", "vtkCompositeIndex"):
            with self.subTest(name):
                self.rename(name)
                report = self.report("smooth", "named.vtu", "out.vtu")
                self.assertEqual(report["coordinates_hash"], expected)
                self.assertEqual(report["input"]["region_arrays"],
                                 [{"name": name, "reason": "known_name", "values": 10, "held_vertices": 672}])

    def test_under_an_unknown_name_they_stay_and_the_output_says_how_to_free_them(self):
        for name in ("foo", "my parts", "Gebiet"):
            with self.subTest(name):
                self.rename(name)
                moved, out, err = self.moved(name="named.vtu")
                self.assertEqual(moved & self.interface, set())
                self.assertRegex(out, f"672 interface.*'{name}'")
                line, = [line for line in err.splitlines() if name in line]
                for words in ("looks like regions", "672", f"--region-array {shlex.quote(name)}", "--region-array none"):
                    self.assertIn(words, line)
        moved, out, err = self.moved("--region-array", "none", name="named.vtu")
        self.assertGreater(len(moved & self.interface), 500)
        self.assertNotIn("Gebiet", out + err)
        moved, out, err = self.moved("--region-array", "gebiet", name="named.vtu")
        self.assertEqual(moved & self.interface, set())
        self.assertNotIn("note", err)


class Texts(tool.ToolTest):

    def test_texts_of_cells_in_files_name_regions_and_stay(self):
        grid = sample_meshes.Grid()
        expected = self.report("smooth", self.write("numbers.vtk", sample_meshes.legacy_vtk(grid)), "out.vtk")
        words = [("air, or \u00e9ther", "copper wire")[region - 1] for region in grid.regions]
        grid.regions = [1] * len(words)
        legacy = f"FIELD own 1\nwhat 1 {len(words)} string\n" + "".join(f"{quote(word)}\n" for word in words)
        numbers = " ".join(str((byte + 128) % 256 - 128) for word in words for byte in (*word.encode(), 0))  # as VTK
        xml = f'<DataArray type="String" Name="what" format="ascii">{numbers}</DataArray></CellData>'
        for name, content in {
                "in.vtk": sample_meshes.legacy_vtk(grid).replace(b"POINT_DATA", legacy.encode() + b"POINT_DATA"),
                "in.vtu": sample_meshes.vtu(grid).replace(b"</CellData>", xml.encode())}.items():
            for arguments in ((), ("--region-array", "what")):
                with self.subTest(name, arguments=arguments):
                    self.write(name, content)
                    report = self.report("smooth", name, "out" + name[2:], *arguments)
                    self.assertEqual([region["region"] for region in report["before"]["regions"]], sorted({*words}))
                    self.assertEqual(report["coordinates_hash"], expected["coordinates_hash"])
                    written = " ".join(self.read("out" + name[2:]).decode().split())
                    self.assertIn(" ".join(legacy.split()) if name == "in.vtk" else numbers, written)


if __name__ == "__main__":
    tool.main()
