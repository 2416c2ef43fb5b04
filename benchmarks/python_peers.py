# SPDX-License-Identifier: BSD-3-Clause
"""Smoothing planar finite element meshes from Python: what there is, and trismooth.

    python benchmarks/python_peers.py [--meshes random holes machine inverted coast farfield]
                                      [--times 100000 1000000] [--runs 5] [--peers TEXT ...]
                                      [--optimesh-python PATH]

Prints tables in Markdown. Each peer is one function from arrays to arrays, as a user would write it; its lines are
counted from its source. Quality is measured by one function for all, and not by trismooth: shape and angle by Verdict
(through PyVista), signed by areas of NumPy. Peers that are not installed are left out, with a line that says so.
optimesh runs in a process of its own, by the interpreter of --optimesh-python.
"""

from __future__ import annotations

import argparse
import contextlib
import importlib
import importlib.metadata
import inspect
import io
import os
import subprocess
import sys
import tempfile
import time
import tokenize
from dataclasses import dataclass, field
from pathlib import Path
from typing import Callable, Optional

import numpy as np
import pyvista

ROOT = Path(__file__).resolve().parent.parent

# ---------------------------------------------------------------------------------------------------------------------
# The peers: points (N, 2) and triangles (M, 3), counter-clockwise, in; points out, or points and triangles.


def trismooth_mean_ratio(points, triangles, regions=None):
    import trismooth

    return trismooth.smooth(points, triangles, regions=regions, method="mean-ratio").points


def trismooth_smart(points, triangles, regions=None):
    import trismooth

    return trismooth.smooth(points, triangles, regions=regions, method="smart").points


def trismooth_one_thread(points, triangles, regions=None):
    import trismooth

    return trismooth.smooth(points, triangles, regions=regions, method="mean-ratio", threads=1).points


def pyvista_smooth_defaults(points, triangles, regions=None):
    import numpy as np
    import pyvista

    mesh = pyvista.PolyData.from_regular_faces(np.column_stack([points, np.zeros(len(points))]), triangles)
    return mesh.smooth(boundary_smoothing=False).points[:, :2]


def pyvista_smooth(points, triangles, regions=None):
    import numpy as np
    import pyvista

    mesh = pyvista.PolyData.from_regular_faces(np.column_stack([points, np.zeros(len(points))]), triangles)
    return mesh.smooth(n_iter=100, relaxation_factor=0.5, boundary_smoothing=False).points[:, :2]


def pyvista_taubin_defaults(points, triangles, regions=None):
    import numpy as np
    import pyvista

    mesh = pyvista.PolyData.from_regular_faces(np.column_stack([points, np.zeros(len(points))]), triangles)
    return mesh.smooth_taubin(boundary_smoothing=False).points[:, :2]


def pyvista_taubin(points, triangles, regions=None):
    import numpy as np
    import pyvista

    mesh = pyvista.PolyData.from_regular_faces(np.column_stack([points, np.zeros(len(points))]), triangles)
    options = {"n_iter": 100, "pass_band": 0.001, "normalize_coordinates": True}
    return mesh.smooth_taubin(**options, boundary_smoothing=False).points[:, :2]


def held_vertices(triangles, regions, count):
    sides = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    keys = sides[:, 0].astype(np.int64) * count + sides[:, 1]
    unique, first, side_of, uses = np.unique(keys, return_index=True, return_inverse=True, return_counts=True)
    is_held = uses == 1
    if regions is not None:
        labels = np.repeat(regions, 3)
        is_held[side_of[labels != labels[first][side_of]]] = True
    held = np.zeros(count, dtype=bool)
    held[sides[first[is_held]]] = True
    return held


