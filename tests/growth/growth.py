# SPDX-License-Identifier: BSD-3-Clause
"""Time follows the size of the input, whatever is in it: four times as much input takes four times the instructions,
and a little more for what is sorted. Counted by callgrind, whose counts are the same in every run.

    growth.py PROGRAM [PART-OF-A-CASE'S-NAME]
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile

FACTOR = 4  # as in growth.cpp
MOST = 1.3  # n log n grows by 1.2 beyond the factor at these sizes, n^1.5 by 2, n^2 by 4


def counts(program, only, folder):
    """{case: {"none", "small", "large": instructions}}"""
    outcome = subprocess.run(
        ["valgrind", "--tool=callgrind", "--instr-atstart=no", "--callgrind-out-file=/dev/null",
         f"--log-file={folder}/log", program, *only],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env={**os.environ, "TMPDIR": folder}, check=False)
    with open(f"{folder}/log", encoding="utf-8", errors="replace") as file:
        log = file.read()
    if outcome.returncode != 0:
        print(outcome.stdout.decode(errors="replace"), log)
        sys.exit(outcome.returncode)
    found = {}
    before = 0
    for told in log.split("instrumentation: on\n")[1:]:
        count = sum(map(int, re.findall(r"^events-\d+: (\d+)$", told, re.MULTILINE)))  # of each thread
        work = re.search(r"up to here: (\w+) (.*)$", told, re.MULTILINE)
        if work:
            found.setdefault(work[2], {})[work[1]] = count - before
        before = count
    return found


def main():
    if not shutil.which("valgrind"):
        print("skipped: valgrind is not installed (scripts/install-deps.sh --tests installs it)")
        return 77
    with tempfile.TemporaryDirectory(prefix="trismooth-growth-") as folder:
        found = counts(sys.argv[1], sys.argv[2:], folder)
    if not found:
        print("nothing was counted")
        return 1
    too_fast = 0
    for case, of in sorted(found.items()):
        if not of["none"] < of["small"] < of["large"]:
            print(f"{case}: does not grow with its input, so there is nothing to see: {of}")
            return 1
        growth = (of["large"] - of["none"]) / (of["small"] - of["none"]) / FACTOR
        too_fast += growth > MOST
        print(f"{growth:6.2f}  {of['none'] / 1e6:8.1f} M {of['small'] / 1e6:8.1f} M  {of['large'] / 1e6:8.1f} M  {case}"
              + ("   <-- grows faster than its input" if growth > MOST else ""))
    print(f"{len(found)} cases, {too_fast} of them grow by more than {MOST} times their input")
    return 1 if too_fast else 0


if __name__ == "__main__":
    sys.exit(main())
