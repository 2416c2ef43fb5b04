# SPDX-License-Identifier: BSD-3-Clause
"""Meshes for benchmarks/sliding.py, each made of nothing but a seed: files that the program reads.

Random squares are Delaunay meshes of random points; the others are made by Gmsh, by whose own smoothing the engineer's
mesh has gone already.
"""

from __future__ import annotations

import contextlib
import math
from collections.abc import Iterator
from pathlib import Path

import gmsh
import numpy as np
from scipy.spatial import Delaunay, Voronoi

Point = tuple[float, float]


# ---------------------------------------------------------------------------------------------------------------------
# A square meshed at random


def displaced_side(count: int, rng: np.random.Generator, part: float = 0.45) -> np.ndarray:
    """Places of the points of a side in (0, 1), `count` edges long, off even ones by up to `part` of an edge."""
    return (np.arange(1, count) + rng.uniform(-part, part, count - 1)) / count


def random_square(vertices: int, seed: int, *, periodic: bool = False) -> tuple[np.ndarray, np.ndarray]:
    """Points and triangles. Those inside are no nearer to a side than a fifth of its edges. `periodic`: opposite sides
    have the same places; vertex i of the left side is then points[4 + 2 i], that of the right one points[5 + 2 i], and
    those of the other sides follow likewise."""
    rng = np.random.default_rng(seed)
    side = int(math.sqrt(vertices)) - 1
    corners = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=float)
    sides = []
    for axis in (0, 1):
        first = displaced_side(side, rng)
        second = first if periodic else displaced_side(side, rng)
        pair = np.zeros((2 * (side - 1), 2))
        pair[0::2, 1 - axis] = first
        pair[1::2, 1 - axis] = second
        pair[1::2, axis] = 1
        sides.append(pair)
    inside = vertices - 4 - sum(map(len, sides))
    margin = 0.2 / side
    points = np.concatenate([corners, *sides, rng.uniform(margin, 1 - margin, (inside, 2))])
    return points, Delaunay(points).simplices


def write_off(path: Path, points: np.ndarray, triangles: np.ndarray) -> Path:
    with path.open("w") as out:
        out.write(f"OFF\n{len(points)} {len(triangles)} 0\n")
        out.writelines(f"{float(x)!r} {float(y)!r} 0\n" for x, y in points)
        out.writelines(f"3 {a} {b} {c}\n" for a, b, c in triangles)
    return path


def write_periodic_msh(path: Path, points: np.ndarray, triangles: np.ndarray) -> Path:
    """A random_square() that is periodic, in MSH 2.2, as a solver of unit cells is given it."""
    per_side = int(math.sqrt(len(points))) - 2
    with path.open("w") as out:
        out.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + f"{len(points)}\n")
        out.writelines(f"{i} {float(x)!r} {float(y)!r} 0\n" for i, (x, y) in enumerate(points, 1))
        out.write(f"$EndNodes\n$Elements\n{len(triangles)}\n")
        out.writelines(f"{i} 2 2 1 1 {a + 1} {b + 1} {c + 1}\n" for i, (a, b, c) in enumerate(triangles, 1))
        out.write("$EndElements\n$Periodic\n2\n")
        for entity, corners in enumerate([((1, 0), (2, 3)), ((3, 0), (2, 1))]):
            first = 4 + entity * 2 * per_side
            pairs = [(first + 2 * i + 1, first + 2 * i) for i in range(per_side)] + list(corners)
            out.write(f"1 {entity + 2} {entity + 4}\n{len(pairs)}\n")
            out.writelines(f"{a + 1} {b + 1}\n" for a, b in pairs)
        out.write("$EndPeriodic\n")
    return path


# ---------------------------------------------------------------------------------------------------------------------
# By Gmsh


@contextlib.contextmanager
def gmsh_model(path: Path) -> Iterator[object]:
    """A model of the geometry kernel "geo", which is meshed and written when the block ends."""
    gmsh.initialize()
    try:
        gmsh.option.setNumber("General.Verbosity", 2)
        # Version 4 says which nodes are points of the geometry, which stay: here every vertex of an outline is one.
        gmsh.option.setNumber("Mesh.MshFileVersion", 2.2)
        gmsh.model.add(path.stem)
        yield gmsh.model.geo
        gmsh.model.geo.synchronize()
        gmsh.model.mesh.generate(2)
        gmsh.write(str(path))
    finally:
        gmsh.finalize()


