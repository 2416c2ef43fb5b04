# SPDX-License-Identifier: BSD-3-Clause
"""Files that Gmsh writes come back from trismooth with nothing lost, and Gmsh opens them with every group in place."""

import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "end_to_end"))

try:
    import gmsh
    import gmsh_model
    import hdf5_values
except (ImportError, OSError) as missing:
    print(f"skipped: Gmsh or h5py for Python is not installed where this runs ({missing})")
    sys.exit(77)

import nastran_columns
import number_texts
import part_groups
import tool

# name -> (extension, options of Gmsh, whether the file is text, whether Gmsh reads the format itself)
TEXT_DIALECTS = {
    "msh41": (".msh", {"MshFileVersion": 4.1, "Binary": 0}),
    "msh40": (".msh", {"MshFileVersion": 4.0, "Binary": 0}),
    "msh22": (".msh", {"MshFileVersion": 2.2, "Binary": 0}),
    "medit": (".mesh", {"Binary": 0}),
    "su2": (".su2", {"Binary": 0}),
    "inp": (".inp", {"Binary": 0, "SaveGroupsOfNodes": 1}),
    "nastran_free": (".bdf", {"BdfFieldFormat": 0}),
    "unv": (".unv", {"SaveGroupsOfNodes": 0}),
    "unv_nodes": (".unv", {"SaveGroupsOfNodes": 1}),
}
COLUMN_DIALECTS = {
    "nastran_small": (".bdf", {"BdfFieldFormat": 1}),
    "nastran_large": (".bdf", {"BdfFieldFormat": 2}),
}
BINARY_DIALECTS = {
    "msh41_binary": (".msh", {"MshFileVersion": 4.1, "Binary": 1}),
    "msh22_binary": (".msh", {"MshFileVersion": 2.2, "Binary": 1}),
}
# Kept by HDF5.
HDF5_DIALECTS = {
    "med": (".med", {}),
    "cgns": (".cgns", {}),
}
# What Gmsh both writes and reads in full.
MSH = ("msh41", "msh40", "msh22", "msh41_binary", "msh22_binary")
EVERY_DIALECT = {**TEXT_DIALECTS, **COLUMN_DIALECTS, **BINARY_DIALECTS, **HDF5_DIALECTS}


class GmshTest(tool.ToolTest):

    def setUp(self):
        super().setUp()
        model = gmsh_model.session()
        model.__enter__()
        self.addCleanup(model.__exit__, None, None, None)

    def write_model(self, dialect, **model):
        extension, options = EVERY_DIALECT[dialect]
        gmsh_model.build(**model)
        name = dialect + extension
        gmsh_model.write(self.path(name), **options)
        return name

    def smooth(self, name, output=None, *options):
        output = output or "smoothed" + os.path.splitext(name)[1]
        return output, self.report("smooth", name, output, *options)

    def hold_everything(self, count):
        self.write("all.txt", "\n".join(map(str, range(count))))
        return "--fixed-ids", "all.txt"


