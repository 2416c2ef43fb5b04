# SPDX-License-Identifier: BSD-3-Clause
"""What adapters make of a mesh, and what they have in common.

What a mesh means is the program's business: :func:`flat_mesh` hands cells and arrays to it, as a file would. Adapters of
meshes that say themselves what their regions are make a :class:`FlatMesh` of their own.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Callable, Optional

import numpy as np

from .. import _arrays, _core
from .._notes import of_mesh


@dataclass
class FlatMesh:
    """A mesh as plain arrays: what :func:`trismooth.smooth` takes.

    Attributes
    ----------
    points : ndarray, shape (N, 2) or (N, 3)
        Coordinates, in the precision of the mesh.
    triangles : ndarray of int, shape (M, 3), (M, 4), (M, 6) or (M, 9)
        Corners of the elements: triangles, or with four quadrilaterals too, and -1 in the last place of a triangle. With
        six nodes triangles, corners and then the middles of the sides 01, 12, 20; with nine elements of any number of
        nodes, -1 behind them.
    regions : ndarray of int, shape (M,), optional
        A label for each element. Vertices between two labels are held.
    fixed : ndarray of bool, shape (N,), optional
        Vertices to hold.
    other_cells : ndarray of bool, shape (N,), optional
        Vertices of cells that are no elements. They are held, too.
    lines : ndarray of int, shape (K, 2), optional
        Where vertices may slide: edges of straight line cells, which then are not among ``other_cells``. May be empty.
    line_tags : ndarray of int, shape (K,), optional
        A number for each of them: lines that the mesh tells apart differ.
    links : ndarray of int, shape (L, 2), optional
        Likewise: pairs of vertices that are periodic.
    notes : list of str
        What the user should know of how the mesh was taken, one sentence each.
    line_notes : list of str
        The same of ``lines``, where these are used.
    """

    points: np.ndarray
    triangles: np.ndarray
    regions: Optional[np.ndarray] = None
    fixed: Optional[np.ndarray] = None
    other_cells: Optional[np.ndarray] = None
    lines: Optional[np.ndarray] = None
    line_tags: Optional[np.ndarray] = None
    links: Optional[np.ndarray] = None
    notes: list[str] = field(default_factory=list)
    line_notes: list[str] = field(default_factory=list)


@dataclass
class Cells:
    """The cells of a mesh, in its order: VTK's number for the type of each, its number of nodes, and the nodes of all,
    one cell after the other."""

    types: np.ndarray
    sizes: np.ndarray
    nodes: np.ndarray


Arrays = Iterable[tuple[str, Any]]


def flat_mesh(
    points: np.ndarray,
    cells: Cells,
    *,
    cell_data: Arrays = (),
    point_data: Arrays = (),
    cell_sets: Mapping[str, np.ndarray] = {},
    point_sets: Arrays = (),
    implied_sets: Arrays = (),
    regions: Any = None,
    fixed: Any = None,
    lines: bool = False,
) -> FlatMesh:
    """Return a mesh as plain arrays, taken as the program takes the same from a file (``pipeline/input``).

    Parameters
    ----------
    points : ndarray, shape (N, 2) or (N, 3)
    cells : Cells
    cell_data, point_data : iterable of (str, array_like)
        Arrays with a row for each cell or point. Numbers or texts; others are left out.
    cell_sets : mapping of str to ndarray of int
        Numbers of cells. What is between two sets is held, and lines of different sets differ.
    point_sets, implied_sets : iterable of (str, ndarray of int)
        Numbers of points: of sets, and of what the mesh tells to be bound otherwise, as nodes of curves.
    regions, fixed, lines
        As in the adapters' ``flatten``.
    """
    names = as_names(regions)
    named_sets = list(cell_sets) if regions is None else [name for name in names or [] if name in cell_sets]
    named_arrays = [name for name in names or [] if name not in cell_sets]
    names_of_fixed = as_names(fixed)
    try:
        found = _core.flat_mesh(
            len(points),
            cells.types,
            cells.sizes,
            cells.nodes,
            list(_judged(cell_data)),
            [(name, values) for name, values in _judged(point_data) if not isinstance(values, list)],
            list(point_sets),
            list(implied_sets),
            None if regions is None else named_arrays or False,
            None if fixed is None else names_of_fixed or False,
            lines,
        )
    except ValueError as error:
        known = f"; its cell sets: {', '.join(cell_sets)}" if cell_sets and str(error).startswith("regions: ") else ""
        raise type(error)(of_mesh(str(error)) + known) from None
    flat = FlatMesh(points, found["triangles"], other_cells=found["other_cells"])
    flat.notes, flat.line_notes = (list(map(of_mesh, found[notes])) for notes in ("notes", "line_notes"))
    of_triangle = found["cell_of_triangle"]
    of_sets = labels_of_sets([cell_sets[name] for name in named_sets], len(cells.types)) if named_sets else None
    if regions is not None and regions is not False and names is None:
        flat.regions = choose_labels(regions, of_triangle, len(cells.types))
    else:
        flat.regions = _labels_with_sets(found["regions"], of_sets, of_triangle)
    if fixed is not None and fixed is not False and names_of_fixed is None:
        flat.fixed = vertex_mask(fixed, len(points))
    else:
        flat.fixed = found["fixed"]
    if lines:
        of_all_sets = labels_of_sets(cell_sets.values(), len(cells.types)) if cell_sets else None
        flat.lines = found["lines"]
        flat.line_tags = _labels_with_sets(found["line_tags"], of_all_sets, found["cell_of_line"])
    return flat


def _labels_with_sets(
    labels: Optional[np.ndarray], of_sets: Optional[np.ndarray], cell_of: np.ndarray
) -> Optional[np.ndarray]:
    """Labels that differ wherever these or those of the cells by their sets do."""
    return labels if of_sets is None else combine_labels([labels, of_sets[cell_of]])


def _judged(arrays: Arrays) -> Iterable[tuple[str, Any]]:
    """The arrays as the compiled part takes them: numbers one behind the other, or a list of texts."""
    for name, given in arrays:
        values = np.asarray(given)
        if values.dtype.kind in "USO" and values.ndim == 1:
            yield name, list(map(str, values))
        elif values.dtype.kind in "biuf" and values.ndim > 0 and 0 not in values.shape[1:]:
            kind = values.dtype if values.dtype.kind != "f" or values.dtype.itemsize in (4, 8) else np.dtype(np.float64)
            yield name, np.ascontiguousarray(values, dtype=kind.newbyteorder("="))


def float_points(points: Any) -> np.ndarray:
    """Return the points as they are if they are float32 or float64, else as float64."""
    array = np.asarray(points)
    return array if array.dtype in (np.float32, np.float64) else array.astype(np.float64)


def vertex_mask(value: Any, count: int, argument: str = "fixed") -> np.ndarray:
    """Return a mask of vertices, given as such or as vertex numbers. Errors begin with the argument's name."""
    return _core.vertex_mask(_arrays.on_host(value, argument), argument, count)


