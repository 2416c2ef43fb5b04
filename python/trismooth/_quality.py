# SPDX-License-Identifier: BSD-3-Clause
"""The quality of a mesh's triangles."""

from __future__ import annotations

from typing import Any, Dict, Iterator, List, Tuple

import numpy as np

from . import _arrays, _core
from ._core import QualityReport
from ._notes import warn_of
from ._repeats import find_repeats

#: The names of the metrics, as the attributes of Quality.
METRICS: Tuple[str, ...] = tuple(name for name, *_ in _core.metrics())


class Quality:
    """The value of each metric for every triangle, and what they come to.

    Attributes
    ----------
    summary : QualityReport
        Ranges, means, histogram of shape, worst elements. ``print(quality)`` shows it.
    shape, area, min_angle, max_angle, aspect_ratio, radius_ratio, edge_ratio, condition, scaled_jacobian, equiangle_skew
        : numpy.ndarray of float64, shape (M,)
        The metrics by Verdict's names and definitions; ``quality["shape"]`` is the same. Angles are in degrees, areas in
        the square of the points' unit. shape, area, scaled_jacobian and condition are negative for inverted triangles:
        those against the majority of their component. Values of triangles without area may be infinite, never NaN.
    """

    __slots__ = ("summary", "_values")

    def __init__(self, summary: QualityReport, values: List[np.ndarray]) -> None:
        self.summary = summary
        self._values: Dict[str, np.ndarray] = dict(zip(METRICS, values))

    def __getattr__(self, name: str) -> np.ndarray:
        if name in METRICS:
            return self._values[name]
        raise AttributeError(f"'{name}' is no metric; there are {', '.join(METRICS)}")

    def __getitem__(self, name: str) -> np.ndarray:
        try:
            return self._values[name]
        except KeyError:
            raise KeyError(f"'{name}' is no metric; there are {', '.join(METRICS)}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(METRICS)

    def __len__(self) -> int:
        return len(METRICS)

    def keys(self) -> Tuple[str, ...]:
        """The names of the metrics."""
        return METRICS

    def __dir__(self) -> List[str]:
        return sorted([*METRICS, "summary", "keys"])

    def __str__(self) -> str:
        return str(self.summary)

    def __repr__(self) -> str:
        return f"<trismooth.Quality: {self.summary!r}>"

    def _repr_html_(self) -> str:
        return self.summary._repr_html_()


def quality(points: Any, triangles: Any = None, *, threads: int = 0) -> Quality:
    """The quality of every triangle of a planar mesh, by ten metrics.

    Parameters
    ----------
    points : array of float64 or float32, shape (N, 2) or (N, 3); or a mesh as for :func:`trismooth.smooth`
    triangles : array of integers, shape (M, 3) or (M, 6)
        In either direction: what the majority of a component's triangles is counts as positive. Of triangles of six
        nodes the corners count. One that is listed again has the values of the first and counts once.
    threads : int
        0: all. The result does not depend on it.

    Returns
    -------
    Quality
        One NumPy array a metric (``quality.shape``), and ``quality.summary``. Arrays on a device are copied to the host.

    Warns
    -----
    MeshWarning
        Of triangles that are listed again.

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
    warn_of(repeats.notes)
    return Quality(_core.renumbered(report, repeats.kept), [of_kept[repeats.place] for of_kept in values])
