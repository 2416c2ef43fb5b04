# SPDX-License-Identifier: BSD-3-Clause
"""Arrays on a CUDA device: they stay there, come back as what they are, and have the CPU's bits.

Skipped where the build has no CUDA, the machine no device, or a library is missing.
"""

from __future__ import annotations

import threading
import warnings

import numpy as np
import pytest

import trismooth
from conftest import grid, mixed_mesh
from trismooth._constraints import Constraints

pytestmark = pytest.mark.skipif(
    not trismooth.build_info()["cuda"] or "device 0" not in trismooth.build_info()["devices"], reason="no CUDA device"
)


class CuPy:
    def __init__(self):
        self.cupy = pytest.importorskip("cupy")
        self.type = self.cupy.ndarray

    def put(self, array):
        return self.cupy.asarray(array)

    def get(self, array):
        return array.get()

    def pointer(self, array):
        return array.data.ptr

    def free_bytes(self):
        self.cupy.get_default_memory_pool().free_all_blocks()
        return self.cupy.cuda.runtime.memGetInfo()[0]


class Torch:
    def __init__(self):
        self.torch = pytest.importorskip("torch")
        self.type = self.torch.Tensor

    def put(self, array):
        return self.torch.from_numpy(np.ascontiguousarray(array)).cuda()

    def get(self, array):
        return array.cpu().numpy()

    def pointer(self, array):
        return array.data_ptr()


class Jax:
    def __init__(self):
        self.jax = pytest.importorskip("jax")
        self.jax.config.update("jax_enable_x64", True)
        self.type = self.jax.Array

    def put(self, array):
        return self.jax.device_put(array, self.jax.devices("gpu")[0])

    def get(self, array):
        return np.asarray(array)

    def pointer(self, array):
        return array.unsafe_buffer_pointer()


@pytest.fixture(params=[CuPy, Torch, Jax], ids=["cupy", "torch", "jax"])
def library(request):
    return request.param()


@pytest.fixture(params=[Torch, CuPy], ids=["torch", "cupy"])
def writable(request):
    return request.param()


def host(points, triangles, **options):
    return trismooth.smooth(points, triangles, backend="cpu", **options).points


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
@pytest.mark.parametrize("indices", [np.int32, np.int64])
def test_arrays_come_back_as_they_went_in_with_the_bits_of_the_cpu(library, dtype, indices):
    points, triangles = grid(60, 40)
    given = library.put(points.astype(dtype))
    pointer = library.pointer(given)
    result = trismooth.smooth(given, library.put(triangles.astype(indices)))
    assert isinstance(result.points, library.type) and str(result.points.dtype).endswith(np.dtype(dtype).name)
    assert result.backend == "cuda"
    assert library.pointer(given) == pointer != library.pointer(result.points)
    np.testing.assert_array_equal(library.get(result.points), host(points.astype(dtype), triangles))
    np.testing.assert_array_equal(library.get(given), points.astype(dtype))


OPTIONS = [
    {"method": method, "form": form, "precision": precision}
    for method in trismooth.METHODS
    for form in ("a", "b")
    for precision in ("double", "single")
] + [{"guard": False}, {"untangle": True}, {"max_sweeps": 3}, {"tolerance": 1e-2}, {"target_quality": 0.3}, {"power": 1},
     {"slide": "straight"}, {"slide": "curves", "corner_angle": 120, "deviation": 0.1, "curve": "spline", "slide_coincident": True},
     {"target": "input-shape"}, {"size_weight": 0.0}, {"execution": "single-block", "layout": "soa"}, {"evaluation": "all"}]


@pytest.mark.parametrize("options", OPTIONS, ids=str)
def test_every_option_has_the_bits_of_the_cpu(writable, options):
    points, triangles = grid(50, 40, shift=0.55)
    result = trismooth.smooth(writable.put(points), writable.put(triangles), **options)
    np.testing.assert_array_equal(writable.get(result.points), host(points, triangles, **options))


