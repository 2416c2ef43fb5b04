# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of meshes, coloured by shape. They need matplotlib, which is imported when one is drawn."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, List, Optional, Sequence, Tuple

import numpy as np

from . import _arrays
from ._core import QualityReport
from ._quality import quality
from ._result import Result

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.cm import ScalarMappable
    from matplotlib.figure import Figure

Window = Tuple[float, float, float, float]

# From the worst shape to the best: red to blue, which all readers can tell apart. Shapes are crowded near 1, so most of
# the scale is there. The same as in the program's pictures (pipeline/picture/colours.h).
_SCALE = [(0.0, "#b2182b"), (0.5, "#ef8a62"), (0.75, "#fddbc7"), (0.9, "#deeef6"), (1.0, "#92c5de")]
_INVERTED = "#111111"
_EDGE = "#5b6770"
_OUTLINE = "#111111"
# Of the histogram: the colours of the program's report.
_BEFORE, _AFTER = "#aeb8c4", "#2463eb"

# Lengths on paper, in points. Edges of smaller triangles would hide the colours: those have none.
_SMALLEST_WITH_EDGES = 4.0
_WIDEST_EDGE = 0.8
_GAP = 0.3
# More triangles than a vector file can sensibly hold become pixels in it.
_MOST_VECTORS = 50_000
# Straight parts of a curved side.
_PARTS_OF_SIDE = 6
# Meshes lower than this, as a part of their width, stand one above the other.
_LOW = 0.45


def plot(
    result: Result,
    *,
    regions: Any = None,
    window: Optional[Window] = None,
    figsize: Optional[Tuple[float, float]] = None,
) -> Figure:
    """Draw the mesh before and after smoothing, coloured by shape, and the histogram of shapes of both.

    Blue triangles are close to equilateral and blue quadrilaterals to squares, red ones are nearly flat, black ones are
    inverted; worse elements lie above better ones. The colours mean the same in all pictures. Where the input points are not there, as of a mesh
    that was smoothed in place, there is only "after".

    In a notebook the figure is shown where it is the last value of a cell; elsewhere by ``matplotlib.pyplot.show()``.

    Parameters
    ----------
    result : Result
        What :func:`trismooth.smooth` returned.
    regions : array of M labels, optional
        Borders between triangles of different labels are drawn as lines, as the boundary is.
    window : (left, bottom, right, top), optional
        The part of the plane to draw, in the unit of the points. The histogram is of the whole mesh.
    figsize : (width, height), optional
        Of the figure, in inches. Default: what suits the mesh.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    ImportError
        Without matplotlib.
    """
    pyplot = _pyplot()
    drawings = []
    if result.input_points is not None:
        drawings.append(_drawing("before", result.input_points, result.triangles, regions))
    drawings.append(_drawing("after", result.points, result.triangles, regions))

    left, bottom, right, top = window or _bounds(drawings)
    slope = (top - bottom) / (right - left)
    rows, columns = (len(drawings), 1) if slope < _LOW else (1, len(drawings))
    panel = _panel_size(slope, columns)
    histogram_height = 2.1
    default_size = (columns * panel[0] + 1.2, rows * (panel[1] + 0.7) + histogram_height)
    figure: Figure = pyplot.figure(figsize=figsize or default_size, layout="constrained")
    grid = figure.add_gridspec(rows + 1, columns, height_ratios=[*[panel[1] + 0.7] * rows, histogram_height])

    panels: List[Axes] = []
    for i, drawing in enumerate(drawings):
        # Zooming into one of them zooms into both.
        shared = panels[0] if panels else None
        axes = figure.add_subplot(grid[divmod(i, columns)], sharex=shared, sharey=shared)
        _draw(axes, drawing, (left, bottom, right, top), drawing.name)
        panels.append(axes)
    _draw_scale(figure, panels, any(drawing.report.inverted > 0 for drawing in drawings))
    _draw_histogram(figure.add_subplot(grid[rows, :]), drawings)
    if "inline" in pyplot.get_backend():
        # The notebook shows the value of a cell, and then every open figure: this one would be there twice.
        pyplot.close(figure)
    return figure


