#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Converts the triangles of a Gmsh 2.2 ASCII mesh to OFF, legacy VTK or VTU.

Vertices that no triangle uses are dropped and all triangles made counter-clockwise. With --jitter, vertices inside a
surface are moved a little at random, as they are after a simple generator or a deformation, so that there is something
to smooth; those on the boundary and on the lines between surfaces stay. Python 3 and its standard library suffice.
"""

import argparse
import base64
import math
import pathlib
import random
import struct
import sys
import zlib

LINE, TRIANGLE = 1, 2  # Gmsh's element types
VTK_CELL_TYPE = {LINE: 3, TRIANGLE: 5}


class Cell:
    def __init__(self, kind, physical, surface, vertices):
        self.kind = kind
        self.physical = physical
        self.surface = surface  # or curve
        self.vertices = vertices


class Mesh:
    def __init__(self, points, cells, names):
        self.points = points  # [x, y] each
        self.cells = cells  # lines before triangles
        self.names = names  # of physical groups, by (dimension, number)

    def of_kind(self, kind):
        return [cell for cell in self.cells if cell.kind == kind]

    def triangles(self):
        return [cell.vertices for cell in self.of_kind(TRIANGLE)]


def read_msh(path):
    lines = iter(path.read_text().splitlines())
    places, cells, names = {}, [], {}
    for line in lines:
        if line == "$PhysicalNames":
            for _ in range(int(next(lines))):
                dimension, number, name = next(lines).split(maxsplit=2)
                names[int(dimension), int(number)] = name.strip('"')
        elif line == "$Nodes":
            for _ in range(int(next(lines))):
                node, x, y, _ = next(lines).split()
                places[int(node)] = [float(x), float(y)]
        elif line == "$Elements":
            for _ in range(int(next(lines))):
                fields = [int(field) for field in next(lines).split()]
                kind, tags = fields[1], fields[3 : 3 + fields[2]]
                if kind in VTK_CELL_TYPE:
                    cells.append(Cell(kind, tags[0], tags[1], fields[3 + fields[2] :]))

    used = sorted({node for cell in cells if cell.kind == TRIANGLE for node in cell.vertices})
    index = {node: i for i, node in enumerate(used)}
    points = [places[node] for node in used]
    for cell in cells:
        cell.vertices = [index[node] for node in cell.vertices]
        if cell.kind == TRIANGLE and shape(*(points[v] for v in cell.vertices)) < 0:
            cell.vertices[1], cell.vertices[2] = cell.vertices[2], cell.vertices[1]
    cells.sort(key=lambda cell: cell.kind)
    return Mesh(points, cells, names)


def shape(a, b, c):
    """Lee and Lo's quality: 1 for an equilateral triangle, 0 for a degenerate one, negative for an inverted one."""
    doubled_area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    squares = math.dist(a, b) ** 2 + math.dist(b, c) ** 2 + math.dist(c, a) ** 2
    return 2 * math.sqrt(3) * doubled_area / squares


def edges_of(triangle):
    return [tuple(sorted((triangle[i], triangle[(i + 1) % 3]))) for i in range(3)]


def fixed_vertices(mesh):
    """The ends of edges that do not lie between two triangles of one surface."""
    surfaces = {}
    for cell in mesh.of_kind(TRIANGLE):
        for edge in edges_of(cell.vertices):
            surfaces.setdefault(edge, []).append(cell.surface)
    return {v for edge, sides in surfaces.items() if len(sides) != 2 or sides[0] != sides[1] for v in edge}


