# SPDX-License-Identifier: BSD-3-Clause
"""Plans: connectivity analysed once, points smoothed as often as they change."""

from __future__ import annotations

import gc
import weakref

import numpy as np

import trismooth
from conftest import grid


def test_a_plan_gives_what_smooth_gives_for_each_position():
    points, triangles = grid(20, 15)
    plan = trismooth.Plan(triangles, len(points), method="smart")
    assert (plan.n_points, plan.n_triangles) == (len(points), len(triangles))
    for step in range(5):
        moved = points + [[0.1 * step, 0]] * (points[:, 1:] > 7)
        np.testing.assert_array_equal(plan.smooth(moved).points, trismooth.smooth(moved, triangles, method="smart").points)


def test_a_plan_takes_constraints_and_sizes():
    points, triangles = grid(20, 15)
    held = {"regions": triangles[:, 0] % 7 == 0, "fixed": np.arange(40), "other_cells": [100], "size": 1 + points[:, 0]}
    held["regions"] = held["regions"].astype(int)
    plan = trismooth.Plan(triangles, len(points), **held)
    np.testing.assert_array_equal(plan.smooth(points).points, trismooth.smooth(points, triangles, **held).points)


def test_a_plan_has_vertices_slide():
    points, triangles = grid(20, 15)
    middle = np.flatnonzero(points[:, 0] == 0)
    on_left, on_right = middle, middle + 20
    held = {
        "method": "mean-ratio",
        "slide": "curves",
        "deviation": 0.1,
        "corner_angle": 60,
        "lines": np.column_stack([np.arange(5), np.arange(1, 6)]),
        "line_tags": ["a", "a", "b", "b", "b"],
        "links": np.column_stack([on_left, on_right]),
    }
    plan = trismooth.Plan(triangles, len(points), **held)
    for _ in range(2):
        result, expected = plan.smooth(points), trismooth.smooth(points, triangles, **held)
        np.testing.assert_array_equal(result.points, expected.points)
        assert repr(result.sliding) == repr(expected.sliding) and result.sliding.slid > 0
        points = points + [[0.1, 0]] * (points[:, 1:] > 7)


def test_the_callers_arrays_may_go_and_change():
    points, triangles = grid(20, 15)
    lines, links = np.array([[0, 22], [22, 44]]), np.array([[21, 41], [42, 62]])
    given = {"method": "mean-ratio", "slide": "straight", "lines": lines, "line_tags": np.array([1, 2]), "links": links}
    expected = trismooth.smooth(points, triangles, size=1 + points[:, 0], **given).points
    mine, size = triangles.copy(), 1 + points[:, 0]
    plan = trismooth.Plan(mine, len(points), size=size, **given)
    mine[:] = -1
    size[:] = np.nan
    lines[:] = links[:] = 10**6
    del size, lines, links
    gc.collect()
    np.testing.assert_array_equal(plan.smooth(points).points, expected)


def test_float32_float64_and_heights_with_one_plan():
    points, triangles = grid(20, 15)
    plan = trismooth.Plan(triangles, len(points))
    for given in (points, points.astype(np.float32), np.column_stack([points, np.zeros(len(points))])):
        result = plan.smooth(given)
        assert result.points.dtype == given.dtype
        np.testing.assert_array_equal(result.points, trismooth.smooth(given, triangles).points)


def test_in_place_and_with_quality():
    points, triangles = grid(20, 15)
    plan = trismooth.Plan(triangles, len(points))
    expected = trismooth.smooth(points, triangles)
    result = plan.smooth(points, out=points, quality=True)
    assert result.points is points
    np.testing.assert_array_equal(points, expected.points)
    for metric in trismooth.METRICS:
        assert result.after[metric].mean == expected.after[metric].mean
        assert result.before[metric].max == expected.before[metric].max


def test_progress_is_that_of_each_call():
    points, triangles = grid(20, 15)
    plan = trismooth.Plan(triangles, len(points))
    first, second = [], []
    plan.smooth(points, progress=first.append)
    result = plan.smooth(points, progress=second.append)
    plan.smooth(points)
    assert len(first) == len(second) == result.sweeps
    assert [record.moved for record in first] == [record.moved for record in result.history]


def test_results_and_arrays_are_freed():
    points, triangles = grid(20, 15)
    result = trismooth.smooth(points, triangles)
    reference = weakref.ref(result.points)
    del result
    gc.collect()
    assert reference() is None
