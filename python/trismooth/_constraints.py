# SPDX-License-Identifier: BSD-3-Clause
"""The arrays that go beside points and triangles: what holds vertices, what these slide along, sizes."""

from __future__ import annotations

from typing import Any, Dict, NamedTuple

from . import _arrays


class Constraints(NamedTuple):
    """The arrays of a call as the caller gives them; None for each that is not given. See smooth()."""

    regions: Any = None
    fixed: Any = None
    other_cells: Any = None
    size: Any = None
    lines: Any = None
    line_tags: Any = None
    links: Any = None

    def on_host(self) -> Dict[str, Any]:
        """Those that are given, by name, as the compiled part takes them: arrays in memory of the host."""
        given = {name: array for name, array in self._asdict().items() if array is not None}
        return {name: _host_array(name, array) for name, array in given.items()}


def _host_array(name: str, array: Any) -> Any:
    if name == "regions":
        return _arrays.labels(array, name, "triangle")
    if name == "line_tags":
        return _arrays.labels(array, name, "line")
    return _arrays.on_host(array, name, float if name == "size" else None)


def slides(slide: Any) -> bool:
    """Whether a caller's ``slide`` has vertices slide. What is no valid value is refused later."""
    return not (isinstance(slide, str) and slide == "off")
