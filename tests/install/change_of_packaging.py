# SPDX-License-Identifier: BSD-3-Clause
"""change_of_packaging.py SCRIPTS: where packages may have changed is seen: of a branch, of a working tree, without git.

Ends with 77 where there is no git.
"""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77
CMAKE = "trismooth_public_headers(\n  base\n  base/point.h)\n"

if shutil.which("git") is None:
    print("skipped: there is no git")
    sys.exit(SKIPPED)

scripts = Path(sys.argv[1])
environment = {**os.environ, "GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_NOSYSTEM": "1"}
for role in ("AUTHOR", "COMMITTER"):
    environment |= {f"GIT_{role}_NAME": "test", f"GIT_{role}_EMAIL": "test@example.org"}


def run(folder, *command, **variables):
    done = subprocess.run(
        command, cwd=folder, env={**environment, **variables}, capture_output=True, text=True, check=True
    )
    return done.stdout.strip()


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


def commit(folder, name, text, hours):
    """A commit that writes one file, so many hours after the first one."""
    write(folder / name, text)
    run(folder, "git", "add", ".")
    date = f"{1700000000 + 3600 * hours} +0000"
    run(folder, "git", "commit", "--quiet", "-m", name, GIT_AUTHOR_DATE=date, GIT_COMMITTER_DATE=date)


def change(folder):
    return run(folder, "bash", "-c", "set -euo pipefail; source scripts/common.sh; change_of_packaging")


def check(what, found, expected):
    if found != expected:
        sys.exit(f"{what}: '{found}' in place of '{expected}'")


with tempfile.TemporaryDirectory() as temporary:
    project = Path(temporary) / "project"
    write(project / "scripts/common.sh", (scripts / "common.sh").read_text())
    unknown = "git does not say what has changed"
    check("no git", change(project), unknown)
    run(project, "git", "init", "--quiet", "--initial-branch=main")
    commit(project, "base/CMakeLists.txt", CMAKE, 0)
    check("all is younger than eight hours", change(project), unknown)
    commit(project, "base/point.h", "", 1)
    commit(project, "base/point.cpp", "int point;\n", 10)
    check("an old header", change(project), "")
    commit(project, "base/CMakeLists.txt", CMAKE + "#\n", 11)
    commit(project, "base/point.cpp", "long point;\n", 18)
    check("a commit before the last one", change(project), "base/CMakeLists.txt")

    branch = Path(temporary) / "branch"
    run(temporary, "git", "clone", "--quiet", str(project), str(branch))
    run(branch, "git", "checkout", "--quiet", "-b", "work")
    commit(branch, "base/point.cpp", "float point;\n", 19)
    commit(branch, "base/private.h", "\n", 40)
    check("a source and a private header", change(branch), "")
    for name in ("base/point.h", "python/src/module.cpp", "cmake/part.cmake", "tests/CMakeLists.txt", "pyproject.toml"):
        before = (branch / name).read_text() if (branch / name).exists() else None
        write(branch / name, "// changed\n")
        check("in the working tree", change(branch), name)
        write(branch / name, before) if before is not None else (branch / name).unlink()
    check("as it was", change(branch), "")
    (branch / "base/point.h").unlink()
    check("a header that is gone", change(branch), "base/point.h")
    run(branch, "git", "checkout", "--quiet", "base/point.h")
    commit(branch, "scripts/other.sh", "", 41)
    commit(branch, "base/point.cpp", "double point;\n", 60)
    check("an earlier commit of the branch", change(branch), "scripts/other.sh")
