# SPDX-License-Identifier: BSD-3-Clause
"""Exodus II and UGRID as netCDF4, meshio and VTK write and read them."""

import os
import shutil
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "end_to_end"))

try:
    import h5py
    import meshio
    import netCDF4
    import numpy
    from vtkmodules.vtkIOExodus import vtkExodusIIReader
except ImportError as missing:
    print(f"skipped: what reads netCDF is not installed where this runs ({missing})")
    sys.exit(77)

import tool

COLUMNS, ROWS = 12, 9
# netCDF4's names of what a file is.
FORMS = ("NETCDF3_CLASSIC", "NETCDF3_64BIT_OFFSET", "NETCDF3_64BIT_DATA", "NETCDF4", "NETCDF4_CLASSIC")


def plate():
    """Points, the inner ones moved about, and triangles; those of the left half first."""
    points, left, right = [], [], []
    for row in range(ROWS + 1):
        for column in range(COLUMNS + 1):
            angle = 2.399963 * len(points)
            inner = 0 < row < ROWS and 0 < column < COLUMNS and column != COLUMNS // 2
            points.append((column + (0.6 * (angle % 1 - 0.5) if inner else 0),
                           row + (0.6 * ((3.7 * angle) % 1 - 0.5) if inner else 0)))
    for row in range(ROWS):
        for column in range(COLUMNS):
            a = row * (COLUMNS + 1) + column
            b, c, d = a + 1, a + COLUMNS + 2, a + COLUMNS + 1
            (left if column < COLUMNS // 2 else right).extend([(a, b, c), (a, c, d)])
    return numpy.array(points), numpy.array(left), numpy.array(right)


def texts(file, name, dimension, values, length="len_name"):
    size = len(file.dimensions[length])
    variable = file.createVariable(name, "S1", (dimension, length))
    variable[:] = netCDF4.stringtochar(numpy.array(values, dtype=f"S{size}"))


def write_exodus(path, form, compress=False):
    """Two blocks, the floor as a side set, corners as a node set, temperatures of two steps."""
    points, left, right = plate()
    with netCDF4.Dataset(path, "w", format=form) as file:
        file.api_version = numpy.float32(8.11)
        file.version = numpy.float32(8.11)
        file.floating_point_word_size = 8
        file.title = "a plate"
        size = {"len_name": 33, "len_string": 33, "num_dim": 2, "num_nodes": len(points), "num_el_blk": 2,
                "num_elem": len(left) + len(right), "num_el_in_blk1": len(left), "num_nod_per_el1": 3,
                "num_el_in_blk2": len(right), "num_nod_per_el2": 3, "num_side_sets": 1,
                "num_side_ss1": COLUMNS // 2, "num_node_sets": 1, "num_nod_ns1": 2, "num_nod_var": 1}
        file.createDimension("time_step", None)
        for name, length in size.items():
            file.createDimension(name, length)
        options = {"zlib": True, "shuffle": True} if compress else {}

        def put(name, kind, dimensions, values, **more):
            variable = file.createVariable(name, kind, dimensions, **more)
            variable[:] = values
            return variable

        put("coordx", "f8", ("num_nodes",), points[:, 0], **options)
        put("coordy", "f8", ("num_nodes",), points[:, 1], **options)
        put("eb_status", "i4", ("num_el_blk",), 1)
        put("eb_prop1", "i4", ("num_el_blk",), [10, 20]).setncattr("name", "ID")
        texts(file, "eb_names", "num_el_blk", ["copper", "air gap"])
        for number, block in ((1, left), (2, right)):
            put(f"connect{number}", "i4", (f"num_el_in_blk{number}", f"num_nod_per_el{number}"),
                block + 1, **options).elem_type = "TRI3"
        put("ss_prop1", "i4", ("num_side_sets",), [7]).setncattr("name", "ID")
        texts(file, "ss_names", "num_side_sets", ["floor"])
        put("elem_ss1", "i4", ("num_side_ss1",), 2 * numpy.arange(COLUMNS // 2) + 1)
        put("side_ss1", "i4", ("num_side_ss1",), 1)
        put("ns_prop1", "i4", ("num_node_sets",), [3]).setncattr("name", "ID")
        texts(file, "ns_names", "num_node_sets", ["corners"])
        put("node_ns1", "i4", ("num_nod_ns1",), [1, COLUMNS + 1])
        texts(file, "name_nod_var", "num_nod_var", ["temperature"])
        put("time_whole", "f8", ("time_step",), [0, 1.5])
        put("vals_nod_var1", "f8", ("time_step", "num_nodes"),
            numpy.stack([points[:, 0], points[:, 1]]))
    return points


def content(path):
    """Everything that netCDF4 sees: variables with their values, storage and attributes."""
    with netCDF4.Dataset(path) as file:
        file.set_auto_maskandscale(False)
        found = {"": {name: str(file.getncattr(name)) for name in file.ncattrs()}}
        for name, variable in file.variables.items():
            found[name] = (variable.dtype, variable.dimensions, variable[:].tolist(),
                           {key: str(variable.getncattr(key)) for key in variable.ncattrs()},
                           str(variable.filters()), str(variable.chunking()), variable.endian())
        return file.data_model, {name: len(size) for name, size in file.dimensions.items()}, found


class NetcdfTest(tool.ToolTest):

    def assert_only_changes(self, before, after, names):
        old, new = content(self.path(before)), content(self.path(after))
        self.assertEqual(old[:2], new[:2])
        self.assertEqual(old[2].keys(), new[2].keys())
        changed = {name for name in old[2] if old[2][name] != new[2][name]}
        self.assertEqual(changed, names)
        for name in changed:
            for part in (0, 1, 3, 4, 5, 6):
                self.assertEqual(old[2][name][part], new[2][name][part])


class Exodus(NetcdfTest):

    def test_every_form_comes_back_with_other_coordinates_alone(self):
        for form in FORMS:
            for compress in (False, True) if form.startswith("NETCDF4") else (False,):
                with self.subTest(form, compress=compress):
                    write_exodus(self.path("in.exo"), form, compress)
                    report = self.report("smooth", "in.exo", "out.exo")
                    self.assertGreater(report["smoothing"]["moved_vertices"], 50)
                    self.assert_only_changes("in.exo", "out.exo", {"coordx", "coordy"})
                    self.write("all.txt", "\n".join(map(str, range((COLUMNS + 1) * (ROWS + 1)))))
                    self.run_tool("smooth", "in.exo", "same.exo", "--fixed-ids", "all.txt")
                    self.assertEqual(self.read("same.exo"), self.read("in.exo"))

    def test_the_form_makes_no_difference(self):
        results = []
        for form in FORMS:
            write_exodus(self.path("in.exo"), form)
            results.append(self.report("smooth", "in.exo", "out.exo")["coordinates_hash"])
        self.assertEqual(len(set(results)), 1)

    def hash_of(self, name):
        return self.report("smooth", name, "out" + os.path.splitext(name)[1])["coordinates_hash"]

    def test_dimensions_are_found_as_older_libraries_and_h5py_have_them(self):
        write_exodus(self.path("in.exo"), "NETCDF4")
        expected = self.hash_of("in.exo")
        shutil.copy(self.path("in.exo"), self.path("references.exo"))
        with h5py.File(self.path("references.exo"), "r+") as file:
            numbers = 0
            for dataset in file.values():
                for name in ("_Netcdf4Coordinates", "_Netcdf4Dimid"):
                    if name in dataset.attrs:
                        del dataset.attrs[name]
                        numbers += 1
        self.assertGreater(numbers, 20)
        self.assertEqual(self.hash_of("references.exo"), expected)
        self.assert_only_changes("references.exo", "out.exo", {"coordx", "coordy"})
        # A file that netCDF has never seen.
        with h5py.File(self.path("in.exo")) as source, h5py.File(self.path("h5py.exo"), "w") as file:
            for name, dataset in source.items():
                if dataset.is_scale:
                    file.create_dataset(name, shape=dataset.shape, maxshape=dataset.maxshape, dtype="f4")
                    file[name].make_scale(name if dataset.ndim == 1 and dataset.id.get_storage_size() else
                                          "This is a netCDF dimension but not a netCDF variable.")
            for name, dataset in source.items():
                if not dataset.is_scale:
                    made = file.create_dataset(name, data=dataset[()])
                    for axis in range(dataset.ndim):
                        made.dims[axis].attach_scale(file[dataset.dims[axis][0].name])
                    for key in ("elem_type",):
                        if key in dataset.attrs:
                            made.attrs[key] = dataset.attrs[key].decode() if isinstance(
                                dataset.attrs[key], bytes) else dataset.attrs[key]
        self.assertEqual(self.hash_of("h5py.exo"), expected)

    def test_without_scales_dimensions_have_no_names_and_the_message_says_what_is_missing(self):
        points = plate()[0]
        with h5py.File(self.path("in.exo"), "w") as file:
            file["coordx"], file["coordy"], file["num_dim"] = points[:, 0], points[:, 1], 2
            file["num_nodes"] = len(points)
        self.assertIn("it has no dimension num_dim", self.run_tool("smooth", "in.exo", "out.exo", expect=None).err)

    def test_orders_of_bytes_chunks_and_checksums_stay(self):
        points = write_exodus(self.path("in.exo"), "NETCDF4")
        expected = self.hash_of("in.exo")
        with netCDF4.Dataset(self.path("in.exo")) as source, netCDF4.Dataset(self.path("big.exo"), "w") as file:
            for name, size in source.dimensions.items():
                file.createDimension(name, None if size.isunlimited() else len(size))
            for name, variable in source.variables.items():
                kind = variable.dtype.str[1:]
                kind = kind if kind == "S1" else ">" + kind
                options = {} if kind == "S1" else {"endian": "big"}
                if name.startswith(("coord", "connect")):
                    options.update(chunksizes=(7, 3)[:variable.ndim], fletcher32=True, zlib=True, shuffle=True)
                if name.startswith("connect"):
                    kind = ">i8"
                made = file.createVariable(name, kind, variable.dimensions, **options)
                made[:] = variable[:]
                made.setncatts({key: variable.getncattr(key) for key in variable.ncattrs()})
        self.assertEqual(self.hash_of("big.exo"), expected)
        self.assert_only_changes("big.exo", "out.exo", {"coordx", "coordy"})
        self.assertEqual(len(points), (COLUMNS + 1) * (ROWS + 1))

    def test_what_was_never_written_is_what_netcdf_says_of_it(self):
        write_exodus(self.path("in.exo"), "NETCDF4")
        with netCDF4.Dataset(self.path("in.exo"), "a") as file:
            file.createDimension("num_elem_sets", 1)
            file.createDimension("num_ele_els1", 2)
            file.createVariable("els_names", "S1", ("num_elem_sets", "len_name"))
            file.createVariable("els_prop1", "i4", ("num_elem_sets",))[:] = 5
            file.createVariable("elem_els1", "i4", ("num_ele_els1",))[:] = [1, 2]
            file.createVariable("num_nodes", "i4", ("num_elem_sets",))[:] = 1  # named as a dimension that it has not
        self.run_tool("smooth", "in.exo", "out.inp")
        with open(self.path("out.inp"), encoding="ascii") as file:
            self.assertRegex(file.read().lower(), "elset=element.set.5\n1, 2")
        self.run_tool("smooth", "in.exo", "out.exo")
        self.assert_only_changes("in.exo", "out.exo", {"coordx", "coordy"})

    def test_sets_are_held_by_their_names(self):
        points = write_exodus(self.path("in.exo"), "NETCDF4")
        for name in ("exodus:block=floor", "corners", "exodus:block=copper"):
            held = self.report("smooth", "in.exo", "out.exo", "--fixed-set", name)
            self.assertGreater(held["smoothing"]["moved_vertices"], 0)
        with netCDF4.Dataset(self.path("out.exo")) as file:
            inside = points[:, 0] <= COLUMNS // 2
            numpy.testing.assert_array_equal(file["coordx"][:][inside], points[inside, 0])

    def test_meshio_s_own_files_come_back(self):
        points, left, right = plate()
        mesh = meshio.Mesh(numpy.column_stack([points, numpy.zeros(len(points))]),
                           [("triangle", left), ("triangle", right)], point_data={"heat": points[:, 0]},
                           point_sets={"corners": numpy.array([0, COLUMNS])})
        meshio.write(self.path("in.e"), mesh)
        self.run_tool("smooth", "in.e", "out.e")
        self.assert_only_changes("in.e", "out.e", {"coord"})
        before, after = meshio.read(self.path("in.e")), meshio.read(self.path("out.e"))
        self.assertTrue((before.points != after.points).any())
        for old, new in zip(before.cells, after.cells):
            numpy.testing.assert_array_equal(old.data, new.data)

    def convert(self):
        """From MSH, with regions, lines around and a named point set by way of Abaqus' names."""
        points, left, right = plate()
        floor = [(i, i + 1) for i in range(COLUMNS)]
        groups = [numpy.full(len(left) + len(right), 1), numpy.full(len(floor), 3)]
        groups[0][len(left):] = 2
        mesh = meshio.Mesh(numpy.column_stack([points, numpy.zeros(len(points))]),
                           [("triangle", numpy.concatenate([left, right])), ("line", numpy.array(floor))],
                           cell_data={"gmsh:physical": groups, "gmsh:geometrical": groups},
                           point_data={"heat": points[:, 0]},
                           field_data={"copper": numpy.array([1, 2]), "air": numpy.array([2, 2]),
                                       "floor": numpy.array([3, 1])})
        meshio.write(self.path("in.msh"), mesh, file_format="gmsh22", binary=True)
        self.run_tool("smooth", "in.msh", "out.exo")
        return left, right, floor

    def test_netcdf4_reads_what_is_written_from_another_format(self):
        left, right, floor = self.convert()
        with netCDF4.Dataset(self.path("out.exo")) as file:
            names = netCDF4.chartostring(file["eb_names"][:])
            self.assertEqual([str(name).rstrip("\0") for name in names], ["copper", "air"])
            numpy.testing.assert_array_equal(file["connect1"][:] - 1, left)
            numpy.testing.assert_array_equal(file["connect2"][:] - 1, right)
            self.assertEqual(file["eb_prop1"][:].tolist(), [1, 2])
            self.assertEqual(file["ss_prop1"][:].tolist(), [3])
            blocks = numpy.concatenate([left, right])
            sides = [(blocks[e - 1][s - 1], blocks[e - 1][s % 3])
                     for e, s in zip(file["elem_ss1"][:], file["side_ss1"][:])]
            self.assertEqual(sides, floor)

    def test_vtk_reads_what_is_written_from_another_format(self):
        left, right, floor = self.convert()
        reader = vtkExodusIIReader()
        reader.SetFileName(self.path("out.exo"))
        reader.UpdateInformation()
        for kind, names in ((reader.ELEM_BLOCK, ["copper", "air"]), (reader.SIDE_SET, ["floor"])):
            self.assertEqual([reader.GetObjectName(kind, i).split(" ")[0]
                              for i in range(reader.GetNumberOfObjects(kind))], names)
            for i in range(reader.GetNumberOfObjects(kind)):
                reader.SetObjectStatus(kind, i, 1)
        reader.SetAllArrayStatus(reader.NODAL, 1)
        reader.Update()
        output = reader.GetOutput()
        blocks = output.GetBlock(0)
        self.assertEqual([blocks.GetBlock(i).GetNumberOfCells() for i in range(2)], [len(left), len(right)])
        sides = output.GetBlock(4)
        self.assertEqual(sides.GetBlock(0).GetNumberOfCells(), len(floor))
        self.assertIsNotNone(blocks.GetBlock(0).GetPointData().GetArray("heat"))

    def test_meshio_reads_what_is_written_from_another_format(self):
        left, right, _ = self.convert()
        mesh = meshio.read(self.path("out.exo"))
        self.assertEqual([block.type for block in mesh.cells], ["triangle", "triangle"])
        numpy.testing.assert_array_equal(mesh.cells[1].data, right)
        numpy.testing.assert_array_equal(mesh.point_data["heat"], plate()[0][:, 0])

    def write_arrays(self):
        """A VTU file of both kinds of arrays, of one component and of three."""
        points, left, right = plate()
        triangles = numpy.concatenate([left, right])
        heat = points[:, 0] ** 2 - 0.1
        speed = numpy.column_stack([points, -points[:, 0]])
        flux = numpy.arange(len(triangles)) / 7
        meshio.write(self.path("in.vtu"), meshio.Mesh(
            numpy.column_stack([points, numpy.zeros(len(points))]), [("triangle", triangles)],
            point_data={"heat": heat, "speed": speed}, cell_data={"flux": [flux]}))
        return heat, speed, flux

    def test_arrays_are_variables_of_one_step_for_netcdf4_vtk_and_meshio(self):
        heat, speed, flux = self.write_arrays()
        self.run_tool("smooth", "in.vtu", "out.exo")
        with netCDF4.Dataset(self.path("out.exo")) as file:
            self.assertEqual(file["time_whole"][:].tolist(), [0])
            names = [str(name).rstrip("\0") for name in netCDF4.chartostring(file["name_nod_var"][:])]
            self.assertEqual(names, ["heat", "speed_x", "speed_y", "speed_z"])
            for i, values in enumerate([heat, *speed.T]):
                numpy.testing.assert_array_equal(file[f"vals_nod_var{i + 1}"][0], values)
            numpy.testing.assert_array_equal(file["vals_elem_var1eb1"][0], flux)
        reader = vtkExodusIIReader()
        reader.SetFileName(self.path("out.exo"))
        reader.UpdateInformation()
        reader.SetAllArrayStatus(reader.NODAL, 1)
        reader.SetAllArrayStatus(reader.ELEM_BLOCK, 1)
        reader.SetSqueezePoints(0)
        reader.Update()
        block = reader.GetOutput().GetBlock(0).GetBlock(0)
        array = block.GetPointData().GetArray("speed_")
        self.assertEqual(array.GetNumberOfComponents(), 3)
        numpy.testing.assert_array_equal([array.GetTuple(i) for i in range(array.GetNumberOfTuples())], speed)
        array = block.GetCellData().GetArray("flux")
        numpy.testing.assert_array_equal([array.GetValue(i) for i in range(array.GetNumberOfTuples())], flux)
        mesh = meshio.read(self.path("out.exo"))
        numpy.testing.assert_array_equal(mesh.point_data["heat"], heat)

    def test_arrays_come_back(self):
        heat, speed, flux = self.write_arrays()
        self.run_tool("smooth", "in.vtu", "out.exo")
        self.run_tool("smooth", "out.exo", "back.vtu")
        mesh = meshio.read(self.path("back.vtu"))
        numpy.testing.assert_array_equal(mesh.point_data["heat"], heat)
        numpy.testing.assert_array_equal(mesh.point_data["speed_y"], speed[:, 1])
        numpy.testing.assert_array_equal(mesh.cell_data["flux"][0], flux)

    def test_annotations_are_variables_and_go_with_a_note(self):
        self.write_arrays()
        self.run_tool("smooth", "in.vtu", "out.exo", "--annotate")
        self.run_tool("quality", "in.vtu", "--annotate", "quality.exo", "--annotate-metrics", "min_angle")
        for name, variables in (("out.exo", {"trismooth:fixed", "trismooth:displacement_x"}),
                                ("quality.exo", {"trismooth:fixed"})):
            with netCDF4.Dataset(self.path(name)) as file:
                names = {str(text).rstrip("\0") for text in netCDF4.chartostring(file["name_nod_var"][:])}
                self.assertLess(variables, names)
        with netCDF4.Dataset(self.path("quality.exo")) as file:
            names = [str(text).rstrip("\0") for text in netCDF4.chartostring(file["name_elem_var"][:])]
            angles = file[f"vals_elem_var{names.index('trismooth:min_angle') + 1}eb1"][0]
            self.assertTrue(((angles > 0) & (angles <= 60.001)).all())
        done = self.run_tool("smooth", "out.exo", "again.exo")
        self.assertIn("made anew without its old annotations", done.out + done.err)
        with netCDF4.Dataset(self.path("again.exo")) as file:
            names = {str(text).rstrip("\0") for text in netCDF4.chartostring(file["name_nod_var"][:])}
            self.assertEqual(names, {"heat", "speed_x", "speed_y", "speed_z"})
        write_exodus(self.path("in.exo"), "NETCDF4")
        done = self.run_tool("smooth", "in.exo", "out.exo", "--annotate")
        self.assertIn("Exodus II files that were read are written back with nothing added", done.out + done.err)


class Ugrid(NetcdfTest):

    def write_coast(self, form, degrees):
        points, left, right = plate()
        with netCDF4.Dataset(self.path("in.nc"), "w", format=form) as file:
            for name, length in (("node", len(points)), ("face", len(left) + len(right)), ("three", 3)):
                file.createDimension(name, length)
            mesh = file.createVariable("mesh2d", "i4", ())
            mesh.setncatts({"cf_role": "mesh_topology", "topology_dimension": numpy.int32(2),
                            "node_coordinates": "node_x node_y", "face_node_connectivity": "faces"})
            for axis, name in enumerate(("node_x", "node_y")):
                variable = file.createVariable(name, "f8", ("node",))
                variable[:] = points[:, axis]
                variable.units = ("degrees_east", "degrees_north")[axis] if degrees else "m"
            faces = file.createVariable("faces", "i4", ("face", "three"), fill_value=-999)
            faces.start_index = numpy.int32(1)
            faces[:] = numpy.concatenate([left, right]) + 1
            depth = file.createVariable("depth", "f8", ("node",))
            depth[:] = 10 + points[:, 0]
        return points

    def test_nodes_and_depths_alone_change(self):
        for form in FORMS:
            with self.subTest(form):
                self.write_coast(form, False)
                self.run_tool("smooth", "in.nc", "out.nc")
                self.assert_only_changes("in.nc", "out.nc", {"node_x", "node_y", "depth"})
                with netCDF4.Dataset(self.path("out.nc")) as file:
                    numpy.testing.assert_allclose(file["depth"][:], 10 + file["node_x"][:], rtol=0, atol=1e-12)
                self.run_tool("smooth", "in.nc", "out.nc", "--fields", "keep")
                self.assert_only_changes("in.nc", "out.nc", {"node_x", "node_y"})

    def test_coordinates_that_are_dimensions_and_names_out_of_order(self):
        """A dimension whose variable comes later than others, variables that have a dimension's name, and groups."""
        points, left, right = plate()
        with netCDF4.Dataset(self.path("in.nc"), "w") as file:
            for name, length in (("three", 3), ("face", len(left) + len(right)), ("node", len(points))):
                file.createDimension(name, length)
            file.createVariable("node", "i4", ("node",))[:] = numpy.arange(len(points))
            file.createVariable("three", "f8", ("face",))[:] = 4  # no coordinate
            mesh = file.createVariable("mesh2d", "i4", ())
            mesh.cf_role, mesh.topology_dimension = "mesh_topology", numpy.int32(2)
            mesh.setncattr_string("node_coordinates", "x y")
            mesh.face_node_connectivity, mesh.face_dimension = "faces", "face"
            for axis, name in enumerate("xy"):
                file.createVariable(name, "f8", ("node",))[:] = points[:, axis]
            faces = file.createVariable("faces", "i8", ("three", "face"))
            faces[:] = numpy.concatenate([left, right]).T
            file.createGroup("other").createVariable("x", "f8", ("node",))[:] = 0
        self.run_tool("smooth", "in.nc", "out.nc", "--fields", "keep")
        self.assert_only_changes("in.nc", "out.nc", {"x", "y"})
        self.run_tool("smooth", "in.nc", "out.vtu", "--fields", "keep")
        mesh = meshio.read(self.path("out.vtu"))
        numpy.testing.assert_array_equal(mesh.cell_data["three"][0], 4)
        numpy.testing.assert_array_equal(mesh.point_data["node"], numpy.arange(len(points)))

    def test_degrees_are_told(self):
        self.write_coast("NETCDF4", True)
        self.assertIn("--geographic", self.run_tool("smooth", "in.nc", "out.nc").err)
        self.run_tool("smooth", "in.nc", "out.nc", "--geographic")
        self.assert_only_changes("in.nc", "out.nc", {"node_x", "node_y", "depth"})

    def test_netcdf4_reads_what_is_written_from_another_format(self):
        points, left, right = plate()
        mesh = meshio.Mesh(numpy.column_stack([points, numpy.zeros(len(points))]),
                           [("triangle", numpy.concatenate([left, right]))], point_data={"depth": points[:, 0]})
        meshio.write(self.path("in.vtu"), mesh)
        self.run_tool("smooth", "in.vtu", "out.nc")
        with netCDF4.Dataset(self.path("out.nc")) as file:
            numpy.testing.assert_array_equal(file["mesh2d_face_nodes"][:], numpy.concatenate([left, right]))
            numpy.testing.assert_array_equal(file["depth"][:], points[:, 0])


if __name__ == "__main__":
    tool.main()
