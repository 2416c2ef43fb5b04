"""Meshes of PyVista and VTK: PolyData and UnstructuredGrid.

Importing this module adds the accessor ``mesh.trismooth`` to PyVista's classes, if PyVista is imported and knows
accessors (0.48 and later). The entry point ``pyvista.accessors`` of the package names this module, so PyVista imports
it when somebody asks for ``mesh.trismooth``: whether trismooth was imported before PyVista, after it, or not at all.

Points of a mesh that was copied shallowly are shared by VTK: in place, both move.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from typing import Any, Optional

import numpy as np

from .flat import (
    FlatMesh,
    any_mask,
    choose_fixed,
    choose_regions,
    float_points,
    marked_points,
    marked_sides,
    no_such_name,
    one_value_each,
    point_array_mask,
    quads_note,
    region_arrays,
    side_names,
    tags_of_lines,
    triangle_width,
    triangles_of_quads,
    vertices_of,
    with_sides,
)

SUPPORTS_COPY = True

_LINES = (3, 4)  # lines and polylines
_TRIANGLE = 5
_TRIANGLE_STRIP = 6
_QUADRATIC_TRIANGLE = 22
_POLYGON, _QUAD, _QUADRATIC_QUAD = 7, 9, 23
_LAGRANGE_TRIANGLE = 69  # of any order: of three nodes it is a triangle, of six a quadratic one


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
    cells = _cells_of(mesh, lines)
    count = mesh.GetNumberOfPoints()
    points = float_points(_to_numpy(mesh.GetPoints().GetData()))
    cell_data, point_data = mesh.GetCellData(), mesh.GetPointData()

    notes = quads_note(cells.quads)

    def of_triangles(name: str) -> Optional[np.ndarray]:
        values = _values(cell_data, name)
        return None if values is None else values[cells.of_triangle]

    def default_regions() -> list[np.ndarray]:
        return region_arrays(_names(cell_data), of_triangles, cells.triangles, count, notes)

    def of_lines(name: str) -> Optional[np.ndarray]:
        values = _values(cell_data, name)
        return None if values is None else values[cells.of_line]

    def named_regions(name: str) -> np.ndarray:
        of_triangle: np.ndarray = _values_of_name(cell_data, name, "regions", "cell array")[cells.of_triangle]
        return one_value_each(of_triangle, name)

    def named_fixed(name: str) -> np.ndarray:
        return point_array_mask(_values_of_name(point_data, name, "fixed", "point array"))

    marks = [values for values in map(of_triangles, side_names(_names(cell_data))) if values is not None]
    sides, side_tags = marked_sides(marks, cells.triangles)
    tags = tags_of_lines(_names(cell_data), regions, of_lines) if len(cells.lines) > 0 else None
    all_lines, line_tags = with_sides(cells.lines, tags, sides, side_tags) if lines else (cells.lines, tags)
    flat = FlatMesh(
        points,
        cells.triangles,
        regions=choose_regions(
            regions,
            default=default_regions,
            named=named_regions,
            cell_of_triangle=cells.of_triangle,
            cell_count=mesh.GetNumberOfCells(),
        ),
        other_cells=vertices_of(cells.other_nodes if lines else [*cells.other_nodes, sides], count),
        lines=all_lines,
        line_tags=line_tags,
        notes=notes,
    )

    def default_fixed() -> Optional[np.ndarray]:
        names = _names(point_data)
        on_lines = vertices_of([*cells.other_nodes, sides, all_lines], count)
        return any_mask(
            [
                named_fixed("fixed") if "fixed" in names else None,
                marked_points(names, lambda name: _values(point_data, name), flat, on_lines),
            ]
        )

    flat.fixed = choose_fixed(fixed, count, default=default_fixed, named=named_fixed)
    return flat


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


@dataclass
class _Cells:
    """The cells of a mesh: triangles, the cell that each of them is, the same of edges of lines, arrays of nodes of all
    other cells, and how many of the triangles are quadrilaterals that repeat a corner."""

    triangles: np.ndarray
    of_triangle: np.ndarray
    lines: np.ndarray
    of_line: np.ndarray
    other_nodes: list[np.ndarray]
    quads: int


@dataclass
class _CellArray:
    """Cells of any number of nodes, with the places in the nodes where each cell begins and where it ends."""

    nodes: np.ndarray
    begins: np.ndarray
    ends: np.ndarray

    def of(self, chosen: np.ndarray, width: int) -> np.ndarray:
        """Return the nodes of the chosen cells, all of that width."""
        nodes: np.ndarray = self.nodes[self.begins[chosen][:, None] + np.arange(width)]
        return nodes

    def triangles_of_quads(self, chosen: np.ndarray, width: int) -> tuple[np.ndarray, np.ndarray]:
        """Return which of the chosen quadrilaterals are triangles since they repeat a corner, and these triangles."""
        places, triangles = triangles_of_quads(self.of(chosen, width))
        return chosen[places], triangles

    def edges_of(self, chosen: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the edges between nodes that follow each other in the chosen cells, and the cell that each is of."""
        counts = (self.ends - self.begins)[chosen] - 1
        of_edge = np.repeat(chosen, counts)
        first = self.begins[of_edge] + np.arange(len(of_edge)) - np.repeat(np.cumsum(counts) - counts, counts)
        return np.column_stack([self.nodes[first], self.nodes[first + 1]]), of_edge

    def nodes_of_others(self, chosen: np.ndarray) -> np.ndarray:
        """Return the nodes of all cells but the chosen ones."""
        is_other = np.ones(len(self.begins), dtype=bool)
        is_other[chosen] = False
        nodes: np.ndarray = self.nodes[np.repeat(is_other, self.ends - self.begins)]
        return nodes


