# SPDX-License-Identifier: BSD-3-Clause
"""The quality of a mesh's triangles."""

from __future__ import annotations

from typing import Any, Dict, Iterator, List, Tuple

import numpy as np

from . import _arrays, _core
from ._core import QualityReport
from ._notes import warn_of
from ._repeats import find_repeats

#: The names of the metrics of triangles. Those of a mesh with quadrilaterals are Quality.keys().
METRICS: Tuple[str, ...] = tuple(name for name, *_ in _core.metrics())


class Quality:
    """The value of each metric for every element, and what they come to.

    Attributes
    ----------
    summary : QualityReport
        Ranges, means, histogram of shape, worst elements; of meshes with quadrilaterals also of each kind
        (``summary.kinds``). ``print(quality)`` shows it.
    shape, area, min_angle, max_angle, aspect_ratio, radius_ratio, edge_ratio, condition, scaled_jacobian, equiangle_skew
        : numpy.ndarray of float64, shape (M,)
        The metrics by Verdict's names and definitions; ``quality["shape"]`` is the same. Angles are in degrees, areas in
        the square of the points' unit. shape, area, scaled_jacobian and condition are negative for inverted triangles:
        those against the majority of their component. Values of triangles without area may be infinite, never NaN.
    skew, taper : numpy.ndarray of float64, shape (M,)
        Of meshes with quadrilaterals, which have no radius_ratio: NaN for triangles, as radius_ratio is for
        quadrilaterals. A mesh of one kind alone has the metrics of that kind.
    """

    __slots__ = ("summary", "_values")

    def __init__(self, summary: QualityReport, values: Dict[str, np.ndarray]) -> None:
        self.summary = summary
        self._values = values

    def __getattr__(self, name: str) -> np.ndarray:
        if name.startswith("_"):  # of a Quality that is being made
            raise AttributeError(name)
        if name in self._values:
            return self._values[name]
        raise AttributeError(f"'{name}' is no metric; there are {', '.join(self._values)}")

    def __getitem__(self, name: str) -> np.ndarray:
        try:
            return self._values[name]
        except KeyError:
            raise KeyError(f"'{name}' is no metric; there are {', '.join(self._values)}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def keys(self) -> Tuple[str, ...]:
        """The names of the metrics that elements of the mesh have."""
        return tuple(self._values)

    def __dir__(self) -> List[str]:
        return sorted([*self._values, "summary", "keys"])

    def __str__(self) -> str:
        return str(self.summary)

    def __repr__(self) -> str:
        return f"<trismooth.Quality: {self.summary!r}>"

    def _repr_html_(self) -> str:
        return self.summary._repr_html_()


def quality(points: Any, triangles: Any = None, *, threads: int = 0) -> Quality:
    """The quality of every triangle, and quadrilateral, of a planar mesh.

    Parameters
    ----------
    points : array of float64 or float32, shape (N, 2) or (N, 3); or a mesh as for :func:`trismooth.smooth`
    triangles : array of integers, shape (M, 3), (M, 4), (M, 6) or (M, 9)
        In either direction: what the majority of a component's triangles is counts as positive. Of elements
        with nodes in the middle of their sides the corners count. With four numbers of each, corners in turn,
        quadrilaterals are among them; the last of a triangle is -1. With nine, elements of any number of nodes. An element that is listed again has the values of the first and counts once. Of a mesh of
        another package the triangles alone count.
    threads : int
        0: all. The result does not depend on it.

    Returns
    -------
    Quality
        One NumPy array a metric (``quality.shape``), and ``quality.summary``. Arrays on a device are copied to the host.

    Warns
    -----
    MeshWarning
        Of elements that are listed again.

    Raises
    ------
    TypeError, ValueError, MeshError
        As :func:`trismooth.smooth`.
    """
    if triangles is None:
        from . import _meshes

        points, triangles = _meshes.arrays_of(points)
    if _arrays.device_of(points) is not None:
        from . import _device

        points, triangles = _device.to_host(points), _device.to_host(triangles)
    numbers, corners = _arrays.on_host(points, "points", float), _arrays.on_host(triangles, "triangles")
    repeats = find_repeats(corners, len(numbers) if numbers.ndim == 2 else 0)
    if repeats is None:
        return Quality(*_core.quality(numbers, corners, threads))
    report, values = _core.quality(numbers, repeats.triangles(), threads)
    warn_of(note.replace("counted and smoothed once", "counted once") for note in repeats.notes)
    of_all = {name: of_kept[repeats.place] for name, of_kept in values.items()}
    return Quality(_core.renumbered(report, repeats.kept), of_all)
