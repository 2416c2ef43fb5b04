"""What adapters make of a mesh, and what they have in common."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any, Callable, Optional

import numpy as np

from .. import _core
from .._repeats import find_repeats


@dataclass
class FlatMesh:
    """A mesh as plain arrays: what :func:`trismooth.smooth` takes.

    Attributes
    ----------
    points : ndarray, shape (N, 2) or (N, 3)
        Coordinates, in the precision of the mesh.
    triangles : ndarray of int, shape (M, 3) or (M, 6)
        Corners; with six nodes, then the middles of the sides 01, 12, 20.
    regions : ndarray of int, shape (M,), optional
        A label for each triangle. Vertices between two labels are held.
    fixed : ndarray of bool, shape (N,), optional
        Vertices to hold.
    other_cells : ndarray of bool, shape (N,), optional
        Vertices of cells that are not triangles. They are held, too.
    lines : ndarray of int, shape (K, 2), optional
        Where vertices may slide: edges of straight line cells, which then are not among ``other_cells``. May be empty.
    line_tags : ndarray of int, shape (K,), optional
        A number for each of them: lines that the mesh tells apart differ.
    links : ndarray of int, shape (L, 2), optional
        Likewise: pairs of vertices that are periodic.
    notes : list of str
        What the user should know of how the mesh was taken, one sentence each.
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


def float_points(points: Any) -> np.ndarray:
    """Return the points as they are if they are float32 or float64, else as float64."""
    array = np.asarray(points)
    return array if array.dtype in (np.float32, np.float64) else array.astype(np.float64)


def triangle_width(linear: int, quadratic: int) -> int:
    """Return how many nodes the triangles have that are smoothed.

    A mesh with triangles of both kinds is smoothed where it has more of them; the others are other cells.

    Parameters
    ----------
    linear, quadratic : int
        Numbers of triangles of three and of six nodes.

    Returns
    -------
    int
        3 or 6.
    """
    if linear + quadratic == 0:
        raise ValueError("points: it has no triangles")
    return 6 if quadratic > linear else 3


