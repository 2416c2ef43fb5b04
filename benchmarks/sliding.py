# SPDX-License-Identifier: BSD-3-Clause
"""What sliding along boundaries and interfaces does for the elements, and to the lines.

    build/python/bin/python benchmarks/sliding.py build/release/pipeline/trismooth
        [--meshes FOLDER] [--pictures FOLDER] [--seeds 3] [tables ...]

Runs the program with mean-ratio, without sliding and with, and prints tables in Markdown: `squares`, `held`, `shapes`,
`libmesh`, `periodic`; all of them unless some are named. Judges the files that the program writes, with formulas of its
own. --meshes: a folder of further meshes for the table `held`. --pictures: where to put pictures of `shapes`.
"""

from __future__ import annotations

import argparse
import json
import math
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import meshio
import numpy as np

import sliding_meshes as made

ROOT = Path(__file__).resolve().parent.parent

OFF: list[str] = []
STRAIGHT = ["--slide", "straight"]
CURVES = ["--slide", "curves"]


@dataclass
class Mesh:
    points: np.ndarray
    triangles: np.ndarray
    held: np.ndarray  # one flag a point
    report: dict

    @property
    def shapes(self) -> np.ndarray:
        """4 sqrt(3) area / (sum of squared edges), negative where clockwise."""
        a, b, c = (self.points[self.triangles[:, i]] for i in range(3))
        squares = sum(((p - q) ** 2).sum(axis=1) for p, q in ((a, b), (b, c), (c, a)))
        u, v = b - a, c - a
        return 2 * math.sqrt(3) * (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / squares

    @property
    def sliding(self) -> dict:
        return self.report["smoothing"]["sliding"] or {}

    @property
    def area_change(self) -> float:
        return max((abs(a["after"] - a["before"]) / a["before"] for a in self.report.get("areas") or [] if a["before"]),
                   default=0.0)


def counter_clockwise(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """The triangles listed as their neighbours are, and most of them counter-clockwise: how a file lists them is no
    matter of their shape."""
    sides: dict[tuple[int, int], list[tuple[int, bool]]] = {}
    for t, (a, b, c) in enumerate(triangles.tolist()):
        for u, v in ((a, b), (b, c), (c, a)):
            sides.setdefault((min(u, v), max(u, v)), []).append((t, u < v))
    around: list[list[tuple[int, bool]]] = [[] for _ in triangles]
    for pair in sides.values():
        if len(pair) == 2:
            (s, is_up), (t, is_up_too) = pair
            around[s].append((t, is_up == is_up_too))
            around[t].append((s, is_up == is_up_too))
    turned = np.zeros(len(triangles), bool)
    found = np.zeros(len(triangles), bool)
    for first in range(len(triangles)):
        if found[first]:
            continue
        found[first] = True
        component = [first]
        for t in component:
            for other, differs in around[t]:
                if not found[other]:
                    found[other] = True
                    turned[other] = turned[t] ^ differs
                    component.append(other)
        a, b, c = (points[triangles[component, i]] for i in range(3))
        twice = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
        if (np.where(turned[component], -twice, twice) < 0).mean() > 0.5:
            turned[component] ^= True
    return np.where(turned[:, None], triangles[:, ::-1], triangles)


class Program:
    def __init__(self, path: Path, folder: Path) -> None:
        self.path = path
        self.folder = folder

    def read(self, path: Path, report: dict) -> Mesh:
        mesh = meshio.read(path)
        triangles = np.concatenate([cells.data[:, :3] for cells in mesh.cells if cells.type.startswith("triangle")])
        points = mesh.points[:, :2].astype(float)
        triangles = counter_clockwise(points, triangles)
        held = np.asarray(mesh.point_data.get("trismooth:fixed", np.zeros(len(points)))).astype(bool)
        return Mesh(points, triangles, held, report)

    def smooth(self, mesh: Path, options: list[str]) -> Mesh:
        out = self.folder / "smoothed.vtu"
        report = self.folder / "report.json"
        method = [] if "--method" in options else ["--method", "mean-ratio"]
        subprocess.run([self.path, "smooth", mesh, out, "--report", report, "--annotate", "--quiet", *method, *options],
                       check=True)
        return self.read(out, json.loads(report.read_text()))

    def as_it_is(self, mesh: Path) -> Mesh:
        out = self.folder / "annotated.vtu"
        subprocess.run([self.path, "quality", mesh, "--annotate", out, "--quiet"], check=True)
        return self.read(out, {})


def numbers(shapes: np.ndarray, *parts: float) -> str:
    return " / ".join(f"{x:.4f}" for x in [shapes.min(), *np.quantile(shapes, parts), shapes.mean()])


# ---------------------------------------------------------------------------------------------------------------------


def squares(program: Program, seeds: int) -> None:
    print("\n### A square meshed at random\n")
    print("Smallest / 0.1 percentile / mean; boundary points displaced by up to 45 % of their spacing.\n")
    print("| vertices | seed | fixed | `straight` | slid | corners and sides |\n|---|---|---|---|---|---|")
    for count in (10_000, 100_000):
        for seed in range(1, seeds + 1):
            points, triangles = made.random_square(count, seed)
            path = made.write_off(program.folder / "square.off", points, triangles)
            fixed = program.smooth(path, OFF)
            slid = program.smooth(path, STRAIGHT)
            exact = np.array_equal(slid.points[:4], points[:4])
            for axis in (0, 1):
                for wall in (0.0, 1.0):
                    on = points[:, axis] == wall
                    exact = exact and on.sum() > 2 and bool((slid.points[on, axis] == wall).all())
            print(f"| {count} | {seed} | {numbers(fixed.shapes, 0.001)} | {numbers(slid.shapes, 0.001)} "
                  f"| {slid.sliding['slid']} of {slid.sliding['vertices']} | {'exact' if exact else 'OFF'} |", flush=True)


def held(program: Program, meshes: list[Path]) -> None:
    print("\n### Elements whose corners are all held without sliding, and all elements\n")
    print("Smallest / 1st percentile / mean. `curves`: deviation 1e-3. Deviations are parts of an edge, areas those of "
          "the region that changed most.\n")
    print("| mesh | | elements | fixed | `straight` | `curves` | slid | deviation | area |\n|---|---|---|---|---|---|---|---|---|")
    for path in meshes:
        fixed = program.smooth(path, OFF)
        straight, curves = program.smooth(path, STRAIGHT), program.smooth(path, CURVES)
        all_held = fixed.held[fixed.triangles].all(axis=1)
        before = program.as_it_is(path)
        worse = any(m.shapes.min() < before.shapes.min() - 1e-12 or (m.shapes <= 0).sum() > (before.shapes <= 0).sum()
                    for m in (straight, curves))
        for name, part in (("three held", all_held), ("all", np.ones(len(all_held), bool))):
            if not part.any():
                continue
            which = f"{part.sum()} ({100 * part.mean():.1f} %)" if name != "all" else str(part.sum())
            tail = ""
            if name == "all":
                deviation = max(curves.sliding.get("relative_deviation", 0), straight.sliding.get("relative_deviation", 0))
                tail = (f"{straight.sliding.get('slid', 0)}, {curves.sliding.get('slid', 0)} | {deviation:.1e} "
                        f"| {straight.area_change:.1e}, {curves.area_change:.1e}")
                tail += "; WORSE THAN THE INPUT" if worse else ""
            else:
                tail = " | | "
            print(f"| {path.stem} | {name} | {which} | {numbers(fixed.shapes[part], 0.01)} "
                  f"| {numbers(straight.shapes[part], 0.01)} | {numbers(curves.shapes[part], 0.01)} | {tail} |",
                  flush=True)


# ---------------------------------------------------------------------------------------------------------------------


def distance_to_polyline(points: np.ndarray, line: np.ndarray) -> np.ndarray:
    """Of each point to the nearest edge of a closed line."""
    a, b = line, np.roll(line, -1, axis=0)
    way = b - a
    nearest = np.full(len(points), np.inf)
    for start, step in zip(a, way):
        part = np.clip(((points - start) @ step) / (step @ step), 0, 1)
        nearest = np.minimum(nearest, np.hypot(*(points - start - part[:, None] * step).T))
    return nearest


def sampled(line: np.ndarray, per_edge: int = 16) -> np.ndarray:
    parts = np.arange(per_edge) / per_edge
    return (line[:, None, :] + parts[None, :, None] * (np.roll(line, -1, axis=0) - line)[:, None, :]).reshape(-1, 2)


def inner_line(mesh: Mesh, near: np.ndarray) -> np.ndarray:
    """The numbers of the boundary's points among `near`, along it."""
    edges = np.sort(mesh.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    unique, count = np.unique(edges, axis=0, return_counts=True)
    nearby = set(near.tolist())
    around: dict[int, list[int]] = {}
    for a, b in unique[count == 1].tolist():
        if a in nearby and b in nearby:
            around.setdefault(a, []).append(b)
            around.setdefault(b, []).append(a)
    order = [next(iter(around))]
    while len(order) < len(around):
        order.append(next(v for v in around[order[-1]] if len(order) < 2 or v != order[-2]))
    return np.array(order)


def shapes(program: Program, pictures: Path | None) -> None:
    print("\n### A plate with a circular hole, and an airfoil\n")
    print("Deviation of the new line from the input's and back (Hausdorff, sampled), as a part of the mean edge of the "
          "line; off: of its points and middles of edges from the analytic shape.\n")
    print("| mesh | | smallest / 1st percentile / mean | slid | deviation | largest of an edge, as reported | off |")
    print("|---|---|---|---|---|---|---|")

    def off_circle(line: np.ndarray) -> float:
        both = np.concatenate([line, 0.5 * (line + np.roll(line, -1, axis=0))])
        return float(np.abs(np.hypot(*both.T) - 0.3).max())

    foil = made.airfoil_at(np.linspace(0, 1, 200_000, endpoint=False))

    def off_foil(line: np.ndarray) -> float:
        from scipy.spatial import cKDTree
        both = np.concatenate([line, 0.5 * (line + np.roll(line, -1, axis=0))])
        return float(cKDTree(foil).query(both)[0].max())

    for make, near, off in ((made.plate, lambda p: np.hypot(*p.T) < 0.31, off_circle),
                            (made.airfoil, lambda p: np.hypot(p[:, 0] - 0.5, p[:, 1]) < 0.6, off_foil)):
        path = make(program.folder / f"{make.__name__}.msh")
        before = program.smooth(path, OFF)
        numbers_on_line = inner_line(before, np.flatnonzero(near(before.points)))
        line = before.points[numbers_on_line]
        edge = np.hypot(*(np.roll(line, -1, axis=0) - line).T).mean()
        for title, options in (("fixed", OFF), ("`straight`", STRAIGHT), ("`curves`", CURVES),
                               ("`curves`, 1e-2", [*CURVES, "--deviation", "1e-2"]),
                               ("`curves`, `spline`, 1e-2", [*CURVES, "--deviation", "1e-2", "--curve", "spline"]),
                               ("`curves`, `spline`, 5e-2", [*CURVES, "--deviation", "5e-2", "--curve", "spline"])):
            after = program.smooth(path, options)
            now = after.points[numbers_on_line]
            apart = max(distance_to_polyline(sampled(now), line).max(), distance_to_polyline(sampled(line), now).max())
            print(f"| {make.__name__} | {title} | {numbers(after.shapes, 0.01)} | {after.sliding.get('slid', 0)} "
                  f"| {apart / edge:.1e} | {after.sliding.get('relative_deviation', 0):.1e} | {off(now):.2e} |", flush=True)
            if pictures is not None:
                draw(pictures / f"{make.__name__} {title.replace('`', '').replace(', ', ' ')}.png", after, line, now)


def draw(path: Path, mesh: Mesh, before: np.ndarray, now: np.ndarray) -> None:
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(1, 2, figsize=(16, 8))
    middle = before.mean(axis=0)
    span = np.ptp(before, axis=0).max()
    corner = before[np.argmin(before[:, 0])]
    for axis, (centre, width) in zip(axes, ((middle, 1.2 * span), (corner, 0.12 * span))):
        axis.tripcolor(*mesh.points.T, mesh.triangles, facecolors=mesh.shapes, vmin=0.4, vmax=1, edgecolors="k",
                       linewidth=0.3, cmap="RdYlGn")
        closed = np.concatenate([before, before[:1]])
        axis.plot(*closed.T, "b-", linewidth=0.8)
        axis.plot(*before.T, "b+", markersize=5)
        axis.plot(*now.T, "r.", markersize=4)
        axis.set_xlim(centre[0] - width / 2, centre[0] + width / 2)
        axis.set_ylim(centre[1] - width / 2, centre[1] + width / 2)
        axis.set_aspect("equal")
    figure.suptitle(f"{path.stem}: blue the input's line and vertices, red where these are now; colour: shape")
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=90)
    pyplot.close(figure)


# ---------------------------------------------------------------------------------------------------------------------


def libmesh(program: Program) -> None:
    print("\n### libMesh: straight sides with clustered nodes (issue 3385), and the mesh of its own test\n")
    print("Smallest / mean. `even`: what libMesh's test has its variational smoother reach, to 1e-6 of a coordinate.\n")
    print("| mesh | input | fixed | `straight` | `even` | slid | sweeps |\n|---|---|---|---|---|---|---|")
    cases = [("clustered", made.clustered(program.folder / "clustered.msh"), None)]
    for sheared, even in ((False, math.sqrt(3) / 2), (True, 1.0)):
        cases.append(("square, halved squares" if not sheared else "the same, sheared",
                      made.libmesh_square(program.folder / f"libmesh{sheared}.off", parallelogram=sheared), even))
    for name, path, even in cases:
        nothing = program.as_it_is(path)
        fixed, slid = program.smooth(path, OFF), program.smooth(path, STRAIGHT)
        print(f"| {name} | {numbers(nothing.shapes)} | {numbers(fixed.shapes)} | {numbers(slid.shapes)} "
              f"| {'' if even is None else f'{even:.4f}'} | {slid.sliding['slid']} of {slid.sliding['vertices']} "
              f"| {slid.report['smoothing']['sweeps']} |", flush=True)


def periodic(program: Program, seeds: int) -> None:
    print("\n### A periodic cell with a random mesh\n")
    print("| seed | method | slid | left equals right | bottom equals top |\n|---|---|---|---|---|")
    for seed in range(1, seeds + 1):
        points, triangles = made.random_square(10_000, seed, periodic=True)
        path = made.write_periodic_msh(program.folder / "periodic.msh", points, triangles)
        per_side = int(math.sqrt(len(points))) - 2
        for method in ("mean-ratio", "smart", "weighted"):
            slid = program.smooth(path, [*STRAIGHT, "--method", method])
            equal = []
            for axis in (0, 1):
                first = 4 + axis * 2 * per_side
                pair = slid.points[first:first + 2 * per_side]
                equal.append(np.array_equal(pair[0::2, 1 - axis].view(np.int64), pair[1::2, 1 - axis].view(np.int64))
                             and bool((pair[0::2, axis] == 0).all() and (pair[1::2, axis] == 1).all()))
            print(f"| {seed} | {method} | {slid.sliding['slid']} of {slid.sliding['vertices']} "
                  f"| {'to the bit' if equal[0] else 'NO'} | {'to the bit' if equal[1] else 'NO'} |", flush=True)


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("program", type=Path)
    arguments.add_argument("tables", nargs="*")
    arguments.add_argument("--meshes", type=Path)
    arguments.add_argument("--pictures", type=Path)
    arguments.add_argument("--seeds", type=int, default=3)
    given = arguments.parse_args()
    known = ("squares", "held", "shapes", "libmesh", "periodic")
    if unknown := set(given.tables) - set(known):
        sys.exit(f"no such table: {', '.join(sorted(unknown))}; there are {', '.join(known)}")
    wanted = given.tables or known
    with tempfile.TemporaryDirectory() as folder:
        program = Program(given.program.resolve(), Path(folder))
        if "squares" in wanted:
            squares(program, given.seeds)
        if "held" in wanted:
            meshes = [make(program.folder / f"generated_{make.__name__}.msh")
                      for make in (made.coast, made.machine, made.microstructure)]
            data = ROOT / "examples" / "data"
            meshes += [data / name for name in ("coast.vtu", "machine.vtu", "bay.14", "channel.msh", "farfield.vtk",
                                                "plate.off", "airfoil.su2")]
            if given.meshes is not None:
                meshes += sorted(p for p in given.meshes.iterdir() if p.suffix in (".vtk", ".vtu", ".off"))
            held(program, meshes)
        if "shapes" in wanted:
            shapes(program, given.pictures)
        if "libmesh" in wanted:
            libmesh(program)
        if "periodic" in wanted:
            periodic(program, given.seeds)


if __name__ == "__main__":
    main()