def test_in_place_nothing_is_copied(writable):
    points, triangles = grid(600, 400)
    on_device, corners = writable.put(points), writable.put(triangles)
    pointer = writable.pointer(on_device)
    result = trismooth.smooth(on_device, corners, out=on_device)
    assert result.points is on_device and writable.pointer(on_device) == pointer
    assert trismooth._device.DevicePlan(corners, len(points), Constraints(), {"method": "smart", "backend": "auto"})._made.copied_bytes == 0
    np.testing.assert_array_equal(writable.get(on_device), host(points, triangles))


def test_constraints_on_the_device_hold(library):
    points, triangles = grid(60, 40)
    regions = (points[triangles].mean(axis=1)[:, 0] > 30).astype(np.int64)
    fixed = np.zeros(len(points), bool)
    fixed[::7] = True
    other = np.array([100, 101, 205])
    size = 1 + points[:, 0] / 20
    expected = host(points, triangles, regions=regions, fixed=fixed, other_cells=other, size=size)
    put = library.put
    for fixed_too in (fixed, np.flatnonzero(fixed)):
        result = trismooth.smooth(
            put(points), put(triangles), regions=put(regions), fixed=put(fixed_too), other_cells=put(other), size=put(size)
        )
        np.testing.assert_array_equal(library.get(result.points), expected)


def test_vertices_slide_along_what_the_device_knows(library):
    points, triangles = grid(60, 40)
    points[points[:, 1] == 0, 0] = 60 * (points[points[:, 1] == 0, 0] / 60) ** 1.2
    regions = (points[triangles].mean(axis=1)[:, 0] > 30).astype(np.int64)
    fixed = np.arange(70, 75)
    expected = trismooth.smooth(points, triangles, regions=regions, fixed=fixed, slide="straight", backend="cpu")
    assert expected.sliding.slid > 0
    put = library.put
    given = {"regions": put(regions), "fixed": put(fixed), "slide": "straight"}
    plan = trismooth.Plan(put(triangles), len(points), **given)
    for result in (trismooth.smooth(put(points), put(triangles), **given), plan.smooth(put(points))):
        np.testing.assert_array_equal(library.get(result.points), expected.points)
        assert repr(result.sliding) == repr(expected.sliding)
    assert trismooth.smooth(put(points), put(triangles)).sliding is None


def test_lines_named_on_the_host_slide_on_the_device_too():
    points, triangles = grid(60, 40)
    row = 20 * 61 + np.arange(61)
    points[row, 1] = 20
    links = np.column_stack([np.arange(41) * 61, np.arange(41) * 61 + 60])
    given = {"lines": np.column_stack([row[:-1], row[1:]]), "links": links, "slide": "straight"}
    result = trismooth.smooth(points, triangles, backend="cuda", **given)
    expected = trismooth.smooth(points, triangles, backend="cpu", **given)
    np.testing.assert_array_equal(result.points, expected.points)
    assert repr(result.sliding) == repr(expected.sliding)


def test_a_mesh_follows_its_boundary_on_the_device_to_the_cpus_bits():
    points, triangles = grid(60, 40, shift=0.2)
    here = trismooth.MovingMesh(points, triangles, backend="cuda")
    there = trismooth.MovingMesh(points, triangles)
    for height in (1.2, 0.7, 1.0):
        for start in ("reference", "previous"):
            now = np.where(here.held[:, None], points * [1, height], points)
            result, expected = here.follow(now, start=start), there.follow(now, start=start)
            np.testing.assert_array_equal(result.points, expected.points)
            assert result.backend == "cuda"
            assert result.min_relative_shape == expected.min_relative_shape


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_a_mesh_made_of_points_on_the_device_follows_there_to_the_cpus_bits(library, dtype):
    points, triangles = grid(60, 40, shift=0.2)
    points = points.astype(dtype)
    here = trismooth.MovingMesh(library.put(points), library.put(triangles), fixed=library.put(np.array([1000])))
    there = trismooth.MovingMesh(points, triangles, fixed=[1000])
    np.testing.assert_array_equal(here.held, there.held)
    for height in (1.2, 0.7, 1.0):
        for start in ("reference", "previous"):
            now = np.where(here.held[:, None], points * [1, height], points).astype(dtype)
            result = here.follow(library.put(now), start=start, quality=True)
            expected = there.follow(now, start=start, quality=True)
            assert isinstance(result.points, library.type) and result.backend == "cuda"
            np.testing.assert_array_equal(library.get(result.points), expected.points)
            np.testing.assert_array_equal(here.points, there.points)
            assert result.min_relative_shape == expected.min_relative_shape
            assert result.largest_move == expected.largest_move
            assert str(result.after) == str(expected.after)