def pyvista_smooth_with_regions(points, triangles, regions=None):
    import numpy as np
    import pyvista

    # VTK holds what is also a cell of one vertex.
    held = np.flatnonzero(held_vertices(triangles, regions, len(points)))
    faces = np.column_stack([np.full(len(triangles), 3), triangles])
    verts = np.column_stack([np.ones(len(held), dtype=int), held])
    mesh = pyvista.PolyData(np.column_stack([points, np.zeros(len(points))]), faces=faces.ravel(), verts=verts.ravel())
    return mesh.smooth(n_iter=100, relaxation_factor=0.5, boundary_smoothing=False).points[:, :2]


def pyvista_taubin_with_regions(points, triangles, regions=None):
    import numpy as np
    import pyvista

    held = np.flatnonzero(held_vertices(triangles, regions, len(points)))
    faces = np.column_stack([np.full(len(triangles), 3), triangles])
    verts = np.column_stack([np.ones(len(held), dtype=int), held])
    mesh = pyvista.PolyData(np.column_stack([points, np.zeros(len(points))]), faces=faces.ravel(), verts=verts.ravel())
    options = {"n_iter": 100, "pass_band": 0.001, "normalize_coordinates": True}
    return mesh.smooth_taubin(**options, boundary_smoothing=False).points[:, :2]


def gmsh_in_plane(points, triangles, regions, method, niter):
    import gmsh
    import numpy as np

    # A plane surface gives Gmsh the parametric coordinates that its smoothers work in. Held vertices are points of the
    # geometry, which stay; the free ones belong to the surface.
    held = held_vertices(triangles, regions, len(points))
    places = np.column_stack([points, np.zeros(len(points))])
    tags = np.arange(1, len(points) + 1)
    gmsh.initialize(readConfigFiles=False)
    gmsh.option.setNumber("General.Verbosity", 1)
    gmsh.option.setNumber("Mesh.Renumber", 0)
    (left, low, _), (right, high, _) = places.min(axis=0), places.max(axis=0)
    rectangle = [(left, low), (right, low), (right, high), (left, high)]
    corners = [gmsh.model.geo.addPoint(x, y, 0, 0, len(points) + 1 + i) for i, (x, y) in enumerate(rectangle)]
    lines = [gmsh.model.geo.addLine(corners[i - 1], corners[i]) for i in range(4)]
    surface = gmsh.model.geo.addPlaneSurface([gmsh.model.geo.addCurveLoop(lines)])
    for tag in tags[held].tolist():
        gmsh.model.geo.addPoint(*places[tag - 1], 0, tag)
    gmsh.model.geo.synchronize()
    for tag in tags[held].tolist():
        gmsh.model.mesh.addNodes(0, tag, [tag], places[tag - 1])
    free = places[~held].ravel()
    gmsh.model.mesh.addNodes(2, surface, tags[~held], free, gmsh.model.getParametrization(2, surface, free))
    gmsh.model.mesh.addElementsByType(surface, 2, [], (triangles + 1).ravel())
    gmsh.model.mesh.optimize(method, niter=niter)
    found, coordinates, _ = gmsh.model.mesh.getNodes()
    gmsh.finalize()
    places[found.astype(np.int64) - 1] = coordinates.reshape(-1, 3)
    return places[:, :2]


def gmsh_laplace(points, triangles, regions=None):
    return gmsh_in_plane(points, triangles, regions, "Laplace2D", 10)


def gmsh_relocate(points, triangles, regions=None):
    return gmsh_in_plane(points, triangles, regions, "Relocate2D", 20)


def gmsh_untangle(points, triangles, regions=None):
    return gmsh_in_plane(points, triangles, regions, "UntangleMeshGeometry", 1)


def gmsh_discrete(points, triangles, regions=None):
    import gmsh
    import numpy as np

    places = np.column_stack([points, np.zeros(len(points))])
    gmsh.initialize(readConfigFiles=False)
    gmsh.option.setNumber("General.Verbosity", 1)
    gmsh.option.setNumber("Mesh.Renumber", 0)
    gmsh.model.addDiscreteEntity(2, 1)
    gmsh.model.mesh.addNodes(2, 1, np.arange(1, len(points) + 1), places.ravel())
    gmsh.model.mesh.addElementsByType(1, 2, [], (triangles + 1).ravel())
    gmsh.model.mesh.classifySurfaces(np.pi, True, True, np.pi)
    gmsh.model.mesh.createGeometry()
    gmsh.model.mesh.optimize("Relocate2D", force=True, niter=5)
    found, coordinates, _ = gmsh.model.mesh.getNodes()
    gmsh.finalize()
    places[found.astype(np.int64) - 1] = coordinates.reshape(-1, 3)
    return places[:, :2]


