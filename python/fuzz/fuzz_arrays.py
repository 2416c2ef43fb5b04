# SPDX-License-Identifier: BSD-3-Clause
"""Calls the package with arrays and options made at random, right and wrong, and checks what it promises.

    python python/fuzz/fuzz_arrays.py --seconds 600 [--seed N]

Made for a module that was built with the address sanitizer (scripts/sanitize.sh asan runs it for a moment). Each call must
end with a result that keeps the promises, or with one of the documented exceptions, whose message begins with the name of
an argument; the caller's arrays are as they were either way. What breaks that is printed with the seed that repeats it.
"""

from __future__ import annotations

import argparse
import random
import re
import sys
import time

import numpy as np

import trismooth

ARGUMENTS = (
    "points|triangles|regions|fixed|other_cells|size|out|method|form|backend|layout|execution|order|topology|precision|"
    "evaluation|guard|untangle|layers|max_sweeps|tolerance|time_limit|target_quality|threads|size_weight|power|target|"
    "record_min_shape|progress|stream|inplace|n_points|quality|slide|corner_angle|deviation|curve|slide_coincident|"
    "lines|line_tags|links"
)
NAMES_AN_ARGUMENT = re.compile(rf"({ARGUMENTS})\b|'[^']*' is no option|options?: ")
FLOATS = ["f8", "f4", ">f8", "f2", "g", "c16", "i4", "O", "U4"]
INTEGERS = ["i4", "i8", "i2", "i1", "u1", "u4", "u8", ">i4", "f8", "?", "O"]
STRANGE = [None, 0, -1, 1.5, "x", b"x", (), [], {}, object(), True, float("nan"), 10**30, "a" * 1000, np.float32(2), [[1]]]


class Maker:
    """Makes the arguments of one call from a seed."""

    def __init__(self, seed: int) -> None:
        self.random = random.Random(seed)
        self.numbers = np.random.default_rng(seed)

    def one_in(self, count: int) -> bool:
        return self.random.randrange(count) == 0

    def points(self, columns: int, rows: int) -> np.ndarray:
        x, y = np.meshgrid(np.arange(columns + 1.0), np.arange(rows + 1.0))
        points = np.column_stack([x.ravel(), y.ravel()])
        points += self.numbers.normal(0, self.random.choice([0, 0.1, 0.3, 1]), points.shape)
        points *= self.random.choice([1, 1e-300, 1e300, 1e-20, 1e20, 3])
        if self.one_in(6):
            points = np.column_stack([points, np.full(len(points), self.random.choice([0, 2.5]))])
        return points

    def triangles(self, columns: int, rows: int) -> np.ndarray:
        first = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
        across = columns + 1
        all_of_them = np.concatenate(
            [
                np.column_stack([first, first + 1, first + across + 1]),
                np.column_stack([first, first + across + 1, first + across]),
            ]
        )
        if self.one_in(4):
            all_of_them = self.numbers.permutation(all_of_them)[: self.random.randrange(len(all_of_them) + 1)]
        if self.one_in(8) and len(all_of_them):
            place = (self.random.randrange(len(all_of_them)), self.random.randrange(3))
            all_of_them[place] = self.random.choice([-1, len(first) * 3, 2**31 - 1, -(2**31), 2**40, 0])
        if self.one_in(20):
            all_of_them = np.hstack([all_of_them, all_of_them[:, ::-1]])
        return all_of_them

    def quadrilaterals(self, columns: int, rows: int) -> np.ndarray:
        """Four corners each, the last of some -1, which makes triangles of them."""
        first = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
        elements = np.column_stack([first, first + 1, first + columns + 2, first + columns + 1])
        elements[self.numbers.random(len(elements)) < self.random.choice([0, 0.3, 1]), 3] = -1
        if self.one_in(8):
            elements.flat[self.random.randrange(elements.size)] = self.random.choice([-1, -2, elements.max() + 1, 2**31, 0])
        return elements

    def spoiled(self, array: np.ndarray, types: list) -> object:
        """The array in another type, layout, shape, or with a strange number; mostly as it is."""
        if self.one_in(5):
            with np.errstate(all="ignore"):
                array = array.astype(self.random.choice(types))
        if self.one_in(12) and array.size and array.dtype.kind == "f":
            array = array.copy()
            array.flat[self.random.randrange(array.size)] = self.random.choice([np.nan, np.inf, -np.inf, 1e308, 5e-324])
        layout = self.random.randrange(16)
        if layout == 0:
            array = np.asfortranarray(array)
        elif layout == 1:
            array = np.repeat(array, 2, axis=0)[::2]
        elif layout == 2:
            array = array[::-1]
        elif layout == 3:
            array = array[: self.random.randrange(len(array) + 1)]
        elif layout == 4:
            array = array.reshape(-1)
        elif layout == 5:
            array = array[..., None]
        elif layout == 6 and array.dtype.kind in "fiu":
            array = np.frombuffer(b"x" + array.tobytes(), array.dtype, offset=1).reshape(array.shape)
        elif layout == 7:
            return array.tolist()
        elif layout == 8:
            array = np.broadcast_to(array[:1], array.shape) if len(array) else array
        elif layout == 9 and self.one_in(6):
            return self.random.choice(STRANGE)
        return array

    def pairs(self, points: int) -> np.ndarray:
        """Pairs of vertices: edges along the rows of a grid, or any."""
        first = self.numbers.integers(0, max(points, 1), self.random.randrange(10))
        second = first + 1 if self.one_in(2) else self.numbers.permutation(first)
        pairs = np.column_stack([first, second])
        return pairs if self.one_in(8) else pairs[second < points]

    def constraint(self, name: str, points: int, triangles: int) -> object:
        if name == "regions":
            array = self.numbers.integers(-3, 3, triangles)
        elif name == "size":
            array = np.exp(self.numbers.normal(0, 2, points))
        elif name in ("lines", "links"):
            array = self.pairs(points)
        elif name == "line_tags":
            array = self.numbers.integers(-3, 3, self.random.randrange(10))
        elif self.one_in(2):
            array = self.numbers.integers(0, 2, points).astype(bool)
        else:
            array = self.numbers.integers(0, max(points, 1), self.random.randrange(10))
        return self.spoiled(array, [*INTEGERS, *FLOATS])

    def options(self) -> dict:
        choices = {
            "method": [*trismooth.METHODS],
            "form": ["a", "b"],
            "backend": ["auto", "cpu"],
            "layout": ["aos"],
            "execution": ["resident", "single-block", "cdp"],
            "topology": ["auto", "host", "device", "halfedge"],
            "precision": ["double", "single"],
            "evaluation": ["changed", "all"],
            "guard": [True, False],
            "untangle": [True, False, "auto"],
            "layers": ["auto", "keep", "smooth"],
            "max_sweeps": [1, 5, 50],
            "tolerance": [0.0, 1e-6, 0.1],
            "time_limit": [None, 0.0, 1e-3],
            "target_quality": [None, -1, 0.5, 1],
            "threads": [0, 1, 2, 5],
            "size_weight": [0, 1.0, 3],
            "power": [None, 1, 8],
            "target": ["uniform", "input-shape"],
            "record_min_shape": [True, False],
            "quality": [True, False, None],
            "slide": ["off", "straight", "curves", "curves"],
            "corner_angle": [None, 0, 30.0, 120, 180],
            "deviation": [None, 0, 1e-3, 0.3, 1],
            "curve": ["polyline", "spline"],
            "slide_coincident": [True, False],
        }
        options = {}
        names = self.random.sample(sorted(choices), self.random.randrange(6))
        if self.one_in(3):
            names += [name for name in ("slide", "deviation", "corner_angle", "curve") if name not in names]
        for name in names:
            options[name] = self.random.choice(STRANGE if self.one_in(15) else choices[name])
        options.setdefault("max_sweeps", 20)
        if self.one_in(40):
            options["methd"] = 1
        if self.one_in(20):
            options["progress"] = self.random.choice([lambda sweep: None, lambda sweep: False, 5])
        return options


