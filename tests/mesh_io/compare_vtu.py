#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compare two .vtu or .vtp files array by array: name, type, components and values, bit for bit.

Needs nothing but the standard library, so that it can judge programs that read and write through VTK. It knows ascii,
inline base64, appended base64 and appended raw data, each plain or zlib-compressed, in either byte order, and joins
several pieces the way VTK does for unstructured grids.

Exit status: 0 where the files hold the same, 1 where they differ (each difference on a line), 2 on wrong usage or an
unreadable file.
"""

import argparse
import base64
import re
import struct
import sys
import xml.etree.ElementTree as ElementTree
import zlib

CODES = {"Int8": "b", "UInt8": "B", "Int16": "h", "UInt16": "H", "Int32": "i", "UInt32": "I", "Int64": "q",
         "UInt64": "Q", "Float32": "f", "Float64": "d"}
COUNTS = ("NumberOfPoints", "NumberOfCells", "NumberOfVerts", "NumberOfLines", "NumberOfPolys", "NumberOfStrips")
ATTRIBUTES = ("Scalars", "Vectors", "Normals", "TCoords", "Tensors", "GlobalIds", "PedigreeIds", "EdgeFlag",
              "Tangents", "RationalWeights", "HigherOrderDegrees")


class FileError(Exception):
    """The file is not one that this script can read."""


class Source:
    """Bytes that follow each other, written as base64 or as they are."""

    def __init__(self, data, is_base64):
        self.data = data
        self.is_base64 = is_base64
        self.position = 0

    def take(self, count):
        """The next `count` bytes, which were encoded as one run."""
        size = 4 * ((count + 2) // 3) if self.is_base64 else count
        run = self.data[self.position:self.position + size]
        self.position += size
        result = base64.b64decode(run, validate=True)[:count] if self.is_base64 else run
        if len(result) != count:
            raise FileError("data are cut off")
        return result

    def peek(self, count):
        """The same, without moving on; the run may be longer."""
        position = self.position
        if self.is_base64:
            run = self.data[position:position + 4 * ((count + 2) // 3)]
            return base64.b64decode(run)[:count]
        return self.data[position:position + count]


class VtkFile:
    """The arrays of a file: {section: [(name, type, components, bytes in little-endian order, extra)]}."""

    def __init__(self, path):
        with open(path, "rb") as file:
            content = file.read()
        self.appended = b""
        match = re.search(rb"<AppendedData[^>]*>\s*_", content)
        head = content
        if match:
            end = content.rfind(b"</AppendedData")
            if end < match.end():
                raise FileError("the appended data have no end")
            self.appended = content[match.end():end]
            head = content[:match.end() - 1] + content[end:]
        try:
            self.root = ElementTree.fromstring(head)
        except ElementTree.ParseError as error:
            raise FileError(f"not well-formed: {error}") from error
        section = self.root.find("AppendedData")
        self.appended_base64 = section is not None and section.get("encoding", "base64") == "base64"
        self.order = ">" if self.root.get("byte_order", "LittleEndian") == "BigEndian" else "<"
        self.word = "Q" if self.root.get("header_type", "UInt32") == "UInt64" else "I"
        compressor = self.root.get("compressor")
        if compressor not in (None, "vtkZLibDataCompressor"):
            raise FileError(f"{compressor} is not known here")
        self.compressed = compressor is not None
        self.facts = {key: self.root.get(key) for key in ("type", "byte_order", "compressor")}
        self.facts["header_type"] = self.root.get("header_type", "UInt32")
        self.sections = {}
        self.attributes = {}
        self.modes = {}
        self.read()

    def words(self, source, count, first=0, run=False):
        size = struct.calcsize("<" + self.word)
        data = (source.take if run else source.peek)((first + count) * size)
        return struct.unpack(f"{self.order}{first + count}{self.word}", data)[first:]

    def decode(self, source):
        if not self.compressed:
            size = self.words(source, 1)[0]
            header = struct.calcsize("<" + self.word)
            return source.take(header + size)[header:]
        count, block_size, last_size = self.words(source, 3)
        sizes = self.words(source, count, 3, run=True)
        data = source.take(sum(sizes))
        blocks = []
        for index, size in enumerate(sizes):
            blocks.append(zlib.decompress(data[:size]))
            data = data[size:]
            expected = last_size if index + 1 == count and last_size else block_size
            if len(blocks[-1]) != expected:
                raise FileError("a compressed block has the wrong size")
        return b"".join(blocks)

    def values(self, element, rows):
        """The bytes of an array's values, little-endian; of bits, one byte each."""
        kind = element.get("type")
        mode = element.get("format", "ascii")
        text = element.text or ""
        if mode == "ascii":
            tokens = text.split()
            if kind == "String":
                return bytes(int(token) % 256 for token in tokens)
            if kind == "Bit":
                return bytes(int(token) for token in tokens)
            parse = float if kind.startswith("Float") else int
            return struct.pack(f"<{len(tokens)}{CODES[kind]}", *map(parse, tokens))
        if mode == "binary":
            source = Source("".join(text.split()).encode(), True)
            if not source.data:
                return b""
        else:
            source = Source(self.appended[int(element.get("offset")):], self.appended_base64)
        data = self.decode(source)
        if kind == "Bit":
            count = rows * int(element.get("NumberOfComponents", "1"))
            return bytes(data[i // 8] >> (7 - i % 8) & 1 for i in range(count))
        if kind in CODES and self.order == ">":
            size = struct.calcsize("<" + CODES[kind])
            count = len(data) // size
            # Integers of the same size: floats may be NaN, and their bits have to stay.
            code = {1: "B", 2: "H", 4: "I", 8: "Q"}[size]
            data = struct.pack(f"<{count}{code}", *struct.unpack(f">{count}{code}", data))
        return data

    def read(self):
        data_set = self.root.find(self.root.get("type", ""))
        if data_set is None:
            raise FileError("no data set")
        pieces = data_set.findall("Piece") or [data_set]
        self.facts["counts"] = [sum(int(piece.get(key, "0")) for piece in pieces) for key in COUNTS]
        for number, piece in enumerate(pieces):
            cells = sum(int(piece.get(key, "0")) for key in COUNTS[1:])
            for section in piece:
                self.add(section, number, {"PointData": int(piece.get(COUNTS[0], "0")), "CellData": cells})
        field_data = data_set.find("FieldData")
        if field_data is not None:
            self.add(field_data, 0, {})

    def add(self, section, piece, rows):
        arrays = self.sections.setdefault(section.tag, [])
        for index, element in enumerate(section.findall("DataArray") + section.findall("Array")):
            components = int(element.get("NumberOfComponents", "1"))
            names = tuple(element.get(f"ComponentName{i}") for i in range(components))
            count = rows.get(section.tag, int(element.get("NumberOfTuples", "0")))
            entry = [element.get("Name"), element.get("type"), components, self.values(element, count), names]
            if piece == 0:
                arrays.append(entry)
                self.modes.setdefault(element.get("format", "ascii"), 0)
                self.modes[element.get("format", "ascii")] += 1
            elif section.tag in ("Points", "PointData", "CellData"):
                arrays[index][3] += entry[3]
            else:
                raise FileError("cells in several pieces are not joined here")
        active = {key: section.get(key) for key in ATTRIBUTES if section.get(key)}
        if active:
            self.attributes[section.tag] = active


def differing_values(a, b, kind):
    size = struct.calcsize("<" + CODES.get(kind, "B"))
    if len(a) != len(b):
        return f"{len(a)} bytes and {len(b)} bytes"
    places = [i for i in range(0, len(a), size) if a[i:i + size] != b[i:i + size]]
    code = CODES.get(kind, "B")
    first = places[0]
    values = [struct.unpack("<" + code, data[first:first + size])[0] for data in (a, b)]
    return f"{len(places)} of {len(a) // size} values differ, first number {first // size}: {values[0]!r}, {values[1]!r}"


def differences(first, second, options):
    """One line for every difference."""
    for key in sorted(first.facts):
        if first.facts[key] != second.facts[key] and not (options.ignore_encoding and key != "counts" and key != "type"):
            yield f"{key}: {first.facts[key]}, {second.facts[key]}"
    if not options.ignore_encoding and set(first.modes) != set(second.modes):
        yield f"format: {sorted(first.modes)}, {sorted(second.modes)}"
    for section in sorted(set(first.sections) | set(second.sections)):
        ours = first.sections.get(section, [])
        theirs = second.sections.get(section, [])
        if options.allow_added and section in ("PointData", "CellData"):
            theirs = theirs[:len(ours)]
        if len(ours) != len(theirs):
            yield f"{section}: {len(ours)} arrays, {len(theirs)} arrays"
            continue
        for a, b in zip(ours, theirs):
            name_allowed = section == "Points" and a[0] is None
            if (a[0] != b[0] and not name_allowed) or a[1:3] != b[1:3] or a[4] != b[4]:
                yield f"{section}: {a[:3] + a[4:]}, {b[:3] + b[4:]}"
            elif a[3] != b[3] and not (options.allow_points and section == "Points"):
                yield f"{section} '{a[0]}': {differing_values(a[3], b[3], a[1])}"
            elif len(a[3]) != len(b[3]):
                yield f"{section} '{a[0]}': {len(a[3])} bytes and {len(b[3])} bytes"
    if first.attributes != second.attributes:
        yield f"active attributes: {first.attributes}, {second.attributes}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("first")
    parser.add_argument("second")
    parser.add_argument("--allow-points", action="store_true", help="the values of the points may differ")
    parser.add_argument("--allow-added", action="store_true",
                        help="the second file may have more arrays in PointData and CellData, behind those of the first")
    parser.add_argument("--ignore-encoding", action="store_true",
                        help="formats, byte order, compressor and header type may differ")
    options = parser.parse_args()
    files = []
    for path in (options.first, options.second):
        try:
            files.append(VtkFile(path))
        except (OSError, FileError, ValueError, struct.error, zlib.error) as error:
            print(f"{path}: {error}", file=sys.stderr)
            return 2
    found = list(differences(*files, options))
    for line in found:
        print(line)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
