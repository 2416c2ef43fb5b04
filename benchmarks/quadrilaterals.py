#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What smoothing makes of meshes with quadrilaterals: their shapes, and finite element solutions on them.

    quadrilaterals.py [--threads N] [METHOD]...

Without METHOD: all. Meshes are an airfoil with a boundary layer and a coast with a channel, of triangles around quadrilaterals, a plate with
two holes, recombined by Gmsh, and grids whose inner points are displaced at random: of squares, and of squares every second of which is two triangles. Solutions are of Poisson's problem and of plane
stress, by bilinear and linear elements. Errors are the L2 norm of the solution's and of its gradient's, as multiples of
those after `smart`, iterations those of conjugate gradients with Jacobi's preconditioner until the residual is 1e-8 of the
right side.
Needs NumPy, SciPy, Gmsh and the package trismooth.
"""

import argparse
import contextlib
import hashlib
import time

import gmsh
import numpy as np
import scipy.sparse
import scipy.sparse.linalg

import trismooth


@contextlib.contextmanager
def gmsh_model(**options):
    """A model of Gmsh that smooths nothing by itself; its mesh is to be taken before the end."""
    gmsh.initialize()
    for option, value in {"General.Terminal": 0, "Mesh.Smoothing": 0, "Mesh.Algorithm": 6, **options}.items():
        gmsh.option.setNumber(option, value)
    yield gmsh.model
    gmsh.finalize()


def mesh_of(model):
    """The points and elements of the model's mesh."""
    model.mesh.generate(2)
    tags, xyz, _ = model.mesh.getNodes()
    row = np.zeros(int(tags.max()) + 1, dtype=np.int32)
    row[tags.astype(int)] = np.arange(len(tags))
    elements = [np.full((0, 4), -1, dtype=np.int32)]
    for kind, corners in ((2, 3), (3, 4)):
        nodes = row[model.mesh.getElementsByType(kind)[1].astype(int)].reshape(-1, corners)
        elements.append(np.pad(nodes, ((0, 0), (0, 4 - corners)), constant_values=-1))
    return xyz.reshape(-1, 3)[:, :2].copy(), np.vstack(elements)


def plate(size):
    """A rectangle with two holes, of quadrilaterals that Gmsh makes of triangles."""
    with gmsh_model(**{"Mesh.MeshSizeMax": size, "Mesh.MeshSizeMin": size, "Mesh.RecombineAll": 1, "Mesh.RecombinationAlgorithm": 1}) as model:
        holes = [(2, model.occ.addDisk(0.6, 0.5, 0, 0.2, 0.2)), (2, model.occ.addDisk(1.4, 0.45, 0, 0.25, 0.15))]
        model.occ.cut([(2, model.occ.addRectangle(0, 0, 0, 2, 1))], holes)
        model.occ.synchronize()
        return mesh_of(model)


def airfoil():
    """NACA 0012 in a circle: a layer of quadrilaterals from 0.0005 of the chord on, by 1.2, and triangles around it."""
    x = 0.5 * (1 - np.cos(np.linspace(0, np.pi, 80)))
    y = 0.6 * (0.2969 * np.sqrt(x) - 0.126 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)
    with gmsh_model(**{"Mesh.MeshSizeMax": 1.0, "Mesh.MeshSizeExtendFromBoundary": 1}) as model:
        occ = model.occ
        upper = [occ.addPoint(a, b, 0, 0.02) for a, b in zip(x, y)]
        lower = [upper[0], *(occ.addPoint(a, -b, 0, 0.02) for a, b in zip(x[1:-1], y[1:-1])), upper[-1]]
        foil = [occ.addSpline(upper), occ.addSpline(lower)]
        circle = occ.addCircle(0.5, 0, 0, 8)
        occ.addPlaneSurface([occ.addCurveLoop([circle]), occ.addCurveLoop([foil[0], -foil[1]])])
        occ.synchronize()
        layer = model.mesh.field.add("BoundaryLayer")
        for name, value in (("CurvesList", foil), ("FanPointsList", [upper[-1]])):
            model.mesh.field.setNumbers(layer, name, value)
        for name, value in (("Size", 0.0005), ("Ratio", 1.2), ("Quads", 1), ("Thickness", 0.03)):
            model.mesh.field.setNumber(layer, name, value)
        model.mesh.field.setAsBoundaryLayer(layer)
        return mesh_of(model)


