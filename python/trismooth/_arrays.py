# SPDX-License-Identifier: BSD-3-Clause
"""The arrays of callers: what they are, where they are, and how an array of the same kind is made.

NumPy arrays pass through untouched. Everything else that has DLPack or ``__array__`` is taken without a copy where it is
in memory of the host, and stays where it is in memory of a CUDA device.
"""

from __future__ import annotations

import sys
from typing import Any, Optional

import numpy as np

#: DLPack's device types, as far as they are told apart here.
_CPU, _CUDA, _CUDA_HOST, _CUDA_MANAGED = 1, 2, 3, 13


def device_of(array: Any) -> Optional[int]:
    """The number of the CUDA device that an array is on, or None for one in memory of the host."""
    if type(array) is np.ndarray or not hasattr(array, "__dlpack_device__"):
        return None
    kind, number = array.__dlpack_device__()
    return int(number) if int(kind) in (_CUDA, _CUDA_MANAGED) else None


def library_of(array: Any) -> str:
    """The package that an array's type is from: "numpy", "cupy", "torch", "jax", ..."""
    root = type(array).__module__.partition(".")[0]
    return "jax" if root == "jaxlib" else root


def is_plain(array: Any) -> bool:
    """Whether this is a NumPy array that the compiled part takes as it is."""
    return type(array) is np.ndarray and array.flags.aligned and array.dtype.isnative


def on_host(array: Any, argument: str, number: Optional[type] = None) -> np.ndarray:
    """An array in memory of the host as a NumPy array, without a copy where that can be.

    ``number`` is the type that plain Python numbers get, of lists and the like. Raises TypeError with the name of the
    argument for what is no array.
    """
    if is_plain(array):
        plain: np.ndarray = array
        return plain
    if isinstance(array, np.ma.MaskedArray) and np.ma.is_masked(array):
        raise ValueError(f"{argument}: some of its elements are masked")
    if device_of(array) is not None:
        raise ValueError(f"{argument}: is on cuda:{device_of(array)}, and points are in memory of the host")
    try:
        result = _as_numpy(array, number)
    except (TypeError, ValueError, BufferError) as error:
        raise type(error)(f"{argument}: {error}") from None
    if not is_plain(result):
        result = result.astype(result.dtype.newbyteorder("="), copy=True)
    return result


def _as_numpy(array: Any, number: Optional[type]) -> np.ndarray:
    if hasattr(array, "__array__") or isinstance(array, memoryview):
        return np.asarray(_detached(array))
    if hasattr(array, "__dlpack__"):
        return np.from_dlpack(array)
    return np.asarray(array, dtype=number)


def _detached(array: Any) -> Any:
    """PyTorch refuses a tensor that records gradients; its numbers are taken."""
    return array.detach() if library_of(array) == "torch" else array


def element_nodes(nodes: np.ndarray) -> np.ndarray:
    """The numbers as int64, -1 where an element has no node, which unsigned numbers say by their largest."""
    numbers: np.ndarray = nodes.astype(np.int64)
    if nodes.dtype.kind == "u":
        numbers[nodes == np.iinfo(nodes.dtype).max] = -1
    return numbers


def corner_counts(numbers: np.ndarray) -> np.ndarray:
    """How many corners elements have, 3 or 4: those of triangles of three and six nodes, and of quadrilaterals.

    Parameters
    ----------
    numbers : ndarray of int, shape (..., N)
        What :func:`element_nodes` returns of elements of any number of nodes.
    """
    return np.where(np.isin((numbers >= 0).sum(axis=-1), (3, 6)), 3, 4)


