# SPDX-License-Identifier: BSD-3-Clause
"""compare.py PROGRAM OTHER [SET]: both print the same, and many lines, OTHER by no better instructions than SET.

Ends with 77 where OTHER cannot run on this machine.
"""

import os
import subprocess
import sys

SKIPPED = 77

limit = {"TRISMOOTH_INSTRUCTION_SET": sys.argv[3]} if len(sys.argv) > 3 else {}
one, other = (
    subprocess.run([program], capture_output=True, text=True, check=False, env={**os.environ, **environment})
    for program, environment in zip(sys.argv[1:3], ({}, limit))
)
if other.returncode == SKIPPED:
    print(other.stdout, end="")
    sys.exit(SKIPPED)
for run in (one, other):
    if run.returncode != 0 or len(run.stdout.splitlines()) < 400:
        sys.exit(f"{run.args[0]} ended with {run.returncode}: {run.stderr}")
differences = [lines for lines in zip(one.stdout.splitlines(), other.stdout.splitlines()) if lines[0] != lines[1]]
if differences:
    sys.exit(f"{len(differences)} meshes differ, the first: {differences[:1]}")
