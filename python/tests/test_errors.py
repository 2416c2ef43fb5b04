# SPDX-License-Identifier: BSD-3-Clause
"""Bad input: an exception that names the argument, and nothing changed."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

import trismooth
from conftest import grid

POINTS, TRIANGLES = grid(4, 3)


def with_value(array, place, value):
    copy = array.copy()
    copy[place] = value
    return copy


def read_only(array):
    copy = array.copy()
    copy.flags.writeable = False
    return copy


ARRAYS = {"points": POINTS, "triangles": TRIANGLES}
CASES = [
    # what is changed, the type of the exception, the argument it names
    ({"points": POINTS[:, :1]}, ValueError, "points"),
    ({"points": POINTS.ravel()}, ValueError, "points"),
    ({"points": POINTS[None]}, ValueError, "points"),
    ({"points": np.hstack([POINTS, POINTS])}, ValueError, "points"),
    ({"points": POINTS.astype(int)}, TypeError, "points"),
    ({"points": POINTS.astype(complex)}, TypeError, "points"),
    ({"points": POINTS.astype(np.float16)}, TypeError, "points"),
    ({"points": POINTS.astype(np.longdouble)}, TypeError, "points"),
    ({"points": POINTS.astype(object)}, TypeError, "points"),
    ({"points": POINTS.astype(str)}, TypeError, "points"),
    ({"points": "mesh"}, ValueError, "points"),
    ({"points": [[0, 0], [1]]}, ValueError, "points"),
    ({"points": np.ma.masked_array(POINTS, POINTS > 1)}, ValueError, "points"),
    ({"points": with_value(POINTS, (6, 1), np.nan)}, trismooth.MeshError, "points"),
    ({"points": with_value(POINTS, (6, 0), np.inf)}, trismooth.MeshError, "points"),
    ({"points": np.column_stack([POINTS, np.arange(len(POINTS)) / 2])}, trismooth.MeshError, "points"),
    ({"triangles": TRIANGLES[:, :2]}, ValueError, "triangles"),
    ({"triangles": TRIANGLES.ravel()}, ValueError, "triangles"),
    ({"triangles": TRIANGLES.astype(float)}, TypeError, "triangles"),
    ({"triangles": TRIANGLES.astype(bool)}, TypeError, "triangles"),
    ({"triangles": TRIANGLES + 1}, trismooth.MeshError, "triangles"),
    ({"triangles": with_value(TRIANGLES, (3, 2), -1)}, trismooth.MeshError, "triangles"),
    ({"triangles": with_value(TRIANGLES.astype(np.uint64), (3, 2), 2**63)}, trismooth.MeshError, "triangles"),
    ({"triangles": with_value(TRIANGLES.astype(np.int64), (3, 2), -(2**40))}, trismooth.MeshError, "triangles"),
    ({"triangles": with_value(TRIANGLES, (3, 2), TRIANGLES[3, 1])}, trismooth.MeshError, "triangles"),
    ({"triangles": None}, TypeError, "triangles"),
    ({"points": object(), "triangles": None}, TypeError, "points"),
    ({"points": POINTS.T}, ValueError, f"points: shape (2, {len(POINTS)}); expected (N, 2) or (N, 3), a vertex a row; points.T"),
    ({"triangles": TRIANGLES.T}, ValueError, "triangles"),
    ({"triangles": [[0, 1, 5, 6, 2, 9**9]]}, trismooth.MeshError, "triangles"),
    ({"regions": [1, 2]}, ValueError, "regions"),
    ({"regions": np.zeros((len(TRIANGLES), 2), int)}, ValueError, "regions"),
    ({"regions": np.full(len(TRIANGLES), np.nan)}, ValueError, "regions"),
    ({"regions": "steel"}, ValueError, "regions"),
    ({"fixed": [len(POINTS)]}, ValueError, "fixed"),
    ({"fixed": [-1]}, ValueError, "fixed"),
    ({"fixed": np.array([2**63], np.uint64)}, ValueError, "fixed"),
    ({"fixed": [True, False]}, ValueError, "fixed"),
    ({"fixed": [0.5]}, TypeError, "fixed"),
    ({"fixed": 3}, ValueError, "fixed"),
    ({"other_cells": [99999]}, ValueError, "other_cells"),
    ({"size": [1.0]}, ValueError, "size"),
    ({"size": np.zeros(len(POINTS)), "method": "mean-ratio"}, ValueError, "size"),
    ({"size": np.full(len(POINTS), np.nan), "method": "mean-ratio"}, ValueError, "size"),
    ({"size": "h"}, ValueError, "size"),
    ({"out": read_only(POINTS)}, ValueError, "out"),
    ({"out": POINTS[:3]}, ValueError, "out"),
    ({"out": np.zeros((len(POINTS), 3))}, ValueError, "out"),
    ({"out": POINTS.astype(np.float32)}, TypeError, "out"),
    ({"out": POINTS.tolist()}, TypeError, "out"),
    ({"out": b"bytes"}, TypeError, "out"),
    ({"method": "best"}, ValueError, "method"),
    ({"method": 3}, TypeError, "method"),
    ({"form": "c"}, ValueError, "form"),
    ({"backend": "gpu"}, ValueError, "backend"),
    ({"devices": "0"}, TypeError, "devices"),
    ({"devices": 1.5}, TypeError, "devices"),
    ({"devices": [0, "1"]}, TypeError, "devices"),
    ({"devices": []}, ValueError, "devices"),
    ({"devices": [0, -1]}, ValueError, "devices"),
    ({"devices": [0], "backend": "cpu"}, ValueError, "devices"),
    ({"devices": [0, 1], "execution": "cdp"}, ValueError, "devices"),
    ({"order": "unordered"}, ValueError, "order"),
    ({"execution": "single-block", "method": "weighted"}, ValueError, "execution"),
    ({"execution": "cdp", "method": "mean-ratio", "backend": "cpu"}, ValueError, "execution"),
    ({"guard": "on"}, TypeError, "guard"),
    ({"untangle": "maybe"}, ValueError, "untangle"),
    ({"max_sweeps": -1}, ValueError, "max_sweeps"),
    ({"max_sweeps": 1.5}, TypeError, "max_sweeps"),
    ({"max_sweeps": 2**80}, ValueError, "max_sweeps"),
    ({"tolerance": -1}, ValueError, "tolerance"),
    ({"tolerance": "small"}, TypeError, "tolerance"),
    ({"time_limit": float("nan")}, ValueError, "time_limit"),
    ({"target_quality": 2}, ValueError, "target_quality"),
    ({"threads": -1}, ValueError, "threads"),
    ({"threads": 10**6}, ValueError, "threads"),
    ({"size_weight": -1}, ValueError, "size_weight"),
    ({"power": 9}, ValueError, "power"),
    ({"power": "3"}, TypeError, "power"),
    ({"target": "round"}, ValueError, "target"),
    ({"slide": "round"}, ValueError, "slide: "),
    ({"slide": True}, TypeError, "slide: "),
    ({"slide": None}, TypeError, "slide: "),
    ({"slide": "curves", "corner_angle": 181}, ValueError, "corner_angle: "),
    ({"slide": "curves", "corner_angle": -1}, ValueError, "corner_angle: "),
    ({"corner_angle": float("nan")}, ValueError, "corner_angle: "),
    ({"corner_angle": "30"}, TypeError, "corner_angle: "),
    ({"slide": "curves", "deviation": 2}, ValueError, "deviation: "),
    ({"deviation": -1e-9}, ValueError, "deviation: "),
    ({"deviation": "1e-3"}, TypeError, "deviation: "),
    ({"curve": "circle"}, ValueError, "curve: "),
    ({"curve": 1}, TypeError, "curve: "),
    ({"slide_coincident": "on"}, TypeError, "slide_coincident: "),
    ({"lines": [[0, len(POINTS)]]}, ValueError, f"lines: vertex {len(POINTS)} is not one of the {len(POINTS)} vertices"),
    ({"lines": [[0, -1]], "slide": "curves"}, ValueError, "lines: vertex -1 is"),
    ({"lines": np.array([[0, 2**63]], np.uint64)}, ValueError, "lines: vertex 9223372036854775808 is"),
    ({"lines": [0, 1]}, ValueError, "lines: shape (2,); expected (K, 2)"),
    ({"lines": [[0, 1, 2]]}, ValueError, "lines: shape (1, 3); expected (K, 2)"),
    ({"lines": np.zeros((0, 3), int)}, ValueError, "lines: shape (0, 3)"),
    ({"lines": [[0.0, 1.0]]}, TypeError, "lines: "),
    ({"lines": [[True, False]]}, TypeError, "lines: "),
    ({"lines": "boundary"}, TypeError, "lines: "),
    ({"lines": False}, TypeError, "lines: "),
    ({"lines": [[0, 1]], "line_tags": [1, 2]}, ValueError, "line_tags: shape (2,); expected (1,), one for each line"),
    ({"lines": [[0, 1]], "line_tags": [[1]]}, ValueError, "line_tags: "),
    ({"lines": [[0, 1]], "line_tags": [np.nan]}, ValueError, "line_tags: "),
    ({"line_tags": [1]}, ValueError, "line_tags: "),
    ({"links": [[0, len(POINTS)]]}, ValueError, "links: vertex "),
    ({"links": [0, 1]}, ValueError, "links: shape (2,)"),
    ({"links": [["a", "b"]], "slide": "straight"}, TypeError, "links: "),
    ({"triangles": [[0, 1, 5, 6, 2, 7]], "slide": "curves"}, ValueError, "slide: is for elements of corners alone"),
    ({"progress": 5}, TypeError, "progress"),
    ({"stream": 3}, TypeError, "stream"),
    ({"inplace": True}, TypeError, "inplace"),
    ({"smooth": 3}, TypeError, "'smooth' is no option"),
    ({"tolerance": "3"}, TypeError, "tolerance"),
    ({"\ud800": 3}, TypeError, "'\\ud800' is no option"),
    ({"threads\0x": 3}, TypeError, "'threads\\x00x' is no option"),
    ({"fixed": np.arange(len(POINTS)) % 2}, TypeError, "fixed"),
    ({"out": np.ma.masked_array(POINTS)}, ValueError, "out"),
    ({"tolerence": 3}, TypeError, "'tolerence' is no option (did you mean 'tolerance'?)"),
]


@pytest.mark.parametrize("changed,error,name", CASES)
def test_the_exception_names_the_argument(changed, error, name):
    arguments = {**ARRAYS, **changed}
    out = arguments.get("out")
    before = out.copy() if isinstance(out, np.ndarray) else None
    with pytest.raises(error) as raised:
        trismooth.smooth(arguments.pop("points"), arguments.pop("triangles"), **arguments)
    assert str(raised.value).startswith(name), raised.value
    if before is not None:
        np.testing.assert_array_equal(out, before)


@pytest.mark.parametrize("changed,error,name", [case for case in CASES if set(case[0]) <= {"points", "triangles"}])
def test_quality_and_plans_name_it_too(changed, error, name):
    arguments = {**ARRAYS, **changed}
    if arguments["triangles"] is not None and np.shape(arguments["triangles"])[1:] != (6,):
        with pytest.raises(error) as raised:
            trismooth.quality(arguments["points"], arguments["triangles"])
        assert str(raised.value).startswith(name), raised.value
        with pytest.raises(error) as raised:
            trismooth.Plan(arguments["triangles"], len(POINTS)).smooth(arguments["points"])
        assert str(raised.value).startswith(name), raised.value


@pytest.mark.parametrize("count", [-1, 1.5, "5", True, None])
def test_a_plan_needs_a_number_of_points(count):
    with pytest.raises(ValueError, match="^n_points"):
        trismooth.Plan(TRIANGLES, count)


def test_what_is_no_mesh_is_told_in_words_of_the_user(tmp_path):
    for name in ("plate.msh", tmp_path / "plate.msh"):
        with pytest.raises(TypeError, match=r"is the name of a file; trismooth\.read\(\) reads"):
            trismooth.smooth(name)
    with pytest.raises(TypeError, match=r"^points: dict is no mesh that trismooth knows"):
        trismooth.smooth({})


def test_a_plan_refuses_points_of_another_mesh():
    plan = trismooth.Plan(TRIANGLES, len(POINTS))
    with pytest.raises(ValueError, match="^points"):
        plan.smooth(POINTS[:-1])
    with pytest.raises(ValueError, match="^triangles"):
        trismooth.Plan(np.zeros((2, 6), int), len(POINTS))


def test_points_changed_while_they_are_smoothed_are_noticed():
    points = POINTS.copy()
    out = np.zeros_like(points)

    def change(_):
        points[6] += 0.01

    with pytest.raises(ValueError, match="^points: changed"):
        trismooth.smooth(points, TRIANGLES, out=out, progress=change)
    np.testing.assert_array_equal(out, 0)


def test_points_cannot_be_resized_while_they_are_smoothed():
    points = POINTS.copy()
    with pytest.raises(ValueError, match="resize"):
        trismooth.smooth(points, TRIANGLES, progress=lambda _: points.resize((3, 2)))


def test_triangles_changed_meanwhile_do_no_harm():
    triangles = TRIANGLES.copy()

    def break_them(_):
        triangles[:] = 10**6

    np.testing.assert_array_equal(
        trismooth.smooth(POINTS, triangles, progress=break_them).points, trismooth.smooth(POINTS, TRIANGLES).points
    )


def test_what_progress_raises_comes_out_and_nothing_has_changed():
    points = POINTS.copy()

    def fail(_):
        raise RuntimeError("enough")

    plan = trismooth.Plan(TRIANGLES, len(points))
    for smooth in (lambda: trismooth.smooth(points, TRIANGLES, out=points, progress=fail), lambda: plan.smooth(points, out=points, progress=fail)):
        with pytest.raises(RuntimeError, match="enough"):
            smooth()
        np.testing.assert_array_equal(points, POINTS)
    np.testing.assert_array_equal(plan.smooth(points).points, trismooth.smooth(POINTS, TRIANGLES).points)


def test_progress_that_returns_false_ends_with_a_valid_mesh():
    from conftest import grid

    points, triangles = grid(30, 30)
    seen = []
    result = trismooth.smooth(points, triangles, progress=lambda sweep: seen.append(sweep.sweep) or len(seen) < 2)
    assert result.stop_reason == "cancelled" and seen == [1, 2]
    assert result.after.inverted == 0 and result.after["shape"].min >= result.before["shape"].min


@pytest.mark.parametrize("answer", [False, np.False_, 0])
def test_what_is_false_ends_the_smoothing(answer):
    points, triangles = grid(30, 30)
    assert trismooth.smooth(points, triangles, progress=lambda _: answer).sweeps == 1


def test_a_plan_or_mesh_inside_its_own_progress_is_an_error_and_no_deadlock():
    plan = trismooth.Plan(TRIANGLES, len(POINTS))
    with pytest.raises(RuntimeError, match="the plan is at work"):
        plan.smooth(POINTS, progress=lambda _: plan.smooth(POINTS))
    np.testing.assert_array_equal(plan.smooth(POINTS).points, trismooth.smooth(POINTS, TRIANGLES).points)


def test_empty_lists_are_none_of_what_they_list():
    expected = trismooth.smooth(POINTS, TRIANGLES).points
    np.testing.assert_array_equal(trismooth.smooth(POINTS, TRIANGLES, fixed=[], other_cells=()).points, expected)
    np.testing.assert_array_equal(trismooth.smooth(POINTS, []).points, POINTS)


def test_none_and_empty_lists_are_no_lines():
    expected = trismooth.smooth(POINTS, TRIANGLES, slide="curves").points
    given = {"lines": [], "line_tags": [], "links": [], "corner_angle": None, "deviation": None}
    np.testing.assert_array_equal(trismooth.smooth(POINTS, TRIANGLES, slide="curves", **given).points, expected)
    empty = np.zeros((0, 2), np.int16)
    np.testing.assert_array_equal(trismooth.smooth(POINTS, TRIANGLES, slide="curves", lines=empty).points, expected)


def test_flags_of_numpy_are_flags():
    expected = trismooth.smooth(POINTS, TRIANGLES, guard=False, untangle=True).points
    given = trismooth.smooth(POINTS, TRIANGLES, guard=np.False_, untangle=np.True_)
    np.testing.assert_array_equal(given.points, expected)


@pytest.mark.parametrize("threads", [None, 1.5, "1", 2**40, -1])
def test_threads_of_quality_are_checked(threads):
    with pytest.raises((TypeError, ValueError), match="^threads: "):
        trismooth.quality(POINTS, TRIANGLES, threads=threads)


def test_a_view_of_points_as_out_leaves_no_input_points():
    points = POINTS.copy()
    assert trismooth.smooth(points, TRIANGLES, out=points[:]).input_points is None


def test_quality_that_was_not_asked_for_says_how_to_get_it():
    points = POINTS.copy()
    result = trismooth.smooth(points, TRIANGLES, out=points)
    with pytest.raises(trismooth.NotComputed, match="quality=True"):
        result.before
    assert not result.has_quality
    assert trismooth.smooth(POINTS, TRIANGLES, out=points, quality=True).before.triangles == len(TRIANGLES)


@pytest.mark.skipif(trismooth.build_info()["cuda"], reason="this build has CUDA")
def test_cuda_is_refused_where_the_build_has_none():
    with pytest.raises(trismooth.DeviceError, match="^backend.*trismooth-cuda13"):
        trismooth.smooth(POINTS, TRIANGLES, backend="cuda")


@pytest.mark.skipif(trismooth.build_info()["cuda"], reason="this build has CUDA")
def test_an_array_on_a_device_is_refused_where_the_build_cannot_take_it():
    class OnDevice:
        shape, ndim = POINTS.shape, 2

        def __dlpack_device__(self):
            return (2, 0)

        def __dlpack__(self, **options):
            raise AssertionError("nobody may ask for the memory")

    with pytest.raises((trismooth.DeviceError, ValueError), match="^points: .*cuda:0"):
        trismooth.smooth(OnDevice(), TRIANGLES)
    with pytest.raises(ValueError, match="^triangles: .*cuda:0"):
        trismooth.smooth(POINTS, OnDevice())


def _meshes_to_be_left(points, triangles, tmp_path):
    """Calls that change what they are given, and what this then holds, by name."""
    space = np.column_stack([points, np.zeros(len(points))])
    array = points.copy()
    yield "out", lambda: trismooth.smooth(array, triangles, out=array), lambda: array
    columns = np.asfortranarray(points)
    yield "out of other strides", lambda: trismooth.smooth(columns, triangles, out=columns), lambda: columns
    foreign = points.astype(points.dtype.newbyteorder())
    yield "out of another byte order", lambda: trismooth.smooth(foreign, triangles, out=foreign), lambda: foreign
    plan, of_plan = trismooth.Plan(triangles, len(points)), points.copy()
    yield "plan", lambda: plan.smooth(of_plan, out=of_plan), lambda: of_plan
    for name in ("pyvista", "meshio", "skfem"):
        try:
            package = __import__(name)
        except ImportError:
            continue
        if name == "pyvista":
            mesh = package.PolyData(space, np.column_stack([np.full(len(triangles), 3), triangles]).ravel())
        elif name == "meshio":
            mesh = package.Mesh(space, [("triangle", triangles)])
        else:
            mesh = package.MeshTri(points.T.copy(), triangles.T.copy())
        yield (
            name,
            lambda mesh=mesh: trismooth.smooth(mesh, inplace=True),
            lambda mesh=mesh: mesh.p if hasattr(mesh, "p") else np.array(mesh.points),
        )
    if trismooth.build_info()["files"]:
        path = tmp_path / "mesh.vtk"
        path.write_text(
            f"# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {len(space)} double\n"
            + "\n".join(" ".join(map(repr, map(float, row))) for row in space)
            + f"\nCELLS {len(triangles)} {4 * len(triangles)}\n"
            + "\n".join("3 {} {} {}".format(*row) for row in triangles)
            + f"\nCELL_TYPES {len(triangles)}\n"
            + "5\n" * len(triangles)
            + f"POINT_DATA {len(space)}\nSCALARS depth double 1\nLOOKUP_TABLE default\n"
            + "\n".join(repr(float(row[0])) for row in space)
            + f"\nCELL_DATA {len(triangles)}\nSCALARS trismooth:shape double 1\nLOOKUP_TABLE default\n"
            + "1\n" * len(triangles)
        )
        of_file = trismooth.read(path)

        def held():
            arrays = [of_file.points, *of_file.point_data.values(), *of_file.cell_data.values()]
            return np.concatenate([array.ravel() for array in arrays])

        yield "file", of_file.smooth, held


def test_warnings_that_are_errors_leave_all_as_it_was(tmp_path):
    points, triangles = grid(12, 9)
    points[5 * 13] = points[5 * 13 + 3]  # of the boundary: it stays, and triangles beside it are inverted
    seen = []
    for name, smooth, state in _meshes_to_be_left(points, triangles, tmp_path):
        seen.append(name)
        before = state().copy()
        with warnings.catch_warnings():
            warnings.simplefilter("error", trismooth.MeshWarning)
            with pytest.raises(trismooth.MeshWarning):
                smooth()
        np.testing.assert_array_equal(state(), before, err_msg=name)
        with pytest.warns(trismooth.MeshWarning):
            smooth()
        assert len(state()) != len(before) or (state() != before).any(), name
    assert {"out", "plan"} <= set(seen)
