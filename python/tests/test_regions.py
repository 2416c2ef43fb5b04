"""Which cell arrays give regions: one judge for the program and for every adapter."""

from __future__ import annotations

import json
import subprocess
import sys
import warnings
from pathlib import Path
from typing import Any, Callable

import numpy as np
import pytest

import trismooth
from adapter_meshes import grid, same_bits
from program import PROGRAM

meshio = pytest.importorskip("meshio")

G = grid()
COUNT = len(G.triangles)


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


# Names, values and whether they hold what is between them: True, by a guess, or False. What is said, if anything.
TRIANGLES = np.arange(COUNT)
ARRAYS = [
    ("material", G.regions, True, None),
    ("matl", G.regions, True, "looks like regions"),
    ("matl", np.array(["air", "steel"])[G.regions - 1], True, "looks like regions"),
    ("matl", G.regions.astype(float), True, "looks like regions"),
    ("matl", G.regions + 0.5, False, "does not hold whole numbers"),
    ("rank of the part", G.regions, False, "by its name it is for another purpose"),
    ("cell_id", TRIANGLES, False, None),
    ("tag", TRIANGLES, False, "is not taken for regions"),
    ("trismooth:shape", G.regions, False, None),
    ("matl", np.full(COUNT, 3), False, None),
]


@pytest.mark.parametrize("make", MAKERS)
@pytest.mark.parametrize(("name", "values", "holds", "said"), ARRAYS)
def test_what_holds_is_held_and_what_is_guessed_is_said(
    make: Callable[..., Any], name: str, values: np.ndarray, holds: bool, said: str | None
) -> None:
    result, caught = smoothed(make({name: values}))
    assert np.array_equal(moved(result), G.is_inside if holds else ~G.is_boundary)
    if said is None:
        assert result.notes == []
    else:
        (note,) = result.notes
        assert f"'{name}'" in note and said in note and f"regions={name!r}" in note
    assert [str(warning.message) for warning in caught] == result.notes
    assert all(warning.category is trismooth.MeshWarning for warning in caught)


@pytest.mark.parametrize("make", MAKERS)
def test_the_way_out_of_the_sentence_is_one(make: Callable[..., Any]) -> None:
    mesh = make({"matl": G.regions})
    for regions, expected in ((False, ~G.is_boundary), ("matl", G.is_inside)):
        result, caught = smoothed(mesh, regions=regions)
        assert np.array_equal(moved(result), expected)
        assert caught == [] and result.notes == []


def test_vectors_under_a_name_of_regions_are_named() -> None:
    result, _ = smoothed(by_meshio({"material": np.ones((COUNT, 3))}))
    assert np.array_equal(moved(result), ~G.is_boundary)
    assert result.notes == ["the cell array 'material' has 3 components: it is not taken for regions"]


def test_the_warning_is_of_the_callers_line() -> None:
    pytest.importorskip("pyvista")
    for call in (lambda: trismooth.smooth(by_pyvista({"matl": G.regions})),
                 lambda: by_pyvista({"matl": G.regions}).trismooth.smooth()):  # fmt: skip
        with pytest.warns(trismooth.MeshWarning, match="matl") as caught:
            call()
        assert [warning.filename for warning in caught] == [__file__]
    assert issubclass(trismooth.MeshWarning, UserWarning)


@pytest.mark.skipif(not trismooth.build_info()["files"], reason="this build has no files")
@pytest.mark.parametrize(("name", "values", "holds", "said"), [a for a in ARRAYS if a[1].dtype.kind != "U"])
def test_program_file_and_adapters_judge_alike(
    name: str, values: np.ndarray, holds: bool, said: str | None, tmp_path: Path
) -> None:
    path = tmp_path / "in.vtu"
    by_meshio({name: values}).write(path)
    result, _ = smoothed(by_meshio({name: values}))
    mesh = trismooth.read(path)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        of_file = mesh.smooth()
    assert np.array_equal(mesh.points, np.asarray(result.points))
    # The same sentences, but for how each says that there are no regions.
    about_array = [note for note in of_file.notes if f"'{name}'" in note]
    assert result.notes == [note.replace("regions='none'", "regions=False") for note in about_array]
    assert [str(warning.message) for warning in caught] == of_file.notes
    assert all(warning.filename == __file__ for warning in caught)
    command = [PROGRAM] if PROGRAM else [sys.executable, "-m", "trismooth"]
    report = tmp_path / "report.json"
    subprocess.run(
        [*command, "smooth", path, tmp_path / "out.vtu", "--report", report], check=True, capture_output=True
    )
    interface = np.asarray(meshio.read(tmp_path / "out.vtu").points)
    assert np.array_equal(interface, mesh.points)
    arrays = json.loads(report.read_text())["input"]["region_arrays"]
    assert [array["name"] for array in arrays] == ([name] if holds else [])


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
        assert caught == []
        freed, _ = smoothed(other, regions=False)
        assert same_bits(np.asarray(freed.points)[:, :2], G.points)[ends].all()
    slid, _ = smoothed(given[0], slide="straight")
    of_skfem, _ = smoothed(mesh, slide="straight")
    assert np.array_equal(np.asarray(slid.points)[:, :2], of_skfem.mesh.p.T)
    if trismooth.build_info()["files"]:
        of_file = trismooth.read(path)
        with pytest.warns(trismooth.MeshWarning, match="named boundaries on sides of triangles"):
            report = of_file.smooth().report
        assert np.array_equal(of_file.points[:, :2], expected)
        assert [array["name"] for array in report["input"]["region_arrays"]] == ["skfem:s:low"]
        of_file = trismooth.read(path)
        with pytest.warns(trismooth.MeshWarning):
            of_file.smooth(slide="straight")
        assert np.array_equal(of_file.points[:, :2], of_skfem.mesh.p.T)
