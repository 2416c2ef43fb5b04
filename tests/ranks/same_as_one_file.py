# SPDX-License-Identifier: BSD-3-Clause
"""same_as_one_file.py PROGRAM: a mesh in pieces gets the coordinates and the report of the mesh as one file."""

import os
import pathlib
import random
import shutil
import subprocess

import pieces
import ranks_tool
import raw_vtu
from ranks_tool import without_run


def has_gpu():
    smi = shutil.which("nvidia-smi")
    return smi is not None and subprocess.run([smi, "--list-gpus"], capture_output=True, check=False).returncode == 0


class SameAsOneFile(ranks_tool.RanksTest):
    def test_global_ids(self):
        mesh = self.random_mesh(2000)
        pieces.write_vtu(self.path("whole.vtu"), mesh)
        pieces.write_pieces(self.path("big.pvtu"), pieces.cut(mesh, pieces.stripes(mesh, 4), 4))
        whole = self.report("smooth", "whole.vtu", "smooth.vtu")
        for ranks in (0, 1, 4):
            self.launch(ranks, "smooth", "big.pvtu", "out.pvtu", "--quiet", "--report", "report.json")
            parts = self.read_report()
            self.assertEqual(parts["coordinates_hash"], whole["coordinates_hash"], f"{ranks} ranks")
            for part in ("input", "smoothing"):
                # Triangles come in another order here, as the pieces have them.
                self.assertEqual(without_run(parts[part]), without_run(whole[part]), f"{ranks} ranks")

    def test_devices(self):
        """Where there are none that is said once, with the exit code that it has without ranks."""
        mesh = self.random_mesh(1000)
        pieces.write_vtu(self.path("whole.vtu"), mesh)
        pieces.write_pieces(self.path("big.pvtu"), pieces.cut(mesh, pieces.stripes(mesh, 2), 2))
        whole = self.report("smooth", "whole.vtu", "smooth.vtu", "--backend", "cpu")
        for mesh_file, output in (("big.pvtu", "out.pvtu"), ("whole.vtu", "out.vtu")):
            arguments = ["smooth", mesh_file, output, "--backend", "cuda", "--quiet", "--report", "report.json"]
            if has_gpu():
                self.launch(2, *arguments)
                self.assertEqual(self.read_report()["coordinates_hash"], whole["coordinates_hash"])
            else:
                outcome = self.launch(2, *arguments, expect=5)
                self.assertEqual(len(self.errors_of(outcome)), 1, outcome)
                self.assertFalse(os.path.exists(self.path(output)))

    def test_arrays_that_are_not_there(self):
        """They are refused in the words of one process, which name no array that ranks gave the mesh."""
        pieces.write_vtu(self.path("whole.vtu"), self.random_mesh(300))
        pieces.write_vtu(self.path("nothing.vtu"), pieces.Mesh([], []))
        for name in ("whole.vtu", "nothing.vtu"):
            for option in ("--fixed-array", "--region-array"):
                alone = self.run_tool("smooth", name, "out.vtu", option, "nosuch", expect=2)
                ranks = self.run_over(3, "smooth", name, "out.pvtu", option, "nosuch", expect=2)
                self.assertEqual(self.errors_of(ranks), self.errors_of(alone), f"{name} {option}")

    def mixed_mesh(self):
        """Triangles listed either way, holes, quadrilaterals, regions under a name and by their looks, fixed points."""
        dice = random.Random(3)
        mesh = self.random_mesh(1500)
        kept = [cell[::-1] if dice.random() < 0.3 else cell for cell in mesh.cells
                if abs(mesh.points[cell[0]][0] - 0.35) > 0.03 and dice.random() > 0.01]
        # Pairs of triangles become quadrilaterals.
        sides = {}
        for c, cell in enumerate(kept):
            for i in range(3):
                sides.setdefault(tuple(sorted((cell[i], cell[i - 1]))), []).append(c)
        joined = set()
        quads = []
        for (a, b), cells in sides.items():
            if len(cells) == 2 and dice.random() < 0.01 and not joined.intersection(cells):
                joined.update(cells)
                quads.append([next(v for v in kept[cells[0]] if v not in (a, b)), a,
                              next(v for v in kept[cells[1]] if v not in (a, b)), b])
        mixed = pieces.Mesh(mesh.points, [cell for c, cell in enumerate(kept) if c not in joined] + quads)
        mixed.cell_arrays["material"] = [3.0 if mixed.points[cell[0]][1] > 0.6 else -2.5 for cell in mixed.cells]
        mixed.cell_arrays["other"] = [int(4 * mixed.points[cell[0]][0]) for cell in mixed.cells]
        mixed.cell_arrays["load"] = [dice.random() for _ in mixed.cells]
        return mixed

    def test_reports(self):
        parts = pieces.cut(self.mixed_mesh(), pieces.stripes(self.mixed_mesh(), 5), 5, global_ids=False)
        pieces.write_pieces(self.path("mixed.pvtu"), parts)
        merged = pieces.merged(parts)
        pieces.write_vtu(self.path("merged.vtu"), merged)
        self.write("ids.txt", "3 17 200 40  # and one twice: 17")
        for ranks, options in ((3, []), (3, ["--method", "mean-ratio", "--untangle", "off"]),
                               (1, ["--precision", "single", "--form", "a"]), (3, ["--method", "laplacian"]),
                               (3, ["--guard", "off", "--method", "weighted"]),
                               (1, ["--region-array", "material", "--region-array", "other"]),
                               (3, ["--region-array", "none", "--fixed-ids", "ids.txt"])):
            with self.subTest(options=options, ranks=ranks):
                whole = self.report("smooth", "merged.vtu", "smooth.vtu", "--quads", "hold", *options)
                report = self.report_over(ranks, "smooth", "mixed.pvtu", "out.pvtu", "--quads", "hold", *options)
                self.assertEqual(without_run(report), without_run(whole))

    def test_quadrilaterals_are_smoothed_in_pieces_to_the_same_bits(self):
        mesh = pieces.grid_of_both_kinds(48)
        parts = pieces.cut(mesh, pieces.stripes(mesh, 5), 5, global_ids=False)
        pieces.write_pieces(self.path("both.pvtu"), parts)
        pieces.write_vtu(self.path("merged.vtu"), pieces.merged(parts))
        for options in ([], ["--method", "mean-ratio"], ["--precision", "single", "--form", "a"],
                        ["--region-array", "none", "--require", "quadrilateral.min_shape>=0.01"],
                        ["--guard", "off", "--method", "laplacian", "--max-sweeps", "7"]):
            whole = self.report("smooth", "merged.vtu", "smooth.vtu", *options)
            self.assertGreater(min(kind["elements"] for kind in whole["after"]["kinds"]), 1024)
            for ranks, name in ((2, "both.pvtu"), (5, "both.pvtu"), (3, "merged.vtu")):
                with self.subTest(options=options, ranks=ranks, name=name):
                    report = self.report_over(ranks, "smooth", name, "out.pvtu", *options)
                    self.assertEqual(without_run(report), without_run(whole))
        whole = self.report("quality", "merged.vtu")
        self.assertEqual(without_run(self.report_over(3, "quality", "merged.vtu")), without_run(whole))

    def test_what_is_done_with_quadrilaterals_by_one_rank_alone_has_the_same_bits(self):
        parts = pieces.cut(self.mixed_mesh(), pieces.stripes(self.mixed_mesh(), 5), 5, global_ids=False)
        pieces.write_pieces(self.path("mixed.pvtu"), parts)
        pieces.write_vtu(self.path("merged.vtu"), pieces.merged(parts))
        for more in ([], ["--slide", "curves", "--deviation", "0.1", "--corner-angle", "60"]):
            options = ["--method", "mean-ratio", "--untangle", "off", *more]
            whole = self.report("smooth", "merged.vtu", "smooth.vtu", *options)
            self.assertGreater(whole["input"]["quadrilaterals"], 10)
            if more:
                self.assertGreater(whole["smoothing"]["sliding"]["slid"], 0)
            for ranks, name, output in ((1, "mixed.pvtu", "out.pvtu"), (2, "mixed.pvtu", "out.pvtu"),
                                        (3, "merged.vtu", "out.vtu"), (4, "mixed.pvtu", "out.pvtu")):
                with self.subTest(ranks=ranks, name=name, more=more):
                    report = self.report_over(ranks, "smooth", name, output, *options)
                    self.assertEqual(report["coordinates_hash"], whole["coordinates_hash"])
                    self.assertEqual(report["after"]["kinds"], whole["after"]["kinds"])
                    note = report["smoothing"].get("backend_note") or ""
                    self.assertEqual("by one rank alone" in note, ranks > 1 and bool(more), note)

    def test_quadrilaterals_are_untangled_by_one_rank_to_the_same_bits(self):
        mesh = self.mixed_mesh()
        dice = random.Random(5)
        # Some are moved by about two edges.
        mesh.points = [(x + dice.uniform(-0.05, 0.05), y + dice.uniform(-0.05, 0.05), z)
                       if 0.1 < x < 0.9 and 0.1 < y < 0.9 and dice.random() < 0.1 else (x, y, z)
                       for x, y, z in mesh.points]
        parts = pieces.cut(mesh, pieces.stripes(mesh, 3), 3, global_ids=False)
        pieces.write_pieces(self.path("tangled.pvtu"), parts)
        pieces.write_vtu(self.path("merged.vtu"), pieces.merged(parts))
        for options in (["--untangle", "on"], ["--method", "mean-ratio"]):
            whole = self.report("smooth", "merged.vtu", "smooth.vtu", *options)
            untangling = whole["smoothing"]["untangling"]
            self.assertGreater(untangling["inverted_before"], 50)
            self.assertLess(untangling["inverted_after"], untangling["inverted_before"] / 2)
            for ranks, name in ((2, "tangled.pvtu"), (3, "merged.vtu")):
                with self.subTest(options=options, ranks=ranks, name=name):
                    report = self.report_over(ranks, "smooth", name, "out.pvtu", *options)
                    self.assertEqual(report["coordinates_hash"], whole["coordinates_hash"])
                    self.assertEqual(report["smoothing"]["untangling"], untangling)
                    self.assertIn("inverted elements are untangled by one rank alone",
                                  report["smoothing"]["backend_note"])

    def notes_of(self, ranks, *arguments):
        return [line for line in self.run_over(ranks, *arguments).err.splitlines() if ": note: " in line]

    def test_what_is_said_of_arrays_and_cells(self):
        """Regions called -0, annotations of an earlier run, a triangle that repeats a vertex."""
        mesh = self.random_mesh(300)
        middle = len(mesh.cells) // 2
        mesh.cells[middle] = [mesh.cells[middle][0], *mesh.cells[middle][:2]]
        upper = [mesh.points[cell[0]][1] < 0.5 for cell in mesh.cells]
        for first, second in ((-0.0, -0.0), (-0.0, 0.0), (0.0, -0.0)):
            zeros = [first] * middle + [second] * (len(mesh.cells) - middle)
            mesh.cell_arrays = {"region": [zero if is_upper else 1.5 for zero, is_upper in zip(zeros, upper)],
                                "trismooth:shape": [0.5] * len(mesh.cells)}
            parts = pieces.cut(mesh, pieces.stripes(mesh, 3), 3, global_ids=False)
            pieces.write_pieces(self.path("big.pvtu"), parts)
            pieces.write_vtu(self.path("whole.vtu"), pieces.merged(parts))
            whole = self.report("smooth", "whole.vtu", "smooth.vtu")
            notes = self.notes_of(0, "smooth", "whole.vtu", "smooth.vtu")
            self.assertEqual(len(notes), 2, notes)
            with self.subTest(zeros=(first, second)):
                report = self.report_over(3, "smooth", "big.pvtu", "out.pvtu")
                self.assertEqual(whole["kept_fields"], ["height"])
                self.assertEqual(without_run(report), without_run(whole))
                self.assertEqual(self.notes_of(3, "smooth", "big.pvtu", "out.pvtu"), notes)

    def test_what_is_said_of_the_result_and_of_strange_meshes(self):
        """The growth bound of mean-ratio, degrees, triangles that share no vertex: as one process says it."""
        mesh = self.random_mesh(200)
        self.write("degrees.14", f"grid\n{len(mesh.cells)} {len(mesh.points)}\n" +
                   "".join(f"{v + 1} {4 * x - 75!r} {4 * y + 35!r} 10\n" for v, (x, y, _) in enumerate(mesh.points)) +
                   "".join(f"{c + 1} 3 {' '.join(str(v + 1) for v in cell)}\n" for c, cell in enumerate(mesh.cells)) +
                   "0\n0\n0\n0\n")
        self.write("apart.off", "OFF 6 2 0\n0 0 0\n1 0 0\n0 1 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 3 4 5\n")
        for name, options, told in (("random.off", ["--method", "mean-ratio"], "the growth bound of mean-ratio keeps"),
                                    ("degrees.14", [], "look like longitude and latitude"),
                                    ("apart.off", [], "--merge")):
            said = [note for note in self.notes_of(0, "smooth", name, "smooth.vtu", *options) if told in note]
            self.assertEqual(len(said), 1, name)
            with self.subTest(name):
                self.assertIn(said[0], self.notes_of(3, "smooth", name, "out.pvtu", *options))
        # That the whole mesh is needed is found late: by then nothing has been said that is said again.
        self.write("none.txt", "# none")
        self.write("inverted.off", "OFF 5 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n1.5 0.5 0\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n")
        for name, method in (("apart.off", "smart"), ("inverted.off", "mean-ratio")):
            with self.subTest(name):
                said = self.run_over(3, "smooth", name, "out.pvtu", "--method", method, "--fixed-ids", "none.txt").err
                self.assertIn("rank 0 had the whole mesh", " ".join(said.split()))
                self.assertEqual(said.count("names no vertices"), 1, said)

    def test_marked_vertices(self):
        """Those of a file that rank 0 reads, and of pieces, are held as in one file."""
        mesh = self.random_mesh(600)
        markers = [7 if v % 20 == 0 else 0 for v in range(len(mesh.points))]
        self.write("marked.mesh", "MeshVersionFormatted 2\nDimension 2\n" + f"Vertices {len(mesh.points)}\n" +
                   "".join(f"{p[0]!r} {p[1]!r} {m}\n" for p, m in zip(mesh.points, markers)) +
                   f"Triangles {len(mesh.cells)}\n" +
                   "".join(" ".join(str(v + 1) for v in cell) + " 0\n" for cell in mesh.cells) + "End\n")
        whole = self.report("smooth", "marked.mesh", "smooth.mesh")
        self.assertEqual([found["name"] for found in whole["input"]["point_sets"]], ["medit:ref"])
        parts = self.report_over(3, "smooth", "marked.mesh", "out.pvtu")
        self.assertEqual(parts["coordinates_hash"], whole["coordinates_hash"])
        self.assertEqual(parts["input"]["point_sets"], whole["input"]["point_sets"])
        mesh.point_arrays["medit:ref"] = markers
        pieces.write_pieces(self.path("big.pvtu"), pieces.cut(mesh, pieces.stripes(mesh, 3), 3))
        raw_vtu.write(self.path("raw.vtu"), mesh, raw_vtu.Form())
        whole = self.report("smooth", "raw.vtu", "smooth.vtu")
        for name in ("big.pvtu", "raw.vtu"):
            with self.subTest(name):
                report = self.report_over(3, "smooth", name, "out.pvtu")
                self.assertEqual(report["coordinates_hash"], whole["coordinates_hash"])
                self.assertIn("whole mesh", self.run_over(3, "smooth", name, "out.pvtu").err)
                self.assertNotIn("whole mesh", self.run_over(3, "smooth", name, "out.pvtu", "--fixed-set", "none").err)

    def test_sets_by_labels(self):
        """Of points, of quadrilaterals and of triangles, in pieces and handed out; at the borders of pieces, too."""
        mesh = self.mixed_mesh()
        mesh.point_arrays["kind"] = [v % 13 for v in range(len(mesh.points))]
        mesh.cell_arrays["kind"] = [5 + 10 * (len(cell) == 3) for cell in mesh.cells]
        mesh.cell_arrays["half"] = [0.5 if 0.4 < mesh.points[cell[0]][0] < 0.6 else 7.0 for cell in mesh.cells]
        parts = pieces.cut(mesh, pieces.stripes(mesh, 5), 5, global_ids=False)
        pieces.write_pieces(self.path("mixed.pvtu"), parts)
        merged = pieces.merged(parts)
        pieces.write_vtu(self.path("merged.vtu"), merged)
        quads = {v for cell in merged.cells if len(cell) == 4 for v in cell}
        halves = {v for cell in merged.cells if 0.4 < merged.points[cell[0]][0] < 0.6 for v in cell}
        members = {"kind=5": quads | {v for v, kind in enumerate(merged.point_arrays["kind"]) if kind == 5},
                   "half=0.5": halves}
        for names, taken in ((["kind=5"], ["kind=5"]), (["KIND=05", "half=.5", "kind=5"], ["kind=5", "half=0.5"])):
            options = [word for name in names for word in ("--fixed-set", name)]
            whole = self.report("smooth", "merged.vtu", "smooth.vtu", *options)
            self.assertEqual({found["name"]: found["vertices"] for found in whole["input"]["point_sets"]},
                             {name: len(members[name]) for name in taken})
            self.write("rows.txt", " ".join(str(v) for name in taken for v in members[name]))
            named = self.report("smooth", "merged.vtu", "smooth.vtu", "--fixed-ids", "rows.txt")
            self.assertEqual(whole["coordinates_hash"], named["coordinates_hash"])
            for ranks, more in ((1, []), (3, ["--partition", "bisect"]), (3, ["--gather"])):
                with self.subTest(names=names, ranks=ranks, more=more):
                    report = self.report_over(ranks, "smooth", "mixed.pvtu", "out.pvtu", *options, *more)
                    self.assertEqual(without_run(report["input"]), without_run(whole["input"]))
                    self.assertEqual(report["coordinates_hash"], whole["coordinates_hash"])
            slid = self.report("smooth", "merged.vtu", "smooth.vtu", *options, "--slide", "straight")
            report = self.report_over(3, "smooth", "mixed.pvtu", "out.pvtu", *options, "--slide", "straight")
            self.assertEqual(report["coordinates_hash"], slid["coordinates_hash"])
            report = self.report_over(3, "smooth", "merged.vtu", "out.pvtu", *options)
            self.assertEqual(report["coordinates_hash"], whole["coordinates_hash"])
        for name in ("kind=99", "nosuch=5", "kind"):
            errors = []
            for ranks, path in ((0, "merged.vtu"), (0, "mixed.pvtu"), (3, "mixed.pvtu")):
                outcome = self.run_over(ranks, "smooth", path, "no" + path[-5:], "--fixed-set", name, expect=2)
                errors.append(self.errors_of(outcome))
                self.assertEqual(len(errors[-1]), 1, outcome)
            # (What marks copies is an array of the pieces alone.)
            self.assertEqual(errors[1], [error.replace("vtkGhostType, ", "") for error in errors[2]])
            if name == "kind=99":
                self.assertEqual(errors[0], errors[1])
                self.assertIn("'kind' has: 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 15", errors[1][0])

    def test_vertices_by_labels(self):
        """The numbers that the file gives its points; of pieces these are their global ids."""
        mesh = self.random_mesh(1000)
        ids = [7 * ((v * 389) % 1009) + 3 for v in range(len(mesh.points))]
        held = list(range(0, len(mesh.points), 9))
        self.write("labels.txt", " ".join(str(ids[v]) for v in held) + f"  # and one twice: {ids[9]}")
        self.write("rows.txt", " ".join(map(str, held)))
        mesh.point_arrays["GlobalNodeIds"] = ids
        pieces.write_vtu(self.path("whole.vtu"), mesh)
        raw_vtu.write(self.path("raw.vtu"), mesh, raw_vtu.Form())
        self.write("whole.msh", f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{len(ids)}\n" +
                   "".join(f"{i} {x!r} {y!r} {z!r}\n" for i, (x, y, z) in zip(ids, mesh.points)) +
                   f"$EndNodes\n$Elements\n{len(mesh.cells)}\n" +
                   "".join(f"{c + 1} 2 2 {region + 2} 1 " + " ".join(str(ids[v]) for v in cell) + "\n" for c, (cell, region)
                           in enumerate(zip(mesh.cells, mesh.cell_arrays["region"]))) + "$EndElements\n")
        named = self.report("smooth", "whole.vtu", "smooth.vtu", "--fixed-ids", "rows.txt")
        parts = pieces.cut(mesh, pieces.stripes(mesh, 4), 4)
        for piece in parts:
            piece.point_arrays["GlobalNodeIds"] = [ids[v] for v in piece.point_arrays["GlobalNodeIds"]]
        pieces.write_pieces(self.path("big.pvtu"), parts)
        places = dict(zip(ids, mesh.points))
        labels = ["--fixed-labels", "labels.txt"]
        held_ids = {ids[v] for v in held}
        for name, ranks, more in (("big.pvtu", 1, []), ("big.pvtu", 3, []),
                                  ("big.pvtu", 3, ["--fields", "interpolate"])):
            with self.subTest(name, ranks=ranks, more=more):
                report = self.report_over(ranks, "smooth", name, "out.pvtu", *labels, *more)
                self.assertEqual(report["input"]["fixed_ids_vertices"], len(held))
                self.assertEqual(report["input"]["free_vertices"], named["input"]["free_vertices"])
                moved = set()
                for source in pieces.sources(self.path("out.pvtu")):
                    arrays = pieces.read_ascii_arrays(self.path(source))
                    xyz = [float(x) for x in arrays["Points", "Points"][1]]
                    moved.update(v for i, v in enumerate(map(int, arrays["PointData", "GlobalNodeIds"][1]))
                                 if tuple(xyz[3 * i:3 * i + 3]) != places[v])
                self.assertFalse(moved & held_ids)
                self.assertTrue(moved)
        for name in ("whole.vtu", "raw.vtu", "whole.msh"):
            alone = self.report("smooth", name, "alone.vtu", *labels)
            self.assertEqual(alone["coordinates_hash"], named["coordinates_hash"])
            for output, more in (("out.vtu", []), ("out.pvtu", []), ("out.pvtu", ["--slide", "straight"])):
                with self.subTest(name, output=output, more=more):
                    report = self.report_over(3, "smooth", name, output, *labels, *more)
                    if not more:
                        self.assertEqual(report["coordinates_hash"], named["coordinates_hash"])
                    self.assertEqual(report["input"]["fixed_ids_vertices"], len(held))
        self.write("labels.txt", f"{ids[3]} -4 {ids[4]} 4")
        said = set()
        for name, ranks, output, more in (("whole.vtu", 0, "no.vtu", []), ("big.pvtu", 0, "no.pvtu", []),
                                          ("big.pvtu", 3, "no.pvtu", []), ("big.pvtu", 3, "no.pvtu", ["--gather"]),
                                          ("raw.vtu", 3, "no.pvtu", [])):
            outcome = self.run_over(ranks, "smooth", name, output, *labels, *more, expect=3)
            self.assertEqual(len(self.errors_of(outcome)), 1, outcome)
            said.update(self.errors_of(outcome))
        self.assertEqual(said, {"trismooth: error: labels.txt: names the vertex -4, and no point of the mesh has that label"})
        mesh = self.random_mesh(300)
        pieces.write_pieces(self.path("big.pvtu"), pieces.cut(mesh, pieces.stripes(mesh, 2), 2, global_ids=False))
        outcome = self.run_over(3, "smooth", "big.pvtu", "no.pvtu", *labels, expect=2)
        self.assertEqual(len(self.errors_of(outcome)), 1, outcome)
        self.assertRegex(outcome.err, "'--fixed-labels': the pieces give .*GlobalNodeIds.*; --fixed-ids takes")

    def test_an_empty_piece_has_any_array_of_ids(self):
        mesh = self.random_mesh(300)
        parts = pieces.cut(mesh, pieces.stripes(mesh, 2), 3)
        pieces.write_pieces(self.path("big.pvtu"), parts)
        pieces.write_vtu(self.path("whole.vtu"), mesh)
        whole = self.report("smooth", "whole.vtu", "smooth.vtu")
        empty = pathlib.Path(self.path("big_2.vtu"))
        text = empty.read_text()
        changed = text.replace('type="Int64" Name="GlobalNodeIds"', 'type="Float32" Name="GlobalNodeIds"')
        self.assertNotEqual(changed, text)
        empty.write_text(changed)
        report = self.report_over(2, "smooth", "big.pvtu", "out.pvtu")
        self.assertEqual(report["coordinates_hash"], whole["coordinates_hash"])

    def test_quality(self):
        mesh = self.random_mesh(500)
        parts = pieces.cut(mesh, pieces.stripes(mesh, 3), 3, global_ids=False)
        pieces.write_pieces(self.path("big.pvtu"), parts)
        pieces.write_vtu(self.path("merged.vtu"), pieces.merged(parts))
        whole = self.run_tool("quality", "merged.vtu", "--verbose").out.replace("merged.vtu", "big.pvtu")
        for ranks in (0, 2):
            self.assertEqual(self.run_over(ranks, "quality", "big.pvtu", "--verbose").out, whole)

    def test_float32(self):
        mesh = self.random_mesh(500)
        parts = pieces.cut(mesh, pieces.stripes(mesh, 3), 3)
        pieces.write_pieces(self.path("big.pvtu"), parts, "Float32")
        pieces.write_vtu(self.path("whole.vtu"), mesh, "Float32")
        whole = self.report("smooth", "whole.vtu", "smooth.vtu")
        self.assertEqual(self.report_over(3, "smooth", "big.pvtu", "out.pvtu")["coordinates_hash"],
                         whole["coordinates_hash"])

    def test_one_file(self):
        mesh = self.mixed_mesh()
        pieces.write_vtu(self.path("whole.vtu"), mesh)
        for options in (["--partition", "keep"], ["--method", "mean-ratio"]):
            whole = self.report("smooth", "whole.vtu", "alone.vtu", *options)
            parts = self.report_over(3, "smooth", "whole.vtu", "shared.vtu", *options)
            with self.subTest(options=options):
                self.assertEqual(self.read("shared.vtu"), self.read("alone.vtu"))
                for key in ("coordinates_hash", "after", "input"):
                    self.assertEqual(without_run(parts[key]), without_run(whole[key]))


if __name__ == "__main__":
    ranks_tool.main()
