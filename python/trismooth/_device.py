# SPDX-License-Identifier: BSD-3-Clause
"""Arrays in memory of a CUDA device: CuPy, PyTorch, JAX and whatever has DLPack. They stay there."""

from __future__ import annotations

import sys
from typing import Any, Callable, Dict, List, Optional, Tuple

import numpy as np

from . import _arrays, _core
from ._constraints import Constraints
from ._notes import warn_of
from ._plan import OnHost
from ._result import Result

#: DLPack's number of the default stream.
_DEFAULT_STREAM = 1


def _require_cuda(argument: str, array: Any) -> None:
    if not _core.has_cuda:
        raise _core.DeviceError(
            f"{argument}: is on cuda:{_arrays.device_of(array)}, and this build of trismooth has no CUDA; the package "
            "trismooth-cuda13 has"
        )


def _stream(array: Any, stream: Any) -> Any:
    """The stream that the caller names, else the current one of the array's library."""
    if stream is not None:
        return stream
    library = _arrays.library_of(array)
    if library == "cupy":
        return sys.modules["cupy"].cuda.get_current_stream()
    if library == "torch":
        return sys.modules["torch"].cuda.current_stream(array.device)
    return _DEFAULT_STREAM


def _number_of(stream: Any) -> int:
    for name in ("ptr", "cuda_stream", "handle"):  # of CuPy, PyTorch and cuda.core
        if hasattr(stream, name):
            return int(getattr(stream, name)) or _DEFAULT_STREAM
    if hasattr(stream, "__index__"):
        return int(stream) or _DEFAULT_STREAM
    raise TypeError(f"stream: a CUDA stream or its number is needed, not {type(stream).__name__}")


def _capsule(array: Any, argument: str, stream: int) -> Any:
    """The array by DLPack, ready on that stream."""
    if array is None:
        return None
    if _arrays.device_of(array) is None:
        raise ValueError(f"{argument}: is in memory of the host, and points are on a CUDA device")
    if _arrays.library_of(array) == "torch":
        array = array.detach()
    return array.__dlpack__(stream=stream)


def _require_writable(out: Any) -> None:
    if _arrays.library_of(out) in ("jax", "jaxlib"):
        raise ValueError("out: arrays of JAX cannot be written")


def _new_like(points: Any) -> Any:
    """An array for the result, with the library's own memory where it is known how, and what DLPack it goes by."""
    library = _arrays.library_of(points)
    if library == "cupy":
        return sys.modules["cupy"].empty(points.shape, points.dtype)
    if library == "torch":
        torch = sys.modules["torch"]
        return torch.empty(points.shape, dtype=points.dtype, device=points.device)
    is_float32 = np.dtype(str(points.dtype)) == np.float32
    return _core.new_device_array(points.shape[0], points.shape[1], is_float32, _arrays.device_of(points) or 0)


def _as_given(points: Any, result: Any) -> Any:
    """A result of _new_like() as an array of the library that `points` are of."""
    library = _arrays.library_of(points)
    if library in ("cupy", "torch"):
        return result
    if library == "jax":
        return sys.modules["jax"].dlpack.from_dlpack(result)
    return points.__array_namespace__().from_dlpack(result)


def to_host(array: Any) -> np.ndarray:
    """A copy in memory of the host."""
    library = _arrays.library_of(array)
    if library == "cupy":
        array = array.get()
    elif library == "torch":
        array = array.detach().cpu().numpy()
    return np.asarray(array)


def _host_sizes(size: Any) -> Optional[np.ndarray]:
    """The library reads sizes on the host."""
    if size is None:
        return None
    return _arrays.on_host(to_host(size) if _arrays.device_of(size) is not None else size, "size", float)


def _on_device(constraints: Constraints, stream: int) -> Dict[str, Any]:
    """The arrays that are given, by name, as the compiled part takes them."""
    for name in ("lines", "line_tags", "links"):
        if getattr(constraints, name) is not None:
            raise ValueError(f"{name}: are for arrays in memory of the host, and points are on a CUDA device")
    return {
        "regions": _capsule(constraints.regions, "regions", stream),
        "fixed": _capsule(constraints.fixed, "fixed", stream),
        "other_cells": _capsule(constraints.other_cells, "other_cells", stream),
        "size": _host_sizes(constraints.size),
    }


def _on_host(array: Any) -> Any:
    """What is on a device, as the host has it."""
    return array if array is None or _arrays.device_of(array) is None else to_host(array)