def number_labels(labels: np.ndarray) -> np.ndarray:
    """Return numbers from 0, the same for the same label. Labels may have any type.

    Parameters
    ----------
    labels : ndarray, shape (M,)

    Returns
    -------
    ndarray of int64, shape (M,)
    """
    if labels.dtype == object:
        labels = labels.astype(str)
    # NumPy 2.0.0 gives the numbers the shape of a column.
    return np.unique(labels, return_inverse=True)[1].reshape(-1).astype(np.int64, copy=False)


def combine_labels(arrays: Sequence[Optional[np.ndarray]]) -> Optional[np.ndarray]:
    """Return labels that differ wherever those of any of the arrays do.

    Parameters
    ----------
    arrays : sequence of ndarray, shape (M,), or None
        None: no labels.

    Returns
    -------
    ndarray of int64, shape (M,), or None
        None if there are no arrays.
    """
    combined: Optional[np.ndarray] = None
    for array in arrays:
        if array is None:
            continue
        numbers = number_labels(array)
        if combined is None:
            combined = numbers
        else:
            combined = number_labels(combined * (numbers.max(initial=0) + 1) + numbers)
    return combined


def labels_of_sets(sets: Iterable[np.ndarray], count: int) -> np.ndarray:
    """Return labels that differ wherever one of two cells is in a set and the other is not.

    Takes time in proportion to the sizes of the sets, however many there are.

    Parameters
    ----------
    sets : iterable of ndarray of int
        The numbers of the cells in each set.
    count : int
        Number of cells.

    Returns
    -------
    ndarray of int64, shape (count,)
    """
    labels = np.zeros(count, dtype=np.int64)
    next_label = 1
    for members in sets:
        if len(members) > 0:
            # Those of one label before this set get another label, the same for all of them.
            numbers = number_labels(labels[members])
            labels[members] = next_label + numbers
            next_label += int(numbers.max()) + 1
    return labels


