# SPDX-License-Identifier: BSD-3-Clause
"""Disks that are full, or become so on the way (a file system counts by pages): the old file stays, nothing else is left, and the message says why."""

import os
import re
import shutil
import subprocess

import private_mounts
import sample_meshes
import tool

DONE, NOT_WRITTEN = 0, 4
FORMATS = ("off", "vtu")
PAGE = 4096


class Disk:
    """A file system in memory, mounted on `folder`, whose free space can be set to the page."""

    def __init__(self, folder, pages=4096, inodes=1000):
        self.folder = folder
        self.filler = os.path.join(folder, "filler")
        os.makedirs(folder)
        private_mounts.mount("-t", "tmpfs", "-o", f"size={pages * PAGE},nr_inodes={inodes},mode=0777", "tmpfs", folder)

    def close(self):
        private_mounts.unmount(self.folder)

    def free_pages(self):
        return os.statvfs(self.folder).f_bfree

    def leave(self, pages):
        """So much is free from now on."""
        with open(self.filler, "w", encoding="ascii") as file:
            file.truncate(0)
            more = self.free_pages() - pages
            if more > 0:
                os.posix_fallocate(file.fileno(), 0, more * PAGE)
        assert self.free_pages() == pages

    def names(self):
        return sorted(set(os.listdir(self.folder)) - {"filler"})


