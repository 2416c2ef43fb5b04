# SPDX-License-Identifier: BSD-3-Clause
"""Vertices of boundaries and interfaces that slide along their lines."""

from __future__ import annotations

import functools

import numpy as np
import pytest

import trismooth
from conftest import grid
from program import hash_of, off_file, program_hash

COLUMNS, ROWS = 12, 9


def uneven_grid():
    """A rectangle with a straight interface, whose vertices are at uneven distances on sides and interface."""
    points, triangles = grid(COLUMNS, ROWS)
    x, y = np.tile(np.arange(COLUMNS + 1), ROWS + 1), np.repeat(np.arange(ROWS + 1), COLUMNS + 1)
    random = np.random.default_rng(3)
    points[x == 6, 0] = 6
    sides = ((x % COLUMNS == 0) ^ (y % ROWS == 0)) | (x == 6)
    along = np.where(np.isin(x, (0, 6, COLUMNS)), 1, 0)
    corner = (np.isin(x, (0, 6, COLUMNS))) & (y % ROWS == 0)
    moved = np.flatnonzero(sides & ~corner)
    points[moved, along[moved]] += random.uniform(-0.35, 0.35, len(moved))
    regions = (x[triangles].mean(axis=1) > 6).astype(int)
    return points, triangles, regions, x, y


def disc(count=64, radius=2.0):
    """A disc of rings of triangles; its boundary has uneven edges."""
    angles = 2 * np.pi * (np.arange(count) + 0.3 * np.sin(np.arange(count) * 2.3)) / count
    rings = [np.column_stack([np.cos(angles), np.sin(angles)]) * r for r in radius * np.linspace(0.4, 1, 5)]
    points = np.concatenate([[[0.0, 0.0]], *rings])
    first = 1 + np.arange(count)
    after = 1 + (np.arange(count) + 1) % count
    triangles = [np.column_stack([np.zeros(count, int), first, after])]
    for ring in range(4):
        low, high = ring * count, (ring + 1) * count
        triangles += [np.column_stack([first + low, first + high, after + high])]
        triangles += [np.column_stack([first + low, after + high, after + low])]
    return points, np.concatenate(triangles)


def test_round_bends_the_deviation_is_kept():
    # (All of the disc is flat, as it has more sectors than rings.)
    smooth = functools.partial(trismooth.smooth, *disc(), layers="smooth")
    few = smooth(slide="curves").sliding
    more = smooth(slide="curves", deviation=0.05).sliding
    assert few.lines == more.lines == 1 and few.vertices == more.vertices == 64
    assert 0 < few.relative_deviation <= 1e-3 < more.relative_deviation <= 0.05
    assert 0 < few.largest_deviation < more.largest_deviation
    assert smooth(slide="straight").sliding.vertices == 0
    spline = smooth(slide="curves", deviation=0.05, curve="spline")
    polyline = smooth(slide="curves", deviation=0.05, curve="polyline")
    assert (spline.points != polyline.points).any()
    # At an angle below that between the edges all of them are corners.
    corners = smooth(slide="curves", deviation=0.05, corner_angle=0).sliding
    assert corners.vertices == 0 == corners.slid


def test_vertices_of_lines_are_held_and_slide_where_that_is_wanted():
    points, triangles, _, x, y = uneven_grid()
    column = np.flatnonzero(x == 6)
    lines = np.column_stack([column[:-1], column[1:]])
    held = trismooth.smooth(points, triangles, lines=lines).points
    np.testing.assert_array_equal(held[column], points[column])
    result = trismooth.smooth(points, triangles, lines=lines.tolist(), slide="straight")
    np.testing.assert_array_equal(result.points[column, 0], 6)
    assert (result.points[column[1:-1], 1] != points[column[1:-1], 1]).any()
    assert result.sliding.vertices == trismooth.smooth(points, triangles, slide="straight").sliding.vertices - 2 + len(column) - 2


@pytest.mark.parametrize("dtype", [np.int8, np.uint16, np.int32, np.uint32, np.int64, np.uint64])
def test_lines_of_any_integer_type_and_strides(dtype):
    points, triangles, _, x, _ = uneven_grid()
    column = np.flatnonzero(x == 6)
    lines = np.column_stack([column[:-1], column[1:]])
    expected = trismooth.smooth(points, triangles, lines=lines, slide="straight").points
    for given in (lines.astype(dtype), np.asfortranarray(lines.astype(dtype)), lines.astype(dtype)[:, ::-1]):
        np.testing.assert_array_equal(trismooth.smooth(points, triangles, lines=given, slide="straight").points, expected)


