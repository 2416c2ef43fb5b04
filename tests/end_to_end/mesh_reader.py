# SPDX-License-Identifier: BSD-3-Clause
"""Reads mesh files independently of the program: points, cells, arrays, and where in the bytes the coordinates are.

Slow and strict, for well-formed files only. XML formats go through compare_vtu.py.
"""

import os
import re
import struct
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "mesh_io"))
import compare_vtu  # noqa: E402

TRIANGLE, QUAD, LINE, VERTEX, POLYGON = 5, 9, 3, 1, 7


class Mesh:
    """`points` as (x, y, z), `cells` as (type, vertices), arrays by name as lists of tuples.

    `spans[v]` lists a vertex's places in `content`, each as three (begin, end), one for each coordinate.
    """

    def __init__(self, content):
        self.content = content
        self.points = []
        self.cells = []
        self.spans = []
        self.cell_arrays = {}
        self.point_arrays = {}
        self.vtk_file = None

    def elements(self):
        """(cell number, vertices) of each proper triangle and quadrilateral."""
        return [(i, vertices) for i, (kind, vertices) in enumerate(self.cells)
                if kind in (TRIANGLE, QUAD, POLYGON) and len(vertices) in (3, 4) and len(set(vertices)) == len(vertices)]


def polygon_type(count):
    return {3: TRIANGLE, 4: QUAD}.get(count, POLYGON)


def as_float32(value):
    return struct.unpack("<f", struct.pack("<f", value))[0]


def tokens_of(content, begin, end):
    return [match.span() for match in re.compile(rb"[^\s]+").finditer(content, begin, end)]


def lines_of(content, comment=b"#"):
    """The tokens' spans of each line that holds any, comments left out."""
    for match in re.compile(rb"[^\r\n]+").finditer(content):
        begin, end = match.span()
        cut = content.find(comment, begin, end)
        tokens = tokens_of(content, begin, end if cut < 0 else cut)
        if tokens:
            yield tokens


def read_off(content):
    mesh = Mesh(content)
    text = lambda span: content[span[0]:span[1]]
    lines = list(lines_of(content))
    first = text(lines[0][0]).removeprefix(b"\xef\xbb\xbf")
    fields = b""
    if first.endswith(b"OFF"):
        fields = first[:-3]
        lines[0] = lines[0][1:]
    lines = [line for line in lines if line]
    head = [span for line in lines[:3] for span in line][:3]
    vertex_count, face_count = int(text(head[0])), int(text(head[1]))
    while len(head) > 0:  # drop the counts, however they are laid out
        taken = min(len(head), len(lines[0]))
        head, lines[0] = head[taken:], lines[0][taken:]
        lines = lines if lines[0] else lines[1:]
    while len(mesh.points) < vertex_count:
        line = lines.pop(0)
        # With optional fields a vertex has a line of its own; without, any layout is allowed.
        while not fields and len(line) % 3:
            line += lines.pop(0)
        for i in range(0, 3 if fields else len(line), 3):
            mesh.points.append(tuple(float(text(span)) for span in line[i:i + 3]))
            mesh.spans.append([line[i:i + 3]])
    for line in lines[:face_count]:
        count = int(text(line[0]))
        mesh.cells.append((polygon_type(count), tuple(int(text(span)) for span in line[1:1 + count])))
    return mesh


VTK_CODES = {"char": "b", "unsigned_char": "B", "short": "h", "unsigned_short": "H", "int": "i", "unsigned_int": "I",
             "long": "q", "unsigned_long": "Q", "vtktypeint64": "q", "vtkidtype": "i", "float": "f", "double": "d"}


