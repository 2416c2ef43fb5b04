# SPDX-License-Identifier: BSD-3-Clause
"""Runs the program under test in a scratch folder of its own."""

import json
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

program = None  # the executable, set by main()
# Tests that try the same at many moments, or with many amounts, try several times as many.
thorough = bool(os.environ.get("TRISMOOTH_THOROUGH"))


class Outcome:
    """What one run gave: `code`, `out` and `err`."""

    def __init__(self, code, out, err):
        self.code = code
        self.out = out
        self.err = err

    def __str__(self):
        return f"exit code {self.code}\nstdout: {self.out}\nstderr: {self.err}"


def limit(resources):
    """In the child, before it starts: {resource.RLIMIT_...: count}."""
    for kind, count in resources.items():
        resource.setrlimit(kind, (count, count))
    # Writing beyond RLIMIT_FSIZE is to fail like writing to a full disk, not to end the program.
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)


class ToolTest(unittest.TestCase):
    """A test with an empty folder, `self.folder`, in which the program runs."""

    maxDiff = 2000

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="trismooth-")
        self.addCleanup(shutil.rmtree, self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, content):
        """Writes bytes or text to a file of the folder; returns its path."""
        path = self.path(name)
        with open(path, "wb") as file:
            file.write(content if isinstance(content, bytes) else content.encode())
        return path

    def read(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def run_tool(self, *arguments, expect=0, timeout=120, limits=None, environment=None):
        """Runs the program; its exit code must be `expect` unless that is None. For `limits` see limit()."""
        done = subprocess.run([program, *map(str, arguments)], cwd=self.folder, timeout=timeout, check=False,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              preexec_fn=(lambda: limit(limits)) if limits else None,
                              env={**os.environ, **(environment or {})})
        outcome = Outcome(done.returncode, done.stdout.decode(errors="replace"), done.stderr.decode(errors="replace"))
        if expect is not None:
            self.assertEqual(outcome.code, expect, f"trismooth {' '.join(map(str, arguments))}\n{outcome}")
        return outcome

    def methods(self):
        """The names of all methods, as the program lists them."""
        return re.search(r"valid are ([^;\n]*)", self.run_tool("smooth", "a", "b", "--method", "", expect=2).err)[1].split(", ")

    def report(self, *arguments, **options):
        """Runs the program quietly with a JSON report; returns that report."""
        self.run_tool(*arguments, "--quiet", "--report", "report.json", **options)
        return json.loads(self.read("report.json"))

    def skip_if_instrumented(self):
        """Where the program brings a sanitizer along: that needs files, addresses and the tracer's place for itself."""
        with open(program, "rb") as file:
            content = file.read()
        if b"__asan_init" in content or b"__tsan_init" in content:
            self.skipTest("the program is instrumented")

    def assert_no_temporary_files(self):
        """The program's temporary files are hidden ones; no test makes any."""
        self.assertEqual([name for name in os.listdir(self.folder) if name.startswith(".")], [])


def main():
    """The first argument names the program; the others are unittest's."""
    global program
    if len(sys.argv) < 2:
        sys.exit(f"usage: {sys.argv[0]} PROGRAM [unittest's arguments]")
    program = os.path.abspath(sys.argv.pop(1))
    # Test modules import this file under its own name; there the value has to be known.
    sys.modules["tool"].program = program
    unittest.main(module="__main__")
