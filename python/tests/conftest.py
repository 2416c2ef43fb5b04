# SPDX-License-Identifier: BSD-3-Clause
"""Meshes that tests share."""

from __future__ import annotations

import numpy as np
import pytest


def grid(columns: int, rows: int, seed: int = 0, shift: float = 0.3):
    """A grid of right triangles whose inner points are displaced at random."""
    x, y = np.meshgrid(np.arange(columns + 1.0), np.arange(rows + 1.0))
    points = np.column_stack([x.ravel(), y.ravel()])
    inner = (points[:, 0] > 0) & (points[:, 0] < columns) & (points[:, 1] > 0) & (points[:, 1] < rows)
    points[inner] += np.random.default_rng(seed).uniform(-shift, shift, (int(inner.sum()), 2))
    first = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    across = columns + 1
    triangles = np.concatenate(
        [np.column_stack([first, first + 1, first + across + 1]), np.column_stack([first, first + across + 1, first + across])]
    )
    return points, triangles.astype(np.int32)


def mixed_mesh(columns=12, rows=9, jitter=0.2, seed=3):
    """A grid of quadrilaterals, every third of which is two triangles."""
    random = np.random.default_rng(seed)
    x, y = np.meshgrid(np.arange(columns + 1.0), np.arange(rows + 1.0))
    points = np.column_stack([x.ravel(), y.ravel()]) + random.uniform(-jitter, jitter, ((columns + 1) * (rows + 1), 2))
    elements = []
    for row in range(rows):
        for column in range(columns):
            a = row * (columns + 1) + column
            b, c, d = a + 1, a + columns + 2, a + columns + 1
            elements += [[a, b, c, -1], [a, c, d, -1]] if random.random() < 1 / 3 else [[a, b, c, d]]
    return points, np.array(elements)


def shape_of_quadrilateral(corners):
    """The smallest 2 sin(angle) |a| |b| / (|a|^2 + |b|^2) over the corners, from angles by the law of cosines."""
    values = []
    for i in range(4):
        here, to, back = corners[i], corners[(i + 1) % 4], corners[i - 1]
        a, b, c = (np.linalg.norm(d) for d in (to - here, back - here, to - back))
        sine = np.sqrt(max(0.0, 1 - ((a**2 + b**2 - c**2) / (2 * a * b)) ** 2))
        values.append(2 * sine * a * b / (a**2 + b**2))
    return min(values)


@pytest.fixture
def mesh():
    """Points and triangles of a grid with 12 by 9 squares."""
    return grid(12, 9)


@pytest.fixture
def large_mesh():
    """A mesh whose smoothing takes a good part of a second."""
    return grid(600, 400, shift=0.45)
