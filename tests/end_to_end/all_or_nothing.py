# SPDX-License-Identifier: BSD-3-Clause
"""The mesh, its reports and the table are all written, or none of them is: old files, the input among them, stay."""

import json
import os
import resource
import subprocess

import sample_meshes
import tool

DONE, NOT_WRITTEN = 0, 4
# A report of many regions is larger than this, the mesh is not.
LARGEST_FILE = {resource.RLIMIT_FSIZE: 5000}


class AllOrNothing(tool.ToolTest):

    def setUp(self):
        super().setUp()
        self.write_files()

    def write_files(self):
        for name in os.listdir(self.folder):
            os.remove(self.path(name))
        self.write("plate.off", sample_meshes.off(sample_meshes.Grid(4)))
        for name in ("out.off", "old.json", "old.html"):
            self.write(name, "precious")

    def content(self):
        return {name: self.read(name) for name in os.listdir(self.folder)}

    def run_into(self, output, *arguments):
        """Runs the program with that file as its standard output."""
        with open(output, "wb") as out:
            done = subprocess.run([tool.program, *arguments], cwd=self.folder, stdin=subprocess.DEVNULL, stdout=out,
                                  stderr=subprocess.PIPE, check=False, timeout=120)
        return tool.Outcome(done.returncode, "", done.stderr.decode())

    def test_one_report_that_cannot_be_written(self):
        for mesh in ("plate.off", "out.off"):
            for reports in (["old.html"], ["old.json", "old.html"], ["old.html", "old.json"],
                            ["new.json", "old.html"]):
                with self.subTest(mesh=mesh, reports=reports):
                    before = self.content()
                    named = [word for report in reports for word in ("--report", report)]
                    outcome = self.run_tool("smooth", "plate.off", mesh, *named, expect=NOT_WRITTEN,
                                            limits=LARGEST_FILE)
                    self.assertIn("trismooth: error: old.html: ", outcome.err)
                    self.assertIn(f"so {mesh} is not written either", outcome.err)
                    self.assertEqual(outcome.out, "")
                    self.assertEqual(self.content(), before)

    def test_a_picture_that_cannot_be_written(self):
        for arguments in (["--picture", "new.svg"], ["--report", "old.json", "--picture", "new.svg"],
                          ["--picture", "new.svg", "--picture", "new.png", "--picture-worst", "4"]):
            with self.subTest(arguments):
                before = self.content()
                outcome = self.run_tool("smooth", "plate.off", "out.off", *arguments, expect=NOT_WRITTEN,
                                        limits={resource.RLIMIT_FSIZE: 2000})
                self.assertIn("trismooth: error: new.svg: ", outcome.err)
                self.assertIn("so out.off is not written either", outcome.err)
                self.assertEqual(self.content(), before)

    def test_every_report_that_cannot_be_written_is_named(self):
        outcome = self.run_tool("quality", "plate.off", "--report", "old.html", "--report", "new.html",
                                expect=NOT_WRITTEN, limits=LARGEST_FILE)
        self.assertEqual([line.split(": ")[2] for line in outcome.err.splitlines()], ["old.html", "new.html"])

    def test_a_standard_output_that_is_full(self):
        if not os.path.exists("/dev/full"):
            self.skipTest("no /dev/full here")
        for arguments in (["smooth", "plate.off", "plate.off"], ["smooth", "plate.off", "out.off"],
                          ["smooth", "plate.off", "out.off", "--report", "old.json", "--report", "new.html"],
                          ["quality", "plate.off", "--report", "old.json"],
                          ["quality", "plate.off", "--annotate", "new.vtk"],
                          ["smooth", "plate.off", "-", "--report", "old.json"],
                          ["generate", "out.off", "--vertices", "20"]):
            with self.subTest(arguments):
                before = self.content()
                outcome = self.run_into("/dev/full", *arguments)
                self.assertEqual(outcome.code, NOT_WRITTEN, outcome)
                self.assertIn("trismooth: error: standard output: cannot be written", outcome.err)
                self.assertEqual(self.content(), before)
                self.assertEqual(self.run_into(self.path("all.txt"), *arguments).code, DONE)
                self.assertNotEqual(self.content(), before)
                self.write_files()

    def test_the_mesh_takes_its_place_last(self):
        """A report cannot take its place where a folder has come there in the meantime."""
        pipes = [self.path("first.json"), self.path("second.json")]
        for path in pipes:
            os.mkfifo(path)
        process = subprocess.Popen([tool.program, "smooth", "plate.off", "out.off", "--report", "old.json", "--report",
                                    "first.json", "--report", "second.json"], cwd=self.folder,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        # The program opens pipes when the mesh is complete aside, one after the other, and waits for a reader.
        with open(pipes[0], "rb") as pipe:
            pipe.read()
        self.assertEqual(self.read("out.off"), b"precious")
        os.remove(self.path("old.json"))
        os.mkdir(self.path("old.json"))
        with open(pipes[1], "rb") as pipe:
            pipe.read()
        _, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, NOT_WRITTEN, err)
        self.assertIn(b"old.json: ", err)
        self.assertEqual(self.read("out.off"), b"precious")
        self.assert_no_temporary_files()


if __name__ == "__main__":
    tool.main()
