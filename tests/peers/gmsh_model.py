# SPDX-License-Identifier: BSD-3-Clause
"""A model in Gmsh: a channel of two materials with a hole, named groups of every dimension, periodic sides."""

import contextlib

import gmsh

WIDTH = 2.0
HEIGHT = 1.0
# (dimension, tag) -> name of every physical group.
GROUPS = {(0, 11): "sensor", (1, 1): "inlet", (1, 2): "outlet", (1, 3): "walls", (1, 4): "hole", (2, 7): "air",
          (2, 9): "steel core"}


@contextlib.contextmanager
def session():
    """Gmsh without a word on the terminal."""
    gmsh.initialize(interruptible=False)
    gmsh.option.setNumber("General.Terminal", 0)
    try:
        yield
    finally:
        gmsh.finalize()


def build(size=0.08, order=1, quads=False):
    """Meshes the model anew, as the current one. Its nodes are not where a smoothing would have them."""
    gmsh.clear()
    gmsh.model.add("channel")
    occ = gmsh.model.occ
    channel = occ.addRectangle(0, 0, 0, WIDTH, HEIGHT)
    core = occ.addRectangle(1.3, 0.2, 0, 0.4, 0.5)
    hole = occ.addDisk(0.6, 0.5, 0, 0.2, 0.2)
    occ.cut([(2, channel)], [(2, hole)])
    pieces, _ = occ.fragment([(2, channel)], [(2, core)])
    sensor = occ.addPoint(1.0, 0.8, 0)
    occ.synchronize()
    surfaces = [tag for dimension, tag in pieces if dimension == 2]
    outer = max(surfaces, key=lambda tag: occ.getMass(2, tag))
    inner = [tag for tag in surfaces if tag != outer]
    gmsh.model.mesh.embed(0, [sensor], 2, outer)
    sides = {"inlet": [], "outlet": [], "walls": [], "hole": []}
    for _, curve in gmsh.model.getBoundary([(2, tag) for tag in surfaces], combined=True, oriented=False):
        x0, y0, _, x1, y1, _ = gmsh.model.getBoundingBox(1, curve)
        if x1 < 0.01:
            sides["inlet"].append(curve)
        elif x0 > WIDTH - 0.01:
            sides["outlet"].append(curve)
        elif y1 < 0.01 or y0 > HEIGHT - 0.01:
            sides["walls"].append(curve)
        else:
            sides["hole"].append(curve)
    members = {"sensor": [sensor], "air": [outer], "steel core": inner, **sides}
    for (dimension, tag), name in GROUPS.items():
        gmsh.model.addPhysicalGroup(dimension, members[name], tag, name)
    shift = [1, 0, 0, WIDTH, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
    gmsh.model.mesh.setPeriodic(1, sides["outlet"], sides["inlet"], shift)
    gmsh.option.setNumber("Mesh.MeshSizeMax", size)
    gmsh.option.setNumber("Mesh.Smoothing", 0)
    gmsh.option.setNumber("Mesh.Optimize", 0)
    gmsh.option.setNumber("Mesh.RandomSeed", 1)
    if quads:
        for surface in inner:
            gmsh.model.mesh.setRecombine(2, surface)
    gmsh.model.mesh.generate(2)
    gmsh.model.mesh.setOrder(order)
    disturb(outer, inner, 0.25 * size)


def build_embedded(size=0.1):
    """A square with a curve and a point inside, periodic from left to right, and no groups but that of the surface."""
    gmsh.clear()
    gmsh.model.add("embedded")
    occ = gmsh.model.occ
    square = occ.addRectangle(0, 0, 0, 1, 1)
    points = [occ.addPoint(0.3, 0.3, 0), occ.addPoint(0.7, 0.4, 0), occ.addPoint(0.3, 0.7, 0)]
    curve = occ.addLine(points[0], points[1])
    occ.synchronize()
    gmsh.model.mesh.embed(1, [curve], 2, square)
    gmsh.model.mesh.embed(0, [points[2]], 2, square)
    left, right = (next(tag for _, tag in gmsh.model.getBoundary([(2, square)], oriented=False)
                        if abs(gmsh.model.getBoundingBox(1, tag)[0] - x) < 1e-3 and
                        abs(gmsh.model.getBoundingBox(1, tag)[3] - x) < 1e-3) for x in (0, 1))
    gmsh.model.mesh.setPeriodic(1, [right], [left], [1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1])
    gmsh.model.addPhysicalGroup(2, [square], 1, "all")
    gmsh.option.setNumber("Mesh.MeshSizeMax", size)
    gmsh.option.setNumber("Mesh.Smoothing", 0)
    gmsh.option.setNumber("Mesh.Optimize", 0)
    gmsh.model.mesh.generate(2)
    disturb(square, [], 0.25 * size)


def disturb(outer, inner, distance):
    """Moves the inner nodes about, so that there is something to smooth."""
    for surface in [outer, *inner]:
        tags, points, _ = gmsh.model.mesh.getNodes(2, surface)
        is_linear = all(gmsh.model.mesh.getElementProperties(kind)[2] == 1
                        for kind in gmsh.model.mesh.getElementTypes(2, surface))
        if not is_linear:
            continue
        for i, tag in enumerate(tags):
            x, y, z = points[3 * i:3 * i + 3]
            # Any fixed rule will do.
            angle = 2.399963 * float(tag)
            moved = [x + distance * 0.7 * (angle % 1 - 0.5), y + distance * 0.7 * ((3.7 * angle) % 1 - 0.5), z]
            gmsh.model.mesh.setNode(int(tag), moved, [])


def write(path, **options):
    """Writes the current mesh; options are names behind "Mesh." and numbers, back to what they were afterwards."""
    old = {name: gmsh.option.getNumber("Mesh." + name) for name in options}
    for name, value in options.items():
        gmsh.option.setNumber("Mesh." + name, value)
    try:
        gmsh.write(str(path))
    finally:
        for name, value in old.items():
            gmsh.option.setNumber("Mesh." + name, value)


def open_file(path):
    """Reads a file as the only model."""
    gmsh.clear()
    gmsh.merge(str(path))


def points():
    """Node tag -> (x, y, z) of the current mesh."""
    tags, flat, _ = gmsh.model.mesh.getNodes()
    return {int(tag): tuple(flat[3 * i:3 * i + 3]) for i, tag in enumerate(tags)}


def parameters():
    """Node tag -> (u, v) of the nodes inside surfaces, where the file has them."""
    found = {}
    for _, surface in gmsh.model.getEntities(2):
        tags, _, flat = gmsh.model.mesh.getNodes(2, surface)
        if len(flat) == 2 * len(tags):
            found.update({int(tag): tuple(flat[2 * i:2 * i + 2]) for i, tag in enumerate(tags)})
    return found


def rows(tags, values):
    """[(tag, its values)], ascending."""
    each = len(values) // len(tags) if len(tags) else 0
    return sorted((int(tag), *map(int, values[each * i:each * (i + 1)])) for i, tag in enumerate(tags))


def everything_but_points():
    """What Gmsh knows of the current mesh beside the places of its nodes."""
    known = {"groups": {}, "elements": {}, "periodic": {}, "partitions": {}}
    for dimension, tag in gmsh.model.getPhysicalGroups():
        known["groups"][dimension, tag] = (gmsh.model.getPhysicalName(dimension, tag),
                                           sorted(map(int, gmsh.model.getEntitiesForPhysicalGroup(dimension, tag))))
    for dimension, tag in gmsh.model.getEntities():
        kinds, elements, nodes = gmsh.model.mesh.getElements(dimension, tag)
        # Gmsh lists ghosts and periodic nodes in another order each time.
        known["elements"][dimension, tag] = [(int(kind), rows(e, n)) for kind, e, n in zip(kinds, elements, nodes)]
        known["partitions"][dimension, tag] = list(map(int, gmsh.model.getPartitions(dimension, tag)))
        master, own, others, transform = gmsh.model.mesh.getPeriodicNodes(dimension, tag)
        if master != tag:
            known["periodic"][dimension, tag] = (int(master), rows(own, others), list(transform))
    return known


def group_cells():
    """Name of each physical group -> its elements as sorted tuples of places of their nodes, sorted."""
    where = points()
    found = {}
    for dimension, tag in gmsh.model.getPhysicalGroups():
        cells = []
        for entity in gmsh.model.getEntitiesForPhysicalGroup(dimension, tag):
            for kind, _, nodes in zip(*gmsh.model.mesh.getElements(dimension, int(entity))):
                count = gmsh.model.mesh.getElementProperties(kind)[3]
                for i in range(0, len(nodes), count):
                    cells.append(tuple(sorted(where[int(node)] for node in nodes[i:i + count])))
        found[dimension, gmsh.model.getPhysicalName(dimension, tag)] = sorted(cells)
    return found
