# SPDX-License-Identifier: BSD-3-Clause
"""debian_package.py CPACK CONFIGURATION_FILE FOLDER MESH: makes the Debian package, and looks at it as dpkg does: it depends
on packages that are needed to run the program and on no other, holds the program and its papers and nothing to develop
with, and the program runs from where it is unpacked."""

import os
import pathlib
import re
import shutil
import stat
import subprocess
import sys

cpack, configuration, folder, mesh = sys.argv[1:]
folder = pathlib.Path(folder)
# What an earlier run left must not help.
shutil.rmtree(folder, ignore_errors=True)


def output(*command):
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    if run.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}:\n{run.stdout}{run.stderr}")
    return run.stdout


if shutil.which("dpkg-shlibdeps") is None:
    print("skipped: there is no dpkg-shlibdeps, which scripts/install-deps.sh --tests installs")
    sys.exit(77)
output(cpack, "-G", "DEB", "--config", configuration, "-B", folder)
packages = list(folder.glob("*.deb"))
assert len(packages) == 1, packages
package = packages[0]


def field(name):
    return output("dpkg-deb", "--field", package, name).strip()


assert field("Package") == "trismooth"
assert package.name == f"trismooth_{field('Version')}_{field('Architecture')}.deb", package.name
assert field("Architecture") == output("dpkg", "--print-architecture").strip()
assert field("Maintainer") == "the trismooth authors"
assert len(field("Description").splitlines()[0]) < 80

depends = [re.match(r"[a-z0-9+.-]+", part.strip())[0] for part in field("Depends").split(",")]
print(f"{package.name}, {package.stat().st_size} bytes, depends on {' '.join(depends)}")
assert not [name for name in depends if name.endswith("-dev")], depends
# Every library that the program and those that come with it are linked with is one of theirs, and each of them has one.
root = folder / "root"
output("dpkg-deb", "--extract", package, root)
binaries = [root / "usr" / "bin" / "trismooth", *(root / "usr" / "lib").glob("*.so.*.*.*")]
dynamic = "".join(output("readelf", "--dynamic", binary) for binary in binaries)
needed = {name for name in re.findall(r"\(NEEDED\).*\[(.*)\]", dynamic) if not (root / "usr" / "lib" / name).exists()}
owner_of = {}
for line in output("dpkg-query", "--search", *(f"*/{library}" for library in needed)).splitlines():
    owner, path = line.split(": ")
    owner_of.setdefault(pathlib.Path(path).name, set()).update(re.findall(r"[a-z0-9+.-]+(?=:|,|$)", owner))
assert len(needed) > 3 and all(owner_of[library] & set(depends) for library in needed), (needed, owner_of, depends)
assert set(depends) <= set().union(*owner_of.values()), (owner_of, depends)
assert not re.search(r"\((RPATH|RUNPATH)\)", output("readelf", "--dynamic", binaries[0]))

files = [path for path in root.rglob("*") if not path.is_dir()]
for path in files:
    place = str(path.relative_to(root))
    assert re.match(r"usr/(bin/trismooth$|lib/libtrismooth_\w+\.so\.[\d.]+$|share/doc/trismooth/)", place), place
    assert path.stat().st_mode & (stat.S_IWGRP | stat.S_IWOTH) == 0, place
documents = root / "usr" / "share" / "doc" / "trismooth"
assert "Redistribution and use" in (documents / "copyright").read_text()
assert "libcli11-dev" in (documents / "third-party" / "NOTICE").read_text()

# As dpkg itself installs it, which knows of no other package there.
if os.geteuid() == 0:
    state = folder / "installed" / "var" / "lib" / "dpkg"
    (state / "info").mkdir(parents=True)
    (state / "status").touch()
    root = folder / "installed"
    output("dpkg", "--root", root, "--force-depends", "--log=/dev/null", "--install", package)
    assert "install ok installed" in output("dpkg-query", "--admindir", state, "--status", "trismooth")
os.environ["LD_LIBRARY_PATH"] = str(root / "usr" / "lib")
program = root / "usr" / "bin" / "trismooth"
assert output(program, "--version") == f"trismooth {field('Version')}\n"
output(program, "smooth", mesh, folder / "smooth.off", "--require", "inverted==0")