def show(
    points: Any,
    triangles: Any = None,
    *,
    regions: Any = None,
    window: Optional[Window] = None,
    title: Optional[str] = None,
    colorbar: bool = True,
    ax: Optional[Axes] = None,
) -> Axes:
    """Draw a mesh, coloured by shape.

    Parameters
    ----------
    points : array of floats, shape (N, 2) or (N, 3); or a mesh as for :func:`trismooth.smooth`
    triangles : array of integers, shape (M, 3), (M, 4) or (M, 6)
        As for :func:`trismooth.quality`. Sides with a node in their middle are drawn as curves; the colour is that of the corners' element.
    regions, window
        As for :func:`trismooth.plot`.
    title : str, optional
        Above the picture, and above the smallest and the mean shape of the whole mesh.
    colorbar : bool
        Whether to draw the scale.
    ax : matplotlib.axes.Axes, optional
        Where to draw. Default: in a new figure.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    ImportError
        Without matplotlib.
    """
    pyplot = _pyplot()
    if triangles is None:
        from . import _meshes

        points, triangles = _meshes.arrays_of(points)
    drawing = _drawing("", points, triangles, regions)
    window = window or _bounds([drawing])
    if ax is None:
        left, bottom, right, top = window
        width, height = _panel_size((top - bottom) / (right - left), columns=1)
        figure: Figure = pyplot.figure(figsize=(width + 1.2, height + 0.7), layout="constrained")
        ax = figure.add_subplot()
    _draw(ax, drawing, window, title or "")
    if colorbar:
        _draw_scale(ax.figure, [ax], drawing.report.inverted > 0)  # type: ignore[arg-type]
    return ax


@dataclass
class _Drawing:
    """A mesh to draw.

    Attributes
    ----------
    name : str
    sides : ndarray, shape (M, 3, K, 2) or (M, 4, K, 2)
        The points of each side of each element, from corner to corner: K is 2 of straight sides. Where there are four,
        one of a triangle has no length.
    outline : ndarray of bool, shape (M, 3) or (M, 4)
        Which sides are on the boundary, or between two regions.
    shapes : ndarray, shape (M,)
    report : QualityReport
    """

    name: str
    sides: np.ndarray
    outline: np.ndarray
    shapes: np.ndarray
    report: QualityReport


def _pyplot() -> Any:
    try:
        import matplotlib.pyplot
    except ImportError as error:
        raise ImportError("pictures need matplotlib: pip install matplotlib") from error
    return matplotlib.pyplot


def _drawing(name: str, points: Any, triangles: Any, regions: Any) -> _Drawing:
    plane = _on_host(points, "points")[:, :2].astype(np.float64, copy=False)
    nodes = _on_host(triangles, "triangles")
    if len(nodes) == 0:
        raise ValueError("triangles: there are none to draw")
    measured = quality(plane, nodes)
    labels = np.zeros(len(nodes), dtype=np.int64)
    if regions is not None:
        labels = np.unique(_on_host(regions, "regions"), return_inverse=True)[1].reshape(-1)
        if len(labels) != len(nodes):
            raise ValueError(f"regions: {len(labels)} labels for {len(nodes)} triangles")
    corners = _corners(nodes)
    return _Drawing(name, _sides(plane, nodes, corners), _outline(corners, labels), measured.shape, measured.summary)


def _on_host(array: Any, argument: str) -> np.ndarray:
    if _arrays.device_of(array) is not None:
        from . import _device

        return np.asarray(_device.to_host(array))
    return _arrays.on_host(array, argument)


def _corners(nodes: np.ndarray) -> np.ndarray:
    """Return the corners of each element: where there are four of each, the third of a triangle twice."""
    if nodes.shape[1] in (3, 6):
        return nodes[:, :3]
    numbers = _arrays.element_nodes(nodes)
    corners: np.ndarray = numbers[:, :4].copy()
    is_triangle = _arrays.corner_counts(numbers) == 3
    corners[is_triangle, 3] = corners[is_triangle, 2]
    return corners


