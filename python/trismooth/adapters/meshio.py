"""Meshes of meshio."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Optional

import numpy as np

from .flat import (
    FlatMesh,
    any_mask,
    choose_fixed,
    choose_regions,
    combine_labels,
    float_points,
    labels_of_sets,
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
    vertex_mask,
    vertices_of,
    with_sides,
)

SUPPORTS_COPY = True

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
        None: the point data ``fixed``, if there are such, and vertices inside that point data of markers mark
        (``medit:ref``, ...), as the program judges it; with ``lines`` points of Gmsh's geometry as well. A name or
        names: of point data, where vertices are held whose value is not zero, or of point sets. An array: a mask, or
        vertex numbers.
    lines : bool
        Whether blocks ``line`` are lines for vertices to slide on. They differ where cell data that give regions or
        cell sets do. Vertices that a file of Gmsh calls periodic are linked.
    """
    return _Flattener(mesh).flatten(regions, fixed, lines)


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
        self._found = [_triangles_of(block) for block in mesh.cells]
        counts = {nodes: sum(len(t) for _, t in self._found if t.shape[1] == nodes) for nodes in (3, 6)}
        width = triangle_width(counts[3], counts[6])
        self._is_chosen = [len(t) > 0 and t.shape[1] == width for _, t in self._found]
        self._first_cell = np.cumsum([0] + [len(block.data) for block in mesh.cells])

    def flatten(self, regions: Any, fixed: Any, lines: bool) -> FlatMesh:
        mesh = self._mesh
        count = len(mesh.points)
        of_lines = [b for b, block in enumerate(mesh.cells) if lines and block.type == "line"]
        others = (self._without_triangles(b) for b in range(len(mesh.cells)) if b not in of_lines)
        of_others = [nodes for cells in others for nodes in _nodes_of(cells)]
        blocks = self._blocks()
        triangles = np.concatenate([self._found[b][1] for b in blocks])
        sides, side_tags = marked_sides([self._values(name, blocks) for name in side_names(mesh.cell_data)], triangles)
        all_lines, line_tags = None, None
        if lines:
            all_lines, line_tags = with_sides(
                np.concatenate([np.empty((0, 2), dtype=np.int64), *(mesh.cells[b].data for b in of_lines)]),
                self._line_tags(of_lines, regions) if of_lines else None,
                sides,
                side_tags,
            )
        notes = quads_note(sum(self._cell_count([b]) for b in blocks if mesh.cells[b].data.shape[1] in (4, 8)))
        flat = FlatMesh(
            float_points(mesh.points),
            triangles,
            regions=choose_regions(
                regions,
                default=lambda: self._default_regions(triangles, notes),
                named=self._named_regions,
                cell_of_triangle=np.concatenate([self._first_cell[b] + self._found[b][0] for b in blocks]),
                cell_count=int(self._first_cell[-1]),
            ),
            other_cells=vertices_of(of_others if lines else [*of_others, sides], count),
            lines=all_lines,
            line_tags=line_tags,
            links=self._links() if lines else None,
            notes=notes,
        )
        on_lines = vertices_of([*of_others, sides if all_lines is None else all_lines], count)
        flat.fixed = choose_fixed(
            fixed, count, default=lambda: self._default_fixed(flat, on_lines, lines), named=self._named_fixed
        )
        return flat

    def _line_tags(self, blocks: list[int], regions: Any) -> Optional[np.ndarray]:
        """A number for each line: they differ where cell data that give regions or cell sets do."""
        of_data = tags_of_lines(self._mesh.cell_data, regions, lambda name: self._values(name, blocks))
        count = self._cell_count(blocks)
        of_sets = labels_of_sets((self._members(name, blocks) for name in self._set_names()), count)
        return combine_labels([of_sets] if of_data is None else [of_data, of_sets])

    def _links(self) -> Optional[np.ndarray]:
        """Pairs of vertices that a file of Gmsh calls periodic."""
        entities = getattr(self._mesh, "gmsh_periodic", None) or []
        pairs = [np.asarray(entity[3], dtype=np.int64).reshape(-1, 2) for entity in entities]
        return np.concatenate(pairs) if pairs else None

    def _blocks(self) -> list[int]:
        """Numbers of the blocks with the triangles that are smoothed."""
        return [b for b, chosen in enumerate(self._is_chosen) if chosen]

    def _cell_count(self, blocks: list[int]) -> int:
        return sum(len(self._rows(b)) for b in blocks)

    def _rows(self, b: int) -> np.ndarray:
        """Numbers of the cells of a block: of those that are triangles, where they are smoothed."""
        return self._found[b][0] if self._is_chosen[b] else np.arange(len(self._mesh.cells[b].data))

    def _without_triangles(self, b: int) -> Any:
        """The cells of a block that are not smoothed."""
        cells = self._mesh.cells[b].data
        return np.delete(cells, self._found[b][0], axis=0) if self._is_chosen[b] else cells

    def _values(self, name: str, blocks: list[int]) -> np.ndarray:
        """Values of cell data at the cells of the blocks."""
        data = self._mesh.cell_data[name]
        of_blocks = (np.asarray(data[b])[self._rows(b)] for b in blocks)
        return np.concatenate([values.reshape(-1) if values.shape[1:] == (1,) else values for values in of_blocks])

    def _members(self, name: str, blocks: list[int]) -> np.ndarray:
        """Numbers of the cells in a cell set, counted over the blocks."""
        first, members = 0, [np.empty(0, dtype=np.int64)]
        for b in blocks:
            of_block = self._mesh.cell_sets[name][b]
            count = len(self._mesh.cells[b].data)
            if of_block is not None:
                numbers = np.asarray(of_block, dtype=np.int64).reshape(-1)
                if numbers.size > 0 and (numbers.min() < 0 or numbers.max() >= count):
                    raise ValueError(f"points: the cell set '{name}' has numbers beyond the {count} cells of block {b}")
                rows = self._rows(b)
                members.append(first + np.flatnonzero(np.isin(rows, numbers)))
            first += self._cell_count([b])
        return np.concatenate(members)

    def _set_names(self) -> list[str]:
        return [name for name in self._mesh.cell_sets if name not in _NOT_CELL_SETS]

    def _default_regions(self, triangles: np.ndarray, notes: list[str]) -> list[np.ndarray]:
        blocks = self._blocks()
        arrays = region_arrays(
            self._mesh.cell_data, lambda name: self._values(name, blocks), triangles, len(self._mesh.points), notes
        )
        sets = self._set_names()
        if sets:
            arrays.append(labels_of_sets((self._members(name, blocks) for name in sets), self._cell_count(blocks)))
        return arrays

    def _named_regions(self, name: str) -> np.ndarray:
        blocks = self._blocks()
        if name in self._mesh.cell_data:
            return one_value_each(self._values(name, blocks), name)
        if name in self._set_names():
            return labels_of_sets([self._members(name, blocks)], self._cell_count(blocks))
        raise no_such_name("regions", name, "cell data or cell set", [*self._mesh.cell_data, *self._set_names()])

    def _default_fixed(self, flat: FlatMesh, on_lines: Optional[np.ndarray], lines: bool) -> Optional[np.ndarray]:
        data = self._mesh.point_data
        return any_mask(
            [
                self._named_fixed("fixed") if "fixed" in data else None,
                self._on_points_of_geometry() if lines else None,
                marked_points(data, lambda name: np.asarray(data[name]), flat, on_lines),
            ]
        )

    def _on_points_of_geometry(self) -> Optional[np.ndarray]:
        """Nodes that a file of Gmsh says are points of its geometry. It says nothing if none is of a surface."""
        entities = self._mesh.point_data.get("gmsh:dim_tags")
        if entities is None or not (np.asarray(entities)[:, 0] > 1).any():
            return None
        is_point: np.ndarray = np.asarray(entities)[:, 0] == 0
        return is_point

    def _named_fixed(self, name: str) -> np.ndarray:
        mesh = self._mesh
        if name in mesh.point_data:
            return point_array_mask(mesh.point_data[name])
        if name in mesh.point_sets:
            return vertex_mask(mesh.point_sets[name], len(mesh.points), f"fixed: point set '{name}'")
        raise no_such_name("fixed", name, "point data or point set", [*mesh.point_data, *mesh.point_sets])


def _triangles_of(block: Any) -> tuple[np.ndarray, np.ndarray]:
    """Which cells of a block are triangles, and their nodes."""
    cells = block.data
    is_polygon = block.type.startswith("polygon")
    width = cells.shape[1] if isinstance(cells, np.ndarray) and cells.dtype != object and cells.ndim == 2 else 0
    if (block.type, width) in (("triangle", 3), ("triangle6", 6)) or (is_polygon and width == 3):
        return np.arange(len(cells)), cells
    if (block.type, width) in (("quad", 4), ("quad8", 8)) or (is_polygon and width == 4):
        return triangles_of_quads(cells)
    return np.empty(0, dtype=np.int64), np.empty((0, 3), dtype=np.int64)



def _nodes_of(cells: Any) -> Iterator[np.ndarray]:
    """Nodes of cells. Those of polyhedra are lists of faces of any number of nodes."""
    if isinstance(cells, (list, tuple)) or cells.dtype == object:
        for cell in cells:
            yield from _nodes_of(cell)
    else:
        yield np.asarray(cells)
