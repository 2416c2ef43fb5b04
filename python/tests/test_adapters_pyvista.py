# SPDX-License-Identifier: BSD-3-Clause
"""PyVista and VTK."""

from __future__ import annotations

import os
import pickle
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import trismooth
from adapter_meshes import edges, grid, quadratic_grid, same_bits, shapes, smallest_jacobian, smooth, smooth_in_place
from trismooth import adapters

pv = pytest.importorskip("pyvista")

G = grid()
TRIANGLES = G.triangles
LINE = [G.vertex(2, 3), G.vertex(3, 3), G.vertex(3, 4)]
# Five corners: a cell that is no element.
FIVE = [G.vertex(7, 6), G.vertex(8, 6), G.vertex(9, 7), G.vertex(8, 7), G.vertex(7, 7)]
LONE = G.vertex(2, 8)
DATA = Path(__file__).parents[2] / "examples" / "data"


def poly_data(**cells: Any) -> Any:
    mesh = pv.PolyData(G.points3, faces=np.insert(TRIANGLES, 0, 3, axis=1).ravel(), **cells)
    mesh.point_data["T"] = G.points[:, 0] * 3
    mesh.field_data["note"] = ["kept"]
    return mesh


def unstructured_grid(*others: tuple[int, list[int]], first: bool = False) -> Any:
    """The grid's triangles and other cells, behind them or before them."""
    triangles = [(pv.CellType.TRIANGLE, list(t)) for t in TRIANGLES]
    cells = [*others, *triangles] if first else [*triangles, *others]
    flat = np.concatenate([[len(nodes), *nodes] for _, nodes in cells])
    return pv.UnstructuredGrid(flat, np.array([kind for kind, _ in cells], dtype=np.uint8), G.points3)


def moved(before: Any, after: Any) -> np.ndarray:
    return ~same_bits(np.asarray(before.points), np.asarray(after.points))


@pytest.mark.parametrize("make", [poly_data, unstructured_grid])
def test_copy_is_smoothed_and_the_mesh_is_not(make: Any) -> None:
    mesh = make()
    points = np.array(mesh.points)
    result = smooth(mesh)
    assert type(result.mesh) is type(mesh)
    assert np.array_equal(mesh.points, points)
    has_moved = moved(mesh, result.mesh)
    assert not has_moved[G.is_boundary].any()
    assert has_moved[~G.is_boundary].all()
    assert result.moved == has_moved.sum()
    assert shapes(result.mesh.points, TRIANGLES).min() > shapes(points, TRIANGLES).min() + 0.05


def test_data_and_type_of_points_are_kept() -> None:
    mesh = poly_data()
    mesh.points = mesh.points.astype(np.float32)
    mesh.cell_data["p"] = np.arange(mesh.n_cells)
    mesh.set_active_scalars("p")
    new = smooth(mesh).mesh
    assert new.points.dtype == np.float32
    assert np.array_equal(new["T"], mesh["T"])
    assert np.array_equal(new["p"], mesh["p"])
    assert list(new.field_data["note"]) == ["kept"]
    assert new.active_scalars_name == "p"
    assert np.array_equal(new.faces, mesh.faces)


def test_in_place() -> None:
    mesh = poly_data()
    expected = smooth(mesh).mesh.points
    view, time = mesh.points, mesh.GetMTime()
    result = smooth_in_place(mesh)
    assert result.mesh is mesh
    assert np.array_equal(mesh.points, expected)
    assert np.array_equal(view, expected)
    assert mesh.GetMTime() > time


def test_height_stays() -> None:
    mesh = poly_data()
    mesh.points[:, 2] = 0.7
    new = smooth(mesh).mesh
    assert np.all(new.points[:, 2] == mesh.points[0, 2])


