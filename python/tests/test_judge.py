# SPDX-License-Identifier: BSD-3-Clause
"""Which vertices are held and what is said of it: the same for the program, alone and over ranks, for the library's files,
for the meshes of PyVista and meshio, and for the arrays that these are taken for."""

from __future__ import annotations

import json
import os
import shlex
import subprocess
import sys
import warnings
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import trismooth
from adapter_meshes import grid
from program import PROGRAM
from trismooth import adapters
from trismooth._notes import of_mesh

meshio = pytest.importorskip("meshio")

MACHINE = Path(__file__).parents[2] / "examples" / "data" / "machine.vtu"
#: What is said of a file alone: meshio writes types of cells as 64 bits.
OF_THE_FILE = ("the cell types are written as UInt8", "annotations of an earlier run")
LAUNCHER = shlex.split(os.environ.get("TRISMOOTH_LAUNCHER", ""))

G = grid()
COUNT = len(G.triangles)
TRIANGLES = np.arange(COUNT)
ROWS = (10 * G.points[G.triangles].mean(axis=1)[:, 1]).astype(int)
SEGMENT = (G.row == 3) & (G.column > 6) & (G.column < 10)
NONE = np.zeros(len(G.points), dtype=bool)
LINE = np.flatnonzero(G.row == 6)[2:5]
FIVE = [G.vertex(7, 6), G.vertex(8, 6), G.vertex(9, 7), G.vertex(8, 7), G.vertex(7, 7)]


@dataclass(eq=False)
class Case:
    """A mesh of the grid's triangles, the vertices inside that are held, words of what is said, one for each sentence,
    and options by the program's names."""

    name: str
    cell_data: dict[str, np.ndarray]
    held: np.ndarray
    said: list[str] = field(default_factory=list)
    point_data: dict[str, np.ndarray] = field(default_factory=dict)
    cells: list[tuple[str, Any]] = field(default_factory=list)
    regions: Any = None
    fixed: Any = None

    def mesh(self) -> Any:
        blocks = [("triangle", G.triangles), *((kind, np.array([nodes])) for kind, nodes in self.cells)]
        cell_data = {name: [values, *(values[:1] for _ in self.cells)] for name, values in self.cell_data.items()}
        return meshio.Mesh(G.points3, blocks, point_data=self.point_data, cell_data=cell_data)