class LegacyVtk:
    """The parser of a legacy VTK file: keyword after keyword."""

    def __init__(self, content):
        self.content = content
        self.mesh = Mesh(content)
        lines = content.split(b"\n", 3)
        self.binary = lines[2].strip() == b"BINARY"
        self.position = sum(len(line) + 1 for line in lines[:3])
        self.pending = {key: [] for key in ("VERTICES", "LINES", "POLYGONS", "TRIANGLE_STRIPS")}
        self.streams = []
        self.section, self.rows = None, 0
        while self.position < len(content):
            words = self.line()
            if words:
                self.keyword(words[0].upper(), words)
        self.finish()

    def line(self):
        end = self.content.find(b"\n", self.position)
        end = len(self.content) if end < 0 else end
        line = self.content[self.position:end]
        self.position = end + 1
        return line.decode().split()

    def numbers(self, count, kind):
        """(values, spans) of the numbers that follow."""
        code = VTK_CODES[kind.lower()]
        if self.binary:
            size = struct.calcsize(">" + code)
            begin = self.position
            self.position = begin + count * size
            values = struct.unpack(f">{count}{code}", self.content[begin:self.position])
            return values, [(begin + i * size, begin + (i + 1) * size) for i in range(count)]
        spans = []
        for match in re.compile(rb"\S+").finditer(self.content, self.position):
            if len(spans) == count:
                break
            spans.append(match.span())
        self.position = spans[-1][1] if spans else self.position
        values = [float(self.content[a:b]) if code in "fd" else int(self.content[a:b]) for a, b in spans]
        return [as_float32(value) if code == "f" else value for value in values], spans

    def keyword(self, word, words):
        if word == "POINTS":
            values, spans = self.numbers(3 * int(words[1]), words[2])
            for i in range(0, len(values), 3):
                self.mesh.points.append(tuple(values[i:i + 3]))
                self.mesh.spans.append([spans[i:i + 3]])
        elif word == "CELLS" or word in self.pending:
            cells = self.cell_list(int(words[1]), int(words[2]))
            self.streams.append((word, cells))
        elif word == "CELL_TYPES":
            self.types = self.numbers(int(words[1]), "int")[0]
        elif word in ("POINT_DATA", "CELL_DATA"):
            self.section, self.rows = word, int(words[1])
        elif word == "SCALARS":
            components = int(words[3]) if len(words) > 3 else 1
            self.line()  # LOOKUP_TABLE
            self.array(words[1], components, words[2], self.rows)
        elif word in ("VECTORS", "NORMALS"):
            self.array(words[1], 3, words[2], self.rows)
        elif word == "LOOKUP_TABLE":
            self.numbers(4 * int(words[2]), "unsigned_char" if self.binary else "float")
        elif word == "FIELD":
            for _ in range(int(words[2])):
                head = []
                while not head:
                    head = self.line()
                self.array(head[0], int(head[1]), head[3], int(head[2]))
        elif word == "METADATA":
            while self.line():
                pass
        elif word != "DATASET":
            raise ValueError(f"keyword {word} is not known here")

    def array(self, name, components, kind, rows):
        values = self.numbers(components * rows, kind)[0]
        table = {"POINT_DATA": self.mesh.point_arrays, "CELL_DATA": self.mesh.cell_arrays}.get(self.section, {})
        table[name] = [tuple(values[i:i + components]) for i in range(0, len(values), components)]

    def cell_list(self, count, size):
        start = self.position
        words = self.line()
        if words and words[0] == "OFFSETS":
            offsets = self.numbers(count, words[1])[0]
            words = self.line() or self.line()
            connectivity = self.numbers(size, words[1])[0]
            return [tuple(connectivity[a:b]) for a, b in zip(offsets, offsets[1:])]
        self.position = start
        stream, cells, i = self.numbers(size, "int")[0], [], 0
        while len(cells) < count:
            cells.append(tuple(stream[i + 1:i + 1 + stream[i]]))
            i += 1 + stream[i]
        return cells

    def finish(self):
        order = ["CELLS", *self.pending]
        for word, cells in sorted(self.streams, key=lambda stream: order.index(stream[0])):
            if word == "CELLS":
                self.mesh.cells += zip(self.types, cells)
            elif word == "POLYGONS":
                self.mesh.cells += [(polygon_type(len(cell)), cell) for cell in cells]
            else:
                self.mesh.cells += [({"VERTICES": VERTEX, "LINES": LINE}.get(word, 6), cell) for cell in cells]


def unpacked(entry):
    _, kind, components, data, _ = entry
    code = compare_vtu.CODES[kind]
    values = struct.unpack(f"<{len(data) // struct.calcsize('<' + code)}{code}", data)
    return [tuple(values[i:i + components]) for i in range(0, len(values), components)]


def read_xml(path):
    file = compare_vtu.VtkFile(path)
    mesh = Mesh(None)
    mesh.vtk_file = file
    mesh.points = unpacked(file.sections["Points"][0])
    cell_sections = {"Cells": None, "Verts": VERTEX, "Lines": LINE, "Strips": 6, "Polys": POLYGON}
    for section, kind in cell_sections.items():
        arrays = {entry[0]: [row[0] for row in unpacked(entry)] for entry in file.sections.get(section, [])}
        begin = 0
        for i, end in enumerate(arrays.get("offsets", [])):
            vertices = tuple(arrays["connectivity"][begin:end])
            cell = arrays["types"][i] if kind is None else polygon_type(len(vertices)) if kind == POLYGON else kind
            mesh.cells.append((cell, vertices))
            begin = end
    for section, table in (("CellData", mesh.cell_arrays), ("PointData", mesh.point_arrays)):
        for entry in file.sections.get(section, []):
            table[entry[0]] = unpacked(entry)
    return mesh


def read(path):
    extension = os.path.splitext(path)[1].lower()
    if extension in (".vtu", ".vtp"):
        return read_xml(path)
    with open(path, "rb") as file:
        content = file.read()
    if extension == ".vtk":
        return LegacyVtk(content).mesh
    return read_off(content)
