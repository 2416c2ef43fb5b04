# SPDX-License-Identifier: BSD-3-Clause
"""XDMF with HDF5 beside it: what meshio and, by its files' form, dolfinx write comes back with moved coordinates alone, as
h5py sees it; meshio and VTK read what trismooth writes."""

import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "end_to_end"))

try:
    import h5py
    import meshio
    import numpy
    import vtk
except ImportError as missing:
    print(f"skipped: a package is not installed where this runs ({missing})")
    sys.exit(77)

import meshio_files
import tool

DOLFINX = """<?xml version="1.0"?>
<!DOCTYPE Xdmf SYSTEM "Xdmf.dtd" []>
<Xdmf Version="3.0" xmlns:xi="https://www.w3.org/2001/XInclude">
  <Domain>
    <Grid Name="mesh" GridType="Uniform">
      <Topology TopologyType="Triangle" NumberOfElements="{triangles}" NodesPerElement="3">
        <DataItem Dimensions="{triangles} 3" NumberType="Int" Format="HDF">data.h5:/Mesh/mesh/topology</DataItem>
      </Topology>
      <Geometry GeometryType="XY">
        <DataItem Dimensions="{points} 2" Format="HDF">data.h5:/Mesh/mesh/geometry</DataItem>
      </Geometry>
    </Grid>
    <Grid Name="facet_tags" GridType="Uniform">
      <xi:include xpointer="xpointer(/Xdmf/Domain/Grid/Geometry)" />
      <Topology TopologyType="PolyLine" NumberOfElements="{lines}" NodesPerElement="2">
        <DataItem Dimensions="{lines} 2" NumberType="Int" Format="HDF">data.h5:/MeshTags/facet_tags/topology</DataItem>
      </Topology>
      <Attribute Name="facet_tags" AttributeType="Scalar" Center="Cell">
        <DataItem Dimensions="{lines} 1" Format="HDF">data.h5:/MeshTags/facet_tags/Values</DataItem>
      </Attribute>
    </Grid>
    <Grid Name="cell_tags" GridType="Uniform">
      <xi:include xpointer="xpointer(/Xdmf/Domain/Grid/Geometry)" />
      <Topology TopologyType="Triangle" NumberOfElements="{triangles}" NodesPerElement="3">
        <DataItem Dimensions="{triangles} 3" NumberType="Int" Format="HDF">data.h5:/MeshTags/cell_tags/topology</DataItem>
      </Topology>
      <Attribute Name="cell_tags" AttributeType="Scalar" Center="Cell">
        <DataItem Dimensions="{triangles} 1" Format="HDF">data.h5:/MeshTags/cell_tags/Values</DataItem>
      </Attribute>
    </Grid>
    <Grid Name="u" GridType="Collection" CollectionType="Temporal">
{steps}
    </Grid>
  </Domain>
</Xdmf>
"""

STEP = """      <Grid Name="u" GridType="Uniform">
        <xi:include xpointer="xpointer(/Xdmf/Domain/Grid[@GridType='Uniform'][1]/*[self::Topology or self::Geometry])" />
        <Time Value="{time}" />
        <Attribute Name="u" AttributeType="Scalar" Center="Node">
          <DataItem Dimensions="{points} 1" Format="HDF">data.h5:/Function/u/{time}</DataItem>
        </Attribute>
      </Grid>"""


def datasets(path):
    """Path -> the numbers, type, chunks and compression of each dataset."""
    found = {}
    with h5py.File(path, "r") as file:
        file.visititems(lambda name, item: found.update({name: (item[()], item.dtype, item.chunks, item.compression)})
                        if isinstance(item, h5py.Dataset) else None)
    return found


