# SPDX-License-Identifier: BSD-3-Clause
"""whole_mesh.py PROGRAM: rank 0 has the whole of a mesh in pieces, to write one file or to do what is not done in
pieces."""

import os
import random

import pieces
import ranks_tool
import tool

RANKS = (0, 1, 2, 3, 5) if tool.thorough else (1, 3)
# Some of those that hold a plain mesh of triangles.
FORMATS = ("off", "vtp", "msh", "off.gz")


def without_run(report):
    """Without what it says of who has the whole mesh, too."""
    return ranks_tool.without_run(report, {"notes", "backend_note", "arguments"})


def write_both(test, mesh, parts=4, gap=0, **options):
    """The mesh as whole.vtu and in pieces as big.pvtu, with its cells in the order of the pieces; `gap`: ids are
    apart by so much more than 1."""
    part_of_cell = pieces.stripes(mesh, parts)
    order = sorted(range(len(mesh.cells)), key=lambda c: part_of_cell[c])
    mesh.cells = [mesh.cells[c] for c in order]
    mesh.types = [mesh.types[c] for c in order]
    mesh.cell_arrays = {name: [values[c] for c in order] for name, values in mesh.cell_arrays.items()}
    cut = pieces.cut(mesh, [part_of_cell[c] for c in order], parts, **options)
    for piece in cut:
        piece.point_arrays["GlobalNodeIds"] = [(1 + gap) * v for v in piece.point_arrays["GlobalNodeIds"]]
    pieces.write_pieces(test.path("big.pvtu"), cut)
    mesh.point_arrays["GlobalNodeIds"] = [(1 + gap) * v for v in range(len(mesh.points))]
    pieces.write_vtu(test.path("whole.vtu"), mesh)


