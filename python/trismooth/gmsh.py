"""Smoothing of the current model of Gmsh's Python interface."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Optional

import numpy as np

from ._constraints import slides
from ._notes import warn_of
from .adapters.flat import quads_note, triangle_width, triangles_of_quads, vertices_of

if TYPE_CHECKING:
    from . import Result

__all__ = ["smooth"]

# Numbers of Gmsh for types of elements, of quadrangles with how many nodes they have. Gmsh lists nodes as VTK does.
_LINE = 1
_TRIANGLE = 2
_QUADRATIC_TRIANGLE = 9
_QUADS = {3: 4, 16: 8}

# How far nodes may be from a plane z = const, as a part of the mesh's size: the tolerance of the command-line program.
_FLATNESS = 1e-6


def smooth(*, fixed: Any = None, slide: str = "off", **options: Any) -> Result:
    """Smooth the triangles of the current model, in place.

    Nodes that Gmsh classifies on surfaces move: those inside of them. Nodes on curves and points are held, also where
    these are embedded in a surface, and so are the borders between surfaces. Nodes of quadrangles and of other elements
    that are no triangles are held, too, and nodes that are linked as periodic; a quadrangle that repeats a corner is a
    triangle. Where they have parametric coordinates on their surface, moved nodes get those of the new place.

    With ``slide`` nodes inside of curves slide along the line elements of their curve; nodes on points stay. Nodes that
    are linked as periodic on two curves slide together. Moved nodes are on the edges of the mesh as it was, not on the
    curve of the geometry; ``deviation`` bounds how far they are from where these were.

    Surfaces are the regions of the result's reports. Physical groups make no difference: what is between them is on
    curves.

    Parameters
    ----------
    fixed : array_like of int, optional
        Tags of further nodes to hold.
    slide, **options
        Those of :func:`trismooth.smooth`, without ``regions``, ``other_cells``, ``lines``, ``line_tags``, ``links``,
        ``out`` and ``inplace``.

    Returns
    -------
    Result
        What :func:`trismooth.smooth` returns for the arrays of the model: ``points`` has a row for each node, in the
        order of ``gmsh.model.mesh.getNodes()``.

    Raises
    ------
    RuntimeError
        If Gmsh is not initialized.
    ValueError
        If the model has no triangles, or its surfaces do not lie in one plane z = const.
    """
    import gmsh

    import trismooth

    if not gmsh.isInitialized():
        raise RuntimeError("gmsh is not initialized: call gmsh.initialize() and make or open a mesh first")
    for name in ("regions", "other_cells", "lines", "line_tags", "links", "out", "inplace"):
        if name in options:
            raise TypeError(f"{name}: is for arrays and meshes; here the model has it all")
    nodes = _nodes_of_model(gmsh)
    surfaces = _entities(gmsh, nodes, 2)
    curves = _entities(gmsh, nodes, 1) if slides(slide) else []
    elements = _elements_of(gmsh, nodes, surfaces, curves)
    held = _held_nodes(nodes, surfaces, curves, elements.lines, fixed)
    _check_plane(nodes, elements.triangles)
    model = gmsh.model.getCurrent()
    warn_of(elements.notes)
    result = trismooth.smooth(
        np.ascontiguousarray(nodes.points[:, :2]),
        elements.triangles,
        regions=elements.regions,
        fixed=held,
        other_cells=elements.other_nodes,
        slide=slide,
        lines=elements.lines,
        line_tags=elements.line_tags,
        links=np.concatenate([curve.periodic_nodes for curve in curves]) if curves else None,
        **options,
    )
    current = gmsh.model.getCurrent()  # the caller's progress may have changed it
    gmsh.model.setCurrent(model)
    result.notes = [*elements.notes, *result.notes]
    _move_nodes(gmsh, nodes, [*surfaces, *curves], np.asarray(result.points))
    gmsh.model.setCurrent(current)
    return result


@dataclass
class _Nodes:
    """The nodes of a model. Tags are any numbers; all else counts nodes from 0, in this order."""

    tags: np.ndarray
    points: np.ndarray
    order: np.ndarray

    def numbers(self, tags: Any) -> np.ndarray:
        """Return the numbers of the nodes with these tags, which must be there."""
        return self.order[np.searchsorted(self.tags, np.asarray(tags), sorter=self.order)]

    def has(self, tags: Any) -> np.ndarray:
        return np.isin(np.asarray(tags), self.tags)


@dataclass
class _Entity:
    """A surface or curve of a model, the nodes inside of it, whether these have parametric coordinates, and the pairs
    of nodes that link it to another one as periodic."""

    dimension: int
    tag: int
    nodes: np.ndarray
    is_parametric: bool
    periodic_nodes: np.ndarray


@dataclass
class _Elements:
    """The triangles of a model, the surface of each, the lines for nodes to slide on, the curve of each, a mask of the
    nodes of all other elements, and what the user should know of them."""

    triangles: np.ndarray
    regions: np.ndarray
    lines: np.ndarray
    line_tags: np.ndarray
    other_nodes: Optional[np.ndarray]
    notes: list[str]


def _nodes_of_model(gmsh: Any) -> _Nodes:
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    return _Nodes(tags, coordinates.reshape(-1, 3), np.argsort(tags, kind="stable"))


def _entities(gmsh: Any, nodes: _Nodes, dimension: int) -> list[_Entity]:
    entities = []
    for _, tag in gmsh.model.getEntities(dimension):
        tags, _, parameters = gmsh.model.mesh.getNodes(dimension, tag, returnParametricCoord=True)
        _, here, there, _ = gmsh.model.mesh.getPeriodicNodes(dimension, tag)
        periodic = np.column_stack([nodes.numbers(linked) for linked in (here, there)])
        is_parametric = len(parameters) == dimension * len(tags) > 0
        entities.append(_Entity(dimension, tag, nodes.numbers(tags), is_parametric, periodic))
    return entities


def _elements_of(gmsh: Any, nodes: _Nodes, surfaces: list[_Entity], curves: list[_Entity]) -> _Elements:
    """Return the elements. Lines are other elements where there are no curves."""
    triangles: dict[int, list[np.ndarray]] = {_TRIANGLE: [], _QUADRATIC_TRIANGLE: []}
    regions: dict[int, list[np.ndarray]] = {_TRIANGLE: [], _QUADRATIC_TRIANGLE: []}
    of_quads = {_TRIANGLE: 0, _QUADRATIC_TRIANGLE: 0}
    others = []
    for surface in surfaces:
        for kind, _, tags in zip(*gmsh.model.mesh.getElements(2, surface.tag)):
            numbers = nodes.numbers(tags)
            like = kind
            if kind in triangles:
                found = numbers.reshape(-1, 3 if kind == _TRIANGLE else 6)
            elif kind in _QUADS:
                quads = numbers.reshape(-1, _QUADS[kind])
                which, found = triangles_of_quads(quads)
                others.append(np.delete(quads, which, axis=0))
                like = _TRIANGLE if _QUADS[kind] == 4 else _QUADRATIC_TRIANGLE
                of_quads[like] += len(found)
            else:
                others.append(numbers)
                continue
            triangles[like].append(found)
            regions[like].append(np.full(len(found), surface.tag, dtype=np.int64))
    linear, quadratic = (sum(map(len, triangles[kind])) for kind in (_TRIANGLE, _QUADRATIC_TRIANGLE))
    if linear + quadratic == 0:
        raise ValueError("the model has no triangles of order 1 or 2: call gmsh.model.mesh.generate(2) first")
    chosen, left = (_TRIANGLE, _QUADRATIC_TRIANGLE)
    if triangle_width(linear, quadratic) == 6:
        chosen, left = left, chosen
    others += triangles[left]
    # Elements of curves and points have only nodes that are held anyway, but for meshes of unusual origin.
    for dimension in (0, 1, 3):
        for kind, _, tags in zip(*gmsh.model.mesh.getElements(dimension)):
            if not curves or kind != _LINE:
                others.append(nodes.numbers(tags))
    return _Elements(
        np.concatenate(triangles[chosen]),
        np.concatenate(regions[chosen]),
        *_lines_of(gmsh, nodes, curves),
        vertices_of(others, len(nodes.tags)),
        quads_note(of_quads[chosen]),
    )


def _lines_of(gmsh: Any, nodes: _Nodes, curves: list[_Entity]) -> tuple[np.ndarray, np.ndarray]:
    """Return the line elements of the curves, and the curve of each."""
    lines = [np.empty((0, 2), dtype=np.int64)]
    line_tags = [np.empty(0, dtype=np.int64)]
    for curve in curves:
        for kind, _, tags in zip(*gmsh.model.mesh.getElements(1, curve.tag)):
            if kind == _LINE:
                lines.append(nodes.numbers(tags).reshape(-1, 2))
                line_tags.append(np.full(len(lines[-1]), curve.tag))
    return np.concatenate(lines), np.concatenate(line_tags)


def _held_nodes(
    nodes: _Nodes, surfaces: list[_Entity], curves: list[_Entity], lines: np.ndarray, fixed: Any
) -> np.ndarray:
    """Return the mask of the nodes that are inside of no surface and on no line inside of a curve, are linked as
    periodic on surfaces, or are fixed by the user."""
    held = np.ones(len(nodes.tags), dtype=bool)
    for surface in surfaces:
        held[surface.nodes] = False
    for curve in curves:
        held[np.intersect1d(curve.nodes, lines)] = False
    for surface in surfaces:
        held[surface.periodic_nodes] = True
    if fixed is not None:
        held[_numbers_of_fixed(nodes, fixed)] = True
    return held


def _numbers_of_fixed(nodes: _Nodes, fixed: Any) -> np.ndarray:
    tags = np.asarray(fixed)
    if tags.size == 0:
        return np.empty(0, dtype=np.int64)
    if tags.dtype.kind not in "iu" or tags.ndim != 1:
        raise TypeError(f"fixed: expected tags of nodes, not values of type {tags.dtype} and shape {tags.shape}")
    known = nodes.has(tags)
    if not known.all():
        raise ValueError(f"fixed: the model has no node {tags[~known][0]}")
    return nodes.numbers(tags)


def _check_plane(nodes: _Nodes, triangles: np.ndarray) -> None:
    points = nodes.points[np.unique(triangles)]
    sizes = np.ptp(points, axis=0)
    if sizes[2] > _FLATNESS * sizes[:2].max():
        low, high = points[:, 2].min(), points[:, 2].max()
        raise ValueError(
            f"the surfaces of the model do not lie in one plane z = const: z goes from {low:g} to {high:g}; only such "
            "models can be smoothed"
        )


def _move_nodes(gmsh: Any, nodes: _Nodes, entities: list[_Entity], points: np.ndarray) -> None:
    """Move the nodes whose points differ."""
    has_moved = np.any(points != nodes.points[:, :2], axis=1)
    for entity in entities:
        moved = entity.nodes[has_moved[entity.nodes]]
        if moved.size == 0:
            continue
        places = np.column_stack([points[moved], nodes.points[moved, 2]])
        parameters = np.empty((len(moved), 0))
        if entity.is_parametric:
            parameters = gmsh.model.getParametrization(entity.dimension, entity.tag, places.reshape(-1))
            parameters = parameters.reshape(-1, entity.dimension)
        for tag, place, parameter in zip(nodes.tags[moved], places, parameters):
            gmsh.model.mesh.setNode(int(tag), place, parameter)