def add_loop(geo, points: list[Point], size: float) -> int:
    """The curve loop of a closed polygon. (Its lines are in no physical group, so the file has none of them: Gmsh makes
    each a curve of its own, at whose ends nothing would slide.)"""
    numbers = [geo.addPoint(x, y, 0, size) for x, y in points]
    lines = [geo.addLine(a, b) for a, b in zip(numbers, numbers[1:] + numbers[:1])]
    return geo.addCurveLoop(lines)


def add_circle(geo, radius: float, size: float, centre: Point = (0, 0)) -> tuple[int, list[int]]:
    """The curve loop of a circle, and its four arcs."""
    middle = geo.addPoint(*centre, 0, size)
    on = [geo.addPoint(centre[0] + radius * x, centre[1] + radius * y, 0, size)
          for x, y in ((1, 0), (0, 1), (-1, 0), (0, -1))]
    arcs = [geo.addCircleArc(on[i], middle, on[(i + 1) % 4]) for i in range(4)]
    return geo.addCurveLoop(arcs), arcs


def coast(path: Path, seed: int = 1) -> Path:
    """A rough shore with 24 winding inlets, most of them one to three elements wide, and islands."""
    rng = np.random.default_rng(seed)
    shore: list[Point] = [(0, 0)]
    for inlet in range(24):
        x = 0.3 + 0.4 * inlet
        width = rng.uniform(0.02, 0.09)
        depth = rng.uniform(0.5, 1.6)
        sway = rng.uniform(-0.1, 0.1)
        steps = 12
        bend = [sway * math.sin(3 * i / steps) + rng.normal(0, 0.006) for i in range(steps + 1)]
        left = [(x + bend[i], -depth * i / steps) for i in range(steps + 1)]
        right = [(x + bend[i] + width * (1.2 - i / steps), -depth * i / steps) for i in range(steps + 1)]
        shore += left + right[::-1]
        shore += [(x + width + 0.06 + 0.07 * k, rng.normal(0, 0.02)) for k in range(3)]
    shore += [(10, 0), (10, 4), (0, 4)]
    with gmsh_model(path) as geo:
        outer = add_loop(geo, shore, 0.05)
        islands = []
        for _ in range(6):
            cx, cy, r = rng.uniform(1, 9), rng.uniform(1, 3.5), rng.uniform(0.05, 0.2)
            angles = np.linspace(0, 2 * np.pi, 24, endpoint=False)
            radii = r * (1 + 0.2 * rng.uniform(-1, 1, 24))
            islands.append(add_loop(geo, list(zip(cx + radii * np.cos(angles), cy + radii * np.sin(angles))), 0.04))
        geo.addPhysicalGroup(2, [geo.addPlaneSurface([outer, *islands])], name="water")
    return path


def machine(path: Path, slots: int = 36) -> Path:
    """A stator with slots whose openings are two elements wide, a thin air gap, and a rotor: four regions."""
    with gmsh_model(path) as geo:
        rotor, _ = add_circle(geo, 0.6, 0.012)
        shaft, _ = add_circle(geo, 0.2, 0.03)
        gap = 0.612
        bore: list[Point] = []
        teeth: list[list[Point]] = []
        for s in range(slots):
            at = 2 * math.pi * s / slots
            pitch = 2 * math.pi / slots

            def polar(radius: float, angle: float) -> Point:
                return (radius * math.cos(at + angle * pitch), radius * math.sin(at + angle * pitch))

            opening = [polar(gap, -0.06), polar(0.64, -0.06), polar(0.66, -0.28), polar(0.82, -0.3),
                       polar(0.82, 0.3), polar(0.66, 0.28), polar(0.64, 0.06), polar(gap, 0.06)]
            teeth.append(opening)
            bore += [polar(gap, -0.06), polar(gap, 0.06)] + [polar(gap, a) for a in (0.2, 0.35, 0.5, 0.65, 0.8)]
        numbers = {}

        def point(p: Point, size: float) -> int:
            key = (round(p[0], 9), round(p[1], 9))
            if key not in numbers:
                numbers[key] = geo.addPoint(*p, 0, size)
            return numbers[key]

        lines = {}

        def line(a: int, b: int) -> int:
            if (b, a) in lines:
                return -lines[(b, a)]
            if (a, b) not in lines:
                lines[(a, b)] = geo.addLine(a, b)
            return lines[(a, b)]

        def loop(points: list[Point], size: float) -> int:
            n = [point(p, size) for p in points]
            return geo.addCurveLoop([line(a, b) for a, b in zip(n, n[1:] + n[:1])])

        bore_loop = loop(bore, 0.012)
        slot_surfaces = []
        outlines: list[Point] = []
        for s, opening in enumerate(teeth):
            slot_surfaces.append(geo.addPlaneSurface([loop(opening, 0.02)]))
            outlines += opening + bore[7 * s + 2: 7 * s + 7]
        iron_inside = loop(outlines, 0.02)
        outer, _ = add_circle(geo, 1.0, 0.05)
        geo.addPhysicalGroup(2, [geo.addPlaneSurface([outer, iron_inside])], name="stator")
        geo.addPhysicalGroup(2, slot_surfaces, name="slots")
        geo.addPhysicalGroup(2, [geo.addPlaneSurface([bore_loop, rotor])], name="gap")
        geo.addPhysicalGroup(2, [geo.addPlaneSurface([rotor, shaft])], name="rotor")
    return path


