# SPDX-License-Identifier: BSD-3-Clause
"""The program, whose bits those of the package are compared with."""

from __future__ import annotations

import json
import os
import subprocess
import sys

import numpy as np
import pytest

PROGRAM = os.environ.get("TRISMOOTH_PROGRAM")
NOT_OF_THE_PROGRAM = ("evaluation", "record_min_shape")
FLAGS = ("slide_coincident",)  # without a value on the command line


def arguments_of(options):
    """The options on the program's command line."""
    arguments = []
    for name, value in options.items():
        if name in NOT_OF_THE_PROGRAM:
            continue
        if name in FLAGS:
            arguments += ["--" + name.replace("_", "-")] if value else []
            continue
        text = value if isinstance(value, str) else {True: "on", False: "off"}.get(value, repr(value)) if isinstance(value, bool) else repr(value)
        arguments += ["--" + name.replace("_", "-"), text]
    return arguments


def hash_of(points):
    """XXH64 of x, y, z as little-endian float64, as the program's report has it. Skips the test without xxhash."""
    xxhash = pytest.importorskip("xxhash")
    return xxhash.xxh64(np.ascontiguousarray(points, "<f8").tobytes()).hexdigest()


def off_file(path, points, triangles):
    """Writes a mesh with every bit of its coordinates."""
    lines = ["OFF", f"{len(points)} {len(triangles)} 0"]
    lines += [f"{x!r} {y!r} 0" for x, y in points.tolist()]
    lines += ["3 " + " ".join(map(str, t)) for t in triangles.tolist()]
    path.write_text("\n".join(lines) + "\n")
    return path


def program_hash(path, options, tmp_path, *more):
    """The hash of the coordinates that the program makes of a file."""
    program = [PROGRAM] if PROGRAM else [sys.executable, "-m", "trismooth"]
    report = tmp_path / "report.json"
    command = [*program, "smooth", str(path), str(tmp_path / "out.off"), *arguments_of(options), "--report", str(report), "--quiet", *more]
    subprocess.run(command, check=True, capture_output=True)
    return json.loads(report.read_text())["coordinates_hash"]
