# SPDX-License-Identifier: BSD-3-Clause
"""A wheel that was installed brings what it needs. Run by scripts/wheels.sh --check; skipped for other installations."""

from __future__ import annotations

import pathlib
import shutil
import subprocess
import sys
from importlib import metadata

import numpy as np
import pytest

import trismooth
from conftest import grid


def distribution():
    for name in ("trismooth", "trismooth-cuda13"):
        try:
            return metadata.distribution(name)
        except metadata.PackageNotFoundError:
            continue
    return None


IS_MANYLINUX = distribution() is not None and "manylinux" in (distribution().read_text("WHEEL") or "")
pytestmark = pytest.mark.skipif(not IS_MANYLINUX, reason="this is no installed wheel")


def test_there_is_no_compiler_to_help_it():
    for tool in ("c++", "g++", "clang++", "cc", "gcc", "cmake", "ninja", "nvcc"):
        assert shutil.which(tool) is None, tool


def test_it_smooths():
    points, triangles = grid(30, 20)
    result = trismooth.smooth(points, triangles)
    assert result.after["shape"].min > result.before["shape"].min and result.moved > 0
    assert np.isfinite(trismooth.quality(points, triangles).shape).all()


def test_the_libraries_it_uses_are_its_own_or_of_the_c_library():
    trismooth.smooth(*grid(30, 20), threads=2)
    maps = pathlib.Path("/proc/self/maps").read_text(encoding="utf-8").splitlines()
    files = {pathlib.Path(line.split(maxsplit=5)[5]) for line in maps if ".so" in line}
    own = pathlib.Path(trismooth.__file__).parent.parent
    assert any(file.name.startswith("libtbb") and own in file.parents for file in files)
    for file in files:
        if file.name.startswith(("libtbb", "libvtk", "libOpenMesh", "libfmt", "libxxhash", "libpng", "libexpat", "libCLI")):
            assert own in file.parents, f"{file} is not of the wheel"


def test_the_version_is_that_of_the_distribution():
    assert trismooth.__version__ == distribution().version == trismooth.build_info()["version"]


def test_types_and_licence_come_along():
    names = {str(file) for file in distribution().files}
    assert {"trismooth/py.typed", "trismooth/_core.pyi"} <= names
    assert any(name.endswith("licenses/LICENSE") for name in names)
    assert any(name.endswith("third-party/nanobind.txt") for name in names)
    assert any("third-party/libtbb" in name for name in names)


def test_the_command_is_installed():
    command = pathlib.Path(sys.executable).with_name("trismooth")
    run = subprocess.run([command, "--version"], capture_output=True, text=True, timeout=60)
    if trismooth.build_info()["files"]:
        assert run.returncode == 0 and trismooth.__version__ in run.stdout
    else:
        assert run.returncode == 2 and "no files" in run.stderr