def test_regions_chosen() -> None:
    mesh = poly_data()
    mesh.cell_data["u"] = G.regions / 2
    mesh.cell_data["v"] = (G.row[TRIANGLES].min(axis=1) < 5) / 2
    with pytest.warns(trismooth.MeshWarning):
        assert moved(mesh, smooth(mesh).mesh)[~G.is_boundary].all()
    by_u = moved(mesh, smooth(mesh, regions="u").mesh)
    assert np.array_equal(by_u, G.is_inside)
    by_both = moved(mesh, smooth(mesh, regions=["u", "v"]).mesh)
    assert np.array_equal(by_both, G.is_inside & (G.row != 5))
    by_labels = moved(mesh, smooth(mesh, regions=G.regions).mesh)
    assert np.array_equal(by_labels, by_u)


def test_fixed() -> None:
    mesh = poly_data()
    fixed = np.zeros(mesh.n_points)
    fixed[LONE] = 2
    mesh.point_data["fixed"] = fixed
    mesh.point_data["other"] = fixed[::-1].copy()
    expected = ~G.is_boundary
    expected[LONE] = False
    assert np.array_equal(moved(mesh, smooth(mesh).mesh), expected)
    assert np.array_equal(moved(mesh, smooth(mesh, fixed=False).mesh), ~G.is_boundary)
    assert np.array_equal(moved(mesh, smooth(mesh, fixed="other").mesh), expected[::-1])
    assert np.array_equal(moved(mesh, smooth(mesh, fixed=[LONE]).mesh), expected)
    assert np.array_equal(moved(mesh, smooth(mesh, fixed=fixed > 0).mesh), expected)


@pytest.mark.parametrize("first", [True, False])
def test_cells_that_are_not_triangles_of_grids(first: bool) -> None:
    lone = (pv.CellType.VERTEX, [LONE])
    mesh = unstructured_grid((pv.CellType.POLY_LINE, LINE), (pv.CellType.POLYGON, FIVE), lone, first=first)
    labels = np.concatenate([[7, 8, 9], G.regions] if first else [G.regions, [7, 8, 9]])
    mesh.cell_data["material"] = labels
    expected = G.is_inside
    expected[[*LINE, *FIVE, LONE]] = False
    new = smooth(mesh).mesh
    assert np.array_equal(moved(mesh, new), expected)
    assert np.array_equal(new.cells, mesh.cells)
    assert np.array_equal(new.celltypes, mesh.celltypes)
    for chosen in (labels, G.regions):
        assert np.array_equal(moved(mesh, smooth(mesh, regions=chosen).mesh), expected)


def test_cells_that_are_not_triangles_of_poly_data() -> None:
    faces = np.concatenate([[5, *FIVE], np.insert(TRIANGLES, 0, 3, axis=1).ravel()])
    mesh = pv.PolyData(G.points3, faces=faces, lines=[len(LINE), *LINE], verts=[1, LONE])
    # VTK's order: vertex, line, polygon, triangles.
    mesh.cell_data["material"] = np.concatenate([[7, 8, 9], G.regions])
    expected = G.is_inside
    expected[[*LINE, *FIVE, LONE]] = False
    new = smooth(mesh).mesh
    assert np.array_equal(moved(mesh, new), expected)
    assert np.array_equal(new.faces, mesh.faces)
    assert np.array_equal(new.lines, mesh.lines)


COLUMN = G.middle_column.tolist()


def with_lines(kind: Any, first: bool = False) -> Any:
    """The grid with the line between its regions as a polyline and two lines, and a vertex of it as a cell."""
    if kind is pv.PolyData:
        faces = np.insert(TRIANGLES, 0, 3, axis=1).ravel()
        lines = [9, *COLUMN[:9], 2, *COLUMN[8:10], 2, *COLUMN[9:]]
        return pv.PolyData(G.points3, faces=faces, lines=lines, verts=[1, COLUMN[7]])
    polyline, line = (pv.CellType.POLY_LINE, COLUMN[:9]), (pv.CellType.LINE, COLUMN[8:10])
    return unstructured_grid(polyline, line, (pv.CellType.LINE, COLUMN[9:]), (pv.CellType.VERTEX, [COLUMN[7]]), first=first)