def test_a_mesh_on_the_device_follows_in_place_with_heights_and_goes_on(writable):
    points, triangles = grid(60, 40, shift=0.2)
    there = trismooth.MovingMesh(points, triangles)
    here = trismooth.MovingMesh(writable.put(points), triangles)
    now = np.where(here.held[:, None], points * [1, 0.8], points)
    expected = there.follow(now).points
    wide = writable.put(np.column_stack([now, np.where(here.held, 2.5, 7), points]))
    assert here.follow(wide[:, :3], out=wide[:, :3]).inverted == 0
    np.testing.assert_array_equal(writable.get(wide)[:, :2], expected)
    np.testing.assert_array_equal(writable.get(wide)[:, 2], np.where(here.held, 2.5, 7))
    here.follow(writable.put(points))
    here.take_back()
    np.testing.assert_array_equal(here.points, expected)
    here.go_on_from(writable.put(expected))
    there.go_on_from(expected)
    given = writable.put(now)
    assert here.follow(given, start="previous", out=given).points is given
    np.testing.assert_array_equal(writable.get(given), there.follow(now, start="previous").points)


def test_a_step_on_the_device_that_is_refused_has_not_happened(writable):
    points, triangles = grid(30, 20, shift=0.2)
    put = writable.put
    mesh = trismooth.MovingMesh(put(points), put(triangles))
    folded = points.copy()
    folded[points[:, 1] == 0, 1] = 30
    given = put(folded)
    with warnings.catch_warnings():
        warnings.simplefilter("error", trismooth.MeshWarning)
        with pytest.raises(trismooth.MeshWarning):
            mesh.follow(given, out=given)
    np.testing.assert_array_equal(writable.get(given), folded)
    np.testing.assert_array_equal(mesh.points, points)
    nan = points.copy()
    nan[20, 1] = np.nan
    cases = [
        (lambda: mesh.follow(put(nan)), ValueError, "points"),
        (lambda: mesh.follow(points), ValueError, "points: are in memory of the host"),
        (lambda: trismooth.MovingMesh(points, triangles).follow(put(points)), ValueError, "points: are on cuda:0"),
        (lambda: mesh.follow(put(points[:5])), ValueError, "points: shape"),
        (lambda: mesh.follow(put(points), out=points.copy()), ValueError, "out"),
        (lambda: mesh.follow(put(points), start="now"), ValueError, "start"),
        (lambda: mesh.go_on_from(put(nan)), ValueError, "points"),
        (lambda: trismooth.MovingMesh(put(points), put(triangles), backend="cpu"), ValueError, "backend"),
        (lambda: trismooth.MovingMesh(put(points), put(triangles), devices=[0, 1]), ValueError, "devices"),
        (lambda: trismooth.MovingMesh(put(points), put(triangles), stream="x"), TypeError, "stream"),
    ]
    for call, error, name in cases:
        with pytest.raises(error) as raised:
            call()
        assert str(raised.value).startswith(name), raised.value
    np.testing.assert_array_equal(mesh.points, points)


def test_a_mesh_that_moves_works_on_the_callers_stream():
    cupy = pytest.importorskip("cupy")
    points, triangles = grid(60, 40, shift=0.2)
    expected = trismooth.MovingMesh(points, triangles).follow(points * 1.25).points
    stream = cupy.cuda.Stream(non_blocking=True)
    mesh = trismooth.MovingMesh(cupy.asarray(points), triangles, stream=stream)
    with stream:
        on_device = cupy.asarray(points)
        for _ in range(200):  # keeps the stream busy: whoever does not wait for it sees other points
            on_device = on_device * 2 / 2
        on_device = on_device * 1.25
        moved = mesh.follow(on_device).points + 0
    np.testing.assert_array_equal(moved.get(), expected)


