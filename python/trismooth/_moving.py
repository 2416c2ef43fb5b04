# SPDX-License-Identifier: BSD-3-Clause
"""Meshes that follow their boundary."""

from __future__ import annotations

from typing import Any, List, Optional

import numpy as np

from . import _arrays, _core
from ._constraints import Constraints
from ._notes import in_python, options_without_effect, warn_of
from ._plan import OnHost
from ._result import NOT_MENDED as _NOT_MENDED
from ._result import Result, invalid_triangles_note, kind_of
from ._smooth import Progress

_MOST_LISTED = 1000
_NO_ROOM = (
    "the boundary leaves them no room, or layers that are kept do not; take_back() and a smaller step, layers='smooth' or "
    "another boundary is the way out"
)
_NO_TIME = "the time was up before they were mended; take_back() and a larger time_limit, or a smaller step, is the way out"


def _following(outcome: _core.Outcome) -> dict[str, Any]:
    found = outcome.following
    assert found is not None
    return found


def _notes_of_following(outcome: _core.Outcome, says_layers: bool) -> List[str]:
    # What is not mended has another way out than where nothing moves; lines do not slide.
    no_room = _NO_TIME if outcome.stop_reason == "time_limit" else _NO_ROOM
    of_layers = outcome.carried_layers_notes if says_layers else []
    said = [outcome.shared_middles_note, *of_layers, outcome.no_time_to_follow_note]
    notes = [in_python(sentence) for sentence in said if sentence]
    notes += [note.replace(_NOT_MENDED, no_room) for note in invalid_triangles_note(outcome)]
    folded = 0 if outcome.following is None else outcome.following["invalid_held"]
    if folded > 0:
        notes.append(
            f"the boundary has folded: all vertices of {folded} {kind_of(outcome)}{'' if folded == 1 else 's'} that "
            f"{'is' if folded == 1 else 'are'} inverted or without area are held, and no place of the others mends "
            f"{'it' if folded == 1 else 'them'}"
        )
    if outcome.stop_reason == "sweep_limit":
        notes.append("the sweeps ended at max_sweeps, and the mesh is still on its way: a larger number lets it arrive")
    if outcome.stop_reason == "time_limit" and outcome.sweeps > 0:
        notes.append(
            "the sweeps ended at time_limit, and the mesh is still on its way: where it is then is not the same every time; "
            "more time lets it arrive"
        )
    crossings = [] if outcome.following is None else outcome.following["crossings"]
    if crossings:
        (a, b), (c, d) = crossings[0]
        notes.append(
            f"the boundary crosses or touches itself, so the mesh lies over itself or on itself: {_count_of(crossings)} pair"
            f"{'' if len(crossings) == 1 else 's'} of edges, as from vertex {a} to {b} and from {c} to {d}; a boundary that "
            "does not is needed"
        )
    overlaps = [] if outcome.following is None else outcome.following["overlaps"]
    if overlaps:
        notes.append(
            f"the mesh lies over itself around {_count_of(overlaps)} {'vertex' if len(overlaps) == 1 else 'vertices'}, as "
            f"around {overlaps[0]}: a hole has been turned inside out, or a slit pushed through itself; another boundary is "
            "needed"
        )
    return notes


def _count_of(listed: List[Any]) -> str:
    return f"{len(listed)}{' or more' if len(listed) >= _MOST_LISTED else ''}"


