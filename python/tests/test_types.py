# SPDX-License-Identifier: BSD-3-Clause
"""The annotations of the package hold, and callers get them."""

from __future__ import annotations

import ast
import os
import pathlib
import subprocess
import sys

import pytest

import trismooth

pytest.importorskip("mypy")
CALLER = """
from typing import Any, Optional

import numpy as np
import trismooth

points = np.zeros((3, 2))
result = trismooth.smooth(points, [[0, 1, 2]], max_sweeps=3)
smallest: float = result.after["shape"].min
moved: int = result.moved
reason: str = result.stop_reason
sliding: Optional[trismooth.SlidingResult] = trismooth.smooth(points, [[0, 1, 2]], slide="curves", deviation=0.01).sliding
slid: int = 0 if sliding is None else sliding.slid
plan = trismooth.Plan([[0, 1, 2]], 3, slide="straight", lines=[[0, 1]], line_tags=["a"], links=[[0, 1]])
again: trismooth.Result = plan.smooth(points)
shapes: np.ndarray[Any, Any] = trismooth.quality(points, [[0, 1, 2]]).shape
mesh: trismooth.Mesh = trismooth.read("mesh.off")
wrong: int = result.stop_reason  # expected to be refused
"""


def test_the_stub_is_true_of_the_module():
    from trismooth import _core

    tree = ast.parse((pathlib.Path(trismooth.__file__).parent / "_core.pyi").read_text(encoding="utf-8"))
    stated = {node.name: node for node in tree.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    there = {name for name in vars(_core) if not name.startswith("_") and callable(getattr(_core, name))}
    assert there <= set(stated), there - set(stated)
    optional = {"DeviceMovingMesh", "DevicePlan", "new_device_array", "FileOutcome", "FileMesh", "run_program", "format_list", "view_page"}
    assert set(stated) - there <= optional
    for name in there:
        if isinstance(stated[name], ast.ClassDef):
            members = {member.name for member in stated[name].body if isinstance(member, ast.FunctionDef)}
            real = {member for member in vars(getattr(_core, name)) if not member.startswith("_")}
            assert real == {member for member in members if not member.startswith("_")}, name


def test_the_package_and_its_callers_type_check(tmp_path):
    (tmp_path / "caller.py").write_text(CALLER)
    checked = subprocess.run(
        [sys.executable, "-m", "mypy", "--cache-dir=/dev/null", "--ignore-missing-imports", "--strict", "-p", "trismooth", "-m", "caller"],
        env={**os.environ, "MYPYPATH": str(tmp_path)}, cwd=tmp_path, capture_output=True, text=True, timeout=300,
    )  # fmt: skip
    lines = [line for line in checked.stdout.splitlines() if ": error:" in line]
    assert len(lines) == 1 and f"caller.py:{CALLER.count(chr(10))}" in lines[0], checked.stdout
