#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Puts the committed results of `trismooth bench` into docs/experiments.md, and their figure into
docs/images/bench_speedup.svg.

    docs/make_bench_summary.py            writes them
    docs/make_bench_summary.py --check    changes nothing; fails where they are not what the results say

Python 3 and its standard library suffice.
"""

import json
import pathlib
import re
import sys
import textwrap

ROOT = pathlib.Path(__file__).resolve().parent.parent
RESULTS = ROOT / "benchmarks/results/paper"
PAGE = ROOT / "docs/experiments.md"
PICTURE = ROOT / "docs/images/bench_speedup.svg"
MARKS = ("<!-- written by docs/make_bench_summary.py -->\n", "<!-- end of what docs/make_bench_summary.py writes -->\n")
COLUMNS = (("serial", None), ("cpu", None), ("gpu", "aos"), ("cdp", "aos"), ("resident", "aos"))


def three_digits(value):
    """As the program's own reports write numbers."""
    return f"{value:.{3 if value < 1 else 2 if value < 10 else 1 if value < 100 else 0}f}"


def size_text(vertices):
    return f"{vertices // 1000}K"


def cell(row):
    time = three_digits(row["measured"]["smoothing_ms"]["median"]) + " ms"
    return time if row["version"] == "serial" else f"{time}, {three_digits(row['speedup']['median'])}x"


def table(results, form):
    """Smoothing in one form, AoS, with how many times faster than the serial version that is; the paper's last."""
    threads = results["machine"]["threads"]
    lines = [f"| vertices | serial CPU | optimised CPU, {threads} threads | GPU version | CDP version | resident | "
             "the paper's GPU, CDP |", "|---|---|---|---|---|---|---|"]
    rows = {(row["size"], row["version"], row["layout"]): row for row in results["rows"]
            if row["form"] == form and row["order"] == "colour"}
    paper = {(entry["table"], row["size"]): row["paper"] for entry in results["tables"] for row in entry["rows"]
             if entry["table"]}
    for size in results["options"]["sizes"]:
        cells = [size_text(size)] + [cell(rows[size, version, layout]) for version, layout in COLUMNS]
        cells.append(", ".join(f"{paper[number, size]['aos_speedup']:.1f}x" for number in (1, 3)))
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def claims(results):
    """The paper's claims with what became of them, and with why ratios are not what they were."""
    lines = ""
    for claim in results["conclusions"]:
        findings = claim["findings"][:1]
        findings += [text for text in claim["findings"] if text.startswith("Beside the paper's own times")]
        text = f"{claim['number']}. {claim['claim']} **{claim['verdict'].capitalize()}.** {' '.join(findings)}"
        lines += textwrap.fill(text, 120, subsequent_indent="   ", break_on_hyphens=False) + "\n"
    return lines


def page_with(text):
    whole = PAGE.read_text()
    begin, end = (whole.index(mark) for mark in MARKS)
    return whole[:begin] + MARKS[0] + "\n" + text + "\n" + whole[end:]


def picture():
    """The figure of speedups, as the page has it."""
    page = (RESULTS / "bench.html").read_text()
    return re.search(r'<svg[^>]*id="figure-4".*?</svg>', page, re.DOTALL)[0] + "\n"


def main():
    results = json.loads((RESULTS / "bench.json").read_text())
    shown = (table(results, "a") + f"\n![Speedup over the serial CPU version]({PICTURE.relative_to(PAGE.parent)})\n\n"
             "The paper's claims on this machine:\n\n" + claims(results))
    wanted = {PAGE: page_with(shown), PICTURE: picture()}
    for path, text in wanted.items():
        if sys.argv[1:] == ["--check"]:
            if not path.exists() or path.read_text() != text:
                sys.exit(f"{path.relative_to(ROOT)} is not what the results say; run docs/make_bench_summary.py")
        else:
            path.write_text(text)


if __name__ == "__main__":
    main()
