# SPDX-License-Identifier: BSD-3-Clause
"""Runs the program under test over the ranks of an MPI job, in a scratch folder."""

import json
import os
import pathlib
import shlex
import signal
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "end_to_end"))

import pieces  # noqa: E402
import tool  # noqa: E402

# What starts ranks, up to their number: "mpirun -n".
launcher = shlex.split(os.environ["TRISMOOTH_LAUNCHER"])
# A job that hangs is an error, soon.
longest_run = 60


def without_size_ratio(report):
    """A job says it where a gate asks for it, reports of one process always."""
    for part in ("before", "after"):
        if report[part]:
            report[part]["metrics"].pop("size_ratio", None)
    return report


class RanksTest(tool.ToolTest):
    """A test with a folder of its own, as ToolTest's, and a mesh in it."""

    def run_over(self, ranks, *arguments, expect=0):
        """Runs the program on so many ranks; 0: without a launcher."""
        outcome = self.run_job([*(launcher + [str(ranks)] if ranks else []), tool.program, *map(str, arguments)])
        self.assertEqual(outcome.code, expect, f"{' '.join(map(str, arguments))}\n{outcome}")
        return outcome

    def run_job(self, command):
        """Runs a job, which is to come to an end."""
        with subprocess.Popen(command, cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, start_new_session=True) as job:
            try:
                out, err = job.communicate(timeout=longest_run)
            except subprocess.TimeoutExpired:
                os.killpg(job.pid, signal.SIGKILL)
                out, err = job.communicate()
                self.fail(f"{' '.join(command)} hangs\n{err.decode(errors='replace')}")
        return tool.Outcome(job.returncode, out.decode(errors="replace"), err.decode(errors="replace"))

    def report_over(self, ranks, *arguments):
        self.run_over(ranks, *arguments, "--quiet", "--report", "report.json")
        return self.read_report()

    def read_report(self):
        return without_size_ratio(json.loads(self.read("report.json")))

    def report(self, *arguments, **options):
        return without_size_ratio(super().report(*arguments, **options))

    def random_mesh(self, vertices):
        """The paper's random mesh, with an array at points, one at cells and two regions."""
        self.run_tool("generate", "random.off", "--vertices", vertices)
        mesh = pieces.read_off(self.path("random.off"))
        mesh.point_arrays["height"] = [3.25 * x + y for x, y, _ in mesh.points]
        mesh.cell_arrays["load"] = [0.37 * c for c in range(len(mesh.cells))]
        mesh.cell_arrays["region"] = [7 if mesh.points[cell[0]][1] < 0.5 else -1 for cell in mesh.cells]
        return mesh

    def errors_of(self, outcome):
        """What the program calls errors."""
        return [line for line in outcome.err.splitlines() if line.startswith("trismooth: error:")]


def main():
    tool.main()