def test_a_line_ends_where_its_tag_changes():
    points, triangles, _, x, _ = uneven_grid()
    column = np.flatnonzero(x == 6)
    tags = np.array(["below"] * 4 + ["above"] * 5)
    given = {"lines": np.column_stack([column[:-1], column[1:]]), "slide": "straight", "method": "mean-ratio"}
    together = trismooth.smooth(points, triangles, **given)
    result = trismooth.smooth(points, triangles, line_tags=tags, **given)
    assert (together.points[column[4]] != points[column[4]]).any()
    np.testing.assert_array_equal(result.points[column[4]], points[column[4]])
    again = trismooth.smooth(points, triangles, line_tags=(tags == "below").astype(int) * 70 - 3, **given)
    np.testing.assert_array_equal(again.points, result.points)


@pytest.mark.parametrize("gap", [0, 1e-10])
def test_parts_that_touch_stay_together_and_a_warning_says_so(gap):
    points, triangles, regions, x, _ = uneven_grid()
    column = np.flatnonzero(x == 6)
    twin = np.arange(len(points))
    twin[column] = len(points) + np.arange(len(column))
    triangles = np.where((regions == 1)[:, None], twin[triangles], triangles)
    points = np.concatenate([points, points[column] + [gap, 0]])
    with pytest.warns(trismooth.MeshWarning, match="lines touch without sharing vertices.*slide_coincident=True"):
        stay = trismooth.smooth(points, triangles, slide="straight")
    np.testing.assert_array_equal(stay.points[column], points[column])
    np.testing.assert_array_equal(stay.points[twin[column]], points[twin[column]])
    assert any("lines touch" in note for note in stay.notes)
    assert (stay.sliding.in_same_place, stay.sliding.at_edges) == (2 * (len(column) - 2), 0)
    together = trismooth.smooth(points, triangles, slide="straight", slide_coincident=True)
    assert not together.notes and together.sliding.in_same_place == 0
    assert (together.points[column] != points[column]).any()
    np.testing.assert_array_equal(together.points[column, 1], together.points[twin[column], 1])


def test_texts_say_what_slid():
    points, triangles, regions, _, _ = uneven_grid()
    result = trismooth.smooth(points, triangles, regions=regions, slide="straight")
    sliding = result.sliding
    free = result.moved - sliding.slid
    lines = str(result).split("\n")
    assert lines[0] == f"{free} of {result.free_vertices} free vertices moved in {result.sweeps} sweeps; stopped by {result.stop_reason}"
    assert lines[1] == f"{sliding.slid} of {sliding.vertices} vertices on 7 lines slid; lines are where they were"
    assert f"{free} of {result.free_vertices} free vertices moved, {sliding.slid} of {sliding.vertices} on lines slid, " in repr(result)
    assert repr(sliding).startswith(f"SlidingResult(lines=7, vertices={sliding.vertices}, slid={sliding.slid}, ")
    curved = trismooth.smooth(*disc(), slide="curves")
    assert f"{curved.sliding.relative_deviation:.3g} of an edge" in str(curved)
    assert "line" not in str(trismooth.smooth(points, triangles)).split("\n")[0]
    none = trismooth.smooth([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]], slide="straight")
    assert "no vertex of a boundary or an interface can slide" in str(none)


@pytest.mark.skipif(not trismooth.build_info()["cuda"], reason="this build has no CUDA")
def test_lines_are_refused_beside_arrays_on_a_device():
    class OnDevice:
        def __init__(self, array):
            self.shape, self.ndim, self.dtype = array.shape, array.ndim, array.dtype

        def __dlpack_device__(self):
            return (2, 0)

        def __dlpack__(self, **options):
            return None

    points, triangles = grid(3, 3)
    for name in ("lines", "line_tags", "links"):
        with pytest.raises(ValueError, match=f"^{name}: are for arrays in memory of the host"):
            trismooth.smooth(OnDevice(points), OnDevice(triangles), slide="straight", **{name: triangles[:, :2]})
        with pytest.raises(ValueError, match=f"^{name}: are for arrays in memory of the host"):
            trismooth.Plan(OnDevice(triangles), len(points), **{name: triangles[:, :2]})


needs_files = pytest.mark.skipif(not trismooth.build_info()["files"], reason="this build has no files")


@pytest.fixture
def msh(tmp_path):
    """A file of Gmsh with two surfaces, curves with numbers of their own, and left and right sides that are periodic.
    With the arrays of the same mesh."""
    points, triangles, regions, x, y = uneven_grid()
    left, right = np.flatnonzero(x == 0), np.flatnonzero(x == COLUMNS)
    points[right, 1] = points[left, 1]
    runs = [np.flatnonzero(mask) for mask in (x == 0, x == COLUMNS, y == 0, y == ROWS, x == 6)]
    lines = [np.column_stack([run[:-1], run[1:]]) for run in runs]
    tags = np.repeat([11, 12, 13, 14, 15], [len(of_run) for of_run in lines])
    tags[np.flatnonzero(tags == 13)[5:]] = 16  # the lower side in two parts
    lines = np.concatenate(lines)
    cells = [f"1 2 {tag} {tag} {a + 1} {b + 1}" for tag, (a, b) in zip(tags, lines.tolist())]
    cells += [f"2 2 {r + 1} {r + 1} {a + 1} {b + 1} {c + 1}" for r, (a, b, c) in zip(regions, triangles.tolist())]
    text = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", str(len(points))]
    text += [f"{i + 1} {px!r} {py!r} 0" for i, (px, py) in enumerate(points.tolist())]
    text += ["$EndNodes", "$Elements", str(len(cells)), *(f"{i + 1} {cell}" for i, cell in enumerate(cells)), "$EndElements"]
    text += ["$Periodic", "1", "1 12 11", str(len(left)), *(f"{b + 1} {a + 1}" for a, b in zip(left, right)), "$EndPeriodic"]
    path = tmp_path / "in.msh"
    path.write_text("\n".join(text) + "\n")
    arrays = {"regions": regions, "lines": lines, "line_tags": tags, "links": np.column_stack([left, right])}
    return path, points, triangles, arrays


