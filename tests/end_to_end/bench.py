"""`trismooth bench`: its reports agree with each other, with the paper and with `trismooth smooth`."""

import csv
import io
import itertools
import json
import os
import re
import xml.etree.ElementTree as ElementTree

import backends
import bench_tool
import page_parser
import tool

NO_DEVICE = 5

# The paper's tables "Performance of the GPU-version developed in the iteration Form A", "... Form B", and the same of
# the CDP-version: milliseconds of CPU, AoS and SoA, the speedups of AoS and SoA.
SIZES = [1000, 5000, 10000, 50000, 100000]
PAPER = {
    ("gpu", "a"): [(218, 16.0, 18.8, 13.63, 11.60),
                   (1217, 72.2, 86.0, 16.86, 14.15),
                   (2012, 117.6, 138.1, 17.11, 14.57),
                   (14383, 530.5, 618.0, 27.11, 23.27),
                   (33836, 802.8, 932.8, 42.15, 36.27)],
    ("gpu", "b"): [(171, 14.9, 17.7, 11.48, 9.66),
                   (1139, 52.4, 76.6, 21.74, 14.87),
                   (1888, 79.3, 115.0, 23.81, 16.42),
                   (11918, 424.5, 513.1, 28.08, 23.23),
                   (26021, 776.1, 896.3, 33.53, 29.03)],
    ("cdp", "a"): [(218, 14.1, 16.5, 15.46, 13.21),
                   (1217, 59.2, 66.8, 20.56, 18.22),
                   (2012, 96.1, 107.7, 20.94, 18.68),
                   (14383, 477.7, 532.4, 30.11, 27.02),
                   (33836, 755.9, 832.5, 44.76, 40.64)],
    ("cdp", "b"): [(171, 13.5, 15.4, 12.67, 11.10),
                   (1139, 50.0, 58.1, 22.78, 19.60),
                   (1888, 74.8, 82.8, 25.24, 22.80),
                   (11918, 404.4, 424.8, 29.47, 28.06),
                   (26021, 750.2, 801.7, 34.69, 32.46)],
}
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
ON_THE_CPU, ON_A_DEVICE = ("serial", "cpu"), ("gpu", "cdp", "resident")
VERDICTS = {"holds", "holds in part", "does not hold", "cannot be told", "not measured"}
NAMES = {"serial": "serial CPU", "cpu": "optimised CPU", "gpu": "GPU", "cdp": "CDP", "resident": "resident"}


def layouts_of(version):
    """The resident version has one, the CPU's have none to choose."""
    return (None,) if version in ON_THE_CPU else ("aos",) if version == "resident" else ("aos", "soa")


def expected_cases(version):
    """(layout, form, order) of all cases of a version."""
    layouts = layouts_of(version)
    kinds = [("a", "colour"), ("b", "colour")] + [("b", "unordered")] * (version in ("gpu", "cdp"))
    return {(layout, *kind) for layout in layouts for kind in kinds}


def ratio(one, other):
    """How many times `one` is `other`, with the widest bounds that both spreads allow."""
    return {"median": one["median"] / other["median"], "least": one["least"] / other["most"],
            "most": one["most"] / other["least"]}


def all_spreads(part):
    """Every spread in a part of the report."""
    if isinstance(part, list):
        for item in part:
            yield from all_spreads(item)
    elif isinstance(part, dict):
        if {*part} == {"median", "least", "most"}:
            yield part
        else:
            yield from all_spreads(list(part.values()))


