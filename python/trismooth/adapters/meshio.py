# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of meshio."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Optional

import numpy as np

from .flat import Cells, FlatMesh, flat_mesh, float_points

SUPPORTS_COPY = True

#: VTK's numbers for types of cells.
_VTK_TYPES = {
    "vertex": 1, "line": 3, "triangle": 5, "polygon": 7, "quad": 9, "line3": 21, "triangle6": 22, "quad8": 23,
    "quad9": 28, "triangle7": 34, "VTK_LAGRANGE_CURVE": 68, "VTK_LAGRANGE_TRIANGLE": 69,
    "VTK_LAGRANGE_QUADRILATERAL": 70,
}  # fmt: skip
#: Points, a cubic line, a quadratic polygon, a convex set of points.
_LIKE_THOSE_OF_DIMENSION = (2, 35, 36, 41)

# meshio keeps the curves around each entity here, as if their numbers were those of cells.
_NOT_CELL_SETS = frozenset({"gmsh:bounding_entities"})


def flatten(mesh: Any, regions: Any = None, fixed: Any = None, lines: bool = False) -> FlatMesh:
    """Return the mesh as plain arrays.

    Parameters
    ----------
    mesh : meshio.Mesh
        Blocks ``triangle`` and ``triangle6`` are smoothed, and of blocks ``polygon`` triangles, of ``quad`` and ``quad8``
        what repeats a corner and so is a triangle. All other cells hold their vertices, lines and vertex cells,
        too. Sides of triangles that cell data of scikit-fem mark (``skfem:b:wall``) are taken for lines.
    regions : None, False, str, list of str or array_like
        None: the cell data that give regions by their names (``gmsh:physical``, ``medit:ref``, ...) or look like it,
        as the program judges it, and all cell sets. A name or names: of cell data or cell sets. An array: a label for
        each triangle, or for each cell of all blocks in their order.
    fixed : None, False, str, list of str or array_like
        None: the point data ``fixed``, if there are such, point sets that are of no area, vertices inside that point
        data of markers mark (``medit:ref``, ...), and those that a file of Gmsh has on points and curves, all as the
        program judges it. A name or names: of point data, where vertices are held whose value is not zero, or of point
        sets. An array: a mask, or vertex numbers.
    lines : bool
        Whether blocks ``line`` are lines for vertices to slide on. They differ where cell data that give regions or
        cell sets do. Vertices that a file of Gmsh calls periodic are linked.
    """
    pairs = _pairs_of(mesh)
    flat = flat_mesh(
        float_points(mesh.points),
        _cells_of(mesh),
        cell_data=((name, _values(mesh, name)) for name in mesh.cell_data),
        point_data=mesh.point_data.items(),
        cell_sets=_sets_of(mesh),
        point_sets=((name, np.asarray(points)) for name, points in mesh.point_sets.items()),
        implied_sets=_implied_sets(mesh, pairs),
        regions=regions,
        fixed=fixed,
        lines=lines,
    )
    flat.links = pairs if lines else None
    return flat


def with_points(mesh: Any, flat: FlatMesh, points: np.ndarray, inplace: bool) -> Any:
    """Return the mesh with other points: the mesh itself, or a deep copy of it."""
    if inplace and mesh.points.dtype == points.dtype:
        mesh.points[...] = points
        return mesh
    target = mesh if inplace else mesh.copy()
    target.points = points
    return target


def _cells_of(mesh: Any) -> Cells:
    blocks = [_nodes_of_block(block) for block in mesh.cells]
    types = [np.full(len(sizes), _vtk_type(block)) for block, (sizes, _) in zip(mesh.cells, blocks)]
    return Cells(_joined(types), *(_joined(list(parts)) for parts in (zip(*blocks) if blocks else ((), ()))))


def _joined(parts: list[np.ndarray]) -> np.ndarray:
    return np.concatenate([np.empty(0, dtype=np.int64), *parts])