class WrittenBack(GmshTest):

    def test_nothing_moved_gives_the_same_bytes(self):
        for dialect in EVERY_DIALECT:
            # SU2 has no elements of second order.
            for order in (1, 2) if dialect != "su2" else (1,):
                with self.subTest(dialect=dialect, order=order):
                    name = self.write_model(dialect, order=order)
                    held = self.hold_everything(self.report("quality", name)["input"]["vertices"])
                    output, report = self.smooth(name, None, *held)
                    self.assertEqual(report["smoothing"]["moved_vertices"], 0)
                    self.assertEqual(self.read(output), self.read(name))

    def test_texts_differ_in_the_numbers_of_moved_nodes_alone(self):
        for dialect in TEXT_DIALECTS:
            with self.subTest(dialect):
                name = self.write_model(dialect)
                output, report = self.smooth(name)
                changed = number_texts.changed_numbers(self.read(name), self.read(output))
                moved = report["smoothing"]["moved_vertices"]
                self.assertGreater(moved, 100)
                # One number of a node may stay as it is.
                self.assertLessEqual(len(changed), 2 * moved)
                self.assertGreaterEqual(len(changed), moved)

    def test_columns_differ_in_the_numbers_of_moved_nodes_alone(self):
        for dialect in COLUMN_DIALECTS:
            for order in (1, 2):
                with self.subTest(dialect=dialect, order=order):
                    name = self.write_model(dialect, order=order)
                    output, report = self.smooth(name)
                    changed = nastran_columns.changed_numbers(self.read(name), self.read(output))
                    moved = report["smoothing"]["moved_vertices"]
                    self.assertGreater(moved, 100)
                    self.assertGreaterEqual(len(changed), moved)
                    if order == 1:
                        self.assertLessEqual(len(changed), 2 * moved)

    def test_binary_files_keep_their_size(self):
        for dialect in BINARY_DIALECTS:
            with self.subTest(dialect):
                name = self.write_model(dialect)
                output, _ = self.smooth(name)
                self.assertEqual(len(self.read(output)), len(self.read(name)))
                self.assertNotEqual(self.read(output), self.read(name))

    def test_hdf5_differs_in_the_coordinates_of_moved_nodes_alone(self):
        for dialect in HDF5_DIALECTS:
            for model in ({}, {"order": 2}, {"quads": True}):
                with self.subTest(dialect=dialect, **model):
                    name = self.write_model(dialect, **model)
                    output, report = self.smooth(name)
                    changed = hdf5_values.changed(self.path(name), self.path(output))
                    self.assertLessEqual({path.rsplit("/", 2)[-1 if dialect == "med" else -2] for path in changed},
                                         {"COO", "CoordinateX", "CoordinateY"})
                    moved = report["smoothing"]["moved_vertices"]
                    self.assertGreater(moved, 100)
                    if model.get("order", 1) == 1:
                        self.assertGreaterEqual(sum(changed.values()), moved)
                        self.assertLessEqual(sum(changed.values()), 2 * moved)

    def test_every_dialect_of_one_model_gives_the_same_places(self):
        # Gmsh writes 16 digits as text, which is not always all of a number.
        for dialects in (("msh41", "msh40", "msh22"), ("msh41_binary", "msh22_binary")):
            hashes = {dialect: self.smooth(self.write_model(dialect))[1]["coordinates_hash"] for dialect in dialects}
            self.assertEqual(len(set(hashes.values())), 1, hashes)