def laplacian_sweeps(points, average, free, sweeps=100, tolerance=1e-6):
    points = points.copy()
    least = tolerance * np.ptp(points)
    for _ in range(sweeps):
        new = average @ points
        moved = np.abs(new - points[free]).max()
        points[free] = new
        if moved < least:
            break
    return points


def neighbours(triangles, count):
    import scipy.sparse

    ends = triangles[:, [0, 1, 2, 1, 2, 0]].T.ravel(), triangles[:, [1, 2, 0, 0, 1, 2]].T.ravel()
    matrix = scipy.sparse.csr_array((np.ones(len(ends[0])), ends), shape=(count, count))
    matrix.data[:] = 1
    return matrix


def scipy_loop(points, triangles, regions=None):
    import numpy as np
    import scipy.sparse

    free = np.flatnonzero(~held_vertices(triangles, regions, len(points)))
    matrix = neighbours(triangles, len(points))
    average = scipy.sparse.diags_array(1 / np.maximum(matrix.sum(axis=1), 1)) @ matrix
    return laplacian_sweeps(points, average[free], free)


def scipy_exact(points, triangles, regions=None):
    import numpy as np
    import scipy.sparse

    held = held_vertices(triangles, regions, len(points))
    matrix = neighbours(triangles, len(points))
    laplacian = (scipy.sparse.diags_array(matrix.sum(axis=1)) - matrix).tocsr()[~held]
    points = points.copy()
    points[~held] = scipy.sparse.linalg.spsolve(laplacian[:, ~held].tocsc(), -(laplacian[:, held] @ points[held]))
    return points


OPTIMESH = """
import sys, time, numpy, optimesh
given = numpy.load(sys.argv[1])
begin = time.perf_counter()
points, cells = optimesh.optimize_points_cells(
    given["points"], given["triangles"], sys.argv[3], float(sys.argv[4]), int(sys.argv[5]))
numpy.savez(sys.argv[2], points=points, triangles=cells, seconds=time.perf_counter() - begin)
"""


def optimesh_function(interpreter: str, method: str) -> Callable:
    def run(points, triangles, regions=None):
        with tempfile.TemporaryDirectory() as folder:
            given, result = os.path.join(folder, "in.npz"), os.path.join(folder, "out.npz")
            np.savez(given, points=points, triangles=triangles)
            subprocess.run(
                [interpreter, "-c", OPTIMESH, given, result, method, "1e-5", "100"], check=True, capture_output=True
            )
            with np.load(result) as found:
                run.seconds = float(found["seconds"])
                return found["points"][:, :2], found["triangles"]

    run.source = optimesh_script
    return run


def optimesh_script(points, triangles, method):
    import optimesh

    return optimesh.optimize_points_cells(points, triangles, method, 1.0e-5, 100)


# From file to file.


def meshio_file(source, target):
    import meshio

    mesh = meshio.read(source)
    mesh.points[:, :2] = scipy_loop(mesh.points[:, :2], mesh.cells_dict["triangle"], mesh.cell_data["region"][0])
    mesh.write(target)


def pyvista_file(source, target):
    import numpy as np
    import pyvista

    grid = pyvista.read(source)
    held = held_vertices(grid.cells_dict[5], grid["region"], grid.n_points)
    verts = np.column_stack([np.ones(held.sum(), dtype=int), np.flatnonzero(held)])
    mesh = pyvista.PolyData(grid.points, faces=grid.cells, verts=verts.ravel())
    grid.points = mesh.smooth(n_iter=100, relaxation_factor=0.5, boundary_smoothing=False).points
    grid.save(target)