def microstructure(path: Path, grains: int = 300, seed: int = 1) -> Path:
    """A square of Voronoi cells, a region each, with about seven elements across one."""
    rng = np.random.default_rng(seed)
    seeds = rng.uniform(0, 1, (grains, 2))
    mirrored = np.concatenate([seeds] + [np.column_stack([a * seeds[:, 0] + b, c * seeds[:, 1] + d]) for a, b, c, d in
                                         ((-1, 0, 1, 0), (-1, 2, 1, 0), (1, 0, -1, 0), (1, 0, -1, 2))])
    cells = Voronoi(mirrored)
    size = 1 / math.sqrt(grains) / 7
    with gmsh_model(path) as geo:
        points: dict[int, int] = {}
        lines: dict[tuple[int, int], int] = {}
        for grain in range(grains):
            ring = cells.regions[cells.point_region[grain]]
            middle = cells.vertices[ring].mean(axis=0)
            ring = sorted(ring, key=lambda v: math.atan2(*(cells.vertices[v] - middle)[::-1]))
            for v in ring:
                if v not in points:
                    points[v] = geo.addPoint(*cells.vertices[v], 0, size)
            edges = []
            for a, b in zip(ring, ring[1:] + ring[:1]):
                key = (min(a, b), max(a, b))
                if key not in lines:
                    lines[key] = geo.addLine(points[key[0]], points[key[1]])
                edges.append(lines[key] if key == (a, b) else -lines[key])
            geo.addPhysicalGroup(2, [geo.addPlaneSurface([geo.addCurveLoop(edges)])], name=f"grain {grain}")
    return path


def uneven(first: float, length: float, count: int, rng: np.random.Generator, part: float = 0.35) -> np.ndarray:
    """`count` places of a closed line, off even ones by up to `part` of a step."""
    return first + length * (np.arange(count) + rng.uniform(-part, part, count)) / count


def plate(path: Path, around: int = 240, seed: int = 1) -> Path:
    """A square plate with a circular hole of radius 0.3, vertices unevenly spaced on all lines."""
    rng = np.random.default_rng(seed)
    angles = uneven(0, 2 * math.pi, around, rng)
    size = 2 * math.pi * 0.3 / around
    sides = 50
    along = 2 * displaced_side(sides, rng, 0.3) - 1
    outline = [(-1.0, -1.0)] + [(a, -1.0) for a in along] + [(1.0, -1.0)] + [(1.0, a) for a in along] + [(1.0, 1.0)]
    outline += [(-a, 1.0) for a in along] + [(-1.0, 1.0)] + [(-1.0, -a) for a in along]
    with gmsh_model(path) as geo:
        hole = add_loop(geo, [(0.3 * math.cos(a), 0.3 * math.sin(a)) for a in angles], 2 * size)
        geo.addPhysicalGroup(2, [geo.addPlaneSurface([add_loop(geo, outline, 0.1), hole])], name="plate")
    return path


