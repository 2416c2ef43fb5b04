# SPDX-License-Identifier: BSD-3-Clause
"""scikit-fem."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from adapter_meshes import edges, grid, same_bits, shapes, smooth, smooth_in_place

skfem = pytest.importorskip("skfem")

G = grid()


def mesh1() -> Any:
    return skfem.MeshTri1(G.points.T.copy(), G.triangles.T.copy())


def mesh2() -> Any:
    """The grid with bent sides on the boundary."""
    straight = skfem.MeshTri2.from_mesh(mesh1())
    doflocs = straight.doflocs.copy()
    middles = straight.dofs.facet_dofs[0, straight.boundary_facets()]
    doflocs[:, middles] += 0.01 * (doflocs[:, middles] - 0.5)
    return skfem.MeshTri2(doflocs, straight.t)


def left(x: np.ndarray) -> np.ndarray:
    return x[0] < 0.5


def moved(before: Any, after: Any) -> np.ndarray:
    return ~same_bits(before.p.T, after.p.T)


def corners_moved(before: Any, after: Any) -> np.ndarray:
    return moved(before, after)[: len(G.points)]


def test_copy_is_smoothed_and_the_mesh_is_not() -> None:
    mesh = mesh1()
    result = smooth(mesh)
    assert type(result.mesh) is skfem.MeshTri1
    assert np.array_equal(mesh.p, G.points.T)
    assert np.array_equal(result.mesh.t, mesh.t)
    assert np.array_equal(moved(mesh, result.mesh), ~G.is_boundary)
    assert result.moved == (~G.is_boundary).sum()
    assert result.before.inverted == result.after.inverted == 0
    new = result.mesh.p.T
    assert shapes(new, G.triangles).min() > shapes(G.points, G.triangles).min() + 0.05


def test_triangles_in_either_direction() -> None:
    random = np.random.default_rng(3)
    order = random.permutation(len(G.points))
    place = np.argsort(order)
    # scikit-fem sorts the corners, so triangles of renumbered vertices turn either way.
    mesh = skfem.MeshTri1(G.points[order].T.copy(), place[G.triangles].T.copy())
    assert (mesh.orientation() < 0).any() and (mesh.orientation() > 0).any()
    result = smooth(mesh)
    assert np.array_equal(result.mesh.orientation(), mesh.orientation())
    assert result.before.inverted == 0
    # As if all of them were listed counter-clockwise.
    expected = smooth(G.points[order], place[G.triangles]).points
    assert np.allclose(result.mesh.p.T, expected, rtol=0, atol=1e-12)


def test_subdomains_and_boundaries_are_kept() -> None:
    mesh = mesh1().with_subdomains({"left": left}).with_boundaries({"wall": lambda x: x[1] == 0})
    new = smooth(mesh).mesh
    assert np.array_equal(new.subdomains["left"], mesh.subdomains["left"])
    assert np.array_equal(new.boundaries["wall"], mesh.boundaries["wall"])
    assert abs(new.restrict("left").p[0].max() - 0.5) < 1e-14


@pytest.mark.parametrize("make", [mesh1, mesh2])
def test_subdomains_are_regions(make: Any) -> None:
    # They overlap, and some triangles are in none.
    mesh = make().with_subdomains({"left": left, "low": lambda x: x[1] < x[1].mean()})
    low = np.zeros(mesh.nelements, dtype=bool)
    low[mesh.subdomains["low"]] = True
    in_both = np.zeros(len(G.points), dtype=int)
    for group in (low, ~low):
        in_both[np.unique(mesh.t[:, group])] += 1
    expected = G.is_inside & (in_both < 2)
    assert 0 < expected.sum() < G.is_inside.sum()
    assert np.array_equal(corners_moved(mesh, smooth(mesh).mesh), expected)
    assert np.array_equal(corners_moved(mesh, smooth(mesh, regions="left").mesh), G.is_inside)
    assert np.array_equal(corners_moved(mesh, smooth(mesh, regions=["left", "low"]).mesh), expected)
    assert np.array_equal(corners_moved(mesh, smooth(mesh, regions=False).mesh), ~G.is_boundary)
    assert np.array_equal(corners_moved(mesh, smooth(mesh, regions=low).mesh), ~G.is_boundary & (in_both < 2))


@pytest.mark.parametrize("make", [mesh1, mesh2])
def test_boundaries_inside_are_held(make: Any) -> None:
    mesh = make()
    facets = mesh.facets_satisfying(lambda x: x[0] == 0.5)
    assert len(facets) == 10
    mesh = mesh.with_boundaries({"crack": facets[2:5], "outside": mesh.boundary_facets()})
    ends = np.unique(mesh.facets[:, facets[2:5]])
    expected = ~G.is_boundary
    expected[ends] = False
    assert np.array_equal(corners_moved(mesh, smooth(mesh).mesh), expected)
    assert np.array_equal(corners_moved(mesh, smooth(mesh, fixed="crack").mesh), expected)
    assert np.array_equal(corners_moved(mesh, smooth(mesh, fixed="outside").mesh), ~G.is_boundary)
    assert np.array_equal(corners_moved(mesh, smooth(mesh, fixed=False).mesh), ~G.is_boundary)
    expected[G.vertex(2, 8)] = False
    assert np.array_equal(corners_moved(mesh, smooth(mesh, fixed=[G.vertex(2, 8)]).mesh), expected)


def test_boundaries_are_lines_where_vertices_slide() -> None:
    mesh = mesh1()
    facets = mesh.facets_satisfying(lambda x: x[0] == 0.5)
    facets = facets[np.argsort(mesh.p[1, mesh.facets[:, facets]].mean(axis=0))]
    column = G.middle_column
    whole = mesh.with_boundaries({"line": facets, "outside": mesh.boundary_facets()})
    result = smooth(whole, slide="straight")
    expected = smooth(G.points, G.triangles, lines=edges(column), slide="straight")
    assert np.array_equal(result.mesh.p.T, expected.points)
    assert moved(mesh, result.mesh)[column[1:-1]].any()
    parts = mesh.with_boundaries({"low": facets[:4], "high": facets[3:]})  # with a facet in both
    has_moved = moved(mesh, smooth(parts, slide="straight").mesh)[column]
    assert not has_moved[[0, 3, 4, 10]].any() and has_moved.any()
    has_moved = moved(mesh, smooth(parts, slide="straight", fixed="low").mesh)[column]
    assert not has_moved[:5].any() and has_moved[5:].any()
    fixed = smooth(parts, slide="straight", fixed=[column[7]])
    assert not moved(mesh, fixed.mesh)[column[7]]
    none = smooth(parts, slide="straight", fixed=False)
    assert np.array_equal(none.mesh.p.T, smooth(G.points, G.triangles, slide="straight").points)
    with pytest.raises(ValueError, match="^slide: is for elements of corners alone"):
        smooth(mesh2(), slide="straight")


def test_oriented_interface() -> None:
    mesh = mesh1().with_subdomains({"left": left})
    mesh = mesh.with_boundaries({"interface": mesh.facets_around("left")})
    new = smooth(mesh, regions=False).mesh
    assert np.array_equal(moved(mesh, new), G.is_inside)
    assert np.array_equal(new.boundaries["interface"].ori, mesh.boundaries["interface"].ori)


def test_quadratic_triangles() -> None:
    mesh = mesh2()
    new = smooth(mesh).mesh
    assert type(new) is skfem.MeshTri2
    assert np.array_equal(corners_moved(mesh, new), ~G.is_boundary)
    boundary = mesh.boundary_facets()
    inner = np.setdiff1d(np.arange(mesh.nfacets), boundary)
    middles = mesh.dofs.facet_dofs[0]
    assert not moved(mesh, new)[middles[boundary]].any()
    straight = new.p[:, new.facets].mean(axis=1)
    assert np.allclose(new.p[:, middles[inner]], straight[:, inner], rtol=0, atol=1e-12)
    # The determinants of scikit-fem's own maps keep the sign of each triangle.
    basis = [skfem.CellBasis(m, skfem.ElementTriP2(), intorder=6) for m in (mesh, new)]
    signs = [np.sign(b.mapping.detDF(b.X)) for b in basis]
    assert np.all(signs[0] == signs[0][:, :1])
    assert np.array_equal(signs[0], signs[1])


@pytest.mark.parametrize("make", [mesh1, mesh2])
def test_in_place(make: Any) -> None:
    mesh = make().with_subdomains({"left": left})
    expected = smooth(mesh).mesh
    twin = mesh.with_boundaries({})
    before = twin.p.copy()
    mesh.mapping()
    assert smooth_in_place(mesh).mesh is mesh
    assert np.array_equal(mesh.p, expected.p)
    # scikit-fem shares arrays between meshes, and keeps what it derived from points.
    assert np.array_equal(twin.p, before)
    X = np.array([[0.3], [0.2]])
    assert np.array_equal(mesh.mapping().F(X), expected.mapping().F(X))


def test_finder_follows_in_place() -> None:
    mesh = mesh1()
    mesh.element_finder()(np.array([0.5]), np.array([0.5]))
    smooth_in_place(mesh)
    centroids = mesh.p[:, mesh.t].mean(axis=1)
    assert np.array_equal(mesh.element_finder()(*centroids), np.arange(mesh.nelements))


def test_faults_name_the_argument() -> None:
    mesh = mesh1().with_subdomains({"left": left})
    with pytest.raises(ValueError, match="^regions: the mesh has no subdomain 'u'; it has: 'left'"):
        smooth(mesh, regions="u")
    with pytest.raises(ValueError, match="^regions: the labels have shape"):
        smooth(mesh, regions=[1, 2])
    with pytest.raises(ValueError, match="^fixed: the mesh has no boundary 'u'; it has: none"):
        smooth(mesh, fixed="u")
    with pytest.raises(ValueError, match=r"^fixed: shape \(1,\); expected"):
        smooth(mesh, fixed=[True])
    with pytest.raises(TypeError, match="^points: a MeshQuad2 is no MeshTri1, MeshTri2 or MeshQuad1"):
        smooth(skfem.MeshQuad2())
    with pytest.raises(TypeError, match="^points: the elements of a MeshTri1DG share no vertices"):
        smooth(skfem.MeshTri1DG.from_mesh(mesh1()))