def trismooth_meshio_file(source, target):
    import meshio
    import trismooth

    trismooth.smooth(meshio.read(source)).mesh.write(target)


def trismooth_pyvista_file(source, target):
    import pyvista
    import trismooth

    trismooth.smooth(pyvista.read(source)).mesh.save(target)


# ---------------------------------------------------------------------------------------------------------------------


@dataclass
class Peer:
    """A way to smooth: its function, that with regions where it is another one, and what it calls to smooth."""

    name: str
    package: str
    function: Callable
    call: Optional[tuple[str, str]]
    helpers: tuple[Callable, ...] = ()
    with_regions: Optional[Callable] = None
    region_helpers: tuple[Callable, ...] = ()
    smallest: int = 0  # vertices
    largest: int = 10**9


def peers_of(optimesh_python: Optional[str]) -> list[Peer]:
    held, in_plane = (held_vertices,), (held_vertices, gmsh_in_plane)
    smooth, taubin = ("pyvista:PolyData", "smooth"), ("pyvista:PolyData", "smooth_taubin")
    optimize, own = ("gmsh:model.mesh", "optimize"), ("trismooth:", "smooth")
    sweeps, solve = (f"{__name__}:", "laplacian_sweeps"), ("scipy.sparse.linalg:", "spsolve")
    result = [
        Peer("PyVista `smooth`, defaults", "pyvista", pyvista_smooth_defaults, smooth),
        Peer("PyVista `smooth`, 100 x 0.5", "pyvista", pyvista_smooth, smooth, (), pyvista_smooth_with_regions, held),
        Peer("PyVista `smooth_taubin`, defaults", "pyvista", pyvista_taubin_defaults, taubin),
        Peer(
            "PyVista `smooth_taubin`, 100, 0.001", "pyvista", pyvista_taubin, taubin, (), pyvista_taubin_with_regions,
            held,
        ),
        Peer("Gmsh `Relocate2D` x 5, discrete", "gmsh", gmsh_discrete, optimize, largest=12_000),
        Peer("Gmsh `Laplace2D` x 10, plane", "gmsh", gmsh_laplace, optimize, in_plane, gmsh_laplace, in_plane),
        Peer("Gmsh `Relocate2D` x 20, plane", "gmsh", gmsh_relocate, optimize, in_plane, gmsh_relocate, in_plane),
        Peer("Gmsh `UntangleMeshGeometry`, plane", "gmsh", gmsh_untangle, optimize, in_plane, gmsh_untangle, in_plane,
             largest=12_000),
    ]
    of_loop, of_solve = (held_vertices, neighbours, laplacian_sweeps), (held_vertices, neighbours)
    result += [
        Peer("NumPy and SciPy, Laplacian loop", "scipy", scipy_loop, sweeps, of_loop, scipy_loop, of_loop),
        Peer("NumPy and SciPy, Laplacian solved", "scipy", scipy_exact, solve, of_solve, scipy_exact, of_solve),
    ]
    if optimesh_python:
        for method in ("cpt-quasi-newton", "cpt-fixed-point", "odt-fixed-point", "lloyd"):
            function = optimesh_function(optimesh_python, method)
            result.append(Peer(f"optimesh `{method}`", "optimesh", function, None, largest=200_000))
    result += [
        Peer('trismooth `method="smart"`', "trismooth", trismooth_smart, own, (), trismooth_smart),
        Peer('trismooth, `method="mean-ratio"`', "trismooth", trismooth_mean_ratio, own, (), trismooth_mean_ratio),
        Peer("trismooth, one thread", "trismooth", trismooth_one_thread, own, smallest=12_001),
    ]
    return [peer for peer in result if is_there(peer, optimesh_python)]


MISSING: set[str] = set()


