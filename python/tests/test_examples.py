# SPDX-License-Identifier: BSD-3-Clause
"""The examples run, print an improvement and draw pictures."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).resolve().parents[2] / "examples" / "python"

image = pytest.importorskip("PIL.Image")
pytest.importorskip("matplotlib")
pytest.importorskip("scipy")
pytestmark = pytest.mark.skipif(not EXAMPLES.is_dir(), reason="the examples are not here")


def run(name, *arguments):
    """Run an example as a user does, without a screen, and return what it prints."""
    environment = {key: value for key, value in os.environ.items() if key not in ("DISPLAY", "MPLBACKEND")}
    command = [sys.executable, str(EXAMPLES / name), *map(str, arguments)]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    return done.stdout


def numbers(line):
    return [float(number) for number in re.findall(r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?", line)]


def row(output, name):
    """The numbers of the line that begins with the name."""
    return numbers(next(line for line in output.splitlines() if line.startswith(name))[len(name) :])


def check_picture(path):
    with image.open(path) as picture:
        picture.load()
        assert picture.width > 300 and picture.height > 200
        assert len(picture.convert("RGB").getcolors(1 << 24)) > 50


def test_gmsh_model(tmp_path):
    pytest.importorskip("gmsh")
    picture = tmp_path / "model.png"
    output = run("gmsh_model.py", "--output", picture)
    for name in ("smallest shape", "mean shape", "smallest angle"):
        before, after = row(output, name)
        assert after > before
    before, after = row(output, "largest angle")
    assert after < before
    check_picture(picture)


def test_poisson(tmp_path):
    pytest.importorskip("skfem")
    picture = tmp_path / "poisson.png"
    output = run("poisson.py", "--output", picture, "--parts", 30)
    smallest, mean, error, error_of_gradient, plain, jacobi = zip(row(output, "before"), row(output, "after"))
    for better_is_larger in (smallest, mean):
        assert better_is_larger[1] > better_is_larger[0]
    for better_is_smaller in (error, error_of_gradient, plain, jacobi):
        assert better_is_smaller[1] < better_is_smaller[0]
    check_picture(picture)


@pytest.mark.parametrize("motion", ["rotor", "foil", "piston", "sloshing"])
def test_moving_meshes(tmp_path, motion):
    pytest.importorskip("skfem")
    animation = tmp_path / "moving.gif"
    size = 0.5 if motion in ("rotor", "foil") else 0.7
    output = run("moving_meshes.py", "--motion", motion, "--output", animation, "--steps", 4, "--size", size)
    smallest, inverted, drift = row(output, "MovingMesh ")[:3]
    assert smallest > 0 and inverted == 0 and drift == 0
    assert row(output, "plan, mean-ratio")[2] > 0
    if motion == "rotor":
        assert row(output, "Laplace")[1] > 0
    if motion == "foil":
        assert row(output, "MovingMesh ")[-1] < 5  # % that the first row of the layer changes by
    check_picture(animation)
    with image.open(animation) as picture:
        assert picture.n_frames == 4
    assert animation.stat().st_size < 3_000_000