def jitter(mesh, amount, lowest_shape, seed):
    """Moves each free vertex by up to `amount` times its shortest edge, unless a triangle's shape falls too low."""
    draw = random.Random(seed).random  # the one method whose sequence Python promises to keep
    fixed = fixed_vertices(mesh)
    incident = [[] for _ in mesh.points]
    for triangle in mesh.triangles():
        for vertex in triangle:
            incident[vertex].append(triangle)
    for vertex, point in enumerate(mesh.points):
        if vertex in fixed:
            continue
        neighbours = {other for triangle in incident[vertex] for other in triangle} - {vertex}
        reach = amount * min(math.dist(point, mesh.points[other]) for other in neighbours)
        angle, distance = 2 * math.pi * draw(), reach * math.sqrt(draw())
        old = list(point)
        point[:] = [old[0] + distance * math.cos(angle), old[1] + distance * math.sin(angle)]
        if any(shape(*(mesh.points[v] for v in triangle)) < lowest_shape for triangle in incident[vertex]):
            point[:] = old


def sea_depth(mesh):
    """Metres of water at each vertex: shelving from the coast and the islands, with banks and a deeper channel."""
    shore = {
        v
        for cell in mesh.of_kind(LINE)
        if mesh.names[1, cell.physical] in ("coast", "islands")
        for v in cell.vertices
    }
    shore_points = [mesh.points[v] for v in shore]
    depths = []
    for x, y in mesh.points:
        distance = min(math.hypot(x - sx, y - sy) for sx, sy in shore_points)
        shelf = 2 + 90 * (1 - math.exp(-distance / 9000)) + distance / 600
        depths.append(shelf * (1 + 0.15 * math.sin(x / 4100) * math.cos(y / 5300)))
    return depths


def write_off(path, mesh, title):
    triangles = mesh.triangles()
    with path.open("w", newline="\n") as file:
        file.write(f"OFF\n# {title}\n{len(mesh.points)} {len(triangles)} 0\n")
        file.writelines(f"{x!r} {y!r} 0\n" for x, y in mesh.points)
        file.writelines(f"3 {a} {b} {c}\n" for a, b, c in triangles)


def write_vtk(path, mesh, title):
    with path.open("w", newline="\n") as file:
        file.write(f"# vtk DataFile Version 3.0\n{title}\nASCII\nDATASET UNSTRUCTURED_GRID\n")
        file.write(f"POINTS {len(mesh.points)} double\n")
        file.writelines(f"{x!r} {y!r} 0\n" for x, y in mesh.points)
        file.write(f"\nCELLS {len(mesh.cells)} {sum(1 + len(cell.vertices) for cell in mesh.cells)}\n")
        file.writelines(f"{len(cell.vertices)} {' '.join(map(str, cell.vertices))}\n" for cell in mesh.cells)
        file.write(f"\nCELL_TYPES {len(mesh.cells)}\n")
        file.writelines(f"{VTK_CELL_TYPE[cell.kind]}\n" for cell in mesh.cells)
        file.write(f"\nCELL_DATA {len(mesh.cells)}\nSCALARS CellEntityIds int 1\nLOOKUP_TABLE default\n")
        file.writelines(f"{cell.physical}\n" for cell in mesh.cells)


VTU_TYPES = {"Float64": "d", "Float32": "f", "Int32": "i", "UInt8": "B"}


def vtu_array(name, kind, components, values, encoding):
    opening = f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}"'
    if encoding == "ascii":
        rows = (values[i : i + components] for i in range(0, len(values), components))
        body = "\n".join(" ".join(map(repr, row)) for row in rows)
        return f'{opening} format="ascii">\n{body}\n</DataArray>\n'
    data = struct.pack(f"<{len(values)}{VTU_TYPES[kind]}", *values)
    if encoding == "base64":
        body = base64.b64encode(struct.pack("<I", len(data)) + data)
    else:
        packed = zlib.compress(data, 9)
        # One block: its number, its size, the size of the last where that is shorter (0: it is not), the packed size.
        body = base64.b64encode(struct.pack("<4I", 1, len(data), 0, len(packed))) + base64.b64encode(packed)
    return f'{opening} format="binary">\n{body.decode()}\n</DataArray>\n'


