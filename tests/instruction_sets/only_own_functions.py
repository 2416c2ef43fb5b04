"""only_own_functions.py NM OBJECT...: what is compiled for AVX2 as a whole defines no function of others.

The linker keeps one of two functions of the same name: a processor without AVX2 might get that one. Ends with 77 where
no object is compiled in that way.
"""

import subprocess
import sys

SKIPPED = 77
OWN = ("_avx2<", ", 32>(")

nm, *objects = sys.argv[1:]
functions = []
for path in objects:
    if "_avx2.cpp" in path:
        listed = subprocess.run([nm, "-C", "--defined-only", path], capture_output=True, text=True, check=True)
        symbols = [line.split(maxsplit=2)[1:] for line in listed.stdout.splitlines()]
        functions += [name for kind, name in symbols if kind in "TtWwVv"]
if not functions:
    print("skipped: nothing is compiled for AVX2 as a whole")
    sys.exit(SKIPPED)
others = [name for name in functions if not any(own in name for own in OWN)]
if others:
    sys.exit(f"{len(others)} functions of others are compiled for AVX2, the first: {others[0]}")
