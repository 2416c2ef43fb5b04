#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Where MPI crashes while it ends, the program has done its work, and its exit code says so.

    crashing_end.py PROGRAM PRELOADED      (what crashing_end.cpp makes)
"""

import os
import sys

import pieces
import ranks_tool
import tool

preloaded = os.path.abspath(sys.argv.pop(2))

WRONG_USAGE = 2


class CrashingEnd(ranks_tool.RanksTest):
    def setUp(self):
        super().setUp()
        self.skip_if_instrumented()  # sanitizers handle signals, and want to be first
        mesh = self.random_mesh(300)
        pieces.write_pieces(self.path("in.pvtu"), pieces.cut(mesh, pieces.stripes(mesh, 2), 2))

    def crashed(self, *arguments):
        """Without a launcher: a job of one process."""
        outcome = self.run_job(["env", f"LD_PRELOAD={preloaded}", tool.program, *arguments])
        self.assertIn("MPI crashed while it ended", outcome.err)
        return outcome

    def test_what_is_done_is_done(self):
        self.run_over(0, "smooth", "in.pvtu", "expected.pvtu", "--quiet")
        outcome = self.crashed("smooth", "in.pvtu", "out.pvtu", "--quiet")
        self.assertEqual(outcome.code, 0, outcome)
        for piece in (0, 1):
            self.assertEqual(self.read(f"out_{piece}.vtu"), self.read(f"expected_{piece}.vtu"))
        self.assert_no_temporary_files()

    def test_an_error_keeps_its_exit_code(self):
        outcome = self.crashed("smooth", "in.pvtu", "out.pvtu", "--fixed-array", "nosuch")
        self.assertEqual(outcome.code, WRONG_USAGE, outcome)
        self.assertEqual(len(self.errors_of(outcome)), 1, outcome)


if __name__ == "__main__":
    ranks_tool.main()
