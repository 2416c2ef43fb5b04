# SPDX-License-Identifier: BSD-3-Clause
"""rooms.py SOURCE: the modules, and the rooms of smoothing/ and cuda/, include each other in one direction only.

Data flows one way: from the caller's coordinates down to the formulas and back. A room may include itself and what its
line below names, and no header includes itself through others.
"""

import collections
import pathlib
import re
import sys

FACES = {**{f"smoothing/{name}.h": "smoothing faces" for name in ("constraints", "errors", "follow_result", "method", "options", "proposal",
                                                                 "result", "sliding")},
         "cuda/device_constraints.h": "cuda faces",
         # What runs the program, from the shell and from Python.
         "pipeline/cli/main.h": "pipeline programs", "python/src/files.h": "pipeline programs"}

SMOOTHING = ["base", "quality", "smoothing faces", "smoothing/parts", "smoothing/layers", "smoothing/rings",
             "smoothing/methods", "smoothing/halo", "smoothing/sweeps", "smoothing/guard", "smoothing/slide", "smoothing/systems",
             "smoothing/untangle", "smoothing/moving", "smoothing"]
MAY_USE = {
    "base": [],
    "quality": ["base"],
    "smoothing faces": ["base", "smoothing faces"],
    "smoothing/methods": ["base", "quality", "smoothing faces", "smoothing/rings"],
    "smoothing/parts": [],
    "smoothing/layers": ["base", "quality", "smoothing faces"],
    "smoothing/rings": ["base", "quality", "smoothing faces", "smoothing/parts", "smoothing/layers"],
    "smoothing/halo": ["base", "smoothing/parts", "smoothing/rings"],
    "smoothing/guard": ["base", "quality", "smoothing faces", "smoothing/rings", "smoothing/halo"],
    "smoothing/slide": ["base", "quality", "smoothing faces", "smoothing/methods", "smoothing/rings", "smoothing/guard"],
    "smoothing/sweeps": ["base", "quality", "smoothing faces", "smoothing/methods", "smoothing/parts", "smoothing/rings",
                         "smoothing/halo", "smoothing/slide"],
    "smoothing/systems": ["base"],
    "smoothing/untangle": ["base", "quality", "smoothing faces", "smoothing/methods", "smoothing/rings", "smoothing/guard",
                           "smoothing/systems"],
    "smoothing/moving": ["base", "quality", "smoothing faces", "smoothing/rings", "smoothing/systems"],
    "smoothing": SMOOTHING,
    "smoothing/in_parts": SMOOTHING,
    "space": list(SMOOTHING),
    "mesh_io": ["base"],
    "mesh_io/halfedge": [*SMOOTHING, "space"],
    "cuda faces": ["base", "smoothing faces"],
}
# From the lowest to the highest: each may use those before it.
below = [*SMOOTHING, "smoothing/in_parts", "cuda faces"]
for own in ("runtime", "primitives", "topology", "packing", "update", "sweeps", "sweeps/grid", "sweeps/patches", "paper",
            "guard", "slide", "moving", "parts"):
    MAY_USE[f"cuda/{own}"] = list(below)
    below.append(f"cuda/{own}")
MAY_USE["cuda"] = below
MAY_USE["mpi"] = list(SMOOTHING)
# The ranks of an MPI job are the pipeline's business in one room alone, which uses what the others have.
MAY_USE["pipeline/ranks"] = [*MAY_USE, "pipeline"]
MAY_USE["pipeline"] = [room for room in MAY_USE if room != "mpi"]
MAY_USE["python"] = list(MAY_USE)
# The paper's experiments: nothing uses them but the programs.
MAY_USE["paper"] = [room for room in MAY_USE["pipeline"] if not room.startswith("cuda")] + ["pipeline"]
MAY_USE["pipeline programs"] = list(MAY_USE)

INCLUDE = re.compile(r'^#include "trismooth/([^"]+)"', re.MULTILINE)


def room_of(path):
    """The room of a file, named from the root; the sources of a face are with it."""
    face = path.removesuffix(".cpp").removesuffix(".h") + ".h"
    if face in FACES:
        return FACES[face]
    folder = path.rsplit("/", 1)[0]
    if folder.startswith("pipeline/ranks/"):
        return "pipeline/ranks"
    module = folder.split("/")[0]
    return folder if module in ("smoothing", "cuda") or folder in ("mesh_io/halfedge", "pipeline/ranks") else module


def includes_of(source):
    """File -> files of the project that it includes."""
    found = {}
    for folder in sorted({room.split("/")[0].split(" ")[0] for room in MAY_USE}):
        for file in sorted((source / folder).rglob("*")):
            if file.suffix in {".h", ".cuh", ".cpp", ".cu"}:
                found[file.relative_to(source).as_posix()] = INCLUDE.findall(file.read_text(encoding="utf-8"))
    return found


def against_the_rule(includes):
    """Includes that climb, or leave a room by another way than its line says."""
    wrong = []
    for file, used in includes.items():
        room = room_of(file)
        if room not in MAY_USE:
            wrong.append(f"{file} is in a room that this check does not know")
            continue
        for other in used:
            # version.h and the like stand above all folders, and use none.
            if "/" in other and room_of(other) not in [room, *MAY_USE[room]]:
                wrong.append(f"{file} includes {other}: {room} may not use {room_of(other)}")
    return wrong


def circles(includes):
    """Headers that reach themselves."""
    state = collections.defaultdict(int)  # 0: not seen, 1: being looked at, 2: done
    found = []

    def visit(file, trail):
        state[file] = 1
        for other in includes.get(file, []):
            if state[other] == 1:
                found.append(" -> ".join([*trail[trail.index(other):], other]))
            elif state[other] == 0:
                visit(other, [*trail, other])
        state[file] = 2

    for file in includes:
        if state[file] == 0:
            visit(file, [file])
    return found


def main():
    includes = includes_of(pathlib.Path(sys.argv[1]))
    if len(includes) < 200:
        sys.exit(f"only {len(includes)} sources found below {sys.argv[1]}")
    # The check itself: what must be found is.
    planted = {"base/a.h": ["quality/b.h"], "smoothing/rings/c.h": ["smoothing/sweeps/d.h"], "base/e.h": ["base/f.h"],
               "base/f.h": ["base/e.h"], "smoothing/options.h": ["smoothing/backend.h"],
               "cuda/runtime/g.h": ["cuda/guard/h.h"], "cuda/attic/i.h": [], "mesh_io/off/j.h": ["quality/b.h"],
               "pipeline/cli/main.cpp": ["paper/k.h"], "pipeline/cli/l.cpp": ["paper/k.h"], "python/src/m.cpp": ["paper/k.h"]}
    assert len(against_the_rule(planted)) == 8 and len(circles(planted)) == 1
    wrong = against_the_rule(includes) + circles(includes)
    sys.exit("\n".join(wrong) or 0)


if __name__ == "__main__":
    main()
