# SPDX-License-Identifier: BSD-3-Clause
"""``python -m trismooth`` is the program: see ``python -m trismooth --help``."""

from __future__ import annotations

import os
import signal
import sys
from typing import List, Optional

from . import _core
from ._support import NO_FILES


def main(arguments: Optional[List[str]] = None) -> int:
    """Runs the program with these arguments, those of the process by default. Returns its exit code."""
    if not _core.has_files:
        print(f"error: {NO_FILES}", file=sys.stderr)
        return 2
    # What Python has kept of its own output comes before the program's.
    for stream in (sys.stdout, sys.stderr):
        if stream is not None:
            stream.flush()
    if hasattr(signal, "SIGPIPE"):
        signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # Python ignores it; the program ends by it, as others do
    given = sys.argv[1:] if arguments is None else arguments
    return _core.run_program([b"trismooth", *(os.fsencode(argument) for argument in given)])


if __name__ == "__main__":
    sys.exit(main())