@needs_files
@pytest.mark.parametrize("options", [{"slide": "straight"}, {"slide": "curves", "deviation": 0.1, "method": "smart"}, {"slide": "off"}], ids=str)
def test_lines_tags_and_links_give_the_bits_of_the_program(msh, options, tmp_path):
    path, points, triangles, arrays = msh
    result = trismooth.smooth(points, triangles, **arrays, **options)
    three = np.column_stack([result.points, np.zeros(len(points))])
    assert hash_of(three) == program_hash(path, options, tmp_path)
    assert result.sliding is None or result.sliding.slid > 0
    mesh = trismooth.read(path)
    of_file = mesh.smooth(**options)
    np.testing.assert_array_equal(mesh.points, three)
    assert repr(of_file.sliding) == repr(result.sliding)


ROUND = [
    {"deviation": 0.05},
    {"deviation": 0.05, "method": "smart", "precision": "single"},
    {"deviation": 0.05, "method": "weighted", "form": "a", "threads": 1},
    {"deviation": 0.05, "method": "laplacian", "guard": False, "slide_coincident": True},
    {"deviation": 0.05, "curve": "spline"},
    {"deviation": 0.05, "corner_angle": 7.0},
]


@needs_files
@pytest.mark.parametrize("options", ROUND, ids=str)
def test_round_bends_have_the_bits_of_the_program(options, tmp_path):
    points, triangles = disc()
    path = off_file(tmp_path / "disc.off", points, triangles)
    result = trismooth.smooth(points, triangles, slide="curves", **options)
    assert result.sliding.slid > 0
    three = np.column_stack([result.points, np.zeros(len(points))])
    assert hash_of(three) == program_hash(path, {"slide": "curves", **options}, tmp_path)


@needs_files
def test_a_file_tells_of_sliding_and_areas(msh):
    path, *_ = msh
    result = trismooth.read(path).smooth(slide="straight")
    told = result.report["smoothing"]["sliding"]
    for name in ("lines", "vertices", "slid", "largest_deviation", "relative_deviation", "in_same_place", "at_edges", "given_up"):
        assert told[name] == getattr(result.sliding, name)
    assert [a["after"] for a in result.report["areas"]] == pytest.approx([a["before"] for a in result.report["areas"]], rel=1e-12)
    assert result.report["options"]["slide"] == "straight"
    assert trismooth.read(path).smooth().sliding is None


@needs_files
def test_what_a_file_cannot_slide_is_said(msh):
    path, *_ = msh
    mesh = trismooth.read(path)
    before = mesh.points
    with pytest.raises(ValueError, match="^slide: .*geographic"):
        mesh.smooth(slide="curves", geographic=True)
    with pytest.raises(ValueError, match="^deviation: "):
        mesh.smooth(slide="curves", deviation=3)
    with pytest.raises(TypeError, match="'lines' is no option"):
        mesh.smooth(slide="curves", lines=[[0, 1]])
    np.testing.assert_array_equal(mesh.points, before)


@pytest.mark.parametrize(
    "option", [{"deviation": 0.1}, {"curve": "spline"}, {"corner_angle": 20}, {"slide_coincident": True}], ids=str
)
def test_options_of_sliding_without_it_are_refused(option):
    points, triangles = grid(4, 3)
    (name,) = option
    calls = [
        lambda: trismooth.smooth(points, triangles, **option),
        lambda: trismooth.Plan(triangles, len(points), **option),
    ]
    for call in calls:
        with pytest.raises(ValueError, match=f"^{name}: .*slide='curves'"):
            call()
    trismooth.smooth(points, triangles, deviation=None, curve="polyline", corner_angle=None, slide_coincident=False)


def test_options_of_curves_without_curves_are_said():
    points, triangles = grid(4, 3)
    with pytest.warns(trismooth.MeshWarning):
        result = trismooth.smooth(points, triangles, slide="straight", deviation=0.1, curve="spline")
    assert result.notes == ["slide='straight' takes no notice of deviation, curve; slide='curves' does"]
