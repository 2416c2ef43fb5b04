# SPDX-License-Identifier: BSD-3-Clause
"""What arrays go in, and what comes back."""

from __future__ import annotations

import array

import numpy as np
import pytest

import trismooth


def expected(points, triangles, **options):
    """The result for plain arrays, which all other arrays of the same numbers must give to the bit."""
    return trismooth.smooth(np.array(points, order="C"), np.array(triangles, np.int32, order="C"), **options).points


LAYOUTS = {
    "columns first": np.asfortranarray,
    "every second row": lambda a: np.repeat(a, 2, axis=0)[::2],
    "backwards": lambda a: a[::-1].copy()[::-1],
    "columns of a wider array": lambda a: np.hstack([a, a + 7])[:, : a.shape[1]],
    "transposed": lambda a: a.T.copy().T,
    "not aligned": lambda a: np.frombuffer(b"x" + a.tobytes(), a.dtype, offset=1).reshape(a.shape),
    "field of a record": lambda a: np.array([(0, row) for row in a], [("tag", "i1"), ("at", a.dtype, a.shape[1])])["at"],
    "the other byte order": lambda a: a.astype(a.dtype.newbyteorder()),
}


@pytest.mark.parametrize("layout", LAYOUTS.values(), ids=LAYOUTS.keys())
@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_points_of_any_layout_give_the_same_bits_in_their_own_type(mesh, layout, dtype):
    points, triangles = mesh
    given = layout(points.astype(dtype))
    before = given.copy()
    result = trismooth.smooth(given, triangles)
    assert result.points.dtype == given.dtype and result.points.shape == given.shape
    np.testing.assert_array_equal(result.points, expected(points.astype(dtype), triangles))
    np.testing.assert_array_equal(given, before)
    assert not np.array_equal(result.points, before)


@pytest.mark.parametrize("layout", LAYOUTS.values(), ids=LAYOUTS.keys())
@pytest.mark.parametrize("dtype", [np.int32, np.int64])
def test_triangles_of_any_layout_give_the_same_bits(mesh, layout, dtype):
    points, triangles = mesh
    given = layout(triangles.astype(dtype))
    np.testing.assert_array_equal(trismooth.smooth(points, given).points, expected(points, triangles))


@pytest.mark.parametrize("code", "bhilqBHILQ")
def test_triangles_of_any_integer_type_give_the_same_bits(code):
    from conftest import grid

    points, triangles = grid(8, 6)  # of less than 128 vertices
    np.testing.assert_array_equal(
        trismooth.smooth(points, triangles.astype(code)).points, expected(points, triangles)
    )


def test_lists_go_in_and_numpy_arrays_come_back(mesh):
    points, triangles = mesh
    result = trismooth.smooth(points.tolist(), triangles.tolist())
    assert type(result.points) is np.ndarray
    np.testing.assert_array_equal(result.points, expected(points, triangles))


def test_memory_of_other_owners_is_taken(mesh):
    points, triangles = mesh
    flat = array.array("d", points.ravel())
    view = memoryview(flat).cast("B").cast("d", points.shape)
    np.testing.assert_array_equal(trismooth.smooth(view, triangles).points, expected(points, triangles))
    trismooth.smooth(view, triangles, out=view)
    np.testing.assert_array_equal(np.asarray(view), expected(points, triangles))


def test_out_may_be_points_and_is_the_array_that_comes_back(mesh):
    points, triangles = mesh
    in_place = points.copy()
    result = trismooth.smooth(in_place, triangles, out=in_place)
    assert result.points is in_place and result.input_points is None
    np.testing.assert_array_equal(in_place, expected(points, triangles))


@pytest.mark.parametrize("layout", ["columns first", "every second row", "the other byte order", "not aligned"])
def test_out_of_any_layout_is_written(mesh, layout):
    points, triangles = mesh
    out = LAYOUTS[layout](np.zeros_like(points))
    if not out.flags.writeable:
        out = np.frombuffer(bytearray(b"x" + out.tobytes()), out.dtype, offset=1).reshape(out.shape)
    result = trismooth.smooth(points.astype(out.dtype), triangles, out=out)
    assert result.points is out
    np.testing.assert_array_equal(out, expected(points, triangles))


