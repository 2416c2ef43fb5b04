# SPDX-License-Identifier: BSD-3-Clause
"""Smoothing of the current model of Gmsh's Python interface."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ._constraints import slides
from ._notes import warn_of
from .adapters.flat import Cells, FlatMesh, flat_mesh

if TYPE_CHECKING:
    from . import Result

__all__ = ["smooth"]

_LINE = 1  # Gmsh's number for the type of elements
#: VTK's for the same types, by Gmsh's: lines, triangles and quadrangles. Gmsh lists nodes as VTK does.
_VTK_TYPES = {_LINE: 3, 2: 5, 9: 22, 3: 9, 16: 23, 10: 28}
_OTHER_OF_SURFACES = 36

# How far nodes may be from a plane z = const, as a part of the mesh's size: the tolerance of the command-line program.
_FLATNESS = 1e-6


def smooth(*, fixed: Any = None, slide: str = "off", **options: Any) -> Result:
    """Smooth the triangles and quadrangles of the current model, in place.

    Nodes that Gmsh classifies on surfaces move: those inside of them. Nodes on curves and points are held, also where
    these are embedded in a surface, and so are the borders between surfaces. Nodes of elements
    that are neither triangles nor quadrangles, of order 1 or 2, are held, too, and nodes that are linked as periodic; a
    quadrangle that repeats a corner is a triangle. Where they have parametric coordinates on their surface, moved nodes get those of the new place.

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
        If the model has neither triangles nor quadrangles, or its surfaces do not lie in one plane z = const.
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
    mesh = _mesh_of(gmsh, nodes, surfaces, curves)
    held = _held_nodes(nodes, surfaces, curves, mesh, fixed)
    _check_plane(nodes, mesh.triangles)
    model = gmsh.model.getCurrent()
    notes = [*mesh.notes, *mesh.line_notes]
    warn_of(notes)
    result = trismooth.smooth(
        np.ascontiguousarray(nodes.points[:, :2]),
        mesh.triangles,
        regions=mesh.regions,
        fixed=held,
        other_cells=mesh.other_cells,
        slide=slide,
        lines=mesh.lines,
        line_tags=mesh.line_tags,
        links=np.concatenate([curve.periodic_nodes for curve in curves]) if curves else None,
        **options,
    )
    current = gmsh.model.getCurrent()  # the caller's progress may have changed it
    gmsh.model.setCurrent(model)
    result.notes = [*notes, *result.notes]
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


def _mesh_of(gmsh: Any, nodes: _Nodes, surfaces: list[_Entity], curves: list[_Entity]) -> FlatMesh:
    """Return the elements of surfaces as a mesh whose regions are the surfaces, with the line elements of the curves,
    and the nodes of all other elements among those of other cells."""
    types, sizes, numbers, entities = ([np.empty(0, dtype=np.int64)] for _ in range(4))
    is_other = np.zeros(len(nodes.tags), dtype=bool)
    for dimension in range(4):
        for _, entity in gmsh.model.getEntities(dimension):
            for kind, tags, of_nodes in zip(*gmsh.model.mesh.getElements(dimension, entity)):
                found = nodes.numbers(of_nodes)
                # Elements of curves and points have only nodes that are held anyway, but for meshes of unusual origin.
                if dimension != 2 and not (dimension == 1 and curves and kind == _LINE):
                    is_other[found] = True
                    continue
                types.append(np.full(len(tags), _VTK_TYPES.get(kind, _OTHER_OF_SURFACES)))
                sizes.append(np.full(len(tags), len(found) // len(tags)))
                numbers.append(found)
                entities.append(np.full(len(tags), entity))
    cells = Cells(*map(np.concatenate, (types, sizes, numbers)))
    if (cells.types == _VTK_TYPES[_LINE]).all():
        raise ValueError("the model has no triangles and no quadrangles of order 1 or 2: call gmsh.model.mesh.generate(2) first")
    entity_of = np.concatenate(entities)
    lines = np.flatnonzero(cells.types == _VTK_TYPES[_LINE])
    of_curves = {str(curve.tag): lines[entity_of[lines] == curve.tag] for curve in curves}
    mesh = flat_mesh(
        nodes.points, cells, cell_sets=of_curves, regions=entity_of, fixed=False, lines=bool(curves)
    )
    mesh.other_cells = is_other if mesh.other_cells is None else mesh.other_cells | is_other
    return mesh


def _held_nodes(
    nodes: _Nodes, surfaces: list[_Entity], curves: list[_Entity], mesh: FlatMesh, fixed: Any
) -> np.ndarray:
    """Return the mask of the nodes that are inside of no surface and on no line inside of a curve, are linked as
    periodic on surfaces, or are fixed by the user."""
    held = np.ones(len(nodes.tags), dtype=bool)
    for surface in surfaces:
        held[surface.nodes] = False
    if mesh.lines is not None:
        for curve in curves:
            held[np.intersect1d(curve.nodes, mesh.lines)] = False
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
