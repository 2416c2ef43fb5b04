# SPDX-License-Identifier: BSD-3-Clause
"""Plane meshes of scikit-fem: MeshTri1, MeshTri2 and MeshQuad1."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, Optional

import numpy as np

from .flat import FlatMesh, as_names, choose_fixed, choose_regions, labels_of_sets, no_such_name

SUPPORTS_COPY = True


def flatten(mesh: Any, regions: Any = None, fixed: Any = None, lines: bool = False) -> FlatMesh:
    """Return the mesh as plain arrays.

    Parameters
    ----------
    mesh : skfem.MeshTri1, skfem.MeshTri2 or skfem.MeshQuad1
    regions : None, False, str, list of str or array_like
        None: all subdomains. A name or names: of subdomains. An array: a label for each element.
    fixed : None, False, str, list of str or array_like
        None: the ends of all named boundaries, which may lie inside of the mesh. False: none of them. A name or names:
        only those of these boundaries. An array, a mask or vertex numbers: those vertices, besides all named
        boundaries.
    lines : bool
        Whether named boundaries are lines for vertices to slide on; they hold vertices then only where ``fixed`` has
        their name.
    """
    _check(mesh)
    points = np.ascontiguousarray(mesh.doflocs.T)
    subdomains: Mapping[str, np.ndarray] = mesh.subdomains or {}
    boundaries: Mapping[str, np.ndarray] = mesh.boundaries or {}

    def default_regions() -> Optional[np.ndarray]:
        return labels_of_sets(map(np.asarray, subdomains.values()), mesh.nelements) if subdomains else None

    def named_regions(name: str) -> np.ndarray:
        if name not in subdomains:
            raise no_such_name("regions", name, "subdomain", subdomains)
        return labels_of_sets([np.asarray(subdomains[name])], mesh.nelements)

    def all_boundaries() -> Optional[np.ndarray]:
        return np.asarray(np.any([named_fixed(name) for name in boundaries], axis=0)) if boundaries else None

    def named_fixed(name: str) -> np.ndarray:
        if name not in boundaries:
            raise no_such_name("fixed", name, "boundary", boundaries)
        mask = np.zeros(len(points), dtype=bool)
        mask[mesh.facets[:, np.asarray(boundaries[name])]] = True
        return mask

    # Lines hold what does not slide along them.
    named = [np.asarray(facets) for facets in boundaries.values()] if lines and fixed is not False else []
    facets = np.unique(np.concatenate([np.empty(0, dtype=np.int64), *named]))
    of_boundaries = None if lines else all_boundaries()
    mask = choose_fixed(fixed, len(points), default=lambda: of_boundaries, named=named_fixed)
    if mask is not None and of_boundaries is not None and as_names(fixed) is None:
        mask = mask | of_boundaries
    return FlatMesh(
        points,
        np.ascontiguousarray(_elements(mesh)),
        regions=choose_regions(regions, mesh.nelements, default=default_regions, named=named_regions),
        fixed=mask,
        lines=mesh.facets[:, facets].T,
        line_tags=labels_of_sets(named, mesh.nfacets)[facets],
    )


def with_points(mesh: Any, flat: FlatMesh, points: np.ndarray, inplace: bool) -> Any:
    """Return the mesh with other points: the mesh itself, or a new one of its class that shares all other arrays."""
    doflocs = np.ascontiguousarray(points.T)
    if not inplace:
        return replace(mesh, doflocs=doflocs)
    # A new array, not new values: scikit-fem lets meshes share their arrays.
    mesh.doflocs = doflocs
    # What scikit-fem derived from the old points: maps of elements and the search tree.
    for name in ("_cached_mapping", "_cached_tree"):
        vars(mesh).pop(name, None)
    return mesh


def _elements(mesh: Any) -> np.ndarray:
    """Return the nodes of the elements, of shape (M, 3), (M, 4) or (M, 6)."""
    # The degrees of freedom of a MeshTri2 are its corners, then the middles of the sides 01, 12 and 02.
    return np.asarray(mesh.dofs.element_dofs.T if "MeshTri2" in _class_names(mesh) else mesh.t.T)


def _class_names(mesh: Any) -> set[str]:
    return {cls.__name__ for cls in type(mesh).__mro__}


def _check(mesh: Any) -> None:
    names = _class_names(mesh)
    if not names & {"MeshTri1", "MeshQuad1"} or "MeshQuad2" in names:
        raise TypeError(f"points: a {type(mesh).__name__} is no MeshTri1, MeshTri2 or MeshQuad1")
    if "MeshDG" in names:
        raise TypeError(f"points: the elements of a {type(mesh).__name__} share no vertices, so none could move")