def is_there(peer: Peer, optimesh_python: Optional[str]) -> bool:
    if peer.package == "optimesh":
        command = [optimesh_python, "-c", "import optimesh; optimesh.optimize_points_cells"]
        try:
            found = subprocess.run(command, capture_output=True).returncode == 0
        except OSError:
            found = False
    else:
        try:
            importlib.import_module(peer.package)
            found = True
        except ImportError:
            found = False
    if not found and peer.package not in MISSING:
        MISSING.add(peer.package)
        print(f"Left out: {peer.package}, which cannot be imported.\n")
    return found


def lines_of(*functions: Callable) -> int:
    """The lines of the functions' sources that hold more than comments."""
    skipped = {tokenize.COMMENT, tokenize.NL, tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT, tokenize.ENDMARKER}
    count = 0
    for function in functions:
        source = inspect.getsource(getattr(function, "source", function))
        lines: set[int] = set()
        for token in tokenize.generate_tokens(io.StringIO(source).readline):
            if token.type not in skipped:
                lines.update(range(token.start[0], token.end[0] + 1))
        count += len(lines)
    return count


# ---------------------------------------------------------------------------------------------------------------------
# Meshes


@dataclass
class Mesh:
    name: str
    points: np.ndarray
    triangles: np.ndarray
    regions: Optional[np.ndarray] = None
    boundary: np.ndarray = field(init=False)
    interface: np.ndarray = field(init=False)

    def __post_init__(self) -> None:
        is_clockwise = signed_areas(self.points, self.triangles) < 0
        if np.mean(is_clockwise) > 0.5:
            self.triangles = self.triangles[:, [0, 2, 1]]
        self.triangles = np.ascontiguousarray(self.triangles, dtype=np.int32)
        self.points = np.ascontiguousarray(self.points, dtype=float)
        self.boundary = held_vertices(self.triangles, None, len(self.points))
        self.interface = held_vertices(self.triangles, self.regions, len(self.points)) & ~self.boundary


def random_mesh(count: int) -> Mesh:
    """Random points in a square; those of the boundary as far apart as those inside."""
    import scipy.spatial

    side = round(count**0.5)
    at, zeros = np.arange(side) / side, np.zeros(side)
    edges = [(at, zeros), (zeros + 1, at), (1 - at, zeros + 1), (zeros, 1 - at)]
    inside = np.random.default_rng(1).random((count - 4 * side, 2))
    points = np.concatenate([np.column_stack(edge) for edge in edges] + [inside])
    return Mesh("random points", points, scipy.spatial.Delaunay(points).simplices)


def plate_mesh() -> Mesh:
    """A plate with holes, by Gmsh without its smoothing."""
    import gmsh

    gmsh.initialize(readConfigFiles=False)
    for name, value in (
        ("General.Verbosity", 1),
        ("Mesh.Smoothing", 0),
        ("Mesh.MeshSizeFromCurvature", 40),
        ("Mesh.MeshSizeMax", 0.0177),
    ):
        gmsh.option.setNumber(name, value)
    plate = gmsh.model.occ.addRectangle(0, 0, 0, 2, 1)
    places = [(0.3, 0.3), (0.3, 0.75), (0.8, 0.6), (1.3, 0.25), (1.4, 0.7), (1.8, 0.2)]
    radii = [0.12, 0.05, 0.2, 0.08, 0.15, 0.04]
    holes = [(2, gmsh.model.occ.addDisk(*place, 0, radius, radius)) for place, radius in zip(places, radii)]
    gmsh.model.occ.cut([(2, plate)], holes)
    gmsh.model.occ.synchronize()
    gmsh.model.mesh.generate(2)
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    _, corners = gmsh.model.mesh.getElementsByType(2)
    gmsh.finalize()
    order = np.argsort(tags)
    triangles = order[np.searchsorted(tags, corners, sorter=order)].reshape(-1, 3)
    return of_used("plate with holes", coordinates.reshape(-1, 3), triangles)


