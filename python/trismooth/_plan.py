# SPDX-License-Identifier: BSD-3-Clause
"""Connectivity analysed once, coordinates smoothed as often as they change."""

from __future__ import annotations

from typing import Any, Callable, Dict, List, Optional, Tuple

import numpy as np

from . import _arrays, _core
from ._constraints import Constraints
from ._notes import options_without_effect, warn_of
from ._repeats import Repeats, find_repeats
from ._result import Result, notes_of
from ._smooth import Progress


class OnHost:
    """Elements in memory of the host, each counted once, and what is made ready of them."""

    def __init__(
        self,
        triangles: Any,
        n_points: int,
        constraints: Constraints,
        make: Callable[[Any, Dict[str, Any]], Any],
    ) -> None:
        corners = _arrays.on_host(triangles, "triangles")
        self._triangles = triangles
        self._repeats: Optional[Repeats] = find_repeats(corners, n_points)
        self.notes: List[str] = []
        if self._repeats is not None:
            corners = self._repeats.triangles()
            constraints = self._repeats.leave_out(constraints, n_points)
            self.notes = self._repeats.notes
        self.corners: np.ndarray = corners
        self.made: Any = make(corners, constraints.on_host())

    def smoothed(
        self, points: Any, out: Any, smooth: Callable[..., _core.Outcome], notes: Callable[[_core.Outcome], List[str]]
    ) -> Tuple[_core.Outcome, Any, Any, Any, List[str]]:
        """What a result is made of. ``smooth`` is called with points, output and what warns of its notes."""
        numbers = _arrays.on_host(points, "points", float)
        output = _arrays.Output(points, numbers, out)
        outcome = smooth(numbers, output.numbers, lambda outcome: warn_of(notes(outcome)))
        outcome = self.renumbered(outcome)
        return outcome, output.delivered(), self._triangles, output.input_points(), notes(outcome)

    def renumbered(self, outcome: _core.Outcome) -> _core.Outcome:
        """What was made of each triangle once, with the numbers of the list that was given."""
        return outcome if self._repeats is None else self._repeats.renumbered(outcome)


class Plan:
    """A mesh whose connectivity is analysed once and whose points are smoothed as often as they change.

    Parameters are those of :func:`trismooth.smooth`; the arrays are copied, but for ``triangles`` on a device, which
    stay where they are and must stay as they are. A plan serves one thread at a time, others wait; several plans work
    at the same time.

    Parameters
    ----------
    triangles : array of integers, shape (M, 3) or (M, 4)
    n_points : int
        The number of vertices.
    regions, fixed, other_cells, size, slide, lines, line_tags, links, method, backend, **options
        As for :func:`trismooth.smooth`.

    Raises
    ------
    TypeError, ValueError, MeshError, DeviceError
        As :func:`trismooth.smooth`.

    Examples
    --------
    >>> plan = trismooth.Plan(triangles, len(points), method="mean-ratio")
    >>> for time in times:
    ...     move_boundary(points, time)
    ...     plan.smooth(points, out=points)
    """

    def __init__(
        self,
        triangles: Any,
        n_points: int,
        *,
        regions: Any = None,
        fixed: Any = None,
        other_cells: Any = None,
        size: Any = None,
        slide: str = "off",
        lines: Any = None,
        line_tags: Any = None,
        links: Any = None,
        method: str = "smart",
        backend: str = "auto",
        **options: Any,
    ) -> None:
        options["method"] = method
        options["backend"] = backend
        options["slide"] = slide
        constraints = Constraints(regions, fixed, other_cells, size, lines, line_tags, links)
        self._notes = options_without_effect(options, size)
        self._on_device = _arrays.device_of(triangles) is not None
        if isinstance(n_points, bool) or not isinstance(n_points, (int, np.integer)) or not 0 <= n_points < 2**31:
            raise ValueError(f"n_points: the number of vertices is needed, not {n_points!r}")
        self._plan: Any
        if self._on_device:
            from . import _device

            self._plan = _device.DevicePlan(triangles, n_points, constraints, options)
        else:
            if "stream" in options:
                raise TypeError("stream: is for arrays on a CUDA device, and triangles are in memory of the host")
            self._mesh = OnHost(
                triangles, n_points, constraints, lambda corners, held: _core.HostPlan(corners, n_points, held, options)
            )
            self._plan = self._mesh.made
            self._notes = [*self._mesh.notes, *self._notes]
        warn_of(self._notes)

    @property
    def n_points(self) -> int:
        """The number of vertices."""
        return int(self._plan.vertex_count)

    @property
    def n_triangles(self) -> int:
        """The number of triangles, and quadrilaterals, each counted once."""
        return int(self._plan.triangle_count)

    def smooth(
        self, points: Any, *, out: Any = None, quality: bool = False, progress: Optional[Progress] = None
    ) -> Result:
        """Smooths the points, one for every vertex.

        Parameters
        ----------
        points : array of float64 or float32, shape (N, 2) or (N, 3)
            On the device that the triangles are on, if they are on one.
        out : array, optional
            Where the result goes; it may be ``points``. Default: a new array.
        quality : bool
            Whether ``result.before`` and ``result.after`` are computed.
        progress : callable, optional
            As for :func:`trismooth.smooth`.

        Returns
        -------
        Result

        Warns
        -----
        MeshWarning
            Where triangles of the result are inverted or degenerate, as those of the points were that went in.
        """
        result = self._smoothed(points, out, _arrays.wants_quality(quality, False), progress)
        result.notes += self._notes
        return result

    def _smoothed(self, points: Any, out: Any, quality: bool, progress: Optional[Progress]) -> Result:
        if self._on_device:
            result: Result = self._plan.smooth(points, out, quality, progress)
            warn_of(result.notes)
            return result
        return Result(
            *self._mesh.smoothed(
                points, out, lambda given, into, accept: self._plan.smooth(given, into, quality, progress, accept), notes_of
            )
        )

    def __repr__(self) -> str:
        listed = self._plan.triangles if self._on_device else self._mesh.corners
        name = "elements" if tuple(listed.shape[1:]) == (4,) else "triangles"
        return f"<trismooth.Plan: {self.n_points} vertices, {self.n_triangles} {name}>"