def _nodes_of_block(block: Any) -> tuple[np.ndarray, np.ndarray]:
    """The numbers of nodes of the cells of a block, and all these nodes."""
    cells = block.data
    if isinstance(cells, np.ndarray) and cells.dtype != object and cells.ndim == 2:
        return np.full(len(cells), cells.shape[1]), cells.reshape(-1)
    nodes = [_joined(list(_nodes_of(cell))) for cell in cells]
    return np.array([len(of_cell) for of_cell in nodes], dtype=np.int64), _joined(nodes)


def _nodes_of(cell: Any) -> Iterator[np.ndarray]:
    """Nodes of a cell. Those of polyhedra are lists of faces of any number of nodes."""
    if isinstance(cell, (list, tuple)) or getattr(cell, "dtype", None) == object:
        for part in cell:
            yield from _nodes_of(part)
    else:
        yield np.ravel(cell)


def _vtk_type(block: Any) -> int:
    """VTK's number for the type of a block's cells; where all that matters is their dimension, of one like them."""
    name = block.type
    if name in _VTK_TYPES:
        return _VTK_TYPES[name]
    if name.startswith("triangle"):
        return _VTK_TYPES["VTK_LAGRANGE_TRIANGLE"]
    return _VTK_TYPES["polygon"] if name.startswith("polygon") else _LIKE_THOSE_OF_DIMENSION[getattr(block, "dim", 3)]


def _values(mesh: Any, name: str) -> np.ndarray:
    """Values of cell data at all cells. Blocks of other cells may have data of another width, which count nothing."""
    of_blocks = [np.asarray(data) for data in mesh.cell_data[name]]
    of_blocks = [values.reshape(-1) if values.shape[1:] == (1,) else values for values in of_blocks]
    widths = [values.shape[1:] for values, block in zip(of_blocks, mesh.cells) if getattr(block, "dim", 2) == 2]
    width = widths[0] if widths else ()
    return np.concatenate(
        [v if v.shape[1:] == width else np.zeros((len(v), *width), dtype=v.dtype) for v in of_blocks]
    )


def _sets_of(mesh: Any) -> dict[str, np.ndarray]:
    """Numbers of the cells in each cell set, counted over the blocks."""
    first = np.cumsum([0, *(len(block.data) for block in mesh.cells)])
    sets = {}
    for name, of_blocks in mesh.cell_sets.items():
        if name in _NOT_CELL_SETS:
            continue
        members = []
        for b, of_block in enumerate(of_blocks):
            numbers = np.asarray([] if of_block is None else of_block, dtype=np.int64).reshape(-1)
            count = len(mesh.cells[b].data)
            if numbers.size > 0 and (numbers.min() < 0 or numbers.max() >= count):
                raise ValueError(f"points: the cell set '{name}' has numbers beyond the {count} cells of block {b}")
            members.append(first[b] + numbers)
        sets[name] = _joined(members)
    return sets


def _pairs_of(mesh: Any) -> Optional[np.ndarray]:
    """Pairs of vertices that a file of Gmsh calls periodic."""
    entities = getattr(mesh, "gmsh_periodic", None) or []
    pairs = [np.asarray(entity[3], dtype=np.int64).reshape(-1, 2) for entity in entities]
    return np.concatenate(pairs) if pairs else None


def _implied_sets(mesh: Any, pairs: Optional[np.ndarray]) -> Iterator[tuple[str, np.ndarray]]:
    """What a file of Gmsh tells of nodes, as the program's reader has it. It says nothing if none is of a surface."""
    entities = np.asarray(mesh.point_data.get("gmsh:dim_tags", np.empty((0, 2))))
    if (entities[:, 0] > 1).any():
        yield "gmsh:points", np.flatnonzero(entities[:, 0] == 0)
        yield "gmsh:curves", np.flatnonzero(entities[:, 0] == 1)
    if pairs is not None:
        yield "gmsh:periodic", np.unique(pairs)
