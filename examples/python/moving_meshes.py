#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes that follow their boundary, beside what else is done about it.

Four motions: a square rotor that turns by 45 degrees and back, a foil with a boundary layer that pitches and plunges, a
piston that moves through half of its cylinder, sloshing in a tank. In each step MovingMesh puts the inner nodes to where
they belong. For comparison: a Laplace equation of the displacements and linear elasticity, both with the inverse areas of
the elements as weights, from the mesh at rest (elasticity also step by step, which takes more); and a Plan, by mean-ratio
and by the default method, that smooths what the last step left.

    pip install trismooth scipy scikit-fem matplotlib
    ./moving_meshes.py --motion rotor --output rotor.gif
    ./moving_meshes.py --motion rotor --limit        # how far each goes before something is inverted
"""

from __future__ import annotations

import argparse
import time
import warnings
from typing import Callable, Dict, List, NamedTuple, Optional, Sequence

import matplotlib
import numpy as np
from matplotlib.animation import PillowWriter
from scipy.sparse.linalg import splu
from scipy.spatial import Delaunay
from skfem import Basis, BilinearForm, ElementTriP1, ElementVector, MeshTri
from skfem.helpers import ddot, dot, eye, grad, sym_grad, trace

import trismooth

matplotlib.use("Agg")
from matplotlib import pyplot as plt  # noqa: E402

warnings.simplefilter("ignore", trismooth.MeshWarning)  # of what is inverted: it is in the table


class Motion(NamedTuple):
    """A mesh at rest and how its boundary moves."""

    points: np.ndarray  # shape (N, 2)
    triangles: np.ndarray  # shape (M, 3)
    boundary: np.ndarray  # N bools
    at: Callable[[float], np.ndarray]  # the boundary's points, for a phase from 0 to 1: at both it is at rest
    first_row: np.ndarray  # shape (K, 2): nodes of a wall and those above them; none where there is no layer
    strained: Callable[[float], np.ndarray]  # the boundary's points, for a strain from 0 on: how far can it go?
    strain: str  # what that is


def turned(points: np.ndarray, degrees: float) -> np.ndarray:
    angle = np.radians(degrees)
    return points @ [[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]]


def rings(inner: np.ndarray, outer: np.ndarray, parts: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Triangles between two closed lines of as many points each; ``parts`` are the places of rows between them, 0 to 1."""
    points = np.concatenate([(1 - part) * inner + part * outer for part in parts])
    around = len(inner)
    row, at = (numbers.ravel() for numbers in np.meshgrid(np.arange(len(parts) - 1), np.arange(around), indexing="ij"))
    a, b = row * around + at, row * around + (at + 1) % around
    triangles = np.concatenate([np.column_stack([a, b, a + around]), np.column_stack([b, b + around, a + around])])
    return points, counter_clockwise(points, triangles)


