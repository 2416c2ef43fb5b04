# SPDX-License-Identifier: BSD-3-Clause
"""Regions of meshes of other packages, beside what test_judge.py holds all doors to."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any, Callable

import numpy as np
import pytest

import trismooth
from adapter_meshes import grid, same_bits

meshio = pytest.importorskip("meshio")

G = grid()


def by_meshio(arrays: dict[str, np.ndarray]) -> Any:
    return meshio.Mesh(G.points3, [("triangle", G.triangles)], cell_data={name: [a] for name, a in arrays.items()})


def by_pyvista(arrays: dict[str, np.ndarray]) -> Any:
    pyvista = pytest.importorskip("pyvista")
    mesh = pyvista.UnstructuredGrid({5: G.triangles}, G.points3)
    for name, array in arrays.items():
        mesh.cell_data[name] = array
    return mesh


MAKERS: list[Callable[[dict[str, np.ndarray]], Any]] = [by_meshio, by_pyvista]


def moved(result: trismooth.Result) -> np.ndarray:
    return ~same_bits(np.asarray(result.points), G.points3)


def smoothed(mesh: Any, **options: Any) -> tuple[trismooth.Result, list[warnings.WarningMessage]]:
    """The result, and what was warned of."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        result = trismooth.smooth(mesh, **options)
    return result, caught


@pytest.mark.parametrize("make", MAKERS)
@pytest.mark.parametrize(("name", "guesses"), [("material", False), ("matl", True)])
def test_texts_give_regions_as_numbers_do(make: Callable[..., Any], name: str, guesses: bool) -> None:
    result, caught = smoothed(make({name: np.array(["air", "steel"])[G.regions - 1]}))
    assert np.array_equal(moved(result), G.is_inside)
    assert [str(warning.message) for warning in caught] == result.notes
    assert all(warning.category is trismooth.MeshWarning for warning in caught)
    assert len(result.notes) == guesses
    assert all(words in note for note in result.notes for words in ("'matl' (2 values)", "regions='matl'", "regions=False"))


@pytest.mark.parametrize("make", MAKERS)
def test_the_way_out_of_the_sentence_is_one(make: Callable[..., Any]) -> None:
    mesh = make({"matl": G.regions})
    for regions, expected in ((False, ~G.is_boundary), ("matl", G.is_inside)):
        result, caught = smoothed(mesh, regions=regions)
        assert np.array_equal(moved(result), expected)
        assert caught == [] and result.notes == []


def test_the_warning_is_of_the_callers_line() -> None:
    pytest.importorskip("pyvista")
    for call in (lambda: trismooth.smooth(by_pyvista({"matl": G.regions})),
                 lambda: by_pyvista({"matl": G.regions}).trismooth.smooth()):  # fmt: skip
        with pytest.warns(trismooth.MeshWarning, match="matl") as caught:
            call()
        assert [warning.filename for warning in caught] == [__file__]
    assert issubclass(trismooth.MeshWarning, UserWarning)


def test_named_boundaries_of_scikit_fem_are_sides_in_every_reader(tmp_path: Path) -> None:
    skfem = pytest.importorskip("skfem")
    mesh = skfem.MeshTri1(G.points.T.copy(), G.triangles.T.copy())
    facets = mesh.facets_satisfying(lambda x: x[0] == 0.5)
    mesh = mesh.with_boundaries({"crack": facets[2:5], "outside": mesh.boundary_facets()}).with_subdomains(
        {"low": lambda x: x[1] < 0.3}
    )
    expected = trismooth.smooth(mesh).mesh.p.T
    ends = np.unique(mesh.facets[:, facets[2:5]])
    written = pytest.importorskip("skfem.io.meshio").to_meshio(mesh)
    written.points = np.column_stack([written.points, np.zeros(len(written.points))])
    path = tmp_path / "mesh.vtu"
    written.write(path)
    given: list[Any] = [meshio.read(path)]
    try:
        import pyvista

        given.append(pyvista.read(path))
    except ImportError:
        pass
    for other in given:
        result, caught = smoothed(other)
        assert np.array_equal(np.asarray(result.points)[:, :2], expected)
        (warning,) = caught
        assert "named boundaries on sides of elements" in str(warning.message)
        freed, _ = smoothed(other, regions=False)
        assert same_bits(np.asarray(freed.points)[:, :2], G.points)[ends].all()
    slid, _ = smoothed(given[0], slide="straight")
    of_skfem, _ = smoothed(mesh, slide="straight")
    assert np.array_equal(np.asarray(slid.points)[:, :2], of_skfem.mesh.p.T)
    if trismooth.build_info()["files"]:
        of_file = trismooth.read(path)
        with pytest.warns(trismooth.MeshWarning, match="named boundaries on sides of elements"):
            report = of_file.smooth().report
        assert np.array_equal(of_file.points[:, :2], expected)
        assert [array["name"] for array in report["input"]["region_arrays"]] == ["skfem:s:low"]
        of_file = trismooth.read(path)
        with pytest.warns(trismooth.MeshWarning):
            of_file.smooth(slide="straight")
        assert np.array_equal(of_file.points[:, :2], of_skfem.mesh.p.T)
