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


@pytest.fixture
def mesh():
    """Points and triangles of a grid with 12 by 9 squares."""
    return grid(12, 9)


@pytest.fixture
def large_mesh():
    """A mesh whose smoothing takes a good part of a second."""
    return grid(600, 400, shift=0.45)
