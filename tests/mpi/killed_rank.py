#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A rank that is killed in the middle of smoothing ends the whole job, soon, and the launcher says so.

    killed_rank.py LAUNCHER... PROGRAM
"""

import subprocess
import sys

SECONDS = 30

try:
    done = subprocess.run(sys.argv[1:], timeout=SECONDS, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          check=False)
except subprocess.TimeoutExpired:
    sys.exit(f"the job goes on {SECONDS} s after a rank was killed")
if done.returncode == 0:
    sys.exit(f"the launcher says that all went well:\n{done.stdout}")
