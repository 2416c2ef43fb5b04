# SPDX-License-Identifier: BSD-3-Clause
"""Files that meshio writes come back with nothing lost, and meshio reads what trismooth writes in each of its formats."""

import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "end_to_end"))

try:
    import h5py  # noqa: F401, which meshio needs for MED
    import meshio
    import numpy
except ImportError as missing:
    print(f"skipped: meshio or h5py is not installed where this runs ({missing})")
    sys.exit(77)

import nastran_columns
import number_texts
import part_groups
import tool

# name -> (extension, arguments of meshio's writer). Of SU2 meshio 5.3 has a reader alone: its writer fails.
TEXT_DIALECTS = {
    "gmsh41": (".msh", {"file_format": "gmsh", "binary": False}),
    "gmsh22": (".msh", {"file_format": "gmsh22", "binary": False}),
    "medit": (".mesh", {"file_format": "medit"}),
    "abaqus": (".inp", {"file_format": "abaqus"}),
    "nastran_free": (".nas", {"file_format": "nastran", "point_format": "free"}),
}
COLUMN_DIALECTS = {
    "nastran_small": (".bdf", {"file_format": "nastran", "point_format": "fixed-small"}),
    "nastran_large": (".bdf", {"file_format": "nastran", "point_format": "fixed-large"}),
}
OTHER_DIALECTS = {
    "gmsh41_binary": (".msh", {"file_format": "gmsh", "binary": True}),
    "gmsh22_binary": (".msh", {"file_format": "gmsh22", "binary": True}),
    "meditb": (".meshb", {"file_format": "medit"}),
    "med": (".med", {"file_format": "med"}),
}
EVERY_DIALECT = {**TEXT_DIALECTS, **COLUMN_DIALECTS, **OTHER_DIALECTS}


