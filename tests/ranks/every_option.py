# SPDX-License-Identifier: BSD-3-Clause
"""every_option.py PROGRAM: whatever is asked for, one file and a mesh in pieces get the coordinates, the report and the
arrays of the serial run on any number of ranks, and it is said where rank 0 had the whole mesh in its memory."""

import math
import random

import pieces
import ranks_tool
import raw_vtu
import tool
from whole_mesh import without_run, write_both

VERTICES = 300
GATHERED = "note: rank 0 had the whole mesh in its memory, for "
# What is asked for: a mesh, the options, and what that needs the whole mesh for; nothing where it is done in pieces.
CASES = (
    ("plain", [], None),
    ("plain", ["--gather"], "--gather"),
    ("plain", ["--slide", "curves"], "--slide"),
    ("plain", ["--slide", "straight", "--method", "mean-ratio"], "--slide"),
    ("plain", ["--geographic"], "--geographic"),
    ("plain", ["--size-array", "height", "--method", "mean-ratio"], "--size-array"),
    ("plain", ["--fields", "interpolate"], "--fields interpolate"),
    ("plain", ["--field-array", "hei*"], "--field-array"),
    ("plain", ["--annotate", "--annotate-metrics", "shape,size_ratio"], "--annotate"),
    ("tangled", ["--untangle", "off"], None),
    ("tangled", ["--method", "mean-ratio", "--untangle", "on"], "the untangling of inverted triangles"),
    ("tangled", ["--method", "mean-ratio", "--slide", "curves"], "--slide"),
    ("hilly", ["--project", "xy", "--annotate"], "--project"),
    ("tilted", [], "a mesh that lies in no plane z = constant"),
    ("cut", ["--merge", "0"], "--merge"),
    ("of six nodes", [], "elements with nodes in the middle of their sides"),
    ("listed again", [], "triangles that are listed again"),
    ("marked", [], "what 'medit:ref' marks"),
)
WAYS = (("whole.vtu", "out.vtu"), ("whole.vtu", "out.pvtu"), ("big.pvtu", "out.pvtu"), ("big.pvtu", "out.vtu"))


