#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes channel.msh, airfoil.su2 and bay.14 from the geometries beside them: files as Gmsh, SU2 and ADCIRC have them.

Needs Gmsh for Python (4.15.2 made the files that are here; other versions give other triangles). Vertices inside a
surface are moved a little at random, as a simple generator or a deformation would leave them; those on lines stay.
"""

import math
import pathlib
import random

import gmsh

FOLDER = pathlib.Path(__file__).resolve().parent


def mesh(name, jitter):
    """Meshes the geometry as the current model. A vertex moves by up to `jitter` times its shortest edge."""
    gmsh.clear()
    gmsh.open(str(FOLDER / f"{name}.geo"))
    gmsh.model.mesh.generate(2)
    places, edges = points(), {}
    for a, b, c in triangles():
        for i, j in ((a, b), (b, c), (c, a)):
            length = math.dist(places[i], places[j])
            edges[i] = min(edges.get(i, length), length)
            edges[j] = min(edges.get(j, length), length)
    numbers = random.Random(1)
    for _, surface in gmsh.model.getEntities(2):
        for tag in sorted(map(int, gmsh.model.mesh.getNodes(2, surface)[0])):
            angle = numbers.uniform(0, 2 * math.pi)
            way = numbers.uniform(0, jitter) * edges[tag]
            x, y = places[tag]
            gmsh.model.mesh.setNode(tag, [x + way * math.cos(angle), y + way * math.sin(angle), 0], [])


def points():
    tags, flat, _ = gmsh.model.mesh.getNodes()
    return {int(tag): (float(flat[3 * i]), float(flat[3 * i + 1])) for i, tag in enumerate(tags)}


def triangles():
    nodes = gmsh.model.mesh.getElementsByType(2)[1]
    return [tuple(map(int, nodes[i:i + 3])) for i in range(0, len(nodes), 3)]


def nodes_along(group):
    """The nodes of a physical curve of one curve, one behind the other; the first comes again where it is closed."""
    tag, = (tag for dimension, tag in gmsh.model.getPhysicalGroups(1)
            if gmsh.model.getPhysicalName(dimension, tag) == group)
    curve, = gmsh.model.getEntitiesForPhysicalGroup(1, tag)
    nodes = gmsh.model.mesh.getElementsByType(1, curve)[1]
    following = {int(nodes[i]): int(nodes[i + 1]) for i in range(0, len(nodes), 2)}
    starts = set(following) - set(following.values())
    chain = [min(starts or following)]
    while chain[-1] in following:
        chain.append(following.pop(chain[-1]))
    return chain


def depth(x, y, shore):
    """Metres of water: shallow at the shore, deep out in the sea."""
    away = 111 * min(math.hypot((x - a) * math.cos(math.radians(41.4)), y - b) for a, b in shore)
    return 1.5 + 2.2 * away + 0.05 * away * away


def write_bay(path):
    cells = triangles()
    # Points of splines are nodes of no triangle.
    used = sorted({tag for cell in cells for tag in cell})
    places = {tag: place for tag, place in points().items() if tag in set(used)}
    numbers = {tag: number for number, tag in enumerate(used, 1)}
    boundaries = {name: nodes_along(name) for name in ("open", "shore", "island")}
    shore = [places[tag] for name in ("shore", "island") for tag in boundaries[name]]
    lines = ["A bay with an island; made for trials, not for navigation", f"{len(cells)} {len(places)}"]
    for tag in used:
        x, y = places[tag]
        lines.append(f"{numbers[tag]:6d} {x:15.10f} {y:15.10f} {depth(x, y, shore):12.5f}")
    for number, cell in enumerate(cells, 1):
        lines.append(f"{number:6d} 3 {' '.join(f'{numbers[tag]:6d}' for tag in cell)}")
    lines.append("1 = Number of open boundaries")
    lines.append(f"{len(boundaries['open'])} = Total number of open boundary nodes")
    lines.append(f"{len(boundaries['open'])} = Number of nodes for open boundary 1")
    lines += [f"{numbers[tag]}" for tag in boundaries["open"]]
    land = [(0, boundaries["shore"]), (1, boundaries["island"])]
    lines.append(f"{len(land)} = Number of land boundaries")
    lines.append(f"{sum(len(nodes) for _, nodes in land)} = Total number of land boundary nodes")
    for number, (kind, nodes) in enumerate(land, 1):
        lines.append(f"{len(nodes)} {kind} = Number of nodes and type of land boundary {number}")
        lines += [f"{numbers[tag]}" for tag in nodes]
    path.write_text("\n".join(lines) + "\n")


def main():
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    mesh("channel", 0.4)
    gmsh.option.setNumber("Mesh.MshFileVersion", 4.1)
    gmsh.write(str(FOLDER / "channel.msh"))
    mesh("airfoil", 0.35)
    gmsh.write(str(FOLDER / "airfoil.su2"))
    mesh("bay", 0.4)
    write_bay(FOLDER / "bay.14")
    gmsh.finalize()


if __name__ == "__main__":
    main()
