# SPDX-License-Identifier: BSD-3-Clause
"""Damaged, odd and hostile files: refused with one clear line and nothing written, or read as what they mean.

Examples, by the program itself: damage anywhere in files of all formats is in tests/bad_input. The folder that the
environment variable TRISMOOTH_EXTRA_BAD_INPUTS names is run as well; its files may be good or bad, but each ends in one
of the two ways.
"""

import os
import random
import resource

import mesh_reader
import planar_geometry
import sample_meshes
import tool

GOOD, REFUSED = 0, 3
ADDRESS_SPACE = 600 << 20
SECONDS = 10


def grid():
    """16 vertices, 18 triangles; 5, 6, 9 and 10 are free."""
    return sample_meshes.Grid(3, seed=5)


def replaced(content, old, new):
    changed = content.replace(old, new, 1)
    if changed == content:
        raise ValueError(f"{old!r} is not in the file")
    return changed


def rejected_files():
    """[(name, content, what the message says)], one or two of a format."""
    ply = sample_meshes.ply(grid(), "ascii")
    stl = sample_meshes.stl(grid(), True)
    raw_vtu = sample_meshes.vtu(grid(), "appended raw", compressed=True)
    return [
        ("garbage.off", b"\x89PNG" + random.Random(7).randbytes(4096), ":1: is not an OFF file"),
        ("not_planar.off", replaced(sample_meshes.off(grid()), b"\n3 3 0\n", b"\n3 3 0.3\n"), "not planar"),
        ("pentagon.off", b"OFF\n5 1 0\n0 0 0\n1 0 0\n2 1 0\n1 2 0\n0 1 0\n5 0 1 2 3 4\n", "1 cell but no triangle"),
        ("moebius.off", ("OFF\n5 5 0\n" + "".join(f"{x} {x * x} 0\n" for x in range(5)) +
                         "".join(f"3 {i} {(i + 1) % 5} {(i + 2) % 5}\n" for i in range(5))).encode(), "orient"),
        ("relative.obj", sample_meshes.obj(grid()) + b"f -1 -2 -17\n", "'-17'"),
        ("huge_count.ply", replaced(ply, b"vertex 16", b"vertex 4000000000"), "4000000000"),
        ("huge_count.stl", stl[:80] + b"\xff\xff\xff\xff" + stl[84:134], "byte 80: .*4294967295"),
        ("huge_cells.vtk", replaced(sample_meshes.legacy_vtk(grid()), b"CELLS 18 72", b"CELLS 4611686018427387904 72"),
         "4611686018427387904"),
        ("cut.vtu", raw_vtu[:len(raw_vtu) // 2], None),
        ("entities.vtu", b'<?xml version="1.0"?><!DOCTYPE a [<!ENTITY a "aaaaaaaaaa">' +
         b"".join(b'<!ENTITY %c "%s">' % (c, b"&%c;" % (c - 1) * 10) for c in range(98, 110)) +
         b"]><VTKFile>&m;</VTKFile>", None),
    ]


class BadInput(tool.ToolTest):

    def setUp(self):
        super().setUp()
        # Builds that watch their memory reserve more address space than any limit here.
        limits = {resource.RLIMIT_AS: ADDRESS_SPACE}
        fits = self.run_tool("--version", expect=None, limits=limits).code == 0
        self.limits = limits if fits else None

    def run_limited(self, *arguments, **options):
        return self.run_tool(*arguments, timeout=SECONDS, limits=self.limits, **options)

    def assert_refused(self, path, place=None):
        """Refuses with one line that names the file; leaves no new output, and the old one as it was."""
        self.write("old.off", "precious")
        for arguments in (("smooth", path, "out" + os.path.splitext(path)[1]), ("smooth", path, "old.off"),
                          ("quality", path)):
            before = sorted(os.listdir(self.folder))
            outcome = self.run_limited(*arguments, expect=REFUSED)
            lines = outcome.err.splitlines()
            self.assertEqual(len(lines), 1, outcome)
            self.assertTrue(lines[0].startswith(f"trismooth: error: {path}:"), lines[0])
            self.assertTrue(lines[0].isprintable(), repr(lines[0]))
            self.assertLess(len(lines[0]), 260 + 2 * len(path))
            if place:
                self.assertRegex(lines[0][len(f"trismooth: error: {path}"):], place)
            self.assertEqual(outcome.out, "")
            self.assertEqual(self.read("old.off"), b"precious")
            self.assertEqual(sorted(os.listdir(self.folder)), before)

    def test_damaged_files_are_refused_with_one_line_and_nothing_is_written(self):
        for name, content, place in rejected_files():
            with self.subTest(name):
                self.write(name, content)
                self.assert_refused(name, place)

    def moved(self, text):
        """The vertices that smoothing an OFF file moves, and its report."""
        self.write("odd.off", text)
        report = self.report("smooth", "odd.off", "out.off")
        before, after = (mesh_reader.read(self.path(name)).points for name in ("odd.off", "out.off"))
        return {v for v, (p, q) in enumerate(zip(before, after)) if p != q}, report

    def test_a_bow_tie_vertex_is_fixed_and_its_fans_are_smoothed(self):
        ring = [(1, 0), (0.5, 0.8), (-0.5, 0.8), (-1, 0), (-0.5, -0.8), (0.5, -0.8)]
        other = [(2.0 - x, y) for x, y in ring[1:]]
        points = [(0.2, 0.1), *ring, (2.2, 0.1), *other]
        left = [(0, 1 + i, 1 + (i + 1) % 6) for i in range(6)]
        right_ring = [1, 8, 9, 10, 11, 12]
        right = [(7, right_ring[(i + 1) % 6], right_ring[i]) for i in range(6)]
        text = f"OFF\n{len(points)} 12 0\n" + "".join(f"{x} {y} 0\n" for x, y in points)
        moved, report = self.moved(text + "".join(f"3 {a} {b} {c}\n" for a, b, c in left + right))
        self.assertEqual(moved, {0, 7})
        self.assertEqual(report["before"]["inverted"], 0)

    def test_a_crack_stays_closed_and_unwelded(self):
        # The row 4 to 7 is there twice: 4 to 7 below, 8 to 11 above the crack.
        whole = grid()
        cracked = grid()
        cracked.points = whole.points[:8] + whole.points[4:8] + whole.points[8:]
        lift = lambda v, above: v + 4 if v > 7 or above else v
        cracked.cells = [(kind, tuple(lift(v, max(cell) > 7) for v in cell)) for kind, cell in whole.cells]
        moved, report = self.moved(sample_meshes.off(cracked))
        self.assertEqual(moved, {13, 14})
        self.assertEqual(report["input"]["vertices"], 20)

    def test_each_of_other_files_is_refused_in_one_line_or_smoothed_without_loss(self):
        folder = os.environ.get("TRISMOOTH_EXTRA_BAD_INPUTS")
        if not folder:
            self.skipTest("TRISMOOTH_EXTRA_BAD_INPUTS names no folder of files")
        for name in sorted(os.listdir(folder)):
            extension = os.path.splitext(name)[1]
            if extension[1:] not in ("off", "vtk", "vtu", "vtp"):
                continue
            with self.subTest(name):
                path, output = os.path.join(folder, name), "out" + extension
                outcome = self.run_limited("smooth", path, output, "--quiet", expect=None)
                self.assertIn(outcome.code, (GOOD, REFUSED))
                if outcome.code == REFUSED:
                    self.assert_refused(path)
                else:
                    before, after = mesh_reader.read(path), mesh_reader.read(self.path(output))
                    self.assertEqual(before.cells, after.cells)
                    moved = {v for v, (p, q) in enumerate(zip(before.points, after.points)) if p != q}
                    self.assertEqual(moved & planar_geometry.fixed_vertices(before), set())
                    os.remove(self.path(output))


if __name__ == "__main__":
    tool.main()
