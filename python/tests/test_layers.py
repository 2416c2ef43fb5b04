# SPDX-License-Identifier: BSD-3-Clause
"""Layers that are flat on purpose: held by default, said, and moved where that is asked for."""

import numpy as np
import pytest

import trismooth


def layered(columns=40, heights=(0.02, 0.03, 0.045, 0.07, 0.1, 0.15), above=6):
    y = np.concatenate([[0], np.cumsum([*heights, *[1.0] * above])])
    grid_x, grid_y = np.meshgrid(np.arange(columns, dtype=float), y)
    points = np.stack([grid_x.ravel(), grid_y.ravel()], 1)
    random = np.random.default_rng(1)
    inner = (grid_x > 0) & (grid_x < columns - 1) & (grid_y > y[len(heights)]) & (grid_y < y[-1])
    points[inner.ravel()] += random.uniform(-0.3, 0.3, (int(inner.sum()), 2))
    first = (np.arange(len(y) - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    lower = np.stack([first, first + 1, first + columns + 1], 1)
    upper = np.stack([first, first + columns + 1, first + columns], 1)
    return points, np.concatenate([lower, upper]), columns * (len(heights) + 1)


@pytest.mark.parametrize("method", trismooth.METHODS)
def test_a_boundary_layer_keeps_its_heights_and_a_warning_says_so(method):
    points, triangles, of_layer = layered()
    with pytest.warns(trismooth.MeshWarning, match="flat on purpose.*layers='smooth' moves them"):
        result = trismooth.smooth(points, triangles, method=method)
    assert (result.points[:of_layer] == points[:of_layer]).all()
    assert (result.points[of_layer:] != points[of_layer:]).any()
    assert result.layers["kept"] == 38 * 6
    assert any("flat on purpose" in note for note in result.notes)


def test_layers_are_smoothed_where_that_is_asked_for():
    points, triangles, of_layer = layered()
    result = trismooth.smooth(points, triangles, layers="smooth")
    assert result.free_vertices == (len(points) // 40 - 2) * 38
    assert result.layers["kept"] == 0
    assert not result.notes
