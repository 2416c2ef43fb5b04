# SPDX-License-Identifier: BSD-3-Clause
"""Makes small meshes in every format and spelling of it. All are one jittered grid, two regions, some vertices free."""

import base64
import random
import struct
import zlib

LINE, TRIANGLE, QUAD = 3, 5, 9


class Grid:
    """An n x n grid of squares, each cut in two; `others` adds line and quad cells at its rim."""

    def __init__(self, n=8, seed=1, others=False):
        # The seed is the caller's: the same mesh every time.
        chance = random.Random(seed)
        jitter = lambda i: chance.uniform(-0.35, 0.35) if 0 < i < n else 0.0
        self.points = []
        for y in range(n + 1):
            for x in range(n + 1):
                inside = 0 < x < n and 0 < y < n
                dx, dy = (jitter(x), jitter(y)) if inside else (0.0, 0.0)
                self.points.append((round(x + dx, 6), round(y + dy, 6), 0.0))
        self.cells, self.regions = [], []
        if others:
            self.cells.append((LINE, (0, 1)))
            self.regions.append(7)
        for y in range(n):
            for x in range(n):
                a = y * (n + 1) + x
                b, c, d = a + 1, a + n + 2, a + n + 1
                halves = [(a, b, c), (a, c, d)] if (x + y) % 2 else [(a, b, d), (b, c, d)]
                if others and x == n - 1:
                    self.cells.append((QUAD, (a, b, c, d)))
                    self.regions.append(3)
                else:
                    self.cells += [(TRIANGLE, half) for half in halves]
                    self.regions += [1 if y < n // 2 else 2] * 2

    def polygons(self):
        return [cell for kind, cell in self.cells if kind != LINE]


def coordinates(point):
    return " ".join(repr(x) if x != int(x) else str(int(x)) for x in point)


def off(grid, keyword="OFF", fields=lambda i: "", newline="\n", comment=False):
    lines = [keyword, f"{len(grid.points)} {len(grid.polygons())} 0"]
    rows = [coordinates(p) + fields(i) for i, p in enumerate(grid.points)]
    if comment:
        lines[1:1] = ["# made for a test", ""]
        rows = [f"  {row}\t# vertex {i}" if i % 3 else row for i, row in enumerate(rows)]
    lines += rows
    lines += [f"{len(c)} {' '.join(map(str, c))}" for c in grid.polygons()]
    return (newline.join(lines) + newline).encode()


def obj(grid):
    lines = ["# made for a test", "mtllib plate.mtl", "o plate", *(f"v {coordinates(p)}" for p in grid.points), "g lower"]
    lines += ["f " + " ".join(str(v + 1) for v in cell) for cell in grid.polygons()]
    return ("\n".join(lines) + "\n").encode()


def ply(grid, encoding, scalar="double"):
    head = ["ply", f"format {encoding} 1.0", "comment made for a test", f"element vertex {len(grid.points)}"]
    head += ["property uchar quality"] + [f"property {scalar} {axis}" for axis in "xyz"] + ["property short tag"]
    head += [f"element face {len(grid.polygons())}", "property list uchar int vertex_indices", "property uchar red"]
    head += ["element edge 2", "property int vertex1", "property int vertex2", "end_header", ""]
    text = "\n".join(head).encode()
    code = {"double": "d", "float": "f"}[scalar]
    if encoding == "ascii":
        rows = [f"{i % 256} {coordinates(p)} {i - 40}" for i, p in enumerate(grid.points)]
        rows += [f"{len(c)} {' '.join(map(str, c))} {i % 256}" for i, c in enumerate(grid.polygons())]
        return text + "\n".join(rows + ["0 1", "1 2", ""]).encode()
    order = "<" if "little" in encoding else ">"
    for i, p in enumerate(grid.points):
        text += struct.pack(f"{order}B3{code}h", i % 256, *p, i - 40)
    for i, c in enumerate(grid.polygons()):
        text += struct.pack(f"{order}B{len(c)}iB", len(c), *c, i % 256)
    return text + struct.pack(f"{order}4i", 0, 1, 1, 2)


def stl(grid, binary, solid=b"solid plate"):
    if binary:
        text = solid.ljust(80, b"\0") + struct.pack("<I", len(grid.polygons()))
        for i, cell in enumerate(grid.polygons()):
            text += struct.pack("<3f", 0, 0, 1) + b"".join(struct.pack("<3f", *grid.points[v]) for v in cell)
            text += struct.pack("<H", i)
        return text
    text = solid.decode() + "\n"
    for cell in grid.polygons():
        corners = "".join(f"      vertex {coordinates(grid.points[v])}\n" for v in cell)
        text += f"  facet normal 0 0 1\n    outer loop\n{corners}    endloop\n  endfacet\n"
    return (text + "endsolid plate\n").encode()


def legacy_vtk(grid, binary=False, version="3.0", polydata=False, scalar="double"):
    """Version 5.1 stores cells as offsets and connectivity; the older ones as counts and vertices in turn."""
    def numbers(code, values, per_line=9):
        if binary:
            return struct.pack(f">{len(values)}{code}", *values) + b"\n"
        rows = [values[i:i + per_line] for i in range(0, len(values), per_line)]
        return "".join(" ".join(map(str, row)) + "\n" for row in rows).encode()

    def cell_block(keyword, cells):
        flat = [v for cell in cells for v in cell]
        if version == "5.1":
            offsets = [0]
            for cell in cells:
                offsets.append(offsets[-1] + len(cell))
            return (f"{keyword} {len(offsets)} {len(flat)}\nOFFSETS vtktypeint64\n".encode() + numbers("q", offsets) +
                    b"CONNECTIVITY vtktypeint64\n" + numbers("q", flat))
        stream = [n for cell in cells for n in (len(cell), *cell)]
        return f"{keyword} {len(cells)} {len(stream)}\n".encode() + numbers("i", stream)

    code = {"double": "d", "float": "f"}[scalar]
    text = (f"# vtk DataFile Version {version}\nmade for a test\n{'BINARY' if binary else 'ASCII'}\n"
            f"DATASET {'POLYDATA' if polydata else 'UNSTRUCTURED_GRID'}\n"
            f"FIELD FieldData 1\nTIME 1 1 double\n").encode() + numbers("d", [0.25])
    text += f"POINTS {len(grid.points)} {scalar}\n".encode() + numbers(code, [x for p in grid.points for x in p], 6)
    if polydata:
        lines = [cell for kind, cell in grid.cells if kind == LINE]
        text += cell_block("LINES", lines) if lines else b""
        text += cell_block("POLYGONS", grid.polygons())
    else:
        text += cell_block("CELLS", [cell for _, cell in grid.cells])
        text += f"CELL_TYPES {len(grid.cells)}\n".encode() + numbers("i", [kind for kind, _ in grid.cells])
    text += f"CELL_DATA {len(grid.cells)}\nSCALARS region int 1\nLOOKUP_TABLE default\n".encode()
    text += numbers("i", grid.regions)
    text += f"FIELD FieldData 1\nload 2 {len(grid.cells)} float\n".encode()
    text += numbers("f", [i / 4 for i in range(2 * len(grid.cells))])
    text += f"POINT_DATA {len(grid.points)}\nVECTORS velocity double\n".encode()
    return text + numbers("d", [i / 8 for i in range(3 * len(grid.points))])


CODES = {"Float64": "d", "Float32": "f", "Int64": "q", "Int32": "i", "UInt8": "B"}


class XmlWriter:
    """Spells the arrays of a .vtu or .vtp file in one of VTK's ways."""

    def __init__(self, mode, compressed=False, word="UInt32", order="<"):
        self.mode, self.compressed, self.order = mode, compressed, order
        self.word, self.word_code = word, {"UInt32": "I", "UInt64": "Q"}[word]
        self.appended = b""

    def encoded(self, data, is_base64):
        words = lambda *values: struct.pack(f"{self.order}{len(values)}{self.word_code}", *values)
        if not self.compressed:
            head, body = b"", words(len(data)) + data
        else:
            block = 1000
            parts = [data[i:i + block] for i in range(0, len(data), block)]
            packed = [zlib.compress(part) for part in parts]
            last = len(data) % block
            head, body = words(len(parts), block, last, *map(len, packed)), b"".join(packed)
        return base64.b64encode(head) + base64.b64encode(body) if is_base64 else head + body

    def array(self, name, kind, components, values):
        begin = f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}"'.encode()
        if self.mode == "ascii":
            return begin + b' format="ascii">\n' + " ".join(map(str, values)).encode() + b"\n</DataArray>\n"
        data = struct.pack(f"{self.order}{len(values)}{CODES[kind]}", *values)
        if self.mode == "binary":
            return begin + b' format="binary">\n' + self.encoded(data, True) + b"\n</DataArray>\n"
        offset = len(self.appended)
        self.appended += self.encoded(data, self.mode == "appended base64")
        return begin + f' format="appended" offset="{offset}"/>\n'.encode()

    def file(self, kind, body):
        order = "LittleEndian" if self.order == "<" else "BigEndian"
        head = f'<?xml version="1.0"?>\n<VTKFile type="{kind}" version="1.0" byte_order="{order}"'
        head += f' header_type="{self.word}"'
        head += ' compressor="vtkZLibDataCompressor">\n' if self.compressed else ">\n"
        text = head.encode() + f"<{kind}>\n".encode() + body + f"</{kind}>\n".encode()
        if self.mode.startswith("appended"):
            encoding = self.mode.split()[1].encode()
            text += b'<AppendedData encoding="' + encoding + b'">\n_' + self.appended + b"\n</AppendedData>\n"
        return text + b"</VTKFile>\n"

    def cells(self, cells):
        offsets = [0]
        for cell in cells:
            offsets.append(offsets[-1] + len(cell))
        return (self.array("connectivity", "Int64", 1, [v for cell in cells for v in cell]) +
                self.array("offsets", "Int64", 1, offsets[1:]))

    def shared_parts(self, grid, scalar):
        points = self.array("Points", scalar, 3, [x for p in grid.points for x in p])
        return (b"<PointData Scalars=\"depth\">\n" +
                self.array("depth", "Float32", 1, [i / 4 for i in range(len(grid.points))]) + b"</PointData>\n" +
                b"<CellData>\n" + self.array("region", "Int32", 1, grid.regions) +
                self.array("load", "Float64", 2, [i / 8 for i in range(2 * len(grid.cells))]) + b"</CellData>\n" +
                b"<Points>\n" + points + b"</Points>\n")