def triangles_of_quads(quads: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return which quadrilaterals are triangles since they repeat a corner, and these triangles, as the program has it.

    Two corners that follow each other are the same vertex, no others; of eight nodes so is the middle between them. See
    ``pipeline/input/planar_mesh.h``.

    Parameters
    ----------
    quads : ndarray of int, shape (M, 4) or (M, 8)
        Corners, then the middles of the sides 01, 12, 23 and 30.

    Returns
    -------
    ndarray of int, shape (K,), and ndarray of int, shape (K, 3) or (K, 6)
    """
    corners = quads[:, :4]
    is_next = corners == np.roll(corners, -1, axis=1)
    repeated = is_next.argmax(axis=1)[:, None]
    three = np.take_along_axis(corners, (repeated + [1, 2, 3]) % 4, axis=1)
    is_triangle = is_next.any(axis=1) & (three != np.roll(three, 1, axis=1)).all(axis=1)
    kept = np.arange(3) + (np.arange(3) > np.minimum(repeated, 2))
    triangles = np.take_along_axis(corners, kept, axis=1)
    if quads.shape[1] == 8:
        between = np.take_along_axis(quads, 4 + repeated, axis=1)
        is_triangle &= (between == np.take_along_axis(corners, repeated, axis=1))[:, 0]
        middles = np.take_along_axis(quads, 4 + np.arange(3) + (np.arange(3) >= repeated), axis=1)
        triangles = np.concatenate([triangles, middles], axis=1)
    return np.flatnonzero(is_triangle), triangles[is_triangle]


def quads_note(count: int) -> list[str]:
    """What to say of quadrilaterals that are triangles: a sentence, or none."""
    if count == 0:
        return []
    return [
        "1 quadrilateral repeats a corner: it is smoothed as the triangle that it is"
        if count == 1
        else f"{count} quadrilaterals repeat a corner: they are smoothed as the triangles that they are"
    ]


def vertices_of(nodes: Iterable[Any], count: int) -> Optional[np.ndarray]:
    """Return the mask of the vertices that any of the arrays of vertex numbers has; None if there are none."""
    mask = np.zeros(count, dtype=bool)
    for array in nodes:
        numbers = np.asarray(array, dtype=np.int64).ravel()
        outside = numbers[(numbers < 0) | (numbers >= count)]
        if outside.size > 0:
            raise ValueError(f"points: a cell names vertex {outside[0]} of {count}")
        mask[numbers] = True
    return mask if mask.any() else None


def vertex_mask(value: Any, count: int, argument: str = "fixed") -> np.ndarray:
    """Return a mask of vertices, given as such or as vertex numbers.

    Parameters
    ----------
    value : array_like
        Mask of shape (count,), or vertex numbers.
    count : int
        Number of vertices.
    argument : str
        Name of the argument, for errors.

    Returns
    -------
    ndarray of bool, shape (count,)
    """
    array = np.asarray(value)
    if array.dtype == bool:
        if array.shape != (count,):
            raise ValueError(f"{argument}: the mask has shape {array.shape}, the mesh has {count} vertices")
        return array
    if array.size > 0 and array.dtype.kind not in "iu":
        raise TypeError(f"{argument}: expected a mask of bool or vertex numbers, not values of type {array.dtype}")
    if array.ndim != 1:
        raise ValueError(f"{argument}: expected one dimension, not shape {array.shape}")
    return _mask_of_numbers(array.astype(np.int64), count, argument)


def _mask_of_numbers(numbers: np.ndarray, count: int, argument: str) -> np.ndarray:
    if numbers.size == 0:
        return np.zeros(count, dtype=bool)
    if numbers.min() < 0 or numbers.max() >= count:
        raise ValueError(
            f"{argument}: vertex numbers go from {numbers.min()} to {numbers.max()}, those of the mesh from 0 to "
            f"{count - 1}"
        )
    # Nobody lists two vertices over and over: this is a mask of the wrong type.
    if numbers.size == count > 2 and numbers.max() <= 1:
        raise TypeError(f"{argument}: this looks like a mask of 0 and 1; make it bool")
    mask = np.zeros(count, dtype=bool)
    mask[numbers] = True
    return mask


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


def combine_labels(arrays: Sequence[np.ndarray]) -> Optional[np.ndarray]:
    """Return labels that differ wherever those of any of the arrays do.

    Parameters
    ----------
    arrays : sequence of ndarray, shape (M,)

    Returns
    -------
    ndarray of int64, shape (M,), or None
        None if there are no arrays.
    """
    combined: Optional[np.ndarray] = None
    for array in arrays:
        numbers = number_labels(array)
        if combined is None:
            combined = numbers
        else:
            combined = number_labels(combined * (numbers.max(initial=0) + 1) + numbers)
    return combined


def labels_of_sets(sets: Iterable[np.ndarray], count: int) -> np.ndarray:
    """Return labels that differ wherever one of two triangles is in a set and the other is not.

    Takes time in proportion to the sizes of the sets, however many there are.

    Parameters
    ----------
    sets : iterable of ndarray of int
        The numbers of the triangles in each set.
    count : int
        Number of triangles.

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


def region_arrays(
    names: Iterable[str],
    values: Callable[[str], Optional[np.ndarray]],
    triangles: np.ndarray,
    vertex_count: int,
    notes: list[str],
) -> list[np.ndarray]:
    """Return the arrays that give regions, as the program judges them.

    An array of one value a cell counts by its name (``material``, ``gmsh:physical``, ``SubdomainID``, ...), or where it
    looks like regions: few whole numbers or texts that change across few edges. See ``pipeline/input/regions.h``.

    Parameters
    ----------
    names : iterable of str
        Names of the cell arrays.
    values : callable
        Returns the values of the triangles in the array of a name, of shape (M,) or (M, components); None if these are
        neither numbers nor texts.
    triangles : ndarray of int, shape (M, 3) or (M, 6)
    vertex_count : int
    notes : list of str
        Gets what the user should know: what is held by a guess, and what is not.
    """
    arrays = [(name, array) for name, array in ((name, values(name)) for name in names) if array is not None]
    judged = [(name, *_judged(array)) for name, array in arrays]
    repeats = find_repeats(triangles, vertex_count)
    if repeats is not None:
        triangles = repeats.triangles()
        judged = [
            (name, components, None if labels is None else number_labels(repeats.labels(labels)[0]), are_whole)
            for name, components, labels, are_whole in judged
        ]
    places, sentences = _core.judge_regions(triangles, vertex_count, judged)
    notes += sentences
    return [arrays[place][1] for place in places]


def _judged(values: np.ndarray) -> tuple[int, Optional[np.ndarray], bool]:
    """Return what the judge asks of an array: its components, a number for each value, whether all are whole."""
    if values.ndim != 1:
        return int(np.prod(values.shape[1:])), None, False
    is_whole = not np.issubdtype(values.dtype, np.floating) or bool(
        (np.isfinite(values) & (values == np.floor(values))).all()
    )
    return 1, number_labels(values), is_whole


def marked_points(
    names: Iterable[str],
    values: Callable[[str], Optional[np.ndarray]],
    flat: FlatMesh,
    held: Optional[np.ndarray],
) -> Optional[np.ndarray]:
    """Return the mask of the vertices inside that arrays of markers mark, as the program judges them, or None.

    An array counts by its name (``medit:ref``, ``triangle:marker``, ``vertex_markers``, ...) if it has whole numbers,
    one a point. See ``pipeline/input/marked_points.h``.

    Parameters
    ----------
    names : iterable of str
        Names of the point arrays.
    values : callable
        Returns the values of the points in the array of a name, of shape (N,) or (N, components).
    flat : FlatMesh
        The mesh, with its regions. Its notes get what the user should know.
    held : ndarray of bool, shape (N,), optional
        Vertices of lines and other cells.
    """
    arrays = []
    for name in filter(_core.is_marker_name, names):
        array = values(name)
        if array is not None and array.ndim == 1 and array.dtype.kind in "iu":
            zero = np.flatnonzero(np.unique(array) == 0)
            arrays.append((name, number_labels(array), int(zero[0]) if zero.size > 0 else -1))
    if not arrays:
        return None
    count = len(flat.points)
    vertices, sentences = _core.judge_markers(flat.triangles, count, arrays, flat.regions, held)
    flat.notes += sentences
    return vertices_of([vertices], count)


def any_mask(masks: Iterable[Optional[np.ndarray]]) -> Optional[np.ndarray]:
    """Return the mask of what is in any of the masks; None if there are none."""
    given = [mask for mask in masks if mask is not None]
    return np.asarray(np.any(given, axis=0)) if given else None


def side_names(names: Iterable[str]) -> list[str]:
    """Return the names of those cell arrays that mark named boundaries by sides, as scikit-fem writes them."""
    return [name for name in names if _core.is_side_name(name)]


def marked_sides(arrays: Sequence[np.ndarray], triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the sides that arrays of named boundaries mark, and a number for each: sides of other boundaries differ.

    Parameters
    ----------
    arrays : sequence of ndarray, shape (M,)
        Bits 1, 2 and 4 of a value are the sides 01, 12 and 02 of the triangle.
    triangles : ndarray of int, shape (M, 3) or (M, 6)

    Returns
    -------
    ndarray of int64, shape (K, 2), and ndarray of int64, shape (K,)
    """
    sides, of_array = [np.empty((0, 2), dtype=np.int64)], [np.empty(0, dtype=np.int64)]
    for number, array in enumerate(arrays):
        bits = array.astype(np.int64)
        for bit, ends in enumerate(((0, 1), (1, 2), (0, 2))):
            sides.append(np.sort(triangles[(bits >> bit) & 1 == 1][:, ends], axis=1))
            of_array.append(np.full(len(sides[-1]), number))
    unique, numbers = np.unique(np.concatenate(sides), axis=0, return_inverse=True)
    # NumPy 2.0.0 gives the numbers another shape.
    numbers, owners = numbers.reshape(-1), np.concatenate(of_array)
    members = (np.unique(numbers[owners == number]) for number in range(len(arrays)))
    return unique, labels_of_sets(members, len(unique))


def with_sides(
    lines: np.ndarray, line_tags: Optional[np.ndarray], sides: np.ndarray, side_tags: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return lines and sides of named boundaries as lines to slide on, with tags that tell them apart.

    Parameters
    ----------
    lines, sides : ndarray of int, shapes (K, 2) and (L, 2)
    line_tags, side_tags : ndarray of int, shapes (K,) and (L,)
        From 0; None: all lines are alike.
    """
    tags = np.zeros(len(lines), dtype=np.int64) if line_tags is None else line_tags
    return np.concatenate([lines, sides]), np.concatenate([tags, side_tags + tags.max(initial=-1) + 1])


def tags_of_lines(
    names: Iterable[str], regions: Any, values: Callable[[str], Optional[np.ndarray]]
) -> Optional[np.ndarray]:
    """Return numbers that differ where cell arrays tell lines apart: those that give regions, by their names or because
    the user says so, and others of whole numbers that do not just number the lines.

    Parameters
    ----------
    names : iterable of str
        Names of the cell arrays.
    regions : object
        The argument ``regions``.
    values : callable
        Returns the values of the lines in the array of a name, as in :func:`region_arrays`.

    Returns
    -------
    ndarray of int64, shape (K,), or None
    """
    chosen = as_names(regions) or []
    found = []
    for name in names:
        array = values(name)
        if array is not None and array.ndim == 1 and (_core.is_region_name(name) or name in chosen or _groups(array)):
            found.append(array)
    return combine_labels(found)


def _groups(values: np.ndarray) -> bool:
    """Whether these are whole numbers, and not so many as if they numbered what they are of."""
    if not np.issubdtype(values.dtype, np.number) or not bool((values == np.floor(values)).all()):
        return False
    return 2 * len(np.unique(values)) <= len(values)


def as_names(value: Any) -> Optional[list[str]]:
    """Return the names if the value is a name or a list of names, else None."""
    if isinstance(value, str):
        return [value]
    if isinstance(value, (list, tuple)) and value and all(isinstance(name, str) for name in value):
        return list(value)
    return None


def one_value_each(values: np.ndarray, name: str) -> np.ndarray:
    """Return the values of an array that the user chose for regions; an error if it has several components."""
    if values.ndim != 1:
        raise ValueError(f"regions: the cell array '{name}' has {values.shape[1:]} values a cell; regions need one")
    return values


def no_such_name(argument: str, name: str, kind: str, names: Iterable[str]) -> ValueError:
    """Return the error for a name that the mesh does not have."""
    known = ", ".join(repr(known) for known in names) or "none"
    return ValueError(f"{argument}: the mesh has no {kind} '{name}'; it has: {known}")


def choose_regions(
    regions: Any,
    *,
    default: Callable[[], Sequence[np.ndarray]],
    named: Callable[[str], np.ndarray],
    cell_of_triangle: np.ndarray,
    cell_count: int,
) -> Optional[np.ndarray]:
    """Return the label of each triangle, as the argument ``regions`` says.

    Parameters
    ----------
    regions : None, False, str, list of str or array_like
        None: the default of the mesh's type. False: no regions. A name or names: of arrays and sets of the mesh. An
        array: a label for each triangle, or one for each cell.
    default : callable
        Returns the arrays that give regions without the user saying so.
    named : callable
        Returns the labels of the triangles under a name; raises if there is no such name.
    cell_of_triangle : ndarray of int, shape (M,)
        The number of the cell that each triangle is.
    cell_count : int
        Number of all cells.

    Returns
    -------
    ndarray of int64, shape (M,), or None
    """
    if regions is None:
        return combine_labels(default())
    if regions is False:
        return None
    names = as_names(regions)
    if names is not None:
        return combine_labels([named(name) for name in names])
    labels = np.asarray(regions)
    if labels.shape == (cell_count,):
        labels = labels[cell_of_triangle]
    if labels.shape != cell_of_triangle.shape:
        cells = f" or {cell_count} (cells)" if cell_count != len(cell_of_triangle) else ""
        raise ValueError(
            f"regions: the labels have shape {labels.shape}; expected {len(cell_of_triangle)} (triangles){cells}"
        )
    return number_labels(labels)


def choose_fixed(
    fixed: Any,
    count: int,
    *,
    default: Callable[[], Optional[np.ndarray]],
    named: Callable[[str], np.ndarray],
) -> Optional[np.ndarray]:
    """Return the mask of the vertices to hold, as the argument ``fixed`` says.

    Parameters
    ----------
    fixed : None, False, str, list of str or array_like
        None: the default of the mesh's type. False: none. A name or names: of arrays and sets of the mesh. An array: a
        mask, or vertex numbers.
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


def point_array_mask(values: np.ndarray) -> np.ndarray:
    """Return which vertices an array of points marks: those where a value is not zero.

    Parameters
    ----------
    values : ndarray, shape (N,) or (N, components)
    """
    marked = np.asarray(values) != 0
    return np.asarray(marked.reshape(len(marked), -1).any(axis=1))
