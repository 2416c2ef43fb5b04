# SPDX-License-Identifier: BSD-3-Clause
"""What the caller should know of a result: sentences, which are warnings too."""

from __future__ import annotations

import re
import shlex
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
    """What to say of options that the method, or the sliding, takes no notice of, one sentence each."""
    usual = {"target": "uniform", "size_weight": 1, "power": None}
    names = [] if size is None else ["size"]
    names += _unusual(options, usual)
    notes = []
    if options["method"] != "mean-ratio" and names:
        notes.append(f"the method '{options['method']}' takes no notice of {', '.join(names)}; method='mean-ratio' does")
    of_curves = _unusual(options, {"deviation": None, "curve": "polyline"})
    if options["slide"] == "straight" and of_curves:
        notes.append(f"slide='straight' takes no notice of {', '.join(of_curves)}; slide='curves' does")
    return notes


def _unusual(options: Dict[str, Any], usual: Dict[str, Any]) -> List[str]:
    return [name for name, value in usual.items() if name in options and options[name] != value]


# Options of the program, with the value that stands behind them in its sentences, if any.
_OPTION = re.compile(
    r"(?:a file of )?--(?:"
    r"(?P<array>region-array|fixed-set|fixed-array|size-array) (?P<word>(?:'[^']*'|\\'|[^\s'\\,;])+)"
    r"|(?P<switch>guard|untangle) (?P<state>on|off)"
    r"|(?P<number>merge) (?P<amount>DISTANCE|[0-9](?:[0-9.e+-]*[0-9])?)"
    r"|(?P<choice>method|target|precision|layers|fields|project|quads|slide) "
    r"(?P<chosen>mean-ratio|smart|laplacian|hold|input-shape|double|keep|interpolate|smooth|xy|straight|curves)\b"
    r"|(?P<flag>geographic|slide-coincident)"
    r"|(?P<other>[a-z]+(?:-[a-z]+)*)"
    r")"
)
_NAMES = {"region-array": "regions", "fixed-set": "fixed_sets", "fixed-ids": "fixed", "size-array": "size",
          "field-array": "field_arrays"}  # fmt: skip
_OF_PROGRAM_ALONE = ("annotate", "format", "report", "require", "verbose", "devices")


def in_python(sentence: str) -> str:
    """A sentence of the program, with arguments of Python in place of the command line's options."""
    return _OPTION.sub(_argument, sentence)


# Arguments of a Mesh of a file, and what a mesh of another package has in their place.
_OF_MESH = {"regions='none'": "regions=False", "fixed_sets='none'": "fixed=False", "fixed_sets=": "fixed="}


def of_mesh(sentence: str) -> str:
    """A sentence of the program, with arguments of smooth() for meshes of other packages."""
    said = in_python(sentence)
    for of_file, argument in _OF_MESH.items():
        said = said.replace(of_file, argument)
    return said


def _argument(found: re.Match[str]) -> str:
    parts = found.groupdict()
    if parts["array"]:
        (word,) = shlex.split(parts["word"]) or [""]
        return f"{_keyword(parts['array'])}={word!r}"
    if parts["switch"]:
        return f"{parts['switch']}={parts['state'] == 'on'}"
    if parts["number"]:
        return f"{parts['number']}={parts['amount']}"
    if parts["choice"]:
        return f"{parts['choice']}={parts['chosen']!r}"
    if parts["flag"]:
        return f"{_keyword(parts['flag'])}=True"
    if parts["other"] in _OF_PROGRAM_ALONE:
        return f"the program's --{parts['other']}"
    return _keyword(parts["other"])


def _keyword(option: str) -> str:
    return _NAMES.get(option, option.replace("-", "_"))


def _is_of_package(level: int) -> bool:
    """Whether the frame of that stacklevel, as warn_of() counts it, is of this package."""
    try:
        name = str(sys._getframe(level).f_globals.get("__name__", ""))
    except ValueError:  # there is none
        return False
    return name.partition(".")[0] == _PACKAGE
