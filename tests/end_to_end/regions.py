"""No interface moves unseen: which cell arrays hold what is between their values, and what the output says of it.

What must stay is worked out here, from the file's triangles and values alone.
"""

import os
import random
import re
import shlex

import mesh_reader
import planar_geometry
import sample_meshes
import tool

EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "data")
# What programs call regions, in several spellings of each.
NAMES = ("attribute", "Attribute", "MATERIAL", "Material ID", "mat_id", "MaterialIds", "cell_tags", "Cell Tags", "f",
         "GeometryIds", "subdomain_id", "SubdomainID", "gmsh:physical", "gmsh:geometrical", "medit:ref", "object_id",
         "ElementBlockIds", "FamilyIdCell", "Label", "Domain index", "RegionId", "vtkCompositeIndex", "Zone")
BOOKKEEPING = ("partition", "gmsh:partition", "mpi_rank", "vtkProcessId", "processor_id", "pid", "vtkGhostType")
WRONG_USAGE = 2


def ends_between(mesh, values):
    """The vertices of edges whose two triangles differ in `values`, which has one for every cell."""
    numbered = mesh.triangles()
    edges = planar_geometry.edges_of([t for _, t in numbered])
    return {v for edge, users in edges.items()
            if len(users) == 2 and values[numbered[users[0]][0]] != values[numbered[users[1]][0]] for v in edge}


def vtu(grid, arrays):
    """A VTU of the grid's triangles with these cell arrays: [(name, VTK's type, values)]."""
    def data(name, kind, values):
        text = " ".join(map(str, values)) if kind != "String" else " ".join(
            str(byte) for value in values for byte in [*value.encode(), 0])
        return f'<DataArray type="{kind}" Name="{name}" format="ascii">{text}</DataArray>\n'
    points = " ".join(str(x) for point in grid.points for x in point)
    return (f'<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian"><UnstructuredGrid>'
            f'<Piece NumberOfPoints="{len(grid.points)}" NumberOfCells="{len(grid.cells)}">'
            f'<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">{points}</DataArray></Points>'
            "<Cells>" + data("connectivity", "Int32", [v for _, cell in grid.cells for v in cell]) +
            data("offsets", "Int32", [3 * (i + 1) for i in range(len(grid.cells))]) +
            data("types", "UInt8", [5] * len(grid.cells)) +
            "</Cells><CellData>" + "".join(data(*array) for array in arrays) +
            "</CellData></Piece></UnstructuredGrid></VTKFile>")


