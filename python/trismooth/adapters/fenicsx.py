# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of FEniCSx: dolfinx.mesh.Mesh.

They are smoothed in place: their coordinates are the array ``mesh.geometry.x``.
"""

from __future__ import annotations

from typing import Any, Optional

import numpy as np

from .flat import FlatMesh, choose_fixed, choose_regions, nothing_named, number_labels

SUPPORTS_COPY = False

# VTK's order of the nodes, by how many there are: dolfinx lists the middles of the sides 12, 02, 01 of a triangle, and the
# corners of a quadrilateral by rows (the order of Basix).
_ORDERS = {3: [0, 1, 2], 4: [0, 1, 3, 2], 6: [0, 1, 2, 5, 3, 4]}


def flatten(mesh: Any, regions: Any = None, fixed: Any = None, lines: bool = False) -> FlatMesh:
    """Return the mesh as plain arrays.

    Parameters
    ----------
    mesh : dolfinx.mesh.Mesh
        Triangles of order 1 or 2, or quadrilaterals of order 1, on one process.
    regions : None, False, dolfinx.mesh.MeshTags or array_like
        None, False: no regions. Tags of cells: each value is a region; cells without a tag are one more. An array: a
        label for each cell.
    fixed : None, False or array_like
        None, False: none. An array: a mask, or numbers of nodes of the geometry. These are not numbers of vertices of
        the topology: ``dolfinx.mesh.entities_to_geometry`` gives those of facets.
    lines : bool
        Makes no difference: the mesh has no line cells.
    """
    _check(mesh)
    dofmap = _dofmap(mesh)
    count = len(mesh.geometry.x)
    labels = _labels_of_tags(regions, len(dofmap)) if hasattr(regions, "indices") else regions
    return FlatMesh(
        mesh.geometry.x,
        np.ascontiguousarray(dofmap[:, _ORDERS[dofmap.shape[1]]]),
        regions=choose_regions(
            labels, len(dofmap), default=lambda: None, named=nothing_named("regions", "a dolfinx mesh")
        ),
        fixed=choose_fixed(fixed, count, default=lambda: None, named=nothing_named("fixed", "a dolfinx mesh")),
    )


def with_points(mesh: Any, flat: FlatMesh, points: np.ndarray, inplace: bool) -> Any:
    """Give the mesh other points and return it."""
    if not inplace:
        raise ValueError("inplace: a dolfinx mesh can only be smoothed in place")
    mesh.geometry.x[...] = points
    return mesh


def _check(mesh: Any) -> None:
    if mesh.topology.dim != 2:
        raise TypeError(f"points: its cells have dimension {mesh.topology.dim}; only plane meshes can be smoothed")
    if mesh.comm.size > 1:
        raise ValueError(f"points: it is distributed over {mesh.comm.size} processes; smooth it on one, before that")


def _dofmap(mesh: Any) -> np.ndarray:
    """Return the nodes of the cells. Meshes with several types of cells have several such arrays."""
    geometry = mesh.geometry
    dofmap: Optional[Any] = getattr(geometry, "dofmap", None)
    nodes = np.asarray(geometry.dofmaps[0] if dofmap is None else dofmap)
    if nodes.ndim != 2 or nodes.shape[1] not in _ORDERS:
        raise TypeError(
            f"points: nodes of cells of shape {nodes.shape} are not those of triangles of order 1 or 2, nor of "
            "quadrilaterals of order 1"
        )
    return nodes


def _labels_of_tags(tags: Any, count: int) -> np.ndarray:
    """Return the label of each cell; 0 without a tag."""
    if tags.dim != 2:
        raise ValueError(f"regions: the tags are of entities of dimension {tags.dim}, not of cells")
    labels = np.zeros(count, dtype=np.int64)
    labels[tags.indices] = number_labels(np.asarray(tags.values)) + 1
    return labels
