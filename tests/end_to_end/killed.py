# SPDX-License-Identifier: BSD-3-Clause
"""Killed or interrupted at any moment: the old output or the whole new one, and who was interrupted is told which."""

import concurrent.futures
import json
import os
import pty
import random
import select
import signal
import subprocess
import tempfile
import threading
import time

import tool

DONE, CANCELLED = 0, 130
# What the program shows on a terminal when a stage begins; the last begins when the line is erased for good.
STAGES = {"read": b"reading", "find neighbours": b"finding neighbours", "check": b"checking the quality",
          "smooth": b"smoothing ...", "check the result": b"checking the result", "write": b"writing",
          "reports": b"\r\x1b[K"}
# So often in each stage.
OFTEN, SELDOM = (100, 10) if tool.thorough else (15, 3)
HITS = {signal.SIGKILL: OFTEN, signal.SIGINT: OFTEN, signal.SIGTERM: SELDOM, signal.SIGHUP: SELDOM}
AT_A_TIME = 2
PRECIOUS = b"precious"


class Run:
    """The program on a terminal of its own."""

    def __init__(self, folder, *arguments):
        self.end, terminal = pty.openpty()
        self.process = subprocess.Popen([tool.program, *arguments], cwd=folder, stdin=subprocess.DEVNULL,
                                        stdout=subprocess.DEVNULL, stderr=terminal)
        os.close(terminal)
        self.text = b""

    def read_some(self, seconds):
        """Reads what the terminal gets in that time at most; false where it is closed."""
        if not select.select([self.end], [], [], max(seconds, 0))[0]:
            return True
        try:
            more = os.read(self.end, 4096)
        except OSError:  # Linux says so where the program has closed it
            return False
        self.text += more
        return bool(more)

    def stage(self):
        """The last that has begun, or none."""
        begun = [name for name, sign in STAGES.items() if name != "reports" and sign in self.text]
        if begun and begun[-1] == "write" and self.text.endswith(STAGES["reports"]):
            return "reports"
        return begun[-1] if begun else None

    def wait_for(self, stage):
        order = list(STAGES)
        deadline = time.monotonic() + 60
        while self.stage() is None or order.index(self.stage()) < order.index(stage):
            if not self.read_some(60) or time.monotonic() > deadline:
                break

    def kill(self, *numbers):
        """Sends the signals, waits for the end."""
        for number in numbers:
            self.process.send_signal(number)
        code = self.process.wait(timeout=60)
        while self.read_some(60):
            pass
        os.close(self.end)
        return code

    def message(self):
        """What stands below the line of the progress, without what erased that."""
        return self.text.split(b"\x1b[K")[-1].decode()


class KilledTest(tool.ToolTest):

    def prepare(self):
        """A folder with an old output and an old report."""
        folder = tempfile.mkdtemp(dir=self.folder)
        for name in ("out.vtu", "report.json"):
            with open(os.path.join(folder, name), "wb") as file:
                file.write(PRECIOUS)
        return folder

    @staticmethod
    def content(folder, name):
        with open(os.path.join(folder, name), "rb") as file:
            return file.read()

    def check(self, folder, run, code, number, whole):
        """What must hold whenever a signal came. Answers whether the run had its way."""
        output, report = self.content(folder, "out.vtu"), self.content(folder, "report.json")
        story = f"{number.name} in {run.stage()}, exit code {code}, terminal: {run.text}"
        self.assertIn(output, (PRECIOUS, whole), story)
        if report != PRECIOUS:
            self.assertIn("timings_ms", json.loads(report), story)
            self.assertEqual(output, whole, story)
        others = sorted(set(os.listdir(folder)) - {"out.vtu", "report.json"})
        if number == signal.SIGKILL and code == -signal.SIGKILL:
            for name in others:
                self.assertRegex(name, fr"^\.(out|report)\.{run.process.pid}-\d+\.(vtu|json)$")
        else:
            self.assertEqual(others, [], story)
            self.assertIn(code, (DONE, CANCELLED), story)
            self.assertEqual(output, whole if code == DONE else PRECIOUS, story)
            self.assertEqual(report == PRECIOUS, code != DONE, story)
            self.assertEqual(run.message(), "" if code == DONE else "trismooth: error: cancelled\r\n", story)


