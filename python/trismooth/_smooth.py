# SPDX-License-Identifier: BSD-3-Clause
"""Smoothing of arrays, and of meshes of other packages."""

from __future__ import annotations

from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple

from . import _arrays, _core
from ._constraints import Constraints
from ._core import SweepRecord
from ._notes import options_without_effect, warn_of
from ._repeats import find_repeats
from ._result import Result, notes_of

Progress = Callable[[SweepRecord], Any]

# The names of all methods.
METHODS: Tuple[str, ...] = tuple(_core.methods())


def smooth(
    points: Any,
    triangles: Any = None,
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
    out: Any = None,
    quality: Optional[bool] = None,
    progress: Optional[Progress] = None,
    **options: Any,
) -> Result:
    """Smooths a planar mesh: moves its free vertices so that triangles get closer to equilateral, and quadrilaterals to
    squares.

    Boundaries, borders of regions and what you name keep their coordinates bit for bit; with ``slide`` boundaries and
    borders keep their lines. No element that was valid becomes invalid, and none ends both worse than it was and worse
    than the worst one around the moved vertices was.
    The result is the same to the bit for every number of threads, on the CPU and on a GPU.

    Parameters
    ----------
    points : array of float64 or float32, shape (N, 2) or (N, 3)
        The vertices, of any strides. A third number is the height, and must be the same for all vertices in use. Any
        array with the buffer protocol, DLPack or ``__array__``; one on a CUDA device stays there. Or a mesh: a
        ``pyvista.PolyData`` or ``UnstructuredGrid``, a ``meshio.Mesh``, a ``skfem.MeshTri``, a mesh of FEniCSx or
        Firedrake; then ``triangles`` is left out, the smoothed mesh is ``result.mesh``, ``inplace=True`` changes the
        mesh itself, and ``regions`` and ``fixed`` may name arrays or sets of the mesh.
    triangles : array of integers, shape (M, 3), (M, 4), (M, 6) or (M, 9)
        Vertex numbers from 0, in either direction. With four, quadrilaterals are among them: the corners in turn, the
        last of a triangle is -1. Six, of arrays of the host alone, are a
        quadratic triangle: the corners, then the middles of the sides 01, 12 and 20, which follow the ends of their
        sides. Nine, likewise, are the nodes of any element of three, four, six, eight or nine, with -1 behind them:
        corners, middles of the sides, the centre, which follows the corners. One that is listed again, in whatever order,
        counts and is smoothed once; of arrays on a CUDA device list none again, for there it is not looked for.
    regions : array of M labels, optional
        Vertices between triangles of different labels are held. Labels of any type, texts as well. A triangle that is
        listed again with another label is of a region of its own, that of both labels. Of a mesh: the names
        of arrays or sets, or False for none; else its sets and those arrays that the program takes for regions, by
        their names or because they look like it.
    fixed : array of N bools, or of vertex numbers, optional
        Vertices to hold.
    other_cells : array of N bools, or of vertex numbers, optional
        Vertices of cells that are no elements, as polygons: held, and part of the mesh even where no element has them.
    size : array of N floats, optional
        The edge length wanted around each vertex, in any unit, for the method "mean-ratio": only relations count.
    slide : {"off", "straight", "curves"}
        Whether vertices of boundaries and borders of regions move along them: "straight" on stretches that are straight
        to rounding, where the line stays the same set of points; "curves" on all, as far as ``deviation`` allows.
        Elements with nodes in the middle of their sides do not slide. See docs/sliding.md.
    lines : array of integers, shape (K, 2), optional
        Edges of further lines, two vertex numbers each: their vertices are held, or slide along them. Of a mesh with
        line cells these are its lines, where vertices slide; False: it has none; an array: these in place of them.
    line_tags : array of K labels, optional
        A line ends where the label changes. Labels of any type, texts as well.
    links : array of integers, shape (L, 2), optional
        Pairs of vertices that slide as one, as those of two sides that are periodic.
    method : str, one of ``trismooth.METHODS``
        How vertices are moved. "smart" is the Smart Laplacian of the paper; "mean-ratio" gives the best elements and
        untangles inverted ones first. docs/method.md has all.
    backend : {"auto", "cpu", "cuda"}
        Who makes the sweeps. "auto": a GPU for large meshes of triangles, where the build and the machine have one.
    out : array, optional
        Where the result goes: of the shape and type of ``points``, which it may be. Left as it is where an exception is
        raised. Default: a new array.
    quality : bool, optional
        Whether ``result.before`` and ``result.after`` are computed. Default: where ``out`` is not given and ``points``
        are in memory of the host.
    progress : callable, optional
        Called with a SweepRecord after each sweep, on this thread. Returning False, or what is false but None, ends the
        smoothing: the result is a valid mesh. Ctrl-C raises KeyboardInterrupt.
    **options
        ``form`` "b" or "a"; ``guard`` True; ``untangle`` "auto", True or False; ``layers`` "auto", "keep" or "smooth" (what is
        flat on purpose: see docs/command_line.md); ``precision`` "double" or "single";
        ``max_sweeps`` 1000 (0: no limit); ``tolerance`` 1e-6; ``time_limit`` None (seconds); ``target_quality`` None
        (stop at this smallest shape); ``threads`` 0 (all); ``size_weight`` 1, ``power`` None (1 to 8) and ``target``
        "uniform" or "input-shape" of "mean-ratio"; with ``slide`` ``corner_angle`` None (30 degrees: a line that turns
        by more has a corner there, which stays), ``deviation`` None (1e-3: how far "curves" may take a line from where
        it was, in edge lengths), ``curve`` "polyline" or "spline" and ``slide_coincident`` False; ``record_min_shape``
        False; ``devices`` None (numbers of CUDA devices that share the mesh out, as [0, 1]); ``topology`` "auto", "host", "halfedge" or "device"; ``evaluation`` "changed" or "all"; and of the
        paper's versions on CUDA ``layout`` "aos" or "soa", ``execution`` "resident", "single-block" or "cdp"
        (these two with "smart" and "laplacian" only),
        ``order`` "colour" or "unordered". ``stream``: the CUDA stream of arrays on a device, else that of their
        library.

    Returns
    -------
    Result
        With ``points``, ``before``, ``after``, ``moved``, ``sliding``, ``sweeps`` and more.

    Warns
    -----
    MeshWarning
        Of what was held by a guess, left out or not mended: the sentences of ``Result.notes``.

    Raises
    ------
    TypeError, ValueError
        For an argument that does not fit; the message begins with its name.
    MeshError
        A ValueError: for triangles that are no mesh, a coordinate that is not finite, heights that differ.
    DeviceError
        Where a GPU is asked for and none can be used, or one fails.

    Examples
    --------
    >>> import numpy as np, trismooth
    >>> points = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0.9, 0.8]])
    >>> triangles = np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    >>> trismooth.smooth(points, triangles).points[4]
    array([0.5, 0.5])
    """
    options["method"] = method
    options["backend"] = backend
    options["slide"] = slide
    constraints = Constraints(regions, fixed, other_cells, size, lines, line_tags, links)
    return smoothed(points, triangles, constraints, out, quality, progress, options)


