# SPDX-License-Identifier: BSD-3-Clause
"""A locale that writes numbers with a comma changes nothing: not what is read, written, printed or reported.

Makes the locale in a folder of its own; exits with 77 where that cannot be done, which ctest shows as skipped.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

import sample_meshes
import tool

LOCALE = "de_DE.UTF-8"
# A comma between digits, which a number of this program never has.
COMMA = re.compile(r"\d,\d")


def make_locale(folder):
    """Compiles the locale into the folder; returns why that cannot be done, or nothing."""
    if shutil.which("localedef") is None or shutil.which("locale") is None:
        return "localedef is not installed"
    subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", os.path.join(folder, LOCALE)], check=False,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    done = subprocess.run(["locale", "decimal_point"], check=False, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                          env={**os.environ, "LOCPATH": folder, "LC_ALL": LOCALE})
    return None if done.stdout.strip() == b"," else f"localedef makes no {LOCALE} (package locales)"


class DecimalComma(tool.ToolTest):

    locales = None  # the folder, set below

    def setUp(self):
        super().setUp()
        self.comma = {"LOCPATH": self.locales, "LC_ALL": LOCALE, "LANG": LOCALE}
        self.point = {"LC_ALL": "C"}

    def both(self, *arguments, output, **options):
        """Runs the program in both locales; returns ([outcome with a point, with a comma], [output bytes of each])."""
        outcomes, outputs = [], []
        for environment in (self.point, self.comma):
            if os.path.exists(self.path(output)):
                os.remove(self.path(output))
            outcomes.append(self.run_tool(*arguments, environment=environment, **options))
            outputs.append(self.read(output))
        return outcomes, outputs

    def test_every_format_is_written_and_read_with_points(self):
        self.write("plate.off", sample_meshes.off(sample_meshes.Grid()))
        known = self.run_tool("smooth", "plate.off", "out.xyz", expect=4).err
        for extension in sorted({*re.findall(r"\.(\w+)", known.split("known are ")[1])} - {"node", "ele"}):
            with self.subTest(extension):
                output = "converted." + extension
                _, outputs = self.both("smooth", "plate.off", output, "--quiet", "--max-sweeps", 1, output=output)
                self.assertTrue(outputs[0] == outputs[1], "the bytes differ")
                again = "again." + extension
                _, outputs = self.both("smooth", output, again, "--quiet", output=again)
                self.assertTrue(outputs[0] == outputs[1], "the bytes differ")

    def test_reports_and_what_is_printed_have_points(self):
        self.write("plate.vtk", sample_meshes.legacy_vtk(sample_meshes.Grid(20)))
        counts = []
        for environment in (self.point, self.comma):
            outcome = self.run_tool("smooth", "plate.vtk", "out.vtk", "--report", "a.json", "--report", "a.html",
                                    "--tolerance", "1e-3", "--target-quality", "0.99", "--require", "min_shape>=0.01",
                                    environment=environment)
            report = json.loads(self.read("a.json"))
            counts.append([len(COMMA.findall(text)) for text in (self.read("a.html").decode(), outcome.out, outcome.err)])
            self.assertIsInstance(report["after"]["metrics"]["shape"]["min"], float)
            self.assertEqual(report["options"]["tolerance"], 1e-3)
            self.assertEqual(report["options"]["target_quality"], 0.99)
        # A page has pairs of numbers in its pictures, as many in each locale.
        self.assertEqual(counts[0], counts[1])
        self.assertEqual(counts[0][1:], [0, 0])

    def test_the_reports_of_the_bench_have_points(self):
        self.run_tool("bench", "--sizes", "300", "--runs", "1", "--backend", "cpu", "--report", "a.csv", "--report",
                      "a.json", "--report", "a.html", environment=self.comma)
        rows = [line.split(",") for line in self.read("a.csv").decode().splitlines()]
        self.assertGreater(len(rows), 1)
        self.assertEqual({len(row) for row in rows}, {len(rows[0])})
        self.assertTrue(any(re.fullmatch(r"\d+\.\d+", word) for row in rows[1:] for word in row))
        json.loads(self.read("a.json"))

    def test_numbers_with_a_comma_are_wrong_in_both_locales(self):
        self.write("plate.off", sample_meshes.off(sample_meshes.Grid()))
        self.write("comma.off", b"OFF\n3 1 0\n0 0 0\n1,5 0 0\n0 1 0\n3 0 1 2\n")
        for environment in (self.point, self.comma):
            outcome = self.run_tool("smooth", "comma.off", "out.off", environment=environment, expect=3)
            self.assertIn("comma.off:4: ", outcome.err)
            self.assertIn("'1,5'", outcome.err)
            self.run_tool("smooth", "plate.off", "out.off", "--tolerance", "0,5", environment=environment, expect=2)
            self.assertFalse(os.path.exists(self.path("out.off")))


if __name__ == "__main__":
    with tempfile.TemporaryDirectory(prefix="trismooth-locales-") as made:
        missing = make_locale(made)
        if missing:
            print(f"skipped: {missing}")
            sys.exit(77)
        DecimalComma.locales = made
        tool.main()
