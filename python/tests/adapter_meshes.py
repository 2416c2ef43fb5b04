# SPDX-License-Identifier: BSD-3-Clause
"""Meshes for the tests of the adapters, with what is known of them by construction, and independent measures."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import trismooth

SIDE = 10  # cells along a side of the grid
MIDDLE = SIDE // 2


@dataclass
class Grid:
    """A square of two regions, left and right, cut into triangles, whose inner vertices are moved at random.

    Vertices between the regions stay on their line, at uneven distances.
    """

    points: np.ndarray  # (N, 2)
    triangles: np.ndarray  # (M, 3)
    regions: np.ndarray  # (M,): 1 left, 2 right
    column: np.ndarray  # (N,): from the left
    row: np.ndarray  # (N,): from below

    @property
    def is_boundary(self) -> np.ndarray:
        return np.isin(self.column, (0, SIDE)) | np.isin(self.row, (0, SIDE))

    @property
    def is_interface(self) -> np.ndarray:
        return self.column == MIDDLE

    @property
    def is_inside(self) -> np.ndarray:
        """Inside of one of the regions."""
        return ~self.is_boundary & ~self.is_interface

    def vertex(self, column: int, row: int) -> int:
        return row * (SIDE + 1) + column

    @property
    def middle_column(self) -> np.ndarray:
        """Numbers of the vertices on the line between the regions, from below."""
        return np.flatnonzero(self.is_interface)

    @property
    def points3(self) -> np.ndarray:
        return np.column_stack([self.points, np.zeros(len(self.points))])


def grid() -> Grid:
    random = np.random.default_rng(7)
    row, column = (a.ravel() for a in np.mgrid[0 : SIDE + 1, 0 : SIDE + 1])
    points = np.column_stack([column, row]).astype(float)
    inner = ~(np.isin(column, (0, SIDE)) | np.isin(row, (0, SIDE)))
    shifts = random.uniform(-0.33, 0.33, points.shape)
    shifts[column == MIDDLE, 0] = 0
    points[inner] += shifts[inner]
    corner = (column + row * (SIDE + 1))[(column < SIDE) & (row < SIDE)]
    lower = np.column_stack([corner, corner + 1, corner + SIDE + 2])
    upper = np.column_stack([corner, corner + SIDE + 2, corner + SIDE + 1])
    triangles = np.concatenate([lower, upper])
    regions = np.where(column[np.concatenate([corner, corner])] < MIDDLE, 1, 2)
    return Grid(points / SIDE, triangles, regions, column, row)


@dataclass
class QuadraticGrid:
    """The grid with a node on every side. Sides of the boundary are bent, all others straight."""

    grid: Grid
    points: np.ndarray  # (N + sides, 2)
    triangles: np.ndarray  # (M, 6)
    sides: np.ndarray  # (sides, 2): the ends, of the middles from N on
    is_boundary_side: np.ndarray  # (sides,)


def quadratic_grid() -> QuadraticGrid:
    base = grid()
    ends = np.sort(base.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    sides, number, uses = np.unique(ends, axis=0, return_inverse=True, return_counts=True)
    middles = base.points[sides].mean(axis=1)
    bend = 0.01 * (middles - 0.5)
    middles[uses == 1] += bend[uses == 1]
    triangles = np.column_stack([base.triangles, len(base.points) + number.reshape(-1, 3)])
    return QuadraticGrid(base, np.concatenate([base.points, middles]), triangles, sides, uses == 1)


def shapes(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """4 sqrt(3) area / sum of squared edges, from Heron's formula with the sign of the orientation."""
    corners = np.asarray(points, dtype=float)[triangles[:, :3], :2]
    x, y, z = (np.linalg.norm(corners[:, k] - corners[:, k - 1], axis=1) for k in range(3))
    s = (x + y + z) / 2
    area = np.sqrt(np.maximum(s * (s - x) * (s - y) * (s - z), 0))
    sign = np.sign(np.linalg.det(np.dstack([corners, np.ones((len(corners), 3))])))
    return 4 * np.sqrt(3) * sign * area / (x**2 + y**2 + z**2)


def smallest_jacobian(points: np.ndarray, triangles: np.ndarray) -> float:
    """The smallest determinant of the maps of quadratic triangles, at many points of the reference triangle."""
    smallest = np.inf
    nodes = np.asarray(points, dtype=float)[triangles][..., :2]
    for u in np.linspace(0, 1, 9):
        for v in np.linspace(0, 1 - u, 9):
            w = 1 - u - v
            # Derivatives of w(2w-1), u(2u-1), v(2v-1), 4wu, 4uv, 4vw.
            du = np.array([1 - 4 * w, 4 * u - 1, 0, 4 * (w - u), 4 * v, -4 * v])
            dv = np.array([1 - 4 * w, 0, 4 * v - 1, -4 * u, 4 * u, 4 * (w - v)])
            columns = np.stack([np.einsum("k,mkd->md", d, nodes) for d in (du, dv)], axis=-1)
            smallest = min(smallest, float(np.linalg.det(columns).min()))
    return smallest


def edges(run: np.ndarray) -> np.ndarray:
    """The edges between vertices that follow each other."""
    return np.column_stack([run[:-1], run[1:]])


def smooth(*mesh: object, **options: object) -> trismooth.Result:
    """By the method that moves all that is free to move, where no other is named."""
    return trismooth.smooth(*mesh, **{"method": "mean-ratio", **options})


def smooth_in_place(mesh: object, **options: object) -> trismooth.Result:
    return smooth(mesh, inplace=True, **options)


def rows(array: np.ndarray) -> list[bytes]:
    """The bits of each row, to compare bit for bit."""
    array = np.ascontiguousarray(array)
    return [row.tobytes() for row in array]


def same_bits(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Which rows have the same bits."""
    return np.array([a == b for a, b in zip(rows(first), rows(second))])