def labels(array: Any, argument: str, of_what: str) -> np.ndarray:
    """Labels of any type, texts as well, as integers of 32 bits: equal ones where labels are equal; one each `of_what`."""
    values = on_host(array, argument)
    if values.dtype.kind in "iu" and (values.dtype.itemsize <= 4 and values.dtype != np.uint32):
        return values
    if values.ndim != 1:
        raise ValueError(f"{argument}: shape {values.shape}; expected one dimension, a label for each {of_what}")
    if values.dtype.kind == "f" and np.isnan(values).any():
        raise ValueError(f"{argument}: a label is NaN")
    try:
        return np.unique(values, return_inverse=True)[1].astype(np.int32)
    except TypeError as error:
        raise TypeError(f"{argument}: its labels cannot be compared: {error}") from None


class Output:
    """Where a result in memory of the host goes: the caller's array, or a new one of the kind of the points.

    Attributes
    ----------
    numbers : numpy.ndarray
        What the compiled part writes into.
    """

    __slots__ = ("numbers", "_points", "_given", "_out", "_array")

    def __init__(self, points: Any, numbers: np.ndarray, out: Any) -> None:
        self._points = points
        self._given = numbers
        self._out = out
        if out is None:
            self._array = np.empty_like(points if isinstance(points, np.ndarray) else numbers, subok=False)
        else:
            self._array = _writable_on_host(out, "out")
        self.numbers = self._array
        if not is_plain(self._array):
            _require_like(self._array, numbers)
            self.numbers = np.empty_like(numbers)

    def delivered(self) -> Any:
        """The result as the caller gets it."""
        if self.numbers is not self._array:
            self._array[...] = self.numbers
        if self._out is not None:
            return self._out
        return self._array if isinstance(self._points, np.ndarray) else _like(self._points, self._array)

    def input_points(self) -> Any:
        """The points that went in; None where they are overwritten."""
        if self._out is None:
            return self._points
        is_overwritten = self._out is self._points or np.may_share_memory(self._array, self._given)
        return None if is_overwritten else self._points


def _require_like(out: np.ndarray, numbers: np.ndarray) -> None:
    """What the compiled part asks of arrays that it writes, of one that is copied to."""
    if not out.flags.writeable:
        raise ValueError("out: cannot be written: it is read-only")
    if out.shape != numbers.shape:
        raise ValueError(f"out: shape {out.shape}; that of points is {numbers.shape}")
    if out.dtype.newbyteorder("=") != numbers.dtype:
        raise TypeError(f"out: its numbers are {out.dtype}, those of points {numbers.dtype}")


def _like(array: Any, result: np.ndarray) -> Any:
    """The result as an array of the kind that `array` is. Shares the memory where the other library can."""
    library = library_of(array)
    if library == "torch":
        return sys.modules["torch"].from_numpy(result)
    if library == "jax":
        return sys.modules["jax"].device_put(result, next(iter(array.devices())))
    if hasattr(array, "__array_namespace__") and not isinstance(array, np.ndarray):
        return array.__array_namespace__().asarray(result)
    return result


def _writable_on_host(array: Any, argument: str) -> np.ndarray:
    """The caller's array to write into, as a NumPy array that shares its memory."""
    if isinstance(array, np.ma.MaskedArray):
        raise ValueError(f"{argument}: masked arrays are not written")
    if isinstance(array, np.ndarray):
        return array
    if device_of(array) is not None:
        raise ValueError(f"{argument}: is on cuda:{device_of(array)}, and points are in memory of the host")
    if library_of(array) == "jax":
        raise ValueError(f"{argument}: arrays of JAX cannot be written")
    if library_of(array) == "torch":
        shared: np.ndarray = _detached(array).numpy()
        return shared
    if isinstance(array, memoryview) or hasattr(array, "__array_interface__"):
        return np.asarray(array)
    if hasattr(array, "__dlpack__"):
        return np.from_dlpack(array)
    raise TypeError(f"{argument}: an array that can be written is needed, not {type(array).__name__}")


def wants_quality(quality: Any, default: bool) -> bool:
    """The caller's answer to whether the quality is computed, or the default."""
    if quality is None:
        return default
    if isinstance(quality, (bool, np.bool_)):
        return bool(quality)
    raise TypeError(f"quality: True, False or None is needed, not {quality!r}")
