# SPDX-License-Identifier: BSD-3-Clause
"""What an output does not hold of its input is said, in full, whatever else is to be said; what it can hold it holds."""

import re

import sample_meshes
import tool


def msh(names, elements):
    """Two squares side by side, each cut in four; `elements` gives the physical groups of the lines at the bottom and
    at the top, and of the squares."""
    bottom, top, left, right = elements
    cells = [(1, bottom, (1, 2)), (1, bottom, (2, 3)), (1, top, (4, 5)), (1, top, (5, 6))]
    for group, corners, middle in ((left, (1, 2, 5, 4), 7), (right, (2, 3, 6, 5), 8)):
        cells += [(2, group, (corners[i], corners[(i + 1) % 4], middle)) for i in range(4)]
    return ("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n" + f"{len(names)}\n" +
            "".join(f'{dimension} {number} "{name}"\n' for dimension, number, name in names) + "$EndPhysicalNames\n"
            "$Nodes\n8\n1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0\n7 0.5 0.4 0\n8 1.5 0.6 0\n"
            f"$EndNodes\n$Elements\n{len(cells)}\n" +
            "".join(f"{i + 1} {kind} 2 {group} {group} " + " ".join(map(str, corners)) + "\n"
                    for i, (kind, group, corners) in enumerate(cells)) + "$EndElements\n")


class Losses(tool.ToolTest):

    def notes(self, *arguments):
        return re.findall("^trismooth: note: (.*)$", self.run_tool("smooth", *arguments).err, re.MULTILINE)

    def test_every_loss_of_a_conversion_is_told_without_verbose(self):
        grid = sample_meshes.Grid()
        count = len(grid.points)
        words = "".join(f"words{i} 1 {count} string\n" + "x\n" * count for i in range(12))
        text = sample_meshes.legacy_vtk(grid) + f"\nPOINT_DATA {count}\nFIELD f 12\n{words}".encode()
        self.write("in.vtk", text)
        notes = self.notes("in.vtk", "out.off")
        for i in range(12):
            self.assertEqual(sum(f"'words{i}'" in note for note in notes), 1, notes)
        self.assertTrue(any("OFF holds no" in note for note in notes), notes)
        # They stay where the format stays.
        self.notes("in.vtk", "same.vtk")
        self.assertEqual(self.read("same.vtk").count(b" string\n"), 12)

    def test_a_surface_gets_no_name_of_a_line_in_2dm(self):
        self.write("in.msh", msh([(1, 2, "only"), (2, 1, "one")], (1, 2, 1, 2)))
        notes = self.notes("in.msh", "out.2dm")
        self.assertEqual(re.findall(r"^MAT.*$", self.read("out.2dm").decode(), re.MULTILINE), ['MAT 1 "one"'])
        self.assertTrue(any("not written are only" in note for note in notes), notes)
        self.assertTrue(any("get that of the faces of their number: 1 (one)" in note for note in notes), notes)

    def test_names_and_numbers_that_change_in_unv_are_told(self):
        self.write("in.msh", msh([(1, 1, " lead"), (1, 2, "trail "), (2, 1, "   "), (2, 2, "tab\tx")], (1, 2, 1, 2)))
        notes = self.notes("in.msh", "out.unv")
        self.assertTrue(any("each number once: changed are 1 to 3, 2 (tab_x) to 4" in note for note in notes), notes)
        renamed = [note for note in notes if note.startswith("UNV has names on a line")]
        self.assertEqual(len(renamed), 1, notes)
        for name in ("' lead' (as lead)", "'trail ' (as trail)", "'   ' (as its number)", "(as tab_x)"):
            self.assertIn(name, renamed[0])

    def test_names_that_unv_keeps_are_no_loss(self):
        self.write("in.msh", msh([(1, 1, "a"), (1, 2, "b"), (2, 3, "c"), (2, 4, "d")], (1, 2, 3, 4)))
        notes = self.notes("in.msh", "out.unv")
        self.assertEqual([note for note in notes if "changed" in note or "names" in note], [])

    def test_names_that_ply_does_not_hold_are_told(self):
        self.write("in.msh", msh([(1, 2, "only"), (2, 1, "one")], (1, 2, 1, 2)))
        notes = self.notes("in.msh", "out.ply")
        self.assertTrue(any("PLY holds no names of values: those of gmsh:physical" in note for note in notes), notes)


if __name__ == "__main__":
    tool.main()
