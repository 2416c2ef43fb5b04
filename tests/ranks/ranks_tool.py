# SPDX-License-Identifier: BSD-3-Clause
"""Runs the program under test over the ranks of an MPI job, in a scratch folder."""

import atexit
import json
import os
import pathlib
import re
import shlex
import signal
import socket
import struct
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "end_to_end"))

import pieces  # noqa: E402
import tool  # noqa: E402

# What starts ranks, up to their number: "mpirun -n".
launcher = shlex.split(os.environ["TRISMOOTH_LAUNCHER"])
# A job that hangs is an error. (Ranks that share a busy machine give way to each other at every look for a message.)
longest_run = 180


# What a run may differ in.
RUN_ALONE = {"other_outputs", "timings_ms", "peak_memory_bytes", "path", "output", "threads", "device", "topology", "command", "date"}


def without_run(report, more=frozenset()):
    """A report, or a part of one, without what runs may differ in, and what else is named."""
    if isinstance(report, dict):
        return {key: without_run(value, more) for key, value in report.items() if key not in RUN_ALONE | more}
    if isinstance(report, list):
        return [without_run(value, more) for value in report]
    return report


def without_size_ratio(report):
    """A job says it where a gate asks for it, reports of one process always."""
    for part in ("before", "after"):
        if report[part]:
            report[part]["metrics"].pop("size_ratio", None)
    return report


class LastingJob:
    """Ranks that run the program as often as they are told to: lasting_rank.cpp."""

    running = {}

    @classmethod
    def of(cls, ranks, *starter):
        """`starter`: what starts each rank, as env does."""
        key = (ranks, *starter)
        if key not in cls.running:
            cls.running[key] = cls(key)
        return cls.running[key]

    def __init__(self, key):
        self.key = key
        ranks, *starter = key
        self.folder = tempfile.TemporaryDirectory(prefix="trismooth-")
        paths = [os.path.join(self.folder.name, name) for name in ("socket", "out", "err")]
        self.said = [open(path, "a+b", buffering=0) for path in paths[1:]]
        with socket.socket(socket.AF_UNIX) as door:
            door.bind(paths[0])
            door.listen(ranks)
            door.settimeout(longest_run)
            self.process = subprocess.Popen(
                [*launcher, str(ranks), *starter, os.environ["TRISMOOTH_LASTING_RANK"], *paths],
                stdin=subprocess.DEVNULL, stdout=self.said[0], stderr=self.said[1], start_new_session=True)
            try:
                self.ranks = [door.accept()[0] for _ in range(ranks)]
            except socket.timeout:
                self.kill()
                raise
        for rank in self.ranks:
            rank.settimeout(longest_run)

    def run(self, folder, words, **environment):
        """The outcome of a run, as the launcher gives it; an error of one rank alone ends the job, and the run after that
        has another."""
        line = "\t".join([*(f"{name}={value}" for name, value in environment.items()), folder, *words])
        for said in self.said:
            said.truncate(0)
        for rank in self.ranks:
            rank.sendall(line.encode() + b"\n")
        try:
            codes = [self.answer_of(rank) for rank in self.ranks]
        except socket.timeout as error:
            del self.running[self.key]
            self.kill()
            self.close()
            raise AssertionError(f"{' '.join(words)} hangs on {len(self.ranks)} ranks") from error
        has_ended = b"" in codes
        code = self.end() if has_ended else next((code for code in map(int, codes) if code != 0), 0)
        texts = []
        for said in self.said:
            said.seek(0)
            texts.append(said.read().decode(errors="replace"))
        if has_ended:
            self.close()
        return tool.Outcome(code, *texts)

    def address_space(self):
        """The most addresses that each rank has had so far, in KiB, in whatever order."""
        peaks = []
        for rank in self.ranks:
            process, _, _ = struct.unpack("3i", rank.getsockopt(socket.SOL_SOCKET, socket.SO_PEERCRED, 12))
            with open(f"/proc/{process}/status", encoding="ascii") as status:
                peaks.append(int(re.search(r"VmPeak:\s*(\d+) kB", status.read())[1]))
        return peaks

    @staticmethod
    def answer_of(rank):
        """A line, or nothing where the rank has ended."""
        try:
            return rank.recv(16)
        except ConnectionResetError:
            return b""

    def end(self):
        """Answers the launcher's exit code."""
        del self.running[self.key]
        for rank in self.ranks:
            rank.close()
        try:
            return self.process.wait(longest_run)
        except subprocess.TimeoutExpired:
            self.kill()
            raise

    def close(self):
        for opened in (*self.ranks, *self.said):
            opened.close()
        self.folder.cleanup()

    def kill(self):
        os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()


@atexit.register
def end_lasting_jobs():
    for job in list(LastingJob.running.values()):
        job.end()
        job.close()


class RanksTest(tool.ToolTest):
    """A test with a folder of its own, as ToolTest's, and a mesh in it."""

    def run_over(self, ranks, *arguments, expect=0):
        """Runs the program on so many ranks, which are there for the next run, too; 0: in a process, without a launcher."""
        words = list(map(str, arguments))
        if ranks == 0:
            return self.launch(0, *words, expect=expect)
        outcome = LastingJob.of(ranks).run(self.folder, words)
        self.assertEqual(outcome.code, expect, f"{' '.join(words)}\n{outcome}")
        return outcome

    def launch(self, ranks, *arguments, expect=0):
        """The same with ranks of its own, as users start it."""
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
