# SPDX-License-Identifier: BSD-3-Clause
"""options_of_ranks.py PROGRAM: options that one rank alone is given are refused, by name, and no job waits for ever.

Examples: which options these are is in same_options.cpp.
"""

import os
import pathlib

import ranks_tool
import tool

WRONG_USAGE, DEVICE_ERROR = 2, 5


class OptionsOfRanks(ranks_tool.RanksTest):

    def setUp(self):
        super().setUp()
        self.run_tool("generate", "mesh.off", "--vertices", 200)

    def job(self, of_first, of_last):
        """Two ranks, each with arguments of its own."""
        return self.run_job([*ranks_tool.launcher, "1", tool.program, *of_first,
                             ":", *ranks_tool.launcher[1:], "1", tool.program, *of_last])

    def refuse(self, word, of_first, of_last, codes=(WRONG_USAGE,)):
        outcome = self.job(of_first, of_last)
        self.assertIn(outcome.code, codes, outcome)
        errors = [line for line in self.errors_of(outcome) if "error: cancelled" not in line]  # told to end meanwhile
        self.assertEqual(len(errors), 1, outcome)
        self.assertIn(word, errors[0])
        self.assertIn("rank 1", errors[0])
        self.assertEqual([file for file in os.listdir(self.folder) if file.startswith("out")], [])
        self.assert_no_temporary_files()

    def test_options_of_one_rank(self):
        common = ["smooth", "mesh.off", "out.pvtu"]
        self.refuse("--size-array", common, [*common, "--size-array", "size"])
        self.refuse("--max-sweeps", [*common, "--max-sweeps", "3"], common)
        self.refuse("OUTPUT", common, ["smooth", "mesh.off", "out2.off"])
        self.refuse("OUTPUT", common, ["quality", "mesh.off"])

    def test_pictures_take_the_whole_mesh(self):
        self.run_tool("smooth", "mesh.off", "one.off", "--picture", "one.svg")
        for arguments in (["smooth", "mesh.off", "out.pvtu"], ["quality", "one.off"]):
            with self.subTest(arguments):
                outcome = self.run_over(2, *arguments, "--picture", "out.svg", expect=WRONG_USAGE)
                self.assertIn("--picture over MPI ranks takes the whole mesh", self.errors_of(outcome)[0])
                self.assertFalse(os.path.exists(self.path("out.svg")) or os.path.exists(self.path("out.pvtu")))
                self.run_over(2, *arguments, "--picture", "out.svg", "--gather")
                self.assertEqual(self.read("out.svg"), self.read("one.svg"))
                for name in ("out.svg", "out.pvtu"):
                    pathlib.Path(self.path(name)).unlink(missing_ok=True)
        self.run_over(2, "smooth", "mesh.off", "out.off", "--picture", "out.svg")
        self.assertEqual(self.read("out.svg"), self.read("one.svg"))

    def test_options_that_one_rank_refuses(self):
        # The build or a job of several has them not.
        for name, value in {"--devices": "0", "--backend": "cuda", "--order": "unordered", "--layout": "soa"}.items():
            with self.subTest(name):
                common = ["smooth", "mesh.off", "out.pvtu"]
                self.refuse(name[2:], common, [*common, name, value], codes=(WRONG_USAGE, DEVICE_ERROR))

    def test_other_commands(self):
        for other in (["generate", "out.off", "--vertices", "9"], ["smooth", "--help"]):
            self.refuse("another command", ["smooth", "mesh.off", "out.pvtu"], other)

    def test_options_that_may_differ(self):
        common = ["smooth", "mesh.off"]
        self.run_tool(*common, "expected.off")
        outcome = self.job([*common, "out.off"],
                           [*common, "out.off", "--threads", "1", "--report", "other.json", "--quiet", "--topology",
                            "halfedge", "--execution", "single-block"])
        self.assertEqual(outcome.code, 0, outcome)
        self.assertEqual(self.read("out.off"), self.read("expected.off"))
        self.assertFalse(os.path.exists(self.path("other.json")))


if __name__ == "__main__":
    ranks_tool.main()