def line_data(mesh: Any, *values: int) -> np.ndarray:
    """Values of the polyline and the two lines among those of all cells."""
    if isinstance(mesh, pv.PolyData):
        return np.concatenate([[0], values, np.ones(len(TRIANGLES))]).astype(int)
    ones = np.ones(len(TRIANGLES))
    is_first = mesh.celltypes[0] != pv.CellType.TRIANGLE
    return np.concatenate([values, [0], ones] if is_first else [ones, values, [0]]).astype(int)


@pytest.mark.parametrize("kind,first", [(pv.PolyData, False), (pv.UnstructuredGrid, False), (pv.UnstructuredGrid, True)])
def test_line_cells_are_lines_where_vertices_slide(kind: Any, first: bool) -> None:
    mesh = with_lines(kind, first)
    arrays = {"lines": edges(G.middle_column), "other_cells": [COLUMN[7]], "slide": "straight"}
    expected = smooth(np.array(mesh.points), TRIANGLES, **arrays)
    result = smooth(mesh, slide="straight")
    assert np.array_equal(result.mesh.points, expected.points)
    has_moved = moved(mesh, result.mesh)[COLUMN]
    assert has_moved[[1, 2, 3, 8, 9]].sum() > 2 and not has_moved[[0, 7, 10]].any()
    assert repr(result.sliding) == repr(expected.sliding)
    # Cell arrays of regions tell them apart; others do so if they are named.
    for name, options in (("material", {}), ("u", {"regions": "u"})):
        tagged = with_lines(kind, first)
        tagged.cell_data[name] = line_data(tagged, 4, 5, 5)
        apart = smooth(tagged, slide="straight", **options)
        assert apart.sliding.vertices == result.sliding.vertices - 1
        assert not moved(tagged, apart.mesh)[COLUMN[8]]
        assert np.array_equal(apart.mesh.cell_data[name], tagged.cell_data[name])
    # Where nothing slides they hold their vertices.
    assert not moved(mesh, smooth(mesh).mesh)[COLUMN].any()
    del arrays["lines"]
    without = smooth(np.array(mesh.points), TRIANGLES, **arrays)
    assert np.array_equal(smooth(mesh, slide="straight", lines=False).mesh.points, without.points)
    assert (without.points != expected.points).any()


def rows_as_strips() -> list[list[int]]:
    """The grid's triangles as one strip a row and region. Triangles of a row lie side by side."""
    strips = []
    for row in range(10):
        for columns in (range(6), range(5, 11)):
            # The diagonals go from the lower left to the upper right.
            strips.append([v for c in columns for v in (G.vertex(c, row + 1), G.vertex(c, row))])
    return strips


def test_strips() -> None:
    strips = rows_as_strips()
    flat = np.concatenate([[len(strip), *strip] for strip in strips])
    mesh = pv.PolyData(G.points3, strips=flat)
    grid_of_strips = pv.UnstructuredGrid(flat, np.full(len(strips), pv.CellType.TRIANGLE_STRIP), G.points3)
    triangulated = mesh.triangulate().regular_faces
    for strip_mesh in (mesh, grid_of_strips):
        strip_mesh.cell_data["material"] = [1, 2] * 10
        found = adapters.find(strip_mesh).flatten(strip_mesh)
        # VTK's own filter has the same triangles, with corners in the same direction.
        turned = [np.roll(t, -int(np.argmin(t))).tolist() for t in found.triangles]
        assert sorted(turned) == sorted(np.roll(t, -int(np.argmin(t))).tolist() for t in triangulated)
        assert np.array_equal(moved(strip_mesh, smooth(strip_mesh).mesh), G.is_inside)