def airfoil_at(part: np.ndarray) -> np.ndarray:
    """Points of NACA 0012 with a closed trailing edge at parts in (0, 1) of its outline, denser where it is rounder."""
    angle = 2 * np.pi * part
    x = 0.5 * (1 + np.cos(angle))
    half = 0.6 * (0.2969 * np.sqrt(x) - 0.126 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)
    return np.column_stack([x, np.where(angle < np.pi, half, -half)])


def airfoil(path: Path, around: int = 300, seed: int = 1) -> Path:
    """NACA 0012 in a circle of ten chords, vertices unevenly spaced on it."""
    rng = np.random.default_rng(seed)
    parts = (np.arange(1, around) + rng.uniform(-0.35, 0.35, around - 1)) / around
    outline = [(1.0, 0.0), *map(tuple, airfoil_at(parts))]
    with gmsh_model(path) as geo:
        far, _ = add_circle(geo, 10, 1.5, (0.5, 0))
        geo.addPhysicalGroup(2, [geo.addPlaneSurface([far, add_loop(geo, outline, 0.01)])], name="air")
    return path


def clustered(path: Path) -> Path:
    """What libMesh's issue 3385 shows: straight sides and straight interfaces, whose nodes lie close together in some
    places and far apart in others, for no reason of geometry."""
    def bunched(count: int, power: float) -> np.ndarray:
        return (np.arange(1, count) / count) ** power

    with gmsh_model(path) as geo:
        def side(a: Point, b: Point, count: int, power: float) -> list[Point]:
            return [a] + [(a[0] + (b[0] - a[0]) * p, a[1] + (b[1] - a[1]) * p) for p in bunched(count, power)]

        left = side((0, 0), (1, 0), 10, 2.2) + side((1, 0), (1, 1), 14, 0.45) + side((1, 1), (0, 1), 10, 2.2)
        left += side((0, 1), (0, 0), 8, 1)
        right = side((2, 0), (2, 1), 8, 1.6) + side((2, 1), (1, 1), 10, 0.5)
        below = side((1, 0), (2, 0), 10, 1.8)
        numbers: dict[Point, int] = {}

        def lines(points: list[Point], end: Point) -> list[int]:
            ids = [numbers[p] if p in numbers else numbers.setdefault(p, geo.addPoint(*p, 0, 0.1))
                   for p in [*points, end]]
            return [geo.addLine(a, b) for a, b in zip(ids, ids[1:])]

        bottom, shared, top, outer = (lines(left[a:b], left[b % len(left)])
                                      for a, b in ((0, 10), (10, 24), (24, 34), (34, 42)))
        right_side = lines(right[:8], right[8]) + lines(right[8:], (1, 1))
        floor = lines(below, (2, 0))
        first = geo.addPlaneSurface([geo.addCurveLoop([*bottom, *shared, *top, *outer])])
        second = geo.addPlaneSurface([geo.addCurveLoop([*floor, *right_side, *[-line for line in shared[::-1]]])])
        geo.addPhysicalGroup(2, [first], name="left")
        geo.addPhysicalGroup(2, [second], name="right")
    return path


def libmesh_square(path: Path, *, parallelogram: bool, per_side: int = 4) -> Path:
    """The mesh of libMesh's own test of its variational smoother on TRI3: a square of 4 x 4 halved squares, of which the
    vertices, those on the sides along these, are drawn towards the outside by a cubic function; as it is, or sheared as
    the test does it, so that the even mesh has equilateral triangles."""
    even = np.linspace(0, 1, per_side + 1)
    points = []
    for y in even:
        for x in even:
            p, q = x, y
            for is_x, (own, other) in ((True, (x, y)), (False, (y, x))):
                if own in (0, 1):
                    continue
                xi = 2 * own - 1
                delta = (xi**3 - xi) * 0.3 * (other - 0.5) ** 2 * 4
                moved = own + delta if delta > 1e-6 else 1.03 * own
                p, q = (moved, q) if is_x else (p, moved)
            points.append((p - 0.5 * q, math.sqrt(0.75) * q) if parallelogram else (p, q))
    triangles = []
    for j in range(per_side):
        for i in range(per_side):
            a = j * (per_side + 1) + i
            b = a + per_side + 1
            triangles += [(a, a + 1, b + 1), (a, b + 1, b)]
    return write_off(path, np.array(points), np.array(triangles))