def test_any_strides_and_heights(writable):
    points, triangles = grid(60, 40)
    expected = host(points, triangles)
    wide = writable.put(np.column_stack([points, np.full(len(points), 2.5), points]))
    backwards = writable.put(np.hstack([triangles[:, ::-1], triangles]))
    for given in (wide[:, :2], wide[:, :3], wide[:, 3:5]):
        result = trismooth.smooth(given, writable.put(triangles))
        assert tuple(result.points.shape) == tuple(given.shape)
        np.testing.assert_array_equal(writable.get(result.points)[:, :2], expected)
        if given.shape[1] == 3:
            np.testing.assert_array_equal(writable.get(result.points)[:, 2], 2.5)
    np.testing.assert_array_equal(
        writable.get(trismooth.smooth(wide[:, :2], backwards[:, :3]).points), host(points, triangles[:, ::-1])
    )
    trismooth.smooth(wide[:, :3], writable.put(triangles), out=wide[:, :3])  # in place in a wider array
    np.testing.assert_array_equal(writable.get(wide)[:, :2], expected)
    np.testing.assert_array_equal(writable.get(wide)[:, 3:], points)


@pytest.mark.parametrize("code", "bhilqBHILQ")
def test_indices_of_any_integer_type(code):
    cupy = pytest.importorskip("cupy")
    points, triangles = grid(8, 6)
    result = trismooth.smooth(cupy.asarray(points), cupy.asarray(triangles.astype(code)))
    np.testing.assert_array_equal(result.points.get(), host(points, triangles))


@pytest.mark.parametrize("value", [-1, 2**31, 2**32 + 1, -(2**40)])
def test_indices_without_a_place_in_32_bits_are_no_vertices(writable, value):
    points, triangles = grid(8, 6)
    wrong = triangles.astype(np.int64)
    wrong[3, 1] = value
    with pytest.raises(trismooth.MeshError, match="^triangles: triangle 3"):
        trismooth.smooth(writable.put(points), writable.put(wrong))


def test_bad_input_names_the_argument_and_leaves_the_arrays(writable):
    points, triangles = grid(8, 6)
    put = writable.put
    p, t = put(points), put(triangles)
    nan = points.copy()
    nan[20, 1] = np.nan
    high = np.column_stack([points, points[:, 0]])
    cases = [
        (lambda: trismooth.smooth(put(nan), t), ValueError, "points"),
        (lambda: trismooth.smooth(put(high), t), ValueError, "points"),
        (lambda: trismooth.smooth(put(points[:, :1]), t), ValueError, "points"),
        (lambda: trismooth.smooth(put(points.astype(np.int32)), t), TypeError, "points"),
        (lambda: trismooth.smooth(p, put(points)), TypeError, "triangles"),
        (lambda: trismooth.smooth(p, put(triangles[:, :2])), ValueError, "triangles"),
        (lambda: trismooth.smooth(p, triangles), ValueError, "triangles"),
        (lambda: trismooth.smooth(points, t), ValueError, "triangles"),
        (lambda: trismooth.smooth(p, t, regions=triangles[:, 0]), ValueError, "regions"),
        (lambda: trismooth.smooth(p, t, regions=put(triangles[:5, 0])), ValueError, "regions"),
        (lambda: trismooth.smooth(p, t, fixed=[3]), ValueError, "fixed"),
        (lambda: trismooth.smooth(p, t, fixed=put(np.array([3, 999]))), ValueError, "fixed"),
        (lambda: trismooth.smooth(p, t, size=put(-points[:, 0]), method="mean-ratio"), ValueError, "size"),
        (lambda: trismooth.smooth(p, t, out=points.copy()), ValueError, "out"),
        (lambda: trismooth.smooth(p, t, out=put(points[:5])), ValueError, "out"),
        (lambda: trismooth.smooth(p, t, out=put(points.astype(np.float32))), TypeError, "out"),
        (lambda: trismooth.smooth(p, t, backend="cpu"), ValueError, "backend"),
        (lambda: trismooth.smooth(p, t, stream="x"), TypeError, "stream"),
        (lambda: trismooth.smooth(p, t, slide="straight", lines=put(np.array([[0, 1]]))), ValueError, "lines"),
        (lambda: trismooth.smooth(p, t, lines=[[0, 1]]), ValueError, "lines"),
        (lambda: trismooth.smooth(p, t, slide="straight", links=put(np.array([[0, 1]]))), ValueError, "links"),
        (lambda: trismooth.smooth(p, t, slide="straight", line_tags=[1]), ValueError, "line_tags"),
        (lambda: trismooth.smooth(p, t, slide="straight", deviation=5), ValueError, "deviation"),
        (lambda: trismooth.smooth(p, t, slide="straight", execution="cdp"), ValueError, "execution"),
        (lambda: trismooth.smooth(p, t, slide="straight", target_quality=0.5), ValueError, "target_quality"),
        (lambda: trismooth.Plan(t, len(points)).smooth(points), ValueError, "points"),
        (lambda: trismooth.Plan(triangles, len(points)).smooth(p), ValueError, "points"),
    ]
    for call, error, name in cases:
        with pytest.raises(error) as raised:
            call()
        assert str(raised.value).startswith(name), raised.value
    np.testing.assert_array_equal(writable.get(p), points)