OTHERS = NONE.copy()
OTHERS[[*LINE, *FIVE]] = True
ROW_LINES = np.isin(G.row, [2, 4, 6, 8])
CASES = [
    Case("a known name", {"material": G.regions}, G.is_interface),
    Case("a known name written otherwise", {"Material ID": G.regions}, G.is_interface),
    Case("numbers below 0", {"region": np.where(G.regions == 1, -7, 3)}, G.is_interface),
    Case("halves under a known name", {"region": G.regions + 0.5}, G.is_interface),
    Case("a known name with the same value everywhere", {"region": np.full(COUNT, 3)}, NONE),
    Case("a constant array hides none", {"region": np.full(COUNT, 3), "matl": G.regions}, G.is_interface, ["looks like"]),
    Case("looks like regions", {"matl": G.regions}, G.is_interface, ["looks like regions"]),
    Case("whole numbers as floats", {"matl": G.regions.astype(float)}, G.is_interface, ["looks like regions"]),
    Case("of one byte", {"matl": G.regions.astype(np.uint8)}, G.is_interface, ["looks like regions"]),
    Case("of 64 bits", {"matl": np.where(G.regions == 1, 2**53, 2**53 + 1)}, G.is_interface, ["looks like regions"]),
    Case("halves", {"matl": G.regions + 0.5}, NONE, ["does not hold whole numbers"]),
    Case("as many values as triangles", {"cell_id": TRIANGLES}, NONE),
    Case("as many under a known name", {"tag": TRIANGLES}, NONE, ["is not taken for regions"]),
    Case("another purpose", {"rank of the part": G.regions}, NONE, ["by its name it is for another purpose"]),
    Case("an annotation", {"trismooth:shape": G.regions}, NONE),
    Case("two arrays", {"region": G.regions, "zone": ROWS // 2}, G.is_interface | ROW_LINES),
    Case("a vector", {"material": np.ones((COUNT, 3))}, NONE, ["has 3 components"]),
    Case("one that is named", {"u": G.regions + 0.5, "region": ROWS // 2}, G.is_interface, regions="u"),
    Case("one that is named loosely", {"My Parts": G.regions + 0.5}, G.is_interface, regions="my_parts"),
    Case("none", {"region": G.regions}, NONE, regions=False),
    Case("other cells", {}, OTHERS, ["3 cells of other types"], cells=[("line", LINE[:2]), ("line", LINE[1:]), ("polygon", FIVE)]),
    Case("a point array", {}, SEGMENT, point_data={"fixed": SEGMENT.astype(float)}),
    Case("a point array written otherwise", {}, SEGMENT, point_data={"Fixed": SEGMENT.astype(np.int8)}),
    Case("a point array that is named", {}, SEGMENT, point_data={"wall": 2 * SEGMENT}, fixed="wall"),
    Case("a point array of an annotation", {}, NONE, point_data={"trismooth:fixed": SEGMENT.astype(int)}),
    Case("markers", {}, SEGMENT, ["3 vertices inside"], point_data={"medit:ref": 5 * SEGMENT}),
    Case("markers beside regions", {"medit:ref": G.regions}, G.is_interface | SEGMENT, ["3 vertices inside"],
         point_data={"medit:ref": np.where(SEGMENT, 5, np.where(G.column < 5, 11, 12))}),
    Case("markers that are numbers", {}, NONE, ["no marks"], point_data={"medit:ref": np.arange(len(G.points))}),
]  # fmt: skip


@dataclass
class Told:
    points: np.ndarray
    notes: list[str]


def by_program(path: Path, case: Case, *launcher: str) -> Told:
    program = [PROGRAM] if PROGRAM else [sys.executable, "-m", "trismooth"]
    options = ["--method", "mean-ratio", "--report", str(path.with_name("report.json"))]
    options += [] if case.regions is None else ["--region-array", case.regions or "none"]
    options += [] if case.fixed is None else ["--fixed-array", case.fixed]
    done = subprocess.run(
        [*launcher, *program, "smooth", str(path), str(path.with_name("out.vtu")), *options],
        check=True, capture_output=True, text=True,
    )  # fmt: skip
    report = json.loads(path.with_name("report.json").read_text())
    notes = [line.partition("note: ")[2] for line in done.stderr.splitlines() if "note: " in line]
    assert report["input"]["held"]["interface"] >= 0
    return Told(np.asarray(meshio.read(path.with_name("out.vtu")).points), notes)


def by_python(smooth: Callable[[], Any], points: Callable[[Any], Any]) -> Told:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        result = smooth()
    assert [str(warning.message) for warning in caught] == result.notes
    return Told(np.asarray(points(result)), result.notes)


def by_file(path: Path, case: Case) -> Told:
    mesh = trismooth.read(path)
    options = {} if case.regions is None else {"regions": case.regions or "none"}
    return by_python(
        lambda: mesh.smooth(method="mean-ratio", fixed_array=case.fixed, **options), lambda _: mesh.points
    )


def by_adapter(mesh: Any, case: Case) -> Told:
    options = {"regions": case.regions, "fixed": case.fixed, "method": "mean-ratio"}
    return by_python(lambda: trismooth.smooth(mesh, **options), lambda result: result.mesh.points)


def by_arrays(mesh: Any, case: Case) -> Told:
    flat = adapters.find(mesh).flatten(mesh, regions=case.regions, fixed=case.fixed)
    held = {"regions": flat.regions, "fixed": flat.fixed, "other_cells": flat.other_cells}
    told = by_python(
        lambda: trismooth.smooth(flat.points, flat.triangles, method="mean-ratio", **held), lambda result: result.points
    )
    return Told(told.points, [*flat.notes, *told.notes])


def doors(path: Path, case: Case, ranks: Iterable[int]) -> dict[str, Callable[[], Told]]:
    """All ways to smooth the file that are there, over so many ranks among them."""
    found = {"meshio": lambda: by_adapter(meshio.read(path), case), "arrays": lambda: by_arrays(meshio.read(path), case)}
    try:
        import pyvista

        found["pyvista"] = lambda: by_adapter(pyvista.read(path), case)
    except ImportError:
        pass
    if trismooth.build_info()["files"]:
        found["file"] = lambda: by_file(path, case)
    if PROGRAM or trismooth.build_info()["files"]:
        found["program"] = lambda: by_program(path, case)
    if LAUNCHER and PROGRAM:
        for number in ranks:
            found[f"{number} ranks"] = lambda number=number: by_program(path, case, *LAUNCHER, str(number))
    return found


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_all_doors_hold_the_same_and_say_the_same(case: Case, tmp_path: Path) -> None:
    case.mesh().write(tmp_path / "in.vtu")
    first: Told | None = None
    for name, door in doors(tmp_path / "in.vtu", case, [1 + CASES.index(case) % 3]).items():
        told = door()
        has_moved = (told.points != G.points3).any(axis=1)
        assert np.array_equal(has_moved, ~G.is_boundary & ~case.held), name
        notes = sorted(of_mesh(note) for note in told.notes if not note.startswith(OF_THE_FILE))
        assert len(notes) == len(case.said), (name, notes)
        assert all(any(words in note for note in notes) for words in case.said), (name, notes)
        first = first or Told(told.points, notes)
        assert np.array_equal(told.points, first.points), name
        assert notes == first.notes, name


@pytest.mark.skipif(not MACHINE.exists(), reason="the example meshes are not here")
@pytest.mark.parametrize(("name", "said"), [("region", []), ("matl", ["the 672 vertices between them are held"])])
def test_the_interfaces_of_a_machine_stay_through_all_doors(name: str, said: list[str], tmp_path: Path) -> None:
    content = MACHINE.read_bytes()
    assert content.count(b'"region"') == 1
    (tmp_path / "in.vtu").write_bytes(content.replace(b'"region"', f'"{name}"'.encode()))
    points = np.asarray(meshio.read(tmp_path / "in.vtu").points)
    found: dict[str, bytes] = {}
    for door_name, door in doors(tmp_path / "in.vtu", Case(name, {}, NONE), [1, 2, 3]).items():
        told = door()
        assert (told.points == points).all(axis=1).sum() == 804, door_name
        notes = [of_mesh(note) for note in told.notes]
        assert len(notes) == len(said) and all(words in note for words, note in zip(said, notes)), (door_name, notes)
        found[door_name] = told.points.tobytes()
    assert len(set(found.values())) == 1, list(found)
