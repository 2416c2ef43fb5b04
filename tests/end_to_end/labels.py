# SPDX-License-Identifier: BSD-3-Clause
"""Vertices that are held by numbers: the user's, which the file itself gives them, and markers."""

import os
import re

import mesh_reader
import sample_meshes
import tool

DONE, WRONG_USAGE, BAD_INPUT = 0, 2, 3


class Labels(tool.ToolTest):

    def setUp(self):
        super().setUp()
        self.grid = sample_meshes.Grid()
        self.write("plate.off", sample_meshes.off(self.grid))
        self.run_tool("smooth", "plate.off", "all.off")
        moved = sorted(self.moved("all.off"))
        self.held = {moved[1], moved[len(moved) // 2], moved[-1]}

    def moved(self, name):
        after = mesh_reader.read(self.path(name)).points
        return {v for v, (p, q) in enumerate(zip(self.grid.points, after)) if tuple(map(float, p)) != tuple(q)}

    def labelled(self, kind, label):
        """The plate as a file of that kind whose point i has label(i)."""
        points, cells = self.grid.points, [cell for _, cell in self.grid.cells if len(cell) == 3]
        self.assertEqual(len(cells), len(self.grid.cells))
        if kind == "inp":
            return ("*NODE\n" + "".join(f"{label(i)}, {x}, {y}, {z}\n" for i, (x, y, z) in enumerate(points)) +
                    "*ELEMENT, TYPE=CPS3\n" +
                    "".join(f"{i + 1}, " + ", ".join(str(label(v)) for v in cell) + "\n"
                            for i, cell in enumerate(cells)))
        if kind == "msh":
            return (f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{len(points)}\n" +
                    "".join(f"{label(i)} {x} {y} {z}\n" for i, (x, y, z) in enumerate(points)) +
                    f"$EndNodes\n$Elements\n{len(cells)}\n" +
                    "".join(f"{i + 1} 2 2 0 1 " + " ".join(str(label(v)) for v in cell) + "\n"
                            for i, cell in enumerate(cells)) + "$EndElements\n")
        if kind == "2dm":
            return ("MESH2D\n" + "".join(f"E3T {i + 1} " + " ".join(str(label(v)) for v in cell) + " 1\n"
                                         for i, cell in enumerate(cells)) +
                    "".join(f"ND {label(i)} {x} {y} {z}\n" for i, (x, y, z) in enumerate(points)))
        if kind == "grd":
            return (f"plate\n{len(cells)} {len(points)}\n" +
                    "".join(f"{label(i)} {x} {y} 1\n" for i, (x, y, z) in enumerate(points)) +
                    "".join(f"{i + 1} 3 " + " ".join(str(label(v)) for v in cell) + "\n"
                            for i, cell in enumerate(cells)) + "0\n0\n0\n0\n")
        if kind == "bdf":
            return ("BEGIN BULK\n" + "".join(f"GRID,{label(i)},,{float(x)},{float(y)},{float(z)}\n"
                                             for i, (x, y, z) in enumerate(points)) +
                    "".join(f"CTRIA3,{i + 1},1," + ",".join(str(label(v)) for v in cell) + "\n"
                            for i, cell in enumerate(cells)) + "ENDDATA\n")
        raise ValueError(kind)

    def assert_holds(self, name, label):
        self.write("labels.txt", "# held\n" + "".join(f"{label(v)}\n" for v in self.held))
        report = self.report("smooth", name, "out" + os.path.splitext(name)[1], "--fixed-labels", "labels.txt")
        self.assertEqual(report["input"]["fixed_ids_vertices"], len(self.held))
        self.assertTrue(report["options"]["fixed_ids_are_labels"])
        self.run_tool("smooth", name, "held.off", "--fixed-labels", "labels.txt")
        moved = self.moved("held.off")
        self.assertFalse(moved & self.held)
        self.assertTrue(moved)

    def test_labels_of_files_that_number_their_points(self):
        count = len(self.grid.points)
        labels = {"from 1": lambda i: i + 1, "from 100": lambda i: i + 100, "backwards": lambda i: count - i,
                  "with gaps": lambda i: 5 + 7 * i + i % 3}
        for kind in ("inp", "msh", "2dm", "grd", "bdf"):
            for name, label in labels.items():
                with self.subTest(kind, labels=name):
                    self.write(f"in.{kind}", self.labelled(kind, label))
                    self.assert_holds(f"in.{kind}", label)

    def test_files_that_count_their_points(self):
        for name, first in (("in.mesh", 1), ("in.su2", 0), ("in.obj", 1), ("in.unv", 1), ("in.node", 1)):
            with self.subTest(name):
                self.run_tool("smooth", "plate.off", name, "--fixed-ids", self.all_rows())
                self.assert_holds(name, lambda i, first=first: i + first)

    def all_rows(self):
        self.write("rows.txt", " ".join(map(str, range(len(self.grid.points)))))
        return "rows.txt"

    def test_a_file_without_numbers_is_refused_with_the_way_out(self):
        self.write("labels.txt", "1\n")
        for name in ("plate.off", "plate.vtk", "plate.ply"):
            with self.subTest(name):
                if name != "plate.off":
                    self.run_tool("smooth", "plate.off", name)
                outcome = self.run_tool("smooth", name, "out.off", "--fixed-labels", "labels.txt", expect=WRONG_USAGE)
                self.assertIn("--fixed-ids", outcome.err)

    def test_a_label_that_no_point_has_is_refused(self):
        self.write("in.inp", self.labelled("inp", lambda i: 5 + 7 * i))
        self.write("labels.txt", "5\n6\n")
        outcome = self.run_tool("smooth", "in.inp", "out.inp", "--fixed-labels", "labels.txt", expect=BAD_INPUT)
        self.assertRegex(outcome.err, "labels.txt: names the vertex 6, ")
        self.run_tool("smooth", "in.inp", "out.inp", "--fixed-labels", "labels.txt", "--fixed-ids", "labels.txt",
                      expect=WRONG_USAGE)

    def test_rows_are_told_from_numbers_of_the_file(self):
        self.assertRegex(re.sub(r"\s+", " ", self.run_tool("smooth", "--help").out), "--fixed-ids FILE .*count from 0")
        self.write("rows.txt", "0\n")
        self.write("in.msh", self.labelled("msh", lambda i: i + 1))
        for name, is_said in (("in.msh", True), ("plate.off", False)):
            outcome = self.run_tool("smooth", name, "out.off", "--fixed-ids", "rows.txt")
            self.assertEqual("--fixed-labels" in outcome.err, is_said, outcome)

    def write_marked(self, extension, marker):
        """The plate as a file in[extension], of one region, whose point i has marker(i)."""
        points = self.grid.points
        corners = [" ".join(str(v + 1) for v in cell) for _, cell in self.grid.cells]
        triangles = "".join(f"{corner} 3\n" for corner in corners)
        if extension == ".node":
            self.write("in.ele", f"{len(corners)} 3 0\n" +
                       "".join(f"{i + 1} {corner}\n" for i, corner in enumerate(corners)))
            text = f"{len(points)} 2 0 1\n" + "".join(f"{i + 1} {x} {y} {marker(i)}\n"
                                                     for i, (x, y, _) in enumerate(points))
        else:
            rows = "".join(f"{x} {y} {marker(i)}\n" for i, (x, y, _) in enumerate(points))
            text = (f"MeshVersionFormatted 2\nDimension 2\nVertices {len(points)}\n{rows}" +
                    f"Triangles {len(corners)}\n{triangles}End\n" if extension == ".mesh" else
                    f"{len(points)} {len(corners)} 0\n{rows}{triangles}")
        self.write("in" + extension, text)

    def assert_sets_hold(self, name, members, *sets):
        """The points of these sets are held, as if their rows had been named, and nothing else. `members` by set."""
        self.write("rows.txt", " ".join(map(str, sorted(set().union(*members.values())))))
        self.run_tool("smooth", "plate.off", "named.off", "--fixed-ids", "rows.txt")
        arguments = ("--region-array", "none", *[word for name in sets for word in ("--fixed-set", name)])
        self.run_tool("smooth", name, "out.off", *arguments)
        self.assertEqual(self.read("out.off"), self.read("named.off"))
        self.assertNotEqual(self.read("out.off"), self.read("all.off"))
        listed = self.report("smooth", name, "out.off", *arguments)["input"]["point_sets"]
        self.assertEqual({found["name"]: found["vertices"] for found in listed if found["holds"]},
                         {name: len(points) for name, points in members.items()})

    def test_sets_by_the_numbers_of_points(self):
        marker = lambda i: 7 if i % 9 in (3, 4) else -2 if i in self.held else 0
        points_of = lambda number: {i for i in range(81) if marker(i) == number}
        for extension, array in ((".node", "triangle:marker"), (".mesh", "medit:ref"), (".msh", "freefem:label")):
            with self.subTest(extension):
                self.write_marked(extension, marker)
                self.assert_sets_hold("in" + extension, {f"{array}=7": points_of(7)}, f"{array}=7")
                both = {f"{array}=7": points_of(7), f"{array}=-2": points_of(-2)}
                self.assert_sets_hold("in" + extension, both, f"{array.upper()}=-2", f"{array}=7", f"{array}=07")

    def test_sets_by_the_numbers_of_cells(self):
        """Those of triangles hold the triangles' points, those of lines and points theirs, and one number all of these."""
        points, cells = self.grid.points, [cell for _, cell in self.grid.cells]
        area = {v for v in range(81) if 2 <= v % 9 <= 4 and 2 <= v // 9 <= 4}
        tags = [6 if area.issuperset(cell) else 1 for cell in cells]
        edges = [(v, v + 1) for v in range(0, 8)]
        elements = ([f"2 2 {tag} {tag} " + " ".join(str(v + 1) for v in cell) for tag, cell in zip(tags, cells)] +
                    [f"1 2 4 4 {a + 1} {b + 1}" for a, b in edges] + ["15 2 6 6 9"])
        self.write("in.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n"
                   "1 6 \"wall\"\n2 6 \"coil\"\n$EndPhysicalNames\n$Nodes\n81\n" +
                   "".join(f"{i + 1} {x} {y} {z}\n" for i, (x, y, z) in enumerate(points)) +
                   f"$EndNodes\n$Elements\n{len(elements)}\n" +
                   "".join(f"{i + 1} {element}\n" for i, element in enumerate(elements)) + "$EndElements\n")
        self.run_tool("smooth", "in.msh", "in.vtu", "--fixed-ids", self.all_rows())
        for name in ("in.msh", "in.vtu"):
            for array in ("gmsh:physical", "gmsh:geometrical"):
                with self.subTest(name, array=array):
                    members = {f"{array}=6": area | {8}, f"{array}=4": set(range(9))}
                    self.assert_sets_hold(name, members, *members)
        self.assert_sets_hold("in.msh", {"gmsh:physical=coil": area}, "gmsh:physical=coil")
        self.assert_sets_hold("in.msh", {"gmsh:physical=coil": area}, "coil")
        said = self.run_tool("smooth", "in.msh", "out.msh", "--fixed-set", "coli", expect=WRONG_USAGE).err
        self.assertIn("no point set 'coli' to hold (did you mean 'coil'?); it has: coil, wall; ", said)

    def test_a_material_of_obj_is_named_as_in_the_file(self):
        lines = "".join(f"v {x} {y} {z}\n" for x, y, z in self.grid.points)
        cells = [cell for _, cell in self.grid.cells]
        steel = {v for cell in cells[:20] for v in cell}
        for c, cell in enumerate(cells):
            lines += {0: "usemtl steel\n", 20: "usemtl air\n"}.get(c, "")
            lines += "f " + " ".join(str(v + 1) for v in cell) + "\n"
        self.write("in.obj", lines)
        self.assert_sets_hold("in.obj", {"material=steel": steel}, "material=steel")
        said = self.run_tool("smooth", "in.obj", "out.vtu").err
        self.assertIn("those of material are not written", said)

    def test_a_group_that_overlaps_others_has_all_of_its_cells(self):
        """UNV: each element has one number in the array, that of the smallest group."""
        points, cells = self.grid.points, [cell for _, cell in self.grid.cells]
        large = [c for c, cell in enumerate(cells) if all(2 <= v % 9 <= 5 and 2 <= v // 9 <= 5 for v in cell)]
        small = [c for c in large if all(v % 9 >= 4 for v in cells[c])]
        groups = ""
        for number, members in ((11, large), (12, small)):
            groups += f"{number:10}" + 6 * f"{0:10}" + f"{len(members):10}\ngroup{number}\n"
            groups += "".join(f"{8:10}{c + 1:10}{0:10}{0:10}\n" for c in members)
        self.write("in.unv", "    -1\n  2411\n" +
                   "".join(f"{i + 1:10}{1:10}{1:10}{11:10}\n{x:25.16E}{y:25.16E}{z:25.16E}\n"
                           for i, (x, y, z) in enumerate(points)) + "    -1\n    -1\n  2412\n" +
                   "".join(f"{c + 1:10}{91:10}{1:10}{1:10}{7:10}{3:10}\n" + "".join(f"{v + 1:10}" for v in cell) + "\n"
                           for c, cell in enumerate(cells)) + f"    -1\n    -1\n  2467\n{groups}    -1\n")
        for number, members in ((11, large), (12, small)):
            points_of = {v for c in members for v in cells[c]}
            self.assert_sets_hold("in.unv", {f"unv:group={number}": points_of}, f"unv:group={number}")

    def test_numbers_that_nothing_has_are_refused_with_those_there_are(self):
        self.write_marked(".mesh", lambda i: i)
        refuse = lambda name: self.run_tool("smooth", "in.mesh", "out.mesh", "--fixed-set", name, expect=WRONG_USAGE).err
        said = refuse("medit:ref=99")
        self.assertIn("no point or cell of the file has 'medit:ref=99'", said)
        self.assertIn("'medit:ref' has: 0, 1, 2, 3, ", said)
        self.assertRegex(said, "18, 19 and more\n")
        for name in ("material=7", "medit"):
            self.assertRegex(refuse(name), f"no point set '{name}' to hold.*; it has: .*ARRAY=NUMBER.*: medit:ref\n")
        self.assertFalse(os.path.exists(self.path("out.mesh")))

    def test_global_ids_are_labels(self):
        """Of a file of VTK, as of the pieces that it may have been."""
        count = len(self.grid.points)
        points = "".join(f"{x} {y} {z}\n" for x, y, z in self.grid.points)
        cells = [cell for _, cell in self.grid.cells]
        self.write("in.vtk", f"# vtk DataFile Version 3.0\nplate\nASCII\nDATASET POLYDATA\nPOINTS {count} double\n" + points +
                   f"POLYGONS {len(cells)} {4 * len(cells)}\n" +
                   "".join("3 " + " ".join(map(str, cell)) + "\n" for cell in cells) + f"POINT_DATA {count}\n" +
                   "SCALARS GlobalNodeIds int 1\nLOOKUP_TABLE default\n" +
                   "".join(f"{5 + 7 * (count - i)}\n" for i in range(count)))
        self.assert_holds("in.vtk", lambda i: 5 + 7 * (count - i))
        self.write("labels.txt", "6\n")
        self.run_tool("smooth", "in.vtk", "out.vtk", "--fixed-labels", "labels.txt", expect=BAD_INPUT)
        self.write("in.vtk", self.read("in.vtk").replace(b"\n19\n12\n", b"\n12\n12\n"))
        self.assertIn("several points the number 12", self.run_tool(
            "smooth", "in.vtk", "out.vtk", "--fixed-labels", "labels.txt", expect=WRONG_USAGE).err)


if __name__ == "__main__":
    tool.main()