def of_used(name: str, points: np.ndarray, triangles: np.ndarray) -> Mesh:
    """The mesh without vertices that no triangle has."""
    used, numbers = np.unique(triangles, return_inverse=True)
    return Mesh(name, points[used, :2], numbers.reshape(-1, 3))


def example_mesh(name: str) -> Mesh:
    grid = pyvista.read(ROOT / "examples" / "data" / name)
    return of_used(name, np.asarray(grid.points), grid.cells_dict[5])


def machine_mesh() -> Mesh:
    grid = pyvista.read(ROOT / "examples" / "data" / "machine.vtu")
    return Mesh("machine.vtu", np.asarray(grid.points)[:, :2], grid.cells_dict[5], np.asarray(grid["region"]))


def inverted_mesh() -> Mesh:
    """The plate with 2 of 100 inner vertices displaced by up to 1.5 times their longest edge."""
    plate = plate_mesh()
    generator = np.random.default_rng(2)
    inner = np.flatnonzero(~plate.boundary)
    chosen = generator.choice(inner, len(inner) // 50, replace=False)
    longest = np.zeros(len(plate.points))
    for first, second in ((0, 1), (1, 2), (2, 0)):
        ends = plate.triangles[:, first], plate.triangles[:, second]
        for end in ends:
            np.maximum.at(longest, end, np.linalg.norm(plate.points[ends[0]] - plate.points[ends[1]], axis=1))
    angles = generator.uniform(0, 2 * np.pi, len(chosen))
    lengths = 1.5 * longest[chosen] * generator.random(len(chosen))
    points = plate.points.copy()
    points[chosen] += lengths[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])
    return Mesh("plate, displaced", points, plate.triangles)


MESHES = {
    "random": lambda: random_mesh(10_000),
    "holes": plate_mesh,
    "machine": machine_mesh,
    "inverted": inverted_mesh,
    "coast": lambda: example_mesh("coast.vtu"),
    "farfield": lambda: example_mesh("farfield.vtk"),
}

# ---------------------------------------------------------------------------------------------------------------------
# Measuring


def signed_areas(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    a, b, c = (points[triangles[:, i]] for i in range(3))
    return 0.5 * ((b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0]))


def quality(points: np.ndarray, triangles: np.ndarray) -> list[str]:
    """Smallest, first percentile and mean of shape, inverted triangles, smallest angle."""
    mesh = pyvista.PolyData.from_regular_faces(np.column_stack([points, np.zeros(len(points))]), triangles)
    measured = mesh.cell_quality(["shape", "min_angle"])
    areas = signed_areas(points, triangles)
    shape = np.where(areas > 0, 1, -1) * np.abs(measured["shape"])
    figures = [f"{shape.min():.3f}", f"{np.percentile(shape, 1):.3f}", f"{shape.mean():.4f}"]
    return figures + [str(int((areas <= 0).sum())), f"{np.abs(measured['min_angle']).min():.1f}"]


def moved(mesh: Mesh, points: np.ndarray, which: np.ndarray) -> str:
    """How many of these vertices moved, and how far at most, as a part of the mean edge."""
    if not which.any():
        return "-"
    distance = np.linalg.norm(points - mesh.points, axis=1)[which]
    count = int((distance > 0).sum())
    if count == 0:
        return f"0 of {which.sum()}"
    first, second = mesh.points[mesh.triangles[:, 0]], mesh.points[mesh.triangles[:, 1]]
    edge = np.linalg.norm(first - second, axis=1).mean()
    return f"{count} of {which.sum()}, by {distance.max() / edge:.2g}"


@contextlib.contextmanager
def timed(call: Optional[tuple[str, str]], seconds: list[float]):
    """Adds up the time that the named function takes meanwhile."""
    if call is None:
        yield
        return
    module, _, path = call[0].partition(":")
    owner = importlib.import_module(module)
    for part in filter(None, path.split(".")):
        owner = getattr(owner, part)
    # Of the class itself, so that static methods and inherited ones come back as they were.
    had, original = vars(owner).get(call[1]), getattr(owner, call[1])

    def timing(*arguments, **named):
        begin = time.perf_counter()
        try:
            return original(*arguments, **named)
        finally:
            seconds[0] += time.perf_counter() - begin

    is_static = inspect.isclass(owner) and isinstance(had, staticmethod)
    setattr(owner, call[1], staticmethod(timing) if is_static else timing)
    try:
        yield
    finally:
        if had is None:
            delattr(owner, call[1])
        else:
            setattr(owner, call[1], had)