def _cells_of(mesh: Any, with_lines: bool) -> _Cells:
    """Return the cells. Unless `with_lines`, lines are other cells."""
    if mesh.GetNumberOfCells() > 0:
        if mesh.IsA("vtkPolyData"):
            return _cells_of_poly_data(mesh, with_lines)
        if mesh.IsA("vtkUnstructuredGrid"):
            return _cells_of_grid(mesh, with_lines)
    elif mesh.IsA("vtkPointSet"):
        raise ValueError("points: it has no cells")
    raise TypeError(
        f"points: a {type(mesh).__name__} is no PolyData or UnstructuredGrid; convert it first, with PyVista by "
        "mesh.extract_surface(), mesh.triangulate() or mesh.combine()"
    )


def _cells_of_poly_data(mesh: Any, with_lines: bool) -> _Cells:
    # VTK numbers the cells in this order.
    first_polygon = mesh.GetNumberOfVerts() + mesh.GetNumberOfLines()
    first_strip = first_polygon + mesh.GetNumberOfPolys()
    polygons = _cell_array(mesh.GetPolys())
    chosen = np.flatnonzero(polygons.ends - polygons.begins == 3)
    strips = _cell_array(mesh.GetStrips())
    of_strips, strip_of = _triangles_of_strips(strips, np.arange(len(strips.begins)))
    quads, of_quads = polygons.triangles_of_quads(np.flatnonzero(polygons.ends - polygons.begins == 4), 4)
    triangle_width(len(chosen) + len(of_strips) + len(quads), 0)
    lines = _cell_array(mesh.GetLines())
    chosen_lines = np.flatnonzero(with_lines & (lines.ends - lines.begins >= 2))
    edges, line_of = lines.edges_of(chosen_lines)
    return _Cells(
        np.concatenate([polygons.of(chosen, 3), of_quads, of_strips]),
        np.concatenate([first_polygon + chosen, first_polygon + quads, first_strip + strip_of]),
        edges,
        mesh.GetNumberOfVerts() + line_of,
        [
            _cell_array(mesh.GetVerts()).nodes,
            lines.nodes_of_others(chosen_lines),
            polygons.nodes_of_others(np.concatenate([chosen, quads])),
        ],
        len(quads),
    )


