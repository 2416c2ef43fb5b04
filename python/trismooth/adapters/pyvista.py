# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of PyVista and VTK: PolyData and UnstructuredGrid.

Importing this module adds the accessor ``mesh.trismooth`` to PyVista's classes, if PyVista is imported and knows
accessors (0.48 and later). The entry point ``pyvista.accessors`` of the package names this module, so PyVista imports
it when somebody asks for ``mesh.trismooth``: whether trismooth was imported before PyVista, after it, or not at all.

Points of a mesh that was copied shallowly are shared by VTK: in place, both move.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from typing import Any

import numpy as np

from .flat import Cells, FlatMesh, flat_mesh, float_points

SUPPORTS_COPY = True

#: VTK's numbers for types of cells.
_VERTEX, _POLY_VERTEX, _LINE, _POLY_LINE, _TRIANGLE_STRIP, _POLYGON = 1, 2, 3, 4, 6, 7


def flatten(mesh: Any, regions: Any = None, fixed: Any = None, lines: bool = False) -> FlatMesh:
    """Return the mesh as plain arrays.

    Parameters
    ----------
    mesh : pyvista.PolyData, pyvista.UnstructuredGrid, vtkPolyData or vtkUnstructuredGrid
        Triangles, polygons of three corners, triangle strips, quadratic triangles and quadrilaterals that repeat a
        corner are smoothed. All other cells hold their vertices, lines and
        vertex cells, too. Sides of triangles that cell arrays of scikit-fem mark (``skfem:b:wall``) are taken for lines.
    regions : None, False, str, list of str or array_like
        None: the cell arrays that give regions by their names (``material``, ``region_id``, ...) or look like it, as
        the program judges it. A name or names: of cell arrays. An array: a label for each triangle or for each cell.
    fixed : None, False, str, list of str or array_like
        None: the point array ``fixed``, if there is one, and vertices inside that point arrays of markers mark
        (``medit:ref``, ``vertex_markers``, ...), as the program judges it. A name or names: of point arrays; vertices
        are held where they are not zero. An array: a mask, or vertex numbers.
    lines : bool
        Whether lines and polylines are lines for vertices to slide on. They differ where cell arrays that give regions
        do.
    """
    cells = _cells_of(mesh)
    return flat_mesh(
        float_points(_to_numpy(mesh.GetPoints().GetData())),
        cells,
        cell_data=_arrays_of(mesh.GetCellData()),
        point_data=_arrays_of(mesh.GetPointData()),
        regions=regions,
        fixed=fixed,
        lines=lines,
    )


def with_points(mesh: Any, flat: FlatMesh, points: np.ndarray, inplace: bool) -> Any:
    """Return the mesh with other points: the mesh itself, or a deep copy of its class."""
    target = mesh if inplace else _copy(mesh)
    data = target.GetPoints().GetData()
    if _is_array_of_structs(data) and _numpy_support().vtk_to_numpy(data).dtype == points.dtype:
        _numpy_support().vtk_to_numpy(data)[...] = points
        target.GetPoints().Modified()
    else:  # of integers, say, which have no place for the result
        target.GetPoints().SetData(_numpy_support().numpy_to_vtk(points, deep=True))
    target.Modified()
    return target


def _copy(mesh: Any) -> Any:
    if hasattr(mesh, "copy"):  # PyVista's meshes know more than VTK copies.
        return mesh.copy(deep=True)
    copy = mesh.NewInstance()
    copy.DeepCopy(mesh)
    return copy


def _cells_of(mesh: Any) -> Cells:
    if mesh.GetNumberOfCells() > 0:
        if mesh.IsA("vtkPolyData"):
            return _cells_of_poly_data(mesh)
        if mesh.IsA("vtkUnstructuredGrid"):
            return Cells(_cell_types(mesh), *_sizes_and_nodes(mesh.GetCells()))
    elif mesh.IsA("vtkPointSet"):
        raise ValueError("points: it has no cells")
    raise TypeError(
        f"points: a {type(mesh).__name__} is no PolyData or UnstructuredGrid; convert it first, with PyVista by "
        "mesh.extract_surface(), mesh.triangulate() or mesh.combine()"
    )


