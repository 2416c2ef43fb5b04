# SPDX-License-Identifier: BSD-3-Clause
"""What README.md, docs/python.md and docs/sliding.md show in Python runs, and the docstrings' examples are true."""

from __future__ import annotations

import doctest
import pathlib
import re
import subprocess
import sys

import numpy as np
import pytest

import trismooth

ROOT = pathlib.Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"^```python([^\n]*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def blocks():
    """Each block of Python of the pages, but for those that say why not: (place, code)."""
    for page in (ROOT / "README.md", ROOT / "docs" / "python.md", ROOT / "docs" / "sliding.md"):
        text = page.read_text(encoding="utf-8")
        for match in BLOCK.finditer(text):
            if "no-run: " not in match[1]:
                line = text.count("\n", 0, match.start()) + 1
                yield pytest.param(match[2], id=f"{page.name}:{line}")


@pytest.mark.parametrize("code", list(blocks()))
def test_the_code_of_the_pages_runs(code, tmp_path):
    for package in ("pyvista", "gmsh"):
        if f"import {package}" in code:
            pytest.importorskip(package)
    if "trismooth.read(" in code and not trismooth.build_info()["files"]:
        pytest.skip("this build has no files")
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    run = subprocess.run(
        [sys.executable, "-c", "import matplotlib; matplotlib.use('Agg')\n" + code], cwd=tmp_path, capture_output=True, text=True, timeout=120
    )
    assert run.returncode == 0, run.stderr


def test_the_pages_have_such_code():
    assert len(list(blocks())) >= 7


def test_the_examples_of_docstrings_are_true():
    globals_ = {"np": np, "trismooth": trismooth}
    tests = doctest.DocTestFinder().find(trismooth.smooth, "smooth", globs=globals_)
    runner = doctest.DocTestRunner()
    for test in tests:
        runner.run(test)
    assert runner.tries >= 4 and runner.failures == 0


def test_everything_public_is_documented():
    for name in trismooth.__all__:
        thing = getattr(trismooth, name)
        assert name in ("METHODS", "METRICS") or (thing.__doc__ and thing.__doc__.strip()), name
        if isinstance(thing, type) and thing.__module__.startswith("trismooth"):
            for member, value in vars(thing).items():
                if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                    assert value.__doc__, f"{name}.{member}"
