# SPDX-License-Identifier: BSD-3-Clause
"""`trismooth bench`: its reports agree with each other and with `trismooth smooth`, and it can be interrupted."""

import itertools
import json
import os
import pty
import re
import signal
import subprocess

import page_parser
import tool

CANCELLED = 130
COLUMNS = ("serial_ms", "aos_ms", "soa_ms", "aos_speedup", "soa_speedup")

KEYS = {
    "": {"trismooth", "date", "command", "machine", "options", "meshes", "rows", "tables", "conclusions", "same_bits",
         "remarks"},
    "machine": {"cpu", "threads", "gpu", "cuda"},
    "options": {"sizes", "versions", "precision", "seed", "runs", "seconds", "threads"},
    "mesh": {"size", "vertices", "triangles"},
    "row": {"size", "version", "layout", "form", "order", "missing_reason", "measured", "speedup", "speedup_together"},
    "measured": {"runs", "device", "threads", "topology_ms", "transfer_ms", "smoothing_ms", "together_ms", "sweeps",
                 "stop_reason", "vertex_updates", "free_vertices", "coordinates_hash", "same_bits_in_every_run",
                 "same_bits_as_first_case"},
    "table": {"table", "title", "version", "form", "order", "missing_reason", "rows"},
    "table row": {"size", "paper", *COLUMNS},
    "conclusion": {"number", "claim", "verdict", "findings", "comparisons"},
    "comparison": {"claimed_faster", "claimed_slower", "size", "factor", "support", "paper_factor", "sweeps"},
}
VERSIONS = ["serial", "cpu", "gpu", "cdp", "resident"]


class BenchTest(tool.ToolTest):

    def bench(self, *arguments):
        return self.run_tool("bench", *arguments)

    def bench_report(self, *arguments):
        """The JSON report of a run with these arguments."""
        self.bench(*arguments, "--report", "bench.json")
        return json.loads(self.read("bench.json"))


class Numbers(BenchTest):

    def setUp(self):
        super().setUp()
        self.outcome = self.bench("--sizes", "200,1K", "--runs", "2", "--report", "bench.json", "--report", "bench.csv",
                                  "--report", "bench.html")
        self.json = json.loads(self.read("bench.json"))

    def test_the_json_report_has_the_promised_keys(self):
        parts = [("", self.json), ("machine", self.json["machine"]), ("options", self.json["options"])]
        for key, name in {"meshes": "mesh", "rows": "row", "tables": "table", "conclusions": "conclusion"}.items():
            parts += [(name, part) for part in self.json[key]]
        parts += [("measured", row["measured"]) for row in self.json["rows"] if row["measured"]]
        parts += [("table row", row) for table in self.json["tables"] for row in table["rows"]]
        parts += [("comparison", comparison) for claim in self.json["conclusions"]
                  for comparison in claim["comparisons"]]
        self.assertEqual({name for name, _ in parts}, {*KEYS})
        for name, part in parts:
            self.assertEqual({*part}, KEYS[name], name)
        self.assertEqual(self.json["options"],
                         {"sizes": [200, 1000], "versions": VERSIONS, "precision": "single", "seed": 1, "runs": 2,
                          "seconds": 20, "threads": 0})
        self.assertRegex(self.json["date"], r"^\d{4}-\d\d-\d\d \d\d:\d\d UTC$")
        self.assertRegex(self.json["command"], "^trismooth bench .*--sizes 200,1000 ")
        self.assertIs(self.json["same_bits"], True)
        self.assertEqual([(mesh["size"], mesh["vertices"]) for mesh in self.json["meshes"]], [(200, 200), (1000, 1000)])
        for mesh in self.json["meshes"]:
            # Euler's formula: a square's hull has few of the vertices.
            self.assertLess(1.8 * mesh["vertices"], mesh["triangles"])
            self.assertLess(mesh["triangles"], 2 * mesh["vertices"])

    def test_the_text_and_the_page_say_what_the_json_says(self):
        parser = page_parser.PageParser()
        parser.feed(self.read("bench.html").decode())
        sentences = [*self.json["remarks"]]
        for claim in self.json["conclusions"]:
            sentences += [f"{claim['number']}. {claim['claim']}", claim["verdict"], *claim["findings"]]
        sentences += [table["title"] for table in self.json["tables"] if table["table"]]
        sentences += ["200 vertices, 386 triangles", self.json["machine"]["cpu"], self.json["date"]]
        for name, text in {"text": self.outcome.out, "page": parser.text}.items():
            text = " ".join(text.split())
            for sentence in sentences:
                with self.subTest(name):
                    self.assertIn(" ".join(sentence.split()), text)
        self.assertIn(self.json["command"], parser.text)
        self.assertEqual(re.findall("^report: (.*)", self.outcome.out, re.M), ["bench.json", "bench.csv", "bench.html"])
        self.assertEqual(self.outcome.err, "")

    def test_an_experiment_is_the_same_run_of_its_command(self):
        again = self.bench_report(*self.json["command"].split()[2:])
        self.assertEqual(again["command"], self.json["command"])
        self.assertEqual(again["options"], self.json["options"])

    def test_wrong_numbers_of_runs_and_repeated_or_unknown_options_are_told(self):
        for arguments, says in {("--runs", "0"): "'0'", ("--runs", "1.5"): "'1.5'", ("--runs", "1001"): "'1001'",
                                ("--sizes", "1K", "--sizes", "2K"): "once", ("--form", "a"): "unknown option"}.items():
            outcome = self.run_tool("bench", *arguments, expect=2)
            for words in ("trismooth: error: ", arguments[0], says):
                self.assertIn(words, outcome.err)
            self.assertEqual((len(outcome.err.splitlines()), outcome.out), (1, ""))