@dataclass
class Outcome:
    points: np.ndarray
    triangles: np.ndarray
    call: float
    whole: float
    runs: int


def run_peer(peer: Peer, function: Callable, mesh: Mesh, regions, runs: int) -> Outcome:
    """The result, and the least times of the runs: 2 where one takes more than 10 s."""
    calls, wholes = [], []
    while len(wholes) < (runs if not wholes or wholes[0] < 10 else min(runs, 2)):
        seconds = [0.0]
        with timed(peer.call, seconds):
            begin = time.perf_counter()
            result = function(mesh.points, mesh.triangles, regions)
            whole = time.perf_counter() - begin
        own = getattr(function, "seconds", None)
        calls.append(seconds[0] if own is None else own)
        wholes.append(whole if own is None else own)
    points, triangles = result if isinstance(result, tuple) else (result, mesh.triangles)
    return Outcome(np.asarray(points), np.asarray(triangles), min(calls), min(wholes), len(wholes))


def milliseconds(seconds: float) -> str:
    return f"{1e3 * seconds:.1f}" if seconds < 0.1 else f"{1e3 * seconds:,.0f}"


def row(*cells: object) -> None:
    print("| " + " | ".join(map(str, cells)) + " |")


def head(*cells: str) -> None:
    row(*cells)
    print("|" + "---|" * len(cells))


def print_mesh(mesh: Mesh, peers: list[Peer], runs: int) -> None:
    print(f"\n### {mesh.name}: {len(mesh.points):,} vertices, {len(mesh.triangles):,} triangles\n")
    has_regions = mesh.regions is not None
    columns = ["", "smallest shape", "1st percentile", "mean", "inverted", "smallest angle", "boundary moved"]
    columns += ["interface moved"] if has_regions else []
    head(*columns, "call, ms", "arrays to arrays, ms")
    row("before", *quality(mesh.points, mesh.triangles), *["" for _ in range(4 if has_regions else 3)])
    for peer in peers:
        if not peer.smallest <= len(mesh.points) <= peer.largest:
            continue
        ways = [("", peer.function, None)]
        if has_regions:
            is_own = peer.package == "trismooth"
            ways = [] if is_own else [(", regions not told", peer.function, None)]
            if peer.with_regions:
                ways.append(("" if is_own else ", interfaces held", peer.with_regions, mesh.regions))
        for note, function, regions in ways:
            try:
                outcome = run_peer(peer, function, mesh, regions, runs)
            except Exception as error:  # A peer's failure is a result.
                row(peer.name + note, f"failed: {type(error).__name__}: {str(error)[:80]}", *[""] * len(columns))
                continue
            figures = quality(outcome.points, outcome.triangles)
            where = [moved(mesh, outcome.points, mesh.boundary)]
            where += [moved(mesh, outcome.points, mesh.interface)] if has_regions else []
            row(peer.name + note, *figures, *where, milliseconds(outcome.call), milliseconds(outcome.whole))
            sys.stdout.flush()