def _cells_of_poly_data(mesh: Any) -> Cells:
    # VTK numbers the cells in this order. Those of so many nodes have a type of their own.
    parts = (
        (mesh.GetVerts(), 1, _VERTEX, _POLY_VERTEX),
        (mesh.GetLines(), 2, _LINE, _POLY_LINE),
        (mesh.GetPolys(), 3, _POLYGON, _POLYGON),
        (mesh.GetStrips(), 3, _TRIANGLE_STRIP, _TRIANGLE_STRIP),
    )
    cells = []
    for array, size, of_size, of_others in parts:
        sizes, nodes = _sizes_and_nodes(array)
        cells.append((np.where(sizes == size, of_size, of_others), sizes, nodes))
    return Cells(*map(np.concatenate, zip(*cells)))


def _numpy_support() -> Any:
    # As late as this, so that nobody pays for VTK who has no mesh of it.
    from vtkmodules.util import numpy_support

    return numpy_support


def _is_array_of_structs(array: Any) -> bool:
    """Return whether the array lies in memory as NumPy's do: most do, those made of formulas do not."""
    return bool(array.HasStandardMemoryLayout())


def _to_numpy(array: Any) -> np.ndarray:
    """Return the values of a vtkDataArray, without a copy where there need be none."""
    if not _is_array_of_structs(array):
        copy = array.CreateDataArray(array.GetDataType())
        copy.DeepCopy(array)
        array = copy
    return np.asarray(_numpy_support().vtk_to_numpy(array))


def _sizes_and_nodes(cells: Any) -> tuple[np.ndarray, np.ndarray]:
    # Cells that were never set have no offsets at all.
    return np.diff(_to_numpy(cells.GetOffsetsArray())), _to_numpy(cells.GetConnectivityArray())


def _cell_types(grid: Any) -> np.ndarray:
    try:
        return _to_numpy(grid.GetCellTypes())
    except TypeError:  # Before VTK 9.6 this method has another meaning, and takes an argument.
        return _to_numpy(grid.GetCellTypesArray())


def _arrays_of(data: Any) -> Iterator[tuple[str, Any]]:
    """The arrays of numbers and texts that have names."""
    for array in map(data.GetAbstractArray, range(data.GetNumberOfArrays())):
        if array.GetName() and array.IsA("vtkDataArray"):
            yield array.GetName(), _to_numpy(array)
        elif array.GetName() and array.IsA("vtkStringArray") and array.GetNumberOfComponents() == 1:
            yield array.GetName(), np.array([array.GetValue(i) for i in range(array.GetNumberOfValues())], dtype=str)


class Accessor:
    """What ``mesh.trismooth`` offers.

    Parameters
    ----------
    mesh : pyvista.PolyData or pyvista.UnstructuredGrid
    """

    def __init__(self, mesh: Any) -> None:
        self._mesh = mesh

    def smooth(self, **options: Any) -> Any:
        """Smooth the mesh: ``trismooth.smooth(mesh, **options)``. The new mesh is ``.mesh`` of the result."""
        import trismooth

        return trismooth.smooth(self._mesh, **options)

    def quality(self, **options: Any) -> Any:
        """Measure the mesh: ``trismooth.quality(mesh, **options)``."""
        import trismooth

        return trismooth.quality(self._mesh, **options)


def register_accessor() -> bool:
    """Add ``mesh.trismooth`` to PyVista's classes, and return whether that could be done."""
    pyvista = sys.modules.get("pyvista")
    register = getattr(pyvista, "register_dataset_accessor", None)
    if pyvista is None or register is None:
        return False
    for cls in (pyvista.PolyData, pyvista.UnstructuredGrid):
        register("trismooth", cls)(Accessor)
    return True


register_accessor()
