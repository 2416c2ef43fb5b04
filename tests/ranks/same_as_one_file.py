"""same_as_one_file.py PROGRAM: a mesh in pieces gets the coordinates and the report of the mesh as one file."""

import os
import pathlib
import random
import shutil
import subprocess
import unittest

import pieces
import ranks_tool
import raw_vtu

# What a run may differ in.
RUN_ALONE = {"timings_ms", "peak_memory_bytes", "path", "output", "threads", "device", "command", "date"}


def without_run(report):
    if isinstance(report, dict):
        return {key: without_run(value) for key, value in report.items() if key not in RUN_ALONE}
    if isinstance(report, list):
        return [without_run(value) for value in report]
    return report


def has_gpu():
    smi = shutil.which("nvidia-smi")
    return smi is not None and subprocess.run([smi, "--list-gpus"], capture_output=True, check=False).returncode == 0


class SameAsOneFile(ranks_tool.RanksTest):
    def test_global_ids(self):
        mesh = self.random_mesh(2000)
        pieces.write_vtu(self.path("whole.vtu"), mesh)
        pieces.write_pieces(self.path("big.pvtu"), pieces.cut(mesh, pieces.stripes(mesh, 4), 4))
        whole = self.report("smooth", "whole.vtu", "smooth.vtu")
        for ranks in (0, 1, 2, 3, 4):
            parts = self.report_over(ranks, "smooth", "big.pvtu", "out.pvtu")
            self.assertEqual(parts["coordinates_hash"], whole["coordinates_hash"], f"{ranks} ranks")
            for part in ("input", "smoothing"):
                # Triangles come in another order here, as the pieces have them.
                self.assertEqual(without_run(parts[part]), without_run(whole[part]), f"{ranks} ranks")

    def test_more_ranks_than_pieces(self):
        mesh = self.random_mesh(1000)
        pieces.write_vtu(self.path("whole.vtu"), mesh)
        pieces.write_pieces(self.path("big.pvtu"), pieces.cut(mesh, pieces.stripes(mesh, 2), 2))
        whole = self.report("smooth", "whole.vtu", "smooth.vtu")
        for ranks, partition in ((4, []), (4, ["--partition", "keep"]), (2, ["--partition", "bisect"])):
            parts = self.report_over(ranks, "smooth", "big.pvtu", "out.pvtu", *partition)
            self.assertEqual(parts["coordinates_hash"], whole["coordinates_hash"], f"{ranks} ranks, {partition}")

    def test_devices(self):
        """Where there are none that is said once, with the exit code that it has without ranks."""
        mesh = self.random_mesh(1000)
        pieces.write_vtu(self.path("whole.vtu"), mesh)
        pieces.write_pieces(self.path("big.pvtu"), pieces.cut(mesh, pieces.stripes(mesh, 2), 2))
        whole = self.report("smooth", "whole.vtu", "smooth.vtu", "--backend", "cpu")
        for mesh_file, output in (("big.pvtu", "out.pvtu"), ("whole.vtu", "out.vtu")):
            arguments = ["smooth", mesh_file, output, "--backend", "cuda", "--quiet", "--report", "report.json"]
            if has_gpu():
                self.run_over(2, *arguments)
                self.assertEqual(self.read_report()["coordinates_hash"], whole["coordinates_hash"])
            else:
                outcome = self.run_over(2, *arguments, expect=5)
                self.assertEqual(len(self.errors_of(outcome)), 1, outcome)
                self.assertFalse(os.path.exists(self.path(output)))

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
        for options in ([], ["--method", "mean-ratio", "--untangle", "off"], ["--precision", "single", "--form", "a"],
                        ["--method", "laplacian"], ["--guard", "off", "--method", "weighted"],
                        ["--region-array", "material", "--region-array", "other"],
                        ["--region-array", "none", "--fixed-ids", "ids.txt"]):
            whole = self.report("smooth", "merged.vtu", "smooth.vtu", *options)
            for ranks in (1, 3):
                with self.subTest(options=options, ranks=ranks):
                    report = self.report_over(ranks, "smooth", "mixed.pvtu", "out.pvtu", *options)
                    self.assertEqual(without_run(report), without_run(whole))

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
            for ranks in (1, 3):
                with self.subTest(zeros=(first, second), ranks=ranks):
                    report = self.report_over(ranks, "smooth", "big.pvtu", "out.pvtu")
                    self.assertEqual(without_run(report), without_run(whole))
                    self.assertEqual(self.notes_of(ranks, "smooth", "big.pvtu", "out.pvtu"), notes)

    def test_marked_vertices(self):
        """Those of a file that rank 0 reads are held as in one file. Pieces do not know them, and it is said."""
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
                said = "note: what 'medit:ref' marks inside is not held in pieces; --gather holds it as in one file"
                self.assertEqual([said in note for note in self.notes_of(3, "smooth", name, "out.pvtu")].count(True), 1)
                gathered = self.run_over(3, "smooth", name, "out.pvtu", "--gather", "--report", "report.json")
                self.assertNotIn("not held in pieces", gathered.err)
                self.assertEqual(self.read_report()["coordinates_hash"], whole["coordinates_hash"])

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
        for options in ([], ["--partition", "keep"], ["--method", "mean-ratio"], ["--slide", "straight"],
                        ["--fields", "interpolate"]):
            whole = self.report("smooth", "whole.vtu", "alone.vtu", *options)
            parts = self.report_over(3, "smooth", "whole.vtu", "shared.vtu", *options)
            with self.subTest(options=options):
                self.assertEqual(self.read("shared.vtu"), self.read("alone.vtu"))
                for key in ("coordinates_hash", "after", "input"):
                    self.assertEqual(without_run(parts[key]), without_run(whole[key]))


if __name__ == "__main__":
    ranks_tool.main()
