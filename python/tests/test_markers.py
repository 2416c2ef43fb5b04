# SPDX-License-Identifier: BSD-3-Clause
"""Vertices inside that arrays of markers mark are held by the adapters as by the program, which is said."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import trismooth
from adapter_meshes import grid

meshio = pytest.importorskip("meshio")

G = grid()
# A segment in the right half, an electrode in the left one.
SEGMENT = (G.row == 3) & (G.column > 6) & (G.column < 10)
ELECTRODE = (G.row == 7) & (G.column == 2)
MARKS = np.where(SEGMENT, 5, np.where(ELECTRODE, 6, 0))
# As Gmsh writes it: surfaces have numbers of their own, curves too.
OF_SURFACES = np.where(MARKS > 0, MARKS, np.where(G.is_boundary | G.is_interface, 1, np.where(G.column < 5, 11, 12)))


def by_meshio(name: str, markers: np.ndarray, regions: bool = True) -> Any:
    cell_data = {"medit:ref": [G.regions]} if regions else {}
    return meshio.Mesh(G.points3, [("triangle", G.triangles)], point_data={name: markers}, cell_data=cell_data)


def by_pyvista(name: str, markers: np.ndarray, regions: bool = True) -> Any:
    pyvista = pytest.importorskip("pyvista")
    mesh = pyvista.UnstructuredGrid({pyvista.CellType.TRIANGLE: G.triangles}, G.points3)
    mesh.point_data[name] = markers
    if regions:
        mesh.cell_data["medit:ref"] = G.regions
    return mesh


MAKERS = [by_meshio, by_pyvista]


def smoothed(mesh: Any, **options: Any) -> tuple[Any, np.ndarray, list[str]]:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        result = trismooth.smooth(mesh, method="mean-ratio", **options)
    assert [str(warning.message) for warning in caught] == result.notes
    assert all(warning.category is trismooth.MeshWarning for warning in caught)
    return result, (np.asarray(result.points)[:, :2] != G.points).any(axis=1), result.notes


@pytest.mark.parametrize("make", MAKERS)
@pytest.mark.parametrize(
    ("name", "markers"), [("medit:ref", MARKS), ("triangle:marker", MARKS), ("medit:ref", OF_SURFACES)]
)
def test_marked_vertices_are_held_and_named_with_the_way_out(
    make: Callable[..., Any], name: str, markers: np.ndarray
) -> None:
    marked = SEGMENT | ELECTRODE
    _, moved, notes = smoothed(make(name, markers))
    assert np.array_equal(moved, G.is_inside & ~marked)
    assert notes == [
        f"4 vertices inside, which '{name}' marks otherwise than what surrounds them: held fixed; fixed=False frees them"
    ]
    for fixed in (False, np.zeros(len(G.points), dtype=bool)):
        _, moved, notes = smoothed(make(name, markers), fixed=fixed)
        assert np.array_equal(moved, G.is_inside)
        assert notes == []


@pytest.mark.parametrize("make", MAKERS)
def test_the_array_fixed_holds_as_well(make: Callable[..., Any]) -> None:
    mesh = make("medit:ref", MARKS)
    mesh.point_data["fixed"] = (G.column == 3).astype(int)
    _, moved, _ = smoothed(mesh)
    assert np.array_equal(moved, G.is_inside & ~SEGMENT & ~ELECTRODE & (G.column != 3))


def test_lines_slide_though_their_vertices_are_marked() -> None:
    line = G.vertex(0, 3) + np.arange(11)
    lines = np.column_stack([line[:-1], line[1:]])
    points = G.points3.copy()
    points[line, 1] = 0.3
    markers = np.where(G.row == 3, 5, 0)
    mesh = meshio.Mesh(points, [("triangle", G.triangles), ("line", lines)], point_data={"medit:ref": markers})
    for slide in ("off", "straight"):
        result, _, notes = smoothed(mesh, slide=slide)
        moved = (np.asarray(result.points) != points).any(axis=1)[line[1:-1]]
        assert moved.any() == (slide == "straight")
        assert not any("medit:ref" in note for note in notes)
