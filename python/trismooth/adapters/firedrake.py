# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of Firedrake.

They are smoothed in place: their coordinates are the values of the function ``mesh.coordinates``.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from .flat import FlatMesh, choose_fixed, choose_regions, float_points, nothing_named

SUPPORTS_COPY = False

# Firedrake lists the middles of the sides 12, 02, 01 (the order of FIAT).
_VTK_ORDER = [0, 1, 2, 5, 3, 4]


def flatten(mesh: Any, regions: Any = None, fixed: Any = None, lines: bool = False) -> FlatMesh:
    """Return the mesh as plain arrays.

    Parameters
    ----------
    mesh : firedrake.MeshGeometry
        Triangles with continuous coordinates of degree 1 or 2, on one process.
    regions : None, False or array_like
        None, False: no regions. An array: a label for each cell, in the order of ``mesh.coordinates.cell_node_map()``.
    fixed : None, False or array_like
        None, False: none. An array: a mask, or numbers of nodes of the coordinates, as in the ``nodes`` of a
        ``DirichletBC`` on the space of the coordinates.
    lines : bool
        Makes no difference: the mesh has no line cells.
    """
    _check(mesh)
    # Coordinates are complex where Firedrake is built so; their imaginary parts are 0.
    points = float_points(np.real(mesh.coordinates.dat.data_ro))
    nodes = _nodes(mesh)
    return FlatMesh(
        points,
        nodes if nodes.shape[1] == 3 else np.ascontiguousarray(nodes[:, _VTK_ORDER]),
        regions=choose_regions(
            regions, len(nodes), default=lambda: None, named=nothing_named("regions", "a Firedrake mesh")
        ),
        fixed=choose_fixed(
            fixed, len(points), default=lambda: None, named=nothing_named("fixed", "a Firedrake mesh")
        ),
    )


def with_points(mesh: Any, flat: FlatMesh, points: np.ndarray, inplace: bool) -> Any:
    """Give the mesh other points and return it."""
    if not inplace:
        raise ValueError("inplace: a Firedrake mesh can only be smoothed in place")
    mesh.coordinates.dat.data[...] = points
    mesh.clear_spatial_index()
    return mesh


def _check(mesh: Any) -> None:
    dimension = mesh.topological_dimension
    # It was a method before it was a property.
    dimension = dimension() if callable(dimension) else dimension
    if dimension != 2:
        raise TypeError(f"points: its cells have dimension {dimension}; only triangles can be smoothed")
    if mesh.comm.size > 1:
        raise ValueError(f"points: it is distributed over {mesh.comm.size} processes; smooth it on one, before that")


def _nodes(mesh: Any) -> np.ndarray:
    """Return the nodes of the cells, of shape (M, 3) or (M, 6)."""
    nodes = np.asarray(mesh.coordinates.cell_node_map().values)
    if nodes.ndim != 2 or nodes.shape[1] not in (3, 6):
        raise TypeError(f"points: nodes of cells of shape {nodes.shape} are not those of triangles of degree 1 or 2")
    if len(nodes) > 1 and np.unique(nodes).size == nodes.size:
        raise ValueError(
            "points: its coordinates are discontinuous (a periodic mesh?); triangles share no nodes, so none could move"
        )
    return nodes