class FollowResult(Result):
    """What :meth:`MovingMesh.follow` did, and the points. All that :class:`trismooth.Result` has is of the smoothing from
    where vertices were carried to."""

    __slots__ = ()

    @property
    def valid(self) -> bool:
        """Whether a solver may go on with this mesh: no element is inverted or degenerate, and it lies over itself nowhere.
        False as well where the call was over before the first sweep."""
        return bool(_following(self._outcome)["valid"])

    @property
    def min_relative_shape(self) -> float:
        """The smallest shape of an element seen from the reference's: 1 where it has the same shape, 0 or less where it is
        degenerate or inverted; of a quadrilateral at its worst corner. NaN where no element is valid in the reference."""
        return float(_following(self._outcome)["min_relative_shape"])

    @property
    def mean_relative_shape(self) -> float:
        """The mean of these shapes."""
        return float(_following(self._outcome)["mean_relative_shape"])

    @property
    def invalid_held(self) -> int:
        """How many elements the boundary itself has inverted or made degenerate: all their vertices are held."""
        return int(_following(self._outcome)["invalid_held"])

    @property
    def crossings(self) -> List[tuple[tuple[int, int], tuple[int, int]]]:
        """Edges between held vertices that cross or touch each other, to rounding, and do not in the reference, as pairs of
        vertices: where there are any the mesh lies over itself or on itself. 1000 at most."""
        return list(_following(self._outcome)["crossings"])

    @property
    def overlaps(self) -> List[int]:
        """Vertices around which the mesh lies over itself, and does not in the reference: the elements around one go
        round it more than once, as where a hole has been turned inside out. 1000 at most."""
        return list(_following(self._outcome)["overlaps"])

    @property
    def invalid(self) -> List[int]:
        """The elements that are inverted or degenerate. 1000 at most."""
        return list(_following(self._outcome)["invalid"])

    @property
    def largest_move(self) -> float:
        """The largest move of a vertex from the last mesh, at first the reference, to this one."""
        return float(_following(self._outcome)["largest_move"])

    def __repr__(self) -> str:
        text = super().__repr__().replace("trismooth.Result", "trismooth.FollowResult")
        invalid = self.inverted + self.degenerate
        found = "" if invalid == 0 else f", {invalid} inverted or degenerate" if invalid > 0 else ", nothing is known"
        for count, what in ((self.crossings, "crossings of the boundary"), (self.overlaps, "vertices where it lies over itself")):
            found += f", {_count_of(count)} {what}" if count else ""
        return f"{text[:-1]}{found}, smallest relative shape {self.min_relative_shape:.4g}>"


