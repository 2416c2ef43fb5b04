# SPDX-License-Identifier: BSD-3-Clause
"""Triangles that are listed again: counted and smoothed once, said, and no vertex is free for it."""

import warnings

import numpy as np
import pytest

import trismooth


def grid(n=10, seed=1):
    x, y = np.meshgrid(np.arange(n + 1, dtype=float), np.arange(n + 1, dtype=float))
    points = np.stack([x.ravel(), y.ravel()], 1)
    inner = (points > 0).all(axis=1) & (points < n).all(axis=1)
    points[inner] += np.random.default_rng(seed).uniform(-0.35, 0.35, (int(inner.sum()), 2))
    first = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    lower = np.stack([first, first + 1, first + n + 2], 1)
    return points, np.concatenate([lower, np.stack([first, first + n + 2, first + n + 1], 1)])


def with_copies(triangles):
    """All of them a second time, the other way round, and some a third time in between."""
    return np.concatenate([triangles[:50], triangles[10:20][:, [1, 2, 0]], triangles[50:], triangles[:, ::-1]])


def part_of(points, triangles):
    centres = points[triangles].mean(axis=1)
    return ((centres > 3) & (centres < 7)).all(axis=1)


@pytest.mark.parametrize("method", trismooth.METHODS)
def test_each_triangle_counts_and_is_smoothed_once(method):
    points, triangles = grid()
    once = trismooth.smooth(points, triangles, method=method)
    with pytest.warns(trismooth.MeshWarning, match=r"210 triangles are listed again \(the first is 50, which has the"):
        again = trismooth.smooth(points, with_copies(triangles), method=method)
    assert (again.points == once.points).all()
    assert again.inverted == 0
    assert again.free_vertices == once.free_vertices
    assert again.before.triangles == len(triangles)
    assert len(again.triangles) == len(triangles) + 210
    assert sum("listed again" in note for note in again.notes) == 1
    assert not any("listed" in note for note in once.notes)


def test_worst_triangles_have_the_numbers_of_the_list():
    points, triangles = grid()
    listed = np.concatenate([triangles[:3], triangles[:3], triangles[3:]])
    with pytest.warns(trismooth.MeshWarning):
        result = trismooth.smooth(points, listed)
    once = trismooth.smooth(points, triangles)
    for report, expected in ((result.before, once.before), (result.after, once.after)):
        for element, known in zip(report.worst, expected.worst):
            assert (listed[element.triangle] == triangles[known.triangle]).all()


def test_regions_that_overlap_keep_their_border():
    points, triangles = grid()
    is_part = part_of(points, triangles)
    listed = np.concatenate([triangles, triangles[is_part]])
    labels = np.array(["all"] * len(triangles) + ["part"] * int(is_part.sum()))
    expected = trismooth.smooth(points, triangles, regions=is_part)
    with pytest.warns(trismooth.MeshWarning, match=f"{is_part.sum()} triangles are listed in several regions"):
        result = trismooth.smooth(points, listed, regions=labels)
    assert (result.points == expected.points).all()
    assert (result.points != trismooth.smooth(points, triangles).points).any()
    # Sets of labels in whatever order are one.
    three = np.concatenate([triangles, triangles[is_part], triangles[is_part]])
    mixed = np.concatenate([np.where(np.arange(len(triangles)) % 2, 5, 7), np.full(2 * is_part.sum(), 5)])
    mixed[len(triangles) + is_part.sum():] = 7
    mixed[: len(triangles)][~is_part] = 5
    with pytest.warns(trismooth.MeshWarning, match=f"{is_part.sum()} triangles are listed in several regions"):
        assert (trismooth.smooth(points, three, regions=mixed).points == expected.points).all()


def test_a_plan_smooths_each_once():
    points, triangles = grid()
    expected = trismooth.Plan(triangles, len(points), regions=part_of(points, triangles)).smooth(points, quality=True)
    listed = with_copies(triangles)
    with pytest.warns(trismooth.MeshWarning, match="210 triangles are listed again"):
        plan = trismooth.Plan(listed, len(points), regions=part_of(points, listed))
    assert plan.n_triangles == len(triangles)
    result = plan.smooth(points, quality=True)
    assert (result.points == expected.points).all()
    assert (listed[result.after.worst[0].triangle] == triangles[expected.after.worst[0].triangle]).all()
    assert sum("listed again" in note for note in result.notes) == 1


def test_quality_of_copies_is_that_of_the_first():
    points, triangles = grid()
    expected = trismooth.quality(points, triangles)
    listed = np.concatenate([triangles[::-1][:7], triangles[:, ::-1]])
    with pytest.warns(trismooth.MeshWarning, match="7 triangles are listed again"):
        found = trismooth.quality(points, listed)
    assert found.summary.triangles == len(triangles)
    assert found.summary.inverted == 0
    assert len(found.shape) == len(listed)
    np.testing.assert_array_equal(found.shape[7:], expected.shape)
    np.testing.assert_array_equal(found.shape[:7], expected.shape[::-1][:7])
    assert (np.sort(listed[found.summary.worst[0].triangle]) == np.sort(triangles[expected.summary.worst[0].triangle])).all()


def test_triangles_of_six_nodes_with_other_middles_hold_their_vertices():
    points, corners = grid()
    sides = np.sort(corners[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    ends, number = np.unique(sides, axis=0, return_inverse=True)
    triangles = np.concatenate([corners, len(points) + number.reshape(-1, 3)], axis=1)
    points = np.concatenate([points, points[ends].mean(axis=1)])
    expected = trismooth.smooth(points, triangles)
    same = np.concatenate([triangles, triangles[:, [2, 1, 0, 4, 3, 5]]])
    with pytest.warns(trismooth.MeshWarning, match="200 triangles are listed again"):
        result = trismooth.smooth(points, same)
    assert (result.points == expected.points).all()
    other = triangles[45:46].copy()
    other[0, 4] = len(points)
    with pytest.warns(trismooth.MeshWarning, match="1 of the triangles that are listed again has other middles"):
        result = trismooth.smooth(np.concatenate([points, [[5.0, 5.0]]]), np.concatenate([triangles, other]))
    assert (result.points[:-1][triangles[45]] == points[triangles[45]]).all()
    assert (result.points[:-1] != points).any()


def test_a_mesh_of_meshio_with_groups_that_overlap():
    meshio = pytest.importorskip("meshio")
    points, triangles = grid()
    is_part = part_of(points, triangles)
    mesh = meshio.Mesh(
        points,
        [("triangle", triangles), ("triangle", triangles[is_part])],
        cell_data={"gmsh:physical": [np.ones(len(triangles), int), np.full(int(is_part.sum()), 2)]},
    )
    with pytest.warns(trismooth.MeshWarning) as warned:
        result = trismooth.smooth(mesh)
    said = [str(warning.message) for warning in warned]
    assert any("are listed again" in sentence for sentence in said)
    assert any("are listed in several regions" in sentence for sentence in said)
    assert (result.mesh.points == trismooth.smooth(points, triangles, regions=is_part).points).all()
    assert [len(block.data) for block in result.mesh.cells] == [len(triangles), int(is_part.sum())]
    assert (result.mesh.cell_data["gmsh:physical"][1] == 2).all()


def test_nothing_is_said_where_nothing_is_listed_again():
    points, triangles = grid()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        trismooth.smooth(points, triangles)
        trismooth.quality(points, triangles)
