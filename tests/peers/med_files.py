# SPDX-License-Identifier: BSD-3-Clause
"""MED by SALOME's own library: its meshes with groups and fields come back with moved nodes alone, and it reads the groups
of what trismooth writes from other formats."""

import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "end_to_end"))

try:
    import h5py
    import medcoupling
    import meshio
    import numpy
except ImportError as missing:
    print(f"skipped: a package is not installed where this runs ({missing})")
    sys.exit(77)

import meshio_files
import tool
import xdmf_files

WIDE, HIGH = 12, 8


def node(column, row):
    return row * (WIDE + 1) + column


def medcoupling_mesh(dimension, points, kind, cells):
    mesh = medcoupling.MEDCouplingUMesh("plate", dimension)
    mesh.setCoords(points)
    mesh.allocateCells(len(cells))
    for cell in cells:
        mesh.insertNextCell(kind if kind else {3: medcoupling.NORM_TRI3, 4: medcoupling.NORM_QUAD4}[len(cell)], len(cell), cell)
    mesh.finishInsertingCells()
    return mesh


def group(name, members):
    ids = medcoupling.DataArrayInt64([int(member) for member in members])
    ids.setName(name)
    return ids


class MedTest(tool.ToolTest):

    def write_medcoupling(self, name):
        """A plate half of triangles, half of quadrilaterals, with groups of faces, sides and nodes, and two fields."""
        across, along = numpy.meshgrid(numpy.linspace(0, 3, WIDE + 1), numpy.linspace(0, 2, HIGH + 1))
        places = numpy.stack([across.ravel(), along.ravel()], 1)
        inner = (places[:, 0] > 0) & (places[:, 0] < 3) & (places[:, 1] > 0) & (places[:, 1] < 2)
        places[inner] += numpy.random.default_rng(2).uniform(-0.07, 0.07, (inner.sum(), 2))
        points = medcoupling.DataArrayDouble(places.ravel().tolist(), len(places), 2)
        points.setInfoOnComponents(["x [m]", "y [m]"])
        squares = [[node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)] for j in range(HIGH) for i in range(WIDE)]
        triangles = [half for square in squares if square[0] % (WIDE + 1) < 6
                     for half in (square[:3], [square[0], square[2], square[3]])]
        quadrilaterals = [square for square in squares if square[0] % (WIDE + 1) >= 6]
        sides = [[node(i, 0), node(i + 1, 0)] for i in range(WIDE)] + [[node(WIDE, j), node(WIDE, j + 1)] for j in range(HIGH)]
        faces = medcoupling_mesh(2, points, None, triangles + quadrilaterals)
        file = medcoupling.MEDFileUMesh()
        file.setMeshAtLevel(0, faces)
        file.setMeshAtLevel(-1, medcoupling_mesh(1, points, medcoupling.NORM_SEG2, sides))
        file.setGroupsAtLevel(0, [group("steel", range(50)),
                                  group("concrete and a long name", range(len(triangles), len(triangles) + len(quadrilaterals)))])
        file.setGroupsAtLevel(-1, [group("bottom", range(WIDE)), group("right", range(WIDE, WIDE + HIGH))])
        file.setGroupsAtLevel(1, [group("sensors", [node(3, 3), node(4, 4)])])
        file.setDescription("a plate")
        file.write(self.path(name), 2)
        fields = [("T", medcoupling.ON_NODES, step, places @ [1, 2] + step) for step in (0, 1)]
        for title, where, step, values in [*fields, ("sigma", medcoupling.ON_CELLS, 0, numpy.arange(len(squares) * 1.5))]:
            field = medcoupling.MEDCouplingFieldDouble(where, medcoupling.ONE_TIME)
            field.setMesh(faces)
            field.setName(title)
            field.setTime(1.5 * step, step, 0)
            field.setArray(medcoupling.DataArrayDouble(values.tolist(), len(values), 1))
            medcoupling.WriteFieldUsingAlreadyWrittenMesh(self.path(name), field)

    def described(self, name):
        """All that SALOME's library says of a file but for coordinates, and these."""
        path = self.path(name)
        file = medcoupling.MEDFileUMesh(path)
        mesh = file.getMeshAtLevel(0)
        groups = {name: [(level, file.getGroupArr(level, name).toNumPyArray().tolist())
                         for level in file.getGrpNonEmptyLevelsExt(name)] for name in file.getGroupsNames()}
        return ({"levels": file.getNonEmptyLevels(), "groups": groups, "description": file.getDescription(),
                 "axes": mesh.getCoords().getInfoOnComponents(), "cells": mesh.getNodalConnectivity().toNumPyArray().tolist(),
                 "fields": {field: medcoupling.GetAllFieldIterations(path, field) for field in medcoupling.GetAllFieldNames(path)}},
                mesh.getCoords().toNumPyArray())

    def test_its_own_files_come_back_with_moved_nodes_alone(self):
        self.write_medcoupling("in.med")
        report = self.report("smooth", "in.med", "out.med")
        held = report["input"]["held"]
        self.assertEqual((held["interface"], held["named"], held["other_cells"]), (16, 2, 21))
        self.assertEqual(report["input"]["regions"], 3)
        (before, places), (after, moved) = (self.described(name) for name in ("in.med", "out.med"))
        self.assertEqual(before, after)
        self.assertEqual(before["fields"], {"T": [(0, 0, 0.0), (1, 0, 1.5)], "sigma": [(0, 0, 0.0)]})
        self.assertEqual((places != moved).any(axis=1).sum(), report["smoothing"]["moved_vertices"])
        sensors = [node(3, 3), node(4, 4)]
        numpy.testing.assert_array_equal(places[sensors], moved[sensors])
        first, second = (xdmf_files.datasets(self.path(name)) for name in ("in.med", "out.med"))
        self.assertEqual(first.keys(), second.keys())
        changed = [name for name in first if not numpy.array_equal(first[name][0], second[name][0])]
        self.assertEqual([name.rsplit("/", 2)[1:] for name in changed], [["NOE", "COO"]])

    def test_a_polygon_goes_both_ways(self):
        points = medcoupling.DataArrayDouble([0, 0, 2, 0, 3, 1, 2, 2, 0, 2, 1, 1], 6, 2)
        mesh = medcoupling_mesh(2, points, medcoupling.NORM_POLYGON, [[0, 1, 2, 3, 5], [0, 5, 3, 4]])
        medcoupling.WriteUMesh(self.path("in.med"), mesh, True)
        self.run_tool("smooth", "in.med", "out.off")
        self.run_tool("smooth", "out.off", "out.med")
        again = medcoupling.MEDFileUMesh(self.path("out.med")).getMeshAtLevel(0)
        self.assertAlmostEqual(again.getMeasureField(True).getArray().accumulate()[0],
                               mesh.getMeasureField(True).getArray().accumulate()[0])

    def test_the_file_that_is_read_is_not_replaced_by_numbers_of_the_one_that_is_written(self):
        self.write_medcoupling("case.h5")
        before = self.read("case.h5")
        said = self.run_tool("smooth", "case.h5", "case.xdmf", expect=4).err
        self.assertIn("has its numbers in case.h5, which is the input here", said)
        self.assertEqual(self.read("case.h5"), before)
        self.assertFalse(os.path.exists(self.path("case.xdmf")))

    def test_it_reads_groups_of_what_comes_from_another_format(self):
        points, lines, marks, triangles, materials = meshio_files.plate()
        names = {"left": (1, 2), "right": (2, 2), "wall": (3, 1), "outlet": (4, 1), "inlet": (5, 1)}
        arrays = [numpy.array(marks), numpy.array(materials)]
        mesh = meshio.Mesh(points, [("line", numpy.array(lines)), ("triangle", numpy.array(triangles))],
                           cell_data={key: arrays for key in ("gmsh:physical", "gmsh:geometrical")},
                           field_data={name: numpy.array(number) for name, number in names.items()})
        meshio.write(self.path("in.msh"), mesh, file_format="gmsh22")
        self.run_tool("smooth", "in.msh", "out.med")
        described, _ = self.described("out.med")
        self.assertEqual(described["groups"],
                         {name: [(dimension - 2, numpy.flatnonzero(arrays[dimension - 1] == number).tolist())]
                          for name, (number, dimension) in names.items()})

    def test_its_groups_go_by_way_of_other_formats_and_back(self):
        self.write_medcoupling("in.med")
        names = {"steel", "concrete and a long name", "bottom", "right", "sensors"}
        for way in ("out.xdmf", "out.cgns", "out.exo"):
            with self.subTest(way):
                self.run_tool("smooth", "in.med", way)
                self.run_tool("smooth", way, "back.med")
                (before, _), (after, _) = (self.described(name) for name in ("in.med", "back.med"))
                if way == "out.exo":
                    # Sides come in the order of their sets; what is in no group is in none again.
                    self.assertEqual(set(after["groups"]), set(before["groups"]))
                    self.assertEqual({name: len(members[0][1]) for name, members in before["groups"].items()},
                                     {name: len(members[0][1]) for name, members in after["groups"].items()})
                else:
                    for what in ("levels", "groups", "cells"):
                        self.assertEqual(before[what], after[what])
        self.assertEqual(meshio.read(self.path("out.xdmf")).field_data.keys(), names)
        with h5py.File(self.path("out.cgns")) as file:
            self.assertEqual(set(file["Base/Zone/ZoneBC"]), names)


if __name__ == "__main__":
    tool.main()