def test_jax_arrays_are_never_written():
    jax = Jax()
    points, triangles = grid(8, 6)
    p = jax.put(points)
    with pytest.raises(ValueError, match="^out: arrays of JAX"):
        trismooth.smooth(p, jax.put(triangles), out=p)


def test_work_is_on_the_callers_stream():
    cupy = pytest.importorskip("cupy")
    points, triangles = grid(60, 40)
    expected = host(points * 2, triangles)
    stream = cupy.cuda.Stream(non_blocking=True)
    with stream:
        on_device = cupy.asarray(points)
        for _ in range(200):  # keeps the stream busy: whoever does not wait for it sees other points
            on_device = on_device * 2 / 2
        on_device = on_device * 2
        result = trismooth.smooth(on_device, cupy.asarray(triangles))
        doubled = result.points + 0
    np.testing.assert_array_equal(doubled.get(), expected)
    by_number = trismooth.smooth(on_device, cupy.asarray(triangles), stream=stream.ptr)
    np.testing.assert_array_equal(by_number.points.get(), expected)


def test_the_current_stream_of_torch_is_taken():
    torch = pytest.importorskip("torch")
    points, triangles = grid(60, 40)
    stream = torch.cuda.Stream()
    with torch.cuda.stream(stream):
        on_device = torch.from_numpy(points).cuda()
        torch.cuda._sleep(50_000_000)
        on_device = on_device * 2
        result = trismooth.smooth(on_device, torch.from_numpy(triangles).cuda())
    stream.synchronize()
    np.testing.assert_array_equal(result.points.cpu().numpy(), host(points * 2, triangles))


def test_plans_follow_moving_points(library):
    points, triangles = grid(60, 40)
    plan = trismooth.Plan(library.put(triangles), len(points), method="smart")
    for step in range(4):
        moved = points + 0.1 * step * points[:, ::-1] / 40
        result = plan.smooth(library.put(moved), quality=True)
        np.testing.assert_array_equal(library.get(result.points), host(moved, triangles, method="smart"))
        assert result.after["shape"].min >= result.before["shape"].min


def test_quality_of_arrays_on_the_device(library):
    points, triangles = grid(30, 20)
    quality = trismooth.quality(library.put(points), library.put(triangles))
    np.testing.assert_array_equal(quality.shape, trismooth.quality(points, triangles).shape)


def test_threads_with_plans_of_their_own(writable):
    points, triangles = grid(60, 40)
    expected = host(points, triangles)
    errors = []

    def work():
        try:
            plan = trismooth.Plan(writable.put(triangles), len(points))
            for _ in range(10):
                np.testing.assert_array_equal(writable.get(plan.smooth(writable.put(points)).points), expected)
        except BaseException as error:  # noqa: BLE001
            errors.append(error)

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(120)
        assert not thread.is_alive()
    assert not errors, errors[0]