def _sides(points: np.ndarray, nodes: np.ndarray, corner_nodes: np.ndarray) -> np.ndarray:
    """Return the points of each side of each element, from corner to corner."""
    corners = points[corner_nodes]
    ends = np.roll(corners, -1, axis=1)
    if nodes.shape[1] < 6:
        return np.stack([corners, ends], axis=2)
    middles = (corners + ends) / 2
    numbers = _arrays.element_nodes(nodes)
    counts = (numbers >= 0).sum(axis=1)
    # (Where there are four corners of each, the third side of a triangle of six nodes is the last.)
    for count in np.intersect1d(counts, (6, 8, 9)):
        rows = np.flatnonzero(counts == count)
        first = 3 if count == 6 else 4
        sides = [*range(first)] if count > 6 else [0, 1, corner_nodes.shape[1] - 1]
        middles[np.ix_(rows, sides)] = points[numbers[rows, first : 2 * first]]
    # The quadratic curve through corner, middle and corner.
    t = np.linspace(0, 1, _PARTS_OF_SIDE + 1)[:, None]
    corners, middles, ends = corners[:, :, None], middles[:, :, None], ends[:, :, None]
    curves: np.ndarray = corners * ((1 - t) * (1 - 2 * t)) + middles * (4 * t * (1 - t)) + ends * (t * (2 * t - 1))
    return curves


def _outline(corners: np.ndarray, labels: np.ndarray) -> np.ndarray:
    """Return which sides are on the boundary or between two labels, as a mask of the shape of the corners."""
    ends = np.stack([corners, np.roll(corners, -1, axis=1)], axis=2).reshape(-1, 2).astype(np.int64)
    keys = ends.min(axis=1) * (ends.max() + 1) + ends.max(axis=1)
    order = np.argsort(keys, kind="stable")
    label = np.repeat(labels, corners.shape[1])[order]
    has_equal_neighbour = (keys[order][1:] == keys[order][:-1]) & (label[1:] == label[:-1])
    inner = ends[:, 0] == ends[:, 1]
    inner[order[1:]] |= has_equal_neighbour
    inner[order[:-1]] |= has_equal_neighbour
    outer: np.ndarray = ~inner.reshape(corners.shape)
    return outer


def _bounds(drawings: Sequence[_Drawing]) -> Window:
    """Return what the triangles cover, with a margin. Vertices that no triangle has are left out."""
    low = np.min([drawing.sides.min(axis=(0, 1, 2)) for drawing in drawings], axis=0)
    high = np.max([drawing.sides.max(axis=(0, 1, 2)) for drawing in drawings], axis=0)
    margin = 0.02 * float((high - low).max()) or 1.0
    return (low[0] - margin, low[1] - margin, high[0] + margin, high[1] + margin)


def _panel_size(slope: float, columns: int) -> Tuple[float, float]:
    """Return width and height of a mesh on paper, in inches. ``slope`` is its height over its width."""
    widest = 5.0 if columns == 2 else 8.0 if slope < _LOW else 6.0
    width = min(widest, 6.5 / slope)
    # Very long meshes keep some height: room is better than a line.
    return max(width, 3.2), max(width * slope, 0.8)


def _colours() -> ScalarMappable:
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import LinearSegmentedColormap, Normalize

    scale = LinearSegmentedColormap.from_list("trismooth", _SCALE).with_extremes(under=_INVERTED)
    return ScalarMappable(Normalize(0, 1), scale)


def _draw(axes: Axes, drawing: _Drawing, window: Window, title: str) -> None:
    from matplotlib.collections import LineCollection, PolyCollection

    left, bottom, right, top = window
    axes.set_xlim(left, right)
    axes.set_ylim(bottom, top)
    axes.set_aspect("equal")
    low, high = drawing.sides.min(axis=(1, 2)), drawing.sides.max(axis=(1, 2))
    seen = np.flatnonzero(((high > (left, bottom)) & (low < (right, top))).all(axis=1))
    seen = seen[np.argsort(-drawing.shapes[seen], kind="stable")]

    colours = _colours().to_rgba(drawing.shapes[seen])
    sizes = (high - low)[seen].max(axis=1) * _points_per_unit(axes, window)
    has_edges = sizes >= _SMALLEST_WITH_EDGES
    edges = np.where(has_edges[:, None], _rgba(_EDGE), colours)
    # Without edges a thin one of the triangle's own colour closes the gap that is seen between two neighbours.
    widths = np.where(has_edges, np.clip(0.04 * sizes, 0.1, _WIDEST_EDGE), _GAP) if has_edges.any() else _GAP
    many = len(seen) > _MOST_VECTORS
    # An array is drawn faster than the sequence of polygons that matplotlib's types ask for.
    polygons: Any = drawing.sides[seen, :, :-1].reshape(len(seen), -1, 2)
    axes.add_collection(
        PolyCollection(polygons, facecolors=colours, edgecolors=edges, linewidths=widths, rasterized=many),
        autolim=False,
    )
    lines = drawing.sides[seen][drawing.outline[seen]]
    axes.add_collection(
        LineCollection(lines, colors=_OUTLINE, linewidths=0.9, capstyle="round", zorder=2, rasterized=many),
        autolim=False,
    )
    _decorate(axes, drawing.report, title)


