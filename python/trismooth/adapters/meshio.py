"""Meshes of meshio."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Optional

import numpy as np

from .flat import (
    FlatMesh,
    choose_fixed,
    choose_regions,
    float_points,
    labels_of_sets,
    no_such_name,
    one_value_each,
    point_array_mask,
    region_arrays,
    triangle_width,
    vertex_mask,
    vertices_of,
)

SUPPORTS_COPY = True

# meshio keeps the curves around each entity here, as if their numbers were those of cells.
_NOT_CELL_SETS = frozenset({"gmsh:bounding_entities"})


def flatten(mesh: Any, regions: Any = None, fixed: Any = None) -> FlatMesh:
    """Return the mesh as plain arrays.

    Parameters
    ----------
    mesh : meshio.Mesh
        Blocks ``triangle`` and ``triangle6`` are smoothed. All other cells hold their vertices, lines and vertex cells,
        too.
    regions : None, False, str, list of str or array_like
        None: the cell data whose names say that they give regions (``gmsh:physical``, ``medit:ref``, ...) and all cell
        sets. A name or names: of cell data or cell sets. An array: a label for each triangle, or for each cell of all
        blocks in their order.
    fixed : None, False, str, list of str or array_like
        None: the point data ``fixed``, if there are such. A name or names: of point data, where vertices are held whose
        value is not zero, or of point sets. An array: a mask, or vertex numbers.
    """
    return _Flattener(mesh).flatten(regions, fixed)


def with_points(mesh: Any, flat: FlatMesh, points: np.ndarray, inplace: bool) -> Any:
    """Return the mesh with other points: the mesh itself, or a deep copy of it."""
    if inplace and mesh.points.dtype == points.dtype:
        mesh.points[...] = points
        return mesh
    target = mesh if inplace else mesh.copy()
    target.points = points
    return target


class _Flattener:
    """The triangles of a mesh and what the mesh says of them."""

    def __init__(self, mesh: Any) -> None:
        self._mesh = mesh
        counts = {kind: sum(len(block.data) for block in mesh.cells if block.type == kind) for kind in _WIDTHS}
        width = triangle_width(counts["triangle"], counts["triangle6"])
        self._is_chosen = [_WIDTHS.get(block.type) == width for block in mesh.cells]
        self._first_cell = np.cumsum([0] + [len(block.data) for block in mesh.cells])

    def flatten(self, regions: Any, fixed: Any) -> FlatMesh:
        mesh = self._mesh
        count = len(mesh.points)
        others = (block for block, chosen in zip(mesh.cells, self._is_chosen) if not chosen)
        return FlatMesh(
            float_points(mesh.points),
            np.concatenate([mesh.cells[b].data for b in self._blocks()]),
            regions=choose_regions(
                regions,
                default=self._default_regions,
                named=self._named_regions,
                cell_of_triangle=np.concatenate(
                    [np.arange(self._first_cell[b], self._first_cell[b + 1]) for b in self._blocks()]
                ),
                cell_count=int(self._first_cell[-1]),
            ),
            fixed=choose_fixed(fixed, count, default=self._default_fixed, named=self._named_fixed),
            other_cells=vertices_of((nodes for block in others for nodes in _nodes_of(block.data)), count),
        )

    def _blocks(self) -> Iterator[int]:
        """Numbers of the blocks with the triangles that are smoothed."""
        return (b for b, chosen in enumerate(self._is_chosen) if chosen)

    def _values(self, name: str) -> np.ndarray:
        """Values of cell data at the triangles."""
        data = self._mesh.cell_data[name]
        of_blocks = (np.asarray(data[b]) for b in self._blocks())
        return np.concatenate([values.reshape(-1) if values.shape[1:] == (1,) else values for values in of_blocks])

    def _members(self, name: str) -> np.ndarray:
        """Numbers of the triangles in a cell set."""
        first, members = 0, [np.empty(0, dtype=np.int64)]
        for b in self._blocks():
            of_block = self._mesh.cell_sets[name][b]
            count = len(self._mesh.cells[b].data)
            if of_block is not None:
                numbers = np.asarray(of_block, dtype=np.int64).reshape(-1)
                if numbers.size > 0 and (numbers.min() < 0 or numbers.max() >= count):
                    raise ValueError(f"points: the cell set '{name}' has numbers beyond the {count} cells of block {b}")
                members.append(first + numbers)
            first += count
        return np.concatenate(members)

    def _set_names(self) -> list[str]:
        return [name for name in self._mesh.cell_sets if name not in _NOT_CELL_SETS]

    def _triangle_count(self) -> int:
        return sum(len(self._mesh.cells[b].data) for b in self._blocks())

    def _default_regions(self) -> list[np.ndarray]:
        arrays = region_arrays(self._mesh.cell_data, self._values)
        sets = self._set_names()
        if sets:
            arrays.append(labels_of_sets((self._members(name) for name in sets), self._triangle_count()))
        return arrays

    def _named_regions(self, name: str) -> np.ndarray:
        if name in self._mesh.cell_data:
            return one_value_each(self._values(name), name)
        if name in self._set_names():
            return labels_of_sets([self._members(name)], self._triangle_count())
        raise no_such_name("regions", name, "cell data or cell set", [*self._mesh.cell_data, *self._set_names()])

    def _default_fixed(self) -> Optional[np.ndarray]:
        return self._named_fixed("fixed") if "fixed" in self._mesh.point_data else None

    def _named_fixed(self, name: str) -> np.ndarray:
        mesh = self._mesh
        if name in mesh.point_data:
            return point_array_mask(mesh.point_data[name])
        if name in mesh.point_sets:
            return vertex_mask(mesh.point_sets[name], len(mesh.points), f"fixed: point set '{name}'")
        raise no_such_name("fixed", name, "point data or point set", [*mesh.point_data, *mesh.point_sets])


_WIDTHS = {"triangle": 3, "triangle6": 6}


def _nodes_of(cells: Any) -> Iterator[np.ndarray]:
    """Nodes of cells. Those of polyhedra are lists of faces of any number of nodes."""
    if isinstance(cells, (list, tuple)) or cells.dtype == object:
        for cell in cells:
            yield from _nodes_of(cell)
    else:
        yield np.asarray(cells)