def vtu(grid, mode="ascii", scalar="Float64", **spelling):
    writer = XmlWriter(mode, **spelling)
    body = f'<Piece NumberOfPoints="{len(grid.points)}" NumberOfCells="{len(grid.cells)}">\n'.encode()
    body += writer.shared_parts(grid, scalar)
    body += b"<Cells>\n" + writer.cells([cell for _, cell in grid.cells])
    body += writer.array("types", "UInt8", 1, [kind for kind, _ in grid.cells]) + b"</Cells>\n</Piece>\n"
    return writer.file("UnstructuredGrid", body)


def vtp(grid, mode="ascii", scalar="Float64", **spelling):
    writer = XmlWriter(mode, **spelling)
    lines = [cell for kind, cell in grid.cells if kind == LINE]
    body = (f'<Piece NumberOfPoints="{len(grid.points)}" NumberOfVerts="0" NumberOfLines="{len(lines)}" '
            f'NumberOfStrips="0" NumberOfPolys="{len(grid.polygons())}">\n').encode()
    body += writer.shared_parts(grid, scalar)
    for section, cells in (("Verts", []), ("Lines", lines), ("Strips", []), ("Polys", grid.polygons())):
        body += f"<{section}>\n".encode() + writer.cells(cells) + f"</{section}>\n".encode()
    return writer.file("PolyData", body + b"</Piece>\n")