class RegionTest(tool.ToolTest):

    def setUp(self):
        super().setUp()
        self.grid = sample_meshes.Grid(12)
        triangles = [cell for _, cell in self.grid.cells]
        self.left_right = [int(min(v % 13 for v in cell) >= 6) for cell in triangles]
        self.bands = [min(v // 13 for v in cell) // 4 for cell in triangles]

    def moved(self, *arguments, name="in.vtu"):
        """The vertices that a run on `name` moves, and what it says: (vertices, standard output, standard error)."""
        outcome = self.run_tool("smooth", name, "out.vtu", *arguments)
        before, after = mesh_reader.read(self.path(name)), mesh_reader.read(self.path("out.vtu"))
        vertices = {v for v, (p, q) in enumerate(zip(before.points, after.points)) if p != q}
        return vertices, outcome.out, outcome.err

    def write_grid(self, *arrays):
        self.write("in.vtu", vtu(self.grid, arrays))
        return mesh_reader.read(self.path("in.vtu")) if all(kind != "String" for _, kind, _ in arrays) else None


class Machine(RegionTest):
    """The example of an electrical machine: ten regions, 672 vertices between them."""

    def setUp(self):
        super().setUp()
        with open(os.path.join(EXAMPLES, "machine.vtu"), "rb") as file:
            self.content = file.read()
        self.write("in.vtu", self.content)
        mesh = mesh_reader.read(self.path("in.vtu"))
        self.interface = ends_between(mesh, mesh.cell_arrays["region"])
        self.assertEqual(len(self.interface), 672)

    def rename(self, name):
        self.assertEqual(self.content.count(b'"region"'), 1)
        self.write("named.vtu", self.content.replace(b'"region"', f'"{name}"'.encode()))

    def test_under_every_known_name_the_interfaces_stay(self):
        moved, out, _ = self.moved()
        self.assertEqual(moved & self.interface, set())
        self.assertRegex(out, "672 interface.*'region'")
        expected = self.report("smooth", "in.vtu", "out.vtu")["coordinates_hash"]
        for name in NAMES:
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

    def test_parts_of_a_parallel_run_hold_nothing_and_a_note_says_so(self):
        for name in BOOKKEEPING:
            with self.subTest(name):
                self.rename(name)
                outcome = self.run_tool("quality", "named.vtu", "--report", "r.json")
                self.assertNotIn("interface", outcome.out)
                self.assertIn(f"--region-array {name}", outcome.err)

    def test_a_constant_array_hides_none(self):
        for other in ("gmsh:physical", "anything"):
            with self.subTest(other):
                mesh = mesh_reader.read(self.path("in.vtu"))
                count = len(mesh.cells)
                constant = f'<DataArray type="Int32" Name="region" format="ascii">{"1 " * count}</DataArray>'
                self.rename(other)
                with open(self.path("named.vtu"), "rb") as file:
                    content = file.read()
                self.write("both.vtu", re.sub(rb"(<CellData[^>]*>)", lambda m: m[1] + constant.encode(), content))
                moved, out, _ = self.moved(name="both.vtu")
                self.assertEqual(moved & self.interface, set())
                self.assertIn(f"'{other}'", out)


class Arrays(RegionTest):

    def test_two_arrays_hold_what_is_between_the_values_of_either(self):
        mesh = self.write_grid(("region", "Int32", self.left_right), ("Physical", "Int64", self.bands))
        moved, out, _ = self.moved()
        held = ends_between(mesh, self.left_right) | ends_between(mesh, self.bands)
        self.assertEqual(moved & held, set())
        self.assertIn("('region', 'Physical')", out)
        moved, _, _ = self.moved("--region-array", "region")
        self.assertEqual(moved & ends_between(mesh, self.left_right), set())
        self.assertGreater(len(moved & ends_between(mesh, self.bands)), 0)
        moved, _, _ = self.moved("--region-array", "physical", "--region-array", "region")
        self.assertEqual(moved & held, set())
        report = self.report("quality", "in.vtu")
        self.assertEqual([(array["name"], array["held_vertices"]) for array in report["input"]["region_arrays"]],
                         [("region", len(ends_between(mesh, self.left_right))),
                          ("Physical", len(ends_between(mesh, self.bands)))])
        self.assertEqual(report["input"]["regions"], 6)
        self.assertEqual(report["input"]["region_array"], "region, Physical")

    def test_floats_and_texts_name_regions_as_well(self):
        names = [("steel", "air, or \u00e9ther")[value] for value in self.left_right]
        for array in (("attribute", "Float32", [float(value) for value in self.left_right]),
                      ("anything", "Float64", [float(value) for value in self.left_right]),
                      ("material", "String", names), ("anything", "String", names)):
            with self.subTest(array[:2]):
                numbers = self.write_grid(("region", "Int32", self.left_right))
                self.write_grid(array)
                outcome = self.run_tool("smooth", "in.vtu", "out.vtu", "--report", "r.json")
                self.assertRegex(outcome.out, f"13 interface.*'{array[0]}'")
                if array[1] != "String":
                    after = mesh_reader.read(self.path("out.vtu"))
                    for v in ends_between(numbers, self.left_right):
                        self.assertEqual(after.points[v], numbers.points[v])

    def test_texts_are_taken_where_they_are_asked_for_and_name_the_regions(self):
        grid = self.grid
        head = ("# vtk DataFile Version 3.0\n\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                f"POINTS {len(grid.points)} double\n" + "\n".join(f"{x} {y} {z}" for x, y, z in grid.points) +
                f"\nCELLS {len(grid.cells)} {4 * len(grid.cells)}\n" +
                "\n".join("3 {} {} {}".format(*cell) for _, cell in grid.cells) +
                f"\nCELL_TYPES {len(grid.cells)}\n" + "5\n" * len(grid.cells) +
                f"CELL_DATA {len(grid.cells)}\nFIELD FieldData 1\nwhat 1 {len(grid.cells)} string\n")
        self.write("in.vtk", head + "".join(("copper%20wire\n", "iron\n")[value] for value in self.left_right))
        for arguments in ((), ("--region-array", "what")):
            report = self.report("smooth", "in.vtk", "out.vtk", *arguments)
            self.assertEqual([region["region"] for region in report["before"]["regions"]], ["copper wire", "iron"])
            before, after = (mesh_reader.LegacyVtk(self.read(name).split(b"CELL_DATA")[0]).mesh
                             for name in ("in.vtk", "out.vtk"))
            held = ends_between(before, self.left_right)
            self.assertEqual(len(held), 13)
            self.assertEqual([v for v in held if before.points[v] != after.points[v]], [])
            self.assertEqual(self.read("in.vtk").split(b"CELL_DATA")[1], self.read("out.vtk").split(b"CELL_DATA")[1])

    def test_ids_and_noise_hold_nothing(self):
        chance = random.Random(3)  # the same every time
        count = len(self.grid.cells)
        self.write_grid()
        free, _, _ = self.moved()
        for values in ([*range(count)], [chance.randrange(5) for _ in range(count)], chance.sample(range(count), count)):
            for name in ("GlobalIds", "noise", "region"):
                self.write_grid((name, "Int32", values))
                moved, out, err = self.moved()
                self.assertEqual(moved, free)
                self.assertNotIn("interface", out)
                self.assertEqual("--region-array region" in err, name == "region")

    def test_many_small_groups_under_an_unknown_name_are_never_passed_over_in_silence(self):
        for width in (2, 3, 4):
            values = [v % 13 // width + 100 * (v // 13 // (5 - width)) for v in (min(cell) for _, cell in self.grid.cells)]
            mesh = self.write_grid(("grains of it", "Int32", values))
            with self.subTest(groups=len(set(values))):
                moved, out, err = self.moved()
                if moved & ends_between(mesh, values):
                    self.assertIn("grains of it", err)
                    self.assertIn("--region-array 'grains of it'", err)

    def test_all_arrays_of_a_name_count_where_it_is_given(self):
        self.write_grid(("part", "Int32", self.left_right), ("part", "Int32", self.bands))
        mesh = mesh_reader.read(self.path("in.vtu"))
        moved, _, _ = self.moved("--region-array", "part")
        for values in (self.left_right, self.bands):
            self.assertEqual(moved & ends_between(mesh, values), set())

    def test_a_region_array_that_is_not_there_is_refused_and_those_that_are_there_named(self):
        self.write_grid(("region", "Int32", self.left_right), ("names", "String", ["a"] * len(self.grid.cells)))
        outcome = self.run_tool("quality", "in.vtu", "--region-array", "mine", expect=WRONG_USAGE)
        self.assertRegex(outcome.err, "'mine'.*it has: region, names")
        outcome = self.run_tool("quality", "in.vtu", "--region-array", "none", "--region-array", "region",
                                expect=WRONG_USAGE)
        self.assertIn("none", outcome.err)

    def test_the_quality_of_each_region_is_that_of_its_triangles(self):
        mesh = self.write_grid(("region", "Int32", [7 + 5 * value for value in self.left_right]))
        report = self.report("smooth", "in.vtu", "out.vtu")
        after = mesh_reader.read(self.path("out.vtu"))
        for key, points in (("before", mesh.points), ("after", after.points)):
            regions = report[key]["regions"]
            self.assertEqual([region["region"] for region in regions], ["7", "12"])
            for region, value in zip(regions, (0, 1)):
                shapes = [planar_geometry.raw_shape([(x, y) for x, y, _ in points], *cell)
                          for (_, cell), own in zip(self.grid.cells, self.left_right) if own == value]
                self.assertEqual(region["triangles"], len(shapes))
                self.assertEqual(region["inverted"], sum(shape < 0 for shape in shapes))
                self.assertAlmostEqual(region["shape"]["min"], min(shapes), places=12)
                self.assertAlmostEqual(region["shape"]["mean"], sum(shapes) / len(shapes), places=12)
        out = self.run_tool("quality", "in.vtu").out
        self.assertRegex(out, r"(?m)^region +triangles +inverted +min shape")
        self.assertRegex(out, r"(?m)^12 +144 +0 ")


class Fixed(RegionTest):

    def write_points(self, name, flags):
        content = vtu(self.grid, []).replace(
            "<CellData>", f'<PointData><DataArray type="UInt8" Name="{name}" format="ascii">'
                          f'{" ".join(map(str, flags))}</DataArray></PointData><CellData>')
        self.write("in.vtu", content)

    def test_an_array_that_is_obeyed_is_named_with_how_many_vertices_it_holds(self):
        self.write_grid()
        free = sorted(self.moved()[0])
        flags = [int(v in free[:5]) for v in range(len(self.grid.points))]
        for name in ("fixed", "Fixed"):
            self.write_points(name, flags)
            moved, out, _ = self.moved("--report", "r.json", "--report", "r.html")
            self.assertEqual(moved & set(free[:5]), set())
            self.assertIn(f"5 by the array '{name}'", out)
            report = self.report("quality", "in.vtu")["input"]
            self.assertEqual((report["fixed_array"], report["fixed_array_vertices"]), (name, 5))
            self.assertIn(f"by the point array &#39;{name}&#39;".encode(),
                          self.read("r.html").replace(b"'", b"&#39;").replace(b"&apos;", b"&#39;"))
        self.write("ids.txt", f"{free[7]} {free[8]} {free[7]}\n")
        outcome = self.run_tool("quality", "in.vtu", "--fixed-ids", "ids.txt", "--report", "r.json")
        self.assertIn("2 by the file ids.txt", " ".join(outcome.out.split()))

    def test_what_holds_vertices_adds_up(self):
        self.write("in.vtk", sample_meshes.legacy_vtk(sample_meshes.Grid(others=True)))
        report = self.report("quality", "in.vtk")["input"]
        mesh = mesh_reader.read(self.path("in.vtk"))
        held = report["held"]
        self.assertEqual(held["interface"], len(planar_geometry.interface_vertices(mesh)))
        self.assertEqual(held["other_cells"], len(planar_geometry.other_cell_vertices(mesh)))
        reasons = sum(count for reason, count in held.items() if reason != "several")
        self.assertGreaterEqual(reasons, report["fixed_vertices"] + held["several"])

    def test_what_annotations_say_is_no_input_of_a_later_run(self):
        for extension, content in {"vtk": sample_meshes.legacy_vtk(self.grid), "vtp": sample_meshes.vtp(self.grid),
                                   "vtu": sample_meshes.vtu(self.grid, "appended raw", compressed=True)}.items():
            with self.subTest(extension):
                plain, once, twice = (f"{name}.{extension}" for name in ("plain", "once", "twice"))
                self.write(plain, content)
                first = self.report("smooth", plain, once, "--annotate", "--max-sweeps", "1")
                again = self.report("smooth", once, twice, "--annotate", "--max-sweeps", "1")
                for key in ("fixed_vertices", "held", "regions", "region_arrays", "fixed_array"):
                    self.assertEqual(again["input"][key], first["input"][key])
                self.assertIsNone(again["input"]["fixed_array"])
                # Nor does it hold the interfaces, once they are set free.
                freed = self.report("quality", once, "--region-array", "none")["input"]
                self.assertEqual(freed["fixed_vertices"], freed["held"]["boundary"])


class RealMeshes(RegionTest):
    """Meshes of others, where they are at hand."""

    folder_of_meshes = os.environ.get("TRISMOOTH_REAL_MESHES", "")

    def test_their_interfaces_stay_under_any_name(self):
        names = [name for name in ("osteon.vtk", "apartment.vtk", "freshcyl.vtk", "meander.vtk")
                 if os.path.exists(os.path.join(self.folder_of_meshes, name))]
        if not names:
            self.skipTest("TRISMOOTH_REAL_MESHES names no folder of them")
        for name in names:
            with open(os.path.join(self.folder_of_meshes, name), "rb") as file:
                content = file.read()
            for own in (b"region", b"mat_id"):
                content = content.replace(b"\n" + own + b" 1", b"\nanything 1").replace(b" " + own + b" ", b" anything ")
            with self.subTest(name):
                self.write("in.vtk", content)
                self.run_tool("smooth", "in.vtk", "out.vtk")
                before, after = mesh_reader.read(self.path("in.vtk")), mesh_reader.read(self.path("out.vtk"))
                held = ends_between(before, before.cell_arrays["anything"])
                self.assertGreater(len(held), 0)
                self.assertEqual([v for v in held if before.points[v] != after.points[v]], [])


if __name__ == "__main__":
    tool.main()
