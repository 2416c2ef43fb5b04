# SPDX-License-Identifier: BSD-3-Clause
"""Too little memory, and threads that the system refuses: a result or one clear message, no crash and no hang."""

import json
import os
import random
import resource
import subprocess

import tool

DONE, BAD_INPUT, NOT_WRITTEN = 0, 3, 4
FORMATS = ("off", "obj", "ply", "stl", "vtk", "vtu", "vtp") if tool.thorough else ("off", "vtk", "vtu")
KIB = 1024
REASONS = "not enough memory|too large for the memory of this machine|Cannot allocate memory"


class LittleMemoryTest(tool.ToolTest):

    def limited(self, kibibytes, *arguments):
        """The program with so many addresses."""
        return self.run_tool(*arguments, expect=None, timeout=60,
                             limits={resource.RLIMIT_AS: kibibytes * KIB, resource.RLIMIT_CORE: 0})

    lowest = None  # what the libraries take is not ours

    def least(self, low, high, succeeds, step=128):
        """The smallest number, to a step, for which it succeeds, as far as one can tell by halving."""
        while high - low > step:
            middle = (low + high) // 2
            low, high = (low, middle) if succeeds(middle) else (middle, high)
        return high

    def setUp(self):
        super().setUp()
        self.skip_if_instrumented()
        if LittleMemoryTest.lowest is None:
            LittleMemoryTest.lowest = self.least(0, 8 << 20,
                                                 lambda kibibytes: self.limited(kibibytes, "--version").code == DONE)

    def assert_told(self, outcome, kibibytes):
        story = f"{kibibytes} KiB: {outcome}"
        self.assertIn(outcome.code, (DONE, BAD_INPUT, NOT_WRITTEN), story)
        errors = [line for line in outcome.err.splitlines() if not line.startswith("trismooth: note: ")]
        if outcome.code == DONE:
            self.assertEqual(errors, [], story)
        else:
            # One of them, or one for each report.
            self.assertIn(len(errors), (1, 2), story)
            for error in errors:
                self.assertRegex(error, f"^trismooth: error: .*({REASONS})", story)
            self.assertEqual(len(set(errors)), len(errors), story)

    def sweep(self, *arguments, outputs=(), steps=16 if tool.thorough else 5):
        """From what the program needs to start to what is enough. The outputs are as they were or whole; those ending in
        json or html, which hold times, with any content."""
        for name in outputs:
            self.write(name, "precious")
        self.run_tool(*arguments)
        whole = {name: self.read(name) for name in outputs}
        enough = self.least(self.lowest, self.lowest + (1 << 20),
                            lambda kibibytes: self.limited(kibibytes, *arguments).code == DONE, step=1024)
        codes = []
        # What is enough once may not be the next time, where threads are started; a little more is.
        for kibibytes in [self.lowest + (enough - self.lowest) * step // steps for step in range(steps)] + [
                enough, enough + (24 << 10)]:
            for name in outputs:
                self.write(name, "precious")
            outcome = self.limited(kibibytes, *arguments)
            codes.append(outcome.code)
            self.assert_told(outcome, kibibytes)
            for name in outputs:
                content = self.read(name)
                if name.endswith("json") and content != b"precious":
                    json.loads(content)
                elif name.endswith("html"):
                    self.assertTrue(content == b"precious" or content.endswith(b"</html>\n"), kibibytes)
                elif content != b"precious":
                    self.assertEqual(content, whole[name], kibibytes)
                if outcome.code == DONE:
                    self.assertNotEqual(content, b"precious")
            if outcome.code == BAD_INPUT and outputs and "plate." in outcome.err:
                self.assertEqual(self.read(outputs[0]), b"precious")
            self.assert_no_temporary_files()
        return codes


