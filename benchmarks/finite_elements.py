#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What smoothing does for finite element solutions: the tables of docs/finite_elements.md.

    finite_elements.py BUILD [--vertices N] [--meshes M] [METHOD]...

BUILD is a folder that trismooth was built in, with examples and benchmarks. Without METHOD: all methods. Figures are
means over M random meshes of a kind (5), smallest shape and largest area the worst of all; a file is one mesh. The last
column has iterations with Jacobi's preconditioner and both errors as multiples of those after `smart`.
Python 3 and its standard library suffice.
"""

import argparse
import pathlib
import statistics
import subprocess
import sys
import tempfile

DATA = pathlib.Path(__file__).resolve().parent.parent / "examples/data"
COLUMNS = ("sweeps", "smallest shape", "mean", "largest area", "CG", "CG, Jacobi")
POISSON = [("random, resolved boundary", "resolved"), ("hexagonal, jittered", "hexagonal"),
           ("grid, displaced by 45 %", "displaced"), ("random, the paper's data", "random"), *(
               (f"`{name}`", DATA / name) for name in ("machine.vtu", "coast.vtu", "plate.off", "farfield.vtk"))]
PLANE_STRESS = [("random", "plate-random"), ("hexagonal, jittered", "plate-hexagonal"),
                ("graded grid, displaced by 45 %", "plate-displaced"), ("`plate.off`, its bore", DATA / "plate.off")]


def output_of(*command):
    done = subprocess.run([str(part) for part in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stderr}")
    return done.stdout


def mesh_files(kind, arguments, folder):
    """The files of a kind of mesh, made where it is not a file already."""
    if isinstance(kind, pathlib.Path):
        return [kind]
    files = []
    for seed in range(1, arguments.meshes + 1):
        files.append(pathlib.Path(folder) / f"{kind}-{seed}.off")
        if kind in ("random", "resolved"):
            output_of(arguments.build / "pipeline/trismooth", "generate", files[-1], "--vertices", arguments.vertices,
                      "--seed", seed, "--boundary", kind)
        else:
            output_of(arguments.build / "benchmarks/finite_element_meshes", kind, arguments.vertices, seed, files[-1])
    return files


def rows_of(table):
    """Method -> numbers of its row; four of them where there is no solution."""
    rows = {}
    for line in table.splitlines()[1:]:
        name, *cells = line.split()
        rows[name] = [float(cell) for cell in (cells[:4] if "no solution" in line else cells)]
    return rows


def over_meshes(rows):
    """One row of several meshes'."""
    columns = list(zip(*rows)) if len({len(row) for row in rows}) == 1 else list(zip(*(row[:4] for row in rows)))
    kinds = [statistics.fmean, min, statistics.fmean, max] + [statistics.fmean] * 4
    return [kind(column) for kind, column in zip(kinds, columns)]


def cells_of(row, smart):
    formats = ("{:.0f}", "{:.4f}", "{:.4f}", "{:.2e}", "{:.0f}", "{:.0f}", "{:.2e}", "{:.3e}")
    cells = [form.format(number) for form, number in zip(formats, row)]
    if len(row) == 4:
        return [*cells, "no solution", "", "", "", ""]
    return [*cells, " / ".join(f"{mine / its:.2f}" for mine, its in zip(row[5:], smart[5:]))]


def print_table(title, errors, meshes, solve):
    columns = ["mesh", "", *COLUMNS, *errors, "times `smart`"]
    print(f"{title}\n\n| {' | '.join(columns)} |\n|{'---|' * len(columns)}")
    for name, kind in meshes:
        tables = [rows_of(table) for table in solve(kind)]
        rows = {method: over_meshes([table[method] for table in tables]) for method in tables[0]}
        for method, row in rows.items():
            label = method if method == "before" else f"`{method}`"
            print(f"| {name} | {label} | {' | '.join(cells_of(row, rows.get('smart', [])))} |", flush=True)
            name = ""
    print()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("methods", nargs="*")
    parser.add_argument("--vertices", default=10000, type=int)
    parser.add_argument("--meshes", default=5, type=int)
    arguments = parser.parse_intermixed_args()
    with tempfile.TemporaryDirectory() as folder:
        def poisson(kind):
            return [output_of(arguments.build / "examples/poisson", file, *arguments.methods)
                    for file in mesh_files(kind, arguments, folder)]

        def plane_stress(kind):
            hole = (38, 40, 19) if isinstance(kind, pathlib.Path) else (0, 0, 0.25)
            return [output_of(arguments.build / "examples/plane_stress", file, *hole, *arguments.methods)
                    for file in mesh_files(kind, arguments, folder)]

        print_table("Poisson's problem:", ("L2 error", "error of the gradient"), POISSON, poisson)
        print_table("Plane stress:", ("L2 error, relative", "energy error, relative"), PLANE_STRESS, plane_stress)


if __name__ == "__main__":
    main()