def test_progress_stops_and_exceptions_come_out(writable):
    points, triangles = grid(60, 40)
    p, t = writable.put(points), writable.put(triangles)
    seen = []
    result = trismooth.smooth(p, t, progress=lambda sweep: seen.append(sweep.sweep) or len(seen) < 2)
    assert result.stop_reason == "cancelled" and seen == [1, 2]

    def fail(_):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        trismooth.smooth(p, t, out=p, progress=fail)
    np.testing.assert_array_equal(writable.get(p), points)


def test_host_arrays_on_the_cuda_backend_have_the_same_bits():
    points, triangles = grid(60, 40)
    result = trismooth.smooth(points, triangles, backend="cuda")
    assert result.backend == "cuda"
    np.testing.assert_array_equal(result.points, host(points, triangles))


@pytest.mark.parametrize("method", ["smart", "mean-ratio"])
def test_quadrilaterals_of_host_arrays_have_the_same_bits_on_the_cuda_backend(method):
    points, elements = mixed_mesh()
    result = trismooth.smooth(points, elements, backend="cuda", method=method)
    assert result.backend == "cuda"
    np.testing.assert_array_equal(result.points, trismooth.smooth(points, elements, backend="cpu", method=method).points)
    shared = trismooth.smooth(points, elements, devices=[0, 0], method=method)
    assert shared.backend == "cuda"
    np.testing.assert_array_equal(shared.points, result.points)


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
@pytest.mark.parametrize("indices", [np.int32, np.int64])
def test_quadrilaterals_on_the_device_come_back_as_they_went_in_with_the_bits_of_the_cpu(library, dtype, indices):
    points, elements = mixed_mesh(40, 30, jitter=0.35)
    points = points.astype(dtype)
    given = library.put(points)
    result = trismooth.smooth(given, library.put(elements.astype(indices)))
    assert isinstance(result.points, library.type) and str(result.points.dtype).endswith(np.dtype(dtype).name)
    assert result.backend == "cuda"
    assert result.note == "the host found the neighbours: of a mesh with quadrilaterals no device does"
    np.testing.assert_array_equal(library.get(result.points), host(points, elements))
    np.testing.assert_array_equal(library.get(given), points)


@pytest.mark.parametrize("options", [options for options in OPTIONS if "execution" not in options], ids=str)
def test_every_option_has_the_bits_of_the_cpu_with_quadrilaterals(writable, options):
    points, elements = mixed_mesh(30, 25, jitter=0.4)
    given = writable.put(points)
    result = trismooth.smooth(given, writable.put(elements), out=given, **options)
    expected = trismooth.smooth(points, elements, backend="cpu", **options)
    np.testing.assert_array_equal(writable.get(given), expected.points)
    assert (result.moved, result.inverted, result.degenerate) == (expected.moved, expected.inverted, expected.degenerate)


def test_constraints_on_the_device_hold_quadrilaterals(library):
    points, elements = mixed_mesh(30, 25, jitter=0.3)
    regions = (elements[:, 0] % 5 == 0).astype(np.int64)
    fixed = np.zeros(len(points), bool)
    fixed[::7] = True
    size = 1 + points[:, 0] / 20
    held = dict(regions=regions, fixed=fixed, other_cells=np.array([100, 101, 205]), size=size)
    result = trismooth.smooth(
        library.put(points),
        library.put(elements),
        method="mean-ratio",
        **{name: library.put(array) for name, array in held.items()},
    )
    np.testing.assert_array_equal(library.get(result.points), host(points, elements, method="mean-ratio", **held))


def test_plans_of_quadrilaterals_follow_moving_points(library):
    points, elements = mixed_mesh(30, 25, jitter=0.3)
    plan = trismooth.Plan(library.put(elements), len(points))
    assert repr(plan) == f"<trismooth.Plan: {len(points)} vertices, {len(elements)} elements>"
    for factor in (1, 0.5, -1, 2):
        moved = points * [factor, 1]
        result = plan.smooth(library.put(moved), quality=True)
        expected = trismooth.smooth(moved, elements, backend="cpu")
        np.testing.assert_array_equal(library.get(result.points), expected.points)
        assert str(result.after) == str(expected.after)
    np.testing.assert_array_equal(
        trismooth.quality(library.put(points), library.put(elements)).shape, trismooth.quality(points, elements).shape
    )