class XdmfTest(tool.ToolTest):

    def write_dolfinx(self, name, points=None):
        """Two materials and marked sides, as dolfinx writes a mesh, tags in an order of their own and a function."""
        plate, lines, marks, triangles, materials = meshio_files.plate()
        points = plate[:, :2] if points is None else points
        backwards = numpy.array(triangles)[::-1]
        with h5py.File(self.path("data.h5"), "w") as file:
            file["/Mesh/mesh/topology"] = numpy.array(triangles, dtype="i8")
            file.create_dataset("/Mesh/mesh/geometry", data=points, chunks=(16, 2), compression="gzip")
            file["/MeshTags/facet_tags/topology"] = numpy.array(lines, dtype="i8")
            file["/MeshTags/facet_tags/Values"] = numpy.array(marks, dtype="i4").reshape(-1, 1)
            file["/MeshTags/cell_tags/topology"] = backwards[:, [1, 2, 0]]
            file["/MeshTags/cell_tags/Values"] = numpy.array(materials[::-1], dtype="i4").reshape(-1, 1)
            for time in (0, 1):
                file[f"/Function/u/{time}"] = numpy.arange(len(points), dtype="f8").reshape(-1, 1) + time
            file.attrs["kept"] = "as it is"
        counts = {"points": len(points), "lines": len(lines), "triangles": len(triangles)}
        steps = "\n".join(STEP.format(time=time, **counts) for time in (0, 1))
        self.write(name, DOLFINX.format(steps=steps, **counts))
        return points, materials

    def write_meshio(self, name, **options):
        points, lines, marks, triangles, materials = meshio_files.plate()
        mesh = meshio.Mesh(points, [("line", numpy.array(lines)), ("triangle", numpy.array(triangles))],
                           point_data={"depth": numpy.arange(len(points)) / 3},
                           cell_data={"region": [numpy.array(marks), numpy.array(materials)]})
        meshio.write(self.path(name), mesh, **options)
        return mesh

    def assert_only_points_differ(self, before, after, path):
        self.assertEqual(before.keys(), after.keys())
        for name, (values, *form) in before.items():
            self.assertEqual(list(after[name][1:]), form)
            if name != path:
                numpy.testing.assert_array_equal(after[name][0], values)
        moved = (before[path][0] != after[path][0]).any(axis=1).sum()
        self.assertGreater(moved, 50)
        return moved


class WrittenBack(XdmfTest):

    def test_of_dolfinx_files_coordinates_alone_change_and_names_are_led_along(self):
        self.write_dolfinx("in.xdmf")
        before = datasets(self.path("data.h5"))
        report = self.report("smooth", "in.xdmf", "out.xdmf")
        after = datasets(self.path("out_data.h5"))
        moved = self.assert_only_points_differ(before, after, "Mesh/mesh/geometry")
        self.assertEqual(moved, report["smoothing"]["moved_vertices"])
        self.assertEqual(self.read("out.xdmf"), self.read("in.xdmf").replace(b"data.h5", b"out_data.h5"))
        with h5py.File(self.path("out_data.h5")) as file:
            self.assertEqual(file.attrs["kept"], "as it is")
        self.assert_no_temporary_files()
        # And once more, in place.
        self.run_tool("smooth", "out.xdmf", "out.xdmf")
        self.assertEqual(datasets(self.path("out_data.h5")).keys(), before.keys())

    def test_nothing_moved_gives_the_same_bytes(self):
        points, _ = self.write_dolfinx("in.xdmf")
        self.write("all.txt", "\n".join(map(str, range(len(points)))))
        os.mkdir(self.path("there"))
        self.run_tool("smooth", "in.xdmf", "there/in.xdmf", "--fixed-ids", "all.txt")
        # What a file is called may be the name of something else in another folder.
        self.assertEqual(self.read("there/in.xdmf"), self.read("in.xdmf").replace(b"data.h5", b"in_data.h5"))
        self.assertEqual(self.read("there/in_data.h5"), self.read("data.h5"))

    def test_tags_are_regions(self):
        self.write_dolfinx("in.xdmf")
        self.run_tool("smooth", "in.xdmf", "out.vtu")
        mesh = meshio.read(self.path("out.vtu"))
        _, _, marks, triangles, materials = meshio_files.plate()
        blocks = {block.type: index for index, block in enumerate(mesh.cells)}
        numpy.testing.assert_array_equal(mesh.cells[blocks["triangle"]].data, triangles)
        numpy.testing.assert_array_equal(mesh.cell_data["cell_tags"][blocks["triangle"]].ravel(), materials)
        numpy.testing.assert_array_equal(mesh.cell_data["facet_tags"][blocks["line"]].ravel(), marks)
        numpy.testing.assert_array_equal(mesh.point_data["u"].ravel(), 1 + numpy.arange(len(mesh.points)))  # of the last step

    def test_meshio_reads_its_own_files_the_same_but_for_moved_points(self):
        for form in ("HDF", "XML"):
            with self.subTest(form):
                before = self.write_meshio("in.xdmf", data_format=form)
                report = self.report("smooth", "in.xdmf", "out.xdmf")
                after = meshio.read(self.path("out.xdmf"))
                for old, new in zip(before.cells, after.cells):
                    numpy.testing.assert_array_equal(new.data, old.data)
                numpy.testing.assert_array_equal(after.point_data["depth"], before.point_data["depth"])
                for old, new in zip(before.cell_data["region"], after.cell_data["region"]):
                    numpy.testing.assert_array_equal(new, old)
                points = meshio.read(self.path("in.xdmf")).points
                moved = (after.points != points).any(axis=1).sum()
                self.assertEqual(moved, report["smoothing"]["moved_vertices"])

    def test_a_file_that_cannot_be_written_leaves_both_as_they_were(self):
        self.write_meshio("in.xdmf")
        self.write("out.xdmf", "before")
        os.mkdir(self.path("out.h5"))
        self.run_tool("smooth", "in.xdmf", "out.xdmf", expect=None)
        self.assertEqual(self.read("out.xdmf"), b"before")
        self.assert_no_temporary_files()


