# SPDX-License-Identifier: BSD-3-Clause
"""What this build has."""

from __future__ import annotations

from typing import Any, Dict

from . import _core

#: What to do about a build without files.
NO_FILES = (
    "this build of trismooth has arrays alone and no files: build it with them, "
    "pip install . -C cmake.define.TRISMOOTH_PYTHON_FILES=ON (docs/python.md)"
)


def build_info() -> Dict[str, Any]:
    """What this build has: ``version``, ``files`` and ``cuda`` (bools), and ``devices``, what CUDA finds, as text."""
    return {
        "version": _core.__version__,
        "files": _core.has_files,
        "cuda": _core.has_cuda,
        "devices": _core.cuda_text(),
    }
