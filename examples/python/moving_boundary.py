#!/usr/bin/env python3
"""Smooths a mesh whose boundary moves: an ellipse that pitches and heaves in a box, over 200 steps of one period.

A Plan analyses the connectivity once. In each step the nodes of the ellipse are put where it is now, and the plan moves
the others. For comparison, two meshes without smoothing: the inner nodes left where they are, and moved along with the
ellipse, the less the further they are from it.

    pip install trismooth scipy matplotlib
    ./moving_boundary.py --output moving_boundary.gif
"""

from __future__ import annotations

import argparse
import time
from typing import Dict, List, Optional, Sequence, Tuple

import matplotlib
import numpy as np
from matplotlib.animation import PillowWriter
from scipy.spatial import Delaunay

import trismooth

matplotlib.use("Agg")
from matplotlib import pyplot as plt  # noqa: E402

WIDTH, HEIGHT = 3.0, 2.0
AXES = np.array([0.6, 0.18])  # half axes of the ellipse, which has its middle in that of the box, at (0, 0)
PITCH, HEAVE = np.radians(50), 0.35
LEFT, ALONG, SMOOTHED = "nodes left where they are", "nodes moved along", "nodes smoothed"


def make_mesh(spacing: float) -> Tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Make a mesh of the box around the ellipse in its first place.

    Returns
    -------
    points : ndarray, shape (N, 2)
    triangles : ndarray of int, shape (M, 3)
    on_ellipse : ndarray of bool, shape (N,)
    """
    columns, rows = round(WIDTH / spacing), round(HEIGHT / (spacing * np.sqrt(0.75)))
    x, y = np.meshgrid(np.linspace(-1, 1, columns + 1) * WIDTH / 2, np.linspace(-1, 1, rows + 1) * HEIGHT / 2)
    # Every second row is shifted by half a spacing, which makes equilateral triangles; the sides of the box stay.
    x[1::2, 1:-1] += WIDTH / columns / 2
    grid = np.c_[x.ravel(), y.ravel()]
    angles = np.linspace(0, 2 * np.pi, 4000, endpoint=False)
    curve = AXES * np.c_[np.cos(angles), np.sin(angles)]
    lengths = np.linalg.norm(np.roll(curve, -1, axis=0) - curve, axis=1).cumsum()
    ellipse = curve[np.searchsorted(lengths, np.arange(0, lengths[-1], 0.8 * spacing))]
    # The value is 1 on the ellipse: points of the grid keep a distance.
    outside = grid[np.linalg.norm(grid / (AXES + 0.6 * spacing), axis=1) > 1]
    points = np.concatenate([ellipse, outside])
    triangles = Delaunay(points).simplices
    in_hole = np.linalg.norm(points[triangles].mean(axis=1) / AXES, axis=1) < 1
    return points, triangles[~in_hole], np.arange(len(points)) < len(ellipse)


def moved(points: np.ndarray, phase: float, weight: np.ndarray) -> np.ndarray:
    """Return where points are that take part in the ellipse's motion with a weight from 0 to 1."""
    angle, shift = PITCH * np.sin(phase) * weight, HEAVE * np.sin(2 * phase) * weight
    x, y = points.T
    return np.c_[x * np.cos(angle) - y * np.sin(angle), x * np.sin(angle) + y * np.cos(angle) + shift]


def weight_of(points: np.ndarray) -> np.ndarray:
    """Return 1 on the ellipse, 0 on the box, and what is linear between them along each ray from the middle."""
    ellipse = np.linalg.norm(points / AXES, axis=1)
    box = np.abs(points / (WIDTH / 2, HEIGHT / 2)).max(axis=1)
    # Along a ray both grow in proportion to the distance: it crosses the ellipse at 1 / ellipse, the box at 1 / box.
    return (1 / box - 1) / (1 / box - 1 / ellipse)


def smallest_shape(points: np.ndarray, triangles: np.ndarray) -> float:
    return trismooth.quality(points, triangles).summary["shape"].min


def draw(
    figure: plt.Figure,
    triangles: np.ndarray,
    meshes: Dict[str, np.ndarray],
    smallest: Dict[str, List[float]],
    steps: int,
) -> None:
    """Draw one frame: two of the meshes, and the smallest shapes up to now."""
    figure.clear()
    # Fixed places, so that nothing jumps from frame to frame.
    places = {"left": 0.1, "right": 0.98, "bottom": 0.11, "top": 0.89, "wspace": 0.06, "hspace": 0.3}
    axes = figure.subplot_mosaic([[LEFT, SMOOTHED], ["curve", "curve"]], height_ratios=[2.5, 1], gridspec_kw=places)
    window = (-0.51 * WIDTH, -0.51 * HEIGHT, 0.51 * WIDTH, 0.51 * HEIGHT)
    for name in (LEFT, SMOOTHED):
        trismooth.show(meshes[name], triangles, ax=axes[name], title=name, window=window, colorbar=False)
        axes[name].set(xticks=[], yticks=[])
    for (name, shapes), colour in zip(smallest.items(), ("#111111", "#e08214", "#2463eb")):
        axes["curve"].plot(shapes, colour, label=name)
    axes["curve"].set(xlim=(0, steps), ylim=(-1.05, 1.05), xlabel="step", ylabel="smallest shape")
    axes["curve"].axhline(0, color="#8a95a3", linewidth=0.8)
    axes["curve"].legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=3, frameon=False, fontsize=8)


def main(arguments: Optional[Sequence[str]] = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--output", default="moving_boundary.gif", help="the animation [%(default)s]")
    parser.add_argument("--steps", type=int, default=200, help="steps of one period [%(default)s]")
    parser.add_argument("--spacing", type=float, default=0.09, help="edge length of the mesh [%(default)s]")
    options = parser.parse_args(arguments)

    start, triangles, on_ellipse = make_mesh(options.spacing)
    plan = trismooth.Plan(triangles, len(start), method="mean-ratio")
    print(f"{len(start)} vertices, {len(triangles)} triangles, {options.steps} steps")
    weight = weight_of(start)
    meshes = {LEFT: start.copy(), ALONG: start.copy(), SMOOTHED: start.copy()}
    smallest: Dict[str, List[float]] = {name: [] for name in meshes}
    seconds = []
    figure = plt.figure(figsize=(7.4, 4.5))
    writer = PillowWriter(fps=12)
    with writer.saving(figure, options.output, dpi=80):
        for step in range(options.steps + 1):
            phase = 2 * np.pi * step / options.steps
            for name in (LEFT, SMOOTHED):
                meshes[name][on_ellipse] = moved(start[on_ellipse], phase, np.ones(on_ellipse.sum()))
            meshes[ALONG] = moved(start, phase, weight)
            began = time.perf_counter()
            plan.smooth(meshes[SMOOTHED], out=meshes[SMOOTHED])
            seconds.append(time.perf_counter() - began)
            for name, points in meshes.items():
                smallest[name].append(smallest_shape(points, triangles))
            if step % 5 == 0 and step < options.steps:
                draw(figure, triangles, meshes, smallest, options.steps)
                writer.grab_frame()
    for name, shapes in smallest.items():
        print(f"smallest shape over all steps, {name + ':':27}{min(shapes):8.4f}")
    print(f"time of a step: {1000 * np.median(seconds):.2f} ms, the longest {1000 * max(seconds):.2f} ms")
    print(f"animation: {options.output}")


if __name__ == "__main__":
    main()
