# SPDX-License-Identifier: BSD-3-Clause
"""Meshes in pieces as VTK's programs write them, and what can be read of them: ASCII, by hand."""

import os
import random
import re
import xml.etree.ElementTree

TRIANGLE = 5


class Mesh:
    """Points (x, y, z), cells (lists of vertices), and arrays by name: a value for every point or cell."""

    def __init__(self, points, cells):
        self.points = points
        self.cells = cells
        self.types = [TRIANGLE if len(cell) == 3 else 9 for cell in cells]
        self.point_arrays = {}
        self.cell_arrays = {}


def grid_of_both_kinds(columns):
    """Squares of a grid, a third of them two triangles, listed either way; more than a thousand of each kind."""
    dice = random.Random(8)
    row = columns + 1
    points = [(x + dice.uniform(-0.3, 0.3), y + dice.uniform(-0.3, 0.3), 0.0) if 0 < x < columns and 0 < y < columns
              else (float(x), float(y), 0.0) for y in range(row) for x in range(row)]
    cells = []
    for y in range(columns):
        for x in range(columns):
            a, b, c, d = y * row + x, y * row + x + 1, (y + 1) * row + x + 1, (y + 1) * row + x
            square = [[a, b, c], [a, c, d]] if dice.random() < 0.33 else [[a, b, c, d]]
            cells += [cell[::-1] if dice.random() < 0.3 else cell for cell in square]
    mesh = Mesh(points, cells)
    mesh.cell_arrays["material"] = [int(points[cell[0]][0] > columns / 2) for cell in cells]
    return mesh


def read_off(path):
    with open(path, encoding="ascii") as file:
        words = file.read().split()
    assert words[0] == "OFF"
    vertices, faces = int(words[1]), int(words[2])
    numbers = words[4:]
    points = [tuple(map(float, numbers[3 * v:3 * v + 3])) for v in range(vertices)]
    at = 3 * vertices
    cells = []
    for _ in range(faces):
        size = int(numbers[at])
        cells.append([int(v) for v in numbers[at + 1:at + 1 + size]])
        at += 1 + size
    return Mesh(points, cells)


def type_of(values):
    return "Int64" if all(isinstance(value, int) for value in values) else "Float64"


def array_xml(name, values, kind=None, components=1):
    # Lines of some values each, as no reader likes one of megabytes.
    texts = [repr(value) for value in values]
    lines = "\n".join(" ".join(texts[i:i + 12]) for i in range(0, len(texts), 12))
    return (f'<DataArray type="{kind or type_of(values)}" Name="{name}" NumberOfComponents="{components}" '
            f'format="ascii">\n{lines}\n</DataArray>\n')


KINDS = {"vtkGhostType": "UInt8", "part": "Int32", "GlobalNodeIds": "Int64"}


def arrays_xml(tag, arrays):
    roles = ' GlobalIds="GlobalNodeIds"' if "GlobalNodeIds" in arrays else ""
    return (f"<{tag}{roles}>\n" + "".join(array_xml(name, values, KINDS.get(name)) for name, values in arrays.items()) +
            f"</{tag}>\n")


def write_vtp(path, mesh):
    """Of triangles and polygons alone."""
    offsets = []
    for cell in mesh.cells:
        offsets.append((offsets[-1] if offsets else 0) + len(cell))
    with open(path, "w", encoding="ascii") as file:
        file.write('<?xml version="1.0"?>\n<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian">\n<PolyData>\n'
                   f'<Piece NumberOfPoints="{len(mesh.points)}" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" '
                   f'NumberOfPolys="{len(mesh.cells)}">\n')
        file.write(arrays_xml("PointData", mesh.point_arrays))
        file.write(arrays_xml("CellData", mesh.cell_arrays))
        file.write("<Points>\n" + array_xml("Points", [x for p in mesh.points for x in p], "Float64", 3) + "</Points>\n")
        file.write("<Polys>\n" + array_xml("connectivity", [v for cell in mesh.cells for v in cell], "Int64") +
                   array_xml("offsets", offsets, "Int64") + "</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n")


def write_vtu(path, mesh, point_type="Float64"):
    offsets = []
    for cell in mesh.cells:
        offsets.append((offsets[-1] if offsets else 0) + len(cell))
    with open(path, "w", encoding="ascii") as file:
        file.write('<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" '
                   'header_type="UInt64">\n<UnstructuredGrid>\n'
                   f'<Piece NumberOfPoints="{len(mesh.points)}" NumberOfCells="{len(mesh.cells)}">\n')
        file.write(arrays_xml("PointData", mesh.point_arrays))
        file.write(arrays_xml("CellData", mesh.cell_arrays))
        file.write("<Points>\n" + array_xml("Points", [x for p in mesh.points for x in p], point_type, 3) + "</Points>\n")
        file.write("<Cells>\n" + array_xml("connectivity", [v for cell in mesh.cells for v in cell], "Int64") +
                   array_xml("offsets", offsets, "Int64") + array_xml("types", mesh.types, "UInt8") + "</Cells>\n")
        file.write("</Piece>\n</UnstructuredGrid>\n</VTKFile>\n")


