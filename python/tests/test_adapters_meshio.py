# SPDX-License-Identifier: BSD-3-Clause
"""meshio."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import trismooth
from adapter_meshes import edges, grid, quadratic_grid, same_bits, shapes, smallest_jacobian, smooth, smooth_in_place

meshio = pytest.importorskip("meshio")

G = grid()
LEFT, RIGHT = np.flatnonzero(G.regions == 1), np.flatnonzero(G.regions == 2)
DATA = Path(__file__).parents[2] / "examples" / "data"


def mesh_of(cells: Any, points: np.ndarray = G.points, **data: Any) -> Any:
    return meshio.Mesh(points.copy(), cells, **data)


def moved(before: Any, after: Any) -> np.ndarray:
    return ~same_bits(before.points, after.points)


@pytest.mark.parametrize("points", [G.points, G.points3, G.points.astype(np.float32), G.points3.astype(np.float32)])
def test_copy_is_smoothed_and_the_mesh_is_not(points: np.ndarray) -> None:
    mesh = mesh_of([("triangle", G.triangles)], points)
    result = smooth(mesh)
    assert type(result.mesh) is meshio.Mesh
    assert np.array_equal(mesh.points, points)
    assert result.mesh.points.dtype == points.dtype
    assert result.mesh.points.shape == points.shape
    assert np.array_equal(moved(mesh, result.mesh), ~G.is_boundary)
    assert shapes(result.mesh.points, G.triangles).min() > shapes(points, G.triangles).min() + 0.05


def test_data_are_kept() -> None:
    mesh = mesh_of(
        [("triangle", G.triangles)],
        point_data={"T": G.points[:, 0]},
        cell_data={"p": [np.arange(200)]},
        field_data={"steel": [1, 2]},
        point_sets={"corner": np.array([0])},
        info={"by": "hand"},
    )
    new = smooth(mesh).mesh
    assert np.array_equal(new.point_data["T"], mesh.point_data["T"])
    assert np.array_equal(new.cell_data["p"][0], np.arange(200))
    assert new.field_data == {"steel": [1, 2]}
    assert new.point_sets["corner"].tolist() == [0]
    assert new.info == {"by": "hand"}
    new.point_data["T"][0] = 9
    assert mesh.point_data["T"][0] == 0


def test_in_place() -> None:
    mesh = mesh_of([("triangle", G.triangles)])
    expected = smooth(mesh).mesh.points
    points = mesh.points
    assert smooth_in_place(mesh).mesh is mesh
    assert mesh.points is points
    assert np.array_equal(points, expected)


def test_whole_numbers_in_place_become_real_ones() -> None:
    triangles = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
    mesh = meshio.Mesh([[0, 0], [9, 0], [9, 9], [0, 9], [8, 7]], [("triangle", triangles)])
    smooth_in_place(mesh, method="smart")
    assert mesh.points.dtype == np.float64
    assert mesh.points[4].tolist() == [4.5, 4.5]


def test_blocks_and_data_of_known_names() -> None:
    cells = [("triangle", G.triangles[LEFT]), ("line", [[0, 1]]), ("triangle", G.triangles[RIGHT])]
    tags = [np.full(100, 4), np.array([8]), np.full((100, 1), 5)]
    for name in ("gmsh:physical", "gmsh:geometrical", "medit:ref", "cell_tags"):
        mesh = mesh_of(cells, cell_data={name: [np.array(t) for t in tags]})
        new = smooth(mesh).mesh
        assert np.array_equal(moved(mesh, new), G.is_inside)
        assert [block.type for block in new.cells] == ["triangle", "line", "triangle"]
        assert np.array_equal(moved(mesh, smooth(mesh, regions=False).mesh), ~G.is_boundary)
    mesh = mesh_of(cells, cell_data={"u": [np.array(t) / 2 for t in tags]})
    with pytest.warns(trismooth.MeshWarning, match="'u' .* does not hold whole numbers"):
        assert np.array_equal(moved(mesh, smooth(mesh).mesh), ~G.is_boundary)
    assert np.array_equal(moved(mesh, smooth(mesh, regions="u").mesh), G.is_inside)


def test_labels_in_the_order_of_the_blocks() -> None:
    cells = [("triangle", G.triangles[RIGHT]), ("vertex", [[0], [1]]), ("triangle", G.triangles[LEFT])]
    mesh = mesh_of(cells)
    for labels in (["r"] * 100 + ["l"] * 100, [2] * 100 + [7, 8] + [1] * 100):
        labels = np.array(labels)
        assert np.array_equal(moved(mesh, smooth(mesh, regions=labels).mesh), G.is_inside)


def test_cell_sets() -> None:
    lower = np.flatnonzero(G.row[G.triangles].min(axis=1) < 4)
    cells = [("line", [[0, 1]]), ("triangle", G.triangles)]
    sets = {"left": [None, LEFT], "lower": [np.array([0]), lower], "gmsh:bounding_entities": [None, np.array([999])]}
    mesh = mesh_of(cells, cell_sets=sets)
    assert np.array_equal(moved(mesh, smooth(mesh).mesh), G.is_inside & (G.row != 4))
    assert np.array_equal(moved(mesh, smooth(mesh, regions="left").mesh), G.is_inside)
    assert np.array_equal(moved(mesh, smooth(mesh, regions=False).mesh), ~G.is_boundary)
    new = smooth(mesh).mesh
    assert set(new.cell_sets) == set(sets)
    assert np.array_equal(new.cell_sets["left"][1], LEFT)


def test_fixed() -> None:
    lone = G.vertex(2, 8)
    mesh = mesh_of(
        [("triangle", G.triangles)],
        point_data={"fixed": (np.arange(len(G.points)) == lone).astype(float)},
        point_sets={"set": np.array([G.vertex(3, 3), lone])},
    )
    expected = ~G.is_boundary
    expected[lone] = False
    assert np.array_equal(moved(mesh, smooth(mesh, fixed=False).mesh), ~G.is_boundary)
    assert np.array_equal(moved(mesh, smooth(mesh, fixed=[lone]).mesh), expected)
    assert np.array_equal(moved(mesh, smooth(mesh, fixed="fixed").mesh), expected)
    expected[G.vertex(3, 3)] = False
    with pytest.warns(trismooth.MeshWarning, match=r"hold their vertices: 'set' \(2 vertices\); fixed=False frees"):
        assert np.array_equal(moved(mesh, smooth(mesh).mesh), expected)
    assert np.array_equal(moved(mesh, smooth(mesh, fixed="set").mesh), expected)
    assert np.array_equal(moved(mesh, smooth(mesh, fixed=["set", "fixed"]).mesh), expected)


def test_point_sets_that_are_of_an_area_hold_nothing() -> None:
    mesh = mesh_of([("triangle", G.triangles)], point_sets={"part": np.flatnonzero(G.column < 4)})
    with pytest.warns(trismooth.MeshWarning, match="cover an area hold nothing: 'part'; fixed='part' holds the vertices"):
        assert np.array_equal(moved(mesh, smooth(mesh).mesh), ~G.is_boundary)
    assert np.array_equal(moved(mesh, smooth(mesh, fixed="part").mesh), ~G.is_boundary & (G.column >= 4))


def test_labels_of_points_are_held_by_their_name() -> None:
    mesh = mesh_of([("triangle", G.triangles)], cell_data={"medit:ref": [G.regions]})
    result = smooth(mesh, fixed="medit:ref=2", regions=False)
    assert np.array_equal(moved(mesh, result.mesh), ~G.is_boundary & (G.column < 5))
    with pytest.raises(ValueError, match="^fixed: no point or cell .* has 'medit:ref=9'"):
        smooth(mesh, fixed="medit:ref=9")


def test_triangles_that_repeat_a_vertex_hold_theirs_as_in_a_file() -> None:
    flat = [[G.vertex(2, 2), G.vertex(2, 3), G.vertex(2, 2)]]
    mesh = mesh_of([("triangle", np.concatenate([G.triangles, flat]))])
    with pytest.warns(trismooth.MeshWarning, match="1 triangle repeating a vertex .the first is cell 200.: kept"):
        has_moved = moved(mesh, smooth(mesh).mesh)
    assert np.array_equal(np.flatnonzero(~has_moved & ~G.is_boundary), flat[0][:2])


def test_cells_that_are_not_triangles() -> None:
    line = [[G.vertex(2, 2), G.vertex(2, 3)], [G.vertex(2, 3), G.vertex(3, 4)]]
    line3 = [[G.vertex(7, 2), G.vertex(9, 2), G.vertex(8, 2)]]
    quad = [[G.vertex(7, 6), G.vertex(8, 6), G.vertex(8, 7), G.vertex(7, 7)]]
    polygon = [[G.vertex(1, 6), G.vertex(2, 6), G.vertex(2, 7), G.vertex(1, 7), G.vertex(1, 8)]]
    others = [("vertex", [[G.vertex(4, 4)]]), ("line3", line3), ("quad", quad), ("polygon", polygon)]
    mesh = mesh_of([("line", line), ("triangle", G.triangles), *others])
    expected = ~G.is_boundary
    for _, nodes in [("line", line), *others]:
        expected[np.ravel(nodes)] = False
    assert np.array_equal(moved(mesh, smooth(mesh).mesh), expected)


def test_line_cells_are_lines_where_vertices_slide() -> None:
    column = edges(G.middle_column)
    cells = [("line", column[:4]), ("triangle", G.triangles), ("line", column[4:]), ("vertex", [[G.vertex(5, 8)]])]
    mesh = mesh_of(cells)
    held = {"lines": column, "other_cells": [G.vertex(5, 8)], "slide": "straight"}
    expected = smooth(G.points, G.triangles, **held)
    result = smooth(mesh, slide="straight")
    assert np.array_equal(result.mesh.points, expected.points)
    has_moved = moved(mesh, result.mesh)[G.middle_column]
    assert has_moved[1:4].any() and has_moved[4] and not has_moved[8]
    assert np.array_equal(result.mesh.points[G.middle_column, 0], np.full(11, 0.5))
    assert result.sliding.slid == expected.sliding.slid > 0
    assert "10 of these cells are lines, which hold nothing with slide: their vertices slide where nothing else holds them" in result.notes
    # Data of regions and whole numbers tell them apart, unless these number them; others do not.
    def tagged_by(name, first, second):
        mesh.cell_data = {name: [first, np.ones(200), second, np.array([0])]}
        tagged = smooth(mesh, slide="straight")
        has_slid = moved(mesh, tagged.mesh)[G.vertex(5, 4)]
        assert tagged.sliding.lines == expected.sliding.lines + (0 if has_slid else 1)
        return not has_slid

    assert tagged_by("gmsh:physical", np.full(4, 3), np.full(6, 4))
    assert tagged_by("marker_of_sides", np.full(4, 3), np.full(6, 4))
    assert not tagged_by("number", np.arange(4), np.arange(4, 10))
    assert not tagged_by("u", np.full(4, 3.5), np.full(6, 4.5))
    assert not moved(mesh, smooth(mesh, slide="straight", regions="u").mesh)[G.vertex(5, 4)]
    mesh.cell_data = {}
    mesh.cell_sets = {"below": [np.arange(4), None, np.array([], dtype=int), None]}
    assert not moved(mesh, smooth(mesh, slide="straight").mesh)[G.vertex(5, 4)]
    # Where nothing slides they hold their vertices.
    assert not moved(mesh, smooth(mesh).mesh)[G.middle_column].any()
    assert smooth(mesh, lines=edges(G.middle_column)).sliding is None


def test_lines_of_the_user_are_in_place_of_those_of_the_mesh() -> None:
    mesh = mesh_of([("line", edges(G.middle_column)), ("triangle", G.triangles)])
    row = G.vertex(0, 3) + np.arange(11)
    for lines in (edges(row), False):
        result = smooth(mesh, slide="straight", lines=lines)
        of_arrays = {"lines": None if lines is False else lines, "slide": "straight"}
        assert np.array_equal(result.mesh.points, smooth(G.points, G.triangles, **of_arrays).points)
    with pytest.raises(ValueError, match="^line_tags: "):
        smooth(mesh, slide="straight", line_tags=np.ones(10))
    with pytest.raises(ValueError, match="^lines: vertex 999 "):
        smooth(mesh, slide="straight", lines=[[0, 999]])


def test_periodic_vertices_slide_as_one() -> None:
    mesh = mesh_of([("triangle", G.triangles)])
    left, right = (np.flatnonzero(G.column == column) for column in (0, 10))
    mesh.points[left[1:-1], 1] += np.random.default_rng(2).uniform(-0.03, 0.03, 9)
    mesh.points[right, 1] = mesh.points[left, 1]
    mesh.gmsh_periodic = [[1, (2, 1), [], np.column_stack([right, left])]]
    new = smooth(mesh, slide="straight").mesh.points
    assert np.array_equal(new[left, 1], new[right, 1])
    assert (new[left, 1] != mesh.points[left, 1]).any()
    apart = smooth(mesh, slide="straight", links=False).mesh.points
    assert (apart[left, 1] != apart[right, 1]).any()
    linked = smooth(mesh, slide="straight", links=np.column_stack([left, right])).mesh.points
    assert np.array_equal(linked, new)


def test_quadratic_triangles_do_not_slide() -> None:
    q = quadratic_grid()
    mesh = mesh_of([("triangle6", q.triangles)], q.points)
    with pytest.raises(ValueError, match="^slide: is for elements of corners alone"):
        smooth(mesh, slide="straight")
    held = smooth(q.points, q.triangles, lines=edges(G.middle_column), links=[[G.vertex(2, 2), G.vertex(3, 3)]])
    on_lines = [*G.middle_column, G.vertex(2, 2), G.vertex(3, 3)]
    assert same_bits(held.points, q.points)[on_lines].all()
    assert not same_bits(held.points, q.points)[: len(G.points)][G.is_inside].all()


@pytest.mark.skipif(not DATA.exists(), reason="the example meshes are not here")
@pytest.mark.skipif(not trismooth.build_info()["files"], reason="this build has no files")
def test_a_file_of_gmsh_slides_as_the_program_has_it() -> None:
    result = smooth(meshio.read(DATA / "channel.msh"), slide="curves", deviation=0.01)
    mesh = trismooth.read(DATA / "channel.msh")
    expected = mesh.smooth(slide="curves", deviation=0.01, method="mean-ratio")
    assert np.array_equal(result.mesh.points, mesh.points)
    assert repr(result.sliding) == repr(expected.sliding)
    assert result.sliding.slid > 0


def test_polyhedra_hold_their_vertices() -> None:
    # Faces of three and of four vertices.
    base = [G.vertex(2, 2), G.vertex(3, 2), G.vertex(3, 3), G.vertex(2, 3)]
    top = G.vertex(7, 7)
    faces = [np.array(base), *(np.array([base[k - 1], base[k], top]) for k in range(4))]
    mesh = mesh_of([("triangle", G.triangles), ("polyhedron5", [faces, faces])])
    expected = ~G.is_boundary
    expected[[*base, top]] = False
    assert np.array_equal(moved(mesh, smooth(mesh).mesh), expected)


def test_polygons_and_quadrilaterals_that_are_triangles() -> None:
    third = len(G.triangles) // 3
    quads = np.column_stack([G.triangles[third:, 0], G.triangles[third:]])
    quads = np.insert(quads, 5, [0, 1, 0, 12], axis=0)  # one that is none
    blocks = [("polygon", G.triangles[:third]), ("quad", quads)]
    labels = [G.regions[:third], np.insert(G.regions[third:], 5, 9)]
    count = len(G.triangles) - third
    expected = smooth(G.points, G.triangles, regions=G.regions, fixed=[0, 1, 12]).points
    of_all = np.concatenate(labels)
    sets = {"left": [np.flatnonzero(of_block == 1) for of_block in labels]}
    for mesh, options in (
        (meshio.Mesh(G.points, blocks, cell_data={"material": labels}), {}),
        (meshio.Mesh(G.points, blocks, cell_sets=sets), {}),
        (meshio.Mesh(G.points, blocks), {"regions": of_all}),
        (meshio.Mesh(G.points, blocks), {"regions": G.regions}),
    ):
        with pytest.warns(trismooth.MeshWarning, match=f"^{count} quadrilaterals repeat a corner"):
            result = smooth(mesh, **options)
        assert same_bits(result.mesh.points, expected).all()


def test_quadratic_triangles() -> None:
    q = quadratic_grid()
    mesh = mesh_of([("triangle6", q.triangles)], q.points, cell_data={"gmsh:physical": [q.grid.regions]})
    new = smooth(mesh).mesh
    count = len(q.grid.points)
    assert np.array_equal(moved(mesh, new)[:count], q.grid.is_inside)
    middles, straight = new.points[count:], new.points[q.sides].mean(axis=1)
    assert same_bits(middles, q.points[count:])[q.is_boundary_side].all()
    assert np.allclose(middles[~q.is_boundary_side], straight[~q.is_boundary_side], rtol=0, atol=1e-12)
    assert smallest_jacobian(new.points, q.triangles) > 0


@pytest.mark.skipif(not DATA.exists(), reason="the example meshes are not here")
def test_file_of_gmsh(tmp_path: Path) -> None:
    mesh = meshio.read(DATA / "channel.msh")
    physical = mesh.get_cell_data("gmsh:physical", "triangle")
    triangles = mesh.get_cells_type("triangle")
    tags_at = [set(physical[(triangles == v).any(axis=1)]) for v in range(len(mesh.points))]
    held = np.array([len(tags) > 1 for tags in tags_at])
    held[mesh.get_cells_type("line")] = True
    assert held.any() and not held.all()
    new = smooth(mesh).mesh
    has_moved = moved(mesh, new)
    assert not has_moved[held].any()
    assert has_moved.sum() > 300
    assert shapes(new.points, triangles).mean() > shapes(mesh.points, triangles).mean() + 0.01
    new.write(tmp_path / "new.msh", file_format="gmsh")
    again = meshio.read(tmp_path / "new.msh")
    assert np.array_equal(again.points, new.points)
    assert np.array_equal(again.get_cell_data("gmsh:physical", "triangle"), physical)


def test_faults_name_the_argument() -> None:
    mesh = mesh_of(
        [("triangle", G.triangles)], cell_data={"flux": [np.zeros((200, 2))]}, cell_sets={"left": [LEFT]}
    )
    text = "^regions: the mesh has no cell array 'u' to take regions from; it has: flux; its cell sets: left"
    with pytest.raises(ValueError, match=text):
        smooth(mesh, regions="u")
    with pytest.raises(ValueError, match="^regions: the cell array 'flux' has"):
        smooth(mesh, regions="flux")
    with pytest.raises(ValueError, match="^points: the cell set 'bad' has numbers beyond the 200 cells of block 0"):
        smooth(mesh_of([("triangle", G.triangles)], cell_sets={"bad": [np.array([200])]}))
    with pytest.raises(ValueError, match="^regions: the labels have shape"):
        smooth(mesh, regions=np.zeros(7))
    with pytest.raises(ValueError, match="^fixed: the mesh has no point array or point set 'u' to hold; it has: none"):
        smooth(mesh, fixed="u", regions=False)
    with pytest.raises(ValueError, match="^points: it has no triangles"):
        smooth(mesh_of([("polygon", [[0, 1, 2, 13, 12]])]))