class WholeMesh(ranks_tool.RanksTest):
    def test_single_has_the_bytes_of_one_file(self):
        write_both(self, self.random_mesh(700))
        for extension in FORMATS:
            self.run_tool("smooth", "whole.vtu", f"alone.{extension}", "--quiet")
            for ranks in RANKS if extension == "off" else (3,):
                with self.subTest(extension=extension, ranks=ranks):
                    self.run_over(ranks, "smooth", "big.pvtu", f"out.{extension}", "--single", "--quiet")
                    self.assertEqual(self.read(f"out.{extension}"), self.read(f"alone.{extension}"))
        self.assert_no_temporary_files()

    def test_a_mesh_follows_its_boundary_to_the_bytes_of_one_process(self):
        mesh = self.random_mesh(700)
        pieces.write_vtu(self.path("whole.vtu"), mesh)
        for name, part in (("half.csv", 0.5), ("all.csv", 1)):
            with open(self.path(name), "w", encoding="ascii") as file:
                file.writelines(f"{v}, {0.2 * part * y * (1 - x)}, {0.1 * part * x}\n"
                                for v, (x, y, _) in enumerate(mesh.points))
        steps = ("--start", "previous", "--steps", "half.csv", "all.csv")
        self.run_tool("deform", "whole.vtu", "alone.vtu", *steps)
        for ranks in RANKS:
            outcome = self.run_over(ranks, "deform", "whole.vtu", "out.vtu", *steps)
            for step in (1, 2):
                self.assertEqual(self.read(f"out_{step}.vtu"), self.read(f"alone_{step}.vtu"))
            self.assertEqual("rank 0 does it" in outcome.err, ranks > 1)
        self.assertNotEqual(self.read("alone_1.vtu"), self.read("alone_2.vtu"))

    def test_meshes_are_compared_by_the_first_rank_as_by_one_process(self):
        pieces.write_vtu(self.path("whole.vtu"), self.random_mesh(700))
        self.run_tool("smooth", "whole.vtu", "smoother.off", "--quiet")
        alone = self.run_tool("compare", "whole.vtu", "smoother.off")
        for ranks in RANKS:
            outcome = self.run_over(ranks, "compare", "whole.vtu", "smoother.off")
            self.assertEqual(outcome.out, alone.out)
            self.assertEqual("rank 0 does it" in outcome.err, ranks > 1)

    def notes_of(self, ranks, name):
        said = self.run_over(ranks, "smooth", name, "out.pvtu" if ranks else "alone.vtu").err.splitlines()
        return [line for line in said if ": note: " in line]

    def test_odd_quadrilaterals_are_held_as_by_one_process(self):
        """Corners that are not in turn, inside and at the rim, nodes that are repeated, no thickness."""
        side = 48

        def square(mesh, after):
            return next(c for c in range(after, len(mesh.cells)) if len(mesh.cells[c]) == 4)

        def cross(mesh):
            for after in (0, len(mesh.cells) // 2):
                cell = mesh.cells[square(mesh, after)]
                cell[1], cell[2] = cell[2], cell[1]

        def repeat(mesh):
            for after in (len(mesh.cells) // 3, len(mesh.cells) // 2):
                cell = mesh.cells[square(mesh, after)]
                cell[2] = cell[0]

        def collapse(mesh):
            for after in (len(mesh.cells) // 3, len(mesh.cells) // 2):
                cell = mesh.cells[square(mesh, after)]
                cell[2] = cell[1]

        def open_thin_row(mesh):
            row = range(20 * (side + 1), 21 * (side + 1))
            copies = {v: len(mesh.points) + i for i, v in enumerate(row)}
            mesh.points += [mesh.points[v] for v in row]
            for cell in mesh.cells:
                if max(cell) >= row.stop:
                    cell[:] = [copies.get(v, v) for v in cell]
            mesh.cells += [[v, v + 1, copies[v + 1], copies[v]] for v in row[:-1]]

        for make, said, is_whole in ((cross, "2 quadrilaterals do not list their corners in turn", True),
                                     (repeat, "2 quadrilaterals repeating a node (the first is cell", False),
                                     (collapse, "2 quadrilaterals repeat a corner: they are smoothed as the tri", False),
                                     (open_thin_row, "48 quadrilaterals have no thickness", True)):
            mesh = pieces.grid_of_both_kinds(side)
            make(mesh)
            mesh = pieces.Mesh(mesh.points, mesh.cells)
            write_both(self, mesh, parts=5)
            whole = self.report("smooth", "whole.vtu", "alone.vtu")
            alone = self.notes_of(0, "whole.vtu")
            self.assertEqual([said in note for note in alone], [True], alone)
            for ranks, name in ((2, "big.pvtu"), (3, "whole.vtu")):
                with self.subTest(said=said, ranks=ranks, name=name):
                    report = self.report_over(ranks, "smooth", name, "out.pvtu")
                    self.assertEqual(report["coordinates_hash"], whole["coordinates_hash"])
                    self.assertEqual(report["after"], whole["after"])
                    self.assertEqual(report["input"]["other_cells"], whole["input"]["other_cells"])
                    over_ranks = self.notes_of(ranks, name)
                    self.assertIn(alone[0], over_ranks)
                    self.assertEqual(any("rank 0 had the whole mesh" in note for note in over_ranks), is_whole)

    def test_single_is_what_the_report_speaks_of(self):
        for gap, options in ((0, {}), (3, {}), (0, {"ghosts": False})):
            write_both(self, self.random_mesh(700), gap=gap, **options)
            whole = self.report("smooth", "whole.vtu", "alone.vtu")
            outputs = set()
            for ranks in RANKS:
                with self.subTest(gap=gap, options=options, ranks=ranks):
                    report = self.report_over(ranks, "smooth", "big.pvtu", "out.vtu", "--single")
                    outputs.add(self.read("out.vtu"))
                    checked = self.report("quality", "out.vtu")
                    self.assertEqual(checked["before"], report["after"])
                    self.assertEqual(without_run(checked["input"]), without_run(report["input"]))
                    if gap == 0:
                        self.assertEqual(report["coordinates_hash"], whole["coordinates_hash"])
                        self.assertEqual(report["after"], whole["after"])
            self.assertEqual(len(outputs), 1)

    def test_single_on_standard_output(self):
        write_both(self, self.random_mesh(300))
        self.run_tool("smooth", "whole.vtu", "alone.off", "--quiet")
        outcome = self.launch(3, "smooth", "big.pvtu", "-", "--single", "--format", "off", "--quiet")
        self.assertEqual(outcome.out.encode(), self.read("alone.off"))

    def test_arrays_of_single(self):
        """Values at points and cells, names, types and roles come along, and annotations; marks of copies do not."""
        mesh = self.random_mesh(500)
        write_both(self, mesh)
        self.run_over(3, "smooth", "big.pvtu", "out.vtk", "--annotate", "--single", "--quiet")
        self.run_tool("smooth", "whole.vtu", "alone.vtk", "--annotate", "--quiet")
        self.assertEqual(self.read("out.vtk"), self.read("alone.vtk"))
        self.assertIn(b"height", self.read("out.vtk"))
        self.assertIn(b"load", self.read("out.vtk"))
        self.assertNotIn(b"vtkGhostType", self.read("out.vtk"))
        self.run_tool("quality", "whole.vtu", "--annotate", "alone.vtk", "--quiet")
        self.run_over(3, "quality", "big.pvtu", "--annotate", "out.vtk", "--single", "--quiet")
        self.assertEqual(self.read("out.vtk"), self.read("alone.vtk"))

    def test_losses_are_said(self):
        write_both(self, self.random_mesh(300))
        alone = self.run_tool("smooth", "whole.vtu", "alone.off").err
        over = self.run_over(2, "smooth", "big.pvtu", "out.off", "--single").err
        for line in alone.splitlines():
            if "is not written" in line or "are not written" in line:
                self.assertIn(line, over)
        self.assertIn("load", over)

    def test_sliding_along_lines(self):
        """Lines, in several pieces and by names of their own, are what vertices slide on."""
        side = 12
        mesh = pieces.Mesh([(x / side, y / side, 0.0) for y in range(side + 1) for x in range(side + 1)], [])
        dice = random.Random(2)
        mesh.points = [(x + dice.uniform(-0.02, 0.02) if 0 < x < 1 else x,
                        y + dice.uniform(-0.02, 0.02) if 0 < y < 1 and y != 0.5 else y, z) for x, y, z in mesh.points]
        for y in range(side):
            for x in range(side):
                v = y * (side + 1) + x
                mesh.cells += [[v, v + 1, v + side + 2], [v, v + side + 2, v + side + 1]]
        middle = side // 2 * (side + 1)
        mesh.cells += [[middle + x, middle + x + 1] for x in range(side)]
        mesh.types = [3 if len(cell) == 2 else 5 for cell in mesh.cells]
        mesh.cell_arrays["tag"] = [1 + c % 2 if len(cell) == 3 else 5 + (c > len(mesh.cells) - side // 2)
                                   for c, cell in enumerate(mesh.cells)]
        write_both(self, mesh, parts=3)
        for options in (["curves"], ["straight", "--region-array", "none"]):
            whole = self.report("smooth", "whole.vtu", "alone.vtu", "--slide", *options)
            if "none" in options:
                self.assertGreater(whole["smoothing"]["sliding"]["slid"], 0)
            for ranks in RANKS:
                with self.subTest(options=options, ranks=ranks):
                    report = self.report_over(ranks, "smooth", "big.pvtu", "out.pvtu", "--slide", *options)
                    self.assertEqual(without_run(report), without_run(whole))
                    if ranks > 1:
                        self.assertIn("rank 0 had the whole mesh", report["smoothing"]["backend_note"])

    def test_held_by_ids(self):
        write_both(self, self.random_mesh(300), gap=2)
        self.write("ids.txt", "12 300 # both are ids\n 12")
        self.write("numbers.txt", "4 100")
        whole = self.report("smooth", "whole.vtu", "alone.vtu", "--slide", "straight", "--fixed-ids", "numbers.txt")
        for ranks in RANKS:
            report = self.report_over(ranks, "smooth", "big.pvtu", "out.pvtu", "--slide", "straight", "--fixed-ids",
                                      "ids.txt")
            self.assertEqual(report["after"], whole["after"], f"{ranks} ranks")
            self.assertEqual(report["input"]["held"], whole["input"]["held"])
        self.write("ids.txt", "12 301")
        outcome = self.run_over(3, "smooth", "big.pvtu", "no.pvtu", "--slide", "straight", "--fixed-ids", "ids.txt",
                                expect=3)
        self.assertIn("ids.txt: names vertex 301, and no piece has", self.errors_of(outcome)[0])

    def test_refusals(self):
        write_both(self, self.random_mesh(300))
        before = {name: self.read(name) for name in os.listdir(self.folder)}
        os.mkdir(self.path("folder.off"))
        for words, code, arguments in (
                (["--single"], 2, ["out.off"]),
                (["--single", "out.pvtu"], 2, ["out.pvtu", "--single"]),
                (["big_1.vtu is a piece of the input"], 2, ["big_1.vtu", "--single"]),
                (["nosuch"], 4, ["out.nosuch", "--single"]),
                (["folder.off: is a folder"], 4, ["folder.off", "--single"]),
                (["nosuch"], 2, ["out.pvtu", "--method", "mean-ratio", "--size-array", "nosuch"]),
                (["nosuch"], 2, ["out.off", "--single", "--slide", "straight", "--region-array", "nosuch"])):
            for ranks in (0, 3):
                with self.subTest(arguments=arguments, ranks=ranks):
                    outcome = self.run_over(ranks, "smooth", "big.pvtu", *arguments, expect=code)
                    errors = self.errors_of(outcome)
                    self.assertEqual(len(errors), 1, outcome)
                    for word in words:
                        self.assertIn(word, errors[0])
                    after = {name: self.read(name) for name in os.listdir(self.folder) if name != "folder.off"}
                    self.assertEqual(after, before)


if __name__ == "__main__":
    ranks_tool.main()
