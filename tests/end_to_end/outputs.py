# SPDX-License-Identifier: BSD-3-Clause
"""Targets that are no ordinary file, or do not stay one; and standard streams that are closed, full or gone."""

import itertools
import json
import os
import resource
import subprocess

import sample_meshes
import tool

DONE, WRONG_USAGE, BAD_INPUT, NOT_WRITTEN = 0, 2, 3, 4
FORMATS = ("off", "obj", "ply", "stl", "vtk", "vtu", "vtp")


class OutputsTest(tool.ToolTest):

    def setUp(self):
        super().setUp()
        self.write("plate.off", sample_meshes.off(sample_meshes.Grid(16)))
        self.write("plate.vtu", sample_meshes.vtu(sample_meshes.Grid(16)))

    def start(self, *arguments, limits=None, **streams):
        """The program as a shell starts it: with every signal as it is by default."""
        def prepare():
            for kind, count in (limits or {}).items():
                resource.setrlimit(kind, (count, count))
        return subprocess.Popen([tool.program, *map(str, arguments)], cwd=self.folder, preexec_fn=prepare,
                                **{"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE,
                                   "text": True, **streams})

    def end(self, process):
        out, err = process.communicate(timeout=120)
        return tool.Outcome(process.returncode, out, err)

    def assert_told(self, outcome, target, reason):
        self.assertEqual(outcome.code, NOT_WRITTEN, outcome)
        self.assertRegex(outcome.err, f"(^|\n)trismooth: error: {target}: [^\n]*{reason}[^\n]*\n$")
        self.assert_no_temporary_files()

    def commands(self, name="out", bench=False):
        """(target, arguments) of everything that the program writes."""
        for extension in FORMATS:
            source = "plate.vtu" if extension in ("vtu", "vtk", "ply") else "plate.off"
            yield f"{name}.{extension}", ("smooth", source, f"{name}.{extension}", "--quiet")
            yield f"{name}.{extension}", ("generate", f"{name}.{extension}", "--vertices", "300")
        for extension in ("json", "html"):
            yield f"{name}.{extension}", ("quality", "plate.off", "--report", f"{name}.{extension}")
        for extension in ("json", "html", "csv") if bench else ():
            yield f"{name}.{extension}", ("bench", "--sizes", "100", "--runs", "1", "--versions", "cpu", "--report",
                                          f"{name}.{extension}")


class Refusals(OutputsTest):

    def test_a_file_size_limit_is_an_error_not_the_end_of_the_program(self):
        self.skip_if_instrumented()
        for target, arguments in self.commands(bench=True):
            with self.subTest(arguments):
                self.write(target, "precious")
                outcome = self.end(self.start(*arguments, limits={resource.RLIMIT_FSIZE: 200, resource.RLIMIT_CORE: 0}))
                self.assert_told(outcome, target, "File too large")
                self.assertEqual(self.read(target), b"precious")

    def test_a_device_that_takes_no_bytes(self):
        for target, arguments in self.commands("full", bench=True):
            with self.subTest(arguments):
                if not os.path.lexists(self.path(target)):
                    os.symlink("/dev/full", self.path(target))
                self.assert_told(self.end(self.start(*arguments)), target, "No space left on device")
                self.assertTrue(os.path.islink(self.path(target)))

    def test_a_folder_in_the_place_of_the_file(self):
        for target, arguments in self.commands("folder", bench=True):
            with self.subTest(arguments):
                os.makedirs(self.path(target), exist_ok=True)
                self.assert_told(self.end(self.start(*arguments)), target, "is a folder")
                self.assertEqual(os.listdir(self.path(target)), [])

    def test_a_report_must_not_be_a_file_of_the_run_under_another_name(self):
        self.write("ids.txt", "0 1\n")
        self.write("out.off", "precious")
        for other in ("plate.off", "out.off", "ids.txt"):
            for link in (os.symlink, os.link):
                with self.subTest(other, link=link.__name__):
                    before = self.read(other)
                    link(self.path(other), self.path("report.json"))
                    outcome = self.run_tool("smooth", "plate.off", "out.off", "--fixed-ids", "ids.txt", "--report",
                                            "report.json", expect=WRONG_USAGE)
                    self.assertRegex(outcome.err, f"^trismooth: error: --report report.json: .*same file as {other}\n$")
                    self.assertEqual(self.read(other), before)
                    os.remove(self.path("report.json"))

    def test_a_report_is_given_once(self):
        outcome = self.run_tool("smooth", "plate.off", "out.off", "--report", "a.json", "--report", "./a.json",
                                expect=WRONG_USAGE)
        self.assertIn("--report ./a.json: is given twice", outcome.err)
        self.assertFalse(os.path.exists(self.path("out.off")))

    def test_options_for_ranks_without_ranks_are_told(self):
        said = self.run_tool("smooth", "plate.off", "out.off", "--single", "--gather").err
        self.assertIn("warning: --single, --gather has no effect", said)

    def test_few_files_may_be_open(self):
        self.skip_if_instrumented()
        self.run_tool("smooth", "plate.vtu", "whole.vtu", "--threads", "1")
        codes = set()
        for files in range(3, 12):
            with self.subTest(files):
                self.write("out.vtu", "precious")
                process = self.start("smooth", "plate.vtu", "out.vtu", "--threads", "1", "--report", "r.json",
                                     limits={resource.RLIMIT_NOFILE: files})
                outcome = self.end(process)
                if outcome.code == 127:
                    continue  # too few for the libraries
                codes.add(outcome.code)
                self.assertIn(outcome.code, (DONE, BAD_INPUT, NOT_WRITTEN), outcome)
                self.assertEqual(self.read("out.vtu"),
                                 self.read("whole.vtu") if outcome.code == DONE else b"precious")
                if outcome.code != DONE:
                    self.assertRegex(outcome.err, r"^trismooth: error: (plate|out)\.vtu: .*Too many open files\n$")
                self.assert_no_temporary_files()
        self.assertIn(DONE, codes)

    def test_a_small_stack_does(self):
        self.run_tool("smooth", "plate.vtu", "whole.vtu")
        for kibibytes in (192, 256, 512):
            outcome = self.end(self.start("smooth", "plate.vtu", "out.vtu", "--report", "r.html",
                                          limits={resource.RLIMIT_STACK: kibibytes << 10}))
            self.assertEqual(outcome.code, DONE, outcome)
            self.assertEqual(self.read("out.vtu"), self.read("whole.vtu"))