def coast():
    """A bay of triangles with a channel that winds inland: quadrilaterals five times as long as wide, as ocean models have
    them, and triangles on its banks."""
    along, across, width, length = 60, 6, 0.12, 6.0
    t = np.linspace(0, 1, 13)
    middle = np.column_stack([length * t, 0.6 * np.sin(5 * t)])
    slope = np.column_stack([np.full(13, length), 3.0 * np.cos(5 * t)])
    normal = np.column_stack([-slope[:, 1], slope[:, 0]]) / np.hypot(*slope.T)[:, None]
    with gmsh_model(**{"Mesh.MeshSizeMax": 0.4, "Mesh.RecombinationAlgorithm": 1}) as model:
        geo = model.geo
        banks = [[geo.addPoint(*p, 0, 0.1) for p in middle + side * width / 2 * normal] for side in (-1, 1)]
        right, left = (geo.addSpline(bank) for bank in banks)
        mouth, head = geo.addLine(banks[0][0], banks[1][0]), geo.addLine(banks[0][-1], banks[1][-1])
        channel = geo.addPlaneSurface([geo.addCurveLoop([right, head, -left, -mouth])])
        corners = [geo.addPoint(a, b, 0, 0.4) for a, b in ((0, -3), (6, -3), (6, 3), (0, 3))]
        lower = [geo.addLine(banks[0][0], corners[0]), geo.addLine(corners[0], corners[1]), geo.addLine(corners[1], banks[0][-1])]
        upper = [geo.addLine(banks[1][-1], corners[2]), geo.addLine(corners[2], corners[3]), geo.addLine(corners[3], banks[1][0])]
        geo.addPlaneSurface([geo.addCurveLoop([*lower, -right])])
        geo.addPlaneSurface([geo.addCurveLoop([*upper, left])])
        for curve, count in ((right, along), (left, along), (mouth, across), (head, across)):
            geo.mesh.setTransfiniteCurve(curve, count + 1)
        geo.mesh.setTransfiniteSurface(channel)
        geo.mesh.setRecombine(2, channel)
        geo.synchronize()
        return mesh_of(model)


def grid(n, jitter, pairs):
    """A square of n by n squares; `pairs`: whether every second one, at random, is two triangles."""
    random = np.random.default_rng(1)
    x, y = np.meshgrid(np.arange(n + 1.0), np.arange(n + 1.0))
    points = np.column_stack([x.ravel(), y.ravel()])
    inner = (points.min(axis=1) > 0) & (points.max(axis=1) < n)
    points[inner] += random.uniform(-jitter, jitter, (inner.sum(), 2))
    a = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    squares = np.column_stack([a, a + 1, a + n + 2, a + n + 1])
    is_pair = random.random(len(squares)) < (0.5 if pairs else 0)
    none = np.full(is_pair.sum(), -1)
    pair = squares[is_pair]
    halves = [np.column_stack([pair[:, [0, 1, 2]], none]), np.column_stack([pair[:, [0, 2, 3]], none])]
    return points / n, np.vstack([squares[~is_pair], *halves])


HYBRIDS = {"airfoil with a layer of quadrilaterals": airfoil, "coast with a channel of quadrilaterals": coast}
MESHES = {
    "plate, recombined, size 0.02": lambda: plate(0.02),
    "plate, recombined, size 0.01": lambda: plate(0.01),
    "grid of squares, displaced by 45 %": lambda: grid(100, 0.45, False),
    "grid of squares, displaced by 30 %": lambda: grid(100, 0.3, False),
    "grid of both kinds, displaced by 30 %": lambda: grid(100, 0.3, True),
}


