"""The command line of `trismooth bench`: options, files, the terminal, interrupts."""

import itertools
import os
import pty
import re
import resource
import signal
import subprocess

import bench_tool
import tool

DONE, WRONG_USAGE, NOT_WRITTEN, CANCELLED = 0, 2, 4, 130


class Usage(bench_tool.BenchTest):

    def test_wrong_usage_names_the_option(self):
        for arguments, says in {("--sizes", "3"): "'3'", ("--sizes", "1Q"): "'1Q'", ("--sizes", ""): "''",
                                ("--sizes", "1K,,2K"): "''", ("--sizes", "1K,"): "''", ("--sizes", "K"): "'K'",
                                ("--sizes", "-1K"): "'-1K'", ("--sizes", "999999M"): "'999999M'",
                                ("--sizes", "1K", "--sizes", "2K"): "once",
                                ("--versions", "foo"): "'foo'; valid are serial, cpu, gpu, cdp, resident",
                                ("--versions", "cpu,"): "''", ("--versions", ""): "''",
                                ("--runs", "0"): "'0'", ("--runs", "1.5"): "'1.5'", ("--runs", "1001"): "'1001'",
                                ("--seconds", "0"): "'0'", ("--seconds", "-1"): "'-1'", ("--seconds", "nan"): "'nan'",
                                ("--seconds", "1,5"): "'1,5'", ("--seed", "-1"): "'-1'", ("--threads", "two"): "'two'",
                                ("--precision", "half"): "'half'; valid are double, single",
                                ("--backend", "gpu"): "'gpu'; valid are auto, cpu, cuda",
                                ("--report", "x.txt"): r"'x\.txt'.*\.json, \.csv or \.html",
                                ("--report", ""): "''", ("--form", "a"): "--form"}.items():
            with self.subTest(" ".join(arguments)):
                outcome = self.bench(*arguments, expect=WRONG_USAGE)
                self.assertRegex(outcome.err, f"^trismooth: error: .*{says}")
                self.assertIn(arguments[0], outcome.err)
                self.assertEqual(len(outcome.err.splitlines()), 1)
                self.assertEqual(outcome.out, "")
                self.assertEqual(os.listdir(self.folder), [])

    def test_sizes_are_taken_with_their_unit_each_once_in_their_order(self):
        report = self.bench_report("--sizes", "2k,300,1K,2000,0300,1000", "--versions", "cpu,serial,cpu", "--runs", "1")
        self.assertEqual(report["options"]["sizes"], [2000, 300, 1000])
        self.assertEqual(report["options"]["versions"], ["cpu", "serial"])
        self.assertEqual([mesh["size"] for mesh in report["meshes"]], [2000, 300, 1000])
        self.assertEqual([(row["size"], row["version"]) for row in report["rows"] if row["form"] == "a"],
                         [(size, version) for size in (2000, 300, 1000) for version in ("cpu", "serial")])

    def test_little_time_gives_fewer_runs_and_a_remark(self):
        report = self.bench_report("--sizes", "5K", "--versions", "serial", "--runs", "1000", "--seconds", "0.01")
        for row in report["rows"]:
            self.assertLess(row["measured"]["runs"], 1000)
        self.assertRegex(" ".join(report["remarks"]), "Fewer runs than 1000.*5K serial CPU, Form A")

    def test_help_goes_to_standard_output(self):
        outcome = self.bench("--help")
        self.assertEqual(outcome.err, "")
        for option in ("--sizes", "--precision", "--versions", "--runs", "--seconds", "--seed", "--threads",
                       "--backend", "--report"):
            self.assertIn(option, outcome.out)
        self.assertLessEqual(max(map(len, outcome.out.splitlines())), 80)


class Reports(bench_tool.BenchTest):

    TINY = ("--sizes", "200", "--runs", "1", "--versions", "cpu")

    def test_a_report_that_cannot_be_written_is_told_and_nothing_is_left(self):
        self.write("file", "")
        for target in ("no/folder/x.json", "file/x.csv"):
            with self.subTest(target):
                outcome = self.bench(*self.TINY, "--report", target, expect=NOT_WRITTEN)
                self.assertRegex(outcome.err, f"^trismooth: error: {target}: ")
                self.assertEqual(len(outcome.err.splitlines()), 1)
                self.assertEqual(os.listdir(self.folder), ["file"])

    def test_a_full_disk_leaves_the_old_report(self):
        for extension in ("json", "csv", "html"):
            with self.subTest(extension):
                self.write(f"bench.{extension}", "precious")
                outcome = self.bench(*self.TINY, "--report", f"bench.{extension}", expect=NOT_WRITTEN,
                                     limits={resource.RLIMIT_FSIZE: 100})
                self.assertRegex(outcome.err, fr"^trismooth: error: bench\.{extension}: .*File too large")
                self.assertIn("The paper's claims", outcome.out)  # what was measured is not lost with it
                self.assertEqual(self.read(f"bench.{extension}"), b"precious")
                self.assert_no_temporary_files()

    def test_the_name_decides_on_the_format_and_nothing_else_is_written(self):
        self.bench(*self.TINY)
        self.assertEqual(os.listdir(self.folder), [])
        self.bench(*self.TINY, "--report", "a.HTML", "--report", "a.csv", "--report", "a.json", "--report", "b.json")
        self.assertEqual(sorted(os.listdir(self.folder)), ["a.HTML", "a.csv", "a.json", "b.json"])
        self.assertTrue(self.read("a.HTML").startswith(b"<!DOCTYPE html>"))
        self.assertTrue(self.read("a.csv").startswith(b"table,version,form,order,precision,size,"))
        self.assertEqual(self.read("a.json"), self.read("b.json"))


class Terminal(bench_tool.BenchTest):

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

    def test_a_bar_shows_on_a_terminal_and_is_gone_in_the_end(self):
        # A run takes longer than the tenth of a second from one look of the bar to the next.
        process, end = self.start_on_terminal("--sizes", "100K", "--versions", "serial,cpu", "--runs", "3")
        text = self.shown(end)
        self.assertEqual(process.wait(), DONE)
        self.assertRegex(text, rb"\[#+-*\] \d+ %  100K: \w.*Form [AB], run \d of 3")
        self.assertTrue(text.endswith(b"\r\x1b[K"), text[-200:])
        drawn = [line for line in text.split(b"\r\x1b[K") if line]
        self.assertLess(max(map(len, drawn)), 80)  # a longer one would wrap and leave remains
        parts = [int(re.search(rb"(\d+) %", line)[1]) for line in drawn]
        self.assertEqual(parts, sorted(parts))

    def test_there_is_no_bar_where_there_is_no_terminal(self):
        outcome = self.bench("--sizes", "5K", "--runs", "2")
        self.assertEqual(outcome.err, "")
        for code in ("\r", "\x1b", "[#"):
            self.assertNotIn(code, outcome.out)

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
