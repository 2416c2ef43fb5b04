# SPDX-License-Identifier: BSD-3-Clause
"""Adapters between meshes of other packages and plain arrays.

An adapter is a module with

- ``SUPPORTS_COPY``: whether it can make a new mesh; else meshes are only smoothed in place;
- ``flatten(mesh, regions=None, fixed=None, lines=False) -> FlatMesh``; with ``lines``, for vertices that slide, line
  cells are lines of the result and do not hold their vertices otherwise;
- ``with_points(mesh, flat, points, inplace) -> mesh``: the mesh with other points, a new one unless ``inplace``.

Which adapter takes an object is decided by the names of its classes and of their modules. So no package is imported for
it, and no adapter before there is a mesh for it.
"""

from __future__ import annotations

import importlib
from types import ModuleType
from typing import Any, Optional

# Package and class, of the object or one of its bases, and the adapter. The classes are wider than what adapters take,
# so that they can say what to do about the others.
_ADAPTERS = {
    ("vtkmodules", "vtkDataObject"): "pyvista",
    ("meshio", "Mesh"): "meshio",
    ("skfem", "Mesh"): "skfem",
    ("dolfinx", "Mesh"): "fenicsx",
    ("firedrake", "MeshGeometry"): "firedrake",
}


def find(mesh: Any) -> Optional[ModuleType]:
    """Return the adapter that takes the mesh, or None.

    Parameters
    ----------
    mesh : object
        Anything.

    Returns
    -------
    module or None
    """
    for cls in type(mesh).__mro__:
        package = cls.__module__.partition(".")[0]
        adapter = _ADAPTERS.get((package, cls.__name__))
        if adapter is not None:
            return importlib.import_module(f"{__name__}.{adapter}")
    return None
