# SPDX-License-Identifier: BSD-3-Clause
"""What is written to CGNS, Exodus II and MED is the same mesh to h5py, netCDF4, VTK, Gmsh and meshio, and comes back so."""

import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "end_to_end"))

try:
    import gmsh
    import h5py
    import meshio
    import netCDF4
    import numpy
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOCGNSReader import vtkCGNSReader
except (ImportError, OSError) as missing:
    print(f"skipped: what reads these files is not installed where this runs ({missing})")
    sys.exit(77)

import tool

COLUMNS, ROWS = 10, 8
MACHINE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "data", "machine.vtu")


def plate(in_turn):
    """Points, the inner ones moved about, and squares, of which some are two triangles: in turn, or the squares first."""
    points, cells, sides = [], [], []
    for row in range(ROWS + 1):
        for column in range(COLUMNS + 1):
            angle = 2.399963 * len(points)
            inner = 0 < row < ROWS and 0 < column < COLUMNS and column != COLUMNS // 2
            points.append((column + (0.5 * (angle % 1 - 0.5) if inner else 0),
                           row + (0.5 * ((3.7 * angle) % 1 - 0.5) if inner else 0), 0))
    for row in range(ROWS):
        for column in range(COLUMNS):
            a = row * (COLUMNS + 1) + column
            b, c, d = a + 1, a + COLUMNS + 2, a + COLUMNS + 1
            new = [(a, b, c, d)] if (row + column) % 3 else [(a, b, c), (a, c, d)]
            cells += new
            sides += [1 if column < COLUMNS // 2 else 2] * len(new)
    if not in_turn:
        order = sorted(range(len(cells)), key=lambda i: -len(cells[i]))
        cells, sides = [cells[i] for i in order], [sides[i] for i in order]
    return points, cells, sides


def legacy_vtk(points, cells, values):
    lines = ["# vtk DataFile Version 3.0", "plate", "ASCII", "DATASET UNSTRUCTURED_GRID", f"POINTS {len(points)} double"]
    lines += [" ".join(map(repr, map(float, point))) for point in points]
    lines += [f"CELLS {len(cells)} {sum(len(cell) + 1 for cell in cells)}"]
    lines += [" ".join(map(str, (len(cell), *cell))) for cell in cells]
    lines += [f"CELL_TYPES {len(cells)}"] + ["5" if len(cell) == 3 else "9" for cell in cells]
    if values:
        lines += [f"CELL_DATA {len(cells)}", "SCALARS region int 1", "LOOKUP_TABLE default", *map(str, values)]
    return "\n".join(lines) + "\n"


class Containers(tool.ToolTest):

    def smooth(self, source, target, *arguments):
        """The report of a run that moves nothing: all vertices are held."""
        return self.report("smooth", source, target, "--fixed-ids", "all.txt", *arguments)

    def write_plate(self, in_turn, with_regions):
        points, cells, regions = plate(in_turn)
        self.write("in.vtk", legacy_vtk(points, cells, regions if with_regions else None))
        self.write("all.txt", "\n".join(map(str, range(len(points)))))
        return points, cells, regions

    def held_at_interfaces(self, name):
        return self.report("smooth", name, "again.off")["input"]["held"]["interface"]

    def test_what_is_held_between_regions_is_the_same_from_each(self):
        for in_turn in (True, False):
            for with_regions in (True, False):
                self.write_plate(in_turn, with_regions)
                expected = self.held_at_interfaces("in.vtk")
                self.assertEqual(expected > 0, with_regions)
                for extension in ("cgns", "exo", "med"):
                    with self.subTest(extension, in_turn=in_turn, with_regions=with_regions):
                        self.smooth("in.vtk", "out." + extension)
                        self.assertEqual(self.held_at_interfaces("out." + extension), expected)

    def test_the_machine_comes_back(self):
        expected = self.held_at_interfaces(MACHINE)
        points = len(meshio.read(MACHINE).points)
        self.write("all.txt", "\n".join(map(str, range(points))))
        for extension in ("cgns", "exo", "med"):
            with self.subTest(extension):
                self.smooth(MACHINE, "out." + extension)
                self.assertEqual(self.held_at_interfaces("out." + extension), expected)

    def test_cgns_has_the_cells_in_their_order_to_vtk(self):
        for in_turn in (True, False):
            with self.subTest(in_turn=in_turn):
                points, cells, _ = self.write_plate(in_turn, True)
                self.smooth("in.vtk", "out.cgns")
                reader = vtkCGNSReader()
                reader.SetFileName(self.path("out.cgns"))
                reader.Update()
                grid = reader.GetOutput().GetBlock(0).GetBlock(0)
                numpy.testing.assert_array_equal(vtk_to_numpy(grid.GetPoints().GetData()), points)
                self.assertEqual([tuple(grid.GetCell(i).GetPointIds().GetId(k)
                                        for k in range(grid.GetCell(i).GetNumberOfPoints()))
                                  for i in range(grid.GetNumberOfCells())], cells)

    def test_cgns_of_types_that_follow_each_other_reaches_gmsh(self):
        _, cells, regions = self.write_plate(False, True)
        self.smooth("in.vtk", "out.cgns")
        gmsh.initialize(interruptible=False)
        try:
            gmsh.option.setNumber("General.Terminal", 0)
            gmsh.open(self.path("out.cgns"))
            _, tags, _ = gmsh.model.mesh.getElements(2)
            self.assertEqual(sorted(map(len, tags)), sorted([sum(len(c) == n for c in cells) for n in (3, 4)]))
            for group, name in gmsh_groups().items():
                members = [entity for entity in gmsh.model.getEntitiesForPhysicalGroup(*group)]
                count = sum(len(t) for entity in members for t in gmsh.model.mesh.getElements(2, entity)[1])
                self.assertEqual(count, regions.count(int(name.split()[-1])))
        finally:
            gmsh.finalize()

    def test_exodus_has_a_region_s_blocks_under_one_property(self):
        _, cells, regions = self.write_plate(True, True)
        self.smooth("in.vtk", "out.exo")
        with netCDF4.Dataset(self.path("out.exo")) as file:
            self.assertEqual(file["eb_prop2"].getncattr("name"), "region")
            found = {}
            numbers = file["elem_num_map"][:].tolist()
            for block, region in enumerate(file["eb_prop2"][:].tolist(), 1):
                for nodes in file[f"connect{block}"][:].tolist():
                    found[numbers[len(found)]] = (region, tuple(node - 1 for node in nodes))
        self.assertEqual([found[number] for number in sorted(found)], list(zip(regions, cells)))
        blocks = meshio.read(self.path("out.exo")).cells
        self.assertEqual(sorted(block.type for block in blocks), ["quad", "quad", "triangle", "triangle"])

    def test_med_has_the_old_numbers_of_elements(self):
        _, cells, _ = self.write_plate(True, True)
        self.smooth("in.vtk", "out.med")
        with h5py.File(self.path("out.med")) as file:
            mesh = file["ENS_MAA/mesh"]
            elements = next(iter(mesh.values()))["MAI"]
            found = {}
            for name, nodes in (("TR3", 3), ("QU4", 4)):
                table = elements[name]["NOD"][()].reshape(nodes, -1).T - 1
                found.update(zip(elements[name]["NUM"][()].tolist(), map(tuple, table.tolist())))
        self.assertEqual([found[number] for number in sorted(found)], cells)

    def test_arrays_reach_every_reader(self):
        points, cells, _ = plate(False)
        quads = [cell for cell in cells if len(cell) == 4]
        triangles = [cell for cell in cells if len(cell) == 3]
        heat = numpy.arange(len(points)) / 8
        flow = numpy.column_stack([heat, -heat, 2 * heat])
        load = [numpy.arange(len(quads)) + 0.5, -numpy.arange(len(triangles)) - 0.5]
        # At a height: of bases of two dimensions VTK puts no vectors together.
        mesh = meshio.Mesh(numpy.array(points) + [0, 0, 1.0], [("quad", numpy.array(quads)), ("triangle", numpy.array(triangles))],
                           point_data={"heat": heat, "flow": flow}, cell_data={"load": load})
        meshio.write(self.path("in.vtu"), mesh)
        self.write("all.txt", "\n".join(map(str, range(len(points)))))
        self.smooth("in.vtu", "out.med")
        back = meshio.read(self.path("out.med"))
        numpy.testing.assert_array_equal(back.point_data["heat"], heat)
        numpy.testing.assert_array_equal(back.point_data["flow"], flow)
        for block, values in zip(back.cells, back.cell_data["load"]):
            numpy.testing.assert_array_equal(values, load[0 if block.type == "quad" else 1])
        gmsh.initialize(interruptible=False)
        try:
            gmsh.option.setNumber("General.Terminal", 0)
            gmsh.open(self.path("out.med"))
            self.assertEqual(sorted(gmsh.option.getString(f"View[{i}].Name") for i in range(len(gmsh.view.getTags()))),
                             ["flow", "heat", "load"])
        finally:
            gmsh.finalize()
        self.smooth("in.vtu", "out.cgns")
        with h5py.File(self.path("out.cgns")) as file:
            numpy.testing.assert_array_equal(file["Base/Zone/PointData/heat/ data"][()], heat)
            numpy.testing.assert_array_equal(file["Base/Zone/PointData/flowZ/ data"][()], flow[:, 2])
            numpy.testing.assert_array_equal(file["Base/Zone/CellData/load/ data"][()], numpy.concatenate(load))
        reader = vtkCGNSReader()
        reader.SetFileName(self.path("out.cgns"))
        reader.UpdateInformation()
        reader.EnableAllPointArrays()
        reader.EnableAllCellArrays()
        reader.Update()
        grid = reader.GetOutput().GetBlock(0).GetBlock(0)
        numpy.testing.assert_array_equal(vtk_to_numpy(grid.GetPointData().GetArray("flow")), flow)
        numpy.testing.assert_array_equal(vtk_to_numpy(grid.GetCellData().GetArray("load")), numpy.concatenate(load))
        for extension in ("med", "cgns"):
            self.smooth("out." + extension, "again.vtu")
            again = meshio.read(self.path("again.vtu"))
            numpy.testing.assert_array_equal(again.point_data["flow"], flow)
            values = {block.type: own for block, own in zip(again.cells, again.cell_data["load"])}
            numpy.testing.assert_array_equal(values["quad"], load[0])
            numpy.testing.assert_array_equal(values["triangle"], load[1])

    def test_fields_of_points_follow_the_mesh_in_their_places(self):
        points, cells, _ = plate(True)
        mesh = meshio.Mesh(numpy.array(points, dtype=float), [("quad", numpy.array([c for c in cells if len(c) == 4])),
                                                              ("triangle", numpy.array([c for c in cells if len(c) == 3]))],
                           point_data={"heat": numpy.array(points)[:, 0] * 2 + 1})
        meshio.write(self.path("in.vtu"), mesh)
        self.write("all.txt", "\n".join(map(str, range(len(points)))))
        for extension in ("med", "cgns"):
            with self.subTest(extension):
                self.smooth("in.vtu", "in." + extension)
                self.run_tool("smooth", "in." + extension, "out." + extension, "--fields", "interpolate")
                self.run_tool("smooth", "out." + extension, "out.vtu", "--fixed-ids", "all.txt")
                after = meshio.read(self.path("out.vtu"))
                self.assertGreater(numpy.count_nonzero(after.points[:, 0] != mesh.points[:, 0]), 20)
                numpy.testing.assert_allclose(after.point_data["heat"], after.points[:, 0] * 2 + 1, rtol=0, atol=1e-9)

    def test_blocks_of_meshio_that_have_no_names_are_told(self):
        points, cells, _ = plate(False)
        meshio.write(self.path("in.e"), meshio.Mesh(numpy.array(points, dtype=float), [
            ("quad", numpy.array([cell for cell in cells if len(cell) == 4])),
            ("triangle", numpy.array([cell for cell in cells if len(cell) == 3]))]))
        self.assertIn("--region-array none frees what is between them", self.run_tool("smooth", "in.e", "out.e").err)


def gmsh_groups():
    return {group: gmsh.model.getPhysicalName(*group).strip() for group in gmsh.model.getPhysicalGroups(2)}


if __name__ == "__main__":
    tool.main()
