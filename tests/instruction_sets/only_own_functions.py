# SPDX-License-Identifier: BSD-3-Clause
"""only_own_functions.py NM CMAKE GENERATOR COMPILER SOURCE FOLDER OBJECT...: nothing shares a function for AVX2.

The linker keeps one of the weak functions of a name: a processor without AVX2 might get that one. So what is compiled
for AVX2 as a whole has none, neither of OBJECT... nor in any kind of build of a project that has SOURCE as a part of it,
in FOLDER. Ends with 77 where nothing is compiled in that way.
"""

import json
import shlex
import subprocess
import sys
from pathlib import Path

SKIPPED = 77
KINDS = {
    "none": [],
    "debug": ["-DCMAKE_BUILD_TYPE=Debug", "-DCMAKE_CXX_FLAGS=-fno-inline"],
    "release": ["-DCMAKE_BUILD_TYPE=Release"],
}


def check_functions(compiled_object, kind):
    listed = subprocess.run([nm, "-C", "--defined-only", compiled_object], capture_output=True, text=True, check=True)
    symbols = [line.split(maxsplit=2)[1:] for line in listed.stdout.splitlines()]
    weak = [name for letter, name in symbols if letter == "W"]
    if weak:
        sys.exit(f"{kind}: {len(weak)} weak functions are compiled for AVX2, the first: {weak[0]}")
    if not any(letter == "T" for letter, _ in symbols):
        sys.exit(f"{kind}: {compiled_object} has no function")


def compile_for_avx2(source, folder, options):
    """Compiles what a build of that kind compiles for AVX2, nothing else of it; returns the objects."""
    configure = [cmake, "-S", source / "tests/install/parent", "-B", folder, "-G", generator, f"-DTRISMOOTH={source}"]
    configure += [f"-DCMAKE_CXX_COMPILER={compiler}", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON", *options]
    subprocess.run(configure, check=True, stdout=subprocess.DEVNULL)
    objects = []
    for entry in json.loads((folder / "compile_commands.json").read_text()):
        command = shlex.split(entry["command"])
        if "-mavx2" in command:
            objects.append(folder / f"avx2-{len(objects)}.o")
            command[command.index("-o") + 1] = str(objects[-1])
            subprocess.run(command, cwd=entry["directory"], check=True)
    return objects


nm, cmake, generator, compiler, source, folder, *objects = sys.argv[1:]
own = [path for path in objects if "_avx2.cpp" in path]
if not own:
    print("skipped: nothing is compiled for AVX2 as a whole")
    sys.exit(SKIPPED)
for path in own:
    check_functions(path, "this build")
for kind, options in KINDS.items():
    compiled = compile_for_avx2(Path(source), Path(folder) / kind, options)
    if not compiled:
        sys.exit(f"{kind}: nothing is compiled for AVX2")
    for path in compiled:
        check_functions(path, kind)
