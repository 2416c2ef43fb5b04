# SPDX-License-Identifier: BSD-3-Clause
"""Quadrilaterals of eight and nine nodes, alone and among others, from arrays and from other packages' meshes."""

import numpy as np
import pytest

import trismooth

N = 7


def grid(centres=True, seed=1):
    """Corners of a jittered grid of squares, with a node in the middle of every side, and in every second centre."""
    random = np.random.default_rng(seed)
    x, y = np.meshgrid(np.arange(N + 1.0), np.arange(N + 1.0))
    points = np.stack([x.ravel(), y.ravel()], axis=1)
    inner = (x.ravel() % N > 0) & (y.ravel() % N > 0)
    points[inner] += random.uniform(-0.3, 0.3, (inner.sum(), 2))
    first = (np.arange(N)[:, None] * (N + 1) + np.arange(N)).ravel()
    corners = np.stack([first, first + 1, first + N + 2, first + N + 1], axis=1)
    sides = np.sort(corners[:, [[0, 1], [1, 2], [2, 3], [3, 0]]].reshape(-1, 2), axis=1)
    ends, number = np.unique(sides, axis=0, return_inverse=True)
    middles = len(points) + number.reshape(-1, 4)
    points = np.concatenate([points, points[ends].mean(axis=1)])
    centre = np.full(len(corners), -1)
    if centres:
        centre[::2] = len(points) + np.arange(len(corners[::2]))
        points = np.concatenate([points, points[corners[::2]].mean(axis=1)])
    return points, np.column_stack([corners, middles, centre]), ends


def check(before, after, elements, ends):
    """Corners inside have moved, those of the boundary have not, and middles are where they were on straight sides."""
    n_corners = (N + 1) ** 2
    moved = (before != after).any(axis=1)
    assert moved[:n_corners].sum() == (N - 1) ** 2
    np.testing.assert_allclose(after[n_corners : n_corners + len(ends)], after[ends].mean(axis=1), atol=1e-14)


@pytest.mark.parametrize("dtype", [np.int64, np.int32, np.uint32])
def test_arrays_of_nine_columns(dtype):
    points, elements, ends = grid()
    result = trismooth.smooth(points, elements.astype(dtype), quality=True)
    check(points, result.points, elements, ends)
    corners_alone = trismooth.smooth(points[: (N + 1) ** 2], elements[:, :4])
    assert (result.points[: (N + 1) ** 2] == corners_alone.points).all()
    assert result.after.quadrilaterals == N * N and result.after["shape"].min > result.before["shape"].min


def test_arrays_of_eight_columns_and_other_elements_among_them():
    points, elements, ends = grid(centres=False)
    expected = trismooth.smooth(points, elements[:, :8])
    check(points, expected.points, elements, ends)
    assert (trismooth.smooth(points, elements).points == expected.points).all()
    mixed = elements.copy()
    mixed[0, 4:] = -1
    assert len(trismooth.smooth(points, mixed).points) == len(points)
    mixed[0, 3:] = [-1, 1, 2, -1, -1, -1]
    with pytest.raises(trismooth.MeshError, match="element 0 has 3 nodes before the first -1"):
        trismooth.smooth(points, mixed)


def test_rows_of_other_numbers_of_nodes_are_refused_by_quality_as_well():
    points, elements, _ = grid()
    for left in (0, 2, 5, 7):
        rows = elements.copy()
        rows[3, left:] = -1
        for call in (trismooth.smooth, trismooth.quality):
            with pytest.raises(trismooth.MeshError, match=f"element 3 has {left} nodes before the first -1"):
                call(points, rows)


@pytest.mark.parametrize("place, other", [(4, (0, 0)), (4, (9, 5)), (8, (12, 8))])
def test_nodes_that_cannot_follow_are_told_with_what_they_hold(place, other):
    points, elements, _ = grid()
    element = 24  # in the middle of the mesh, with a centre
    free = trismooth.smooth(points, elements)
    assert free.notes == []
    elements[element, place] = elements[other]
    with pytest.warns(trismooth.MeshWarning, match="a node of its own for each side and element lets them move"):
        result = trismooth.smooth(points, elements)
    assert (result.points[elements[other]] == points[elements[other]]).all()
    assert result.free_vertices < free.free_vertices