def _cells_of_grid(mesh: Any, with_lines: bool) -> _Cells:
    cells = _cell_array(mesh.GetCells())
    types = _cell_types(mesh)
    sizes = cells.ends - cells.begins
    linear, quadratic = (
        np.flatnonzero((types == kind) | np.isin(types, of_any_size) & (sizes == nodes))
        for kind, nodes, of_any_size in (
            (_TRIANGLE, 3, (_LAGRANGE_TRIANGLE, _POLYGON)),
            (_QUADRATIC_TRIANGLE, 6, (_LAGRANGE_TRIANGLE,)),
        )
    )
    quads, of_quads = cells.triangles_of_quads(np.flatnonzero((types == _QUAD) | (types == _POLYGON) & (sizes == 4)), 4)
    quadratic_quads, of_quadratic_quads = cells.triangles_of_quads(np.flatnonzero(types == _QUADRATIC_QUAD), 8)
    strips = np.flatnonzero(types == _TRIANGLE_STRIP)
    of_strips, strip_of = _triangles_of_strips(cells, strips)
    chosen_lines = np.flatnonzero(with_lines & np.isin(types, _LINES) & (sizes >= 2))
    edges, line_of = cells.edges_of(chosen_lines)
    width = triangle_width(len(linear) + len(quads) + len(of_strips), len(quadratic) + len(quadratic_quads))
    if width == 6:
        of_triangle = np.concatenate([quadratic, quadratic_quads])
        others = cells.nodes_of_others(np.concatenate([of_triangle, chosen_lines]))
        triangles = np.concatenate([cells.of(quadratic, 6), of_quadratic_quads])
        return _Cells(triangles, of_triangle, edges, line_of, [others], len(quadratic_quads))
    return _Cells(
        np.concatenate([cells.of(linear, 3), of_quads, of_strips]),
        np.concatenate([linear, quads, strip_of]),
        edges,
        line_of,
        [cells.nodes_of_others(np.concatenate([linear, quads, strips, chosen_lines]))],
        len(quads),
    )


def _triangles_of_strips(cells: _CellArray, strips: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the triangles of the strips, all in one direction, and the strip that each is of."""
    triangles = [np.empty((0, 3), dtype=np.int64)]
    for strip in strips:
        nodes = cells.nodes[cells.begins[strip] : cells.ends[strip]]
        of_strip = np.column_stack([nodes[:-2], nodes[1:-1], nodes[2:]])
        of_strip[1::2, :2] = of_strip[1::2, 1::-1]
        triangles.append(of_strip)
    return np.concatenate(triangles), np.repeat(strips, [len(of_strip) for of_strip in triangles[1:]])


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


def _cell_array(cells: Any) -> _CellArray:
    offsets = _to_numpy(cells.GetOffsetsArray()).astype(np.int64, copy=False)
    # The cells that were never set have no offsets at all.
    offsets = offsets if offsets.size > 0 else np.zeros(1, dtype=np.int64)
    nodes = _to_numpy(cells.GetConnectivityArray()).astype(np.int64, copy=False)
    return _CellArray(nodes, offsets[:-1], offsets[1:])


def _cell_types(grid: Any) -> np.ndarray:
    try:
        return _to_numpy(grid.GetCellTypes())
    except TypeError:  # Before VTK 9.6 this method has another meaning, and takes an argument.
        return _to_numpy(grid.GetCellTypesArray())


def _names(data: Any) -> list[str]:
    names = [data.GetAbstractArray(i).GetName() for i in range(data.GetNumberOfArrays())]
    return [name for name in names if name]


def _values(data: Any, name: str) -> Optional[np.ndarray]:
    """Return the values of an array of numbers or texts; None if it holds something else."""
    array = data.GetAbstractArray(name)
    if array.IsA("vtkDataArray"):
        values = _to_numpy(array)
        return values.reshape(-1) if array.GetNumberOfComponents() == 1 else values
    if array.IsA("vtkStringArray") and array.GetNumberOfComponents() == 1:
        return np.array([array.GetValue(i) for i in range(array.GetNumberOfValues())], dtype=str)
    return None


def _values_of_name(data: Any, name: str, argument: str, kind: str) -> np.ndarray:
    names = _names(data)
    values = _values(data, name) if name in names else None
    if values is None:
        raise no_such_name(argument, name, kind, names)
    return values


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
