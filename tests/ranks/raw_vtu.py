# SPDX-License-Identifier: BSD-3-Clause
"""VTU with raw appended arrays, as ParaView and meshio write it: writes it in all its forms, and reads what the program
writes."""

import re
import struct
import zlib

FORMATS = {"Int8": "b", "UInt8": "B", "Int16": "h", "UInt16": "H", "Int32": "i", "UInt32": "I", "Int64": "q",
           "UInt64": "Q", "Float32": "f", "Float64": "d"}


class Form:
    """How arrays stand in the file."""

    def __init__(self, compressed=False, wide=True, big=False, block=1024, index="Int64", point="Float64"):
        self.compressed = compressed
        self.wide = wide
        self.big = big
        self.block = block
        self.index = index
        self.point = point

    def __repr__(self):
        return repr(vars(self))


def encoded(data, form):
    """The bytes of an array with the header in front of them."""
    order = ">" if form.big else "<"
    word = order + ("Q" if form.wide else "I")
    if not form.compressed:
        return struct.pack(word, len(data)) + data
    blocks = [data[i:i + form.block] for i in range(0, len(data), form.block)]
    packed = [zlib.compress(block) for block in blocks]
    last = len(blocks[-1]) % form.block if blocks else 0
    words = [len(blocks), form.block, last, *map(len, packed)]
    return b"".join(struct.pack(word, value) for value in words) + b"".join(packed)


def write(path, mesh, form, field=None):
    """`field`: values of an array of the whole mesh."""
    order = ">" if form.big else "<"
    appended = b""
    xml = []

    def array(name, kind, values, components=1, more=""):
        nonlocal appended
        data = struct.pack(f"{order}{len(values)}{FORMATS[kind]}", *values)
        xml.append(f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}"{more} format="appended" '
                   f'offset="{len(appended)}"/>\n')
        appended += encoded(data, form)

    def kind_of(values):
        return "Int32" if all(isinstance(value, int) for value in values) else "Float64"

    offsets = []
    for cell in mesh.cells:
        offsets.append((offsets[-1] if offsets else 0) + len(cell))
    if field:
        xml.append("<FieldData>\n")
        array("field", "Float64", field, more=f' NumberOfTuples="{len(field)}"')
        xml.append("</FieldData>\n")
    xml.append(f'<Piece NumberOfPoints="{len(mesh.points)}" NumberOfCells="{len(mesh.cells)}">\n')
    for section, arrays in (("PointData", mesh.point_arrays), ("CellData", mesh.cell_arrays)):
        xml.append(f"<{section}>\n")
        for name, values in arrays.items():
            array(name, kind_of(values), values)
        xml.append(f"</{section}>\n")
    xml.append("<Points>\n")
    array("Points", form.point, [x for p in mesh.points for x in p], 3)
    xml.append("</Points>\n<Cells>\n")
    array("connectivity", form.index, [v for cell in mesh.cells for v in cell])
    array("offsets", form.index, offsets)
    array("types", "UInt8", mesh.types)
    xml.append("</Cells>\n</Piece>\n")
    with open(path, "wb") as file:
        file.write(('<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="1.0" '
                    f'byte_order="{"BigEndian" if form.big else "LittleEndian"}" '
                    f'header_type="{"UInt64" if form.wide else "UInt32"}"' +
                    (' compressor="vtkZLibDataCompressor"' if form.compressed else "") +
                    ">\n<UnstructuredGrid>\n" + "".join(xml) + '</UnstructuredGrid>\n<AppendedData encoding="raw">\n_'
                    ).encode())
        file.write(appended)
        file.write(b"\n</AppendedData>\n</VTKFile>\n")


def read(path):
    """(section, name) -> rows of numbers, of a file that is not compressed, as the program writes it."""
    with open(path, "rb") as file:
        content = file.read()
    mark = content.index(b"_", content.index(b"<AppendedData")) + 1
    head = content[:mark].decode()
    assert 'header_type="UInt64"' in head and 'byte_order="LittleEndian"' in head, head[:300]
    found = {}
    section = None
    for tag in re.findall(r"<([^>]*)>", head):
        name = tag.split()[0]
        if name in ("PointData", "CellData", "Points", "Cells", "FieldData"):
            section = name
        if name == "DataArray":
            attributes = dict(re.findall(r'(\w+)="([^"]*)"', tag))
            at = mark + int(attributes["offset"])
            size = struct.unpack_from("<Q", content, at)[0]
            kind = FORMATS[attributes["type"]]
            values = struct.unpack_from(f"<{size // struct.calcsize(kind)}{kind}", content, at + 8)
            components = int(attributes.get("NumberOfComponents", 1))
            found[(section, attributes["Name"])] = [
                values[i] if components == 1 else values[i:i + components] for i in range(0, len(values), components)]
    return found