def test_corners_alone_in_rows_of_nine_are_corners_alone():
    points, elements, _ = grid(centres=False)
    points, corners = points[: (N + 1) ** 2], elements[:, :4]
    rows = np.pad(corners, ((0, 0), (0, 5)), constant_values=-1)
    for options in ({}, {"slide": "straight", "method": "mean-ratio"}):
        expected = trismooth.smooth(points, corners, **options)
        assert (trismooth.smooth(points, rows, **options).points == expected.points).all()
    assert trismooth.Plan(rows, len(points)).n_triangles == N * N


def test_what_arrays_with_middles_cannot_do_is_said():
    points, elements, _ = grid()
    with pytest.raises(ValueError, match="slide: is for elements of corners alone"):
        trismooth.smooth(points, elements, slide="straight")
    with pytest.raises(ValueError, match="a plan is for elements of corners alone"):
        trismooth.Plan(elements, len(points))
    with pytest.raises(ValueError, match=r"shape \(49, 7\); expected"):
        trismooth.smooth(points, elements[:, :7])
    with pytest.raises(TypeError, match="have no -1"):
        trismooth.smooth(points, elements.astype(np.uint16))


def test_a_copy_with_another_middle_holds_its_vertices():
    points, elements, _ = grid()
    middle = (N // 2) * N + N // 2
    copy = np.roll(elements[middle, :4], 1)
    same = np.concatenate([copy, np.roll(elements[middle, 4:8], 1), elements[middle, 8:]])
    with pytest.warns(trismooth.MeshWarning, match="1 element is listed again"):
        result = trismooth.smooth(points, np.vstack([elements, same]))
    assert (result.points == trismooth.smooth(points, elements).points).all()
    same[4] = len(points)
    with pytest.warns(trismooth.MeshWarning, match="has other middles of sides"):
        result = trismooth.smooth(np.vstack([points, [[9, 9]]]), np.vstack([elements, same]))
    assert (result.points[elements[middle, :4]] == points[elements[middle, :4]]).all()


def test_meshes_of_meshio_and_pyvista():
    meshio = pytest.importorskip("meshio")
    pv = pytest.importorskip("pyvista")
    points, elements, ends = grid()
    expected = trismooth.smooth(points, elements).points
    points3 = np.column_stack([points, np.zeros(len(points))])
    with_centre = elements[:, 8] >= 0
    mesh = meshio.Mesh(points3, [("quad9", elements[with_centre]), ("quad8", elements[~with_centre, :8])])
    found = trismooth.smooth(mesh).mesh.points
    check(points, found[:, :2], elements, ends)
    np.testing.assert_allclose(found[:, :2], expected, atol=0.2)
    cells = [[9, *row] if row[8] >= 0 else [8, *row[:8]] for row in elements]
    types = np.where(with_centre, 28, 23).astype(np.uint8)
    grid_of_vtk = pv.UnstructuredGrid(np.concatenate(cells), types, points3)
    assert (trismooth.smooth(grid_of_vtk).mesh.points[:, :2] == expected).all()


def test_files_and_pictures(tmp_path):
    pytest.importorskip("matplotlib")
    meshio = pytest.importorskip("meshio")
    if not trismooth.build_info()["files"]:
        pytest.skip("built without files")
    points, elements, ends = grid()
    path = tmp_path / "mesh.msh"
    with_centre = elements[:, 8] >= 0
    points3 = np.column_stack([points, np.zeros(len(points))])
    blocks = [("quad8", elements[~with_centre, :8]), ("quad9", elements[with_centre])]
    meshio.write(path, meshio.Mesh(points3, blocks), file_format="gmsh22", binary=False)
    mesh = trismooth.read(path)
    assert mesh.quadratic_quadrilaterals.shape == (N * N, 9)
    result = mesh.smooth()
    check(points, result.points[:, :2], elements, ends)
    assert result.report["input"]["quadratic_quadrilaterals"] == N * N
    axes = trismooth.plot(result)
    assert axes is not None
