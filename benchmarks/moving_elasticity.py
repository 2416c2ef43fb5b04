# SPDX-License-Identifier: BSD-3-Clause
"""What a step of a mesh that moves takes by linear elasticity, and by MovingMesh.

    python benchmarks/moving_elasticity.py [--sizes 7 20] [--degrees 0.5] [--solver superlu|amg]

A square rotor in a round hole, of 24 times size rings with 96 times size vertices each, which turns by so many degrees:
elasticity with the inverse areas of the triangles as stiffness, assembled by scikit-fem and solved by SciPy's SuperLU, or
by conjugate gradients to 1e-8 with the smoothed aggregation of PyAMG, which knows rigid motions. Prints tables in
Markdown, seconds of the wall clock.
"""

from __future__ import annotations

import argparse
import time

import numpy as np
from scipy.sparse.linalg import cg, splu
from skfem import Basis, BilinearForm, ElementTriP1, ElementVector, MeshTri
from skfem.helpers import ddot, eye, sym_grad, trace

import trismooth


@BilinearForm
def elasticity(u, v, w):
    nu = 0.3
    strain = sym_grad(u)
    return w.weight * ddot(strain + nu / (1 - 2 * nu) * eye(trace(strain), 2), sym_grad(v))


def rotor(size: int) -> tuple[np.ndarray, np.ndarray]:
    """Points and triangles; the first 96 * size points are those of the square."""
    around, rings = 96 * size, 24 * size
    ring = np.arange(rings + 1)[:, None]
    angles = 2 * np.pi * (np.arange(around)[None, :] + 0.5 * (ring % 2)) / around
    radius = np.broadcast_to(1 + (4.0 ** (ring / rings) - 1), angles.shape).copy()
    radius[0] = 0.7 / np.maximum(np.abs(np.cos(angles[0])), np.abs(np.sin(angles[0])))
    points = np.column_stack([(radius * np.cos(angles)).ravel(), (radius * np.sin(angles)).ravel()])
    row, at = (numbers.ravel() for numbers in np.meshgrid(np.arange(rings), np.arange(around), indexing="ij"))
    first = row * around
    left = (at - 1 + row % 2) % around
    above = first + around + (at + row % 2) % around
    here = np.column_stack([first + at, first + (at + 1) % around, above])
    there = np.column_stack([first + at, above, first + around + left])
    return points, np.concatenate([here, there])


def solved(matrix, right, solver: str, points: np.ndarray) -> np.ndarray:
    if solver == "superlu":
        return splu(matrix.tocsc()).solve(right)
    import pyamg

    rigid = np.zeros((2 * len(points), 3))
    rigid[0::2, 0] = rigid[1::2, 1] = 1
    rigid[0::2, 2], rigid[1::2, 2] = -points[:, 1], points[:, 0]
    levels = pyamg.smoothed_aggregation_solver(matrix.tobsr((2, 2)), B=rigid)
    result, failed = cg(matrix, right, rtol=1e-8, M=levels.aspreconditioner(), maxiter=1000)
    if failed:
        raise SystemExit("conjugate gradients did not come to an end")
    return result


def by_elasticity(points: np.ndarray, triangles: np.ndarray, now: np.ndarray, held: np.ndarray, solver: str):
    begin = time.perf_counter()
    basis = Basis(MeshTri(np.ascontiguousarray(points.T), np.ascontiguousarray(triangles.T)), ElementVector(ElementTriP1()))
    a, b, c = (points[triangles[:, k]] for k in range(3))
    areas = np.abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
    matrix = elasticity.assemble(basis, weight=np.broadcast_to((areas.min() / areas)[:, None], basis.dx.shape)).tocsr()
    rows = basis.nodal_dofs.T
    free, of_held = rows[~held].ravel(), rows[held].ravel()
    right = -matrix[free][:, of_held] @ (now - points)[held].ravel()
    inner = matrix[free][:, free]
    assembled = time.perf_counter()
    result = now.copy()
    result[~held] = points[~held] + solved(inner, right, solver, points[~held]).reshape(-1, 2)
    return result, assembled - begin, time.perf_counter() - assembled


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--sizes", type=int, nargs="+", default=[7, 20])
    parser.add_argument("--degrees", type=float, default=0.5)
    parser.add_argument("--solver", choices=["superlu", "amg"], default="superlu")
    arguments = parser.parse_args()
    print(f"| vertices | elasticity: assembling | {arguments.solver} | inverted | MovingMesh: made | step | inverted |")
    print("|---|---|---|---|---|---|---|")
    for size in arguments.sizes:
        points, triangles = rotor(size)
        begin = time.perf_counter()
        moving = trismooth.MovingMesh(points, triangles, layers="smooth")
        made = time.perf_counter() - begin
        angle = np.radians(arguments.degrees)
        now = points.copy()
        now[: 96 * size] = points[: 96 * size] @ [[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]]
        begin = time.perf_counter()
        result = moving.follow(now)
        step = time.perf_counter() - begin
        moved, assembling, solving = by_elasticity(points, triangles, now, moving.held, arguments.solver)
        inverted = int((trismooth.quality(moved, triangles).shape <= 0).sum())
        print(
            f"| {len(points):,} | {assembling:.2f} | {solving:.2f} | {inverted} | {made:.2f} | {step:.2f} | {result.inverted} |",
            flush=True,
        )


if __name__ == "__main__":
    main()