def write_summary(path, sources, arrays=()):
    with open(path, "w", encoding="ascii") as file:
        file.write('<?xml version="1.0"?>\n<VTKFile type="PUnstructuredGrid" version="1.0" '
                   'byte_order="LittleEndian">\n  <PUnstructuredGrid GhostLevel="1">\n    <PPoints>\n'
                   '      <PDataArray type="Float64" Name="Points" NumberOfComponents="3"/>\n    </PPoints>\n')
        for array in arrays:
            file.write(f"    <!-- {array} -->\n")
        for source in sources:
            file.write(f'    <Piece Source="{source}"/>\n')
        file.write("  </PUnstructuredGrid>\n</VTKFile>\n")


def cut(mesh, part_of_cell, parts, ghosts=True, global_ids=True):
    """The pieces; `ghosts`: with one layer of other pieces' cells at their borders."""
    pieces = []
    for part in range(parts):
        own = [c for c, p in enumerate(part_of_cell) if p == part]
        own_vertices = {v for c in own for v in mesh.cells[c]}
        halo = [c for c, cell in enumerate(mesh.cells) if part_of_cell[c] != part and own_vertices.intersection(cell)]
        cells = own + (halo if ghosts else [])
        numbers = {}
        for c in cells:
            for v in mesh.cells[c]:
                numbers.setdefault(v, len(numbers))
        piece = Mesh([mesh.points[v] for v in numbers], [[numbers[v] for v in mesh.cells[c]] for c in cells])
        piece.types = [mesh.types[c] for c in cells]
        piece.point_arrays = {name: [values[v] for v in numbers] for name, values in mesh.point_arrays.items()}
        piece.cell_arrays = {name: [values[c] for c in cells] for name, values in mesh.cell_arrays.items()}
        if global_ids:
            piece.point_arrays["GlobalNodeIds"] = list(numbers)
        if ghosts:
            piece.cell_arrays["vtkGhostType"] = [0] * len(own) + [1] * len(halo)
            piece.point_arrays["vtkGhostType"] = [0 if v in own_vertices else 1 for v in numbers]
        pieces.append(piece)
    return pieces


def write_pieces(path, pieces, point_type="Float64"):
    """The summary at `path` and the pieces beside it; returns their names."""
    stem = os.path.splitext(os.path.basename(path))[0]
    names = [f"{stem}_{i}.vtu" for i in range(len(pieces))]
    for name, piece in zip(names, pieces):
        write_vtu(os.path.join(os.path.dirname(path), name), piece, point_type)
    write_summary(path, names)
    return names


def stripes(mesh, parts):
    """A part for each cell: stripes along x."""
    def centre(cell):
        return sum(mesh.points[v][0] for v in cell) / len(cell)

    low = min(p[0] for p in mesh.points)
    width = max(p[0] for p in mesh.points) - low
    return [min(parts - 1, int(parts * (centre(cell) - low) / width)) for cell in mesh.cells]


def merged(pieces):
    """The mesh as one file: points at the same place are one, as they come; copies of cells are left out."""
    numbers = {}
    points, cells, types = [], [], []
    point_arrays = {name: [] for name in pieces[0].point_arrays}
    arrays = {name: [] for name in pieces[0].cell_arrays if name != "vtkGhostType"}
    for piece in pieces:
        local = []
        for p, point in enumerate(piece.points):
            if point not in numbers:
                numbers[point] = len(points)
                points.append(point)
                for name in point_arrays:
                    point_arrays[name].append(piece.point_arrays[name][p])
            local.append(numbers[point])
        ghosts = piece.cell_arrays.get("vtkGhostType", [0] * len(piece.cells))
        for c, cell in enumerate(piece.cells):
            if not ghosts[c]:
                cells.append([local[v] for v in cell])
                types.append(piece.types[c])
                for name in arrays:
                    arrays[name].append(piece.cell_arrays[name][c])
    mesh = Mesh(points, cells)
    mesh.types = types
    mesh.point_arrays = point_arrays
    mesh.cell_arrays = arrays
    return mesh


def read_ascii_arrays(path):
    """(section, name) -> the words of that array of an ASCII file, in the file's order."""
    root = xml.etree.ElementTree.parse(path).getroot()
    found = {}
    for section in root.iter():
        if section.tag in ("PointData", "CellData", "Points", "Cells"):
            for array in section.findall("DataArray"):
                found[(section.tag, array.get("Name"))] = (array.get("type"), (array.text or "").split())
    return found


def sources(path):
    with open(path, encoding="ascii") as file:
        return re.findall(r'<Piece Source="([^"]*)"', file.read())
