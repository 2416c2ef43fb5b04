#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Smooths the mesh of a Gmsh model in place, and draws it before and after.

The model is a bracket of steel with a round bushing of brass and a hole: two materials, and curved boundaries. Gmsh
knows which nodes lie on curves. They stay where they are: the boundaries, and the border between the materials.

    pip install trismooth gmsh matplotlib
    ./gmsh_model.py --output gmsh_model.png
"""

from __future__ import annotations

import argparse
from typing import Optional, Sequence

import gmsh
import matplotlib
import numpy as np

import trismooth

matplotlib.use("Agg")


def make_model() -> None:
    """Make the model: a plate with a curved right side, a bushing in it and a hole."""
    occ = gmsh.model.occ
    corners = [occ.addPoint(x, y, 0) for x, y in ((0, 0), (8, 0), (8, 5), (0, 5))]
    bulges = [occ.addPoint(x, y, 0) for x, y in ((10, 1.2), (9, 2.6), (10.5, 4))]
    lines = [occ.addLine(corners[i], corners[(i + 1) % 4]) for i in (0, 2, 3)]
    curve = occ.addSpline([corners[1], *bulges, corners[2]])
    plate = occ.addPlaneSurface([occ.addCurveLoop([lines[0], curve, *lines[1:]])])
    hole = occ.addDisk(6.8, 2.6, 0, 1.1, 0.7)
    bushing = occ.addDisk(2.6, 2.5, 0, 1.5, 1.5)
    occ.cut([(2, plate)], [(2, hole)])
    # Without this the plate and the bushing would lie above each other, and share no nodes.
    occ.fragment([(2, plate)], [(2, bushing)])
    occ.synchronize()

    surfaces = [tag for _, tag in gmsh.model.getEntities(2)]
    gmsh.model.addPhysicalGroup(2, [bushing], name="brass")
    gmsh.model.addPhysicalGroup(2, [tag for tag in surfaces if tag != bushing], name="steel")


def make_mesh(size: float) -> None:
    """Mesh the model, finer at curves, by Gmsh's Delaunay algorithm, and without Gmsh's own smoothing."""
    gmsh.option.setNumber("Mesh.MeshSizeMax", size)
    gmsh.option.setNumber("Mesh.MeshSizeFromCurvature", 30)
    gmsh.option.setNumber("Mesh.Algorithm", 5)
    gmsh.option.setNumber("Mesh.Smoothing", 0)
    gmsh.model.mesh.generate(2)


def surface_of_triangles() -> np.ndarray:
    """Return the tag of the surface that each triangle lies in, in the order of the result's triangles.

    Returns
    -------
    ndarray of int, shape (M,)
    """
    tags = [tag for _, tag in gmsh.model.getEntities(2)]
    counts = [sum(map(len, gmsh.model.mesh.getElements(2, tag)[1])) for tag in tags]
    return np.repeat(tags, counts)


def print_result(result: trismooth.Result) -> None:
    """Print what smoothing did."""
    print(f"{result.after.triangles} triangles, {result.moved} of {result.free_vertices} free nodes moved")
    print(f"{'':16}{'before':>8}{'after':>8}")
    rows = [("smallest shape", "shape", "min"), ("mean shape", "shape", "mean")]
    rows += [("smallest angle", "min_angle", "min"), ("largest angle", "max_angle", "max")]
    for name, metric, figure in rows:
        before, after = (getattr(report[metric], figure) for report in (result.before, result.after))
        print(f"{name:16}{before:8.3f}{after:8.3f}")


def main(arguments: Optional[Sequence[str]] = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--output", default="gmsh_model.png", help="the picture [%(default)s]")
    parser.add_argument("--size", type=float, default=0.5, help="largest edge length [%(default)s]")
    options = parser.parse_args(arguments)

    gmsh.initialize()
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        make_model()
        make_mesh(options.size)
        result = trismooth.gmsh.smooth(method="mean-ratio")
        regions = surface_of_triangles()
        # The model has the new mesh now: gmsh.write("bracket.msh") would write it.
    finally:
        gmsh.finalize()

    print_result(result)
    result.plot(regions=regions).savefig(options.output, dpi=120)
    print(f"picture: {options.output}")


if __name__ == "__main__":
    main()