def test_quadrilaterals_of_any_strides_and_integer_types():
    cupy = pytest.importorskip("cupy")
    points, elements = mixed_mesh(10, 9)  # of numbers that 8 bits have
    expected = host(points, elements)
    put = cupy.asarray
    backwards = put(np.hstack([elements[:, ::-1], elements]))
    for given in (backwards[:, 4:], *(put(elements.astype(code)) for code in "bhilqILQ")):
        np.testing.assert_array_equal(trismooth.smooth(put(points), given).points.get(), expected)
    for code in "BH":
        with pytest.raises(TypeError, match="^triangles: unsigned integers of 8 or 16 bits have no -1"):
            trismooth.smooth(put(points), put(elements.astype(code)))


def test_triangles_with_four_numbers_are_what_they_are_with_three(library):
    points, triangles = grid(60, 40)
    four = np.pad(triangles, ((0, 0), (0, 1)), constant_values=-1)
    for options in ({}, {"execution": "single-block"}):
        result = trismooth.smooth(library.put(points), library.put(four), **options)
        assert result.backend == "cuda" and not result.note
        np.testing.assert_array_equal(library.get(result.points), host(points, triangles))


def test_elements_on_the_device_that_are_no_mesh_are_refused_as_on_the_host(writable):
    points, elements = mixed_mesh()
    put = writable.put
    p = put(points)
    place = int(np.argmax(elements[:, 3] >= 0))

    def with_number(corner, number):
        wrong = elements.copy()
        wrong[place, corner] = number
        return wrong

    for wrong in (with_number(1, -1), with_number(1, len(points)), with_number(3, -2), with_number(1, elements[place, 3])):
        with pytest.raises(trismooth.MeshError) as here:
            trismooth.smooth(p, put(wrong))
        with pytest.raises(trismooth.MeshError) as there:
            trismooth.smooth(points, wrong)
        assert str(here.value) == str(there.value)
    with pytest.raises(ValueError, match="execution 'single-block' smooths triangles alone"):
        trismooth.smooth(p, put(elements), execution="single-block")
    with pytest.raises(ValueError, match=r"^triangles: shape \(\d+, 6\); expected \(M, 3\), or \(M, 4\) with"):
        trismooth.smooth(p, put(np.hstack([elements, elements[:, :2]])))
    with pytest.raises(ValueError, match="quadrilaterals in memory of the host"):
        trismooth.MovingMesh(p, put(elements))
    np.testing.assert_array_equal(writable.get(p), points)


@pytest.mark.parametrize("devices", [0, [0], [0, 0], (0, 0, 0)])
def test_devices_that_share_a_mesh_have_the_same_bits(devices):
    points, triangles = grid(60, 40)
    for _ in range(2):
        result = trismooth.smooth(points, triangles, devices=devices)
        assert result.backend == "cuda"
        np.testing.assert_array_equal(result.points, host(points, triangles))


def test_devices_that_are_not_there_are_an_error():
    points, triangles = grid(6, 4)
    with pytest.raises(trismooth.DeviceError, match="no device 1000"):
        trismooth.smooth(points, triangles, devices=[0, 1000])


def test_memory_of_the_device_is_given_back():
    cupy = pytest.importorskip("cupy")
    points, triangles = grid(300, 200)
    p, t = cupy.asarray(points), cupy.asarray(triangles)
    used = []
    for _ in range(6):
        trismooth.smooth(p, t)
        cupy.get_default_memory_pool().free_all_blocks()
        used.append(cupy.cuda.runtime.memGetInfo()[0])
    assert used[-1] >= used[2] - (1 << 20)


@pytest.mark.skipif(not trismooth.build_info()["cuda"], reason="no CUDA")
def test_arrays_on_two_devices_are_refused():
    cupy = pytest.importorskip("cupy")
    if cupy.cuda.runtime.getDeviceCount() < 2:
        pytest.skip("one device")
    points, triangles = grid(8, 6)
    p = cupy.asarray(points)
    with cupy.cuda.Device(1):
        t = cupy.asarray(triangles)
    with pytest.raises(ValueError, match="^triangles: .*cuda:1"):
        trismooth.smooth(p, t)
