# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of other packages, by their adapters."""

from __future__ import annotations

import os
from typing import Any, Dict, Optional, Tuple

import numpy as np

from . import _arrays, _core, adapters
from ._constraints import Constraints, slides
from ._result import Result
from .adapters.flat import FlatMesh


def _adapter_of(mesh: Any) -> Any:
    adapter = adapters.find(mesh)
    if adapter is None and (isinstance(mesh, (list, tuple)) or hasattr(mesh, "__array__") or hasattr(mesh, "__dlpack__")):
        raise TypeError("triangles: are needed beside an array of points")
    if isinstance(mesh, (str, os.PathLike)):
        raise TypeError(f"points: {mesh!r} is the name of a file; trismooth.read() reads the mesh in it")
    if adapter is None:
        module = type(mesh).__module__
        kind = type(mesh).__qualname__ if module == "builtins" else f"{module}.{type(mesh).__qualname__}"
        raise TypeError(f"points: {kind} is no mesh that trismooth knows; give points and triangles")
    return adapter


def smooth_mesh(
    mesh: Any, given: Constraints, out: Any, quality: Optional[bool], progress: Any, options: Dict[str, Any]
) -> Result:
    """smoothed() of a mesh: the result has the smoothed one as ``mesh``."""
    from ._smooth import smoothed

    if out is not None:
        raise TypeError("out: is for arrays; a mesh is changed itself with inplace=True")
    adapter = _adapter_of(mesh)
    inplace = options.pop("inplace", None)
    if inplace is None:
        inplace = not adapter.SUPPORTS_COPY
    if not inplace and not adapter.SUPPORTS_COPY:
        raise ValueError("inplace: meshes of this type can be smoothed in place only")
    flat = adapter.flatten(mesh, regions=given.regions, fixed=given.fixed, lines=slides(options["slide"]))
    result = smoothed(
        flat.points,
        flat.triangles,
        _constraints_of(flat, given),
        None,
        _arrays.wants_quality(quality, True),
        progress,
        options,
        [*flat.notes, *(flat.line_notes if given.lines is None else [])],
    )
    if inplace:
        result.input_points = None
    result.mesh = adapter.with_points(mesh, flat, result.points, inplace=inplace)
    return result


def _constraints_of(flat: FlatMesh, given: Constraints) -> Constraints:
    """The arrays for smoothed(): of the mesh and of the user."""
    lines, line_tags, links = given.lines, given.line_tags, given.links
    if lines is None:
        if line_tags is not None:
            raise ValueError("line_tags: are for lines that are given; the mesh has its own")
        lines, line_tags = flat.lines, flat.line_tags
    if links is None:
        links = flat.links
    return given._replace(
        regions=flat.regions,
        fixed=flat.fixed,
        other_cells=_united(flat.other_cells, given.other_cells, len(flat.points)),
        lines=None if lines is False else lines,
        line_tags=line_tags,
        links=None if links is False else links,
    )


def _united(of_mesh: Any, of_user: Any, count: int) -> Any:
    """The vertices of both; None where there are none."""
    if of_mesh is None or of_user is None:
        return of_mesh if of_user is None else of_user
    given = _core.vertex_mask(_arrays.on_host(of_user, "other_cells"), "other_cells", count)
    return given | _core.vertex_mask(np.asarray(of_mesh), "other_cells", count)


def arrays_of(mesh: Any) -> Tuple[Any, Any]:
    """The points and triangles of a mesh."""
    flat = _adapter_of(mesh).flatten(mesh, regions=False, fixed=False)
    return flat.points, flat.triangles