class SameBits(BenchTest):

    def hashes(self, report):
        """{(size, form): of every row but unordered ones}"""
        found = {}
        for row in report["rows"]:
            if row["measured"] and row["order"] == "colour":
                self.assertIs(row["measured"]["same_bits_in_every_run"], True)
                found.setdefault((row["size"], row["form"]), set()).add(row["measured"]["coordinates_hash"])
        return found

    def test_the_hashes_are_those_of_generate_and_smooth(self):
        seen = set()
        for seed, precision in itertools.product((1, 7), ("single", "double")):
            report = self.bench_report("--sizes", "200,1K", "--runs", "1", "--seed", seed, "--precision", precision)
            hashes = self.hashes(report)
            self.assertEqual({*hashes}, {(size, form) for size in (200, 1000) for form in "ab"})
            for (size, form), found in hashes.items():
                with self.subTest(size=size, form=form, seed=seed, precision=precision):
                    self.run_tool("generate", "mesh.vtu", "--vertices", size, "--seed", seed)
                    smoothed = self.report("smooth", "mesh.vtu", "out.vtu", "--backend", "cpu", "--form", form,
                                           "--precision", precision)
                    self.assertEqual(found, {smoothed["coordinates_hash"]})
            seen |= {hash_text for found in hashes.values() for hash_text in found}
        # No two of sizes, forms, seeds and precisions give the same.
        self.assertEqual(len(seen), 16)

    def test_a_seed_gives_the_same_bits_again_with_any_number_of_threads(self):
        arguments = ("--sizes", "1K", "--runs", "2", "--seed", "3", "--threads")
        one, other = (self.hashes(self.bench_report(*arguments, threads)) for threads in (1, 3))
        self.assertEqual(one, other)


class Interrupted(BenchTest):

    def start_on_terminal(self, *arguments):
        """The program with a terminal for its standard error; and the terminal's other end."""
        end, terminal = pty.openpty()
        process = subprocess.Popen([tool.program, "bench", *arguments], cwd=self.folder, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=terminal)
        os.close(terminal)
        self.addCleanup(os.close, end)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process, end

    @staticmethod
    def shown(end, until=None):
        """What the terminal gets until this is in it, or to the end."""
        text = b""
        while until is None or until not in text:
            try:
                more = os.read(end, 4096)
            except OSError:  # Linux says so where the program has closed it
                break
            if not more:
                break
            text += more
        return text

    def test_an_interrupt_ends_it_at_once_and_leaves_no_file(self):
        for moment, number in itertools.product((b"1M: generating", b"1M: serial CPU, Form A"),
                                                (signal.SIGINT, signal.SIGTERM)):
            with self.subTest(moment, number=number.name):
                self.write("old.html", "precious")
                process, end = self.start_on_terminal("--sizes", "1M", "--report", "new.json", "--report", "old.html")
                self.assertIn(moment, self.shown(end, moment))
                self.assertIsNone(process.poll())
                process.send_signal(number)
                # The whole run would take minutes.
                self.assertEqual(process.wait(timeout=30), CANCELLED)
                self.assertTrue(self.shown(end).endswith(b"\r\x1b[Ktrismooth: error: cancelled\r\n"))
                self.assertEqual(self.read("old.html"), b"precious")
                self.assertEqual(os.listdir(self.folder), ["old.html"])


if __name__ == "__main__":
    tool.main()