class Changes(OutputsTest):
    """What happens to the target while the program is at work: it waits for its input, a pipe."""

    def after(self, change, *arguments):
        os.mkfifo(self.path("pipe.off"))
        process = self.start(*arguments)
        with open(self.path("pipe.off"), "wb") as pipe:  # opens when the program has come to read it
            change()
            pipe.write(self.read("plate.off"))
        outcome = self.end(process)
        os.remove(self.path("pipe.off"))
        return outcome

    def test_the_folder_of_a_report_vanishes_and_no_mesh_is_there(self):
        os.mkdir(self.path("folder"))
        outcome = self.after(lambda: os.rmdir(self.path("folder")), "smooth", "pipe.off", "out.off", "--report",
                             "folder/r.json")
        self.assert_told(outcome, "folder/r.json", "No such file or directory")
        self.assertFalse(os.path.exists(self.path("out.off")))

    def test_somebody_else_writes_the_target_and_the_last_one_wins(self):
        outcome = self.after(lambda: self.write("out.off", "of somebody else"), "smooth", "pipe.off", "out.off")
        self.assertEqual(outcome.code, DONE, outcome)
        self.run_tool("smooth", "plate.off", "whole.off")
        self.assertEqual(self.read("out.off"), self.read("whole.off"))


class Names(OutputsTest):

    def test_input_and_output_are_one_file_under_two_names(self):
        self.run_tool("smooth", "plate.off", "whole.off")
        before = self.read("plate.off")
        for link in (os.symlink, os.link):
            for source, target in (("plate.off", "name.off"), ("name.off", "plate.off"), ("name.off", "name.off")):
                with self.subTest(link.__name__, source=source, target=target):
                    self.write("plate.off", before)
                    link(self.path("plate.off"), self.path("name.off"))
                    self.run_tool("smooth", source, target)
                    self.assertEqual(self.read(target), self.read("whole.off"))
                    if link is os.symlink:
                        self.assertTrue(os.path.islink(self.path("name.off")))
                    os.remove(self.path("name.off"))
        self.assert_no_temporary_files()

    def test_another_name_of_the_old_file_keeps_that_and_a_link_or_name_that_cannot_be_is_told(self):
        self.write("one.off", "precious")
        os.link(self.path("one.off"), self.path("other.off"))
        self.run_tool("smooth", "plate.off", "one.off")
        self.assertNotEqual(self.read("one.off"), b"precious")
        self.assertEqual(self.read("other.off"), b"precious")
        os.symlink("nowhere/new.off", self.path("link.off"))
        for target, reason in (("link.off", "No such file or directory"), ("x" * 252 + ".off", "File name too long")):
            self.assert_told(self.run_tool("smooth", "plate.off", target, expect=NOT_WRITTEN), target, reason)