def smoothed(
    points: Any,
    triangles: Any,
    constraints: Constraints,
    out: Any,
    quality: Optional[bool],
    progress: Optional[Progress],
    options: Dict[str, Any],
    notes: Sequence[str] = (),
) -> Result:
    """smooth() of what it has gathered, with ``notes`` in front of those of the result."""
    if triangles is None:
        from . import _meshes

        return _meshes.smooth_mesh(points, constraints, out, quality, progress, options)
    if _arrays.device_of(points) is not None:
        from . import _device

        result = _device.smooth(points, triangles, constraints, out, quality, progress, options)
        result.notes += options_without_effect(options, constraints.size)
        warn_of(result.notes)
        return result
    if "inplace" in options:
        raise TypeError("inplace: is for meshes; arrays are smoothed in place by out=points")
    if "stream" in options:
        raise TypeError("stream: is for arrays on a CUDA device, and points are in memory of the host")
    numbers = _arrays.on_host(points, "points", float)
    corners = _arrays.on_host(triangles, "triangles")
    output = _arrays.Output(points, numbers, out)
    repeats = find_repeats(corners, len(numbers) if numbers.ndim == 2 else 0)
    if repeats is not None:
        corners = repeats.triangles()
        constraints = repeats.leave_out(constraints, len(numbers))
        notes = [*notes, *repeats.notes]

    def notes_with(outcome: _core.Outcome) -> List[str]:
        return [*notes, *notes_of(outcome), *options_without_effect(options, constraints.size)]

    outcome = _core.smooth(
        numbers,
        corners,
        output.numbers,
        constraints.on_host(),
        _arrays.wants_quality(quality, out is None),
        progress,
        lambda outcome: warn_of(notes_with(outcome)),
        options,
    )
    if repeats is not None:
        outcome = repeats.renumbered(outcome)
    return Result(outcome, output.delivered(), triangles, output.input_points(), notes_with(outcome))
