"""FEniCSx. dolfinx cannot be installed everywhere: a class with its names and its layout of arrays stands for it."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from adapter_meshes import grid, quadratic_grid, same_bits, shapes, smallest_jacobian, smooth

G = grid()


class Mesh:
    """dolfinx.mesh.Mesh, as far as the adapter looks."""

    __module__ = "dolfinx.mesh"

    def __init__(self, points: np.ndarray, cells: np.ndarray, *, dim: int = 2, size: int = 1, several: bool = False):
        x = np.zeros((len(points), 3), dtype=points.dtype)
        x[:, :2] = points
        cells = np.asarray(cells, dtype=np.int32)
        self.geometry = SimpleNamespace(x=x, dim=2, **({"dofmaps": [cells]} if several else {"dofmap": cells}))
        self.topology = SimpleNamespace(dim=dim)
        self.comm = SimpleNamespace(size=size)


def tags_of(dim: int, indices: np.ndarray, values: np.ndarray) -> Any:
    return SimpleNamespace(dim=dim, indices=indices.astype(np.int32), values=values.astype(np.int32))


def moved_by(mesh: Mesh, **options: Any) -> np.ndarray:
    before = mesh.geometry.x.copy()
    smooth(mesh, **options)
    return ~same_bits(before, mesh.geometry.x)


@pytest.mark.parametrize("several", [False, True])
@pytest.mark.parametrize("precision", [np.float64, np.float32])
def test_in_place(precision: type, several: bool) -> None:
    mesh = Mesh(G.points.astype(precision), G.triangles, several=several)
    x = mesh.geometry.x
    result = smooth(mesh)
    assert result.mesh is mesh
    assert mesh.geometry.x is x
    assert np.array_equal(~same_bits(x[:, :2], G.points.astype(precision)), ~G.is_boundary)
    assert not x[:, 2].any()
    assert shapes(x, G.triangles).min() > shapes(G.points, G.triangles).min() + 0.05


def test_vertices_slide() -> None:
    mesh = Mesh(G.points, G.triangles)
    result = smooth(mesh, slide="straight", regions=G.regions)
    expected = smooth(G.points, G.triangles, slide="straight", regions=G.regions)
    assert np.array_equal(mesh.geometry.x[:, :2], expected.points)
    assert result.sliding.slid > 0


def test_tags_are_regions() -> None:
    right = np.flatnonzero(G.regions == 2)
    every = np.arange(200)
    assert np.array_equal(moved_by(Mesh(G.points, G.triangles), regions=tags_of(2, every, G.regions)), G.is_inside)
    # Cells without a tag are a region, too, also where a tag is 0.
    for value in (0, 5):
        tags = tags_of(2, right, np.full(len(right), value))
        assert np.array_equal(moved_by(Mesh(G.points, G.triangles), regions=tags), G.is_inside)
    assert np.array_equal(moved_by(Mesh(G.points, G.triangles), regions=G.regions), G.is_inside)
    assert np.array_equal(moved_by(Mesh(G.points, G.triangles), regions=False), ~G.is_boundary)


def test_fixed() -> None:
    expected = ~G.is_boundary
    expected[[30, 40]] = False
    assert np.array_equal(moved_by(Mesh(G.points, G.triangles), fixed=[30, 40]), expected)
    mask = np.isin(np.arange(len(G.points)), [30, 40])
    assert np.array_equal(moved_by(Mesh(G.points, G.triangles), fixed=mask), expected)


def test_quadratic_triangles() -> None:
    q = quadratic_grid()
    # The order of Basix, from its documentation: the middle of the side opposite to each corner.
    middle_opposite = {0: q.triangles[:, 4], 1: q.triangles[:, 5], 2: q.triangles[:, 3]}
    cells = np.column_stack([q.triangles[:, :3], *(middle_opposite[corner] for corner in range(3))])
    mesh = Mesh(q.points, cells)
    count = len(q.grid.points)
    has_moved = moved_by(mesh)
    assert np.array_equal(has_moved[:count], ~q.grid.is_boundary)
    assert not has_moved[count:][q.is_boundary_side].any()
    x = mesh.geometry.x
    straight = x[q.sides].mean(axis=1)[~q.is_boundary_side]
    assert np.allclose(x[count:][~q.is_boundary_side], straight, rtol=0, atol=1e-12)
    assert smallest_jacobian(x, q.triangles) > 0


def test_faults_name_the_argument() -> None:
    mesh = Mesh(G.points, G.triangles)
    before = mesh.geometry.x.copy()
    with pytest.raises(ValueError, match="^inplace: "):
        smooth(mesh, inplace=False)
    with pytest.raises(TypeError, match="^regions: a dolfinx mesh has no array 'u'"):
        smooth(mesh, regions="u")
    with pytest.raises(ValueError, match="^regions: the tags are of entities of dimension 1"):
        smooth(mesh, regions=tags_of(1, np.arange(3), np.arange(3)))
    with pytest.raises(TypeError, match="^fixed: a dolfinx mesh has no array 'u'"):
        smooth(mesh, fixed="u")
    assert np.array_equal(mesh.geometry.x, before)
    with pytest.raises(TypeError, match="^points: nodes of cells of shape"):
        smooth(Mesh(G.points, np.zeros((5, 4))))
    with pytest.raises(TypeError, match="^points: its cells have dimension 1"):
        smooth(Mesh(G.points, G.triangles, dim=1))
    with pytest.raises(ValueError, match="^points: it is distributed over 4 processes"):
        smooth(Mesh(G.points, G.triangles, size=4))
