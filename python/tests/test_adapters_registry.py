# SPDX-License-Identifier: BSD-3-Clause
"""Which adapter takes what, without importing anything for it."""

from __future__ import annotations

import json
import subprocess
import sys

import numpy as np
import pytest

from trismooth import adapters
from trismooth.adapters import flat

PACKAGES = {"pyvista", "vtk", "vtkmodules", "meshio", "gmsh", "skfem", "dolfinx", "firedrake", "matplotlib"}


def imported_by(code: str) -> set[str]:
    script = f"import sys, json\n{code}\nprint(json.dumps([name.partition('.')[0] for name in sys.modules]))"
    done = subprocess.run([sys.executable, "-c", script], check=True, capture_output=True, text=True)
    return set(json.loads(done.stdout.splitlines()[-1])) & PACKAGES


def test_import_brings_no_other_package() -> None:
    assert imported_by("import trismooth, trismooth.adapters") == set()


def test_import_of_the_gmsh_module_brings_no_gmsh() -> None:
    assert imported_by("import trismooth.gmsh") == set()


def test_search_brings_no_other_package() -> None:
    assert imported_by("import trismooth.adapters as a, numpy; assert a.find(numpy.zeros(3)) is None") == set()


@pytest.mark.parametrize(
    ("module", "name", "adapter"),
    [
        ("pyvista.core.pointset", "vtkDataObject", None),
        ("vtkmodules.vtkCommonDataModel", "vtkDataObject", "pyvista"),
        ("meshio._mesh", "Mesh", "meshio"),
        ("meshio", "CellBlock", None),
        ("meshiolike", "Mesh", None),
        ("skfem.mesh.mesh", "Mesh", "skfem"),
        ("dolfinx.mesh", "Mesh", "fenicsx"),
        ("firedrake.mesh", "MeshGeometry", "firedrake"),
        ("trimesh.base", "Trimesh", None),
    ],
)
def test_names_of_class_and_module_decide(module: str, name: str, adapter: str | None) -> None:
    base = type(name, (), {"__module__": module})
    derived = type("Derived", (base,), {"__module__": "elsewhere"})
    for cls in (base, derived):
        found = adapters.find(cls())
        assert found is None if adapter is None else found.__name__ == f"trismooth.adapters.{adapter}"


@pytest.mark.parametrize("thing", [None, 3, "mesh", np.zeros((3, 2)), [1, 2], object()])
def test_no_adapter_for_other_things(thing: object) -> None:
    assert adapters.find(thing) is None


@pytest.mark.parametrize("adapter", ["pyvista", "meshio", "skfem", "fenicsx", "firedrake"])
def test_protocol(adapter: str) -> None:
    module = __import__(f"trismooth.adapters.{adapter}", fromlist=["flatten"])
    assert callable(module.flatten)
    assert callable(module.with_points)
    assert module.SUPPORTS_COPY is (adapter not in ("fenicsx", "firedrake"))


def test_labels_are_combined() -> None:
    random = np.random.default_rng(1)
    first, second = random.integers(-3, 3, 200), random.choice(["steel", "air", "Kupfer"], 200)
    third = np.array(random.choice([0.5, np.nan], 200), dtype=object)
    combined = flat.combine_labels([first, second, third])
    assert combined is not None
    keys = list(zip(first, second, map(str, third)))
    same = np.array([[a == b for b in keys] for a in keys])
    assert np.array_equal(combined[:, None] == combined[None, :], same)
    assert flat.combine_labels([]) is None


def test_labels_of_overlapping_sets() -> None:
    random = np.random.default_rng(2)
    sets = [random.choice(100, size) for size in (0, 1, 30, 60, 100, 100)]
    labels = flat.labels_of_sets(sets, 100)
    keys = [tuple(cell in members for members in sets) for cell in range(100)]
    same = np.array([[a == b for b in keys] for a in keys])
    assert np.array_equal(labels[:, None] == labels[None, :], same)


def test_vertex_masks() -> None:
    assert flat.vertex_mask([2, 0, 2], 4).tolist() == [True, False, True, False]
    assert flat.vertex_mask(np.array([False, True]), 2).tolist() == [False, True]
    assert flat.vertex_mask([], 2).tolist() == [False, False]


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [
        ([True, False], ValueError, r"shape \(2,\); expected \(4,\)"),
        ([4], ValueError, "vertex 4 is not one"),
        ([-1], ValueError, "vertex -1"),
        ([0.5], TypeError, "float64"),
        ([[0, 1]], ValueError, "dimension"),
        ([0, 1, 1, 0], TypeError, "flagged .bool. or numbered"),
        (True, ValueError, "one dimension"),
    ],
)
def test_faults_of_vertex_masks(value: object, error: type[Exception], text: str) -> None:
    with pytest.raises(error, match=f"^fixed: .*{text}"):
        flat.vertex_mask(value, 4)
