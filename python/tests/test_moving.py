# SPDX-License-Identifier: BSD-3-Clause
"""Meshes that follow their boundary."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

import trismooth
from conftest import grid


def rotor(rings: int = 12, around: int = 48):
    """Triangles between a square and a circle around it: points, triangles, and which points are of the square."""
    angles = np.arange(around) * 2 * np.pi / around
    square = 0.7 / np.maximum(np.abs(np.cos(angles)), np.abs(np.sin(angles)))
    part = np.linspace(0, 1, rings + 1)[:, None]
    radius = (1 - part) * square + part * 4
    points = np.column_stack([(radius * np.cos(angles)).ravel(), (radius * np.sin(angles)).ravel()])
    ring, at = (numbers.ravel() for numbers in np.meshgrid(np.arange(rings), np.arange(around), indexing="ij"))
    a, b = ring * around + at, ring * around + (at + 1) % around
    triangles = np.concatenate([np.column_stack([a, a + around, b]), np.column_stack([b, a + around, b + around])])
    return points, triangles, np.arange(len(points)) < around


def turned(points: np.ndarray, degrees: float) -> np.ndarray:
    angle = np.radians(degrees)
    return points @ [[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]]


def with_rotor_at(points: np.ndarray, of_rotor: np.ndarray, degrees: float) -> np.ndarray:
    now = points.copy()
    now[of_rotor] = turned(points[of_rotor], degrees)
    return now


def doubled_areas(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    a, b, c = (points[triangles[:, i]] for i in range(3))
    return (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]


def test_a_rotor_that_turns_and_comes_back_has_the_same_points_to_the_last_bit():
    points, triangles, of_rotor = rotor()
    mesh = trismooth.MovingMesh(points, triangles, layers="smooth")
    seen: dict[float, bytes] = {}
    for degrees in (0, 15, 30, 45, 30, 15, 0):
        now = points.copy()
        now[of_rotor] = turned(points[of_rotor], degrees)
        result = mesh.follow(now)
        assert result.inverted == 0 and doubled_areas(result.points, triangles).min() > 0
        assert seen.setdefault(degrees, result.points.tobytes()) == result.points.tobytes()
        np.testing.assert_array_equal(mesh.points, result.points)


def test_what_is_held_keeps_its_bits_and_where_the_others_were_does_not_matter():
    points, triangles, of_rotor = rotor()
    mesh = trismooth.MovingMesh(points, triangles)
    assert mesh.held[of_rotor].all() and mesh.held.sum() == 2 * of_rotor.sum()
    now = points.copy()
    now[of_rotor] = turned(points[of_rotor], 20)
    expected = mesh.follow(now).points
    np.testing.assert_array_equal(expected[mesh.held], now[mesh.held])
    now[~mesh.held] = 7
    np.testing.assert_array_equal(mesh.follow(now).points, expected)
    for threads in (1, 3):
        again = trismooth.MovingMesh(points, triangles, threads=threads)
        np.testing.assert_array_equal(again.follow(now, out=now).points, expected)
        np.testing.assert_array_equal(now, expected)


def test_a_mesh_that_is_shifted_or_turned_is_where_it_was_but_for_that():
    points, triangles, _ = rotor()
    mesh = trismooth.MovingMesh(points, triangles)
    at_rest = mesh.follow(points).points
    shifted = mesh.follow(points + [1, 2])
    np.testing.assert_allclose(shifted.points, at_rest + [1, 2], atol=1e-9)
    assert shifted.largest_move == pytest.approx(5**0.5, abs=1e-9)
    around = mesh.follow(turned(points, 130) - [3, 4])
    np.testing.assert_allclose(around.points, turned(at_rest, 130) - [3, 4], atol=1e-9)


def test_from_the_last_result_on_it_depends_on_the_path_and_is_as_good():
    points, triangles, of_rotor = rotor()
    mesh = trismooth.MovingMesh(points, triangles, layers="smooth")
    for degrees in (5, 10):
        now = points.copy()
        now[of_rotor] = turned(points[of_rotor], degrees)
        result = mesh.follow(now, start="previous")
    from_reference = mesh.follow(now)
    assert not np.array_equal(result.points, from_reference.points)
    assert result.inverted == 0 and result.min_relative_shape > 0.5 * from_reference.min_relative_shape


def test_defaults_are_what_the_documentation_says():
    points, triangles, of_rotor = rotor()
    now = points.copy()
    now[of_rotor] = turned(points[of_rotor], 20)
    expected = trismooth.MovingMesh(points, triangles).follow(now).points
    said = trismooth.MovingMesh(
        points, triangles, method="mean-ratio", target="input-shape", power=8, size_weight=0.3, backend="cpu"
    )
    np.testing.assert_array_equal(said.follow(now).points, expected)
    uniform = trismooth.MovingMesh(points, triangles, target="uniform").follow(now)
    assert not np.array_equal(uniform.points, expected)


def test_float32_heights_and_quality():
    points, triangles, of_rotor = rotor()
    mesh = trismooth.MovingMesh(points, triangles)
    now = points.copy()
    now[of_rotor] = turned(points[of_rotor], 20)
    single = mesh.follow(now.astype(np.float32), quality=True)
    assert single.points.dtype == np.float32
    assert single.after["shape"].min == pytest.approx(mesh.follow(now, quality=True).after["shape"].min, rel=1e-3)
    high = mesh.follow(np.column_stack([now, np.full(len(now), 3.5)]))
    np.testing.assert_array_equal(high.points, np.column_stack([mesh.follow(now).points, np.full(len(now), 3.5)]))


def test_relative_shapes_are_those_of_the_maps_from_the_reference():
    points, triangles, of_rotor = rotor()
    now = points.copy()
    now[of_rotor] = turned(points[of_rotor], 30)
    result = trismooth.MovingMesh(points, triangles).follow(now)
    shapes = []
    for corners in triangles:
        was, is_now = (np.column_stack([p[corners[1]] - p[corners[0]], p[corners[2]] - p[corners[0]]]) for p in (points, result.points))
        change = is_now @ np.linalg.inv(was)
        shapes.append(2 * np.linalg.det(change) / np.sum(change**2))
    assert result.min_relative_shape == pytest.approx(min(shapes), rel=1e-9)
    assert result.mean_relative_shape == pytest.approx(np.mean(shapes), rel=1e-9)
    assert "smallest relative shape" in repr(result)


def test_a_boundary_that_folds_is_said():
    points, triangles = grid(6, 6, shift=0)
    mesh = trismooth.MovingMesh(points, triangles)
    now = points.copy()
    # The corner of the square with a triangle of its own goes through the opposite side of it.
    corner = next(v for v in (0, 6, 42, 48) if (triangles == v).any(axis=1).sum() == 1)
    now[corner] += 1.5 * (points.mean(axis=0) - points[corner]) / 3
    with pytest.warns(trismooth.MeshWarning, match="the boundary has folded: all vertices of 1 triangle that is inverted"):
        result = mesh.follow(now)
    assert result.invalid_held == 1 and result.inverted >= 1
    assert any("folded" in note for note in result.notes)


def test_triangles_that_are_listed_again_count_once_and_are_said():
    points, triangles, of_rotor = rotor()
    now = points.copy()
    now[of_rotor] = turned(points[of_rotor], 20)
    with pytest.warns(trismooth.MeshWarning, match="listed again"):
        mesh = trismooth.MovingMesh(points, np.concatenate([triangles, triangles[3:5]]))
    assert mesh.n_triangles == len(triangles) and mesh.n_points == len(points)
    np.testing.assert_array_equal(mesh.follow(now).points, trismooth.MovingMesh(points, triangles).follow(now).points)


def test_invalid_triangles_have_the_numbers_of_the_list_that_was_given():
    points, triangles, of_rotor = rotor()
    twice = np.concatenate([triangles[:40], triangles])
    now = points.copy()
    now[of_rotor] += [3.7, 0.1]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", trismooth.MeshWarning)
        result = trismooth.MovingMesh(points, twice).follow(now)
    areas = doubled_areas(result.points, twice) * np.sign(doubled_areas(points, twice))
    first = np.unique(np.sort(twice, axis=1), axis=0, return_index=True)[1]
    assert result.invalid == sorted(set(first) & set(np.flatnonzero(~(areas > 0))))


def test_named_vertices_and_borders_of_regions_are_held():
    points, triangles, _ = rotor()
    labels = (doubled_areas(points, triangles) > np.median(doubled_areas(points, triangles))).astype(int)
    mesh = trismooth.MovingMesh(points, triangles, regions=labels, fixed=[200])
    assert mesh.held[200]
    both = set(triangles[labels == 0].ravel()) & set(triangles[labels == 1].ravel())
    assert mesh.held[sorted(both)].all()


def test_layers_go_with_their_wall():
    points, triangles = grid(30, 8, shift=0)
    points[:, 1] = 0.002 * (2.0 ** points[:, 1] - 1)
    mesh = trismooth.MovingMesh(points, triangles)
    now = points.copy()
    now[:, 1] += 0.02 * np.sin(np.pi * points[:, 0] / 30)
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        result = mesh.follow(now)
    assert any(
        "and are carried along as they are; layers='smooth' smooths them" in str(note.message) for note in said
    )
    first = (result.points[31:62, 1] - result.points[:31, 1])[1:-1]
    np.testing.assert_allclose(first, 0.002, rtol=0.05)


def test_a_callback_ends_the_sweeps():
    points, triangles, of_rotor = rotor()
    now = points.copy()
    now[of_rotor] = turned(points[of_rotor], 20)
    result = trismooth.MovingMesh(points, triangles).follow(now, progress=lambda record: record.sweep < 2)
    assert result.stop_reason == "cancelled" and result.sweeps == 2


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        ({"slide": "straight"}, ValueError, "slide"),
        ({"max_sweeps": 0}, ValueError, "^max_sweeps: .*limit from 1"),
        ({"size": np.ones(624)}, TypeError, "size: a mesh that moves has the sizes of its reference"),
        ({"powr": 2}, TypeError, "'powr' is no option .did you mean 'power'"),
        ({"power": 99}, ValueError, "power"),
        ({"fixed": [624]}, ValueError, "fixed"),
    ],
)
def test_what_does_not_fit_is_refused(arguments, error, message):
    points, triangles, _ = rotor()
    with pytest.raises(error, match=message):
        trismooth.MovingMesh(points, triangles, **arguments)


def test_layers_are_said_in_the_first_step_alone_also_as_errors():
    x, y = np.meshgrid(np.linspace(0, 40, 41), np.cumsum([0, *(0.02 * 1.3 ** np.arange(20))]))
    points = np.column_stack([x.ravel(), y.ravel()])
    first = (np.arange(20)[:, None] * 41 + np.arange(40)).ravel()
    triangles = np.concatenate([np.column_stack([first, first + 1, first + 42]), np.column_stack([first, first + 42, first + 41])])
    mesh = trismooth.MovingMesh(points, triangles)
    with pytest.warns(trismooth.MeshWarning, match="layers .* are carried along as they are; layers='smooth' smooths them"):
        mesh.follow(points)
    with warnings.catch_warnings():
        warnings.simplefilter("error", trismooth.MeshWarning)
        mesh.follow(points)
        mesh = trismooth.MovingMesh(points, triangles)
        with pytest.raises(trismooth.MeshWarning, match="layers"):
            mesh.follow(points)
        assert mesh.follow(points).valid


def test_a_limit_of_time_is_no_fault_of_the_boundary():
    points, triangles, of_rotor = rotor()
    now = points.copy()
    now[of_rotor] = turned(points[of_rotor], 20)
    mesh = trismooth.MovingMesh(points, triangles, time_limit=0.0)
    with pytest.warns(trismooth.MeshWarning, match="the time was up before the first sweep, so no vertex has moved"):
        result = mesh.follow(now)
    assert result.inverted == -1 and not any("boundary leaves them no room" in note for note in result.notes)
    np.testing.assert_array_equal(mesh.points, points)
    # As soon as it makes a sweep, or none is needed, what it says is of the time.
    for limit in (1e-4, 3e-4, 1e-3, 3e-3, 1e-2):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", trismooth.MeshWarning)
            result = trismooth.MovingMesh(points, triangles, time_limit=limit).follow(now)
        ended = result.stop_reason == "time_limit"
        assert ended == any("time" in note for note in result.notes)
        assert not ended or not any("the boundary leaves" in note for note in result.notes)


def test_what_makes_a_result_invalid_is_in_its_text():
    points, triangles = grid(6, 6, shift=0)
    mesh = trismooth.MovingMesh(points, triangles)
    now = points.copy()
    now[mesh.held] = now[mesh.held][:, [1, 0]]  # mirrored
    with pytest.warns(trismooth.MeshWarning):
        result = mesh.follow(now)
    assert not result.valid
    assert any(word in repr(result) for word in ("inverted or degenerate", "crossings of the boundary", "lies over itself"))


def test_a_device_that_is_not_there_is_told():
    if "device 0" in str(trismooth.build_info()["devices"]):
        pytest.skip("there is one: test_device.py has meshes follow on it")
    points, triangles, _ = rotor()
    with pytest.raises((ValueError, trismooth.DeviceError)):
        trismooth.MovingMesh(points, triangles, backend="cuda")


def test_sweeps_that_end_before_the_mesh_has_arrived_are_said():
    points, triangles, of_rotor = rotor()
    now = with_rotor_at(points, of_rotor, 40)
    mesh = trismooth.MovingMesh(points, triangles, max_sweeps=2)
    with pytest.warns(trismooth.MeshWarning, match="still on its way"):
        mesh.follow(now)
    assert trismooth.MovingMesh(points, triangles).follow(now).stop_reason != "sweep_limit"


def test_arrays_that_do_not_fit_are_refused_and_leave_the_points_alone():
    points, triangles, _ = rotor()
    mesh = trismooth.MovingMesh(points, triangles)
    for wrong, message in (
        (points[:-1], "points: shape .*; the moving mesh has 624 vertices"),
        (np.where(points == points[5], np.nan, points), "point"),
        (points.astype(int), "points: "),
    ):
        kept = wrong.copy()
        with pytest.raises((TypeError, ValueError), match=message):
            mesh.follow(wrong, out=wrong)
        np.testing.assert_array_equal(wrong, kept)
    with pytest.raises(ValueError, match="start: .*reference"):
        mesh.follow(points, start="now")
    with pytest.raises(ValueError, match="a moving mesh is for elements of corners alone"):
        trismooth.MovingMesh(points, np.zeros((2, 6), dtype=int) + np.arange(6))
    with pytest.raises(ValueError, match="nan|finite"):
        trismooth.MovingMesh(points * np.nan, triangles)


def test_a_boundary_that_crosses_itself_is_said():
    points, triangles, of_rotor = rotor()
    now = points.copy()
    now[of_rotor] += [3.7, 0.1]
    with pytest.warns(trismooth.MeshWarning, match="the boundary crosses or touches itself"):
        result = trismooth.MovingMesh(points, triangles).follow(now)
    for one, other in result.crossings:
        ends = now[[*one, *other]]
        (a, b), (c, d) = ends[:2], ends[2:]
        part = np.linalg.solve(np.column_stack([b - a, c - d]), c - a)
        assert (part > 0).all() and (part < 1).all()
    assert len(result.crossings) >= 2


def ring(around=16):
    angles = np.linspace(0, 2 * np.pi, around, endpoint=False)
    circle = np.column_stack([np.cos(angles), np.sin(angles)])
    points = np.concatenate([(1 + j) * circle for j in range(3)])
    i = np.arange(around)
    j = (i + 1) % around
    triangles = np.concatenate(
        [
            np.column_stack(corners)
            for k in (0, around)
            for corners in ((k + i, k + around + i, k + around + j), (k + i, k + around + j, k + j))
        ]
    )
    return points, triangles


def test_a_hole_that_is_turned_inside_out_is_said_though_nothing_is_inverted():
    points, triangles = ring()
    now = points.copy()
    now[:16, 0] *= -1
    with pytest.warns(trismooth.MeshWarning, match="lies over itself|inverted"):
        result = trismooth.MovingMesh(points, triangles).follow(now)
    assert result.crossings == []
    assert result.overlaps or result.invalid


def test_the_triangles_that_are_not_valid_are_listed():
    points, triangles, of_rotor = rotor()
    now = points.copy()
    now[of_rotor] += [3.7, 0.1]
    with pytest.warns(trismooth.MeshWarning):
        result = trismooth.MovingMesh(points, triangles).follow(now)
    areas = doubled_areas(result.points, triangles) * np.sign(doubled_areas(points, triangles))
    assert result.invalid == list(np.flatnonzero(~(areas > 0)))
    assert len(result.invalid) == result.inverted + result.degenerate
    assert f"{len(result.invalid)} inverted or degenerate" in repr(result)


def test_a_call_that_fails_has_not_happened():
    points, triangles, of_rotor = rotor()
    mesh = trismooth.MovingMesh(points, triangles)
    mesh.follow(with_rotor_at(points, of_rotor, 10))
    last = mesh.points
    bad = points.copy()
    bad[of_rotor] += [3.7, 0.1]
    with warnings.catch_warnings():
        warnings.simplefilter("error", trismooth.MeshWarning)
        with pytest.raises(trismooth.MeshWarning):
            mesh.follow(bad)
    np.testing.assert_array_equal(mesh.points, last)
    other = trismooth.MovingMesh(points, triangles)
    other.go_on_from(last)
    now = with_rotor_at(points, of_rotor, 12)
    np.testing.assert_array_equal(mesh.follow(now, start="previous").points, other.follow(now, start="previous").points)


def test_a_run_goes_on_from_points_that_were_kept():
    points, triangles, of_rotor = rotor()
    whole = trismooth.MovingMesh(points, triangles)
    kept = whole.follow(with_rotor_at(points, of_rotor, 10)).points
    expected = whole.follow(with_rotor_at(points, of_rotor, 12), start="previous")
    again = trismooth.MovingMesh(points, triangles)
    again.go_on_from(kept)
    np.testing.assert_array_equal(again.points, kept)
    result = again.follow(with_rotor_at(points, of_rotor, 12), start="previous")
    np.testing.assert_array_equal(result.points, expected.points)
    assert result.largest_move == expected.largest_move
    with pytest.raises(ValueError, match="points: "):
        again.go_on_from(points[:-1])


def test_a_step_that_is_taken_back_has_not_happened():
    points, triangles, of_rotor = rotor()
    mesh = trismooth.MovingMesh(points, triangles)
    with pytest.raises(RuntimeError, match="no step to take back"):
        mesh.take_back()
    first = mesh.follow(with_rotor_at(points, of_rotor, 10)).points
    mesh.follow(with_rotor_at(points, of_rotor, 50))
    mesh.take_back()
    np.testing.assert_array_equal(mesh.points, first)
    with pytest.raises(RuntimeError, match="no step to take back"):
        mesh.take_back()
    other = trismooth.MovingMesh(points, triangles)
    other.go_on_from(first)
    now = with_rotor_at(points, of_rotor, 12)
    np.testing.assert_array_equal(mesh.follow(now, start="previous").points, other.follow(now, start="previous").points)


def test_a_mesh_is_valid_where_nothing_is_inverted_flat_or_over_itself():
    points, triangles, of_rotor = rotor()
    mesh = trismooth.MovingMesh(points, triangles)
    assert mesh.follow(with_rotor_at(points, of_rotor, 10)).valid
    now = points.copy()
    now[of_rotor] += [3.7, 0.1]
    with pytest.warns(trismooth.MeshWarning, match="take_back"):
        assert not mesh.follow(now).valid
    hurried = trismooth.MovingMesh(points, triangles, time_limit=1e-9)
    with pytest.warns(trismooth.MeshWarning, match="time was up"):
        ended = hurried.follow(points, quality=True)
    assert ended.inverted == 0 and ended.sweeps == 0 and not ended.valid
    with pytest.raises(ValueError, match="read-only"):
        mesh.held[0] = False


def test_a_method_without_a_memory_of_the_reference_is_said():
    points, triangles, _ = rotor()
    with pytest.warns(trismooth.MeshWarning, match="no memory of the reference"):
        trismooth.MovingMesh(points, triangles, method="smart")


def test_velocities_are_about_those_of_the_boundary_however_small_the_step():
    points, triangles, of_rotor = rotor()
    mesh = trismooth.MovingMesh(points, triangles)
    first = mesh.follow(with_rotor_at(points, of_rotor, 8))
    assert first.untangling["inverted_before"] == 0
    for degrees in (1e-1, 1e-3, 1e-5):
        further = mesh.follow(with_rotor_at(points, of_rotor, 8 + degrees)).points
        moves = np.linalg.norm(further - first.points, axis=1)
        assert moves.max() < 1.5 * moves[of_rotor].max()


def test_what_has_no_meaning_for_a_mesh_that_moves_is_refused_by_its_name():
    points, triangles, _ = rotor()
    with pytest.raises(ValueError, match="^slide: "):
        trismooth.MovingMesh(points, triangles, slide="straight")
    with pytest.raises(TypeError, match="^stream: "):
        trismooth.MovingMesh(points, triangles, stream=1)
    with pytest.raises(TypeError, match="^start: "):
        trismooth.MovingMesh(points, triangles).follow(points, start=None)


def test_quadrilaterals_follow_alone_and_beside_triangles_and_come_back_valid():
    around, between = 32, 8
    radii = 3.0 ** (np.arange(between + 1) / between)
    angles = 2 * np.pi * np.arange(around) / around
    points = np.stack(
        [np.outer(radii, np.cos(angles)).ravel(), np.outer(radii, np.sin(angles)).ravel()], axis=1
    )
    ring, sector = np.divmod(np.arange(around * between), around)
    a, b = ring * around + sector, ring * around + (sector + 1) % around
    quads = np.stack([a, a + around, b + around, b], axis=1).astype(np.int64)
    cut = (ring + sector) % 3 == 0
    first, second = quads[cut][:, [0, 1, 2, 2]].copy(), quads[cut][:, [0, 2, 3, 3]].copy()
    first[:, 3] = second[:, 3] = -1
    for elements in (quads, np.concatenate([quads[~cut], first, second])):
        mesh = trismooth.MovingMesh(points, elements, layers="smooth")
        assert mesh.n_triangles == len(elements)
        now = points.copy()
        c, s = np.cos(0.6), np.sin(0.6)
        now[:around] = points[:around] @ np.array([[c, s], [-s, c]])
        result = mesh.follow(now)
        assert result.valid and result.min_relative_shape > 0.1
        assert np.array_equal(result.points[:around], now[:around])
        assert trismooth.quality(result.points, elements).summary.inverted == 0
        assert mesh.follow(now).points.tobytes() == result.points.tobytes()