class MovingMesh:
    """A mesh that follows its boundary: rotors, flapping foils, free surfaces, moulds.

    Made of the mesh at rest, the *reference*, whose sizes and shapes are aimed at. In every step you say where the held
    vertices are; the others are carried along with them, untangled where they have to be, smoothed and guarded. The same
    boundary gives the same points to the last bit, whatever came before: after a cycle nothing has drifted. On
    the CPU, or with ``backend="cuda"`` on a GPU, to the same bits; made of points on a CUDA device it takes points
    there, and only those of the boundary go to the host. See docs/moving.md.

    Parameters
    ----------
    points : array of float64 or float32, shape (N, 2) or (N, 3)
        The reference: of NumPy, or on a CUDA device (CuPy, PyTorch, JAX, whatever has DLPack). It is copied, as all
        arrays are, which may be on either.
    triangles : array of integers, shape (M, 3) or (M, 4)
        Quadrilaterals, with -1 in the last place of a triangle, follow on the CPU, with points in memory of the host.
    regions, fixed, other_cells, **options
        As for :func:`trismooth.smooth`, with other defaults: ``method`` is "mean-ratio", ``target`` "input-shape" (the
        reference's shapes; "uniform" aims at equilateral triangles and squares), ``power`` 8, ``size_weight`` 0.3, ``max_sweeps`` 1000,
        ``steady`` True (moves die away towards the least gain that is worth one, so that the mesh goes as smoothly as its
        boundary). Nothing slides.

    Raises
    ------
    TypeError, ValueError, MeshError
        As :func:`trismooth.smooth`; ValueError also for ``slide``, and for several ``devices``.

    Warns
    -----
    MeshWarning
        Of elements that are listed again.

    Examples
    --------
    >>> mesh = trismooth.MovingMesh(points, triangles)
    >>> for time in times:
    ...     points[mesh.held] = boundary_at(time)
    ...     result = mesh.follow(points, out=points)
    ...     if not result.valid: ...
    """

    def __init__(
        self,
        points: Any,
        triangles: Any,
        *,
        regions: Any = None,
        fixed: Any = None,
        other_cells: Any = None,
        backend: str = "auto",
        **options: Any,
    ) -> None:
        if "size" in options:
            raise TypeError("size: a mesh that moves has the sizes of its reference")
        if options.get("slide", "off") != "off":
            raise ValueError("slide: vertices that slide have no place of their own; say where they are, without sliding")
        constraints = Constraints(regions, fixed, other_cells)
        self._on_device: Any = None
        if _arrays.device_of(points) is not None:
            from . import _device

            self._on_device = _device.DeviceMovingMesh(points, triangles, constraints, {"backend": backend, **options})
            self._mesh = self._on_device.on_host
        else:
            if "stream" in options:
                raise TypeError("stream: is for arrays on a CUDA device, and points are in memory of the host")
            options["backend"] = "cpu" if backend == "auto" else backend
            reference = _arrays.on_host(points, "points", float)
            count = len(reference) if reference.ndim == 2 else 0
            self._mesh = OnHost(
                triangles, count, constraints, lambda corners, held: _core.HostMovingMesh(reference, corners, held, options)
            )
        self._moving = self._mesh.made
        self._has_said_layers = False
        self._notes = [*self._mesh.notes, *options_without_effect({"method": "mean-ratio", "slide": "off", **options}, None)]
        if options.get("method", "mean-ratio") != "mean-ratio":
            self._notes.append(
                f"the method {options['method']!r} has no memory of the reference, whose shapes and sizes method='mean-ratio' "
                "aims at"
            )
        warn_of(self._notes)

    @property
    def n_points(self) -> int:
        """The number of vertices."""
        return int(self._moving.vertex_count)

    @property
    def n_triangles(self) -> int:
        """The number of triangles, and quadrilaterals, each counted once."""
        return int(self._moving.triangle_count)

    @property
    def held(self) -> np.ndarray:
        """The vertices of which you say where they are: an array of N bools, those of boundaries and borders of regions
        and those that you named."""
        held: np.ndarray = self._moving.held
        held.flags.writeable = False
        return held

    @property
    def points(self) -> np.ndarray:
        """The last mesh, at first the reference: a copy in memory of the host, of float64 and shape (N, 2)."""
        points: np.ndarray = self._moving.points
        return points

    def follow(
        self,
        points: Any,
        *,
        start: str = "reference",
        out: Any = None,
        quality: bool = False,
        progress: Optional[Progress] = None,
    ) -> FollowResult:
        """Puts the free vertices to where they belong.

        Parameters
        ----------
        points : array of float64 or float32, shape (N, 2) or (N, 3)
            Held vertices where they are now, which keep their bits. Where the others are does not matter, but they must
            be finite. On a CUDA device if the reference was.
        start : {"reference", "previous"}
            Where vertices are carried on from. "reference": the result depends on the boundary alone. "previous", the
            last result: fewer sweeps where steps are small, and the result depends on the path.
        out : array, optional
            Where the result goes; it may be ``points``. Default: a new array.
        quality : bool
            Whether ``result.before``, of ``points`` as they are given, and ``result.after`` are computed.
        progress : callable, optional
            As for :func:`trismooth.smooth`.

        Returns
        -------
        FollowResult

        Warns
        -----
        MeshWarning
            Where elements of the result are inverted or degenerate, where the boundary has folded, or crosses or touches
            itself, where the mesh lies over itself, and where sweeps ended at ``max_sweeps`` or ``time_limit``; in the
            first step of a mesh also what its layers are. Made an error by a filter, or interrupted, the call has not
            happened: no array has changed, nor :attr:`points`.
        """
        if not isinstance(start, str):
            raise TypeError(f"start: 'reference' or 'previous' is needed, not {start!r}")
        wanted = _arrays.wants_quality(quality, False)
        if self._on_device is not None:
            made = self._on_device.follow(points, out, start, wanted, progress, self._notes_of)
        elif _arrays.device_of(points) is not None:
            raise ValueError(
                f"points: are on cuda:{_arrays.device_of(points)}, and the mesh was made of points in memory of the host"
            )
        else:
            made = self._mesh.smoothed(
                points,
                out,
                lambda given, into, accept: self._moving.follow(given, into, start, wanted, progress, accept),
                self._notes_of,
            )
        result = FollowResult(*made)
        result.notes += self._notes
        return result

    def _notes_of(self, outcome: _core.Outcome) -> List[str]:
        # What the layers of the reference are is said once, also where a filter makes an error of it: a step that was
        # given up for that would be given up for ever.
        notes = _notes_of_following(outcome, not self._has_said_layers)
        self._has_said_layers = True
        return notes

    def take_back(self) -> None:
        """Has the last step not have happened, as where a solver repeats a time step with a smaller one: :attr:`points` are
        those before it. RuntimeError where there is no such step: none yet, one that was taken back, :meth:`go_on_from`
        since, or a call since that has begun and raised or ended early: that has not happened, but what was before the step
        before it is gone."""
        self._moving.take_back()

    def go_on_from(self, points: Any) -> None:
        """Has these points be the last mesh, as where a run goes on that was broken off: ``start="previous"`` starts there.

        Parameters
        ----------
        points : array of float64 or float32, shape (N, 2) or (N, 3)
        """
        if self._on_device is not None:
            points = self._on_device.copied(points)
        self._moving.go_on_from(_arrays.on_host(points, "points", float))

    def __repr__(self) -> str:
        return f"<trismooth.MovingMesh: {self.n_points} vertices, {self.n_triangles} triangles>"
