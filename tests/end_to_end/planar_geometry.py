# SPDX-License-Identifier: BSD-3-Clause
"""What a mesh's fixed vertices, orientation and shapes are, worked out independently of the program."""

import math
import struct

from mesh_reader import Mesh  # noqa: F401  (the type that the functions take)

REGION_NAMES = ("region", "mat_id", "material", "materialids", "cellentityids", "gmsh:physical", "medit:ref",
                "gmsh:geometrical", "attribute", "group")


def sides(element):
    """(corner, next corner), in turn."""
    return list(zip(element, (*element[1:], element[0])))


def edges_of(elements):
    """{(low, high): [element number]}."""
    edges = {}
    for number, element in enumerate(elements):
        for edge in sides(element):
            edges.setdefault((min(edge), max(edge)), []).append(number)
    return edges


def region_values(mesh, cells):
    """The region of each element, by all arrays that name regions; None where there is none."""
    arrays = [rows for name, rows in mesh.cell_arrays.items()
              if name.lower() in REGION_NAMES and rows and len(rows[0]) == 1
              and (len(cells) <= 1 or len({rows[cell] for cell in cells}) < len(cells))]
    return [tuple(rows[cell] for rows in arrays) for cell in cells] if arrays else None


def interface_vertices(mesh):
    numbered = mesh.elements()
    regions = region_values(mesh, [cell for cell, _ in numbered])
    if regions is None:
        return set()
    return {v for edge, users in edges_of([t for _, t in numbered]).items()
            if len(users) == 2 and regions[users[0]] != regions[users[1]] for v in edge}


def other_cell_vertices(mesh):
    proper = {cell for cell, _ in mesh.elements()}
    return {v for cell, (_, vertices) in enumerate(mesh.cells) if cell not in proper for v in vertices}


def fixed_vertices(mesh):
    """All vertices that must not move."""
    elements = [corners for _, corners in mesh.elements()]
    fixed = set(range(len(mesh.points))) - {v for corners in elements for v in corners}
    for edge, users in edges_of(elements).items():
        if len(users) != 2:
            fixed.update(edge)
    # An interior vertex has one closed fan: walking over its neighbours, two in each of its elements, meets them all.
    links = {}
    for element in elements:
        for (p, v), (_, q) in zip(sides(element), (*sides(element)[1:], sides(element)[0])):
            links.setdefault(v, {}).setdefault(p, []).append(q)
            links[v].setdefault(q, []).append(p)
    for v, link in links.items():
        if v not in fixed:
            start = next(iter(link))
            seen, stack = {start}, [start]
            while stack:
                for other in link[stack.pop()]:
                    if other not in seen:
                        seen.add(other)
                        stack.append(other)
            if len(seen) != len(link):
                fixed.add(v)
    fixed |= interface_vertices(mesh) | other_cell_vertices(mesh)
    fixed |= {v for v, row in enumerate(mesh.point_arrays.get("fixed", [])) if any(row)}
    return fixed


def plane_axes(points):
    """The two coordinates that vary; None for a plane that is parallel to no two axes."""
    extents = [max(column) - min(column) for column in zip(*points)] if points else [1, 1, 0]
    across = min((2, 1, 0), key=lambda i: extents[i])
    return [i for i in range(3) if i != across] if extents[across] <= 1e-6 * max(extents) else None


def flat(points):
    axes = plane_axes(points)
    if axes is None:
        raise ValueError("the plane is not parallel to two axes")
    # Around the middle and in units of the size: no overflow, no lost digits.
    columns = list(zip(*points))
    centre = [(min(columns[i]) / 2 + max(columns[i]) / 2) for i in axes]
    size = max(max(columns[i]) / 2 - min(columns[i]) / 2 for i in axes) or 1.0
    return [((p[axes[0]] - centre[0]) / size, (p[axes[1]] - centre[1]) / size) for p in points]


def cross(points, a, b, c):
    (ax, ay), (bx, by), (cx, cy) = points[a], points[b], points[c]
    return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)


def doubled_area(points, *corners):
    """Twice the signed area of an element: of the triangles that fan out from its first corner."""
    return sum(cross(points, corners[0], b, c) for b, c in zip(corners[1:], corners[2:]))


def squared(points, a, b):
    return (points[b][0] - points[a][0]) ** 2 + (points[b][1] - points[a][1]) ** 2


