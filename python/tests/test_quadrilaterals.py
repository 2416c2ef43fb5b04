# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of quadrilaterals, and of these and triangles, are smoothed."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from conftest import grid, mixed_mesh, shape_of_quadrilateral

import trismooth


def shapes_of(points, elements):
    """The shape of each element, by the angles of its corners or the sides of its triangle."""
    shapes = []
    for element in elements:
        corners = points[element[element >= 0]]
        if len(corners) == 4:
            shapes.append(shape_of_quadrilateral(corners))
        else:
            a, b, c = corners
            squares = sum(np.sum((p - q) ** 2) for p, q in ((a, b), (b, c), (c, a)))
            shapes.append(2 * np.sqrt(3) * np.linalg.det([b - a, c - a]) / squares)
    return np.array(shapes)


@pytest.mark.parametrize("method", trismooth.METHODS)
def test_the_worst_element_gets_better_and_the_boundary_stays(method):
    points, elements = mixed_mesh(jitter=0.3)
    result = trismooth.smooth(points, elements, method=method)
    assert shapes_of(result.points, elements).min() > shapes_of(points, elements).min()
    assert (result.after.triangles, result.after.quadrilaterals) == ((elements[:, 3] < 0).sum(), (elements[:, 3] >= 0).sum())
    x, y = np.meshgrid(np.arange(13), np.arange(10))
    on_boundary = ((x == 0) | (x == 12) | (y == 0) | (y == 9)).ravel()
    np.testing.assert_array_equal(result.points[on_boundary], points[on_boundary])
    assert result.moved > 50 and result.notes == [] and result.free_vertices == (~on_boundary).sum()


def test_a_jittered_grid_of_squares_becomes_one_of_squares():
    points, elements = mixed_mesh(jitter=0)
    squares = np.array([[a, a + 1, a + 14, a + 13] for a in range(9 * 13) if a % 13 < 12])
    inner = (points.min(axis=1) > 0) & (points[:, 0] < 12) & (points[:, 1] < 9)
    moved = points + inner[:, None] * np.random.default_rng(1).uniform(-0.4, 0.4, points.shape)
    for method in ("smart", "mean-ratio"):
        result = trismooth.smooth(moved, squares, method=method)
        assert result.after["shape"].min > 0.99
        np.testing.assert_allclose(result.points, points, atol=0.05)


def test_triangles_in_rows_of_four_are_smoothed_as_in_rows_of_three():
    points, triangles = grid(12, 9)
    rows = np.column_stack([triangles, np.full(len(triangles), -1)])
    for options in ({}, {"method": "mean-ratio"}, {"slide": "straight"}, {"untangle": True}):
        expected = trismooth.smooth(points, triangles, **options)
        found = trismooth.smooth(points, rows, **options)
        np.testing.assert_array_equal(found.points, expected.points)
        assert repr(found.after) == repr(expected.after)


@pytest.mark.parametrize("dtype", [np.int32, np.int64, np.uint32, np.uint64])
def test_numbers_of_any_type_give_the_same_bits(dtype):
    points, elements = mixed_mesh()
    expected = trismooth.smooth(points, elements, method="mean-ratio").points
    np.testing.assert_array_equal(trismooth.smooth(points, elements.astype(dtype), method="mean-ratio").points, expected)
    for threads in (1, 2, 3):
        found = trismooth.smooth(points, np.asfortranarray(elements), method="mean-ratio", threads=threads)
        np.testing.assert_array_equal(found.points, expected)


def test_a_plan_smooths_quadrilaterals_as_often_as_their_points_change():
    points, elements = mixed_mesh()
    plan = trismooth.Plan(elements, len(points), method="mean-ratio")
    assert (plan.n_triangles, repr(plan)) == (len(elements), f"<trismooth.Plan: 130 vertices, {len(elements)} elements>")
    for scale in (1, 3):
        result = plan.smooth(scale * points, quality=True)
        np.testing.assert_array_equal(result.points, trismooth.smooth(scale * points, elements, method="mean-ratio").points)
        assert result.after.quadrilaterals == (elements[:, 3] >= 0).sum()


def test_constraints_hold_vertices_of_quadrilaterals():
    points, elements = mixed_mesh()
    regions = np.where(elements[:, 0] % 13 < 6, "left", "right")
    result = trismooth.smooth(points, elements, regions=regions, fixed=[30, 31], method="mean-ratio")
    stays = (result.points == points).all(axis=1)
    assert stays[[30, 31]].all() and stays[np.arange(130) % 13 == 6].all()
    assert not stays[np.arange(130) % 13 == 5][1:-1].all()


