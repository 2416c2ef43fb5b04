#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs what the documentation shows, and holds what it says to the program and the source tree.

    run_commands.py PROGRAM COMPILER BUILD_INCLUDE [--system-include FOLDER]... [--without PART]...

In README.md and docs/*.md:
- blocks of `sh` are run as they are, in a folder of their own that has examples/; they must end with 0;
- blocks of `console` are run command by command (lines that begin with `$ `), and must print what they show, but for
  times and the number of threads;
- blocks of `cpp` must compile;
- a block whose first line says `no-run: REASON` behind the language is left out;
- links must lead to files and headings, and names of files in backticks and in the picture of the architecture must
  exist;
- every option of the program must be on the page of the command line, and every option named anywhere must be one;
- every method must be in the table of the page of the methods, and every extension of a format on the page of the
  formats.

PART (cuda, halfedge, mesh_io, pipeline) is a part that the build does not have: C++ that includes it is left out.
Python 3 and its standard library suffice.
"""

import argparse
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
LINKED_PAGES = PAGES + [ROOT / name for name in ("CONTRIBUTING.md", "SECURITY.md", "examples/README.md",
                                             "examples/data/README.md")]
COMMANDS = ("smooth", "deform", "quality", "compare", "generate", "bench", "info")
# Options of other programs that the pages name.
FOREIGN_OPTIONS = {"--prefix", "--preset", "--build", "--install", "--target", "--cflags", "--libs", "--check",
                   "--sanitize", "--tests", "--tools", "--package", "--optimesh-python", "--files", "--cuda",
                   "--kill-on-bad-exit", "--bind-to", "--map-by", "--oversubscribe", "--gpus-per-task"}


class Block:
    """A fenced block of a page."""

    def __init__(self, page, line, info, text):
        self.place = f"{page.relative_to(ROOT)}:{line}"
        self.language, _, rest = info.partition(" ")
        self.runs = not rest.startswith("no-run: ")
        self.text = text


def blocks_of(page):
    blocks = []
    lines = page.read_text().split("\n")
    begin = None
    for number, line in enumerate(lines, 1):
        if not line.startswith("```"):
            continue
        if begin is None:
            begin = number
        else:
            blocks.append(Block(page, begin + 1, lines[begin - 1][3:], "\n".join(lines[begin:number - 1]) + "\n"))
            begin = None
    if begin is not None:
        sys.exit(f"{page}:{begin}: the block has no end")
    return blocks


def masked(text):
    """Without what differs from run to run and from machine to machine."""
    text = re.sub(r"\b[0-9.]+ (ms|s)\b", "TIME", text)
    text = re.sub(r"\bwith [0-9]+ threads?\b", "with THREADS", text)
    return "\n".join(line.rstrip() for line in text.rstrip().split("\n"))


def commands_of(console):
    """Pairs of a command and what it prints."""
    pairs = []
    for line in console.rstrip("\n").split("\n"):
        if line.startswith("$ "):
            pairs.append([line[2:], ""])
        elif pairs:
            pairs[-1][1] += line + "\n"
    return pairs


class Runner:
    def __init__(self, program, folder):
        self.folder = pathlib.Path(folder)
        (self.folder / "bin").mkdir()
        (self.folder / "bin/trismooth").symlink_to(pathlib.Path(program).resolve())
        self.environment = dict(os.environ, PATH=f"{self.folder}/bin:{os.environ['PATH']}", COLUMNS="120", LC_ALL="C")

    def run(self, name, script):
        folder = self.folder / name
        folder.mkdir()
        (folder / "examples").symlink_to(ROOT / "examples")
        return subprocess.run(["bash", "-c", script], cwd=folder, env=self.environment, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=60, check=False)

    def check(self, number, block):
        """What is wrong with the block, or nothing."""
        if block.language == "sh":
            done = self.run(str(number), "set -euo pipefail\n" + block.text)
            return "" if done.returncode == 0 else f"exit code {done.returncode}:\n{done.stdout}"
        pairs = commands_of(block.text)
        mark = "---- end of a command ----"
        script = "".join(f"{command}\n{{ rc=$?; echo; echo '{mark}'; (exit $rc); }}\n" for command, _ in pairs)
        outputs = self.run(str(number), script).stdout.split(f"\n{mark}\n")
        for (command, wanted), found in zip(pairs, outputs):
            if masked(found) != masked(wanted):
                return f"$ {command}\nprints\n{found}\nand not\n{wanted}"
        return ""


def run_blocks(program, blocks):
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        runner = Runner(program, folder)
        faults = pool.map(runner.check, range(len(blocks)), blocks)
        return [f"{block.place}: {fault}" for block, fault in zip(blocks, faults) if fault]


def compile_blocks(compiler, includes, blocks):
    def check(block):
        done = subprocess.run([compiler, "-std=c++20", "-ffp-contract=off", "-Wall", "-Wextra", "-Werror", "-fsyntax-only",
                               *includes, "-x", "c++", "-"], input=block.text, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, check=False)
        return "" if done.returncode == 0 else f"{block.place}: does not compile:\n{done.stdout}"

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        return [fault for fault in pool.map(check, blocks) if fault]


def needs(block, part):
    folder = {"halfedge": "mesh_io/halfedge", "mesh_io": "mesh_io/mesh_file"}.get(part, part)
    return f'"trismooth/{folder}' in block.text


def anchors_of(page):
    """The headings of a page as GitHub makes anchors of them."""
    anchors = set()
    fenced = False
    for line in page.read_text().split("\n"):
        fenced ^= line.startswith("```")
        if not fenced and re.match(r"#{1,6} ", line):
            heading = re.sub(r"[^\w\- ]", "", line.lstrip("#").strip().lower())
            anchors.add(heading.replace(" ", "-"))
    return anchors


def check_links(page):
    text = re.sub(r"^```.*?^```", "", page.read_text(), flags=re.DOTALL | re.MULTILINE)
    for target in re.findall(r"\]\(([^()\s]+)\)", text):
        if target.startswith(("http://", "https://")):
            continue
        path, _, anchor = target.partition("#")
        file = (page.parent / path).resolve() if path else page
        if not file.exists():
            yield f"{page.relative_to(ROOT)}: the link to {target} leads nowhere"
        elif anchor and anchor not in anchors_of(file):
            yield f"{page.relative_to(ROOT)}: {file.relative_to(ROOT)} has no heading for #{anchor}"


def missing(name):
    """The files and folders that the name stands for and that are not there; {a,b} stands for both."""
    match = re.match(r"(.*)\{(.*)\}(.*)", name)
    names = [match[1] + middle + match[3] for middle in match[2].split(",")] if match else [name]
    return [one for one in names if "..." not in one and not (ROOT / one).exists()]


def check_paths(page):
    """Names in backticks that begin with a folder of the source tree."""
    folders = "|".join(entry.name for entry in ROOT.iterdir()
                       if entry.is_dir() and re.match("[a-z_]+$", entry.name) and entry.name not in ("build", "out"))
    text = re.sub(r"^```.*?^```", "", page.read_text(), flags=re.DOTALL | re.MULTILINE)
    for name in re.findall(rf"`((?:{folders}|\.ci)/[^`\s]*)`", text):
        for one in missing(name):
            yield f"{page.relative_to(ROOT)}: there is no {one}"


def check_picture(picture):
    """Names of folders and headers in the picture of the architecture."""
    for names in re.findall(r'class="name"[^>]*>([^<]*)<', picture.read_text()):
        for name in re.split(r", (?![^{]*\})", names):
            for one in missing(name):
                yield f"{picture.relative_to(ROOT)}: there is no {one}"


def check_options(program):
    known = set()
    for command in COMMANDS:
        help_text = subprocess.run([program, command, "--help"], stdout=subprocess.PIPE, text=True, check=True).stdout
        known |= set(re.findall(r"(?<![\w-])--[a-z][a-z-]*", help_text))
    known.add("--version")
    page = (ROOT / "docs/command_line.md").read_text()
    for option in sorted(known - {"--help", "--version"}):
        if not re.search(rf"{option}(?![\w-])", page):
            yield f"docs/command_line.md: {option} is missing"
    for page in PAGES:
        text = re.sub(r"^```sh no-run.*?^```", "", page.read_text(), flags=re.DOTALL | re.MULTILINE)
        for option in sorted(set(re.findall(r"(?<![\w-])--[a-z][a-z-]*", text)) - known - FOREIGN_OPTIONS - {"--help"}):
            yield f"{page.relative_to(ROOT)}: trismooth has no option {option}"


def check_methods(program):
    bad = subprocess.run([program, "smooth", "a", "b", "--method", ""], stderr=subprocess.PIPE, text=True, check=False)
    page = (ROOT / "docs/method.md").read_text()
    for method in re.search("valid are ([^;\n]*)", bad.stderr)[1].split(", "):
        if f"| `{method}` |" not in page:
            yield f"docs/method.md: the method {method} is missing"


def check_formats(program):
    info = subprocess.run([program, "info"], stdout=subprocess.PIPE, text=True, check=True).stdout
    page = (ROOT / "docs/formats.md").read_text()
    for extension in sorted(set(re.findall(r"(?<=[(\s])\.[a-z0-9]+(?=[)\s])", info[:info.index(";")]))):
        if f"`{extension}`" not in page:
            yield f"docs/formats.md: {extension} is missing"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("compiler")
    parser.add_argument("include")
    parser.add_argument("--system-include", action="append", default=[])
    parser.add_argument("--without", action="append", default=[])
    arguments = parser.parse_args()

    blocks = [block for page in PAGES for block in blocks_of(page)]
    shell = [block for block in blocks if block.language in ("sh", "console") and block.runs]
    cpp = [block for block in blocks if block.language == "cpp" and block.runs
           and not any(needs(block, part) for part in arguments.without)]
    includes = ["-I", arguments.include]
    for folder in arguments.system_include:
        includes += ["-isystem", folder]

    faults = run_blocks(arguments.program, shell)
    faults += compile_blocks(arguments.compiler, includes, cpp)
    for page in LINKED_PAGES:
        faults += check_links(page)
        faults += check_paths(page)
    faults += check_picture(ROOT / "docs/images/architecture.svg")
    faults += check_options(arguments.program)
    faults += check_methods(arguments.program)
    faults += check_formats(arguments.program)
    for block in blocks:
        if not block.language:
            faults.append(f"{block.place}: the block does not say what language it is in")
    if faults:
        sys.exit("\n\n".join(faults))
    print(f"{len(shell)} blocks of commands run, {len(cpp)} of C++ compiled, {len(LINKED_PAGES)} pages looked through")


if __name__ == "__main__":
    main()
