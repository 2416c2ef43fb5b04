# SPDX-License-Identifier: BSD-3-Clause
"""Meshes on standard streams, compressed ones, and ones whose name does not say what they are."""

import gzip
import os
import subprocess

import sample_meshes
import tool

DONE, WRONG_USAGE, BAD_INPUT, NOT_WRITTEN = 0, 2, 3, 4


class StreamsTest(tool.ToolTest):

    def setUp(self):
        super().setUp()
        self.grid = sample_meshes.Grid(12)
        self.files = {"off": sample_meshes.off(self.grid), "vtu": sample_meshes.vtu(self.grid, "appended raw")}
        for extension, content in self.files.items():
            self.write(f"plate.{extension}", content)

    def call(self, *arguments, data=b"", **streams):
        """(exit code, bytes of standard output, text of standard error)."""
        done = subprocess.run([tool.program, *arguments], cwd=self.folder, input=None if streams else data,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=120, check=False, **streams)
        return done.returncode, done.stdout, done.stderr.decode()

    def smoothed(self, source, target):
        """The bytes that smoothing one file into another gives."""
        code, _, err = self.call("smooth", source, target, "--quiet")
        self.assertEqual(code, DONE, err)
        return self.read(target)


class Streams(StreamsTest):

    def test_a_mesh_goes_through_the_program_as_from_file_to_file(self):
        for extension in self.files:
            with self.subTest(extension):
                expected = self.smoothed(f"plate.{extension}", f"out.{extension}")
                content = self.read(f"plate.{extension}")
                code, out, err = self.call("smooth", "-", "-", data=content)
                self.assertEqual((code, out), (DONE, expected), err)
                self.assertIn("input:      standard input: ", err)
                self.assertIn("written:    standard output", err)
                code, out, err = self.call("smooth", f"plate.{extension}", "-", "--quiet")
                self.assertEqual((code, out, err), (DONE, expected, ""))
                code, out, err = self.call("smooth", "-", f"other.{extension}", "--quiet", data=gzip.compress(content))
                self.assertEqual((code, out, err), (DONE, b"", ""))
                self.assertEqual(self.read(f"other.{extension}"), expected)

    def test_format_says_what_a_stream_gets_and_what_comes_where_its_content_does_not(self):
        expected = self.smoothed("plate.off", "out.obj")
        code, out, err = self.call("smooth", "-", "-", "--format", "obj", "--quiet", data=self.read("plate.off"))
        self.assertEqual((code, out), (DONE, expected), err)
        code, out, err = self.call("quality", "-", "--format", "obj", data=expected)
        self.assertEqual(code, DONE, err)
        code, out, err = self.call("quality", "-", data=expected)
        self.assertEqual((code, out), (BAD_INPUT, b""))
        self.assertIn("trismooth: error: standard input: the content does not show its format; --format NAME", err)

    def test_a_format_that_nothing_needs_is_wrong_usage(self):
        for arguments in (("smooth", "plate.off", "out.off"), ("quality", "plate.off"),
                          ("generate", "out.off", "--vertices", "9")):
            with self.subTest(arguments):
                code, out, err = self.call(*arguments, "--format", "off")
                self.assertEqual((code, out), (WRONG_USAGE, b""))
                self.assertIn("--format names the format of '-'", err)
        code, _, err = self.call("quality", "-", "--format", "uff")
        self.assertEqual(code, WRONG_USAGE)
        self.assertIn("unknown format 'uff'; valid are off, obj, ", err)

    def test_a_random_mesh_goes_to_standard_output(self):
        code, _, err = self.call("generate", "random.ply", "--vertices", "50")
        self.assertEqual(code, DONE, err)
        code, out, err = self.call("generate", "-", "--vertices", "50", "--format", "ply")
        self.assertEqual((code, out), (DONE, self.read("random.ply")), err)
        code, out, err = self.call("generate", "-", "--vertices", "50")
        self.assertEqual((code, out), (WRONG_USAGE, b""))
        self.assertIn("--format NAME", err)

    def test_output_behind_what_stands_in_the_file_already_destroys_nothing(self):
        self.write("log", "before\n")
        with open(self.path("log"), "ab") as log:
            subprocess.run([tool.program, "smooth", "plate.off", "-", "-q"], cwd=self.folder, stdout=log, check=True)
        self.assertEqual(self.read("log"), b"before\n" + self.smoothed("plate.off", "out.off"))

    def test_streams_that_are_closed_full_or_gone_are_told(self):
        with open("/dev/full", "wb") as full:
            done = subprocess.run([tool.program, "smooth", "plate.off", "-"], cwd=self.folder, stdout=full,
                                  stderr=subprocess.PIPE, check=False)
        self.assertEqual(done.returncode, NOT_WRITTEN)
        self.assertRegex(done.stderr.decode(), "standard output: cannot be written: No space")
        self.assertNotIn("written:    standard output", done.stderr.decode())
        reader, writer = os.pipe()
        os.close(reader)
        done = subprocess.run([tool.program, "smooth", "plate.off", "-", "-q"], cwd=self.folder, stdout=writer,
                              stderr=subprocess.PIPE, check=False)
        os.close(writer)
        self.assertEqual(done.returncode, NOT_WRITTEN)
        self.assertRegex(done.stderr.decode(), "standard output: cannot be written: Broken pipe")
        code, _, err = self.call("quality", "-", preexec_fn=lambda: os.close(0))
        self.assertEqual(code, BAD_INPUT)
        self.assertRegex(err, "standard input: cannot be read: ")

    def test_what_is_wrong_in_a_stream_is_told_with_its_line(self):
        code, _, err = self.call("quality", "-", data=b"OFF\n3 1 0\n0 0 0\n1 0 x\n0 1 0\n3 0 1 2\n")
        self.assertEqual(code, BAD_INPUT)
        self.assertRegex(err, "^trismooth: error: standard input:4: ")


class Compressed(StreamsTest):

    def test_pythons_gzip_and_ours_read_each_other(self):
        for extension, content in self.files.items():
            with self.subTest(extension):
                expected = self.smoothed(f"plate.{extension}", f"out.{extension}")
                self.write(f"plate.{extension}.gz", gzip.compress(self.read(f"plate.{extension}")))
                written = self.smoothed(f"plate.{extension}.gz", f"out.{extension}.gz")
                self.assertEqual(gzip.decompress(written), expected)
                # Again, on one thread, from a file whose name does not say that it is compressed: the same bytes.
                self.write(f"other.{extension}", self.read(f"plate.{extension}.gz"))
                code, _, err = self.call("smooth", f"other.{extension}", "again.off.gz" if extension == "off" else
                                         "again.vtu.gz", "--threads", "1")
                self.assertEqual(code, DONE, err)
                self.assertIn("note: the file is compressed by gzip, which its name does not say", err)
                self.assertEqual(self.read(f"again.{extension}.gz"), written)


class Names(StreamsTest):

    def test_a_file_is_read_as_what_it_is(self):
        self.write("wrong.ply", self.read("plate.off"))
        expected = self.smoothed("plate.off", "out.off")
        code, _, err = self.call("smooth", "wrong.ply", "again.off")
        self.assertEqual(code, DONE)
        self.assertIn("note: the file is OFF by its content, not PLY as its name says: it is read as that", err)
        self.assertEqual(self.read("again.off"), expected)
        self.write("none", self.read("plate.off"))
        code, _, err = self.call("smooth", "none", "none.out", "--format", "off")
        self.assertEqual(code, DONE, err)
        self.assertEqual(self.read("none.out"), expected)


if __name__ == "__main__":
    tool.main()
