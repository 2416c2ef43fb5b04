# SPDX-License-Identifier: BSD-3-Clause
"""FEniCSx and Firedrake. They cannot be installed everywhere: classes with their names and their layouts of arrays stand
for their meshes."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from adapter_meshes import grid, quadratic_grid, same_bits, shapes, smallest_jacobian, smooth

G = grid()


class FenicsxMesh:
    """dolfinx.mesh.Mesh, as far as the adapter looks."""

    def __init__(self, points: np.ndarray, cells: Any, *, dim: Any = 2, size: int = 1, several: bool = False):
        self.x = np.zeros((len(points), 3), dtype=points.dtype)
        self.x[:, :2] = points
        cells = np.asarray(cells, dtype=np.int32)
        self.geometry = SimpleNamespace(x=self.x, dim=2, **({"dofmaps": [cells]} if several else {"dofmap": cells}))
        self.topology = SimpleNamespace(dim=dim)
        self.comm = SimpleNamespace(size=size)


FenicsxMesh.__name__, FenicsxMesh.__module__ = "Mesh", "dolfinx.mesh"


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


class FiredrakeMesh:
    """firedrake.mesh.MeshGeometry, as far as the adapter looks."""

    def __init__(self, points: np.ndarray, cells: Any, *, dim: Any = 2, size: int = 1) -> None:
        node_map = SimpleNamespace(values=np.asarray(cells, dtype=np.int32))
        self.x = points.copy()
        self.coordinates = SimpleNamespace(dat=Dat(self.x), cell_node_map=lambda: node_map)
        self.topological_dimension = dim
        self.comm = SimpleNamespace(size=size)
        self.clears = 0

    def clear_spatial_index(self) -> None:
        self.clears += 1


FiredrakeMesh.__name__, FiredrakeMesh.__module__ = "MeshGeometry", "firedrake.mesh"

both = pytest.mark.parametrize("Mesh", [FenicsxMesh, FiredrakeMesh])


def moved_by(mesh: Any, **options: Any) -> np.ndarray:
    before = mesh.x.copy()
    assert smooth(mesh, **options).mesh is mesh
    return ~same_bits(before, mesh.x)


@pytest.mark.parametrize("several", [False, True])
@pytest.mark.parametrize("precision", [np.float64, np.float32])
def test_in_place_in_fenicsx(precision: type, several: bool) -> None:
    mesh = FenicsxMesh(G.points.astype(precision), G.triangles, several=several)
    smooth(mesh)
    x = mesh.geometry.x
    assert x is mesh.x
    assert np.array_equal(~same_bits(x[:, :2], G.points.astype(precision)), ~G.is_boundary)
    assert not x[:, 2].any()
    assert shapes(x, G.triangles).min() > shapes(G.points, G.triangles).min() + 0.05


@pytest.mark.parametrize("dim", [2, lambda: 2])
def test_in_place_in_firedrake(dim: Any) -> None:
    mesh = FiredrakeMesh(G.points, G.triangles, dim=dim)
    assert np.array_equal(moved_by(mesh), ~G.is_boundary)
    assert mesh.coordinates.dat.writes == mesh.clears == 1
    assert shapes(mesh.x, G.triangles).min() > shapes(G.points, G.triangles).min() + 0.05


def test_complex_coordinates_of_firedrake() -> None:
    real, complex_ = FiredrakeMesh(G.points, G.triangles), FiredrakeMesh(G.points.astype(complex), G.triangles)
    assert np.array_equal(moved_by(real), moved_by(complex_))
    assert np.array_equal(complex_.x, real.x)


def test_vertices_slide() -> None:
    mesh = FenicsxMesh(G.points, G.triangles)
    result = smooth(mesh, slide="straight", regions=G.regions)
    expected = smooth(G.points, G.triangles, slide="straight", regions=G.regions)
    assert np.array_equal(mesh.x[:, :2], expected.points)
    assert result.sliding.slid > 0


def tags_of(dim: int, indices: np.ndarray, values: np.ndarray) -> Any:
    return SimpleNamespace(dim=dim, indices=indices.astype(np.int32), values=values.astype(np.int32))


def test_tags_of_fenicsx_are_regions() -> None:
    right = np.flatnonzero(G.regions == 2)
    # Cells without a tag are a region, too, also where a tag is 0.
    for tags in (tags_of(2, np.arange(200), G.regions), tags_of(2, right, np.zeros(len(right))),
                 tags_of(2, right, np.full(len(right), 5))):  # fmt: skip
        assert np.array_equal(moved_by(FenicsxMesh(G.points, G.triangles), regions=tags), G.is_inside)


@both
def test_regions_and_fixed(Mesh: Any) -> None:
    assert np.array_equal(moved_by(Mesh(G.points, G.triangles), regions=G.regions), G.is_inside)
    assert np.array_equal(moved_by(Mesh(G.points, G.triangles), regions=False), ~G.is_boundary)
    expected = ~G.is_boundary
    expected[[30, 40]] = False
    for fixed in ([30, 40], np.isin(np.arange(len(G.points)), [30, 40])):
        assert np.array_equal(moved_by(Mesh(G.points, G.triangles), fixed=fixed), expected)


@both
def test_quadratic_triangles(Mesh: Any) -> None:
    q = quadratic_grid()
    # The order of Basix and of FIAT, from their documentation: the middle of the side opposite to each corner.
    mesh = Mesh(q.points, np.column_stack([q.triangles[:, :3], q.triangles[:, [4, 5, 3]]]))
    count = len(q.grid.points)
    has_moved = moved_by(mesh)
    assert np.array_equal(has_moved[:count], ~q.grid.is_boundary)
    assert not has_moved[count:][q.is_boundary_side].any()
    straight = mesh.x[q.sides].mean(axis=1)[~q.is_boundary_side]
    assert np.allclose(mesh.x[count:][~q.is_boundary_side], straight, rtol=0, atol=1e-12)
    assert smallest_jacobian(mesh.x, q.triangles) > 0


@both
def test_faults_name_the_argument(Mesh: Any) -> None:
    name = "dolfinx" if Mesh is FenicsxMesh else "Firedrake"
    mesh = Mesh(G.points, G.triangles)
    before = mesh.x.copy()
    with pytest.raises(ValueError, match="^inplace: "):
        smooth(mesh, inplace=False)
    for argument in ("regions", "fixed"):
        with pytest.raises(TypeError, match=f"^{argument}: a {name} mesh has no array 'u'"):
            smooth(mesh, **{argument: "u"})
    assert np.array_equal(mesh.x, before)
    with pytest.raises(TypeError, match="^points: nodes of cells of shape"):
        smooth(Mesh(G.points, np.zeros((5, 5))))
    with pytest.raises(TypeError, match="^points: its cells have dimension 1"):
        smooth(Mesh(G.points, G.triangles, dim=1))
    with pytest.raises(ValueError, match="^points: it is distributed over 4 processes"):
        smooth(Mesh(G.points, G.triangles, size=4))


def test_faults_of_one_of_them() -> None:
    with pytest.raises(ValueError, match="^regions: the tags are of entities of dimension 1"):
        smooth(FenicsxMesh(G.points, G.triangles), regions=tags_of(1, np.arange(3), np.arange(3)))
    mesh = FiredrakeMesh(G.points, G.triangles)
    with pytest.raises(TypeError, match="^regions: "):
        smooth(mesh, regions="u")
    assert mesh.coordinates.dat.writes == mesh.clears == 0
    with pytest.raises(ValueError, match="^points: its coordinates are discontinuous"):
        smooth(FiredrakeMesh(G.points[G.triangles].reshape(-1, 2), np.arange(600).reshape(-1, 3)))


def test_quadrilaterals_of_fenicsx_are_smoothed() -> None:
    # Corners by rows, as dolfinx lists them.
    x, y = np.meshgrid(np.arange(6.0), np.arange(5.0))
    points = np.column_stack([x.ravel(), y.ravel()])
    cells = [[a, a + 1, a + 6, a + 7] for a in range(24) if a % 6 < 5]
    inner = (points.min(axis=1) > 0) & (points[:, 0] < 5) & (points[:, 1] < 4)
    moved = points + inner[:, None] * np.random.default_rng(3).uniform(-0.3, 0.3, points.shape)
    mesh = FenicsxMesh(moved, cells)
    result = smooth(mesh, method="mean-ratio")
    assert result.before.inverted == 0 and result.after["shape"].min > 0.99
    np.testing.assert_allclose(mesh.x[:, :2], points, atol=0.05)
