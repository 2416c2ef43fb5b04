# SPDX-License-Identifier: BSD-3-Clause
"""refuse_fast_math.py COMPILER INCLUDE HEADERS_FOLDER...: every header below the folders that computes inline refuses to
be compiled with fast-math or a part of it, and says why; without, the same headers are taken."""

import pathlib
import re
import subprocess
import sys

compiler, include, *folders = sys.argv[1:]
COMPUTES = re.compile(r"TRISMOOTH_HOST_DEVICE [^;{]*\b(?:double|T|Point2<\w+>)\b|^inline double", re.MULTILINE)
# They turn bits into numbers or compare them, and compute nothing.
EXACT = {"host_device.h"}
FLAGS = ["-ffast-math", "-Ofast", "-ffinite-math-only"]
PARTS_THAT_GCC_TELLS_OF = ["-funsafe-math-optimizations", "-freciprocal-math", "-fno-signed-zeros"]


def preprocessed(header, flag):
    command = [compiler, "-std=c++20", "-E", *flag, "-I", include, "-x", "c++", header, "-o", "/dev/null"]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def refuses(header, flag):
    run = preprocessed(header, [flag])
    return run.returncode != 0 and "fast-math" in run.stderr


headers = [
    header
    for folder in folders
    for header in sorted(pathlib.Path(folder).rglob("*.h"))
    if header.name not in EXACT and COMPUTES.search(header.read_text())
]
assert len(headers) >= 10, headers
wrong = [str(header) for header in headers if not refuses(header, FLAGS[0])]
one = next(header for header in headers if header.name == "triangle_quality.h")
version = subprocess.run([compiler, "--version"], capture_output=True, text=True, check=True).stdout
is_gcc = "Free Software Foundation" in version
wrong += [flag for flag in FLAGS[1:] + (PARTS_THAT_GCC_TELLS_OF if is_gcc else []) if not refuses(one, flag)]
if wrong:
    sys.exit(f"taken with fast-math: {wrong}")
plain = preprocessed(one, ["-O3", "-fno-math-errno", "-fno-trapping-math"])
if plain.returncode != 0:
    sys.exit(f"refused without fast-math: {plain.stderr}")