def test_vertices_of_lines_and_links_are_held():
    points, elements = mixed_mesh()
    for named in ({"lines": [[30, 31]]}, {"links": [[30, 31]]}):
        result = trismooth.smooth(points, elements, method="mean-ratio", **named)
        stays = (result.points == points).all(axis=1)
        assert stays[[30, 31]].all() and not stays[[29, 32]].any()


def test_a_corner_in_line_is_told_of():
    points = [[0, 0], [1, 0], [2, 0], [1, 1.0]]
    with pytest.warns(trismooth.MeshWarning, match="1 element without area or with a corner in line"):
        assert trismooth.smooth(points, [[0, 1, 2, 3]]).degenerate == 1


def test_copies_of_quadrilaterals_count_once_and_are_told_of():
    points, elements = mixed_mesh()
    quadrilaterals = elements[elements[:, 3] >= 0]
    twice = np.vstack([elements, np.roll(quadrilaterals[:2], 1, axis=1), quadrilaterals[2:3, ::-1]])
    expected = trismooth.smooth(points, elements)
    with pytest.warns(trismooth.MeshWarning, match="3 elements are listed again"):
        found = trismooth.smooth(points, twice)
    np.testing.assert_array_equal(found.points, expected.points)
    assert found.after.quadrilaterals == expected.after.quadrilaterals


def test_inverted_quadrilaterals_that_are_left_are_told_of():
    # The middle of a plus of four quadrilaterals can go where it likes: a corner of one of these is held beyond its
    # diagonal.
    points = np.array([[0, 0], [1, 0], [2, 0], [0, 1], [1, 1], [2, 1], [0, 2], [1, 2], [1.1, 1.1]], dtype=float)
    elements = np.array([[0, 1, 4, 3], [1, 2, 5, 4], [3, 4, 7, 6], [4, 5, 8, 7]])
    with pytest.warns(trismooth.MeshWarning, match="1 inverted element: nothing untangled the mesh; untangle=True does"):
        result = trismooth.smooth(points, elements, fixed=[4])
    assert result.inverted == 1 and result.untangling is None
    with pytest.warns(trismooth.MeshWarning, match="1 inverted element: the untangling could not mend more, and elements "):
        result = trismooth.smooth(points, elements, fixed=[4], method="mean-ratio")
    assert result.inverted == 1 and result.untangling["inverted_fixed"] == 1


def test_inverted_quadrilaterals_are_untangled():
    points = np.array([[x, y] for y in range(21) for x in range(21)], dtype=float)
    inner = ((points > 0) & (points < 20)).all(axis=1)
    points[inner] += np.random.default_rng(3).uniform(-0.9, 0.9, (inner.sum(), 2))
    squares = np.array([[a, a + 1, a + 22, a + 21] for a in range(20 * 21 - 1) if a % 21 < 20])
    assert (trismooth.quality(points, squares)["shape"] <= 0).sum() > 40
    for options in ({"untangle": True}, {"method": "mean-ratio"}):
        result = trismooth.smooth(points, squares, **options)
        assert (trismooth.quality(result.points, squares)["shape"] > 0).all()
        assert result.untangling["inverted_before"] > 40 and result.untangling["inverted_after"] == 0
        np.testing.assert_array_equal(result.points[~inner], points[~inner])


def test_what_quadrilaterals_cannot_have_is_refused_by_name():
    points, elements = mixed_mesh()
    before = points.copy()
    refused = (
        ({"regions": [1, 2]}, "^regions: "),
    )
    for options, said in refused:
        with pytest.raises(ValueError, match=said):
            trismooth.smooth(points, elements, out=points, **options)
    with pytest.raises(trismooth.MeshError, match="^triangles: element 0 names vertex 999"):
        trismooth.smooth(points, [[0, 1, 2, 999]])
    with pytest.raises(trismooth.MeshError, match="^triangles: element 0 repeats a vertex; of a triangle the last of four numbers is -1"):
        trismooth.smooth(points, [[0, 1, 14, 14]])
    with pytest.raises(trismooth.MeshError, match="^triangles: element 0 names vertex 999"):
        trismooth.MovingMesh(points, [[0, 1, 2, 999]])
    np.testing.assert_array_equal(points, before)


def test_a_result_shows_both_kinds():
    points, elements = mixed_mesh()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        result = trismooth.smooth(points, elements)
    assert "of the elements are acceptable" in result._repr_html_() and "triangles are" not in result._repr_html_()
    assert "quadrilaterals alone" in str(result.after)


def as_meshio(points, elements):
    meshio = pytest.importorskip("meshio")
    is_triangle = elements[:, 3] < 0
    return meshio.Mesh(points, [("triangle", elements[is_triangle, :3]), ("quad", elements[~is_triangle])])


