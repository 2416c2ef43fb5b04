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


def test_the_callers_arrays_may_go_and_change():
    points, triangles = grid(20, 15)
    expected = trismooth.smooth(points, triangles, size=1 + points[:, 0]).points
    mine, size = triangles.copy(), 1 + points[:, 0]
    plan = trismooth.Plan(mine, len(points), size=size)
    mine[:] = -1
    size[:] = np.nan
    del size
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
