# SPDX-License-Identifier: BSD-3-Clause
"""Annotations: right values, replaced by a later run, never taken for input; a file's own arrays stay."""

import os
import re

import mesh_reader
import planar_geometry
import sample_meshes
import tool

WRONG_USAGE, NOT_WRITTEN = 2, 4
PREFIX = "trismooth:"


def samples():
    grid = sample_meshes.Grid(others=True)
    return {"a.vtk": sample_meshes.legacy_vtk(grid), "b.vtk": sample_meshes.legacy_vtk(grid, True, "5.1", True),
            "a.vtu": sample_meshes.vtu(grid, "appended raw", compressed=True), "a.vtp": sample_meshes.vtp(grid)}


def extension(name):
    return os.path.splitext(name)[1]


class Annotations(tool.ToolTest):

    def mesh(self, name):
        return mesh_reader.read(self.path(name))

    def assert_own_arrays_stay(self, before, after):
        """Of everything that is no annotation, nothing is gone, new or changed."""
        for table in ("cell_arrays", "point_arrays"):
            own = {name: rows for name, rows in getattr(after, table).items() if not name.startswith(PREFIX)}
            self.assertEqual(own, {name: rows for name, rows in getattr(before, table).items()
                                   if not name.startswith(PREFIX)})
        self.assertEqual(after.cells, before.cells)

    def assert_annotated(self, mesh, cells, points):
        for table, names in ((mesh.cell_arrays, cells), (mesh.point_arrays, points)):
            self.assertEqual({name for name in table if name.startswith(PREFIX)}, {PREFIX + name for name in names})

    def test_smoothing_shows_before_and_after(self):
        for name, content in samples().items():
            with self.subTest(name):
                self.write(name, content)
                output = "out" + extension(name)
                report = self.report("smooth", name, output, "--annotate", "--annotate-metrics", "shape,min_angle")
                before, after = self.mesh(name), self.mesh(output)
                self.assert_own_arrays_stay(before, after)
                self.assert_annotated(after, {"shape", "shape_before", "min_angle", "min_angle_before"},
                                      {"fixed", "displacement"})
                fixed = planar_geometry.fixed_vertices(before)
                self.assertEqual([flag for flag, in after.point_arrays[PREFIX + "fixed"]],
                                 [int(v in fixed) for v in range(len(before.points))])
                for p, q, d in zip(before.points, after.points, after.point_arrays[PREFIX + "displacement"]):
                    self.assertEqual(d, tuple(b - a for a, b in zip(p, q)))
                elements = {cell for cell, _ in after.elements()}
                for metric in ("shape", "min_angle"):
                    for stage, suffix in (("before", "_before"), ("after", "")):
                        rows = after.cell_arrays[PREFIX + metric + suffix]
                        self.assertEqual({value for cell, (value,) in enumerate(rows) if cell not in elements}, {0})
                        self.assertAlmostEqual(min(rows[cell][0] for cell in elements),
                                               report[stage]["metrics"][metric]["min"], places=12)

    def test_quality_writes_the_mesh_as_it_is_with_what_was_found(self):
        for name, content in samples().items():
            with self.subTest(name):
                self.write(name, content)
                output = "out" + extension(name)
                report = self.report("quality", name, "--annotate", output, "--annotate-metrics", "max_angle,shape")
                before, after = self.mesh(name), self.mesh(output)
                self.assertEqual(after.points, before.points)
                self.assert_own_arrays_stay(before, after)
                self.assert_annotated(after, {"max_angle", "shape"}, {"fixed"})
                self.assertEqual(max(value for value, in after.cell_arrays[PREFIX + "max_angle"]),
                                 report["before"]["metrics"]["max_angle"]["max"])
                self.assertEqual(sum(flag for flag, in after.point_arrays[PREFIX + "fixed"]),
                                 report["input"]["fixed_vertices"])
                self.assertIsNone(report["after"])
                self.assertEqual(report["options"]["output"], output)

    def test_annotating_again_replaces_what_was_written_before(self):
        for name, content in samples().items():
            with self.subTest(name):
                self.write(name, content)
                kind = extension(name)
                once, twice, other = f"once{kind}", f"twice{kind}", f"other{kind}"
                self.run_tool("quality", name, "--annotate", once)
                self.run_tool("smooth", name, other, "--annotate", "--annotate-metrics", "area,condition", "--method",
                              "laplacian", "--max-sweeps", "0", "--tolerance", "1e9")
                self.run_tool("quality", once, "--annotate", twice)
                self.assertEqual(self.read(twice), self.read(once))
                self.run_tool("quality", other, "--annotate", twice, "--annotate-metrics", "edge_ratio")
                self.assert_own_arrays_stay(self.mesh(name), self.mesh(twice))
                self.assert_annotated(self.mesh(twice), {"edge_ratio"}, {"fixed"})
                # In another format, too.
                for target in ("converted.vtk", "converted.vtu"):
                    self.run_tool("quality", other, "--annotate", target, "--quiet")
                    self.assert_annotated(self.mesh(target), {"shape"}, {"fixed"})

    def test_what_can_hold_no_annotations_is_refused_with_extensions_that_can(self):
        self.write("a.vtk", samples()["a.vtk"])
        error = self.run_tool("quality", "a.vtk", "--annotate", "shape.off", expect=2).err
        named = re.search(r"'shape.off' can hold no arrays; formats that do are (\.ply, \.vtk, [a-z., ]*[a-z])", error)
        self.assertTrue(named, error)
        for extension in named[1].split(", "):
            with self.subTest(extension=extension):
                self.run_tool("quality", "a.vtk", "--annotate", "shape" + extension)

    def test_a_run_on_annotated_output_is_one_on_the_plain_output(self):
        for name, content in samples().items():
            with self.subTest(name):
                self.write(name, content)
                kind = extension(name)
                self.run_tool("smooth", name, f"plain{kind}", "--max-sweeps", "2")
                self.run_tool("smooth", name, f"annotated{kind}", "--max-sweeps", "2", "--annotate",
                              "--annotate-metrics", "shape,area,edge_ratio")
                plain = self.report("smooth", f"plain{kind}", f"plain_out{kind}")
                annotated = self.report("smooth", f"annotated{kind}", f"annotated_out{kind}")
                for key in ("coordinates_hash", "before", "after"):
                    self.assertEqual(annotated[key], plain[key])
                self.assertEqual({**annotated["input"], "path": ""}, {**plain["input"], "path": ""})

    def test_annotations_of_an_earlier_run_are_never_left_stale(self):
        for name, content in samples().items():
            for target in ("c" + extension(name), "c.vtk", "c.vtu"):
                with self.subTest(name, target=target):
                    self.write(name, content)
                    annotated = "b" + extension(name)
                    self.run_tool("smooth", name, annotated, "--annotate", "--max-sweeps", "1")
                    outcome = self.run_tool("smooth", annotated, target, "--verbose")
                    self.assertIn("annotations of an earlier run, which show another mesh, are left out", outcome.err)
                    self.assertIn("trismooth:shape_before", outcome.err)
                    self.assert_own_arrays_stay(self.mesh(name), self.mesh(target))
                    self.assert_annotated(self.mesh(target), set(), set())

    def test_those_of_ply_are_left_out_or_renewed(self):
        self.write("plate.off", sample_meshes.off(sample_meshes.Grid()))
        self.run_tool("smooth", "plate.off", "once.ply", "--annotate", "--max-sweeps", "1")
        self.assertIn(b"trismooth:displacement_0", self.read("once.ply"))
        self.run_tool("smooth", "plate.off", "plain.ply", "--max-sweeps", "1")
        outcome = self.run_tool("smooth", "once.ply", "twice.ply")
        self.assertIn("trismooth:shape_before", outcome.err)
        self.assertIn("the PLY file is made anew without its old annotations", outcome.err)
        self.run_tool("smooth", "plain.ply", "plain_twice.ply")
        self.assertEqual(self.read("twice.ply"), self.read("plain_twice.ply"))
        hashes = [self.report("smooth", "once.ply", "renewed.ply", *more)["coordinates_hash"]
                  for more in ((), ("--annotate",))]
        self.assertEqual(hashes[0], hashes[1])
        self.assertEqual(self.read("renewed.ply").count(b"trismooth:shape_before"), 1)

    def test_a_place_that_holds_no_arrays_or_cannot_be_written_is_told_before_the_work(self):
        self.write("a.vtk", samples()["a.vtk"])
        outcome = self.run_tool("quality", "a.vtk", "--annotate", "b.off", expect=WRONG_USAGE)
        self.assertRegex(outcome.err, r"b\.off.*no arrays.*\.vtu")
        self.run_tool("quality", "a.vtk", "--annotate", "no/such/folder.vtu", expect=NOT_WRITTEN)
        self.run_tool("quality", "a.vtk", "--annotate", "b.xyz", expect=NOT_WRITTEN)
        self.run_tool("quality", "a.vtk", "--annotate-metrics", "shape", expect=WRONG_USAGE)
        for text in ("size", "shape,shape", "", "shape,"):
            outcome = self.run_tool("smooth", "a.vtk", "b.vtk", "--annotate", f"--annotate-metrics={text}",
                                    expect=WRONG_USAGE)
            self.assertIn("--annotate-metrics", outcome.err)
        self.assertEqual(sorted(os.listdir(self.folder)), ["a.vtk"])

    def test_the_input_may_be_annotated_in_place(self):
        self.write("a.vtk", samples()["a.vtk"])
        before = self.mesh("a.vtk")
        for _ in range(2):
            self.run_tool("quality", "a.vtk", "--annotate", "a.vtk")
        self.assert_own_arrays_stay(before, self.mesh("a.vtk"))
        self.assert_annotated(self.mesh("a.vtk"), {"shape"}, {"fixed"})

    def test_smoothing_into_a_format_without_arrays_says_so_and_writes_the_mesh(self):
        self.write("plate.off", sample_meshes.off(sample_meshes.Grid()))
        outcome = self.run_tool("smooth", "plate.off", "out.off", "--annotate")
        self.assertRegex(outcome.err, "note: --annotate")
        self.assertTrue(os.path.exists(self.path("out.off")))


if __name__ == "__main__":
    tool.main()