def plate(columns=12, rows=9):
    """Two materials side by side, the inner points moved about, lines around; flat or, for formats that want it, in
    space."""
    points = []
    for row in range(rows + 1):
        for column in range(columns + 1):
            inner = 0 < row < rows and 0 < column < columns and column != columns // 2
            angle = 2.399963 * len(points)
            points.append((column + (0.6 * (angle % 1 - 0.5) if inner else 0),
                           row + (0.6 * ((3.7 * angle) % 1 - 0.5) if inner else 0), 0.0))

    def at(column, row):
        return row * (columns + 1) + column

    triangles, materials = [], []
    for row in range(rows):
        for column in range(columns):
            a, b, c, d = at(column, row), at(column + 1, row), at(column + 1, row + 1), at(column, row + 1)
            triangles += [(a, b, c), (a, c, d)]
            materials += [1 if column < columns // 2 else 2] * 2
    around = ([at(i, 0) for i in range(columns)] + [at(columns, i) for i in range(rows)] +
              [at(i, rows) for i in range(columns, 0, -1)] + [at(0, i) for i in range(rows, 0, -1)])
    lines = [(a, b) for a, b in zip(around, around[1:] + around[:1])]
    marks = [3] * columns + [4] * rows + [3] * columns + [5] * rows
    return numpy.array(points), lines, marks, triangles, materials


def mesh_for(dialect):
    points, lines, marks, triangles, materials = plate()
    cells = [("line", numpy.array(lines)), ("triangle", numpy.array(triangles))]
    arrays = [numpy.array(marks), numpy.array(materials)]
    kind = EVERY_DIALECT[dialect][1]["file_format"]
    if kind.startswith("gmsh"):
        names = {"left": numpy.array([1, 2]), "right": numpy.array([2, 2]), "wall": numpy.array([3, 1]),
                 "outlet": numpy.array([4, 1]), "inlet": numpy.array([5, 1])}
        inner = numpy.full((len(points), 2), (2, 1))
        inner[points[:, 0] >= points[:, 0].max() / 2] = (2, 2)
        for (first, _), mark in zip(lines, marks):
            inner[first] = (1, mark)
        return meshio.Mesh(points, cells, cell_data={"gmsh:physical": arrays, "gmsh:geometrical": arrays},
                           point_data={"gmsh:dim_tags": inner} if kind == "gmsh" else {}, field_data=names)
    if kind == "medit":
        return meshio.Mesh(points[:, :2], cells, cell_data={"medit:ref": arrays},
                           point_data={"medit:ref": numpy.arange(len(points)) % 3})
    if kind == "med":
        mesh = meshio.Mesh(points, cells, cell_data={"cell_tags": [-numpy.array(marks), -numpy.array(materials)]},
                           point_data={"point_tags": numpy.where(numpy.arange(len(points)) == 12, 1, 0),
                                       "heat": points[:, 0]})
        mesh.cell_tags = {-1: ["left", "all"], -2: ["right", "all"], -3: ["wall"], -4: ["outlet"], -5: ["inlet"]}
        mesh.point_tags = {1: ["corner"]}
        return mesh
    if kind == "nastran":
        return meshio.Mesh(points, cells, cell_data={"nastran:ref": arrays})
    if kind == "abaqus":
        left = numpy.flatnonzero(arrays[1] == 1)
        right = numpy.flatnonzero(arrays[1] == 2)
        none = numpy.array([], dtype=int)
        return meshio.Mesh(points, cells, point_sets={"corners": numpy.array([0, 12])},
                           cell_sets={"left": [none, left], "right": [none, right]})
    raise ValueError(f"no mesh for the format {kind}")


class MeshioTest(tool.ToolTest):

    def write_mesh(self, dialect):
        extension, arguments = EVERY_DIALECT[dialect]
        name = dialect + extension
        meshio.write(self.path(name), mesh_for(dialect), **arguments)
        return name

    def read_mesh(self, name):
        mesh = meshio.read(self.path(name))
        if name.endswith(".med"):
            self.assertTrue(mesh.cell_tags)
        return mesh

    def assert_same_but_points(self, before, after):
        self.assertEqual([block.type for block in after.cells], [block.type for block in before.cells])
        for old, new in zip(before.cells, after.cells):
            numpy.testing.assert_array_equal(new.data, old.data)
        for old, new in ((before.cell_data, after.cell_data), (before.cell_sets, after.cell_sets)):
            self.assertEqual(new.keys(), old.keys())
            for key in old:
                for block, same in zip(old[key], new[key]):
                    numpy.testing.assert_array_equal(same, block)
        for old, new in ((before.point_data, after.point_data), (before.point_sets, after.point_sets),
                         (before.field_data, after.field_data)):
            self.assertEqual(new.keys(), old.keys())
            for key in old:
                numpy.testing.assert_array_equal(new[key], old[key])


class WrittenBack(MeshioTest):

    def test_nothing_moved_gives_the_same_bytes(self):
        for dialect in EVERY_DIALECT:
            with self.subTest(dialect):
                name = self.write_mesh(dialect)
                self.write("all.txt", "\n".join(map(str, range(len(plate()[0])))))
                output = "same" + os.path.splitext(name)[1]
                self.run_tool("smooth", name, output, "--fixed-ids", "all.txt")
                self.assertEqual(self.read(output), self.read(name))

    def test_texts_differ_in_the_numbers_of_moved_points_alone(self):
        for dialect in TEXT_DIALECTS:
            with self.subTest(dialect):
                name = self.write_mesh(dialect)
                output = "smoothed" + os.path.splitext(name)[1]
                moved = self.report("smooth", name, output)["smoothing"]["moved_vertices"]
                changed = number_texts.changed_numbers(self.read(name), self.read(output))
                self.assertGreater(moved, 50)
                self.assertLessEqual(len(changed), 2 * moved)
                self.assertGreaterEqual(len(changed), moved)

    def test_columns_differ_in_the_numbers_of_moved_points_alone(self):
        for dialect in COLUMN_DIALECTS:
            with self.subTest(dialect):
                name = self.write_mesh(dialect)
                moved = self.report("smooth", name, "smoothed.bdf")["smoothing"]["moved_vertices"]
                changed = nastran_columns.changed_numbers(self.read(name), self.read("smoothed.bdf"))
                self.assertGreater(moved, 50)
                self.assertLessEqual(len(changed), 2 * moved)
                self.assertGreaterEqual(len(changed), moved)

    def test_large_fields_of_elements_are_read(self):
        # meshio writes these, but does not read them.
        meshio.write(self.path("large.bdf"), mesh_for("nastran_large"), file_format="nastran", cell_format="fixed-large")
        meshio.write(self.path("small.bdf"), mesh_for("nastran_large"), file_format="nastran")
        counts = [self.report("quality", name)["input"] for name in ("large.bdf", "small.bdf")]
        for key in ("vertices", "triangles"):
            self.assertEqual(counts[0][key], counts[1][key])

    def test_meshio_reads_the_same_but_for_moved_points(self):
        for dialect in EVERY_DIALECT:
            with self.subTest(dialect):
                name = self.write_mesh(dialect)
                output = "smoothed" + os.path.splitext(name)[1]
                report = self.report("smooth", name, output)
                before, after = self.read_mesh(name), self.read_mesh(output)
                self.assert_same_but_points(before, after)
                moved = numpy.flatnonzero((before.points != after.points).any(axis=1))
                self.assertEqual(len(moved), report["smoothing"]["moved_vertices"])
                self.assertEqual(report["input"]["vertices"], len(before.points))


class Converted(MeshioTest):
    """From Gmsh's format, which holds everything, into each of the others that meshio reads."""

    TARGETS = {".mesh": "medit:ref", ".meshb": "medit:ref", ".su2": "su2:tag", ".inp": None,
               ".bdf": "nastran:ref", ".med": None}

    def test_elements_and_their_groups_are_the_same(self):
        name = self.write_mesh("gmsh22")
        _, lines, marks, triangles, materials = plate()
        for extension, array in self.TARGETS.items():
            with self.subTest(extension):
                output = "converted" + extension
                self.run_tool("smooth", name, output)
                mesh = self.read_mesh(output)
                cells = mesh.cells_dict
                self.assertEqual(sorted(map(tuple, cells["triangle"].tolist())), sorted(triangles))
                self.assertEqual(sorted(map(tuple, cells["line"].tolist())), sorted(lines))
                if extension in (".mesh", ".meshb", ".bdf"):
                    found = mesh.cell_data_dict[array]["triangle"]
                    self.assertEqual(sorted(zip(map(tuple, cells["triangle"].tolist()), found.tolist())),
                                     sorted(zip(triangles, materials)))
                if extension == ".med":
                    names = {number: groups[0] for number, groups in mesh.cell_tags.items()}
                    self.assertEqual(sorted(names.values()), ["inlet", "left", "outlet", "right", "wall"])
                    found = [names[number] for number in mesh.cell_data_dict["cell_tags"]["triangle"]]
                    self.assertEqual(sorted(zip(map(tuple, cells["triangle"].tolist()), found)),
                                     sorted(zip(triangles, [["left", "right"][m - 1] for m in materials])))
                if extension == ".inp":
                    self.assertLessEqual({"left", "right", "wall", "inlet", "outlet"}, set(mesh.cell_sets))
                if extension == ".su2":
                    tags = mesh.cell_data_dict[array]["line"].tolist()
                    self.assertEqual(len(set(tags)), len(set(marks)))


class PartsInGroups(MeshioTest):

    def test_msh_with_groups_for_a_part_of_the_cells_is_opened_and_saved_again_with_all_of_them(self):
        for name, content in part_groups.FILES.items():
            with self.subTest(name):
                self.write(name, content())
                outcome = self.run_tool("smooth", name, "out.msh")
                self.assertIn("without a group are written in a further one", outcome.err)
                mesh = self.read_mesh("out.msh")
                meshio.write(self.path("again.msh"), mesh, file_format="gmsh")
                for read in (mesh, self.read_mesh("again.msh")):
                    for kind, count in (("triangle", part_groups.TRIANGLES), ("line", part_groups.LINES)):
                        self.assertEqual(len(read.get_cells_type(kind)), count)
                        self.assertTrue((read.get_cell_data("gmsh:physical", kind) > 0).all())


if __name__ == "__main__":
    tool.main()
