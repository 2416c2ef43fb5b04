"""Firedrake. It cannot be installed everywhere: a class with its names and its layout of arrays stands for it."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from adapter_meshes import grid, quadratic_grid, same_bits, shapes, smallest_jacobian, smooth

G = grid()


class Dat:
    """Values of a function, which Firedrake wants to know about when they are written."""

    def __init__(self, values: np.ndarray) -> None:
        self.values = values
        self.writes = 0

    @property
    def data(self) -> np.ndarray:
        self.writes += 1
        return self.values

    @property
    def data_ro(self) -> np.ndarray:
        view = self.values.view()
        view.flags.writeable = False
        return view


class MeshGeometry:
    """firedrake.mesh.MeshGeometry, as far as the adapter looks."""

    __module__ = "firedrake.mesh"

    def __init__(self, points: np.ndarray, cells: Any, *, dim: Any = 2, size: int = 1) -> None:
        node_map = SimpleNamespace(values=np.asarray(cells, dtype=np.int32))
        self.coordinates = SimpleNamespace(dat=Dat(points.copy()), cell_node_map=lambda: node_map)
        self.topological_dimension = dim
        self.comm = SimpleNamespace(size=size)
        self.clears = 0

    def clear_spatial_index(self) -> None:
        self.clears += 1


def moved_by(mesh: MeshGeometry, **options: Any) -> np.ndarray:
    before = mesh.coordinates.dat.values.copy()
    assert smooth(mesh, **options).mesh is mesh
    return ~same_bits(before, mesh.coordinates.dat.values)


@pytest.mark.parametrize("dim", [2, lambda: 2])
def test_in_place(dim: Any) -> None:
    mesh = MeshGeometry(G.points, G.triangles, dim=dim)
    assert np.array_equal(moved_by(mesh), ~G.is_boundary)
    assert mesh.coordinates.dat.writes == 1
    assert mesh.clears == 1
    new = mesh.coordinates.dat.values
    assert shapes(new, G.triangles).min() > shapes(G.points, G.triangles).min() + 0.05


def test_complex_coordinates() -> None:
    real, complex_ = MeshGeometry(G.points, G.triangles), MeshGeometry(G.points.astype(complex), G.triangles)
    assert np.array_equal(moved_by(real), moved_by(complex_))
    assert np.array_equal(complex_.coordinates.dat.values, real.coordinates.dat.values)


def test_regions_and_fixed() -> None:
    assert np.array_equal(moved_by(MeshGeometry(G.points, G.triangles), regions=G.regions), G.is_inside)
    expected = ~G.is_boundary
    expected[[30, 40]] = False
    assert np.array_equal(moved_by(MeshGeometry(G.points, G.triangles), fixed=[30, 40]), expected)


def test_quadratic_triangles() -> None:
    q = quadratic_grid()
    # The order of FIAT: the middle of the side opposite to each corner.
    cells = np.column_stack([q.triangles[:, :3], q.triangles[:, 4], q.triangles[:, 5], q.triangles[:, 3]])
    mesh = MeshGeometry(q.points, cells)
    count = len(q.grid.points)
    has_moved = moved_by(mesh)
    assert np.array_equal(has_moved[:count], ~q.grid.is_boundary)
    assert not has_moved[count:][q.is_boundary_side].any()
    new = mesh.coordinates.dat.values
    straight = new[q.sides].mean(axis=1)[~q.is_boundary_side]
    assert np.allclose(new[count:][~q.is_boundary_side], straight, rtol=0, atol=1e-12)
    assert smallest_jacobian(new, q.triangles) > 0


def test_faults_name_the_argument() -> None:
    mesh = MeshGeometry(G.points, G.triangles)
    with pytest.raises(ValueError, match="^inplace: "):
        smooth(mesh, inplace=False)
    with pytest.raises(TypeError, match="^regions: a Firedrake mesh has no array 'u'"):
        smooth(mesh, regions="u")
    with pytest.raises(TypeError, match="^fixed: a Firedrake mesh has no array 'u'"):
        smooth(mesh, fixed="u")
    assert mesh.coordinates.dat.writes == mesh.clears == 0
    with pytest.raises(TypeError, match="^points: nodes of cells of shape"):
        smooth(MeshGeometry(G.points, np.zeros((5, 4))))
    with pytest.raises(TypeError, match="^points: its cells have dimension 3"):
        smooth(MeshGeometry(G.points, G.triangles, dim=3))
    with pytest.raises(ValueError, match="^points: it is distributed over 2 processes"):
        smooth(MeshGeometry(G.points, G.triangles, size=2))
    with pytest.raises(ValueError, match="^points: its coordinates are discontinuous"):
        smooth(MeshGeometry(G.points[G.triangles].reshape(-1, 2), np.arange(600).reshape(-1, 3)))
