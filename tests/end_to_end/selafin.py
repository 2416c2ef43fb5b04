# SPDX-License-Identifier: BSD-3-Clause
"""SELAFIN files, written and read here by the records that TELEMAC describes, with struct alone."""

import struct

import tool

COLUMNS, ROWS = 8, 6


def record(order, content):
    return struct.pack(order + "i", len(content)) + content + struct.pack(order + "i", len(content))


def write_selafin(points, triangles, order=">", real="f", variables=(), steps=(), origin=(0, 0)):
    """`variables`: names of 32 characters; `steps`: (time, a list of values for each variable)."""
    def numbers(kind, values):
        return record(order, struct.pack(f"{order}{len(values)}{kind}", *values))

    title = b"A PLATE".ljust(72) + (b"SERAFIND" if real == "d" else b"SERAFIN ")
    parts = [record(order, title), numbers("i", [len(variables), 0])]
    parts += [record(order, name.encode().ljust(32)) for name in variables]
    parts += [numbers("i", [1, 0, *origin, 0, 0, 0, 0, 0, 1]), numbers("i", [2026, 11, 30, 12, 0, 0])]
    parts += [numbers("i", [len(triangles), len(points), 3, 1]), numbers("i", [v + 1 for t in triangles for v in t])]
    parts += [numbers("i", [0] * len(points)), numbers(real, [p[0] for p in points]), numbers(real, [p[1] for p in points])]
    for time, values in steps:
        parts += [numbers(real, [time])] + [numbers(real, list(own)) for own in values]
    return b"".join(parts)


def read_selafin(data, order=">"):
    """A dictionary of what the file has."""
    records, at = [], 0
    while at < len(data):
        size = struct.unpack_from(order + "i", data, at)[0]
        assert struct.unpack_from(order + "i", data, at + 4 + size)[0] == size
        records.append(data[at + 4:at + 4 + size])
        at += 8 + size
    rest = iter(records)

    def numbers(kind):
        content = next(rest)
        return list(struct.unpack(f"{order}{len(content) // struct.calcsize(order + kind)}{kind}", content))

    title = next(rest)
    real = "d" if title.endswith(b"SERAFIND") else "f"
    count = sum(numbers("i"))
    found = {"variables": [next(rest).decode() for _ in range(count)], "parameters": numbers("i")}
    if found["parameters"][9] == 1:
        found["date"] = numbers("i")
    elements, points, corners, _ = numbers("i")
    nodes = numbers("i")
    found["triangles"] = [tuple(v - 1 for v in nodes[i:i + corners]) for i in range(0, elements * corners, corners)]
    found["boundary"] = numbers("i")
    found["points"] = list(zip(numbers(real), numbers(real)))
    assert len(found["points"]) == points
    found["steps"] = []
    for time in rest:
        found["steps"].append((struct.unpack(order + real, time)[0], [numbers(real) for _ in range(count)]))
    return found


def plate():
    points, triangles = [], []
    for row in range(ROWS + 1):
        for column in range(COLUMNS + 1):
            angle = 2.399963 * len(points)
            inner = 0 < row < ROWS and 0 < column < COLUMNS
            x = column + (0.6 * (angle % 1 - 0.5) if inner else 0)
            y = row + (0.6 * ((3.7 * angle) % 1 - 0.5) if inner else 0)
            # Exact in both sizes of reals.
            points.append(struct.unpack("ff", struct.pack("ff", x, y)))
    for row in range(ROWS):
        for column in range(COLUMNS):
            a = row * (COLUMNS + 1) + column
            triangles += [(a, a + 1, a + COLUMNS + 2), (a, a + COLUMNS + 2, a + COLUMNS + 1)]
    return points, triangles


class Selafin(tool.ToolTest):

    def test_coordinates_alone_change_and_nothing_where_nothing_moves(self):
        points, triangles = plate()
        self.write("all.txt", "\n".join(map(str, range(len(points)))))
        hashes = set()
        for order in "><":
            for real in "fd":
                with self.subTest(order=order, real=real):
                    values = [[p[0] for p in points], [2 * p[1] for p in points]]
                    data = write_selafin(points, triangles, order, real, ["VELOCITY U      M/S", "FREE SURFACE    M"],
                                         [(0, values), (1.5, values[::-1])], (5, 7))
                    self.write("in.slf", data)
                    report = self.report("smooth", "in.slf", "out.slf")
                    hashes.add((real, report["coordinates_hash"]))
                    self.assertGreater(report["smoothing"]["moved_vertices"], 20)
                    before, after = read_selafin(data, order), read_selafin(self.read("out.slf"), order)
                    moved = sum(a != b for a, b in zip(before["points"], after["points"]))
                    self.assertEqual(moved, report["smoothing"]["moved_vertices"])
                    self.assertEqual(write_selafin(after["points"], triangles, order, real, ["VELOCITY U      M/S",
                                     "FREE SURFACE    M"], [(0, values), (1.5, values[::-1])], (5, 7)),
                                     self.read("out.slf"))
                    self.run_tool("smooth", "in.slf", "same.slf", "--fixed-ids", "all.txt")
                    self.assertEqual(self.read("same.slf"), data)
        self.assertEqual(len(hashes), 2)

    def test_the_bottom_follows_the_mesh_and_other_values_where_that_is_asked_for(self):
        points, triangles = plate()
        values = [[10 + p[0] for p in points], [20 - p[1] for p in points]]
        self.write("in.slf", write_selafin(points, triangles, ">", "d", ["BOTTOM          M", "HEAT"], [(0, values)]))
        for option, followers in ((("--fields", "keep"), ()), ((), (0,)), (("--fields", "interpolate"), (0, 1))):
            self.run_tool("smooth", "in.slf", "out.slf", *option)
            after = read_selafin(self.read("out.slf"))
            for variable, of_place in ((0, lambda p: 10 + p[0]), (1, lambda p: 20 - p[1])):
                for point, old, value in zip(after["points"], values[variable], after["steps"][0][1][variable]):
                    self.assertAlmostEqual(value, of_place(point) if variable in followers else old, delta=1e-9)

    def test_other_formats_are_written_as_selafin_with_their_values(self):
        points, triangles = plate()
        values = [[10 + p[0] for p in points]]
        self.write("in.slf", write_selafin(points, triangles, ">", "d", ["BOTTOM          M"], [(0, values)]))
        self.write("all.txt", "\n".join(map(str, range(len(points)))))
        for through in ("middle.vtk", "middle.14", "middle.2dm"):
            with self.subTest(through):
                self.run_tool("smooth", "in.slf", through, "--fixed-ids", "all.txt")
                self.run_tool("smooth", through, "out.slf", "--fixed-ids", "all.txt")
                found = read_selafin(self.read("out.slf"))
                self.assertEqual(found["points"], points)
                self.assertEqual(found["triangles"], triangles)
                self.assertEqual([name.split()[0] for name in found["variables"]], ["BOTTOM"])
                self.assertEqual(found["steps"], [(0, values)])
                ring = [point for number, point in sorted(zip(found["boundary"], points)) if number > 0]
                self.assertEqual(ring[0], (0, 0))
                self.assertEqual(len(ring), 2 * (COLUMNS + ROWS))
                for a, b in zip(ring, ring[1:]):
                    self.assertEqual(abs(a[0] - b[0]) + abs(a[1] - b[1]), 1)


if __name__ == "__main__":
    tool.main()
