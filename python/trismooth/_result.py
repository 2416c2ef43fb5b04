# SPDX-License-Identifier: BSD-3-Clause
"""What a smoothing hands back."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, List, Optional

from . import _core
from ._core import QualityReport, SlidingResult, SweepRecord
from ._notes import in_python

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from ._show import View


class NotComputed(AttributeError):
    """A quality that was not asked for: pass ``quality=True``."""


NOT_MENDED = "the untangling could not mend more, and elements whose vertices are all held stay as they are"


def kind_of(outcome: _core.Outcome) -> str:
    """What its elements are called: "triangle" where all are."""
    return "triangle" if outcome.quadrilaterals == 0 else "element"


def invalid_triangles_note(outcome: _core.Outcome) -> List[str]:
    """What to say of elements that are not valid in the result: a sentence, or none."""
    name = kind_of(outcome)
    flat = "without area" if outcome.quadrilaterals == 0 else "without area or with a corner in line"
    kinds = ((outcome.inverted, f"inverted {name}{{}}"), (outcome.degenerate, f"{name}{{}} {flat}"))
    found = [f"{count} {kind.format('' if count == 1 else 's')}" for count, kind in kinds if count > 0]
    if not found:
        return []
    if had_no_time(outcome):
        why = "there was no time to mend all of them"
    elif outcome.untangling is None:
        why = "nothing untangled the mesh; untangle=True does"
    else:
        why = NOT_MENDED
    return [f"the result has {' and '.join(found)}: {why}"]


def had_no_time(outcome: _core.Outcome) -> bool:
    """Whether the time was up before the first sweep, and with it perhaps before all was untangled."""
    return bool(outcome.no_time_note)


def notes_of(outcome: _core.Outcome) -> List[str]:
    """What to say of what a smoothing did, one sentence each."""
    said = [outcome.shared_middles_note, *outcome.layers_notes, outcome.touching_lines_note, outcome.no_time_note]
    return [*(in_python(sentence) for sentence in said if sentence), *invalid_triangles_note(outcome)]


def free_moved(result: Result) -> int:
    """How many of the free vertices moved: those that slid are none of them."""
    return result.moved - (0 if result.sliding is None else result.sliding.slid)


class Result:
    """What a smoothing did, and the points.

    Attributes
    ----------
    points : array
        The smoothed points: of the shape and type of those that went in. Where ``out`` was given, that array.
    triangles : array
        The triangles, and quadrilaterals, that went in.
    input_points : array or None
        The points that went in; None where they were smoothed in place.
    mesh : object or None
        Of a mesh of another package: the smoothed mesh.
    notes : list of str
        What one should know, one sentence each: what was held by a guess, left out or not mended. They were warnings.
    """

    __slots__ = ("points", "triangles", "input_points", "mesh", "notes", "_outcome")

    def __init__(
        self,
        outcome: _core.Outcome,
        points: Any,
        triangles: Any,
        input_points: Any = None,
        notes: Optional[List[str]] = None,
    ) -> None:
        self.points = points
        self.triangles = triangles
        self.input_points = input_points
        self.mesh: Any = None
        self._outcome = outcome
        self.notes: List[str] = notes_of(outcome) if notes is None else notes

    def _quality(self, report: Optional[QualityReport]) -> QualityReport:
        if report is None:
            raise NotComputed(
                "the quality was not computed: it costs time, and is left out where points are smoothed in place or on "
                "a device. Pass quality=True"
            )
        return report

    @property
    def before(self) -> QualityReport:
        """The quality of the mesh that went in. Raises NotComputed where it was not asked for."""
        return self._quality(self._outcome.before)

    @property
    def after(self) -> QualityReport:
        """The quality of the smoothed mesh. Raises NotComputed where it was not asked for."""
        return self._quality(self._outcome.after)

    @property
    def has_quality(self) -> bool:
        """Whether ``before`` and ``after`` are there."""
        return self._outcome.before is not None and self._outcome.after is not None

    @property
    def moved(self) -> int:
        """How many vertices have other coordinates than before, those that slid included."""
        return self._outcome.moved

    @property
    def sweeps(self) -> int:
        """How many sweeps were made."""
        return self._outcome.sweeps

    @property
    def stop_reason(self) -> str:
        """Why the sweeps ended: "fixed_point", "tolerance", "few_moves", "sweep_limit", "time_limit",
        "quality_target" or "cancelled"."""
        return self._outcome.stop_reason

    @property
    def vertex_updates(self) -> int:
        """Evaluations of a vertex, over all sweeps."""
        return self._outcome.vertex_updates

    @property
    def reverted(self) -> int:
        """How many vertices the never-worse guard put back."""
        return self._outcome.reverted

    @property
    def reverted_vertices(self) -> List[Any]:
        """Of each vertex that the guard put back: its number, and where it had been, (x, y)."""
        return self._outcome.reverted_vertices

    @property
    def guard_rounds(self) -> int:
        """Rounds of the guard that put vertices back."""
        return self._outcome.guard_rounds

    @property
    def free_vertices(self) -> int:
        """How many vertices nothing held, neither in their place nor to a line."""
        return self._outcome.free_vertices

    @property
    def layers(self) -> Dict[str, float]:
        """What was found of triangles that are flat in one direction: how many vertices are held for it and would be
        free (kept) or slide (kept_on_lines) else, and how many are smoothed though they are inside of such stretches
        (left), with the largest aspects of their triangles (kept_aspect, left_aspect; 0: none). See ``layers=``."""
        return self._outcome.layers

    @property
    def inverted(self) -> int:
        """How many elements are inverted in the result: those against the majority of their component. Of all, with a
        free vertex or not; counted always, but -1 where the time was up before anybody could and quality=False."""
        return self._outcome.inverted

    @property
    def degenerate(self) -> int:
        """How many elements have no area in the result, or of quadrilaterals a corner in line; -1 where inverted is."""
        return self._outcome.degenerate

    @property
    def colours(self) -> int:
        """Colours of form b; 0 of form a."""
        return self._outcome.colours

    @property
    def history(self) -> List[SweepRecord]:
        """A record of each sweep."""
        return self._outcome.history

    @property
    def untangling(self) -> Optional[Dict[str, int]]:
        """Counts of inverted elements before and after, where they were untangled before the sweeps; else None."""
        return self._outcome.untangling

    @property
    def sliding(self) -> Optional[SlidingResult]:
        """What became of vertices that may slide along lines; None where ``slide`` is "off"."""
        return self._outcome.sliding

    @property
    def backend(self) -> str:
        """Who made the sweeps: "cpu" or "cuda"."""
        return self._outcome.backend

    @property
    def device(self) -> str:
        """The processor or the GPU by its name."""
        return self._outcome.device

    @property
    def threads(self) -> int:
        """Threads of the CPU that made the sweeps; 0 where a device did."""
        return self._outcome.threads

    @property
    def device_memory_bytes(self) -> int:
        """The most memory of a device that was taken at a time, beside the caller's arrays."""
        return self._outcome.device_memory_bytes

    @property
    def reproducible(self) -> bool:
        """False for ``order="unordered"`` alone."""
        return self._outcome.reproducible

    @property
    def note(self) -> str:
        """Why a backend was taken that one may not have expected; or empty."""
        return self._outcome.note

    @property
    def timings(self) -> Dict[str, float]:
        """Milliseconds of the parts: prepare, transfer_in, untangle, smooth, transfer_out, guard."""
        return self._outcome.timings

    def plot(self, **options: Any) -> Figure:
        """Draws the mesh before and after, coloured by shape, and the histogram of shapes. Needs matplotlib.

        See :func:`trismooth.plot` for the options.
        """
        from ._plot import plot

        return plot(self, **options)

    def view(self, **options: Any) -> View:
        """The page that shows the mesh before and after, zoomed, panned and coloured by any metric.

        It is the view of the program's HTML report: elements are clicked for their metrics, a slider leads from before
        to after, held vertices and moves are switched on. It needs no network. Where the input points are not there, as
        of a mesh that was smoothed in place, there is only one state, and a warning; of a mesh that was read from a file
        both are there, with its regions and what held its vertices, unless others are given. ``view().html`` is the
        page, ``view().save(file)`` writes it.

        Parameters
        ----------
        regions : array of M labels, optional
            Of the elements; borders between different labels are drawn as lines.
        fixed : array of N bool, or of vertex numbers, optional
            The vertices that were held, beside those that the mesh itself holds.
        title : str, optional
            Of the page.
        threads : int, optional
            To make the page with. Default: all.

        Raises
        ------
        ValueError
            For a mesh without elements, and labels of another number than the elements.
        """
        from ._show import view

        return view(self, **options)

    def _page(self, title: str, regions: Any, fixed: Any, threads: int) -> str:
        from ._show import page_of_arrays

        return page_of_arrays(self, title, regions, fixed, threads)

    def show(self, **options: Any) -> Optional[View]:
        """Shows the mesh before and after: in Jupyter as the value of a cell, elsewhere in the browser.

        See :meth:`view` for the options, and for a page to keep. In Jupyter the view is returned, which shows it; a
        script gets None, and a warning where there is no browser.
        """
        from ._show import show

        return show(self, **options)

    def _moves(self) -> str:
        if self.moved == 0 and had_no_time(self._outcome):
            return "no vertex moved"  # those that are free may not have been counted
        return f"{free_moved(self)} of {self.free_vertices} free vertices moved"

    def __str__(self) -> str:
        lines = f"{self._moves()} in {self.sweeps} sweep{'' if self.sweeps == 1 else 's'}; stopped by {self.stop_reason}"
        if self.sliding is not None:
            lines += f"\n{self.sliding}"
        return f"{lines}\n\n{self._outcome.summary()}" if self.has_quality else lines

    def __repr__(self) -> str:
        shapes = ""
        if self.has_quality:
            before, after = self.before["shape"], self.after["shape"]
            shapes = f", smallest shape {before.min:.4g} -> {after.min:.4g}, mean {before.mean:.4g} -> {after.mean:.4g}"
        slid = "" if self.sliding is None else f", {self.sliding.slid} of {self.sliding.vertices} on lines slid"
        return (
            f"<trismooth.Result: {self._moves()}{slid}, {self.sweeps} sweeps, {self.stop_reason}{shapes}>"
        )

    def _repr_html_(self) -> str:
        from ._html import result_html

        return result_html(self)