class Numbers(bench_tool.BenchTest):

    def setUp(self):
        super().setUp()
        self.outcome = self.bench("--sizes", "200,1K", "--runs", "2", "--report", "bench.json", "--report", "bench.csv",
                                  "--report", "bench.html")
        self.json = json.loads(self.read("bench.json"))
        self.rows = {(row["size"], row["version"], row["layout"], row["form"], row["order"]): row
                     for row in self.json["rows"]}

    def assert_ratio(self, spread, one, other):
        """`spread` is ratio(one, other), or null where one of them is missing."""
        if one is None or other is None:
            self.assertIsNone(spread)
            return
        for key, value in ratio(one, other).items():
            self.assertAlmostEqual(spread[key] / value, 1, places=9)

    def time_of(self, key, *what):
        """The spread of a measurement, or None."""
        row = self.rows[what]
        return row["measured"] and row["measured"][key]

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
                         {"sizes": [200, 1000], "versions": [*NAMES], "precision": "single", "seed": 1, "runs": 2,
                          "seconds": 20, "threads": 0})
        self.assertRegex(self.json["date"], r"^\d{4}-\d\d-\d\d \d\d:\d\d UTC$")
        self.assertRegex(self.json["command"], "^trismooth bench .*--sizes 200,1000 ")
        self.assertIs(self.json["same_bits"], True)
        self.assertEqual([(mesh["size"], mesh["vertices"]) for mesh in self.json["meshes"]], [(200, 200), (1000, 1000)])
        for mesh in self.json["meshes"]:
            # Euler's formula: a square's hull has few of the vertices.
            self.assertLess(1.8 * mesh["vertices"], mesh["triangles"])
            self.assertLess(mesh["triangles"], 2 * mesh["vertices"])

    def test_every_case_has_one_row_a_size_measured_or_with_a_reason(self):
        self.assertEqual(len(self.rows), len(self.json["rows"]))
        self.assertEqual({*self.rows}, {(size, version, *case) for size in (200, 1000) for version in NAMES
                                        for case in expected_cases(version)})
        for row in self.json["rows"]:
            self.assertNotEqual(row["measured"] is None, row["missing_reason"] is None, row)
            if row["version"] in ON_THE_CPU:
                self.assertIsNotNone(row["measured"])

    def test_spreads_and_parts_of_times_fit(self):
        count = 0
        for spread in all_spreads(self.json):
            self.assertLessEqual(spread["least"], spread["median"])
            self.assertLessEqual(spread["median"], spread["most"])
            self.assertGreaterEqual(spread["least"], 0)
            count += 1
        self.assertGreater(count, 50)
        for row in filter(lambda row: row["measured"], self.json["rows"]):
            measured = row["measured"]
            parts = [measured[key] for key in ("topology_ms", "transfer_ms", "smoothing_ms")]
            # A device has a clock of its own.
            rounding = 0.01 * measured["together_ms"]["most"]
            self.assertLessEqual(sum(part["least"] for part in parts), measured["together_ms"]["most"] + rounding)
            self.assertGreaterEqual(sum(part["most"] for part in parts), measured["together_ms"]["least"] - rounding)
            for part in parts:
                self.assertLessEqual(part["median"], measured["together_ms"]["median"] + rounding)
            self.assertGreater(measured["smoothing_ms"]["least"], 0)
            self.assertEqual(measured["runs"], 2)
            self.assertIn(measured["stop_reason"], ("fixed_point", "tolerance", "sweep_limit"))
            self.assertGreaterEqual(measured["vertex_updates"], 1)
            self.assertTrue(0 < measured["free_vertices"] < row["size"])
            if row["version"] in ON_THE_CPU:
                self.assertEqual(measured["transfer_ms"], {"median": 0, "least": 0, "most": 0})
                self.assertEqual(measured["device"], self.json["machine"]["cpu"])
            if row["version"] == "serial":
                self.assertEqual(measured["threads"], 1)
                # Every vertex in every sweep.
                self.assertEqual(measured["vertex_updates"], measured["free_vertices"] * measured["sweeps"]["median"])
            if row["version"] == "cpu":
                self.assertEqual(measured["threads"], self.json["machine"]["threads"])

    def test_speedups_are_those_over_the_serial_version_of_the_same_form(self):
        for (size, version, layout, form, order), row in self.rows.items():
            what = (size, version, layout, form, order)
            for key, time_key in {"speedup": "smoothing_ms", "speedup_together": "together_ms"}.items():
                if version == "serial":
                    self.assertEqual(row[key], {"median": 1, "least": 1, "most": 1})
                    continue
                self.assert_ratio(row[key], self.time_of(time_key, size, "serial", None, form, "colour"),
                                  self.time_of(time_key, *what))

    def test_tables_hold_the_numbers_of_the_rows(self):
        self.assertEqual([table["table"] for table in self.json["tables"]], [1, 2, 3, 4, None, None, None, None])
        self.assertEqual([(table["version"], table["form"], table["order"]) for table in self.json["tables"]],
                         [("gpu", "a", "colour"), ("gpu", "b", "unordered"), ("cdp", "a", "colour"),
                          ("cdp", "b", "unordered"), ("gpu", "b", "colour"), ("cdp", "b", "colour"),
                          ("resident", "a", "colour"), ("resident", "b", "colour")])
        for table in self.json["tables"]:
            what = (table["form"], table["order"])
            self.assertEqual([row["size"] for row in table["rows"]], [200, 1000])
            for row in table["rows"]:
                self.assertEqual(row["serial_ms"],
                                 self.time_of("smoothing_ms", row["size"], "serial", None, table["form"], "colour"))
                for layout in {"aos", "soa"}.difference(layouts_of(table["version"])):
                    self.assertIsNone(row[f"{layout}_ms"])
                    self.assertIsNone(row[f"{layout}_speedup"])
                for layout in layouts_of(table["version"]):
                    case = (row["size"], table["version"], layout, *what)
                    self.assertEqual(row[f"{layout}_ms"], self.time_of("smoothing_ms", *case))
                    self.assertEqual(row[f"{layout}_speedup"], self.rows[case]["speedup"])
            measured = [row["aos_ms"] or row["soa_ms"] for row in table["rows"]]
            self.assertEqual(table["missing_reason"] is None, any(measured))
            self.assertRegex(table["title"], f"(?i)^(Table {table['table']}: )?{NAMES[table['version']]} version, "
                                             f"Form {table['form']}")

    def test_the_csv_holds_the_tables_number_by_number(self):
        lines = list(csv.DictReader(io.StringIO(self.read("bench.csv").decode())))
        flat = [(table, row) for table in self.json["tables"] for row in table["rows"]]
        self.assertEqual(len(lines), len(flat))
        number = lambda text: float(text) if text else None
        for line, (table, row) in zip(lines, flat):
            self.assertNotIn(None, line)  # no more fields than columns
            self.assertEqual(number(line.pop("table")), table["table"])
            for key in ("version", "form", "order"):
                self.assertEqual(line.pop(key), table[key])
            self.assertEqual(int(line.pop("size")), row["size"])
            self.assertEqual(line.pop("precision"), "single")
            for key in COLUMNS:
                spread = row[key] or {"median": None, "least": None, "most": None}
                self.assertEqual(number(line.pop(key)), spread["median"])
                self.assertEqual(number(line.pop(f"{key}_least")), spread["least"])
                self.assertEqual(number(line.pop(f"{key}_most")), spread["most"])
                self.assertEqual(number(line.pop(f"paper_{key}")), (row["paper"] or {}).get(key))
            self.assertEqual(line, {})

    def test_conclusions_follow_from_the_rows(self):
        self.assertEqual([claim["number"] for claim in self.json["conclusions"]], [1, 2, 3, 4])
        for claim in self.json["conclusions"]:
            self.assertIn(claim["verdict"], VERDICTS)
            self.assertEqual(claim["verdict"] == "not measured", not claim["comparisons"])
            self.assertTrue(claim["claim"].endswith("."))
            self.assertNotEqual(claim["findings"], [])
            at_least = 44 if claim["number"] == 1 else 1
            support = []
            for comparison in claim["comparisons"]:
                one, other = (self.rows[comparison["size"], case["version"], case["layout"], case["form"], case["order"]]
                              ["measured"] for case in (comparison["claimed_faster"], comparison["claimed_slower"]))
                factor = comparison["factor"]
                self.assert_ratio(factor, other["smoothing_ms"], one["smoothing_ms"])
                support.append("yes" if factor["least"] > at_least else "no" if factor["most"] < at_least else
                               "within the spread")
                self.assertEqual(comparison["support"], support[-1])
                if comparison["sweeps"]:
                    self.assertEqual(comparison["sweeps"], {"claimed_faster": one["sweeps"],
                                                            "claimed_slower": other["sweeps"]})
            if claim["number"] > 1 and support:
                agree = [answer for answer in support
                         if answer == "yes" or (claim["number"] == 2 and answer == "within the spread")]
                verdict = "holds" if len(agree) == len(support) else "holds in part" if agree else \
                    "does not hold" if "no" in support else "cannot be told"
                self.assertEqual(claim["verdict"], verdict)

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

    def test_the_page_is_well_formed_and_stands_alone(self):
        page = self.read("bench.html").decode()
        parser = page_parser.PageParser()
        parser.feed(page)
        self.assertEqual((parser.mistakes, parser.open, parser.outside), ([], [], []))
        ElementTree.fromstring(page)
        for reference in ("<script", "<link", "<iframe", "@import", "url(", "srcset", "javascript:"):
            self.assertNotIn(reference, page)
        self.assertIsNone(re.search(r"<[^>]*\son\w+=", page))
        pictures = [ElementTree.fromstring(picture) for picture in re.findall(r"<svg.*?</svg>", page, re.DOTALL)]
        self.assertEqual([picture.get("id") for picture in pictures], ["figure-3", "figure-4"])
        for picture in pictures:
            self.assertEqual(picture.tag, "{http://www.w3.org/2000/svg}svg")
            self.assertTrue(picture.get("aria-label"))

    def test_an_experiment_is_the_same_run_of_its_command(self):
        again = self.bench_report(*self.json["command"].split()[2:])
        self.assertEqual(again["command"], self.json["command"])
        self.assertEqual(again["options"], self.json["options"])