class OpenedByGmsh(GmshTest):
    """Judged by what Gmsh's own reader finds in both files."""

    def open_both(self, name, output):
        found = []
        for path in (name, output):
            gmsh_model.open_file(self.path(path))
            found.append((gmsh_model.everything_but_points(), gmsh_model.points()))
        (known, before), (known_after, after) = found
        self.assertEqual(known_after, known)
        self.assertEqual(after.keys(), before.keys())
        return before, after

    def assert_only_inner_nodes_moved(self, name, before, after):
        gmsh_model.open_file(self.path(name))
        inner = {int(tag) for _, surface in gmsh.model.getEntities(2) for tag in gmsh.model.mesh.getNodes(2, surface)[0]}
        moved = {tag for tag in before if before[tag] != after[tag]}
        self.assertGreater(len(moved), 100)
        self.assertLessEqual(moved, inner)

    def test_groups_names_elements_and_periods_are_in_place(self):
        for dialect in MSH:
            for model in ({}, {"order": 2}, {"quads": True}):
                with self.subTest(dialect=dialect, **model):
                    name = self.write_model(dialect, **model)
                    output, _ = self.smooth(name)
                    before, after = self.open_both(name, output)
                    self.assertEqual({name for name, _ in gmsh_model.everything_but_points()["groups"].values()},
                                     set(gmsh_model.GROUPS.values()))
                    if model.get("order", 1) == 1:
                        self.assert_only_inner_nodes_moved(name, before, after)

    def test_properties_and_elements_of_nastran_are_in_place(self):
        for dialect in ("nastran_free", "nastran_small", "nastran_large"):
            for model in ({}, {"order": 2}, {"quads": True}):
                with self.subTest(dialect=dialect, **model):
                    name = self.write_model(dialect, **model)
                    output, report = self.smooth(name)
                    before, after = self.open_both(name, output)
                    moved = sum(before[tag] != after[tag] for tag in before)
                    self.assertGreater(moved, 100)
                    if model.get("order", 1) == 1:
                        self.assertEqual(moved, report["smoothing"]["moved_vertices"])

    def test_groups_and_elements_of_unv_are_in_place(self):
        for dialect in ("unv", "unv_nodes"):
            for model in ({}, {"order": 2}, {"quads": True}):
                with self.subTest(dialect=dialect, **model):
                    extension, options = EVERY_DIALECT[dialect]
                    gmsh_model.build(**model)
                    # Gmsh writes no elements of points, and does not survive reading a group of them.
                    gmsh.model.removePhysicalGroups([(0, 11)])
                    name = dialect + extension
                    gmsh_model.write(self.path(name), **options)
                    output, report = self.smooth(name)
                    before, after = self.open_both(name, output)
                    moved = sum(before[tag] != after[tag] for tag in before)
                    self.assertGreater(moved, 100)
                    if model.get("order", 1) == 1:
                        self.assertEqual(moved, report["smoothing"]["moved_vertices"])
                    names = {name for name, _ in gmsh_model.everything_but_points()["groups"].values()}
                    self.assertLessEqual({"air", "steel_core", "inlet", "outlet", "walls", "hole"}, names)

    def test_groups_names_and_elements_of_hdf5_are_in_place(self):
        for dialect in HDF5_DIALECTS:
            for model in ({}, {"order": 2}, {"quads": True}):
                with self.subTest(dialect=dialect, **model):
                    name = self.write_model(dialect, **model)
                    output, report = self.smooth(name)
                    before, after = self.open_both(name, output)
                    moved = sum(before[tag] != after[tag] for tag in before)
                    if model.get("order", 1) == 1:
                        self.assertEqual(moved, report["smoothing"]["moved_vertices"])
                    groups = {name.strip() for name, _ in gmsh_model.everything_but_points()["groups"].values()}
                    self.assertEqual(groups, set(gmsh_model.GROUPS.values()))

    def test_partitions_and_ghosts_are_in_place(self):
        gmsh_model.build()
        gmsh.option.setNumber("Mesh.PartitionCreateGhostCells", 1)
        gmsh.model.mesh.partition(3)
        for dialect in ("msh41", "msh41_binary", "msh22", "msh22_binary"):
            with self.subTest(dialect):
                extension, options = EVERY_DIALECT[dialect]
                gmsh_model.build()
                gmsh.option.setNumber("Mesh.PartitionCreateGhostCells", 1)
                gmsh.model.mesh.partition(3)
                gmsh_model.write(self.path("parts" + extension), **options)
                output, _ = self.smooth("parts" + extension)
                before, after = self.open_both("parts" + extension, output)
                self.assertNotEqual(before, after)

    def test_parametric_nodes_are_where_their_parameters_say(self):
        for dialect in ("msh41", "msh41_binary"):
            with self.subTest(dialect):
                extension, options = EVERY_DIALECT[dialect]
                gmsh_model.build()
                # Nodes of setNode() have no parameters: mesh anew.
                gmsh.model.mesh.clear()
                gmsh.model.mesh.generate(2)
                gmsh_model.write(self.path("uv" + extension), SaveParametric=1, **options)
                output, _ = self.smooth("uv" + extension)
                gmsh_model.open_file(self.path("uv" + extension))
                before, places = gmsh_model.parameters(), gmsh_model.points()
                gmsh_model.open_file(self.path(output))
                after, moved = gmsh_model.parameters(), gmsh_model.points()
                self.assertEqual(after.keys(), before.keys())
                # Gmsh's parameters of a plane surface are its x and y, but for a shift and a turn: lengths agree.
                tags = [tag for tag in after if moved[tag] != places[tag]]
                self.assertGreater(len(tags), 50)
                for tag in tags:
                    way = [q - p for p, q in zip(places[tag][:2], moved[tag][:2])]
                    parameters = [q - p for p, q in zip(before[tag], after[tag])]
                    self.assertAlmostEqual(way[0]**2 + way[1]**2, parameters[0]**2 + parameters[1]**2, delta=1e-12)

    def test_embedded_curves_and_points_stay_though_the_file_has_no_elements_of_them(self):
        msh_sets = {"gmsh:points": (3, True), "gmsh:curves": (4, True)}
        for dialect, held in (("msh41", msh_sets), ("msh40", msh_sets), ("msh41_binary", msh_sets),
                              ("medit", {"medit:ref": (7, True)})):
            with self.subTest(dialect):
                extension, options = EVERY_DIALECT[dialect]
                gmsh_model.build_embedded()
                name = "embedded" + extension
                gmsh_model.write(self.path(name), **options)
                bound = {int(tag) for dimension in (0, 1) for _, entity in gmsh.model.getEntities(dimension)
                         for tag in gmsh.model.mesh.getNodes(dimension, entity)[0]}
                output, report = self.smooth(name)
                before, after = self.open_both(name, output)
                self.assertEqual(len(gmsh.model.mesh.getElements(1)[0]), 0)
                moved = {tag for tag in before if before[tag] != after[tag]}
                self.assertGreater(len(moved), 40)
                self.assertFalse(moved & bound)
                sets = {found["name"]: found for found in report["input"]["point_sets"]}
                self.assertEqual({name: (found["vertices"], found["holds"]) for name, found in sets.items()}, held)
                freed, _ = self.smooth(name, None, "--fixed-set", "none")
                before, after = self.open_both(name, freed)
                self.assertTrue(bound & {tag for tag in before if before[tag] != after[tag]})

    def test_old_files_with_parameters_are_read(self):
        # Gmsh itself does not read version 1 with parameters.
        for version, binary in ((1, 0), (2.2, 0), (2.2, 1)):
            with self.subTest(version=version, binary=binary):
                gmsh_model.build()
                gmsh.model.mesh.clear()
                gmsh.model.mesh.generate(2)
                for name, parametric in (("plain.msh", 0), ("uv.msh", 1)):
                    gmsh_model.write(self.path(name), MshFileVersion=version, Binary=binary, SaveParametric=parametric)
                _, plain = self.smooth("plain.msh", "plain_out.msh")
                _, report = self.smooth("uv.msh", "uv_out.msh")
                self.assertGreater(report["smoothing"]["moved_vertices"], 100)
                self.assertEqual(report["coordinates_hash"], plain["coordinates_hash"])
                # Read again, they are the same places.
                _, again = self.smooth("uv_out.msh", "again.msh", "--max-sweeps", "1", "--fixed-ids",
                                       self.hold_everything(report["input"]["vertices"])[1])
                self.assertEqual(again["coordinates_hash"], report["coordinates_hash"])
                if version > 1:
                    gmsh_model.open_file(self.path("uv_out.msh"))
                    places = gmsh_model.points()
                    gmsh_model.open_file(self.path("plain_out.msh"))
                    self.assertEqual(gmsh_model.points(), places)

    def test_views_are_kept(self):
        name = self.write_model("msh41")
        tags = list(map(int, gmsh.model.mesh.getNodes()[0]))
        view = gmsh.view.add("temperature")
        gmsh.view.addModelData(view, 0, "channel", "NodeData", tags, [[float(tag)] for tag in tags])
        gmsh.option.setNumber("PostProcessing.SaveMesh", 0)
        gmsh.view.write(view, self.path(name), append=True)
        output, _ = self.smooth(name)
        self.open_both(name, output)
        gmsh_model.open_file(self.path(output))
        _, again, values, _, _ = gmsh.view.getModelData(gmsh.view.getTags()[0], 0)
        self.assertEqual([(int(tag), value[0]) for tag, value in zip(again, values)], [(tag, float(tag)) for tag in tags])


    def test_annotations_are_views(self):
        for dialect in MSH:
            with self.subTest(dialect):
                name = self.write_model(dialect)
                plain, _ = self.smooth(name)
                annotated, _ = self.smooth(name, "annotated.msh", "--annotate")
                self.assertTrue(self.read(annotated).startswith(self.read(plain)))
                gmsh_model.open_file(self.path(name))
                places = gmsh_model.points()
                before = self.qualities()
                known, after = self.open_both(plain, annotated)
                self.assertEqual(known, after)
                views = {gmsh.option.getString(f"View[{i}].Name"): gmsh.view.getModelData(tag, 0)
                         for i, tag in enumerate(gmsh.view.getTags())}
                self.assertEqual(sorted(views), ["trismooth:displacement", "trismooth:fixed", "trismooth:shape",
                                                 "trismooth:shape_before"])
                values = {name: (kind, {int(tag): tuple(row) for tag, row in zip(tags, rows)})
                          for name, (kind, tags, rows, _, _) in views.items()}
                displacement, fixed = values["trismooth:displacement"][1], values["trismooth:fixed"][1]
                self.assertEqual(displacement, {tag: tuple(q - p for p, q in zip(places[tag], after[tag]))
                                                for tag in places})
                self.assertEqual(fixed.keys(), places.keys())
                self.assertEqual({displacement[tag] for tag in fixed if fixed[tag] == (1.0,)}, {(0.0, 0.0, 0.0)})
                self.assertEqual({kind for kind, _ in values.values()}, {"NodeData", "ElementData"})
                for view, expected in (("trismooth:shape", self.qualities()), ("trismooth:shape_before", before)):
                    shapes = values[view][1]
                    self.assertGreater(len(expected), 500)
                    for tag, quality in expected.items():
                        self.assertAlmostEqual(shapes[tag][0], quality, places=12)

    def qualities(self):
        """Gmsh's own measure of each triangle, which is the shape."""
        tags = [int(tag) for kind, elements in zip(*gmsh.model.mesh.getElements(2)[:2]) if kind == 2
                for tag in elements]
        return dict(zip(tags, gmsh.model.mesh.getElementQualities(tags, "minSICN")))

    def test_annotations_of_version_1_are_said_to_be_left_out(self):
        gmsh_model.build()
        gmsh_model.write(self.path("old.msh"), MshFileVersion=1, Binary=0)
        outcome = self.run_tool("smooth", "old.msh", "out.msh", "--annotate", "--verbose")
        self.assertIn("--annotate has no effect: Gmsh MSH files of version 1, or with tags above 2147483647, that were "
                      "read are written back with nothing added",
                      " ".join(outcome.err.split()))


