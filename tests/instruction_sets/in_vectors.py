# SPDX-License-Identifier: BSD-3-Clause
"""in_vectors.py OBJDUMP CONFIGURATION OBJECT...: the compiler has made vectors of the loops over lanes.

Whether it does depends on limits of its own: what is added to such a loop can undo it for all of them, and nothing but time
tells. Divisions tell as well: all are of vectors, for either set of instructions, or nearly all. Ends with 77 where CONFIGURATION is
not optimised.
"""

import re
import subprocess
import sys
from pathlib import Path

SKIPPED = 77

objdump, configuration, *objects = sys.argv[1:]
if configuration not in ("Release", "RelWithDebInfo"):
    print(f"skipped: {configuration or 'this configuration'} is not optimised")
    sys.exit(SKIPPED)
of_lanes = [path for path in objects if Path(path).name.startswith("lane_update.cpp.")]
assert len(of_lanes) == 1, objects
code = subprocess.run([objdump, "-d", "--no-show-raw-insn", *of_lanes], capture_output=True, text=True, check=True).stdout
for instructions, prefix in (("the baseline", r"\b"), ("AVX2", r"\bv")):
    for number, letter in (("double", "d"), ("float", "s")):
        count = {kind: len(re.findall(rf"{prefix}div{kind}{letter}\b", code)) for kind in "ps"}
        print(f"{instructions}, {number}: {count['p']} divisions of vectors, {count['s']} of numbers")
        if count["p"] < 20 * count["s"] or count["p"] < 100:
            sys.exit("that is too few of vectors: loops over lanes go number by number")
