# SPDX-License-Identifier: BSD-3-Clause
"""Triangles, and quadrilaterals, that are listed again, as programs do for every group that has them."""

from __future__ import annotations

from typing import Dict, FrozenSet, List, Optional, Tuple

import numpy as np

from . import _arrays, _core
from ._constraints import Constraints


class Repeats:
    """Those of one list of triangles. Each triangle counts and is smoothed once, as it is listed first.

    Attributes
    ----------
    kept : ndarray of int, shape (K,)
        The numbers of the triangles that are listed for the first time.
    place : ndarray of int, shape (M,)
        Of each triangle: where in ``kept`` it is, or that of which it is a copy.
    notes : list of str
        What the user should know, one sentence each.
    """

    def __init__(self, triangles: np.ndarray, pairs: np.ndarray) -> None:
        self._triangles = triangles
        self._copies, self._firsts = pairs[:, 0], pairs[:, 1]
        is_kept = np.ones(len(triangles), dtype=bool)
        is_kept[self._copies] = False
        self.kept = np.flatnonzero(is_kept)
        self.place = np.cumsum(is_kept) - 1
        self.place[self._copies] = self.place[self._firsts]
        count = len(pairs)
        self._kind = name = "triangle" if triangles.shape[1] in (3, 6) else "element"
        self.notes = [
            f"{count} {name}{' is' if count == 1 else 's are'} listed again (the first is {self._copies[0]}, which has "
            f"the corners of {self._firsts[0]}): {'it is' if count == 1 else 'each is'} counted and smoothed once, as it "
            "is listed first"
        ]

    def triangles(self) -> np.ndarray:
        """The triangles, each once."""
        return self._triangles[self.kept]

    def labels(self, labels: np.ndarray) -> Tuple[np.ndarray, int]:
        """Labels of the triangles that are kept, and how many of these are listed with several.

        Such a triangle has a label of its own, the same for all with the same labels: where groups overlap, what is in
        both has a border with what is in one.
        """
        once = np.unique(labels[self.kept], return_inverse=True)[1].reshape(-1)
        several = np.unique(self._firsts[labels[self._firsts] != labels[self._copies]])
        if len(several) == 0:
            return labels[self.kept], 0
        of_several = np.isin(self._firsts, several)
        owners = np.concatenate([several, self._firsts[of_several]])
        numbers = np.unique(np.concatenate([labels[several], labels[self._copies[of_several]]]), return_inverse=True)[1]
        pairs = np.unique(np.stack([owners, numbers.reshape(-1)], axis=1), axis=0)
        bounds = np.flatnonzero(np.diff(pairs[:, 0])) + 1
        sets: dict[bytes, int] = {}
        found = [sets.setdefault(part.tobytes(), len(sets)) for part in np.split(pairs[:, 1], bounds)]
        once[self.place[several]] = once.max() + 1 + np.array(found)
        return once, len(several)

    def leave_out(self, constraints: Constraints, n_points: int) -> Constraints:
        """What the constraints are for the triangles that are kept."""
        others = self._nodes_of_others()
        if len(others) > 0:
            mask = np.zeros(n_points, dtype=bool)
            if constraints.other_cells is not None:
                given = _arrays.on_host(constraints.other_cells, "other_cells")
                mask |= _core.vertex_mask(given, "other_cells", n_points)
            mask[np.concatenate(others)] = True
            constraints = constraints._replace(other_cells=mask)
            self.notes.append(
                f"{len(others)} of the {self._kind}s that are listed again {'has' if len(others) == 1 else 'have'} other "
                "middles of sides: their vertices are held"
            )
        if constraints.regions is None:
            return constraints
        regions = _arrays.labels(constraints.regions, "regions", "triangle")
        if regions.shape != (len(self._triangles),):
            return constraints  # It is refused later.
        once, several = self.labels(regions)
        if several > 0:
            self.notes.append(
                f"{several} triangle{' is' if several == 1 else 's are'} listed in several regions: what these share is a "
                "region of its own, whose border is held; list each triangle once where that is not meant"
            )
        return constraints._replace(regions=once)

    def renumbered(self, outcome: _core.Outcome) -> _core.Outcome:
        """What was made of the triangles that are kept, with their numbers in the whole list."""
        if outcome.following is not None:
            outcome = outcome.with_invalid(self.kept[outcome.following["invalid"]].tolist())
        if outcome.before is None or outcome.after is None:
            return outcome
        return outcome.with_quality(
            _core.renumbered(outcome.before, self.kept), _core.renumbered(outcome.after, self.kept)
        )

    def _nodes_of_others(self) -> List[np.ndarray]:
        """The nodes of those copies that have others in the middle of their sides, or in the centre."""
        if self._triangles.shape[1] < 6:
            return []
        nodes = _arrays.element_nodes(self._triangles)
        return [
            nodes[copy][nodes[copy] >= 0]
            for copy, first in zip(self._copies, self._firsts)
            if not _middles(nodes[copy]).items() <= _middles(nodes[first]).items()
        ]


def _middles(nodes: np.ndarray) -> Dict[FrozenSet[int], int]:
    """The node in the middle of each side, by the side's ends, and that in the centre, by all corners."""
    numbers = [int(number) for number in nodes if number >= 0]
    n_corners = int(_arrays.corner_counts(nodes))
    corners, others = numbers[:n_corners], numbers[n_corners:]
    middles = {frozenset((corners[i], corners[(i + 1) % n_corners])): middle for i, middle in enumerate(others[:n_corners])}
    middles.update({frozenset(corners): centre for centre in others[n_corners:]})
    return middles


def find_repeats(triangles: np.ndarray, n_points: int) -> Optional[Repeats]:
    """The elements that are one before them, from whichever corner and in either direction; None where there are none, or no
    valid elements."""
    pairs = _core.repeated_triangles(triangles, n_points)
    return Repeats(triangles, pairs) if len(pairs) > 0 else None