def test_quadratic_triangles() -> None:
    q = quadratic_grid()
    count = len(q.grid.points)
    cells = np.insert(q.triangles, 0, 6, axis=1).ravel()
    points = np.column_stack([q.points, np.zeros(len(q.points))])
    mesh = pv.UnstructuredGrid(cells, np.full(len(q.triangles), pv.CellType.QUADRATIC_TRIANGLE), points)
    mesh.cell_data["material"] = q.grid.regions
    new = smooth(mesh).mesh
    assert np.array_equal(moved(mesh, new)[:count], q.grid.is_inside)
    middles = new.points[count:]
    assert same_bits(middles, points[count:])[q.is_boundary_side].all()
    straight = new.points[q.sides].mean(axis=1)
    assert np.allclose(middles[~q.is_boundary_side], straight[~q.is_boundary_side], rtol=0, atol=1e-12)
    assert smallest_jacobian(points, q.triangles) > 0
    assert smallest_jacobian(new.points, q.triangles) > 0


@pytest.mark.parametrize("order", [1, 2])
def test_lagrange_triangles_are_those_of_their_order(order: int) -> None:
    q = quadratic_grid()
    nodes = q.triangles if order == 2 else q.triangles[:, :3]
    points = np.column_stack([q.points, np.zeros(len(q.points))])
    cells = np.insert(nodes, 0, nodes.shape[1], axis=1).ravel()
    kinds = (pv.CellType.LAGRANGE_TRIANGLE, {1: pv.CellType.TRIANGLE, 2: pv.CellType.QUADRATIC_TRIANGLE}[order])
    lagrange, ordinary = (smooth(pv.UnstructuredGrid(cells, np.full(len(nodes), k), points)).mesh for k in kinds)
    assert same_bits(np.asarray(lagrange.points), np.asarray(ordinary.points)).all()
    assert not np.array_equal(lagrange.points, points)
    assert set(lagrange.celltypes) == {pv.CellType.LAGRANGE_TRIANGLE}


def test_polygons_and_quadrilaterals_that_are_triangles_are_those_of_the_program(tmp_path: Path) -> None:
    quads = [[a, *t] if k % 2 else [*t, t[2]] for k, t in enumerate(TRIANGLES.tolist()) for a in t[:1]]
    none = [[0, 1, 12, 11], [0, 1, 0, 11]]  # four corners; a repeated one that does not follow
    kinds = np.arange(len(TRIANGLES)) % 4
    by_kind = {0: (5, 3), 1: (7, 3), 2: (9, 4), 3: (7, 4)}
    cells = [TRIANGLES[k].tolist() if by_kind[kind][1] == 3 else quads[k] for k, kind in enumerate(kinds)]
    types = np.array([by_kind[kind][0] for kind in kinds], dtype=np.uint8)
    flat = np.concatenate([[len(cell), *cell] for cell in cells])
    expected = np.asarray(smooth(G.points3, TRIANGLES).points)
    meshes = [pv.UnstructuredGrid(flat, types, G.points3), pv.PolyData(G.points3, faces=flat)]
    for mesh in meshes:
        mesh.cell_data["load"] = np.arange(len(cells)) * 0.5
        with pytest.warns(trismooth.MeshWarning, match=f"^{np.sum(kinds > 1)} quadrilaterals repeat a corner") as caught:
            result = smooth(mesh)
        assert same_bits(np.asarray(result.mesh.points), expected).all()
        assert str(caught[0].message) == result.notes[0]
    regions = G.regions
    with pytest.warns(trismooth.MeshWarning):
        held = smooth(meshes[0], regions=regions).mesh.points
    assert np.array_equal(moved(meshes[0], pv.PolyData(held)), G.is_inside)
    if trismooth.build_info()["files"]:
        meshes[0].save(tmp_path / "mesh.vtu")
        of_file = trismooth.read(tmp_path / "mesh.vtu")
        with pytest.warns(trismooth.MeshWarning):
            notes = of_file.smooth(method="mean-ratio").notes
        assert np.allclose(of_file.points, expected, rtol=0, atol=1e-15)
        assert f"{np.sum(kinds > 1)} quadrilaterals repeat a corner: they are smoothed as the triangles that they are" in notes
    more = np.concatenate([flat, *([4, *quad] for quad in none)])
    with pytest.warns(trismooth.MeshWarning):
        stay = smooth(pv.UnstructuredGrid(more, np.append(types, [9, 9]).astype(np.uint8), G.points3)).mesh
    has_moved = moved(meshes[0], stay)
    assert not has_moved[[0, 1, 11, 12]].any() and has_moved[13]


