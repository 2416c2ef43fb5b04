# SPDX-License-Identifier: BSD-3-Clause
"""one_file_in_ranges.py PROGRAM: a file that no rank reads whole gets the coordinates and the report of the serial run,
and its points, cells and arrays are in the pieces that are written, each where its number says."""

import os
import random
import struct
import threading

import pieces
import ranks_tool
import raw_msh
import raw_vtu
from ranks_tool import without_run


class OneFileInRanges(ranks_tool.RanksTest):
    def check(self, name, ranks, *options, whole=None):
        """The run over ranks says what the serial run says; returns its notes."""
        whole = whole or self.report("smooth", name, "serial.vtu", *options)
        outcome = self.run_over(ranks, "smooth", name, "out.pvtu", *options, "--report", "report.json")
        report = self.read_report()
        self.assertEqual(report["coordinates_hash"], whole["coordinates_hash"], f"{name}, {ranks} ranks, {options}")
        self.assertEqual(without_run(report), without_run(whole), f"{name}, {ranks} ranks, {options}")
        return " ".join(outcome.err.split())

    def assert_by_ranges(self, notes, by_ranges=True):
        self.assertEqual(notes.count("handed it out"), 0 if by_ranges else 1, notes)

    def gathered(self):
        """The arrays of all pieces in the order of the file, and how many points more than one piece has."""
        points, cells = {}, {}
        for source in pieces.sources(self.path("out.pvtu")):
            arrays = raw_vtu.read(self.path(source))
            ids = arrays[("PointData", "GlobalPointIds")]
            numbers = arrays[("CellData", "GlobalCellIds")]
            self.assertEqual(sorted(ids), list(ids))
            self.assertEqual(sorted(numbers), list(numbers))
            for i, point in enumerate(ids):
                row = [arrays[("Points", "Points")][i]] + [
                    values[i] for (section, name), values in arrays.items() if section == "PointData"]
                self.assertEqual(points.setdefault(point, row), row)
            connectivity = arrays[("Cells", "connectivity")]
            first = 0
            for c, end in enumerate(arrays[("Cells", "offsets")]):
                self.assertNotIn(numbers[c], cells)
                cells[numbers[c]] = ([ids[v] for v in connectivity[first:end]], arrays[("Cells", "types")][c], [
                    values[c] for (section, name), values in arrays.items() if section == "CellData"])
                first = end
        return points, cells

    def assert_pieces(self, mesh):
        """Every point and cell is there, with its values, at the place of the serial run."""
        serial = raw_vtu.read(self.path("serial.vtu"))
        points, cells = self.gathered()
        self.assertEqual(sorted(points), list(range(len(mesh.points))))
        self.assertEqual(sorted(cells), list(range(len(mesh.cells))))
        for v, row in points.items():
            self.assertEqual(row[0], serial[("Points", "Points")][v])
            self.assertEqual(row[1:-1], [values[v] for values in mesh.point_arrays.values()])
        for c, (corners, kind, row) in cells.items():
            self.assertEqual((corners, kind), (mesh.cells[c], mesh.types[c]))
            self.assertEqual(row[:-1], [values[c] for values in mesh.cell_arrays.values()])

    def test_off(self):
        self.run_tool("generate", "random.off", "--vertices", 2000)
        mesh = pieces.read_off(self.path("random.off"))
        whole = self.report("smooth", "random.off", "serial.vtu")
        for ranks in (1, 2, 5):
            self.assert_by_ranges(self.check("random.off", ranks, whole=whole))
            self.assert_pieces(mesh)
        self.assert_by_ranges(self.check("random.off", 3, "--partition", "keep"))
        self.assert_pieces(mesh)

    def write_off(self, name, mesh, end="\n", comments=False, colours=False, keyword="OFF"):
        dice = random.Random(7)
        lines = [keyword, f"{len(mesh.points)} {len(mesh.cells)} 0"]
        for x, y, z in mesh.points:
            lines.append(f"{x!r} {y!r} {z!r}" + (" 10 20 30" if colours else ""))
        for cell in mesh.cells:
            lines.append(" ".join(map(str, [len(cell), *cell])) + (f" {dice.randrange(255)} 1 2" if colours else ""))
        if comments:
            with_more = []
            for line in lines:
                with_more.append(line + ("  # 1 2 3" if dice.random() < 0.1 else "\t " if dice.random() < 0.1 else ""))
                while dice.random() < 0.2:
                    with_more.append(dice.choice(["", "   ", "# 3 0 1 2", "\t# OFF"]))
            lines = with_more
        self.write(name, end.join(lines) + dice.choice(["", end]))

    def mixed(self):
        """Triangles listed either way, quadrilaterals, a point of no cell, points and cells in any order."""
        mesh = self.random_mesh(900)
        dice = random.Random(5)
        new = list(range(len(mesh.points) + 1))
        dice.shuffle(new)
        points = [None] * len(new)
        for v, point in enumerate([*mesh.points, (0.5, 0.5, 0.0)]):
            points[new[v]] = point
        cells = [[new[v] for v in (cell if dice.random() < 0.6 else cell[::-1])] for cell in mesh.cells
                 if dice.random() > 0.02]
        dice.shuffle(cells)
        mixed = pieces.Mesh(points, cells)
        mixed.point_arrays = {"height": [3.25 * x + y for x, y, _ in points], "mark": list(range(len(points)))}
        mixed.cell_arrays = {"load": [dice.random() for _ in cells],
                             "region": [7 if points[cell[0]][1] < 0.5 else -1 for cell in cells]}
        return mixed

    def test_a_larger_mesh(self):
        """Corners of triangles travel to those who report on them in several rounds."""
        mesh = self.random_mesh(80000)
        raw_vtu.write(self.path("large.vtu"), mesh, raw_vtu.Form())
        self.assert_by_ranges(self.check("large.vtu", 2, "--max-sweeps", "3", "--precision", "single", "--form", "a"))

    def test_quadrilaterals(self):
        mesh = pieces.grid_of_both_kinds(40)
        raw_vtu.write(self.path("both.vtu"), mesh, raw_vtu.Form())
        self.write_off("both.off", mesh)
        for options in ([], ["--method", "mean-ratio", "--form", "a"], ["--quads", "hold"]):
            self.assert_by_ranges(self.check("both.off", 2, *options))
            self.assert_by_ranges(self.check("both.vtu", 3, *options))
            self.assert_pieces(mesh)

    def test_off_of_any_looks(self):
        mesh = self.mixed()
        for number, looks in enumerate([{}, {"end": "\r\n"}, {"end": "\r"}, {"comments": True},
                                        {"comments": True, "end": "\r\n"}, {"colours": True, "keyword": "COFF"},
                                        {"colours": True, "comments": True}]):
            name = f"looks_{number}.off"
            self.write_off(name, mesh, **looks)
            with self.subTest(looks=looks):
                self.assert_by_ranges(self.check(name, 5 if number == 4 else 3))

    def test_off_of_other_layouts(self):
        """What does not have a row in every line is read whole, and still shared out."""
        mesh = self.mixed()
        self.write_off("rows.off", mesh)
        words = self.read("rows.off").split()
        self.write("words.off", b"OFF\n" + b" ".join(words[1:4]) + b"\n" + b"\n".join(words[4:]))
        self.assert_by_ranges(self.check("words.off", 3), by_ranges=False)
        self.write_off("colours.off", mesh, colours=True)
        lines = self.read("colours.off").decode().splitlines()
        lines[-1] = " ".join(lines[-1].split()[:4])
        self.write("uneven.off", "\n".join(lines))
        self.assert_by_ranges(self.check("uneven.off", 3), by_ranges=False)

    def test_held_by_numbers(self):
        self.write_off("mixed.off", self.mixed())
        self.write("ids.txt", "3 17 200 40")
        self.check("mixed.off", 3, "--fixed-ids", "ids.txt")

    def test_vtu(self):
        mesh = self.mixed()
        forms = [raw_vtu.Form(), raw_vtu.Form(wide=False, index="Int32"), raw_vtu.Form(big=True),
                 raw_vtu.Form(compressed=True), raw_vtu.Form(compressed=True, wide=False, big=True, index="UInt32"),
                 raw_vtu.Form(compressed=True, block=32768), raw_vtu.Form(point="Float32")]
        for number, form in enumerate(forms):
            name = f"form_{number}.vtu"
            raw_vtu.write(self.path(name), mesh, form, field=[1.5, 2.5, 3.5])
            whole = self.report("smooth", name, "ignored.vtu")
            for ranks in (1, 5) if number == 4 else (3,):
                with self.subTest(form=form, ranks=ranks):
                    self.assert_by_ranges(self.check(name, ranks, whole=whole))
                    points, cells = self.gathered()
                    self.assertEqual([points[v][1:-1] for v in range(len(mesh.points))],
                                     [[values[v] for values in mesh.point_arrays.values()] for v in range(len(mesh.points))])
                    self.assertEqual([cells[c][0] for c in range(len(mesh.cells))], mesh.cells)
                    self.assertEqual([cells[c][2][:-1] for c in range(len(mesh.cells))],
                                     [[values[c] for values in mesh.cell_arrays.values()] for c in range(len(mesh.cells))])
                    fields = [raw_vtu.read(self.path(source)).get(("FieldData", "field"))
                              for source in pieces.sources(self.path("out.pvtu"))]
                    self.assertEqual(fields, [[1.5, 2.5, 3.5]] + [None] * (len(fields) - 1))

    def geometry(self):
        """A mesh of two surfaces, with lines between them, a curve inside of which no lines are left, and a point."""
        mesh = self.mixed()
        dice = random.Random(11)
        surface = [(2, 1 if sum(mesh.points[v][1] for v in cell) < 1.5 else 2) for cell in mesh.cells]
        edges = {}
        for cell, entity in zip(mesh.cells, surface):
            for i in range(3):
                edges.setdefault(tuple(sorted((cell[i], cell[i - 1]))), set()).add(entity)
        between = [list(edge) for edge, entities in sorted(edges.items()) if len(entities) == 2]
        points = [(0, 1) if dice.random() < 0.01 else (1, 7) if abs(x - 0.3) < 0.02 else (2, 1) for x, _, _ in mesh.points]
        lines = [(1, 5)] * len(between)
        return pieces.Mesh(mesh.points, between + mesh.cells), points, lines + surface

    def test_msh(self):
        mesh, points, cells = self.geometry()
        names = [(1, 5, "weld"), (2, 1, "steel"), (2, 2, "steel"), (1, 9, "nowhere")]
        for number, (version, options) in enumerate([("2.2", {}), ("4.1", {}), ("4.1", {"big": True}),
                                                     ("2.2", {"big": True, "first_tag": 100}),
                                                     ("4.1", {"names": [], "first_tag": 5})]):
            name = f"mesh_{number}.msh"
            raw_msh.write(self.path(name), mesh, version, points, cells, **{"names": names, **options})
            for more in ([], ["--region-array", "none"]) if number == 1 else ([],):
                whole = self.report("smooth", name, "serial.vtu", *more)
                self.assertGreater(whole["input"]["held"]["named"], 20 if version == "4.1" else -1)
                for ranks in (1, 5) if number == 1 else (3,):
                    with self.subTest(version=version, options=options, ranks=ranks, more=more):
                        self.assert_by_ranges(self.check(name, ranks, *more, whole=whole))
                        _, found = self.gathered()
                        self.assertEqual([found[c][0] for c in range(len(mesh.cells))], mesh.cells)

    def test_msh_of_other_looks(self):
        """Tags that do not count on, groups that share entities, data: read whole, and shared out."""
        mesh, points, cells = self.geometry()
        raw_msh.write(self.path("plain.msh"), mesh, "2.2", points, cells, names=[(2, 1, "steel")])
        content = self.read("plain.msh")
        self.write("data.msh", content + b'$NodeData\n1\n"a"\n1\n0.0\n3\n0\n1\n0\n$EndNodeData\n')
        self.run_tool("smooth", "plain.msh", "text.msh", "--quiet")
        raw_vtu.write(self.path("mesh.vtu"), self.mixed(), raw_vtu.Form())
        self.run_tool("smooth", "mesh.vtu", "text.msh", "--quiet")
        for name in ("data.msh", "text.msh"):
            self.assert_by_ranges(self.check(name, 3), by_ranges=False)

    def test_quality(self):
        mesh = self.mixed()
        self.write_off("mixed.off", mesh)
        raw_vtu.write(self.path("mixed.vtu"), mesh, raw_vtu.Form(compressed=True))
        pieces.write_vtu(self.path("text.vtu"), mesh)
        self.write("tilted.off", "OFF\n3 1 0\n0 0 0\n1 0 1\n0 1 0\n3 0 1 2\n")
        for name in ("mixed.off", "mixed.vtu", "text.vtu", "tilted.off"):
            whole = self.run_tool("quality", name, "--verbose")
            self.assertEqual(self.run_over(3, "quality", name, "--verbose").out, whole.out)

    def test_what_is_read_whole(self):
        mesh = self.mixed()
        pieces.write_vtu(self.path("text.vtu"), mesh)
        self.run_tool("smooth", "text.vtu", "legacy.vtk", "--quiet")
        for name in ("text.vtu", "legacy.vtk"):
            self.assert_by_ranges(self.check(name, 3), by_ranges=False)

    def test_pieces_are_read_again(self):
        self.write_off("mixed.off", self.mixed())
        first = self.report_over(3, "smooth", "mixed.off", "out.pvtu", "--max-sweeps", "3")
        again = self.report_over(2, "quality", "out.pvtu")
        self.assertEqual(again["input"]["vertices"], first["input"]["vertices"])
        self.assertEqual(again["before"]["inverted"], first["after"]["inverted"])
        self.run_tool("smooth", "mixed.off", "serial.off", "--max-sweeps", "3", "--quiet")
        self.assertEqual(self.report_over(2, "smooth", "out.pvtu", "again.pvtu")["coordinates_hash"],
                         self.report("smooth", "serial.off", "again.off")["coordinates_hash"])

    def test_arrays_that_are_called_as_numbers_are(self):
        mesh = self.mixed()
        mesh.point_arrays["GlobalPointIds"] = [7] * len(mesh.points)
        mesh.cell_arrays["GlobalCellIds"] = list(range(len(mesh.cells)))[::-1]
        raw_vtu.write(self.path("named.vtu"), mesh, raw_vtu.Form())
        notes = self.check("named.vtu", 3)
        self.assertEqual(notes.count("GlobalPointIds_of_file"), 1, notes)
        arrays = raw_vtu.read(self.path("out_1.vtu"))
        self.assertEqual(set(arrays[("PointData", "GlobalPointIds_of_file")]), {7})
        self.run_over(2, "quality", "out.pvtu")

    def test_an_array_that_would_call_cells_copies(self):
        mesh = self.mixed()
        mesh.cell_arrays["vtkGhostType"] = [c % 3 % 2 for c in range(len(mesh.cells))]
        raw_vtu.write(self.path("ghosts.vtu"), mesh, raw_vtu.Form())
        notes = self.check("ghosts.vtu", 3)
        self.assertEqual(notes.count("vtkGhostType_of_file"), 1, notes)
        whole = self.report("quality", "ghosts.vtu")
        self.assertEqual(self.report_over(2, "quality", "out.pvtu")["input"]["triangles"], whole["input"]["triangles"])

    def test_triangles_that_are_there_twice(self):
        self.write("twice.off", "OFF\n6 6 0\n0 0 0\n1 0 0\n2 0 0\n0 1 0\n1 1 0\n2 1 0\n"
                   "3 0 1 4\n3 0 4 3\n3 1 2 5\n3 1 5 4\n3 4 0 1\n3 5 4 1\n")
        whole = self.report("smooth", "twice.off", "serial.vtu")
        outcome = self.run_over(3, "smooth", "twice.off", "out.pvtu", "--report", "report.json")
        self.assertIn("for triangles that are listed again", " ".join(outcome.err.split()))
        self.assertEqual(self.read_report()["coordinates_hash"], whole["coordinates_hash"])

    def test_a_pipe(self):
        self.write_off("mixed.off", self.mixed())
        whole = self.report("smooth", "mixed.off", "serial.vtu")
        os.mkfifo(self.path("pipe.off"))
        with open(self.path("mixed.off"), "rb") as source:
            text = source.read()

        def fill():
            with open(self.path("pipe.off"), "wb") as pipe:
                pipe.write(text)

        writer = threading.Thread(target=fill, daemon=True)
        writer.start()
        report = self.report_over(3, "smooth", "pipe.off", "out.pvtu")
        writer.join(timeout=10)
        self.assertEqual(report["coordinates_hash"], whole["coordinates_hash"])

    def test_more_ranks_than_cells(self):
        self.write("two.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n")
        self.write("none.off", "OFF\n0 0 0\n")
        self.write("points.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n1 1 0\n")
        for name in ("two.off", "none.off", "points.off"):
            whole = self.report("smooth", name, "serial.vtu")
            for ranks in (1, 5):
                report = self.report_over(ranks, "smooth", name, "out.pvtu")
                self.assertEqual(report["coordinates_hash"], whole["coordinates_hash"], name)
                self.run_over(2, "quality", "out.pvtu")

    def refused(self, name, *words, ranks=(3,)):
        """One error, the one of the serial run, and nothing is written."""
        serial = self.run_tool("smooth", name, "serial.vtu", expect=None)
        self.assertNotEqual(serial.code, 0)
        before = self.read(name)
        for count in ranks:
            outcome = self.run_over(count, "smooth", name, "out.pvtu", expect=serial.code)
            self.assertEqual(self.errors_of(outcome), self.errors_of(serial), f"{count} ranks")
            for word in words:
                self.assertIn(word, self.errors_of(outcome)[0])
            self.assertEqual([file for file in os.listdir(self.folder) if file.startswith("out")], [])
            self.assert_no_temporary_files()
        self.assertEqual(self.read(name), before)

    def test_bad_off(self):
        mesh = self.mixed()
        self.write_off("good.off", mesh)
        lines = self.read("good.off").decode().splitlines()
        last_third = 2 + len(lines) * 5 // 6

        def written(name, changed):
            self.write(name, "\n".join(changed) + "\n")
            return name

        self.refused(written("cut.off", lines[:-5]), "expected", ranks=(1, 3))
        self.write("bytes.off", self.read("good.off")[:-7])
        self.refused("bytes.off")
        self.refused(written("word.off", [*lines[:last_third], "3 1 two 3", *lines[last_third + 1:]]),
                     f":{last_third + 1}:", "two")
        self.refused(written("index.off", [*lines[:last_third], f"3 1 2 {len(mesh.points)}", *lines[last_third + 1:]]),
                     f":{last_third + 1}:", "vertex index")
        self.refused(written("number.off", [*lines[:300], "0.5 1e999 0", *lines[301:]]), ":301:")
        self.refused(written("more.off", [*lines, "3 0 1 2"]), "end of the file")
        self.refused(written("counts.off", ["OFF", "1000000 10 0", *lines[2:]]), "vertices")
        self.refused(written("solid.off", ["OFF", "5 1 0", "0 0 0", "1 0 0", "2 1 0", "1 2 0", "0 1 0", "5 0 1 2 3 4"]))
        self.refused(written("empty.off", []))

    def test_bad_msh(self):
        """Heads of blocks that say less or more than there is, corners that are not there, an end too early."""
        mesh = pieces.Mesh([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [[0, 1, 2], [0, 2, 3]])
        for version in ("4.1", "2.2"):
            raw_msh.write(self.path("good.msh"), mesh, version)
            content = self.read("good.msh")
            self.write("cut.msh", content[:-30])
            self.refused("cut.msh")
            last_corner = content.rindex(b"\n$EndElements") - (8 if version == "4.1" else 4)
            self.write("corner.msh", content[:last_corner] + b"\x09" + content[last_corner + 1:])
            self.refused("corner.msh", "9")
            elements = content.index(b"$Elements\n") + len(b"$Elements\n")
            if version == "4.1":
                self.write("none.msh", content[:elements] + struct.pack("<q", 0) + content[elements + 8:])
                self.write("no_blocks.msh", content[:elements] + struct.pack("<4q", 0, 2, 1, 2) + b"\n$EndElements\n")
                self.refused("none.msh")
                self.refused("no_blocks.msh")
            else:
                self.write("more.msh", content[:elements] + b"9" + content[elements + 1:])
                self.refused("more.msh")

    def test_bad_vtu(self):
        mesh = self.mixed()
        for form in (raw_vtu.Form(), raw_vtu.Form(compressed=True)):
            raw_vtu.write(self.path("good.vtu"), mesh, form)
            content = self.read("good.vtu")
            self.write("cut.vtu", content[:len(content) * 3 // 4])
            self.refused("cut.vtu")
            self.write("short.vtu", content.replace(b'NumberOfCells="', b'NumberOfCells="9'))
            self.refused("short.vtu")
            mesh_with_bad_corner = self.mixed()
            mesh_with_bad_corner.cells[-10] = [0, 1, len(mesh.points) + 5]
            raw_vtu.write(self.path("corner.vtu"), mesh_with_bad_corner, form)
            self.refused("corner.vtu")

    def test_refused_options(self):
        self.write_off("mixed.off", self.mixed())
        # What the program adds is no array of the file.
        outcome = self.run_over(2, "smooth", "mixed.off", "out.pvtu", "--region-array", "GlobalCellIds", expect=2)
        self.assertIn("'GlobalCellIds'", self.errors_of(outcome)[0])
        self.assertTrue(self.errors_of(outcome)[0].endswith("none"), outcome)

    def test_output_over_input(self):
        self.write_off("mixed.off", self.mixed())
        os.rename(self.path("mixed.off"), self.path("x_1.vtu"))
        raw_vtu.write(self.path("x_1.vtu"), self.mixed(), raw_vtu.Form())
        before = self.read("x_1.vtu")
        outcome = self.run_over(3, "smooth", "x_1.vtu", "x.pvtu", expect=2)
        self.assertIn("is one of the input", self.errors_of(outcome)[0])
        self.assertEqual(self.read("x_1.vtu"), before)


if __name__ == "__main__":
    ranks_tool.main()
