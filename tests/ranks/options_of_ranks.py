"""options_of_ranks.py PROGRAM: options that one rank alone is given are refused, by name, and no job waits for ever."""

import os
import re

import ranks_tool
import tool

WRONG_USAGE, DEVICE_ERROR = 2, 5

SLIDE = ["--slide", "curves"]
# Every option that matters to the others: what one rank is given, and what all are.
SHARED = {
    "--method": (["laplacian"], []),
    "--form": (["a"], []),
    "--untangle": (["on"], []),
    "--layers": (["smooth"], []),
    "--precision": (["single"], []),
    "--guard": (["off"], []),
    "--size-weight": (["0.5"], []),
    "--size-array": (["size"], []),
    "--power": (["2"], []),
    "--target": (["input-shape"], []),
    "--slide": (["straight"], []),
    "--corner-angle": (["40"], SLIDE),
    "--deviation": (["0.1"], SLIDE),
    "--curve": (["spline"], SLIDE),
    "--slide-coincident": ([], SLIDE),
    "--max-sweeps": (["3"], []),
    "--tolerance": (["0.01"], []),
    "--time-limit": (["1000"], []),
    "--target-quality": (["0.5"], []),
    "--region-array": (["none"], []),
    "--fixed-array": (["fixed"], []),
    "--fixed-set": (["none"], []),
    "--merge": (["0"], []),
    "--fixed-ids": (["ids.txt"], []),
    "--fixed-labels": (["ids.txt"], []),
    "--project": (["xy"], []),
    "--geographic": ([], []),
    "--fields": (["keep"], []),
    "--field-array": (["*"], []),
    "--partition": (["keep"], []),
    "--format": (["off"], ["--single"]),
    "--single": ([], []),
    "--gather": ([], []),
    "--verbose": ([], []),
    "--annotate": ([], []),
    "--annotate-metrics": (["shape,min_angle"], ["--annotate"]),
    "--require": (["size_ratio<9"], []),
}
# Those that a rank refuses by itself, as the build or a job of several has them not.
REFUSED_ALONE = {"--devices": ["0"], "--backend": ["cuda"], "--order": ["unordered"], "--layout": ["soa"]}
# Those that rank 0 has the say of, or each rank for itself, or the CPU takes no notice of.
FREE = {"--threads": ["1"], "--report": ["other.json"], "--quiet": [], "--topology": ["halfedge"],
        "--execution": ["single-block"]}


class OptionsOfRanks(ranks_tool.RanksTest):
    def setUp(self):
        super().setUp()
        self.run_tool("generate", "mesh.off", "--vertices", 200)
        self.write("ids.txt", "3 4\n")

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

    def test_every_option_is_known_here(self):
        named = set(re.findall(r"^ {2}(?:-\w, )?(--[a-z-]+)", self.run_tool("smooth", "--help").out, re.MULTILINE))
        self.assertEqual(named - {"--help"}, set(SHARED) | set(REFUSED_ALONE) | set(FREE))

    def test_options_of_one_rank(self):
        for name, (values, of_all) in SHARED.items():
            output = "out.vtu" if "--single" in [name, *of_all] else "out.pvtu"
            common = ["smooth", "mesh.off", output, *of_all]
            with self.subTest(name):
                self.refuse(name, common, [*common, name, *values])

    def test_options_of_all_but_one_rank(self):
        for name in ("--layers", "--region-array", "--max-sweeps"):
            values, of_all = SHARED[name]
            common = ["smooth", "mesh.off", "out.pvtu", *of_all]
            with self.subTest(name):
                self.refuse(name, [*common, name, *values], common)

    def test_options_that_one_rank_refuses(self):
        for name, values in REFUSED_ALONE.items():
            with self.subTest(name):
                common = ["smooth", "mesh.off", "out.pvtu"]
                self.refuse(name[2:], common, [*common, name, *values], codes=(WRONG_USAGE, DEVICE_ERROR))

    def test_other_commands(self):
        for other in (["info"], ["generate", "out.off", "--vertices", "9"], ["--version"], ["smooth", "--help"]):
            self.refuse("another command", ["smooth", "mesh.off", "out.pvtu"], other)

    def test_other_files(self):
        self.write("other.off", self.read("mesh.off"))
        for output in ("out.pvtu", "out.off"):
            self.refuse("INPUT", ["smooth", "mesh.off", output], ["smooth", "other.off", output])
            self.refuse("OUTPUT", ["smooth", "mesh.off", output], ["smooth", "mesh.off", "out2.off"])
            self.refuse("OUTPUT", ["smooth", "mesh.off", output], ["quality", "mesh.off"])

    def test_options_that_may_differ(self):
        common = ["smooth", "mesh.off"]
        self.run_tool(*common, "expected.off")
        for name, values in FREE.items():
            with self.subTest(name):
                outcome = self.job([*common, "out.off"], [*common, "out.off", name, *values])
                self.assertEqual(outcome.code, 0, outcome)
                self.assertEqual(self.read("out.off"), self.read("expected.off"))
                self.assertFalse(os.path.exists(self.path("other.json")))


if __name__ == "__main__":
    ranks_tool.main()