def test_meshes_of_other_packages_are_smoothed_and_judged_with_their_quadrilaterals():
    points, elements = mixed_mesh()
    listed = np.concatenate([elements[elements[:, 3] < 0], elements[elements[:, 3] >= 0]])
    mesh = as_meshio(points, elements)
    expected = trismooth.smooth(points, listed, method="mean-ratio")
    result = trismooth.smooth(mesh, method="mean-ratio")
    np.testing.assert_array_equal(result.mesh.points, expected.points)
    assert result.notes == [] and result.after.quadrilaterals == (elements[:, 3] >= 0).sum()
    assert repr(trismooth.quality(mesh).summary) == repr(trismooth.quality(points, listed).summary)


def uneven_square(seed=3):
    """A mesh of both kinds whose sides are straight: its vertices are off their places, those of the sides along these."""
    places, elements = mixed_mesh(jitter=0)
    x, y = places.T
    shift = np.random.default_rng(seed).uniform(-0.3, 0.3, places.shape)
    shift[(x == 0) | (x == 12), 0] = 0
    shift[(y == 0) | (y == 9), 1] = 0
    return places, places + shift, elements


@pytest.mark.parametrize("method", ["smart", "laplacian", "weighted", "mean-ratio"])
def test_vertices_of_quadrilaterals_slide_along_sides(method):
    places, points, elements = uneven_square()
    x, y = places.T
    result = trismooth.smooth(points, elements, slide="straight", method=method)
    assert result.sliding.lines == 4 and result.sliding.vertices == 2 * (11 + 8) and result.sliding.slid > 0
    assert (result.points[y == 0, 1] == 0).all() and (result.points[x == 12, 0] == 12).all()
    corners = ((x == 0) | (x == 12)) & ((y == 0) | (y == 9))
    np.testing.assert_array_equal(result.points[corners], points[corners])
    assert shapes_of(result.points, elements).min() >= shapes_of(points, elements).min() - 1e-12
    planned = trismooth.Plan(elements, len(points), slide="straight", method=method).smooth(points)
    np.testing.assert_array_equal(planned.points, result.points)


def test_vertices_of_quadrilaterals_of_other_packages_slide():
    _, points, elements = uneven_square()
    listed = np.concatenate([elements[elements[:, 3] < 0], elements[elements[:, 3] >= 0]])
    for options in ({"slide": "straight"}, {"slide": "curves", "method": "mean-ratio", "deviation": 0.05}):
        expected = trismooth.smooth(points, listed, **options)
        result = trismooth.smooth(as_meshio(points, elements), **options)
        np.testing.assert_array_equal(result.mesh.points, expected.points)
        assert result.notes == [] and result.sliding.slid == expected.sliding.slid > 0


def test_quadrilaterals_of_scikit_fem_are_smoothed():
    skfem = pytest.importorskip("skfem")
    square = skfem.MeshQuad1().refined(3)
    inner = square.interior_nodes()
    doflocs = square.doflocs.copy()
    doflocs[:, inner] += np.random.default_rng(2).uniform(-0.04, 0.04, (2, len(inner)))
    result = trismooth.smooth(skfem.MeshQuad1(doflocs, square.t), method="mean-ratio")
    assert isinstance(result.mesh, skfem.MeshQuad1) and result.before["shape"].min < 0.6 < 0.99 < result.after["shape"].min
    np.testing.assert_allclose(result.mesh.doflocs, square.doflocs, atol=0.01)


def test_a_file_is_smoothed_with_its_quadrilaterals_unless_they_are_to_be_held(tmp_path):
    points, elements = mixed_mesh()
    as_meshio(np.pad(points, ((0, 0), (0, 1))), elements).write(tmp_path / "mixed.vtu")
    mesh = trismooth.read(tmp_path / "mixed.vtu")
    np.testing.assert_array_equal(mesh.quadrilaterals, elements[elements[:, 3] >= 0])
    assert mesh.quality().quadrilaterals == len(mesh.quadrilaterals)
    with pytest.warns(trismooth.MeshWarning, match="not smoothed, their vertices held fixed"):
        held = mesh.smooth(quads="hold")
    assert held.report["options"]["quads"] == "hold" and held.report["input"]["quadrilaterals"] == 0
    result = mesh.smooth(method="mean-ratio")
    assert result.report["after"]["kinds"][1]["kind"] == "quadrilateral"
    assert result.report["after"]["kinds"][1]["metrics"]["shape"]["min"] == pytest.approx(
        shapes_of(mesh.points[:, :2], elements[elements[:, 3] >= 0]).min()
    )
    with pytest.raises(ValueError, match="^quads: .*'smooth', 'hold'|quads"):
        mesh.smooth(quads="some")