def write_vtu(path, mesh, title, encoding, depths):
    cells = mesh.of_kind(TRIANGLE)

    def array(*arguments):
        return vtu_array(*arguments, encoding)

    compressor = ' compressor="vtkZLibDataCompressor"' if encoding == "zlib" else ""
    parts = [
        '<?xml version="1.0"?>\n',
        f"<!-- {title} -->\n",
        '<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian" header_type="UInt32"'
        f"{compressor}>\n",
        f'<UnstructuredGrid>\n<Piece NumberOfPoints="{len(mesh.points)}" NumberOfCells="{len(cells)}">\n',
        "<PointData>\n",
        array("depth", "Float32", 1, [float(f"{depth:.2f}") for depth in depths]) if depths else "",
        "</PointData>\n<CellData>\n",
        array("region", "Int32", 1, [cell.physical for cell in cells]),
        "</CellData>\n<Points>\n",
        array("Points", "Float64", 3, [value for x, y in mesh.points for value in (x, y, 0.0)]),
        "</Points>\n<Cells>\n",
        array("connectivity", "Int32", 1, [v for cell in cells for v in cell.vertices]),
        array("offsets", "Int32", 1, [3 * (i + 1) for i in range(len(cells))]),
        array("types", "UInt8", 1, [VTK_CELL_TYPE[TRIANGLE]] * len(cells)),
        "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n",
    ]
    with path.open("w", newline="\n") as file:
        file.writelines(parts)


def summary(mesh):
    shapes = [shape(*(mesh.points[v] for v in triangle)) for triangle in mesh.triangles()]
    lengths = [math.dist(mesh.points[a], mesh.points[b]) for t in mesh.triangles() for a, b in edges_of(t)]
    regions = {cell.physical for cell in mesh.of_kind(TRIANGLE)}
    return (
        f"{len(mesh.points)} vertices, {len(shapes)} triangles, {len(regions)} regions, shape {min(shapes):.3f} at"
        f" worst and {sum(shapes) / len(shapes):.3f} in the mean, longest edge {max(lengths) / min(lengths):.0f} times"
        " the shortest"
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("input", type=pathlib.Path, help="Gmsh mesh, format 2.2, ASCII")
    parser.add_argument("output", type=pathlib.Path, help="by extension: .off, .vtk (keeps lines as cells) or .vtu")
    parser.add_argument("--title", default="", help="one line for the file's head")
    parser.add_argument("--jitter", type=float, default=0, metavar="F", help="move by up to F shortest edges")
    parser.add_argument("--lowest-shape", type=float, default=0.05, metavar="Q", help="jitter stops at this")
    parser.add_argument("--seed", type=int, default=1, help="of the jitter")
    parser.add_argument("--decimals", type=int, default=9, help="digits after the point that coordinates keep")
    parser.add_argument("--encoding", choices=("ascii", "base64", "zlib"), default="ascii", help="of VTU arrays")
    parser.add_argument("--depth", action="store_true", help='VTU: depth at points, from curves "coast" and "islands"')
    arguments = parser.parse_args()

    mesh = read_msh(arguments.input)
    if arguments.jitter > 0:
        jitter(mesh, arguments.jitter, arguments.lowest_shape, arguments.seed)
    for point in mesh.points:
        point[:] = [round(value, arguments.decimals) + 0.0 for value in point]  # + 0.0: no negative zero
    if any(shape(*(mesh.points[v] for v in triangle)) <= 0 for triangle in mesh.triangles()):
        sys.exit(f"{arguments.input}: a triangle is degenerate or inverted; more --decimals may help")

    if arguments.output.suffix == ".off":
        write_off(arguments.output, mesh, arguments.title)
    elif arguments.output.suffix == ".vtk":
        write_vtk(arguments.output, mesh, arguments.title)
    elif arguments.output.suffix == ".vtu":
        depths = sea_depth(mesh) if arguments.depth else None
        write_vtu(arguments.output, mesh, arguments.title, arguments.encoding, depths)
    else:
        sys.exit(f"{arguments.output}: expected a name that ends in .off, .vtk or .vtu")
    print(f"{arguments.output.name}: {summary(mesh)}")


if __name__ == "__main__":
    main()
