# SPDX-License-Identifier: BSD-3-Clause
"""Metrics as arrays, and their summary."""

from __future__ import annotations

import copy

import numpy as np
import pytest

import trismooth
from conftest import grid, mixed_mesh, shape_of_quadrilateral


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
    assert repr(copy.copy(quality)) == repr(quality)


def test_values_outlive_the_quality(mesh):
    values = trismooth.quality(*mesh).shape
    copy = values.copy()
    trismooth.quality(*mesh)
    np.testing.assert_array_equal(values, copy)


def test_it_prints_as_a_table():
    text = str(trismooth.quality(*grid(3, 3)))
    assert "min_angle" in text and "acceptable" in text


def test_quadrilaterals_and_triangles_have_their_metrics_and_a_summary_each():
    points, elements = mixed_mesh()
    quality = trismooth.quality(points, elements)
    is_triangle = elements[:, 3] < 0
    assert set(quality) == {*trismooth.METRICS, "skew", "taper"}
    for name in quality:
        values = quality[name]
        expected = {"radius_ratio": is_triangle, "skew": ~is_triangle, "taper": ~is_triangle}.get(name, np.full(len(elements), True))
        np.testing.assert_array_equal(np.isfinite(values), expected)
        assert quality.summary[name].min == np.nanmin(values) and quality.summary[name].max == np.nanmax(values)
        np.testing.assert_allclose(quality.summary[name].mean, np.nanmean(values), rtol=1e-12)
    alone = trismooth.quality(points, elements[is_triangle][:, :3])
    np.testing.assert_array_equal(quality.shape[is_triangle], alone.shape)
    expected = [shape_of_quadrilateral(points[corners]) for corners in elements[~is_triangle]]
    np.testing.assert_allclose(quality.shape[~is_triangle], expected, rtol=1e-9)
    triangles, quadrilaterals = quality.summary.kinds
    assert (triangles.kind, quadrilaterals.kind) == ("triangle", "quadrilateral")
    assert (triangles.elements, quadrilaterals.elements) == (is_triangle.sum(), (~is_triangle).sum())
    assert quadrilaterals["shape"].min == quality.shape[~is_triangle].min()
    assert quality.summary.triangles == is_triangle.sum() and quality.summary.quadrilaterals == (~is_triangle).sum()
    with pytest.raises(KeyError, match="'radius_ratio' is no metric; valid are shape, .*taper"):
        quadrilaterals["radius_ratio"]
    assert "quadrilaterals" in repr(quality) and "quadrilaterals alone" in str(quality)
    assert "element" in quality._repr_html_()


def test_quadrilaterals_alone_have_no_metrics_of_triangles():
    points, elements = mixed_mesh()
    quality = trismooth.quality(points, elements[elements[:, 3] >= 0])
    assert quality.summary.triangles == 0 and "radius_ratio" not in quality and "taper" in quality
    assert "quadrilaterals" in quality._repr_html_() and "triangle" not in quality._repr_html_()
    with pytest.raises(AttributeError, match="radius_ratio"):
        quality.radius_ratio


@pytest.mark.parametrize("kind", [np.int32, np.int64, np.uint32, np.uint64, np.int16])
def test_four_vertex_numbers_of_every_type_are_the_same_elements(kind):
    points, elements = mixed_mesh()
    expected = trismooth.quality(points, elements).shape
    np.testing.assert_array_equal(trismooth.quality(points, elements.astype(kind)).shape, expected)
    np.testing.assert_array_equal(trismooth.quality(points, np.asfortranarray(elements.astype(kind))).shape, expected)


def test_an_element_that_is_listed_again_counts_once_and_has_the_values_of_the_first():
    points, elements = mixed_mesh()
    again = np.vstack([elements, np.roll(elements[elements[:, 3] >= 0][:2], 1, axis=1)])
    with pytest.warns(trismooth.MeshWarning, match="2 elements are listed again .*: each is counted once"):
        quality = trismooth.quality(points, again)
    once = trismooth.quality(points, elements)
    assert quality.summary.quadrilaterals == once.summary.quadrilaterals
    np.testing.assert_array_equal(quality.shape[: len(elements)], once.shape)
    np.testing.assert_array_equal(quality.shape[len(elements) :], once.shape[elements[:, 3] >= 0][:2])


def test_quadrilaterals_that_are_no_mesh_are_refused_by_their_numbers():
    points, elements = mixed_mesh()
    with pytest.raises(trismooth.MeshError, match="^triangles: element 0 names vertex 999"):
        trismooth.quality(points, [[0, 1, 2, 999]])
    with pytest.raises(TypeError, match="^triangles: "):
        trismooth.quality(points, elements.astype(float))


def test_other_quadrilaterals_of_the_same_corners_are_no_copies():
    points = [[0, 0], [1, 0], [1, 1], [0, 1]]
    quality = trismooth.quality(points, [[0, 1, 2, 3], [0, 2, 1, 3]])
    np.testing.assert_array_equal(quality.area, [1, 0])
    assert quality.summary.quadrilaterals == 2 and quality.summary.inverted == 1
    with pytest.warns(trismooth.MeshWarning, match="2 elements are listed again"):
        quality = trismooth.quality(points, [[0, 1, 2, 3], [2, 3, 0, 1], [1, 0, 3, 2]])
    assert quality.summary.quadrilaterals == 1


@pytest.mark.parametrize("last", [[0, 1, -1, 2], [-1, 0, 1, 2], [0, 1, 2, 99], [0, 1, 2, 2]])
def test_an_element_that_is_none_is_told_by_its_number_beside_copies_of_others(last):
    with pytest.raises(trismooth.MeshError, match="^triangles: element 2 "):
        trismooth.quality([[0, 0], [1, 0], [1, 1]], [[0, 1, 2, -1], [0, 1, 2, -1], last])


def test_triangles_given_by_four_numbers_are_triangles_alone():
    points, elements = mixed_mesh()
    triangles = elements[elements[:, 3] < 0]
    quality = trismooth.quality(points, triangles)
    assert quality.summary.kinds == [] and set(quality) == set(trismooth.METRICS)
    assert repr(quality.summary) == repr(trismooth.quality(points, triangles[:, :3]).summary)


def test_shapes_of_arrays_that_are_taken_are_named():
    points, elements = mixed_mesh()
    with pytest.raises(ValueError, match=r"^triangles: shape .*expected \(M, 3\), \(M, 4\) with quadrilaterals, "):
        trismooth.quality(points, elements[:, [0, 1, 2, 3, 3]])
    with pytest.raises(TypeError, match="^triangles: .*no -1"):
        trismooth.quality(points, elements.astype(np.uint16))