class Sweeps(LittleMemoryTest):

    def test_every_format(self):
        for extension in FORMATS:
            self.run_tool("generate", f"plate.{extension}", "--vertices", "3000", "--boundary", "resolved")
            for threads in (1, 2):
                with self.subTest(extension, threads=threads):
                    reports = ("r.json", "r.html") if threads == 1 else ()
                    more = [word for report in reports for word in ("--report", report)] or ["--precision", "single"]
                    codes = self.sweep("smooth", f"plate.{extension}", f"out.{extension}", "--threads", threads,
                                       "--annotate", *more, outputs=(f"out.{extension}", *reports))
                    self.assertIn(BAD_INPUT, codes)
                    self.assertEqual(codes[-1], DONE)

    def test_other_formats_than_the_one_read(self):
        self.run_tool("generate", "plate.off", "--vertices", "3000", "--boundary", "resolved")
        self.run_tool("generate", "plate.vtu", "--vertices", "3000", "--boundary", "resolved")
        for source, target in (("plate.off", "out.vtu"), ("plate.off", "out.vtk"), ("plate.vtu", "out.ply"),
                               ("plate.vtu", "out.stl"), ("plate.off", "out.vtp")):
            with self.subTest(source, target=target):
                self.sweep("smooth", source, target, "--threads", 1, outputs=(target,))

    def test_other_commands(self):
        self.run_tool("generate", "plate.vtk", "--vertices", "3000", "--boundary", "resolved")
        self.sweep("quality", "plate.vtk", "--report", "r.html", outputs=("r.html",))
        self.sweep("bench", "--sizes", "1K", "--runs", "1", "--versions", "serial,cpu", "--threads", "2", "--report",
                   "r.json", outputs=("r.json",))
        for extension in ("off", "vtu"):
            target = f"out.{extension}"
            self.sweep("generate", target, "--vertices", "3000", outputs=(target,))

    def test_many_threads(self):
        """More memory means more threads, not always more left for the mesh: there is no one amount that is enough."""
        self.run_tool("generate", "plate.vtu", "--vertices", "3000", "--boundary", "resolved")
        self.run_tool("smooth", "plate.vtu", "whole.vtu", "--threads", "1")
        codes = set()
        for mebibytes in range(4, 100, 3):
            self.write("out.vtu", "precious")
            kibibytes = self.lowest + mebibytes * KIB + mebibytes * 37
            outcome = self.limited(kibibytes, "smooth", "plate.vtu", "out.vtu", "--threads", "16")
            codes.add(outcome.code)
            self.assert_told(outcome, kibibytes)
            self.assertEqual(self.read("out.vtu"), self.read("whole.vtu") if outcome.code == DONE else b"precious")
            self.assert_no_temporary_files()
        self.assertEqual(codes, {DONE, BAD_INPUT})

    def test_the_message_names_the_mesh_and_what_to_do(self):
        self.run_tool("generate", "plate.ply", "--vertices", "3000", "--boundary", "resolved")
        enough = self.least(self.lowest, self.lowest + (1 << 20), lambda kibibytes: self.limited(
            kibibytes, "smooth", "plate.ply", "out.ply", "--threads", "1").code == DONE)
        outcome = self.limited(enough - 512, "smooth", "plate.ply", "out.ply", "--threads", "1")
        self.assertEqual(outcome.code, BAD_INPUT)
        self.assertRegex(outcome.err, "^trismooth: error: plate.ply: not enough memory.*--threads 1.*smaller mesh\n$")


class Processes(tool.ToolTest):

    def test_threads_that_are_refused_are_done_without(self):
        if os.geteuid() != 0:
            self.skipTest("only root can become a user without other processes")
        self.skip_if_instrumented()
        # The limit counts all processes of a user, on all of a machine: one that nobody else is, nor another run of this.
        user = random.SystemRandom().randrange(20000, 60000)
        os.chmod(self.folder, 0o777)
        self.run_tool("generate", "plate.vtu", "--vertices", "3000", "--boundary", "resolved")
        self.run_tool("smooth", "plate.vtu", "whole.vtu", "--threads", "1")

        def prepare(processes):
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            resource.setrlimit(resource.RLIMIT_NPROC, (processes, processes))
            os.setgroups([])
            os.setgid(user)
            os.setuid(user)

        try:
            subprocess.run([tool.program, "--version"], preexec_fn=lambda: prepare(1), check=True,
                           stdout=subprocess.DEVNULL)
        except (OSError, subprocess.SubprocessError) as error:
            self.skipTest(f"another user cannot run the program: {error}")
        for processes in (1, 2, 3, 4, 7, 20):
            for threads in ("1", "2", "5", "16", "64"):
                with self.subTest(processes=processes, threads=threads):
                    done = subprocess.run([tool.program, "smooth", "plate.vtu", "out.vtu", "--threads", threads],
                                          cwd=self.folder, preexec_fn=lambda: prepare(processes), check=False,
                                          stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=60)
                    self.assertEqual((done.returncode, done.stderr), (DONE, ""))
                    self.assertEqual(self.read("out.vtu"), self.read("whole.vtu"))
                    os.remove(self.path("out.vtu"))


if __name__ == "__main__":
    tool.main()