class OtherFormatsBecomeMsh(GmshTest):

    def test_groups_and_names_reach_gmsh(self):
        # What each format keeps of the groups: those of points are in none but MSH.
        for dialect, dimensions in {"msh22": (1, 2), "su2": (1,), "inp": (1, 2)}.items():
            with self.subTest(dialect):
                name = self.write_model(dialect)
                expected = {key: cells for key, cells in gmsh_model.group_cells().items() if key[0] in dimensions}
                if dialect == "inp":
                    # Gmsh leaves no blanks in them.
                    expected = {(key[0], key[1].replace(" ", "_")): cells for key, cells in expected.items()}
                held = self.hold_everything(self.report("quality", name)["input"]["vertices"])
                self.run_tool("smooth", name, "converted.msh", *held)
                gmsh_model.open_file(self.path("converted.msh"))
                found = gmsh_model.group_cells()
                # An input file has a set for each entity as well.
                self.assertLessEqual(set(expected), set(found))
                for key, cells in expected.items():
                    self.assertEqual(len(found[key]), len(cells), key)


class MshBecomesUnv(GmshTest):

    def test_groups_names_and_elements_reach_gmsh(self):
        for model in ({}, {"order": 2}, {"quads": True}):
            with self.subTest(**model):
                name = self.write_model("msh41", **model)
                gmsh_model.open_file(self.path(name))
                expected = {key: cells for key, cells in gmsh_model.group_cells().items() if key[0] > 0}
                self.assertEqual(len(expected), 6)
                held = self.hold_everything(self.report("quality", name)["input"]["vertices"])
                self.run_tool("smooth", name, "converted.unv", *held)
                gmsh_model.open_file(self.path("converted.unv"))
                found = gmsh_model.group_cells()
                for (dimension, name), cells in expected.items():
                    # Gmsh reads a name up to its first blank.
                    self.assertEqual(self.rounded(found[dimension, name.split()[0]]), self.rounded(cells), name)

    def test_quadrilaterals_of_nine_nodes_keep_their_order(self):
        gmsh_model.build(order=2, quads=True)
        expected = self.quadrilaterals()
        self.assertGreater(len(expected), 10)
        gmsh_model.write(self.path("nine.unv"))
        gmsh_model.write(self.path("nine.msh"), MshFileVersion=4.1)
        held = self.hold_everything(self.report("quality", "nine.msh")["input"]["vertices"])
        self.run_tool("smooth", "nine.unv", "from_unv.msh", *held)
        gmsh_model.open_file(self.path("from_unv.msh"))
        self.assertEqual(self.quadrilaterals(), expected)
        # Gmsh reads the corners of such elements, which have to be these.
        self.run_tool("smooth", "nine.msh", "to.unv", *held)
        gmsh_model.open_file(self.path("to.unv"))
        self.assertEqual(self.quadrilaterals(kind=3), sorted(cell[:4] for cell in expected))

    def quadrilaterals(self, kind=10):
        """Their nodes' places, in the order of Gmsh: corners first."""
        where = gmsh_model.points()
        elements, nodes = gmsh.model.mesh.getElementsByType(kind)
        places = [tuple(round(float(x), 12) for x in where[int(node)]) for node in nodes]
        each = len(places) // len(elements)
        return sorted(tuple(places[i:i + each]) for i in range(0, len(places), each))

    def rounded(self, cells):
        """Gmsh itself lays periodic nodes of MSH files on each other, to the last digit."""
        return sorted(tuple(sorted(tuple(round(float(x), 12) for x in place) for place in cell)) for cell in cells)