class Smooth(KilledTest):

    # One thread, as two runs go on at a time. The check that nothing gets worse is a part of the stage "smooth".
    ARGUMENTS = ("smooth", "../plate.vtu", "out.vtu", "--threads", "1", "--backend", "cpu", "--report", "report.json")

    def setUp(self):
        super().setUp()
        self.run_tool("generate", "plate.vtu", "--vertices", "4000", "--boundary", "resolved")
        folder = self.prepare()
        self.run_tool("smooth", "plate.vtu", "whole.vtu", "--threads", "1")
        self.whole = self.read("whole.vtu")
        run = Run(folder, *self.ARGUMENTS)
        self.durations = {}
        for stage in STAGES:
            begin = time.monotonic()
            run.wait_for(stage)
            self.durations[stage] = begin
        times = [*self.durations.values(), time.monotonic()]
        self.durations = {stage: end - begin for stage, begin, end in zip(STAGES, times[1:], times[2:] + [times[-1]])}
        self.assertEqual(run.kill(), DONE, run.text)
        self.assertEqual(self.content(folder, "out.vtu"), self.whole)

    def one(self, stage, number, part):
        """One run that gets the signal in that part of the stage, if it is not over by then; where it came."""
        folder = self.prepare()
        run = Run(folder, *self.ARGUMENTS)
        run.wait_for(stage)
        # (What a cancelled run writes at last does not tell whether the last stage had begun.)
        is_in_last = run.stage() == "reports"
        time.sleep(self.durations[stage] * part)
        code = run.kill(number)
        self.check(folder, run, code, number, self.whole)
        return "reports" if is_in_last else run.stage(), code, folder

    def test_the_old_output_or_the_whole_new_one(self):
        chance = random.Random(20)
        hits = {number: dict.fromkeys(STAGES, 0) for number in HITS}
        codes = {number: {} for number in HITS}
        leftovers = [0]
        lock = threading.Lock()

        def hit(stage, number, seed):
            chance = random.Random(seed)
            longest = 1.0
            for _ in range(200):
                with lock:
                    if hits[number][stage] >= HITS[number]:
                        return
                found, code, folder = self.one(stage, number, chance.uniform(0, longest))
                with lock:
                    hits[number][found] += 1
                    codes[number][code] = codes[number].get(code, 0) + 1
                    leftovers[0] += len(os.listdir(folder)) > 2
                    if found == stage:
                        return
                longest /= 2  # a busy machine: closer to the begin of the stage, which is shown

        begin = time.monotonic()
        with concurrent.futures.ThreadPoolExecutor(AT_A_TIME) as pool:
            tasks = [pool.submit(hit, stage, number, chance.random()) for number, count in HITS.items()
                     for stage in STAGES for _ in range(count)]
            for task in tasks:
                task.result()
        print(f"\n{sum(sum(counts.values()) for counts in hits.values())} runs, {time.monotonic() - begin:.1f} s")
        for number, counts in hits.items():
            print(f"{number.name:8}" + ", ".join(f"{stage} {count}" for stage, count in counts.items()) +
                  "; exit codes " + ", ".join(f"{code}: {count}" for code, count in sorted(codes[number].items())))
        print(f"temporary files left by SIGKILL: {leftovers[0]}")
        for number, counts in hits.items():
            for stage, count in counts.items():
                self.assertGreaterEqual(count, HITS[number], f"{number.name} in {stage}")

    def test_what_a_killed_run_left_hinders_nobody(self):
        folder = self.prepare()
        left = []
        for _ in range(200):
            run = Run(folder, *self.ARGUMENTS)
            run.wait_for("write")
            run.kill(signal.SIGKILL)
            left = sorted(set(os.listdir(folder)) - {"out.vtu", "report.json"})
            if left:
                break
        self.assertTrue(left)
        before = {name: self.content(folder, name) for name in left}
        self.run_tool("smooth", "plate.vtu", os.path.join(folder, "out.vtu"), "--report",
                      os.path.join(folder, "report.json"))
        self.assertEqual(self.content(folder, "out.vtu"), self.whole)
        self.assertEqual({name: self.content(folder, name) for name in left}, before)
        self.assertEqual(sorted(os.listdir(folder)), sorted(["out.vtu", "report.json", *left]))

    def test_two_interrupts_in_quick_succession(self):
        chance = random.Random(21)
        for stage in STAGES:
            for numbers in ((signal.SIGINT, signal.SIGINT), (signal.SIGINT, signal.SIGTERM),
                            (signal.SIGHUP, signal.SIGINT, signal.SIGINT)):
                folder = self.prepare()
                run = Run(folder, *self.ARGUMENTS)
                run.wait_for(stage)
                time.sleep(self.durations[stage] * chance.random())
                code = run.kill(*numbers)
                output = self.content(folder, "out.vtu")
                self.assertIn((code, output), ((CANCELLED, PRECIOUS), (CANCELLED, self.whole), (DONE, self.whole)))
                self.assertEqual(sorted(os.listdir(folder)), ["out.vtu", "report.json"])
                self.assertEqual(run.message(), "" if code == DONE else
                                 "trismooth: error: cancelled\r\n" if output == PRECIOUS else
                                 "trismooth: error: cancelled; some of the output is written already\r\n")