def print_times(counts: list[int], peers: list[Peer], runs: int, most: float) -> None:
    print("\n### Time, random points\n")
    columns = ("call, s", "arrays to arrays, s", "runs", "smallest shape", "1st percentile", "mean", "inverted")
    head("", "vertices", *columns)
    before: dict[str, float] = {}
    for count in counts:
        mesh = random_mesh(count)
        row("before", f"{count:,}", "", "", "", *quality(mesh.points, mesh.triangles)[:4])
        for peer in peers:
            expected = before.get(peer.name, 0.0) * (count / counts[0])
            if count < peer.smallest:
                continue
            if count > peer.largest or expected > most:
                row(peer.name, f"{count:,}", "not run", "", "", "", "", "", "")
                continue
            outcome = run_peer(peer, peer.function, mesh, None, runs)
            if count == counts[0]:
                before[peer.name] = outcome.whole
            figures = quality(outcome.points, outcome.triangles)[:4]
            row(peer.name, f"{count:,}", f"{outcome.call:.3f}", f"{outcome.whole:.3f}", outcome.runs, *figures)
            sys.stdout.flush()


def print_lines(peers: list[Peer]) -> None:
    print("\n### Lines of code\n")
    head("", "one region", "regions")
    for peer in peers:
        if peer.smallest > 0:
            continue
        with_regions = lines_of(peer.with_regions, *peer.region_helpers) if peer.with_regions else "-"
        row(peer.name, lines_of(peer.function, *peer.helpers), with_regions)


def print_files(runs: int) -> None:
    """From file to file, with regions held."""
    scripts = [
        (
            "meshio, NumPy and SciPy, loop", "meshio", meshio_file,
            (scipy_loop, held_vertices, neighbours, laplacian_sweeps),
        ),
        ("PyVista `smooth`, interfaces held", "pyvista", pyvista_file, (held_vertices,)),
        ("trismooth and meshio", "trismooth", trismooth_meshio_file, ()),
        ("trismooth and PyVista", "trismooth", trismooth_pyvista_file, ()),
    ]
    source, mesh = ROOT / "examples" / "data" / "machine.vtu", machine_mesh()
    print("\n### From file to file: machine.vtu\n")
    head("", "lines", "ms", "smallest shape", "1st percentile", "mean", "inverted", "interface moved")
    for name, package, script, helpers in scripts:
        if package in MISSING:
            continue
        with tempfile.TemporaryDirectory() as folder:
            target, times = os.path.join(folder, "out.vtu"), []
            for _ in range(runs):
                begin = time.perf_counter()
                script(str(source), target)
                times.append(time.perf_counter() - begin)
            points = np.asarray(pyvista.read(target).points)[:, :2]
        where = moved(mesh, points, mesh.interface)
        row(name, lines_of(script, *helpers), milliseconds(min(times)), *quality(points, mesh.triangles)[:4], where)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--meshes", nargs="*", choices=list(MESHES), default=list(MESHES))
    parser.add_argument("--times", nargs="*", type=int, default=[100_000, 1_000_000], help="vertices")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--peers", nargs="*", metavar="TEXT", help="only those whose names contain one of these")
    parser.add_argument("--most-seconds", type=float, default=60, help="for one run of a peer at the larger --times")
    parser.add_argument("--optimesh-python", metavar="PATH", help="an interpreter that can import optimesh")
    arguments = parser.parse_args()
    versions = [f"Python {sys.version.split()[0]}"]
    for package in ("trismooth", "numpy", "scipy", "pyvista", "vtk", "gmsh", "meshio"):
        try:
            module = importlib.import_module(package)
        except ImportError:
            continue
        try:
            versions.append(f"{package} {importlib.metadata.version(package)}")
        except importlib.metadata.PackageNotFoundError:
            versions.append(f"{package} {module.__version__}")
    print(", ".join(versions) + "\n")
    if not arguments.optimesh_python:
        print("Left out: optimesh, as there is no --optimesh-python.\n")
    peers = peers_of(arguments.optimesh_python)
    if arguments.peers:
        peers = [peer for peer in peers if any(text in peer.name for text in arguments.peers)]
    print_lines(peers)
    for name in arguments.meshes:
        print_mesh(MESHES[name](), peers, arguments.runs)
    if "machine" in arguments.meshes:
        print_files(arguments.runs)
    if arguments.times:
        print_times(sorted(arguments.times), peers, arguments.runs, arguments.most_seconds)


if __name__ == "__main__":
    main()