def as_names(value: Any) -> Optional[list[str]]:
    """Return the names if the value is a name or a list of names, else None."""
    if isinstance(value, str):
        return [value]
    if isinstance(value, (list, tuple)) and value and all(isinstance(name, str) for name in value):
        return list(value)
    return None


def no_such_name(argument: str, name: str, kind: str, names: Iterable[str]) -> ValueError:
    """Return the error for a name that the mesh does not have."""
    known = ", ".join(repr(known) for known in names) or "none"
    return ValueError(f"{argument}: the mesh has no {kind} '{name}'; it has: {known}")


def choose_labels(regions: Any, cell_of_triangle: np.ndarray, cell_count: int) -> np.ndarray:
    """Return the label of each triangle, of an array with a label for each triangle or for each cell.

    Parameters
    ----------
    regions : array_like
    cell_of_triangle : ndarray of int, shape (M,)
        The number of the cell that each triangle is.
    cell_count : int
        Number of all cells.

    Returns
    -------
    ndarray of int64, shape (M,)
    """
    labels = np.asarray(regions)
    if labels.shape == (cell_count,):
        labels = labels[cell_of_triangle]
    if labels.shape != cell_of_triangle.shape:
        cells = f" or {cell_count} (cells)" if cell_count != len(cell_of_triangle) else ""
        raise ValueError(
            f"regions: the labels have shape {labels.shape}; expected {len(cell_of_triangle)} (triangles){cells}"
        )
    return number_labels(labels)


def choose_regions(
    regions: Any, cell_count: int, *, default: Callable[[], Optional[np.ndarray]], named: Callable[[str], np.ndarray]
) -> Optional[np.ndarray]:
    """Return the label of each triangle of a mesh that has no other cells, as the argument ``regions`` says.

    Parameters
    ----------
    regions : None, False, str, list of str or array_like
        None: the default of the mesh's type. False: no regions. A name or names: of sets of the mesh. An array: a label
        for each triangle.
    cell_count : int
        Number of the triangles.
    default : callable
        Returns the labels that the mesh gives without the user saying so.
    named : callable
        Returns the labels under a name; raises if there is no such name.

    Returns
    -------
    ndarray of int64, shape (M,), or None
    """
    if regions is None:
        return default()
    if regions is False:
        return None
    names = as_names(regions)
    if names is not None:
        return combine_labels([named(name) for name in names])
    return choose_labels(regions, np.arange(cell_count), cell_count)


def choose_fixed(
    fixed: Any, count: int, *, default: Callable[[], Optional[np.ndarray]], named: Callable[[str], np.ndarray]
) -> Optional[np.ndarray]:
    """Return the mask of the vertices to hold, as the argument ``fixed`` says.

    Parameters
    ----------
    fixed : None, False, str, list of str or array_like
        None: the default of the mesh's type. False: none. A name or names: of sets of the mesh. An array: a mask, or
        vertex numbers.
    count : int
        Number of vertices.
    default, named : callable
        As in :func:`choose_regions`, but they return masks of vertices.

    Returns
    -------
    ndarray of bool, shape (count,), or None
    """
    if fixed is None:
        return default()
    if fixed is False:
        return None
    names = as_names(fixed)
    if names is not None:
        return np.asarray(np.any([named(name) for name in names], axis=0))
    return vertex_mask(fixed, count)


def nothing_named(argument: str, mesh: str) -> Callable[[str], np.ndarray]:
    """Return what to do about a name where the mesh's type has no named arrays: raise an error that says so."""

    def refuse(name: str) -> np.ndarray:
        raise TypeError(f"{argument}: {mesh} has no array '{name}'; give an array")

    return refuse