class OtherCommands(KilledTest):

    def interrupt_when(self, ready, *arguments, signals=1, stderr=subprocess.PIPE):
        process = subprocess.Popen([tool.program, *arguments], cwd=self.folder, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=stderr, text=True)
        ready(process)
        for _ in range(signals):
            self.assertIsNone(process.poll())
            process.send_signal(signal.SIGINT)
            time.sleep(0.05)
        _, err = process.communicate(timeout=60)
        return tool.Outcome(process.returncode, "", err)

    @staticmethod
    def sleeps_in(process, *calls):
        """Waits until the process sleeps in one of the kernel's functions of these names, if that can be seen."""
        deadline = time.monotonic() + 20
        while time.monotonic() < deadline:
            try:
                with open(f"/proc/{process.pid}/wchan", encoding="ascii") as file:
                    place = file.read()
                with open(f"/proc/{process.pid}/stat", encoding="ascii") as file:
                    state = file.read().rsplit(")", 1)[1].split()[0]
            except OSError:
                return
            if state == "S" and (place in ("", "0") or any(call in place for call in calls)):
                return
            time.sleep(0.01)

    def test_an_interrupt_ends_what_waits_for_a_pipe(self):
        self.run_tool("generate", "plate.off", "--vertices", "4000", "--boundary", "resolved")
        for name in ("pipe.off", "pipe.vtu", "pipe.json"):
            os.mkfifo(self.path(name))
        before = sorted(os.listdir(self.folder))
        waits_for_other_end = lambda process: self.sleeps_in(process, "wait_for_partner", "fifo_open", "pipe")
        cases = {"nobody writes the input": (waits_for_other_end, ("smooth", "pipe.off", "out.off")),
                 "nobody reads the output": (waits_for_other_end, ("smooth", "plate.off", "pipe.off")),
                 "nobody reads the generated mesh": (waits_for_other_end, ("generate", "pipe.vtu", "--vertices", "99")),
                 "nobody reads the report": (waits_for_other_end, ("quality", "plate.off", "--report", "pipe.json"))}
        for name, (ready, arguments) in cases.items():
            with self.subTest(name):
                outcome = self.interrupt_when(ready, *arguments)
                self.assertEqual((outcome.code, outcome.err), (CANCELLED, "trismooth: error: cancelled\n"))
                self.assertEqual(sorted(os.listdir(self.folder)), before)

    def test_an_interrupt_ends_what_waits_for_more_of_a_pipe(self):
        self.run_tool("generate", "plate.off", "--vertices", "4000", "--boundary", "resolved")
        for name in ("in.off", "out.off"):
            os.mkfifo(self.path(name))
        before = sorted(os.listdir(self.folder))
        held = []

        def writes_a_part(process):
            held.append(open(self.path("in.off"), "wb", buffering=0))
            held[-1].write(b"OFF\n4000")
            self.sleeps_in(process, "pipe")

        def reads_a_part(process):
            held.append(open(self.path("out.off"), "rb", buffering=0))
            held[-1].read(10)
            self.sleeps_in(process, "pipe")

        for ready, arguments in ((writes_a_part, ("smooth", "in.off", "new.off")),
                                 (reads_a_part, ("smooth", "plate.off", "out.off"))):
            outcome = self.interrupt_when(ready, *arguments)
            self.assertEqual((outcome.code, outcome.err), (CANCELLED, "trismooth: error: cancelled\n"))
            self.assertEqual(sorted(os.listdir(self.folder)), before)
            held.pop().close()

    def test_an_interrupt_while_the_report_waits_for_a_reader_leaves_no_mesh(self):
        self.run_tool("generate", "plate.off", "--vertices", "400", "--boundary", "resolved")
        os.mkfifo(self.path("pipe.json"))
        outcome = self.interrupt_when(lambda process: self.sleeps_in(process, "wait_for_partner", "fifo_open", "pipe"),
                                      "smooth", "plate.off", "out.off", "--report", "pipe.json")
        self.assertEqual((outcome.code, outcome.err), (CANCELLED, "trismooth: error: cancelled\n"))
        self.assertEqual(sorted(os.listdir(self.folder)), ["pipe.json", "plate.off"])

    def test_an_interrupt_of_generate_leaves_nothing(self):
        outcome = self.interrupt_when(lambda process: time.sleep(0.5), "generate", "out.off", "--vertices", "3000000")
        self.assertEqual((outcome.code, outcome.err), (CANCELLED, "trismooth: error: cancelled\n"))
        self.assertEqual(os.listdir(self.folder), [])

    def test_what_is_ignored_stays_ignored(self):
        self.run_tool("generate", "plate.off", "--vertices", "400", "--boundary", "resolved")
        os.mkfifo(self.path("pipe.off"))
        for number in (signal.SIGINT, signal.SIGHUP, signal.SIGTERM):
            with self.subTest(number.name):
                process = subprocess.Popen(["sh", "-c", f"trap '' {number.name[3:]}; exec \"$@\"", "sh", tool.program,
                                            "smooth", "pipe.off", "out.off"], cwd=self.folder,
                                           stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                           text=True)
                # Asleep in the middle of its work, where an interrupt would end it.
                self.sleeps_in(process, "wait_for_partner", "fifo_open", "pipe")
                process.send_signal(number)
                self.write("pipe.off", self.read("plate.off"))
                _, err = process.communicate(timeout=60)
                self.assertEqual((process.returncode, err), (DONE, ""))


if __name__ == "__main__":
    tool.main()
