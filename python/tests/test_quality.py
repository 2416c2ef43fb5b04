# SPDX-License-Identifier: BSD-3-Clause
"""Metrics as arrays, and their summary."""

from __future__ import annotations

import numpy as np
import pytest

import trismooth
from conftest import grid


def test_known_triangles():
    h = np.sqrt(3) / 2
    points = np.array([[0, 0], [2, 0], [1, 2 * h], [0, -1.0], [1, -1.0], [0, -2.0]])
    quality = trismooth.quality(points, [[0, 1, 2], [3, 5, 4]])
    np.testing.assert_allclose(quality.shape, [1, h], rtol=1e-15)
    np.testing.assert_allclose(quality.area, [2 * h, 0.5], rtol=1e-15)
    np.testing.assert_allclose(quality.min_angle, [60, 45], rtol=1e-14)
    np.testing.assert_allclose(quality["max_angle"], [60, 90], rtol=1e-14)
    np.testing.assert_allclose(quality.edge_ratio, [1, np.sqrt(2)], rtol=1e-15)


def test_all_triangles_in_their_order_and_the_summary_agree(mesh):
    points, triangles = mesh
    quality = trismooth.quality(points, triangles)
    for name in trismooth.METRICS:
        values = quality[name]
        assert values.shape == (len(triangles),) and values.dtype == np.float64
        summary = quality.summary[name]
        assert (summary.min, summary.max) == (values.min(), values.max())
        np.testing.assert_allclose(summary.mean, values.mean(), rtol=1e-12)
        np.testing.assert_allclose(summary.stddev, values.std(), rtol=1e-9)
    worst = [element.triangle for element in quality.summary.worst]
    assert worst == np.argsort(quality.shape, kind="stable")[:10].tolist()
    np.testing.assert_allclose(quality.summary.worst[0].centroid, points[triangles[worst[0]]].mean(axis=0))
    counts = np.histogram(quality.shape, bins=20, range=(0, 1))[0]
    assert quality.summary.histogram == counts.tolist()


def test_the_summary_is_that_of_a_smoothing(mesh):
    points, triangles = mesh
    result = trismooth.smooth(points, triangles)
    for report, at in ((result.before, points), (result.after, result.points)):
        assert repr(report["shape"]) == repr(trismooth.quality(at, triangles).summary["shape"])


def test_unknown_metrics_are_told():
    quality = trismooth.quality(*grid(2, 2))
    with pytest.raises(AttributeError, match="no metric; there are shape"):
        quality.skewness
    with pytest.raises(KeyError, match="no metric"):
        quality["skewness"]
    with pytest.raises(KeyError, match="no metric"):
        quality.summary["skewness"]
    assert set(quality) == set(quality.keys()) == set(trismooth.METRICS) and len(quality) == 10


def test_values_outlive_the_quality(mesh):
    values = trismooth.quality(*mesh).shape
    copy = values.copy()
    trismooth.quality(*mesh)
    np.testing.assert_array_equal(values, copy)


def test_it_prints_as_a_table():
    text = str(trismooth.quality(*grid(3, 3)))
    assert "min_angle" in text and "acceptable" in text
