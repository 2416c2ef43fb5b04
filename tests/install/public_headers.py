# SPDX-License-Identifier: BSD-3-Clause
"""public_headers.py DOCUMENT INCLUDE COMPONENTS COMPILER [FLAG...]: the headers installed below INCLUDE are those that
the document lists for the components (separated by commas), no more and no less; each of them is compiled alone, with
nothing but that folder to find headers of trismooth in; and trismooth/trismooth.h includes every one of them."""

import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys
import tempfile

document, include, components, compiler, *flags = sys.argv[1:]
include = pathlib.Path(include)
command = [compiler, "-std=c++20", "-Wall", "-Wextra", "-Werror", *flags, f"-I{include}", "-x", "c++"]

everything = "trismooth/trismooth.h"
listed = set()
component = None
for line in pathlib.Path(document).read_text(encoding="utf-8").splitlines():
    if heading := re.match(r"## (\w+)", line):
        component = heading[1]
    elif component in components.split(","):
        listed.update(re.findall(r"^\| `(trismooth/[\w/]+\.h)`", line))
installed = {str(path.relative_to(include)) for path in include.rglob("*") if path.is_file()}
assert len(listed) > 20, listed
wrong = [f"installed, but not in {document}: {header}" for header in sorted(installed - listed)]
wrong += [f"in {document}, but not installed: {header}" for header in sorted(listed - installed)]


def first_include(header):
    found = re.search(r'^#include [<"](.*)[>"]', (include / header).read_text(encoding="utf-8"), re.MULTILINE)
    return found and found[1]


def compiled_alone(header):
    run = subprocess.run([*command, "-fsyntax-only", "-MMD", "-MF", dependencies if header == everything else os.devnull, "-"],
                         input=f'#include "{header}"\n', capture_output=True, text=True, check=False)
    return "" if run.returncode == 0 else f"{header} cannot be compiled alone:\n{run.stderr}"


# What another header includes before anything else is compiled alone there.
proven_elsewhere = {first_include(header) for header in installed}
with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
    dependencies = str(pathlib.Path(folder) / "dependencies")
    wrong += filter(None, pool.map(compiled_alone, sorted(installed - proven_elsewhere, reverse=True)))
    words = pathlib.Path(dependencies).read_text(encoding="utf-8").split()
included = {str(pathlib.Path(word).relative_to(include)) for word in words if word.startswith(str(include))}
wrong += [f"not included by {everything}: {header}" for header in sorted(installed - included)]
if wrong:
    sys.exit("\n".join(wrong))
