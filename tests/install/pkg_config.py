# SPDX-License-Identifier: BSD-3-Clause
"""pkg_config.py COMPILER FLAGS PREFIX FOLDER "PACKAGE..." SOURCE [ARGUMENT...]: with what pkg-config says of the packages,
installed below PREFIX, the compiler alone makes a program of SOURCE, which runs and does its work."""

import os
import pathlib
import shlex
import subprocess
import sys

compiler, flags, prefix, folder, packages, source, *arguments = sys.argv[1:]
packages = packages.split()
found = list(pathlib.Path(prefix).rglob(f"{packages[0]}.pc"))
assert len(found) == 1, found
environment = {**os.environ, "PKG_CONFIG_PATH": str(found[0].parent), "LD_LIBRARY_PATH": str(found[0].parent.parent)}


def pkg_config(*words):
    run = subprocess.run(["pkg-config", *words, *packages], env=environment, capture_output=True, text=True, check=False)
    if run.returncode != 0:
        sys.exit(f"pkg-config {' '.join(words)}: {run.stderr}")
    return shlex.split(run.stdout)


cflags = pkg_config("--cflags")
# The formulas in the headers have the bits of those in the library.
assert "-ffp-contract=off" in cflags, cflags
assert pkg_config("--modversion") != [""]
pathlib.Path(folder).mkdir(parents=True, exist_ok=True)
program = pathlib.Path(folder) / "program"
subprocess.run([compiler, "-std=c++20", *shlex.split(flags), source, *cflags, *pkg_config("--libs"), "-o", program], check=True)
subprocess.run([program, *arguments], env=environment, check=True)
