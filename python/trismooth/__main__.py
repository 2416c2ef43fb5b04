"""``python -m trismooth`` is the program: see ``python -m trismooth --help``."""

from __future__ import annotations

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
    sys.stdout.flush()
    sys.stderr.flush()
    return _core.run_program(["trismooth", *(sys.argv[1:] if arguments is None else arguments)])


if __name__ == "__main__":
    sys.exit(main())