def tangle(mesh):
    """Corners that reach over triangles beside them."""
    dice = random.Random(5)
    for v in dice.sample(range(len(mesh.points)), len(mesh.points) // 30):
        x, y, z = mesh.points[v]
        if 0.15 < x < 0.85 and 0.15 < y < 0.85:
            mesh.points[v] = (x + dice.uniform(-0.1, 0.1), y + dice.uniform(-0.1, 0.1), z)


def raise_points(mesh, height):
    mesh.points = [(x, y, height(x, y)) for x, y, _ in mesh.points]


def cut_open(mesh):
    """The left half has corners of its own where the right one is."""
    copies = {}
    left = [sum(mesh.points[v][0] for v in cell) < 1.5 for cell in mesh.cells]
    of_right = {v for cell, is_left in zip(mesh.cells, left) if not is_left for v in cell}
    for c, cell in enumerate(mesh.cells):
        if left[c]:
            for v in of_right.intersection(cell):
                if v not in copies:
                    copies[v] = len(mesh.points)
                    mesh.points.append(mesh.points[v])
                    for values in mesh.point_arrays.values():
                        values.append(values[v])
            mesh.cells[c] = [copies.get(v, v) for v in cell]


def add_middles(mesh):
    middles = {}
    for c, cell in enumerate(mesh.cells):
        for a, b in ((0, 1), (1, 2), (2, 0)):
            ends = tuple(sorted((cell[a], cell[b])))
            if ends not in middles:
                middles[ends] = len(mesh.points)
                mesh.points.append(tuple((p + q) / 2 for p, q in zip(*(mesh.points[v] for v in ends))))
                for values in mesh.point_arrays.values():
                    values.append((values[ends[0]] + values[ends[1]]) / 2)
            mesh.cells[c] = mesh.cells[c] + [middles[ends]]
    mesh.types = [22] * len(mesh.cells)


def list_again(mesh):
    """Those at the lower side, the other way round."""
    again = [c for c, cell in enumerate(mesh.cells) if min(mesh.points[v][1] for v in cell) < 0.05]
    mesh.cells += [mesh.cells[c][::-1] for c in again]
    mesh.types += [pieces.TRIANGLE] * len(again)
    for values in mesh.cell_arrays.values():
        values += [values[c] for c in again]


def mark(mesh):
    mesh.point_arrays["medit:ref"] = [7 if v % 20 == 0 else 0 for v in range(len(mesh.points))]


CHANGES = {"plain": lambda mesh: None, "tangled": tangle,
           "hilly": lambda mesh: raise_points(mesh, lambda x, y: 0.1 * math.sin(7 * x) * y),
           "tilted": lambda mesh: raise_points(mesh, lambda x, y: 0.5 * x + 0.25 * y), "cut": cut_open,
           "of six nodes": add_middles, "listed again": list_again, "marked": mark}


def arrays_of(path):
    """(section, name) -> the rows of an array, each as a tuple of numbers; and the cells."""
    with open(path, "rb") as file:
        is_raw = b'encoding="raw"' in file.read()
    found = {}
    if is_raw:
        found = {key: [row if isinstance(row, tuple) else (row,) for row in rows]
                 for key, rows in raw_vtu.read(path).items()}
    else:
        counts = {key: len(words) for key, (_, words) in pieces.read_ascii_arrays(path).items()}
        points, cells = counts["Points", "Points"] // 3, counts["Cells", "offsets"]
        for key, (_, words) in pieces.read_ascii_arrays(path).items():
            rows = {"Points": points, "PointData": points, "CellData": cells}.get(key[0], len(words))
            width = max(1, len(words) // max(rows, 1))
            found[key] = [tuple(map(float, words[i:i + width])) for i in range(0, len(words), width)]
    corners = [int(v) for v, in found["Cells", "connectivity"]]
    ends = [int(end) for end, in found["Cells", "offsets"]]
    return found, [corners[begin:end] for begin, end in zip([0, *ends], ends)]


class EveryOption(ranks_tool.RanksTest):
    def check_pieces(self, whole, cells):
        """Points and cells of the pieces, copies too, have what they have in the whole mesh."""
        places = {tuple(sorted(cell)): c for c, cell in reversed(list(enumerate(cells)))}
        checked = set()
        for name in pieces.sources(self.path("out.pvtu")):
            arrays, own = arrays_of(self.path(name))
            ids = [int(v) for v, in arrays.get(("PointData", "GlobalPointIds")) or arrays["PointData", "GlobalNodeIds"]]
            rows_of = {"Points": ids, "PointData": ids,
                       "CellData": [places[tuple(sorted(ids[v] for v in cell))] for cell in own]}
            for key, rows in arrays.items():
                if key in whole and key[0] in rows_of:
                    self.assertEqual(rows, [whole[key][row] for row in rows_of[key[0]]], (name, key))
                    checked.add(key)
        self.assertEqual({key for key in whole if key[1].startswith("trismooth:")} - checked, set())
        return checked

    def test_every_way(self):
        for case, (kind, options, reason) in enumerate(CASES):
            mesh = self.random_mesh(VERTICES)
            CHANGES[kind](mesh)
            write_both(self, mesh)
            whole = self.report("smooth", "whole.vtu", "alone.vtu", *[word for word in options if word != "--gather"])
            arrays, cells = arrays_of(self.path("alone.vtu"))
            # In turn two of them, which together have all of the sources and outputs; all where the mesh says what to do.
            for way in range(4) if tool.thorough or kind in ("of six nodes", "marked") else range(case % 2, 4, 2):
                source, output = WAYS[way]
                for ranks in (1, 2, 3, 4) if tool.thorough else (1 + (case + way) % 4,):
                    with self.subTest(mesh=kind, options=options, source=source, output=output, ranks=ranks):
                        single = ["--single"] if (source, output) == ("big.pvtu", "out.vtu") else []
                        outcome = self.run_over(ranks, "smooth", source, output, *options, *single, "--report",
                                                "report.json")
                        report = self.read_report()
                        self.assertEqual(report["coordinates_hash"], whole["coordinates_hash"])
                        self.assertEqual(without_run(report), without_run(whole))
                        in_pieces = source == "big.pvtu" or (output == "out.pvtu" and kind != "marked")
                        expected = GATHERED + reason if reason and ranks > 1 and in_pieces else None
                        said = " ".join(outcome.err.split())
                        self.assertEqual(said.count(GATHERED), 1 if expected else 0, said)
                        self.assertIn(expected or "", said)
                        if output == "out.pvtu":
                            self.check_pieces(arrays, cells)
        self.assert_no_temporary_files()

    def test_depths(self):
        """Values that follow the mesh by default do so in pieces of one file."""
        mesh = self.random_mesh(VERTICES)
        self.write("grid.14", f"grid\n{len(mesh.cells)} {len(mesh.points)}\n" +
                   "".join(f"{v + 1} {x!r} {y!r} {3 + x * y!r}\n" for v, (x, y, _) in enumerate(mesh.points)) +
                   "".join(f"{c + 1} 3 {a + 1} {b + 1} {d + 1}\n" for c, (a, b, d) in enumerate(mesh.cells)) + "0\n0\n0\n0\n")
        for options, word in (([], "which follow the mesh"), (["--fields", "keep"], "")):
            whole = self.report("smooth", "grid.14", "alone.vtu", *options)
            arrays, cells = arrays_of(self.path("alone.vtu"))
            for ranks in (1, 3):
                with self.subTest(options=options, ranks=ranks):
                    outcome = self.run_over(ranks, "smooth", "grid.14", "out.pvtu", *options)
                    self.assertIn(word if ranks > 1 else "", outcome.err)
                    self.assertEqual("rank 0 had the whole mesh" in outcome.err, bool(word) and ranks > 1)
                    self.assertEqual({section for section, _ in self.check_pieces(arrays, cells)},
                                     {"Points", "PointData"})
            self.assertEqual([field["name"] for field in whole["fields"] or []], ["depth"] if word else [])


if __name__ == "__main__":
    ranks_tool.main()