def steps(count, most):
    """0 to count - 1; some of them where they are many, the first and the last always."""
    if count <= most:
        return range(count)
    ends = most // 3
    middle = [ends + (count - 2 * ends) * i // (most - 2 * ends) for i in range(most - 2 * ends)]
    return sorted({*range(ends), *middle, *range(count - ends, count)})


class FullDiskTest(tool.ToolTest):

    def setUp(self):
        super().setUp()
        self.disk = Disk(self.path("disk"))
        self.addCleanup(self.disk.close)

    def assert_told(self, outcome, target, reason="No space left on device"):
        self.assertEqual(outcome.code, NOT_WRITTEN, outcome)
        self.assertRegex(outcome.err, f"^trismooth: error: {re.escape(target)}: [^\n]*{reason}[^\n]*\n$")

    def sweep(self, target, *arguments, old=b"precious", most=7 if tool.thorough else 4, same_bytes=True):
        """Runs the program, which writes `target` on the disk, with every free space that is too little. Where another
        run writes other bytes (times, memory), the last page may be one too many."""
        name = os.path.basename(target)
        self.disk.leave(4000)
        self.run_tool(*arguments)
        whole = self.read(target)
        pages = -(-len(whole) // PAGE)
        os.remove(self.path(target))
        if old is not None:
            self.write(target, old)
        for free in steps(pages if same_bytes else pages - 1, most):
            self.disk.leave(free)
            self.assert_told(self.run_tool(*arguments, expect=None), target)
            self.assertEqual(self.disk.names(), [name] if old is not None else [])
            if old is not None:
                self.assertEqual(self.read(target), old)
        self.disk.leave(pages + 1)
        self.run_tool(*arguments)
        if same_bytes:
            self.assertEqual(self.read(target), whole)
        self.assertEqual(self.disk.names(), [name])
        os.remove(self.path(target))


class Meshes(FullDiskTest):

    def test_the_format_that_was_read(self):
        grid = sample_meshes.Grid(32)
        samples = {"a.off": sample_meshes.off(grid), "binary.ply": sample_meshes.ply(grid, "binary_big_endian"),
                   "binary.vtk": sample_meshes.legacy_vtk(grid, True), "ascii.vtu": sample_meshes.vtu(grid),
                   "raw_zlib.vtu": sample_meshes.vtu(grid, "appended raw", compressed=True)}
        for name, content in samples.items():
            with self.subTest(name):
                self.write(name, content)
                target = "disk/out" + os.path.splitext(name)[1]
                self.sweep(target, "smooth", name, target, old=content)

    def test_files_of_several_blocks(self):
        for extension in ("stl", "vtu"):
            with self.subTest(extension):
                target = f"disk/out.{extension}"
                vertices = 6000 if extension == "stl" else 20000
                self.sweep(target, "generate", target, "--vertices", vertices, most=6)

    def test_the_input_itself(self):
        for name, content in {"plate.off": sample_meshes.off(sample_meshes.Grid(32)),
                              "plate.vtu": sample_meshes.vtu(sample_meshes.Grid(32))}.items():
            with self.subTest(name):
                self.disk.leave(4000)
                self.write(f"disk/{name}", content)
                for free in steps(len(content) // PAGE, 7):
                    self.disk.leave(free)
                    self.assert_told(self.run_tool("smooth", f"disk/{name}", f"disk/{name}", expect=None),
                                     f"disk/{name}")
                    self.assertEqual(self.read(f"disk/{name}"), content)
                    self.assertEqual(self.disk.names(), [name])
                os.remove(self.path(f"disk/{name}"))


class Reports(FullDiskTest):

    def test_reports_of_a_run(self):
        self.write("plate.off", sample_meshes.off(sample_meshes.Grid(8)))
        for extension in ("json", "html"):
            with self.subTest(extension):
                target = f"disk/report.{extension}"
                self.sweep(target, "smooth", "plate.off", "out.off", "--report", target, same_bytes=False)
                self.sweep(target, "quality", "plate.off", "--report", target, same_bytes=False, old=None)

    def test_nothing_is_there_where_one_report_cannot_be(self):
        self.write("plate.off", sample_meshes.off(sample_meshes.Grid(8)))
        self.disk.leave(1)
        outcome = self.run_tool("smooth", "plate.off", "out.off", "--report", "disk/full.html", "--report", "b.json",
                                expect=NOT_WRITTEN)
        self.assert_told(outcome, "disk/full.html")
        self.assertEqual(outcome.out, "")
        self.assertEqual(sorted(os.listdir(self.folder)), ["disk", "plate.off"])
        self.assertEqual(self.disk.names(), [])


class OtherRefusals(FullDiskTest):

    def assert_refused_everywhere(self, reason, user=None):
        """Nothing can be made on the disk, on which there is an old.EXTENSION of each kind."""
        before = self.disk.names()
        for extension in FORMATS:
            for name in (f"old.{extension}", f"new.{extension}"):
                for arguments in (("smooth", "plate.off", f"disk/{name}"),
                                  ("generate", f"disk/{name}", "--vertices", "9")):
                    self.assert_told(self.run_tool(*arguments, expect=None, user=user), f"disk/{name}", reason)
        for name in ("old.json", "new.json", "old.html", "new.html"):
            for arguments in (("smooth", "plate.off", "out.off"), ("quality", "plate.off"),
                              ("bench", "--sizes", "100", "--runs", "1", "--versions", "cpu")):
                outcome = self.run_tool(*arguments, "--report", f"disk/{name}", expect=None, user=user)
                self.assert_told(outcome, f"disk/{name}", reason)
        self.assertEqual(self.disk.names(), before)
        for name in before:
            self.assertEqual(self.read(f"disk/{name}"), b"precious")

    def setUp(self):
        super().setUp()
        self.write("plate.off", sample_meshes.off(sample_meshes.Grid(4)))
        for extension in (*FORMATS, "json", "html"):
            self.write(f"disk/old.{extension}", "precious")

    def run_tool(self, *arguments, user=None, **more):
        if user is None:
            return super().run_tool(*arguments, **more)
        done = subprocess.run([tool.program, *arguments], cwd=self.folder, capture_output=True, text=True, check=False,
                              stdin=subprocess.DEVNULL, timeout=120, user=user, group=user, extra_groups=[])
        return tool.Outcome(done.returncode, done.stdout, done.stderr)

    def test_no_inodes(self):
        for number in range(os.statvfs(self.disk.folder).f_ffree):
            self.write(f"disk/{number}.txt", "precious")
        self.assert_refused_everywhere("No space left on device")

    def test_a_file_system_that_is_read_only(self):
        private_mounts.mount("-o", "remount,bind,ro", self.disk.folder)
        self.assert_refused_everywhere("Read-only file system")

    def test_a_folder_of_somebody_else(self):
        nobody = 65534
        os.chmod(self.folder, 0o777)
        os.chmod(self.disk.folder, 0o755)
        try:
            subprocess.run([tool.program, "--version"], check=True, user=nobody, group=nobody, extra_groups=[],
                           stdout=subprocess.DEVNULL)
        except (PermissionError, OSError) as error:
            self.skipTest(f"nobody else can run the program: {error}")
        self.assert_refused_everywhere("Permission denied", user=nobody)
        # One's own file in it can be read, but not replaced.
        shutil.chown(self.path("disk/old.off"), nobody, nobody)
        self.assert_refused_everywhere("Permission denied", user=nobody)

    def test_a_file_of_somebody_else_in_a_folder_for_all(self):
        os.chmod(self.folder, 0o777)
        os.chmod(self.path("disk/old.off"), 0o444)
        try:
            outcome = self.run_tool("smooth", "plate.off", "disk/old.off", user=65534)
        except (PermissionError, OSError) as error:
            self.skipTest(f"nobody else can run the program: {error}")
        self.assert_told(outcome, "disk/old.off", "Permission denied")
        self.assertEqual(self.read("disk/old.off"), b"precious")

    def assert_reports_survive(self, reason, user=None):
        """The mesh cannot take its place, which shows at the last moment: the old reports are there, and no new one."""
        before = {name: self.read(f"disk/{name}") for name in self.disk.names()}
        outcome = self.run_tool("smooth", "plate.off", "disk/old.off", "--report", "disk/old.json", "--report",
                                "disk/new.json", "--report", "disk/old.html", user=user, expect=None)
        self.assert_told(outcome, "disk/old.off", reason)
        self.assertEqual({name: self.read(f"disk/{name}") for name in self.disk.names()}, before)

    def test_reports_of_a_mesh_whose_place_is_a_mount_point(self):
        self.write("disk/other.off", "precious")
        private_mounts.mount("--bind", self.path("disk/other.off"), self.path("disk/old.off"))
        self.addCleanup(private_mounts.unmount, self.path("disk/old.off"))
        self.assert_reports_survive("Device or resource busy")

    def test_reports_of_a_mesh_of_somebody_else_whose_folder_is_sticky(self):
        nobody = 65534
        os.chmod(self.folder, 0o777)
        os.chmod(self.disk.folder, 0o1777)
        os.chmod(self.path("disk/old.off"), 0o666)
        for report in ("disk/old.json", "disk/old.html"):
            shutil.chown(self.path(report), nobody, nobody)
        try:
            self.assert_reports_survive("Operation not permitted", user=nobody)
        except (PermissionError, OSError) as error:
            self.skipTest(f"nobody else can run the program: {error}")


class SystemCalls(tool.ToolTest):
    """What no disk of ours does: system calls made to fail, or looked at, by strace."""

    def setUp(self):
        super().setUp()
        self.skip_if_instrumented()
        try:
            subprocess.run(["strace", "-qq", "-e", "trace=none", "true"], check=True, capture_output=True)
        except (FileNotFoundError, subprocess.CalledProcessError) as error:
            self.skipTest(f"strace does not work here: {error}")
        self.write("plate.off", sample_meshes.off(sample_meshes.Grid(4)))
        self.write("plate.vtu", sample_meshes.vtu(sample_meshes.Grid(4)))

    def traced(self, *options_and_arguments):
        done = subprocess.run(["strace", "-qq", "-o", "trace.txt", *options_and_arguments], cwd=self.folder,
                              check=False, capture_output=True, text=True, timeout=120)
        return tool.Outcome(done.returncode, done.stdout, done.stderr)

    def test_errors_that_come_late_leave_the_old_file(self):
        names = {"ENOSPC": "No space left on device", "EDQUOT": "Disk quota exceeded", "EIO": "Input/output error"}
        for call, errors in {"fsync": ("ENOSPC", "EDQUOT", "EIO"), "/^rename": ("ENOSPC", "EDQUOT"),
                             "/^fchmod": ("EIO",), "write": ("EDQUOT", "EIO")}.items():
            for error in errors:
                for name in ("plate.off", "plate.vtu", "report.html"):
                    # How the bytes go to the disk: each kind of call is counted by itself.
                    failing = "pwrite64" if (call, name) == ("write", "plate.vtu") else call
                    with self.subTest(failing, error=error, name=name):
                        self.write(f"old_{name}", "precious")
                        before = sorted({*os.listdir(self.folder), "trace.txt"})
                        arguments = (("quality", "plate.off", "--report", f"old_{name}") if name == "report.html" else
                                     ("smooth", name, f"old_{name}"))
                        outcome = self.traced("-e", f"trace={failing}", "-e", f"inject={failing}:error={error}:when=1",
                                              tool.program, *arguments)
                        self.assertEqual(outcome.code, NOT_WRITTEN, outcome)
                        self.assertRegex(outcome.err, f"^trismooth: error: old_{name}: [^\n]*{names[error]}\n$")
                        self.assertEqual(self.read(f"old_{name}"), b"precious")
                        self.assertEqual(sorted(os.listdir(self.folder)), before)

    def test_the_file_is_on_the_disk_before_it_gets_its_name_and_the_name_before_the_program_goes_on(self):
        for name in ("plate.off", "plate.vtu"):
            with self.subTest(name):
                target = f"new_{name}"
                outcome = self.traced("-y", "-e", "trace=fsync,/^rename,/^p?write", tool.program, "smooth", name,
                                      target, "--quiet")
                self.assertEqual(outcome.code, DONE, outcome)
                calls = self.read("trace.txt").decode().splitlines()
                written = [i for i, line in enumerate(calls) if re.match(r"p?write", line)]
                flushed, renamed, folder_flushed = calls[written[-1] + 1:]
                self.assertRegex(flushed, fr"^fsync\(\d+<.*/\.new_plate\..*>\) += 0")
                self.assertRegex(renamed, fr'^rename.*"{target}".* = 0')
                self.assertRegex(folder_flushed, fr"^fsync\(\d+<{re.escape(os.path.realpath(self.folder))}>\) += 0")


if __name__ == "__main__":
    private_mounts.enter()
    tool.main()
