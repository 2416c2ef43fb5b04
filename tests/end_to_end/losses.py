"""What an output does not hold of its input is said, in full, whatever else is to be said; what it can hold it holds."""

import re

import sample_meshes
import tool


def vtu_with(root="", piece="", point_data="", cell_data="", more=""):
    grid = sample_meshes.Grid()
    points = " ".join(str(x) for p in grid.points for x in p)
    connectivity = " ".join(str(v) for _, cell in grid.cells for v in cell)
    offsets = " ".join(str(3 * (i + 1)) for i in range(len(grid.cells)))
    return (f'<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian"{root}><UnstructuredGrid>\n'
            f'<Piece NumberOfPoints="{len(grid.points)}" NumberOfCells="{len(grid.cells)}"{piece}>\n'
            f'{point_data}\n{cell_data}\n<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">'
            f'{points}</DataArray></Points>\n<Cells>\n'
            f'<DataArray type="Int32" Name="connectivity" format="ascii">{connectivity}{more}</DataArray>\n'
            f'<DataArray type="Int32" Name="offsets" format="ascii">{offsets}</DataArray>\n'
            f'<DataArray type="UInt8" Name="types" format="ascii">{"5 " * len(grid.cells)}</DataArray>\n'
            '</Cells></Piece></UnstructuredGrid></VTKFile>\n')


def array(name, count, attributes="", kind="Float64", components=1):
    numbers = " ".join(str(i % 7) for i in range(count * components))
    return (f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="ascii"{attributes}>'
            f'{numbers}</DataArray>\n')


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

    def test_attributes_that_nobody_knows_are_told(self):
        count = len(sample_meshes.Grid().points)
        self.write("in.vtu", vtu_with(' creator="me"', ' units="mm"',
                                      "<PointData>" + array("T", count, ' units="K"') + "</PointData>"))
        notes = self.notes("in.vtu", "out.vtu")
        self.assertIn("the attribute 'units' of <DataArray> in line 3 is not kept", notes)
        self.assertIn("the attribute 'units' of <Piece> in line 2 is not kept", notes)
        self.assertIn(b'<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian" creator="me">',
                      self.read("out.vtu"))
        notes = self.notes("in.vtu", "out.vtk")
        self.assertTrue(any("'creator'" in note for note in notes), notes)

    def test_numbers_that_nobody_asked_for_are_told(self):
        self.write("in.vtu", vtu_with(more=" 0 1 2"))
        notes = self.notes("in.vtu", "out.vtu")
        self.assertTrue(any("'connectivity' in line" in note and "is not kept" in note for note in notes), notes)

    def test_units_components_and_active_arrays_get_from_vtu_to_legacy_and_back(self):
        count = len(sample_meshes.Grid().points)
        velocity = array("velocity", count, ' ComponentName0="u" ComponentName1="v" ComponentName2="w"', "Float32", 3)
        units = '<InformationKey name="UNITS_LABEL" location="vtkDataArray">m/s</InformationKey>'
        velocity = velocity.replace("</DataArray>", f"{units}</DataArray>")
        self.write("in.vtu", vtu_with(point_data=f'<PointData Vectors="velocity" Scalars="T">{array("T", count)}'
                                                 f'{velocity}</PointData>'))
        self.assertEqual(self.notes("in.vtu", "out.vtk"), [])
        legacy = self.read("out.vtk")
        self.assertIn(b"\nVECTORS velocity float\n", legacy)
        self.assertIn(b"\nSCALARS T double 1\n", legacy)
        self.assertIn(b"\nMETADATA\nCOMPONENT_NAMES\nu\nv\nw\nINFORMATION 1\n"
                      b"NAME UNITS_LABEL LOCATION vtkDataArray\nDATA m/s\n\n", legacy)
        self.assertEqual(self.notes("out.vtk", "back.vtu"), [])
        back = self.read("back.vtu")
        for part in (b'ComponentName1="v"', b'Vectors="velocity"', b'Scalars="T"', b"m/s"):
            self.assertIn(part, back)

    def test_damaged_xml_behind_appended_data_is_refused(self):
        samples = {name: content for name, content in sample_meshes.every_sample().items()
                   if b"</AppendedData>" in content}
        self.assertGreater(len(samples), 1)
        for name, content in samples.items():
            with self.subTest(name):
                self.write(name, content.replace(b"</VTKFile>", b"</VTKFil"))
                outcome = self.run_tool("quality", name, expect=3)
                self.assertRegex(outcome.err, r"^trismooth: error: .*:\d+: ")

    def test_whole_coordinates_of_a_legacy_file_become_double_where_they_must(self):
        text = ("# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 int\n"
                "0 0 0  10 0 0  10 10 0  0 10 0  3 7 0\nCELLS 4 16\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n"
                "CELL_TYPES 4\n5 5 5 5\n")
        self.write("in.vtk", text)
        self.notes("in.vtk", "out.vtk")
        self.assertEqual(self.read("out.vtk").decode(), text.replace("3 7 0", "5 5 0"))
        self.write("odd.vtk", text.replace("10", "11"))
        self.notes("odd.vtk", "out.vtk")
        self.assertEqual(self.read("out.vtk").decode(),
                         text.replace("10", "11").replace("int", "double").replace("3 7 0", "5.5 5.5 0"))

    def test_a_mesh_of_triangle_strips_alone_is_smoothed_and_its_strips_stay(self):
        points = "0 0 0  1 0 0  2 0 0  0 1 0  1.5 1.25 0  2 1 0  0 2 0  1 2 0  2 2 0"
        strips = "6 0 3 1 4 2 5\n6 3 6 4 7 5 8\n"
        text = (f"# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 9 double\n{points}\n"
                f"TRIANGLE_STRIPS 2 14\n{strips}")
        self.write("in.vtk", text)
        self.assertEqual(self.notes("in.vtk", "out.vtk"), [])
        written = self.read("out.vtk").decode()
        self.assertNotIn("1.5 1.25 0", written)
        self.assertEqual(re.sub(r"0 1 0  \S+ \S+ 0  2 1 0", "0 1 0  1.5 1.25 0  2 1 0", written), text)
        self.write("in.vtp", '<VTKFile type="PolyData" version="1.0"><PolyData><Piece NumberOfPoints="9" '
                   'NumberOfStrips="2"><Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">'
                   f'{points}</DataArray></Points><Strips><DataArray type="Int32" Name="connectivity" format="ascii">'
                   '0 3 1 4 2 5 3 6 4 7 5 8</DataArray><DataArray type="Int32" Name="offsets" format="ascii">6 12'
                   '</DataArray></Strips></Piece></PolyData></VTKFile>')
        self.assertEqual(self.notes("in.vtp", "out.vtp"), [])
        self.assertRegex(self.read("out.vtp").decode().replace("\n", " "), r"0\s+3\s+1\s+4\s+2\s+5\s+3\s+6")
        hashes = {self.report("smooth", name, "out" + name[2:])["coordinates_hash"] for name in ("in.vtk", "in.vtp")}
        self.assertEqual(len(hashes), 1)


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


class Names(tool.ToolTest):

    def notes(self, *arguments):
        return re.findall("^trismooth: note: (.*)$", self.run_tool("smooth", *arguments).err, re.MULTILINE)

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