def _rgba(colour: str) -> Tuple[float, float, float, float]:
    from matplotlib.colors import to_rgba

    return to_rgba(colour)


def _points_per_unit(axes: Axes, window: Window) -> float:
    """Return how long on paper, in points, a unit of the mesh is: about, for the layout is not made yet."""
    left, bottom, right, top = window
    size = axes.get_window_extent()
    return min(size.width / (right - left), size.height / (top - bottom)) * 72 / axes.figure.dpi


def _decorate(axes: Axes, report: QualityReport, title: str) -> None:
    shape = report["shape"]
    words = f"shape: smallest {shape.min:.4g}, mean {shape.mean:.4g}"
    if report.inverted > 0:
        words += f"; {report.inverted:,} inverted"
    axes.text(0, 1.01, words, transform=axes.transAxes, fontsize=9, va="bottom", ha="left")
    if title:
        axes.set_title(title, loc="left", fontsize=12, fontweight="bold", pad=18)
    axes.tick_params(labelsize=8, length=3)
    axes.locator_params(nbins=5)
    for spine in axes.spines.values():
        spine.set_visible(False)


def _draw_scale(figure: Figure, panels: Sequence[Axes], any_inverted: bool) -> None:
    bar = figure.colorbar(
        _colours(),
        ax=panels,
        ticks=[0, 0.25, 0.5, 0.75, 1],
        extend="min" if any_inverted else "neither",
        aspect=30,
        pad=0.02,
        label="shape (black: inverted)" if any_inverted else "shape",
    )
    bar.ax.tick_params(labelsize=8)
    bar.outline.set_visible(False)


def _draw_histogram(axes: Axes, drawings: Sequence[_Drawing]) -> None:
    """Draw how many elements have which shape. Inverted ones have a place of their own, left of 0."""
    from matplotlib.ticker import NullLocator, StrMethodFormatter

    any_inverted = any(drawing.report.inverted > 0 for drawing in drawings)
    bins = len(drawings[0].report.histogram)
    width = 0.86 / bins / len(drawings)
    for i, drawing in enumerate(drawings):
        counts = [drawing.report.inverted, *drawing.report.histogram]
        places = (np.arange(-1, bins) + 0.07) / bins + i * width
        colour = _BEFORE if drawing.name == "before" else _AFTER
        axes.bar(places, counts, width, align="edge", color=colour, label=drawing.name)
    # Logarithmic, with a place for 0 half a decade below 1: one triangle is seen beside a million.
    axes.set_yscale("symlog", linthresh=1, linscale=0.5)
    largest = max(max(drawing.report.inverted, *drawing.report.histogram) for drawing in drawings)
    axes.set_ylim(0, 10.0 ** max(1, np.ceil(np.log10(largest))))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_major_formatter(StrMethodFormatter("{x:,.0f}"))
    axes.yaxis.grid(True, color="#808080", alpha=0.25, linewidth=0.8)
    axes.set_axisbelow(True)
    ticks, labels = list(np.linspace(0, 1, 11)), [f"{tick:.1f}" for tick in np.linspace(0, 1, 11)]
    if any_inverted:
        ticks, labels = [-0.5 / bins, *ticks[1:]], ["< 0", *labels[1:]]
    axes.set_xticks(ticks, labels)
    axes.set_xlim(-1 / bins if any_inverted else 0, 1)
    axes.set_xlabel("shape", fontsize=9)
    has_quadrilaterals = drawings[0].report.quadrilaterals > 0
    axes.set_ylabel("elements" if has_quadrilaterals else "triangles", fontsize=9)
    axes.tick_params(labelsize=8, length=0)
    for side in ("left", "right", "top"):
        axes.spines[side].set_visible(False)
    if len(drawings) > 1:
        axes.legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=2, frameon=False, fontsize=9, borderaxespad=0.2)