def areas_can_be_told(points: np.ndarray) -> bool:
    """Whether the area of every triangle can be told from zero at the scale of the whole mesh.

    A double has some 300 decades on either side of one and an area takes two for each decade of length: where lengths are
    spread over more than 150 of them, the small triangles count as degenerate for as long as the large ones are there.
    """
    sizes = np.abs(points.astype(float))
    return bool(sizes.max(initial=0) * 1e-150 <= sizes[sizes > 0].min(initial=np.inf))


def check_result(result: object, points: object, triangles: object, options: dict) -> None:
    """What a result promises of itself."""
    smoothed = np.asarray(result.points)
    given = np.asarray(points)
    if isinstance(points, np.ndarray) and options.get("out") is None:
        assert smoothed.dtype == points.dtype and smoothed.shape == points.shape, "another type or shape"
    # Where the time is up before anything is found out nobody has looked at the points, nor for lines to slide on.
    unseen = result.stop_reason == "time_limit" and result.sweeps == 0 and np.array_equal(smoothed, given, equal_nan=True)
    assert unseen or np.isfinite(smoothed.astype(float)).all(), "a coordinate that is not finite"
    moved = int(np.any(smoothed != given, axis=1).sum()) if not unseen else 0
    assert moved == result.moved or moved <= result.moved, f"{moved} vertices differ, {result.moved} are said to"
    slid = 0 if result.sliding is None else result.sliding.slid
    assert 0 <= slid <= result.moved, f"{slid} vertices slid, {result.moved} moved"
    slides = options.get("slide", "off") != "off"
    assert unseen or (result.sliding is not None) == slides, "sliding that nobody asked for, or none"
    guarded = options.get("guard", True) is True and not (result.untangling or {}).get("turned_components")
    if result.has_quality and guarded and areas_can_be_told(given):
        # What is most of a mesh of quadrilaterals, by area, need not be most of it by shape: the report may turn it over.
        inverted = result.inverted if result.before.quadrilaterals > 0 else result.after.inverted
        assert inverted <= result.before.inverted, "more inverted elements than before"