class Pipes(OutputsTest):

    def read_pipe(self, target, most=None):
        """Everything that comes through the pipe; with `most`, some bytes, after which the reader goes away."""
        with open(self.path(target), "rb", buffering=0) as pipe:
            if most is not None:
                return pipe.read(most)
            return b"".join(iter(lambda: pipe.read(1 << 16), b""))

    def test_a_pipe_gets_the_bytes_of_a_file(self):
        for target, arguments in self.commands("pipe"):
            if not target.endswith(("json", "html")):
                with self.subTest(arguments):
                    whole = [argument.replace("pipe.", "whole.") for argument in arguments]
                    self.run_tool(*whole)
                    if not os.path.exists(self.path(target)):
                        os.mkfifo(self.path(target))
                    process = self.start(*arguments)
                    self.assertEqual(self.read_pipe(target), self.read(target.replace("pipe.", "whole.")))
                    self.assertEqual(self.end(process).code, DONE)

    def test_a_reader_that_goes_away_is_an_error_not_the_end_of_the_program(self):
        self.run_tool("generate", "large.vtu", "--vertices", "4000")  # more than a pipe holds
        self.run_tool("generate", "large.off", "--vertices", "4000")
        for extension in FORMATS:
            with self.subTest(extension):
                target = f"pipe.{extension}"
                os.mkfifo(self.path(target))
                source = "large.vtu" if extension == "vtu" else "large.off"
                process = self.start("smooth", source, target, "--quiet")
                self.read_pipe(target, most=100)
                self.assert_told(self.end(process), target, "Broken pipe")


class StandardStreams(OutputsTest):

    def setUp(self):
        super().setUp()
        self.run_tool("smooth", "plate.vtu", "whole.vtu")

    def assert_whole(self):
        self.assertEqual(self.read("out.vtu"), self.read("whole.vtu"))
        self.assert_no_temporary_files()
        os.remove(self.path("out.vtu"))

    def test_a_standard_output_that_takes_nothing(self):
        with open("/dev/full", "wb") as full:
            for arguments in (("smooth", "plate.vtu", "out.vtu", "--require", "min_shape>2"), ("--help",), ("info",),
                              ("bench", "--sizes", "100", "--runs", "1", "--versions", "cpu")):
                with self.subTest(arguments):
                    self.assert_told(self.end(self.start(*arguments, stdout=full)), "standard output",
                                     "No space left on device")
                    self.assertFalse(os.path.exists(self.path("out.vtu")))
            outcome = self.end(self.start("smooth", "plate.vtu", "out.vtu", "--quiet", stdout=full))
            self.assertEqual((outcome.code, outcome.err), (DONE, ""))
            self.assert_whole()

    def test_a_reader_of_the_standard_output_that_goes_away(self):
        # It has gone before the program begins, or a quick program would be done before that.
        reader, writer = os.pipe()
        os.close(reader)
        process = self.start("smooth", "plate.vtu", "out.vtu", "--report", "r.json", stdout=writer)
        os.close(writer)
        error = process.stderr.read()
        process.stderr.close()
        # As with any program in front of `head`: ended by the signal, without a word, its files whole.
        self.assertEqual(process.wait(timeout=120), -13)
        self.assertEqual(error, "")
        self.assert_whole()
        json.loads(self.read("r.json"))

    def test_messages_do_not_go_into_files_where_standard_streams_are_closed(self):
        for closed in itertools.chain.from_iterable(itertools.combinations((0, 1, 2), n) for n in (1, 2, 3)):
            for arguments in (("--verbose", "--report", "r.json"), ("--quiet",)):
                with self.subTest(closed, arguments=arguments):
                    redirections = " ".join(f"{stream}>&-" for stream in closed)
                    done = subprocess.run(["sh", "-c", f'exec "$@" {redirections}', "sh", tool.program, "smooth",
                                           "plate.vtu", "out.vtu", *arguments], cwd=self.folder, timeout=120,
                                          check=False, capture_output=True, text=True)
                    lost = 1 in closed and "--verbose" in arguments
                    self.assertEqual(done.returncode, NOT_WRITTEN if lost else DONE, done)
                    if lost and 2 not in closed:
                        self.assertRegex(done.stderr, "trismooth: error: standard output: .*Bad file descriptor; so "
                                                      "out.vtu is not written either\n$")
                    if lost:
                        self.assertFalse(os.path.exists(self.path("out.vtu")))
                        self.assert_no_temporary_files()
                    else:
                        self.assert_whole()

    def test_an_error_is_told_by_the_exit_code_where_messages_cannot_be(self):
        for stream in ("2>&-", "2>/dev/full"):
            done = subprocess.run(["sh", "-c", f'exec "$@" {stream}', "sh", tool.program, "smooth", "plate.vtu",
                                   "no/out.vtu"], cwd=self.folder, check=False, timeout=120)
            self.assertEqual(done.returncode, NOT_WRITTEN)


if __name__ == "__main__":
    tool.main()
