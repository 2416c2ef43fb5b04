"""What the caller should know of a result: sentences, which are warnings too."""

from __future__ import annotations

import sys
import warnings
from typing import Any, Dict, Iterable, List

_PACKAGE = __name__.partition(".")[0]


class MeshWarning(UserWarning):
    """Something of a mesh was held, kept, left out or guessed. The sentence says what to do about it; it is among
    ``Result.notes`` as well."""

    __module__ = _PACKAGE


def warn_of(notes: Iterable[str]) -> None:
    """Warns of each sentence once, at the line outside of this package from where it was called."""
    level = 2
    while _is_of_package(level):
        level += 1
    for note in dict.fromkeys(notes):
        warnings.warn(note, MeshWarning, stacklevel=level)


def options_without_effect(options: Dict[str, Any], size: Any) -> List[str]:
    """What to say of options that the method takes no notice of: a sentence, or none."""
    usual = {"target": "uniform", "size_weight": 1, "power": None}
    names = [] if size is None else ["size"]
    names += [name for name, value in usual.items() if name in options and options[name] != value]
    if options["method"] == "mean-ratio" or not names:
        return []
    return [f"the method '{options['method']}' takes no notice of {', '.join(names)}; method='mean-ratio' does"]


def _is_of_package(level: int) -> bool:
    """Whether the frame of that stacklevel, as warn_of() counts it, is of this package."""
    try:
        name = str(sys._getframe(level).f_globals.get("__name__", ""))
    except ValueError:  # there is none
        return False
    return name.partition(".")[0] == _PACKAGE