# What a mesh that moves has no use for.
NOT_OF_MOVING = ("size", "slide", "corner_angle", "deviation", "curve", "slide_coincident", "lines", "line_tags", "links")


def in_order_of_machine(points: object) -> bytes:
    array = np.array(points)
    return array.astype(array.dtype.newbyteorder("=")).tobytes()


def follow(make: Maker, points: object, triangles: object, arguments: dict, out: object) -> None:
    """A mesh that goes elsewhere and comes back, to the same bits."""
    if not make.one_in(10):
        arguments = {name: value for name, value in arguments.items() if name not in NOT_OF_MOVING}
    step = {name: arguments.pop(name) for name in ("progress", "quality") if name in arguments}
    arguments.pop("out", None)
    mesh = trismooth.MovingMesh(points, triangles, **arguments)
    first = in_order_of_machine(mesh.follow(points, **step).points)
    elsewhere = mesh.points
    elsewhere[mesh.held] = elsewhere[mesh.held] * 0.75
    mesh.follow(elsewhere, start=make.random.choice(["reference", "previous"]), **step)
    again = mesh.follow(points, out=out, **step)
    if arguments.get("time_limit") is None:
        assert in_order_of_machine(again.points) == first, "the same boundary gave other points"


def call(seed: int) -> str:
    """One call; answers what became of it."""
    make = Maker(seed)
    columns, rows = make.random.randrange(1, 9), make.random.randrange(1, 9)
    points = make.spoiled(make.points(columns, rows), FLOATS)
    elements = make.quadrilaterals if make.one_in(3) else make.triangles
    triangles = make.spoiled(elements(columns, rows), INTEGERS)
    count = len(points) if hasattr(points, "__len__") else 0
    many = len(triangles) if hasattr(triangles, "__len__") else 0
    arguments = make.options()
    for name in ("regions", "fixed", "other_cells", "size"):
        if make.one_in(5):
            arguments[name] = make.constraint(name, count, many)
    if make.one_in(5):
        arguments["lines"] = make.constraint("lines", count, many)
        if make.one_in(2):
            lines = len(arguments["lines"]) if hasattr(arguments["lines"], "__len__") else 0
            arguments["line_tags"] = make.numbers.integers(-1, 2, lines) if make.one_in(2) else make.constraint("line_tags", count, many)
    if make.one_in(8):
        arguments["links"] = make.constraint("links", count, many)
    if make.one_in(4):
        arguments["out"] = points if make.one_in(2) else make.spoiled(make.points(columns, rows), FLOATS)
    before = points.copy() if isinstance(points, np.ndarray) else None
    kept_triangles = triangles.copy() if isinstance(triangles, np.ndarray) else None
    given, out = points, arguments.get("out")
    failed = True
    try:
        if make.one_in(6):
            progress = arguments.pop("progress", None)
            arguments.pop("out", None)
            quality = arguments.pop("quality", False)
            plan = trismooth.Plan(triangles, count, **arguments)
            for _ in range(2):
                result = plan.smooth(points, out=out, quality=quality, progress=progress)
                points = points if out is None else np.array(result.points)
        elif make.one_in(5):
            follow(make, points, triangles, arguments, out)
        elif make.one_in(8):
            result = trismooth.quality(points, triangles)
            of_both = set(result) - {"radius_ratio", "skew", "taper"}
            assert not any(np.isnan(result[name]).any() for name in of_both), "a NaN among the metrics"
            for one, other in (("skew", "taper"), ("skew", "radius_ratio")):
                none = [np.isnan(result[name]) for name in (one, other) if name in result]
                assert len(none) < 2 or np.array_equal(none[0], none[1] != (other == "radius_ratio")), "metrics of both kinds"
        else:
            result = trismooth.smooth(points, triangles, **arguments)
            if before is not None and result.points is not points:
                check_result(result, before, triangles, arguments)
        failed = False
    except (TypeError, ValueError, trismooth.DeviceError) as error:
        assert NAMES_AN_ARGUMENT.match(str(error)), f"the message names no argument: {type(error).__name__}: {error}"
        outcome = type(error).__name__
    else:
        outcome = "result"
    if before is not None and (failed or out is not given):
        assert given.tobytes() == before.tobytes(), "points were changed"
    if kept_triangles is not None:
        assert triangles.tobytes() == kept_triangles.tobytes(), "triangles were changed"
    return outcome


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--seconds", type=float, default=20)
    parser.add_argument("--seed", type=int, help="repeat this call alone")
    parser.add_argument("--first", type=int, default=time.time_ns() % 10**9, help="the seed to begin with")
    options = parser.parse_args()
    np.seterr(all="ignore")
    if options.seed is not None:
        print(call(options.seed))
        return 0
    outcomes: dict = {}
    end = time.monotonic() + options.seconds
    seed = options.first
    while time.monotonic() < end:
        try:
            outcome = call(seed)
        except BaseException:
            print(f"found with --seed {seed}", file=sys.stderr)
            raise
        outcomes[outcome] = outcomes.get(outcome, 0) + 1
        seed += 1
    print(f"{seed - options.first} calls from seed {options.first}: {outcomes}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