class Kind:
    """The elements of one kind, with shape functions, their gradients and weights at the points of a rule."""

    def __init__(self, points, elements):
        self.elements = elements
        if elements.shape[1] == 4:
            at, weight = np.polynomial.legendre.leggauss(5)
            s, t = (a.ravel() for a in np.meshgrid((at + 1) / 2, (at + 1) / 2))
            weights = np.outer(weight, weight).ravel() / 4
            self.values = np.stack([(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t], axis=1)
            along = np.stack([np.stack([t - 1, s - 1], 1), np.stack([1 - t, -s], 1), np.stack([t, s], 1), np.stack([-t, 1 - s], 1)], 1)
        else:
            # The square's rule, folded: one of its sides becomes a corner.
            at, weight = np.polynomial.legendre.leggauss(6)
            s, t = (a.ravel() for a in np.meshgrid((at + 1) / 2, (at + 1) / 2))
            weights = np.outer(weight, weight).ravel() / 4 * (1 - s)
            t = t * (1 - s)
            self.values = np.stack([1 - s - t, s, t], axis=1)
            along = np.broadcast_to(np.array([[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]]), (len(s), 3, 2))
        corners = points[elements]
        self.at = np.einsum("qi,eid->eqd", self.values, corners)
        jacobian = np.einsum("qik,eid->eqdk", along, corners)
        self.weights = np.linalg.det(jacobian) * weights
        self.gradients = np.einsum("qik,eqkd->eqid", along, np.linalg.inv(jacobian))

    def assemble(self, local, size):
        """Local matrices, of one number a pair of nodes, as a sparse one."""
        k = self.elements.shape[1]
        rows, columns = np.repeat(self.elements, k, axis=1), np.tile(self.elements, (1, k))
        return scipy.sparse.csr_matrix((local.ravel(), (rows.ravel(), columns.ravel())), shape=(size, size))


def kinds_of(points, elements):
    is_triangle = elements[:, 3] < 0
    both = (elements[is_triangle, :3], elements[~is_triangle])
    return [Kind(points, listed) for listed in both if len(listed) > 0]


def boundary_of(elements, size):
    """A flag a vertex."""
    sides = [np.stack([listed, np.roll(listed, -1, axis=1)], 2).reshape(-1, 2)
             for listed in (elements[elements[:, 3] < 0, :3], elements[elements[:, 3] >= 0])]
    keys = np.sort(np.vstack(sides), axis=1)
    unique, counts = np.unique(keys, axis=0, return_counts=True)
    flags = np.zeros(size, dtype=bool)
    flags[unique[counts == 1].ravel()] = True
    return flags


def solve(matrix, right, known, held):
    """The solution with these values where it is held, and the iterations."""
    free = np.flatnonzero(~held)
    inner = matrix[free][:, free].tocsr()
    rest = right[free] - matrix[free][:, np.flatnonzero(held)] @ known[held]
    count = [0]
    scale = scipy.sparse.diags(1 / inner.diagonal())

    def tally(_):
        count[0] += 1

    found, failed = scipy.sparse.linalg.cg(inner, rest, rtol=1e-8, atol=0, maxiter=100_000, M=scale, callback=tally)
    if failed:
        raise ArithmeticError("no solution")
    solution = known.copy()
    solution[free] = found
    return solution, count[0]


def poisson(points, elements):
    """-Laplace(u) = f with u = sin(2 pi x) sin(3 pi y) + x: errors of u and of its gradient, and iterations."""
    pi, size = np.pi, len(points)

    def exact(at):
        return np.sin(2 * pi * at[..., 0]) * np.sin(3 * pi * at[..., 1]) + at[..., 0]

    matrix, right = scipy.sparse.csr_matrix((size, size)), np.zeros(size)
    kinds = kinds_of(points, elements)
    for kind in kinds:
        matrix = matrix + kind.assemble(np.einsum("eqid,eqjd,eq->eij", kind.gradients, kind.gradients, kind.weights), size)
        source = 13 * pi**2 * (exact(kind.at) - kind.at[..., 0])
        np.add.at(right, kind.elements, np.einsum("qi,eq,eq->ei", kind.values, source, kind.weights))
    solution, iterations = solve(matrix, right, exact(points), boundary_of(elements, size))
    errors = np.zeros(2)
    for kind in kinds:
        x, y = kind.at[..., 0], kind.at[..., 1]
        slope = np.stack([2 * pi * np.cos(2 * pi * x) * np.sin(3 * pi * y) + 1, 3 * pi * np.sin(2 * pi * x) * np.cos(3 * pi * y)], -1)
        nodal = solution[kind.elements]
        errors[0] += np.sum(kind.weights * (np.einsum("qi,ei->eq", kind.values, nodal) - exact(kind.at)) ** 2)
        errors[1] += np.sum(kind.weights[..., None] * (np.einsum("eqid,ei->eqd", kind.gradients, nodal) - slope) ** 2)
    return np.sqrt(errors), iterations


def plane_stress(points, elements):
    """A displacement with E = 1 and nu = 0.3, held at the boundary: errors of it and of its gradient, and iterations."""
    pi, size = np.pi, len(points)
    nu = 0.3
    stiff = np.array([[1, nu, 0], [nu, 1, 0], [0, 0, (1 - nu) / 2]]) / (1 - nu**2)

    def exact(at):
        x, y = at[..., 0], at[..., 1]
        return np.stack([np.sin(2 * pi * x) * np.cos(pi * y), np.cos(pi * x) * np.sin(2 * pi * y)], -1)

    def force(at):
        x, y = at[..., 0], at[..., 1]
        a, b, c = stiff[0, 0], stiff[0, 1], stiff[2, 2]
        u, v = np.sin(2 * pi * x) * np.cos(pi * y), np.cos(pi * x) * np.sin(2 * pi * y)
        u_xy, v_xy = -2 * np.cos(2 * pi * x) * np.sin(pi * y), -2 * np.sin(pi * x) * np.cos(2 * pi * y)
        return pi**2 * np.stack([(4 * a + c) * u - (b + c) * v_xy, (4 * a + c) * v - (b + c) * u_xy], -1)

    matrix, right = scipy.sparse.csr_matrix((2 * size, 2 * size)), np.zeros((size, 2))
    kinds = kinds_of(points, elements)
    for kind in kinds:
        gradients = kind.gradients
        strain = np.zeros((*gradients.shape[:2], 3, gradients.shape[2], 2))
        strain[:, :, 0, :, 0] = strain[:, :, 2, :, 1] = gradients[..., 0]
        strain[:, :, 1, :, 1] = strain[:, :, 2, :, 0] = gradients[..., 1]
        strain = strain.reshape(*strain.shape[:3], -1)
        local = np.einsum("eqai,ab,eqbj,eq->eij", strain, stiff, strain, kind.weights, optimize=True)
        degrees = (2 * kind.elements[..., None] + np.arange(2)).reshape(len(kind.elements), -1)
        k = degrees.shape[1]
        rows, columns = np.repeat(degrees, k, axis=1), np.tile(degrees, (1, k))
        matrix = matrix + scipy.sparse.csr_matrix((local.ravel(), (rows.ravel(), columns.ravel())), shape=matrix.shape)
        np.add.at(right, kind.elements, np.einsum("qi,eqd,eq->eid", kind.values, force(kind.at), kind.weights))
    held = np.repeat(boundary_of(elements, size), 2)
    solution, iterations = solve(matrix, right.ravel(), exact(points).ravel(), held)
    solution = solution.reshape(-1, 2)
    errors = np.zeros(2)
    for kind in kinds:
        x, y = kind.at[..., 0], kind.at[..., 1]
        slope = pi * np.stack(
            [np.stack([2 * np.cos(2 * pi * x) * np.cos(pi * y), -np.sin(2 * pi * x) * np.sin(pi * y)], -1),
             np.stack([-np.sin(pi * x) * np.sin(2 * pi * y), 2 * np.cos(pi * x) * np.cos(2 * pi * y)], -1)], -2)
        nodal = solution[kind.elements]
        difference = np.einsum("qi,eic->eqc", kind.values, nodal) - exact(kind.at)
        errors[0] += np.sum(kind.weights[..., None] * difference**2)
        errors[1] += np.sum(kind.weights[..., None, None] * (np.einsum("eqid,eic->eqcd", kind.gradients, nodal) - slope) ** 2)
    return np.sqrt(errors), iterations


def smoothed(points, elements, methods, threads):
    """Name -> points, sweeps and milliseconds."""
    found = {"before": (points, 0, 0.0)}
    for name in methods:
        method, _, power = name.partition(", p ")
        options = {"method": method, "threads": threads, **({"power": int(power)} if power else {})}
        begin = time.perf_counter()
        result = trismooth.smooth(points, elements, quality=False, **options)
        found[name] = (result.points, result.sweeps, 1e3 * (time.perf_counter() - begin))
    return found


def hybrid(name, make, methods, threads):
    """What becomes of the quadrilaterals, which are flat on purpose, and of the triangles around them."""
    points, elements = make()
    is_quad = elements[:, 3] >= 0
    print(f"\n{name}: {len(points)} vertices, {is_quad.sum()} quadrilaterals, {(~is_quad).sum()} triangles\n")
    print("| | quadrilaterals that moved | their smallest shape | triangles: smallest shape | 1st percentile | mean |\n|---|---|---|---|---|---|")
    for method, (moved, _, _) in smoothed(points, elements, methods, threads).items():
        has_moved = (moved != points).any(axis=1)
        shape = trismooth.quality(moved, elements).shape
        triangles = shape[~is_quad]
        print(f"| {method} | {has_moved[elements[is_quad]].any(axis=1).sum()} | {shape[is_quad].min():.4f} "
              f"| {triangles.min():.3f} | {np.quantile(triangles, 0.01):.3f} | {triangles.mean():.3f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("methods", metavar="METHOD", nargs="*")
    arguments = parser.parse_args()
    methods = arguments.methods or [*trismooth.METHODS, "mean-ratio, p 2", "mean-ratio, p 3"]
    if "smart" not in methods:
        methods.insert(0, "smart")
    for name, make in HYBRIDS.items():
        hybrid(name, make, methods, arguments.threads)
    for name, make in MESHES.items():
        points, elements = make()
        print(f"\n{name}: {len(points)} vertices, {(elements[:, 3] >= 0).sum()} quadrilaterals, {(elements[:, 3] < 0).sum()} triangles\n")
        print("| | smallest shape | 1st percentile | mean | inverted | sweeps | ms | hash |\n|---|---|---|---|---|---|---|---|")
        results = smoothed(points, elements, methods, arguments.threads)
        for method, (moved, sweeps, milliseconds) in results.items():
            quality = trismooth.quality(moved, elements)
            shape = quality.shape
            digest = hashlib.sha256(np.ascontiguousarray(moved).tobytes()).hexdigest()[:16]
            print(f"| {method} | {shape.min():.3f} | {np.quantile(shape, 0.01):.3f} | {shape.mean():.3f} | {quality.summary.inverted} "
                  f"| {sweeps} | {milliseconds:.0f} | `{digest}` |")
        for problem in (poisson, plane_stress):
            print(f"\n| {problem.__name__.replace('_', ' ')} | error | error of the gradient | iterations |\n|---|---|---|---|")
            reference, _ = problem(results["smart"][0], elements)
            for method, (moved, _, _) in results.items():
                if trismooth.quality(moved, elements).summary.inverted > 0:
                    print(f"| {method} | no solution | | |")
                    continue
                errors, iterations = problem(moved, elements)
                print(f"| {method} | {errors[0] / reference[0]:.3f} | {errors[1] / reference[1]:.3f} | {iterations} |")


if __name__ == "__main__":
    main()