class Paper(bench_tool.BenchTest):

    def test_the_default_sizes_and_the_published_numbers_are_the_papers(self):
        report = self.bench_report("--versions", "gpu,cdp", "--backend", "cpu")
        self.assertEqual(report["options"]["sizes"], SIZES)
        self.assertEqual(report["options"]["precision"], "single")
        tables = [table for table in report["tables"] if table["table"]]
        self.assertEqual([table["table"] for table in tables], [1, 2, 3, 4])
        for table, (what, published) in zip(tables, PAPER.items()):
            self.assertEqual((table["version"], table["form"]), what)
            self.assertEqual([row["paper"] for row in table["rows"]],
                             [dict(zip(COLUMNS, numbers)) for numbers in published])
        for table in report["tables"][4:]:
            self.assertEqual({row["paper"] for row in table["rows"]}, {None})


class SameBits(bench_tool.BenchTest):

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


class WithoutADevice(backends.BackendTest):

    HIDDEN = {"CUDA_VISIBLE_DEVICES": ""}
    DEVICE_NAMES = {f"{NAMES[version]}-{layout}" for version in ("gpu", "cdp") for layout in ("AoS", "SoA")} | {"resident"}

    def bench_report(self, *arguments):
        outcome = self.run_tool("bench", "--sizes", "200", "--runs", "1", *arguments, "--report", "bench.json",
                                environment=self.HIDDEN)
        self.assertEqual(outcome.err, "")
        report = json.loads(self.read("bench.json"))
        self.assertIsNone(report["machine"]["gpu"])
        for row in report["rows"]:
            self.assertEqual(row["measured"] is None, row["version"] in ON_A_DEVICE)
        return report

    def assert_told(self, report, reason):
        """Every version that needs a device is named with why it is missing, wherever it would be."""
        for row in report["rows"]:
            if row["version"] in ON_A_DEVICE:
                self.assertRegex(row["missing_reason"], reason)
                self.assertIsNone(row["speedup"])
        for table in report["tables"]:
            self.assertRegex(table["missing_reason"], reason)
            self.assertIsNotNone(table["rows"][0]["serial_ms"])
        remarks = " ".join(report["remarks"])
        self.assertRegex(remarks, reason)
        for name in self.DEVICE_NAMES:
            self.assertIn(name, remarks)
        for claim in report["conclusions"]:
            if claim["number"] != 3:  # the CPU has both forms, too
                self.assertEqual(claim["verdict"], "not measured")
                self.assertRegex(" ".join(claim["findings"]), reason)

    def test_what_needs_a_device_is_missing_with_the_reason(self):
        self.assert_told(self.bench_report(), r"cudaError\w+ \(|no dynamic parallelism" if self.is_built else "no CUDA")

    def test_what_the_user_leaves_out_is_told(self):
        self.require_built()
        self.assert_told(self.bench_report("--backend", "cpu"), "left out by --backend cpu|no dynamic parallelism")

    def test_cuda_that_cannot_be_had_is_an_error_of_its_own(self):
        outcome = self.run_tool("bench", "--backend", "cuda", "--report", "bench.json", expect=NO_DEVICE,
                                environment=self.HIDDEN)
        self.assertRegex(outcome.err, r"^trismooth: error: " + (r"cudaError\w+ " if self.is_built else ".*no CUDA"))
        self.assertIn("--backend auto", outcome.err)
        self.assertEqual(len(outcome.err.splitlines()), 1)
        self.assertEqual(outcome.out, "")
        self.assertFalse(os.path.exists(self.path("bench.json")))


if __name__ == "__main__":
    tool.main()