class _OnDevice:
    """What smooths or moves points on a device. ``_made`` is the compiled part's."""

    def __init__(self, triangles: Any, options: Dict[str, Any], array: Any, argument: str) -> None:
        _require_cuda(argument, array)
        if options["backend"] == "cpu":
            raise ValueError(f"backend: 'cpu' is for arrays in memory of the host, and {argument} are on a CUDA device")
        if options.get("devices") is not None:
            raise ValueError("devices: are for arrays in memory of the host; arrays on a CUDA device are smoothed there")
        self._options = dict(options, backend="cuda")
        # What is made keeps it: work is queued on it to the very end, where this object's own reference may be gone.
        self._stream = _stream(array, self._options.pop("stream", None))
        self._stream_number = _number_of(self._stream)
        self.triangles = triangles
        self._place = f"{argument} are on a CUDA device"
        self._made: Any

    @property
    def vertex_count(self) -> int:
        return int(self._made.vertex_count)

    @property
    def triangle_count(self) -> int:
        return int(self._made.triangle_count)

    def smoothed(
        self, points: Any, out: Any, quality: bool, smooth: Callable[[Any, Any, bool], _core.Outcome]
    ) -> Tuple[_core.Outcome, Any, Any, Any]:
        """What a result is made of. ``smooth`` is called with points, output, and whether that is new."""
        if _arrays.device_of(points) is None:
            raise ValueError(f"points: are in memory of the host, and {self._place}")
        if out is not None:
            _require_writable(out)
        target = _new_like(points) if out is None else out
        reports = [self._report(points)] if quality else []
        outcome = smooth(
            _capsule(points, "points", self._stream_number), _capsule(target, "out", self._stream_number), out is None
        )
        result_points = _as_given(points, target) if out is None else out
        if quality:
            outcome = outcome.with_quality(reports[0], self._report(result_points))
        return outcome, result_points, self.triangles, None if out is points else points

    def _report(self, points: Any) -> _core.QualityReport:
        return _core.quality(to_host(points), self._corners(), 0)[0]

    def _corners(self) -> np.ndarray:
        return to_host(self.triangles)


class DevicePlan(_OnDevice):
    """The part of Plan for arrays on a device."""

    def __init__(self, triangles: Any, n_points: int, constraints: Constraints, options: Dict[str, Any]) -> None:
        super().__init__(triangles, options, triangles, "triangles")
        stream = self._stream_number
        self._made = _core.DevicePlan(
            _capsule(triangles, "triangles", stream),
            n_points,
            _on_device(constraints, stream),
            stream,
            self._stream,
            self._options,
        )

    def smooth(self, points: Any, out: Any, quality: bool, progress: Any) -> Result:
        return Result(
            *self.smoothed(
                points, out, quality, lambda given, into, is_new: self._made.smooth(given, into, is_new, progress)
            )
        )


class DeviceMovingMesh(_OnDevice):
    """The part of MovingMesh for points on a device. What is made ready of the reference is made on the host."""

    def __init__(self, points: Any, triangles: Any, constraints: Constraints, options: Dict[str, Any]) -> None:
        super().__init__(triangles, options, points, "points")
        self._place = "the mesh was made of points on a CUDA device"
        reference = to_host(points)
        device = _arrays.device_of(points) or 0
        self.on_host = OnHost(
            _on_host(triangles),
            len(reference) if reference.ndim == 2 else 0,
            Constraints(*(_on_host(array) for array in constraints)),
            lambda corners, held: _core.DeviceMovingMesh(
                reference, corners, held, device, self._stream_number, self._stream, self._options
            ),
        )
        self._made = self.on_host.made

    def follow(
        self, points: Any, out: Any, start: str, quality: bool, progress: Any, notes: Callable[[_core.Outcome], List[str]]
    ) -> Tuple[_core.Outcome, Any, Any, Any, List[str]]:
        def step(given: Any, into: Any, is_new: bool) -> _core.Outcome:
            made: _core.DeviceMovingMesh = self._made
            return made.follow(given, into, is_new, start, progress, lambda found: warn_of(notes(found)))

        outcome, result, triangles, before = self.smoothed(points, out, quality, step)
        outcome = self.on_host.renumbered(outcome)
        return outcome, result, triangles, before, notes(outcome)

    def copied(self, points: Any) -> Any:
        """Points, wherever they are, as the host has them."""
        return _on_host(points)

    def _corners(self) -> np.ndarray:
        return self.on_host.corners


def smooth(
    points: Any,
    triangles: Any,
    constraints: Constraints,
    out: Any,
    quality: Optional[bool],
    progress: Any,
    options: Dict[str, Any],
) -> Result:
    """smooth() for points on a device."""
    _require_cuda("points", points)
    if _arrays.device_of(triangles) is None:
        raise ValueError(f"triangles: are in memory of the host, and points are on cuda:{_arrays.device_of(points)}")
    if _arrays.device_of(triangles) != _arrays.device_of(points):
        raise ValueError(
            f"triangles: are on cuda:{_arrays.device_of(triangles)}, and points are on cuda:{_arrays.device_of(points)}"
        )
    if getattr(points, "ndim", 0) != 2:
        raise ValueError(f"points: shape {tuple(points.shape)}; expected (N, 2) or (N, 3), a vertex a row")
    options = dict(options, stream=_stream(points, options.get("stream")))
    return DevicePlan(triangles, points.shape[0], constraints, options).smooth(
        points, out, _arrays.wants_quality(quality, False), progress
    )
