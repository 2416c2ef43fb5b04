#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Memory that one rank of three lacks, at whatever place, ends all ranks, soon, with a message and the exit code that a
mesh too large for one process has; an old output survives.

    little_memory.py PROGRAM PRELOADED      (what failing_new.cpp makes)
"""

import os
import sys

import pieces
import ranks_tool
import tool

preloaded = os.path.abspath(sys.argv.pop(2))

RANKS = 3
BAD_INPUT, NOT_WRITTEN = 3, 4
OLD = b"an old output"


def evenly(first, last, count):
    """So many whole numbers from first to last."""
    count = min(count, last - first + 1)
    return sorted({first + (last - first) * i // max(count - 1, 1) for i in range(count)})


class LittleMemory(ranks_tool.RanksTest):
    def setUp(self):
        super().setUp()
        self.skip_if_instrumented()  # sanitizers have an operator new of their own
        mesh = self.random_mesh(1000)
        pieces.write_pieces(self.path("in.pvtu"), pieces.cut(mesh, pieces.stripes(mesh, RANKS), RANKS))

    def outputs(self):
        return {name: self.read(name) for name in sorted(os.listdir(self.folder)) if name.startswith("out")}

    def check_outcome(self, arguments, good, outcome, rank=0):
        """It has worked, or has ended with a message, which names the rank or the rank's file, and left what was there."""
        if outcome.code == 0:
            self.assertEqual(self.outputs(), good, outcome)
            return
        self.assertIn(outcome.code, (BAD_INPUT, NOT_WRITTEN), outcome)
        errors = [line for line in self.errors_of(outcome) if "error: cancelled" not in line]  # told to end meanwhile
        self.assertTrue(errors, outcome)
        for error in errors:
            self.assertRegex(error, "memory" if outcome.code == BAD_INPUT else "memory|standard output", outcome)
            if rank > 0:
                self.assertRegex(error, rf"rank {rank}: |_{rank}\.vtu: ", outcome)
        if "smooth" in arguments and outcome.code == BAD_INPUT:
            self.assertEqual(self.outputs(), {arguments[2]: OLD}, outcome)

    def prepared(self, arguments):
        for name in self.outputs():
            os.remove(self.path(name))
        if "smooth" in arguments:
            self.write(arguments[2], OLD)

    def check_allocations(self, *arguments, rank=1, samples=6):
        """Has single allocations of a rank fail, and twenty in a row."""
        arguments = [*arguments, "--threads", "1"]

        def run(first, failing):
            self.prepared(arguments)
            return ranks_tool.LastingJob.of(RANKS, "env", f"LD_PRELOAD={preloaded}").run(
                self.folder, arguments, FAILING_RANK=rank, FAIL_AT=first, FAILING_COUNT=failing,
                COUNT_FILE=self.path("count"))

        # (What is made once in a process does not count.)
        for _ in range(2):
            self.assertEqual(run(0, 0).code, 0)
        good = self.outputs()
        count = int(self.read("count"))
        self.assertGreater(count, 100)
        # (Behind the last of them rank 0 prints its results, as one process does.)
        for first in evenly(1, count - 25, 200 if tool.thorough else samples):
            for failing in (1, 20) if tool.thorough or first % 2 else (1,):
                with self.subTest(arguments=arguments, rank=rank, first=first, of=count, failing=failing):
                    self.check_outcome(arguments, good, run(first, failing), rank)

    def limited(self, kibibytes, arguments):
        """Ranks of their own, of which rank 1 has so many addresses."""
        self.prepared(arguments)
        command = list(ranks_tool.launcher[:-1])
        for rank in range(RANKS):
            limit = ["bash", "-c", f'ulimit -v {kibibytes}; exec "$@"', "bash"] if rank == 1 else []
            command += [*([":"] if rank else []), "-n", "1", *limit, tool.program, *arguments]
        return self.run_job(command)

    def test_limits(self):
        mesh = self.random_mesh(30000)
        pieces.write_pieces(self.path("large.pvtu"), pieces.cut(mesh, pieces.stripes(mesh, RANKS), RANKS))
        arguments = ["smooth", "large.pvtu", "out.pvtu", "--threads", "1", "--max-sweeps", "20"]
        self.run_over(RANKS, *arguments)
        good = self.outputs()
        enough = ranks_tool.LastingJob.of(RANKS).address_space()
        codes = set()
        # A mesh of that size takes some 10 MiB a rank.
        for kibibytes in evenly(min(enough) - (14 << 10), max(enough) + (2 << 10), 100 if tool.thorough else 8):
            with self.subTest(kibibytes=kibibytes, enough=enough):
                outcome = self.limited(kibibytes, arguments)
                codes.add(outcome.code)
                if outcome.code in (0, BAD_INPUT):
                    self.check_outcome(arguments, good, outcome, 1)
                else:  # MPI's or the system's libraries could not begin
                    self.assertEqual(self.outputs(), {"out.pvtu": OLD}, outcome)
        self.assertLessEqual({0, BAD_INPUT}, codes)

    def test_allocations_over_pieces(self):
        self.check_allocations("smooth", "in.pvtu", "out.pvtu", samples=12)

    def test_allocations_of_one_file(self):
        for rank in (0, 1):
            self.check_allocations("smooth", "random.off", "out.off", rank=rank)

    def test_allocations_of_one_file_shared_out(self):
        self.check_allocations("smooth", "random.off", "out.pvtu")

    def test_allocations_of_a_look_by_ranges(self):
        self.check_allocations("quality", "random.off")

    def test_allocations_of_a_gathered_mesh(self):
        for rank in (0, 1):
            self.check_allocations("smooth", "in.pvtu", "out.pvtu", "--slide", "straight", rank=rank,
                                   samples=4)


if __name__ == "__main__":
    ranks_tool.main()