class Refused(XdmfTest):

    def test_of_time_steps_points_that_move_are_refused_and_points_that_do_not_are_written_back(self):
        points, _ = self.write_dolfinx("in.xdmf")
        text = self.read("in.xdmf").decode()
        begin = text.rindex("<xi:include")
        own = f"""<Topology TopologyType="Triangle"><DataItem Dimensions="216 3" Format="HDF">data.h5:/Mesh/mesh/topology</DataItem>
          </Topology><Geometry GeometryType="XY"><DataItem Dimensions="{len(points)} 2" Format="HDF">data.h5:/again</DataItem></Geometry>"""
        self.write("in.xdmf", text[:begin] + own + text[text.index("/>", begin) + 2:])
        for shift in (0, 1):
            with h5py.File(self.path("data.h5"), "a") as file:
                if "again" in file:
                    del file["again"]
                file["again"] = points + shift
            outcome = self.run_tool("smooth", "in.xdmf", "out.xdmf", expect=3 * shift)
            self.assertIn("a mesh that moves" if shift else "2 time steps", outcome.err)
        after = datasets(self.path("out_data.h5"))
        numpy.testing.assert_array_equal(after["again"][0], after["Mesh/mesh/geometry"][0])

    def test_time_steps_of_meshio_are_read(self):
        points, _, _, triangles, _ = meshio_files.plate()
        before = os.getcwd()
        os.chdir(self.folder)  # where meshio puts the HDF5 file
        try:
            with meshio.xdmf.TimeSeriesWriter("in.xdmf") as writer:
                writer.write_points_cells(points, [("triangle", numpy.array(triangles))])
                for time in (0, 1):
                    writer.write_data(time, point_data={"u": points[:, time]})
        finally:
            os.chdir(before)
        self.assertIn("the last of 2 time steps, t = 1 ", self.run_tool("smooth", "in.xdmf", "out.xdmf").err)
        with meshio.xdmf.TimeSeriesReader(self.path("out.xdmf")) as reader:
            self.assertEqual(len(reader.read_points_cells()[0]), len(points))
            self.assertEqual(reader.num_steps, 2)

    def test_what_is_not_beside_the_file_is_not_read(self):
        self.write_dolfinx("in.xdmf")
        text = self.read("in.xdmf").decode()
        for name in ("../data.h5", "/etc/passwd", "there/data.h5"):
            self.write("in.xdmf", text.replace("data.h5", name))
            self.assertIn("only files beside this one are read", self.run_tool("smooth", "in.xdmf", "out.xdmf", expect=3).err)
        self.write("in.xdmf", text.replace("data.h5", "none.h5"))
        self.assertIn("which is not beside it", self.run_tool("smooth", "in.xdmf", "out.xdmf", expect=3).err)


class Converted(XdmfTest):

    def test_meshio_and_vtk_read_what_is_written_from_another_format(self):
        points, lines, marks, triangles, materials = meshio_files.plate()
        meshio.write(self.path("in.vtu"), meshio.Mesh(
            points, [("line", numpy.array(lines)), ("triangle", numpy.array(triangles))],
            point_data={"depth": numpy.arange(len(points)) / 3},
            cell_data={"region": [numpy.array(marks), numpy.array(materials)]}))
        for target in ("out.xdmf", "-"):
            with self.subTest(target):
                if target == "-":
                    outcome = self.run_tool("smooth", "in.vtu", "-", "--format", "xdmf", "--quiet", expect=None)
                    if outcome.code != 0:
                        self.skipTest(outcome.err)
                    self.write("out.xdmf", outcome.out)
                else:
                    self.run_tool("smooth", "in.vtu", target)
                    self.assertTrue(os.path.exists(self.path("out.h5")))
                mesh = meshio.read(self.path("out.xdmf"))
                numpy.testing.assert_array_equal(mesh.cells_dict["triangle"], triangles)
                numpy.testing.assert_array_equal(mesh.cells_dict["line"], lines)
                numpy.testing.assert_array_equal(mesh.point_data["depth"], numpy.arange(len(points)) / 3)
                numpy.testing.assert_array_equal(mesh.cell_data_dict["region"]["triangle"], materials)
                reader = vtk.vtkXdmfReader()
                reader.SetFileName(self.path("out.xdmf"))
                reader.Update()
                grid = reader.GetOutputDataObject(0)
                self.assertEqual(grid.GetNumberOfPoints(), len(points))
                self.assertEqual(grid.GetNumberOfCells(), len(lines) + len(triangles))
                self.assertEqual(grid.GetCellData().GetArray("region").GetTuple1(len(lines)), materials[0])


if __name__ == "__main__":
    tool.main()