def test_quadrilaterals_of_eight_nodes_that_are_triangles_of_six() -> None:
    q = quadratic_grid()
    points = np.column_stack([q.points, np.zeros(len(q.points))])
    a, b, c, ab, bc, ca = q.triangles.T
    quads = np.column_stack([a, b, c, c, ab, bc, c, ca])
    quads[::3] = np.column_stack([a, a, b, c, a, ab, bc, ca])[::3]
    kind = pv.CellType.QUADRATIC_QUAD
    with pytest.warns(trismooth.MeshWarning, match="quadrilaterals repeat a corner"):
        of_quads = smooth(pv.UnstructuredGrid(np.insert(quads, 0, 8, axis=1).ravel(), np.full(len(quads), kind), points))
    expected = smooth(points, q.triangles).points
    assert same_bits(np.asarray(of_quads.mesh.points), np.asarray(expected)).all()


def test_triangles_of_both_kinds() -> None:
    q = quadratic_grid()
    left = q.grid.regions == 1
    cells = [*([6, *t] for t in q.triangles[left]), *([3, *t[:3]] for t in q.triangles[~left][:-7])]
    kinds = [22 if cell[0] == 6 else 5 for cell in cells]
    points = np.column_stack([q.points, np.zeros(len(q.points))])
    mesh = pv.UnstructuredGrid(np.concatenate(cells), np.array(kinds, dtype=np.uint8), points)
    has_moved = moved(mesh, smooth(mesh).mesh)[: len(q.grid.points)]
    corners = np.concatenate([q.triangles[left, :3], q.triangles[~left, :3][:-7]])
    expected = smooth(q.grid.points, corners).points
    assert np.array_equal(has_moved, ~same_bits(q.grid.points, expected))
    assert has_moved[q.grid.column < 5].any() and has_moved[q.grid.column > 5].any()


def plain_vtk(mesh: Any) -> Any:
    from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkUnstructuredGrid

    plain = (vtkPolyData if isinstance(mesh, pv.PolyData) else vtkUnstructuredGrid).__mro__[0]()
    plain.DeepCopy(mesh)
    return plain


@pytest.mark.parametrize("make", [poly_data, unstructured_grid])
@pytest.mark.parametrize("inplace", [True, False])
def test_plain_vtk(make: Any, inplace: bool) -> None:
    mesh = make()
    mesh.cell_data["material"] = G.regions
    plain = plain_vtk(mesh)
    result = smooth_in_place(plain) if inplace else smooth(plain)
    assert result.mesh.GetClassName() == plain.GetClassName()
    assert (result.mesh is plain) is inplace
    assert np.array_equal(pv.wrap(result.mesh).points, smooth(mesh).mesh.points)


@pytest.mark.parametrize("make", [pv.ImageData, pv.Sphere().cast_to_pointset, pv.MultiBlock])
def test_other_types_are_refused(make: Any) -> None:
    mesh = pv.ImageData(dimensions=(3, 3, 1)) if make is pv.ImageData else make()
    with pytest.raises((TypeError, ValueError), match="^points: "):
        smooth(mesh)


def test_faults_name_the_argument() -> None:
    mesh = poly_data()
    mesh.cell_data["flux"] = np.zeros((mesh.n_cells, 2))
    with pytest.raises(ValueError, match="^regions: the mesh has no cell array 'u' to take regions from; it has: flux"):
        smooth(mesh, regions="u")
    with pytest.raises(ValueError, match="^regions: the cell array 'flux' has"):
        smooth(mesh, regions="flux")
    with pytest.raises(ValueError, match=r"^regions: the labels have shape \(3,\); expected 200"):
        smooth(mesh, regions=[1, 2, 3])
    with pytest.raises(ValueError, match="^fixed: the mesh has no point array or point set 'u' to hold; it has: T"):
        smooth(mesh, fixed="u")
    with pytest.raises(ValueError, match="^fixed: "):
        smooth(mesh, fixed=[mesh.n_points])
    with pytest.raises(ValueError, match="^points: it has no triangles"):
        smooth(pv.PolyData(G.points3))
    with pytest.raises(ValueError, match="^points: it has no cells"):
        smooth(pv.PolyData())