def raw_shape(points, *corners):
    if len(corners) == 4:
        # The worst corner, by the two sides that leave it.
        quotients = []
        for (before, corner), (_, behind) in zip(sides(corners), (*sides(corners)[1:], sides(corners)[0])):
            lengths = squared(points, corner, behind) + squared(points, corner, before)
            quotients.append(2 * cross(points, corner, behind, before) / lengths if lengths > 0 else 0.0)
        return min(quotients) if doubled_area(points, *corners) >= 0 else -min(-q for q in quotients)
    lengths = sum(squared(points, a, b) for a, b in sides(corners))
    return 2 * math.sqrt(3) * cross(points, *corners) / lengths if lengths > 0 else 0.0


class Orientation:
    """Each element's sign in the consistent mesh, fixed by the input; `reoriented` counts those listed against it."""

    def __init__(self, elements, points):
        self.elements = elements
        edges = edges_of(elements)
        flips = [None] * len(elements)
        self.signs = [0] * len(elements)
        self.components = 0
        self.reoriented = 0
        for start in range(len(elements)):
            if flips[start] is not None:
                continue
            self.components += 1
            flips[start] = 1
            component = [start]
            for t in component:  # grows while it is walked over
                for p, q in sides(elements[t]):
                    for other in edges[(min(p, q), max(p, q))]:
                        if other == t or len(edges[(min(p, q), max(p, q))]) != 2 or flips[other] is not None:
                            continue
                        same_way = (p, q) in sides(elements[other])
                        flips[other] = -flips[t] if same_way else flips[t]
                        component.append(other)
            self.orient(component, flips, points)

    def orient(self, component, flips, points):
        raw = {t: doubled_area(points, *self.elements[t]) for t in component}
        balance = sum((raw[t] * flips[t] > 0) - (raw[t] * flips[t] < 0) for t in component)
        if balance == 0:
            first = min((t for t in component if raw[t] != 0), default=None)
            balance = 1 if first is None or raw[first] * flips[first] > 0 else -1
        side = 1 if balance > 0 else -1
        for t in component:
            self.signs[t] = flips[t] * side
        # Listed against the rest: on the side of the fewer in its component.
        turned = sum(flips[t] < 0 for t in component)
        self.reoriented += min(turned, len(component) - turned)

    def shapes(self, points):
        return [sign * raw_shape(points, *t) for sign, t in zip(self.signs, self.elements)]


MASK = (1 << 64) - 1
PRIMES = (11400714785074694791, 14029467366897019727, 1609587929392839161, 9650029242287828579, 2870177450012600261)


def rotate(value, bits):
    return ((value << bits) | (value >> (64 - bits))) & MASK


def xxh64(data):
    """XXH64 with seed 0, after its specification."""
    p1, p2, p3, p4, p5 = PRIMES

    def round_of(lane, word):
        return rotate((lane + word * p2) & MASK, 31) * p1 & MASK

    position = 0
    if len(data) >= 32:
        lanes = [(p1 + p2) & MASK, p2, 0, -p1 & MASK]
        while position + 32 <= len(data):
            words = struct.unpack_from("<4Q", data, position)
            lanes = [round_of(lane, word) for lane, word in zip(lanes, words)]
            position += 32
        value = sum(rotate(lane, bits) for lane, bits in zip(lanes, (1, 7, 12, 18))) & MASK
        for lane in lanes:
            value = ((value ^ round_of(0, lane)) * p1 + p4) & MASK
    else:
        value = p5
    value = (value + len(data)) & MASK
    while position + 8 <= len(data):
        value = (rotate(value ^ round_of(0, struct.unpack_from("<Q", data, position)[0]), 27) * p1 + p4) & MASK
        position += 8
    if position + 4 <= len(data):
        value = (rotate(value ^ (struct.unpack_from("<I", data, position)[0] * p1 & MASK), 23) * p2 + p3) & MASK
        position += 4
    for byte in data[position:]:
        value = rotate(value ^ (byte * p5 & MASK), 11) * p1 & MASK
    value = (value ^ (value >> 33)) * p2 & MASK
    value = (value ^ (value >> 29)) * p3 & MASK
    return value ^ (value >> 32)


def coordinates_hash(points):
    numbers = [x for point in points for x in point]
    return f"{xxh64(struct.pack(f'<{len(numbers)}d', *numbers)):016x}"
