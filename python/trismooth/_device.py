# SPDX-License-Identifier: BSD-3-Clause
"""Arrays in memory of a CUDA device: CuPy, PyTorch, JAX and whatever has DLPack. They stay there."""

from __future__ import annotations

import sys
from typing import Any, Dict, Optional

import numpy as np

from . import _arrays, _core
from ._constraints import Constraints
from ._result import Result

#: DLPack's number of the default stream.
_DEFAULT_STREAM = 1


def _require_cuda(argument: str, array: Any) -> None:
    if not _core.has_cuda:
        raise _core.DeviceError(
            f"{argument}: is on cuda:{_arrays.device_of(array)}, and this build of trismooth has no CUDA; the package "
            "trismooth-cuda13 has"
        )


def _stream(array: Any, stream: Any) -> int:
    """The number of a stream: of the one that the caller names, else of the current one of the array's library."""
    if stream is not None:
        for name in ("ptr", "cuda_stream", "handle"):  # of CuPy, PyTorch and cuda.core
            if hasattr(stream, name):
                return int(getattr(stream, name)) or _DEFAULT_STREAM
        if hasattr(stream, "__index__"):
            return int(stream) or _DEFAULT_STREAM
        raise TypeError(f"stream: a CUDA stream or its number is needed, not {type(stream).__name__}")
    library = _arrays.library_of(array)
    if library == "cupy":
        return int(sys.modules["cupy"].cuda.get_current_stream().ptr) or _DEFAULT_STREAM
    if library == "torch":
        return int(sys.modules["torch"].cuda.current_stream(array.device).cuda_stream) or _DEFAULT_STREAM
    return _DEFAULT_STREAM


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


def _refuse_devices(options: Dict[str, Any]) -> None:
    if options.get("devices") is not None:
        raise ValueError("devices: are for arrays in memory of the host; arrays on a CUDA device are smoothed there")


class DevicePlan:
    """The part of Plan for arrays on a device."""

    def __init__(self, triangles: Any, n_points: int, constraints: Constraints, options: Dict[str, Any]) -> None:
        _require_cuda("triangles", triangles)
        if options["backend"] == "cpu":
            raise ValueError("backend: 'cpu' is for arrays in memory of the host, and triangles are on a CUDA device")
        _refuse_devices(options)
        options = dict(options)
        self._given_stream = options.pop("stream", None)
        options["backend"] = "cuda"
        stream = _stream(triangles, self._given_stream)
        self._stream_number = stream
        self._triangles = triangles
        self._plan = _core.DevicePlan(
            _capsule(triangles, "triangles", stream),
            n_points,
            _on_device(constraints, stream),
            stream,
            options,
        )

    @property
    def vertex_count(self) -> int:
        return self._plan.vertex_count

    @property
    def triangle_count(self) -> int:
        return self._plan.triangle_count

    def smooth(self, points: Any, out: Any, quality: bool, progress: Any) -> Result:
        if _arrays.device_of(points) is None:
            raise ValueError("points: are in memory of the host, and triangles are on a CUDA device")
        if out is not None:
            _require_writable(out)
        target = _new_like(points) if out is None else out
        stream = self._stream_number
        reports = [self._report(points)] if quality else []
        outcome = self._plan.smooth(
            _capsule(points, "points", stream),
            _capsule(target, "out", stream),
            out is None,
            progress,
        )
        result_points = _as_given(points, target) if out is None else out
        if quality:
            outcome = outcome.with_quality(reports[0], self._report(result_points))
        return Result(outcome, result_points, self._triangles, None if out is points else points)

    def _report(self, points: Any) -> _core.QualityReport:
        return _core.quality(to_host(points), to_host(self._triangles), 0)[0]


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
    if options["backend"] == "cpu":
        raise ValueError("backend: 'cpu' is for arrays in memory of the host, and points are on a CUDA device")
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
