# SPDX-License-Identifier: BSD-3-Clause
"""Lets a test mount file systems that nobody else sees and that are gone with it, however it ends."""

import os
import subprocess
import sys

SKIPPED = 77


def enter():
    """Starts this script again where it may mount; ends it as skipped where that cannot be."""
    if os.environ.get("TRISMOOTH_PRIVATE_MOUNTS"):
        return
    reasons = []
    for rights in (["unshare", "--mount"], ["unshare", "--user", "--map-root-user", "--mount"]):
        try:
            attempt = subprocess.run([*rights, "mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", "/tmp"],
                                     capture_output=True, text=True, check=False)
        except FileNotFoundError as error:
            reasons.append(str(error))
            continue
        if attempt.returncode == 0:
            os.environ["TRISMOOTH_PRIVATE_MOUNTS"] = "1"
            os.execvp(rights[0], [*rights, sys.executable, "-B", *sys.argv])
        reasons.append(attempt.stderr.strip())
    print(f"skipped: no file system can be mounted here: {'; '.join(reasons)}")
    sys.exit(SKIPPED)


def mount(*arguments):
    subprocess.run(["mount", *map(str, arguments)], check=True)


def unmount(folder):
    subprocess.run(["umount", "-l", str(folder)], check=True)