def test_out_may_overlap_points(mesh):
    points, triangles = mesh
    memory = np.zeros((len(points) + 1, 2))
    memory[1:] = points
    trismooth.smooth(memory[1:], triangles, out=memory[:-1])
    np.testing.assert_array_equal(memory[:-1], expected(points, triangles))


def test_heights_come_back_as_they_were(mesh):
    points, triangles = mesh
    in_space = np.column_stack([points, np.full(len(points), 3.5)])
    result = trismooth.smooth(in_space, triangles)
    assert result.points.shape == in_space.shape
    np.testing.assert_array_equal(result.points[:, 2], 3.5)
    np.testing.assert_array_equal(result.points[:, :2], expected(points, triangles))


def test_jax_arrays_come_back_as_such(mesh):
    jax = pytest.importorskip("jax")
    jax.config.update("jax_enable_x64", True)
    points, triangles = mesh
    on_host = jax.devices("cpu")[0]
    result = trismooth.smooth(jax.device_put(points, on_host), jax.device_put(triangles, on_host))
    assert isinstance(result.points, jax.Array)
    np.testing.assert_array_equal(np.asarray(result.points), expected(points, triangles))
    with pytest.raises(ValueError, match="^out: "):
        trismooth.smooth(points, triangles, out=jax.device_put(points, on_host))


def test_torch_tensors_come_back_as_such(mesh):
    torch = pytest.importorskip("torch")
    points, triangles = mesh
    given = torch.from_numpy(points.copy()).requires_grad_()
    result = trismooth.smooth(given, torch.from_numpy(triangles))
    assert isinstance(result.points, torch.Tensor) and not result.points.requires_grad
    np.testing.assert_array_equal(result.points.numpy(), expected(points, triangles))
    out = torch.zeros_like(given)
    assert trismooth.smooth(given, torch.from_numpy(triangles), out=out).points is out
    np.testing.assert_array_equal(out.numpy(), expected(points, triangles))


class Exporter:
    """An array of an unknown library: DLPack and nothing else."""

    def __init__(self, numbers):
        self.numbers = numbers

    def __dlpack__(self, **options):
        return self.numbers.__dlpack__(**options)

    def __dlpack_device__(self):
        return self.numbers.__dlpack_device__()


def test_dlpack_alone_will_do(mesh):
    points, triangles = mesh
    result = trismooth.smooth(Exporter(points), Exporter(triangles))
    np.testing.assert_array_equal(result.points, expected(points, triangles))
    out = np.zeros_like(points)
    if not np.from_dlpack(out).flags.writeable:  # NumPy before 2.1 never writes through DLPack
        with pytest.raises(ValueError, match="^out: .*read-only"):
            trismooth.smooth(Exporter(points), Exporter(triangles), out=Exporter(out))
        return
    trismooth.smooth(Exporter(points), Exporter(triangles), out=Exporter(out))
    np.testing.assert_array_equal(out, expected(points, triangles))


def test_meshes_without_triangles_or_points_are_no_error():
    none = np.zeros((0, 3), int)
    assert trismooth.smooth(np.zeros((0, 2)), none).moved == 0
    points = np.random.default_rng(1).random((5, 2))
    np.testing.assert_array_equal(trismooth.smooth(points, none).points, points)


def test_quadratic_triangles_are_smoothed_with_their_middles(mesh):
    points, corners = mesh
    sides = {}
    middles = [
        [sides.setdefault(tuple(sorted((t[i], t[(i + 1) % 3]))), len(points) + len(sides)) for i in range(3)] for t in corners
    ]
    ends = np.array(list(sides))
    all_points = np.vstack([points, points[ends].mean(axis=1)])
    result = trismooth.smooth(all_points, np.hstack([corners, middles]))
    assert result.moved > 0
    moved_middles = result.points[len(points) :]
    np.testing.assert_allclose(moved_middles, result.points[ends].mean(axis=1), atol=1e-12)  # straight sides stay so
    np.testing.assert_array_equal(result.points[: len(points)], expected(points, corners))
