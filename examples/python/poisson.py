#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Solves Poisson's problem with scikit-fem on a mesh of random points, before and after smoothing.

The solution is known, so the errors are, too. Beside them stand the iterations of the conjugate gradients, plain and
with Jacobi's preconditioner: better triangles give a better solution, sooner.

    pip install trismooth scikit-fem matplotlib
    ./poisson.py --output poisson.png
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from typing import Any, List, Optional, Sequence, Tuple

import matplotlib
import numpy as np
from scipy.sparse import csr_matrix, diags
from scipy.sparse.linalg import cg
from scipy.spatial import Delaunay
from skfem import Basis, BilinearForm, ElementTriP1, Functional, LinearForm, MeshTri, condense
from skfem.helpers import dot, grad

import trismooth

matplotlib.use("Agg")
from matplotlib import pyplot as plt  # noqa: E402

PI = np.pi


def solution(x: np.ndarray) -> np.ndarray:
    return np.sin(2 * PI * x[0]) * np.sin(3 * PI * x[1]) + x[0]


def gradient(x: np.ndarray) -> np.ndarray:
    along_x = 2 * PI * np.cos(2 * PI * x[0]) * np.sin(3 * PI * x[1]) + 1
    along_y = 3 * PI * np.sin(2 * PI * x[0]) * np.cos(3 * PI * x[1])
    return np.array([along_x, along_y])


@BilinearForm
def laplace(u: Any, v: Any, _: Any) -> Any:
    return dot(grad(u), grad(v))


@LinearForm
def load(v: Any, w: Any) -> Any:
    return 13 * PI**2 * np.sin(2 * PI * w.x[0]) * np.sin(3 * PI * w.x[1]) * v


@Functional
def squared_error(w: Any) -> Any:
    return (w["u"] - solution(w.x)) ** 2


@Functional
def squared_error_of_gradient(w: Any) -> Any:
    difference = grad(w["u"]) - gradient(w.x)
    return dot(difference, difference)


@dataclass
class Outcome:
    """What one mesh gives: errors, and the residuals of the iterations without and with a preconditioner."""

    name: str
    mesh: MeshTri
    shape: trismooth.MetricSummary
    error: float
    error_of_gradient: float
    plain: List[float]
    jacobi: List[float]


def random_mesh(parts: int) -> MeshTri:
    """Return Delaunay's triangulation of random points in the unit square, whose sides have so many parts."""
    random = np.random.default_rng(2)
    side = np.linspace(0, 1, parts + 1)[:-1]
    zero, one = np.zeros(parts), np.ones(parts)
    boundary = np.concatenate([np.c_[side, zero], np.c_[one, side], np.c_[1 - side, one], np.c_[zero, 1 - side]])
    # Points nearer to a side than this would leave triangles that no smoothing can help.
    margin = 0.5 / parts
    inside = random.uniform(margin, 1 - margin, (parts**2, 2))
    points = np.concatenate([boundary, inside])
    return MeshTri(*map(np.ascontiguousarray, (points.T, Delaunay(points).simplices.T)))


def conjugate_gradients(matrix: csr_matrix, b: np.ndarray, weights: np.ndarray) -> Tuple[np.ndarray, List[float]]:
    """Solve with a diagonal preconditioner. The residuals are after each iteration, as a part of the right side."""
    residuals: List[float] = []

    def record(x: np.ndarray) -> None:
        residuals.append(float(np.linalg.norm(b - matrix @ x) / np.linalg.norm(b)))

    x, failed = cg(matrix, b, rtol=1e-8, M=diags(weights), callback=record)
    assert not failed
    return x, residuals


def solve(name: str, mesh: MeshTri, shape: trismooth.MetricSummary) -> Outcome:
    """Solve the problem on the mesh."""
    basis = Basis(mesh, ElementTriP1(), intorder=8)
    u = solution(mesh.p)
    matrix, b, u, inner = condense(laplace.assemble(basis), load.assemble(basis), x=u, D=basis.get_dofs())
    _, plain = conjugate_gradients(matrix, b, np.ones(len(b)))
    u[inner], jacobi = conjugate_gradients(matrix, b, 1 / matrix.diagonal())
    field = basis.interpolate(u)
    error, slope_error = (np.sqrt(form.assemble(basis, u=field)) for form in (squared_error, squared_error_of_gradient))
    return Outcome(name, mesh, shape, error, slope_error, plain, jacobi)


def print_table(outcomes: Sequence[Outcome]) -> None:
    print(f"{'':8}{'smallest':>10}{'mean':>8}{'L2 error':>12}{'of gradient':>13}{'CG':>6}{'CG, Jacobi':>12}")
    for it in outcomes:
        print(
            f"{it.name:8}{it.shape.min:10.4f}{it.shape.mean:8.4f}{it.error:12.3e}{it.error_of_gradient:13.3e}"
            f"{len(it.plain):6}{len(it.jacobi):12}"
        )


def draw(outcomes: Sequence[Outcome], path: str) -> None:
    """Draw a corner of each mesh, and how the residuals fall."""
    figure, axes = plt.subplots(1, 3, figsize=(13, 4.2), layout="constrained", width_ratios=[1, 1, 1.1])
    for ax, it in zip(axes, outcomes):
        window = (-0.01, -0.01, 0.4, 0.4)
        trismooth.show(it.mesh, ax=ax, title=f"{it.name} (a corner)", window=window, colorbar=it is outcomes[1])
    for it, colour in zip(outcomes, ("#8a95a3", "#2463eb")):
        axes[2].semilogy(it.plain, colour, label=f"{it.name}, plain")
        axes[2].semilogy(it.jacobi, colour, linestyle="--", label=f"{it.name}, Jacobi")
    axes[2].set(xlabel="iterations of conjugate gradients", ylabel="residual, as a part of the right side", xlim=0)
    axes[2].grid(alpha=0.3)
    axes[2].legend(frameon=False)
    figure.savefig(path, dpi=120)


def main(arguments: Optional[Sequence[str]] = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--output", default="poisson.png", help="the picture [%(default)s]")
    parser.add_argument("--parts", type=int, default=60, help="edges along a side of the square [%(default)s]")
    options = parser.parse_args(arguments)

    mesh = random_mesh(options.parts)
    result = trismooth.smooth(mesh, method="mean-ratio")
    print(f"{mesh.nvertices} vertices, {mesh.nelements} triangles")
    outcomes = [solve("before", mesh, result.before["shape"]), solve("after", result.mesh, result.after["shape"])]
    print_table(outcomes)
    draw(outcomes, options.output)
    print(f"picture: {options.output}")


if __name__ == "__main__":
    main()