needs_accessors = pytest.mark.skipif(not hasattr(pv, "register_dataset_accessor"), reason="PyVista has no accessors")


@needs_accessors
@pytest.mark.parametrize("make", [poly_data, unstructured_grid])
def test_accessor(make: Any) -> None:
    assert adapters.find(make()).register_accessor()
    mesh = make()
    assert np.array_equal(mesh.trismooth.smooth().mesh.points, smooth(mesh, method="smart").mesh.points)
    assert type(mesh.trismooth.quality()) is type(trismooth.quality(mesh))
    assert not hasattr(pv.ImageData(), "trismooth")
    pickle.loads(pickle.dumps(mesh.trismooth.smooth().mesh))


def test_accessor_is_no_fault_of_older_versions(monkeypatch: pytest.MonkeyPatch) -> None:
    adapter = adapters.find(poly_data())
    monkeypatch.delattr(pv, "register_dataset_accessor", raising=False)
    assert not adapter.register_accessor()
    monkeypatch.setitem(sys.modules, "pyvista", None)
    assert not adapter.register_accessor()


@needs_accessors
@pytest.mark.parametrize(
    "imports", ["import pyvista", "import trismooth, pyvista", "import pyvista; import trismooth"]
)
def test_entry_point_brings_the_accessor(tmp_path: Path, imports: str) -> None:
    info = tmp_path / "trismooth_accessor-0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: trismooth-accessor\nVersion: 0\n")
    (info / "entry_points.txt").write_text("[pyvista.accessors]\ntrismooth = trismooth.adapters.pyvista\n")
    script = f"{imports}\nmesh = pyvista.Plane(i_resolution=3, j_resolution=3).triangulate()\n"
    script += "print(mesh.trismooth.smooth().mesh.n_cells)"
    path = os.pathsep.join([str(tmp_path), str(Path(trismooth.__file__).parents[1])])
    done = subprocess.run(
        [sys.executable, "-c", script], env={**os.environ, "PYTHONPATH": path}, capture_output=True, text=True
    )
    assert done.stdout.strip() == "18", done.stderr


@pytest.mark.skipif(not DATA.exists(), reason="the example meshes are not here")
@pytest.mark.parametrize(("name", "held"), [("machine.vtu", 804), ("farfield.vtk", 726)])
def test_as_many_are_held_as_the_program_says(name: str, held: int) -> None:
    # The numbers are what `trismooth smooth` prints: interfaces of one, lines before the triangles of the other.
    mesh = pv.read(DATA / name)
    has_moved = moved(mesh, smooth(mesh).mesh)
    assert (~has_moved).sum() == held


def test_points_of_integers_become_floats():
    points = np.array([[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0], [3, 3, 0]])
    faces = np.array([[3, 0, 1, 4], [3, 1, 2, 4], [3, 2, 3, 4], [3, 3, 0, 4]]).ravel()
    for inplace in (False, True):
        mesh = pv.PolyData(points, faces, force_float=False)
        result = smooth(mesh, inplace=inplace)
        np.testing.assert_array_equal(np.asarray(result.mesh.points), result.points)
        assert result.mesh.points.dtype.kind == "f" and (result.input_points is None) == inplace


def test_other_cells_of_the_user_are_checked_beside_those_of_the_mesh():
    points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.9, 0.8, 0]])
    mesh = pv.PolyData(points, faces=[3, 0, 1, 4, 3, 1, 2, 4, 3, 2, 3, 4, 3, 3, 0, 4], lines=[2, 0, 1])
    assert smooth(mesh, other_cells=[4]).moved == 0
    for wrong, error in (([-1], ValueError), ([10**6], ValueError), ([1.5], TypeError)):
        with pytest.raises(error, match="^other_cells: "):
            smooth(mesh, other_cells=wrong)