class MshBecomesHdf5(GmshTest):

    def test_groups_names_and_elements_reach_gmsh(self):
        for dialect in HDF5_DIALECTS:
            for model in ({}, {"order": 2}, {"quads": True}):
                with self.subTest(dialect=dialect, **model):
                    name = self.write_model("msh41", **model)
                    gmsh_model.open_file(self.path(name))
                    expected = self.groups()
                    self.assertEqual(len(expected), 7)
                    held = self.hold_everything(self.report("quality", name)["input"]["vertices"])
                    self.run_tool("smooth", name, "converted." + dialect, *held)
                    gmsh_model.open_file(self.path("converted." + dialect))
                    self.assertEqual(self.groups(), expected)

    def groups(self):
        # MED fills names up with blanks. Gmsh lays periodic nodes of MSH files on each other, to the last digit.
        return {(dimension, name.strip()): sorted(tuple(sorted(tuple(round(float(x), 12) for x in place)
                                                               for place in cell)) for cell in cells)
                for (dimension, name), cells in gmsh_model.group_cells().items()}


class PartsInGroups(GmshTest):

    def test_msh_with_groups_for_a_part_of_the_cells_is_opened_and_saved_again_with_all_of_them(self):
        for name, content in part_groups.FILES.items():
            with self.subTest(name):
                self.write(name, content())
                self.run_tool("smooth", name, "out.msh")
                gmsh.clear()
                gmsh.open(self.path("out.msh"))
                gmsh.write(self.path("again.msh"))
                gmsh.clear()
                gmsh.open(self.path("again.msh"))
                for dimension, kind, count in ((2, 2, part_groups.TRIANGLES), (1, 1, part_groups.LINES)):
                    types, tags, _ = gmsh.model.mesh.getElements(dimension)
                    self.assertEqual({int(t): len(of_type) for t, of_type in zip(types, tags)}, {kind: count})


if __name__ == "__main__":
    tool.main()