def doubled_areas(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    ab, ac = (points[triangles[:, i]] - points[triangles[:, 0]] for i in (1, 2))
    areas: np.ndarray = ab[:, 0] * ac[:, 1] - ab[:, 1] * ac[:, 0]
    return areas


def counter_clockwise(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    return np.where((doubled_areas(points, triangles) < 0)[:, None], triangles[:, [0, 2, 1]], triangles)


def box(width: float, height: float, spacing: float, pin: Optional[tuple[float, float, float]] = None) -> tuple[np.ndarray, np.ndarray]:
    """An unstructured mesh of a box from (0, 0) on, with a round hole (x, y, radius) where a pin is."""
    columns, rows = round(width / spacing), round(height / (spacing * np.sqrt(0.75)))
    x, y = np.meshgrid(np.linspace(0, width, columns + 1), np.linspace(0, height, rows + 1))
    x[1::2, 1:-1] += width / columns / 2
    points = np.c_[x.ravel(), y.ravel()]
    if pin is not None:
        angles = np.arange(0, 2 * np.pi, 0.9 * spacing / pin[2])
        circle = np.array(pin[:2]) + pin[2] * np.c_[np.cos(angles), np.sin(angles)]
        points = np.concatenate([circle, points[np.hypot(*(points - pin[:2]).T) > pin[2] + 0.5 * spacing]])
    triangles = Delaunay(points).simplices
    if pin is not None:
        triangles = triangles[np.hypot(*(points[triangles].mean(axis=1) - pin[:2]).T) > pin[2]]
    return points, counter_clockwise(points, triangles)


def boundary_of(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    ends, counts = np.unique(sides, axis=0, return_counts=True)
    is_boundary = np.zeros(len(points), dtype=bool)
    is_boundary[ends[counts == 1]] = True
    return is_boundary


def rotor(size: float) -> Motion:
    around = round(96 * size)
    angles = np.arange(around) * 2 * np.pi / around
    circle = np.c_[np.cos(angles), np.sin(angles)]
    square = 0.7 * circle / np.abs(circle).max(axis=1)[:, None]
    parts = (4 ** np.linspace(0, 1, round(24 * size) + 1) - 1) / 3
    points, triangles = rings(square, 4 * circle, parts)
    boundary = boundary_of(points, triangles)
    of_rotor = np.arange(len(points)) < around

    def at_angle(degrees: float) -> np.ndarray:
        now = points.copy()
        now[of_rotor] = turned(points[of_rotor], degrees)
        return now[boundary]

    return Motion(
        points, triangles, boundary, lambda phase: at_angle(45 * np.sin(np.pi * phase)), np.empty((0, 2), dtype=int),
        at_angle, "degrees",
    )  # fmt: skip


def foil(size: float) -> Motion:
    """NACA 0012 with twelve rows of a boundary layer, the first of 0.0005 chords, in a round domain of eight chords."""
    around = 2 * round(80 * size)
    angles = np.arange(around) * 2 * np.pi / around
    fine = np.linspace(0, 2 * np.pi, 5001)
    x = 0.5 + 0.5 * np.cos(fine)
    thickness = 0.6 * (0.2969 * np.sqrt(x) - 0.126 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)
    curve = np.c_[x - 0.25, np.sign(np.pi - fine) * thickness]
    lengths = np.r_[0, np.linalg.norm(np.diff(curve, axis=0), axis=1).cumsum()]
    at = np.arange(around) / around * lengths[-1]
    wall = np.c_[np.interp(at, lengths, curve[:, 0]), np.interp(at, lengths, curve[:, 1])]
    edges = np.roll(wall, -1, axis=0) - wall
    normals = np.c_[edges[:, 1], -edges[:, 0]] / np.linalg.norm(edges, axis=1)[:, None]
    normals = normals + np.roll(normals, 1, axis=0)
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    heights = 0.0005 * (1.3 ** np.arange(13) - 1) / 0.3
    layer = wall + heights[-1] * normals
    far = 4 * np.c_[np.cos(angles), np.sin(angles)]
    parts = (60 ** np.linspace(0, 1, round(28 * size) + 1) - 1) / 59
    inner, of_inner = rings(wall, layer, heights / heights[-1])
    outer, of_outer = rings(layer, far, parts)
    shift = len(inner) - around
    points = np.concatenate([inner, outer[around:]])
    triangles = np.concatenate([of_inner, of_outer + shift])
    boundary = boundary_of(points, triangles)
    of_foil = np.arange(len(points)) < around

    def placed(degrees: float, plunge: float) -> np.ndarray:
        now = points.copy()
        now[of_foil] = turned(points[of_foil], degrees) + [0, plunge]
        return now[boundary]

    return Motion(
        points, triangles, boundary,
        lambda phase: placed(30 * np.sin(2 * np.pi * phase), 0.5 * np.sin(2 * np.pi * phase) * np.cos(np.pi * phase)),
        np.c_[np.arange(around), np.arange(around) + around],
        lambda degrees: placed(degrees, 0), "degrees",
    )  # fmt: skip


def piston(size: float) -> Motion:
    """A cylinder of two by one with a pin in it; the side on the right moves to the middle."""
    points, triangles = box(2, 1, 0.06 / size, (0.5, 0.55, 0.2))
    boundary = boundary_of(points, triangles)
    moves = boundary & ((points[:, 0] > 1) | (np.abs(points[:, 1] - 0.5) > 0.49))

    def at_stroke(stroke: float) -> np.ndarray:
        now = points.copy()
        now[moves, 0] *= 1 - stroke / 2
        return now[boundary]

    return Motion(
        points, triangles, boundary, lambda phase: at_stroke(np.sin(np.pi * phase)), np.empty((0, 2), dtype=int),
        lambda percent: at_stroke(percent / 50), "% of the cylinder",
    )  # fmt: skip


def sloshing(size: float) -> Motion:
    """A tank of two by one, whose surface is a wave that goes from side to side."""
    points, triangles = box(2, 1, 0.06 / size)
    boundary = boundary_of(points, triangles)

    def wave(first: float, second: float) -> np.ndarray:
        now = points.copy()
        x = points[:, 0]
        surface = 1 + first * np.cos(np.pi * x / 2) + second * np.cos(np.pi * x)
        now[boundary, 1] *= surface[boundary]
        return now[boundary]

    return Motion(
        points, triangles, boundary,
        lambda phase: wave(0.55 * np.sin(2 * np.pi * phase), 0.25 * np.sin(4 * np.pi * phase)),
        np.empty((0, 2), dtype=int),
        lambda percent: wave(percent / 100, 0), "% of the depth",
    )  # fmt: skip


LINES = ("k-", "k--", "g-", "r-", "r--", "b-", "b:")  # in the order of followers()
MOTIONS = {"rotor": rotor, "foil": foil, "piston": piston, "sloshing": sloshing}


@BilinearForm
def laplace(u, v, w):
    return w.weight * dot(grad(u), grad(v))


@BilinearForm
def elasticity(u, v, w):
    nu = 0.3
    strain = sym_grad(u)
    stress = strain + nu / (1 - 2 * nu) * eye(trace(strain), 2)
    return w.weight * ddot(stress, sym_grad(v))


class Equation:
    """The displacements of inner nodes by a linear equation on a mesh, whose weights are the inverse areas."""

    def __init__(self, form: BilinearForm, points: np.ndarray, triangles: np.ndarray, boundary: np.ndarray) -> None:
        mesh = MeshTri(np.ascontiguousarray(points.T), np.ascontiguousarray(triangles.T))
        vector = form is elasticity
        basis = Basis(mesh, ElementVector(ElementTriP1()) if vector else ElementTriP1())
        areas = np.abs(doubled_areas(points, triangles))
        matrix = form.assemble(basis, weight=np.broadcast_to((areas.min() / areas)[:, None], basis.dx.shape)).tocsc()
        if not vector:
            self.rows = np.arange(len(points))[:, None]  # each component by itself, by one matrix
        else:
            self.rows = basis.nodal_dofs.T
        free = self.rows[~boundary].ravel()
        self.held = self.rows[boundary].ravel()
        self.to_held = matrix[free][:, self.held]
        self.solve = splu(matrix[free][:, free].tocsc()).solve
        self.boundary = boundary
        self.vector = vector

    def displaced(self, points: np.ndarray, boundary: np.ndarray) -> np.ndarray:
        change = boundary - points[self.boundary]
        now = points.copy()
        now[self.boundary] = boundary
        if self.vector:
            now[~self.boundary] += self.solve(-self.to_held @ change.ravel()).reshape(-1, 2)
        else:
            now[~self.boundary] += self.solve(-self.to_held @ change)
        return now


Follow = Callable[[np.ndarray], np.ndarray]


def followers(motion: Motion) -> Dict[str, Callable[[], Follow]]:
    """By name: what makes a function that answers the points for the boundary's."""
    points, triangles, boundary = motion.points, motion.triangles, motion.boundary

    def with_boundary(now: np.ndarray, of: np.ndarray) -> np.ndarray:
        result = of.copy()
        result[boundary] = now
        return result

    def moving(**options: object) -> Follow:
        mesh = trismooth.MovingMesh(points, triangles, **options)
        return lambda now: mesh.follow(with_boundary(now, points)).points

    def plan(**options: object) -> Follow:
        prepared = trismooth.Plan(triangles, len(points), **options)
        last = points.copy()

        def follow(now: np.ndarray) -> np.ndarray:
            last[boundary] = now
            return prepared.smooth(last, out=last).points.copy()

        return follow

    def equation(form: BilinearForm) -> Follow:
        made = Equation(form, points, triangles, boundary)
        return lambda now: made.displaced(points, now)

    def step_by_step() -> Follow:
        last = [points]

        def follow(now: np.ndarray) -> np.ndarray:
            last[0] = Equation(elasticity, last[0], triangles, boundary).displaced(last[0], now)
            return last[0]

        return follow

    return {
        "MovingMesh": moving,
        "MovingMesh, equilateral": lambda: moving(target="uniform"),
        "Laplace": lambda: equation(laplace),
        "elasticity": lambda: equation(elasticity),
        "elasticity, step by step": step_by_step,
        "plan, mean-ratio": lambda: plan(method="mean-ratio"),
        "plan, smart": plan,
    }


def shapes_of(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    return trismooth.quality(points, triangles)["shape"]


def run(motion: Motion, follow: Follow, steps: int) -> tuple[List[np.ndarray], float]:
    """The meshes of all steps, and the median time of one in seconds."""
    meshes, seconds = [], []
    for step in range(steps + 1):
        began = time.perf_counter()
        meshes.append(follow(motion.at(step % steps / steps)))
        seconds.append(time.perf_counter() - began)
    return meshes, float(np.median(seconds))


def print_row(name: str, motion: Motion, meshes: List[np.ndarray], seconds: float) -> List[float]:
    smallest = [float(shapes_of(points, motion.triangles).min()) for points in meshes]
    inverted = sum(shape <= 0 for shape in smallest)
    sides = np.linalg.norm(np.diff(motion.points[motion.triangles[:, [0, 1]]], axis=1)[:, 0], axis=1)
    drift = np.linalg.norm(meshes[-1] - meshes[0], axis=1).max() / np.median(sides)
    layer = ""
    if len(motion.first_row) > 0:
        heights = [np.linalg.norm(np.subtract(*points[motion.first_row.T]), axis=1) for points in (motion.points, *meshes)]
        layer = f"{100 * max(np.abs(height / heights[0] - 1).max() for height in heights[1:]):9.3g} %"
    print(f"{name:26}{min(smallest):10.4f}{inverted:10}{drift:12.3g}{1000 * seconds:10.1f}{layer}")
    return smallest


def limit_of(motion: Motion, follow: Follow, most: float, steps: int) -> float:
    """The largest strain up to which no step has inverted anything."""
    for step in range(1, steps + 1):
        if shapes_of(follow(motion.strained(most * step / steps)), motion.triangles).min() <= 0:
            return most * (step - 1) / steps
    return most


def draw(figure: plt.Figure, motion: Motion, meshes: Dict[str, np.ndarray], smallest: Dict[str, List[float]], steps: int) -> None:
    """One frame: two of the meshes, and the smallest shapes up to now."""
    figure.clear()
    # Fixed places, so that nothing jumps from frame to frame.
    places = {"left": 0.1, "right": 0.98, "bottom": 0.11, "top": 0.91, "wspace": 0.06, "hspace": 0.35}
    names = list(meshes)
    axes = figure.subplot_mosaic([names, ["curve", "curve"]], height_ratios=[2.5, 1], gridspec_kw=places)
    low, high = motion.points.min(axis=0), motion.points.max(axis=0)
    low, high = low - 0.02 * (high - low), high + [0, 0.02] * (high - low)
    if len(motion.first_row) > 0:
        low, high = np.array([-0.9, -0.9]), np.array([1.1, 0.9])
    if motion.strain == "% of the depth":
        high[1] *= 1.7
    for name, points in meshes.items():
        trismooth.show(points, motion.triangles, ax=axes[name], title=name, window=(*low, *high), colorbar=False)
        axes[name].set(xticks=[], yticks=[])
    at_rest = shapes_of(motion.points, motion.triangles).min()
    for (name, shapes), style in zip(smallest.items(), LINES):
        axes["curve"].plot(np.array(shapes) / at_rest, style, label=name, linewidth=2.2 if name == "MovingMesh" else 1.2)
    axes["curve"].set(xlim=(0, steps), ylim=(-0.6, 1.7), xlabel="step", ylabel="smallest shape\nto that at rest")
    axes["curve"].axhline(0, color="#8a95a3", linewidth=0.8)
    axes["curve"].legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=4, frameon=False, fontsize=6.5)


def main(arguments: Optional[Sequence[str]] = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--motion", choices=MOTIONS, default="rotor", help="what moves [%(default)s]")
    parser.add_argument("--output", help="the animation [MOTION.gif]")
    parser.add_argument("--steps", type=int, default=100, help="steps of one cycle [%(default)s]")
    parser.add_argument("--size", type=float, default=1, help="of finer meshes: how many times finer [%(default)s]")
    parser.add_argument("--limit", action="store_true", help="how far each goes, instead of a cycle")
    options = parser.parse_args(arguments)

    motion = MOTIONS[options.motion](options.size)
    shapes = shapes_of(motion.points, motion.triangles)
    print(f"{options.motion}: {len(motion.points)} vertices, {len(motion.triangles)} triangles, {options.steps} steps")
    print(f"at rest: smallest shape {shapes.min():.4f}, mean {shapes.mean():.4f}")
    if options.limit:
        most = 180 if motion.strain == "degrees" else 95
        print(f"\n{'goes without inversion to':26}{motion.strain:>20}")
        for name, make in followers(motion).items():
            print(f"{name:26}{limit_of(motion, make(), most, options.steps):20.1f}")
        return

    print(f"\n{'':26}{'smallest':>10}{'steps':>10}{'drift':>12}{'time of':>10}{'first row' if len(motion.first_row) else '':>11}")
    print(f"{'':26}{'shape':>10}{'inverted':>10}{'(edges)':>12}{'step, ms':>10}{'changes by' if len(motion.first_row) else '':>11}")
    runs, smallest = {}, {}
    for name, make in followers(motion).items():
        runs[name], seconds = run(motion, make(), options.steps)
        smallest[name] = print_row(name, motion, runs[name], seconds)
    output = options.output or f"{options.motion}.gif"
    figure = plt.figure(figsize=(8.6, 5.2))
    writer = PillowWriter(fps=10)
    with writer.saving(figure, output, dpi=80):
        for step in range(0, options.steps, max(1, options.steps // 20)):
            shown = {name: runs[name][step] for name in ("MovingMesh", "elasticity")}
            draw(figure, motion, shown, {name: shapes[: step + 1] for name, shapes in smallest.items()}, options.steps)
            writer.grab_frame()
    print(f"\nanimation: {output}")


if __name__ == "__main__":
    main()
