"""Damaged, odd and hostile files: refused with one clear line and nothing written, or read as what they mean.

The folder that the environment variable TRISMOOTH_EXTRA_BAD_INPUTS names is run as well; its files may be good or bad,
but each ends in one of the two ways.
"""

import os
import random
import resource
import struct

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


def replaced(content, old, new, count=1):
    changed = content.replace(old, new, count)
    if changed == content:
        raise ValueError(f"{old!r} is not in the file")
    return changed


def off_with(line, text):
    """The grid as OFF with one line (from 1) in other words."""
    lines = sample_meshes.off(grid()).decode().split("\n")
    lines[line - 1] = text
    return "\n".join(lines)


def vtk_with(old, new, **spelling):
    return replaced(sample_meshes.legacy_vtk(grid(), **spelling), old, new)


def vtu_with(old, new, **spelling):
    return replaced(sample_meshes.vtu(grid(), **spelling), old, new)


def with_damaged_block(content):
    """Changes a byte in the middle of the first compressed block of appended raw data."""
    begin = content.index(b"_", content.index(b"<AppendedData")) + 60
    return content[:begin] + bytes([content[begin] ^ 0x55]) + content[begin + 1:]


def garbage(count):
    return random.Random(7).randbytes(count)


def rejected_files():
    """[(name, content, what the message says)]: examples; damage anywhere in files of all formats is in tests/bad_input."""
    off = sample_meshes.off(grid())
    lines = off.decode().split("\n")
    ply = sample_meshes.ply(grid(), "ascii")
    binary_ply = sample_meshes.ply(grid(), "binary_little_endian")
    stl = sample_meshes.stl(grid(), True)
    raw_vtu = sample_meshes.vtu(grid(), "appended raw", compressed=True)
    return [
        ("empty.off", "", ":1: .*empty|:1: .*end of the file"),
        ("cut_in_faces.off", "\n".join(lines[:31]) + "\n", ":3[12]: .*18 faces.*13"),
        ("index_out_of_range.off", off_with(20, "3 0 1 16"), ":20: face 2 of 18: .*'16'.*16 vertices"),
        ("word.off", off_with(8, "abc 1 0"), ":8: .*'abc'"),
        ("huge_counts.off", "OFF\n4000000000 8000000000 0\n0 0 0\n3 0 1 2\n", ":2: .*'4000000000'"),
        ("large_counts.off", "OFF\n2000000000 2000000000 0\n0 0 0\n3 0 1 2\n", "2000000000"),
        ("garbage_throughout.off", b"\x89PNG" + garbage(4096), ":1: is not an OFF file"),
        ("zeros.off", bytes(4096), ":1: "),
        ("homogeneous.off", replaced(off, b"OFF", b"4OFF"), ":1: unsupported OFF variant '4OFF'"),
        ("not_planar.off", off_with(8, "1 1 0.3"), "not planar"),
        ("quads_only.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n", "1 cell but no triangle"),
        ("pentagon.off", "OFF\n5 1 0\n2 0 0\n3 1 0\n2 2 0\n0 2 0\n0 0 0\n5 0 1 2 3 4\n", "1 cell but no triangle"),
        ("moebius.off", "OFF\n5 5 0\n" + "".join(f"{x} {x * x} 0\n" for x in range(5)) +
         "".join(f"3 {i} {(i + 1) % 5} {(i + 2) % 5}\n" for i in range(5)), "orient"),
        ("index_relative.obj", sample_meshes.obj(grid()) + b"f -1 -2 -17\n", "'-17'"),
        ("bad_type.ply", replaced(ply, b"property double x", b"property quad x"), ":6: .*'quad'"),
        ("huge_count.ply", replaced(ply, b"vertex 16", b"vertex 4000000000"), "4000000000"),
        ("huge_list.ply", replaced(binary_ply, struct.pack("<B3i", 3, *grid().cells[0][1]),
                                   struct.pack("<B3i", 255, *grid().cells[0][1])), "byte|:"),
        ("huge_count.stl", stl[:80] + struct.pack("<I", 0xFFFFFFFF) + stl[84:134], "byte 80: .*4294967295"),
        ("cell_types_short.vtk", vtk_with(b"CELL_TYPES 18", b"CELL_TYPES 17"), ":.*17 cell types for 18 cells"),
        ("huge_points_binary.vtk", vtk_with(b"POINTS 16", b"POINTS 1600000000", binary=True),
         "declares (16|48)00000000 "),
        ("huge_cells.vtk", vtk_with(b"CELLS 18 72", b"CELLS 4611686018427387904 72"), "4611686018427387904"),
        ("offsets_not_monotone.vtu", vtu_with(b"3 6 9 12 15", b"3 6 9 1200000 15"), "offsets.*1200000"),
        ("huge_count.vtu", vtu_with(b'NumberOfPoints="16"', b'NumberOfPoints="4000000000"'), "4000000000"),
        ("damaged_block.vtu", with_damaged_block(raw_vtu), "damaged|compressed"),
        ("entities.vtu", b'<?xml version="1.0"?><!DOCTYPE a [<!ENTITY a "aaaaaaaaaa">' +
         b"".join(b'<!ENTITY %c "%s">' % (c, b"&%c;" % (c - 1) * 10) for c in range(98, 110)) +
         b"]><VTKFile>&m;</VTKFile>", None),
    ]


class BadInputTest(tool.ToolTest):

    def setUp(self):
        super().setUp()
        # Builds that watch their memory reserve more address space than any limit here.
        limits = {resource.RLIMIT_AS: ADDRESS_SPACE}
        fits = self.run_tool("--version", expect=None, limits=limits).code == 0
        self.limits = limits if fits else None

    def run_limited(self, *arguments, **options):
        return self.run_tool(*arguments, timeout=SECONDS, limits=self.limits, **options)

    def assert_refused(self, path, output, place=None):
        """Refuses with one line that names the file; leaves no output."""
        outcome = self.run_limited("smooth", path, output, expect=REFUSED)
        lines = outcome.err.splitlines()
        self.assertEqual(len(lines), 1, outcome)
        self.assertTrue(lines[0].startswith(f"trismooth: error: {path}:"), lines[0])
        self.assertTrue(lines[0].isprintable(), repr(lines[0]))
        self.assertLess(len(lines[0]), 260 + 2 * len(path))
        if place:
            self.assertRegex(lines[0][len(f"trismooth: error: {path}"):], place)
        self.assertEqual(outcome.out, "")
        self.assertFalse(os.path.exists(self.path(output)))
        self.assert_no_temporary_files()
        return lines[0]


class Refused(BadInputTest):

    def test_damaged_files_are_refused_with_one_line_and_nothing_is_written(self):
        for name, content, place in rejected_files():
            with self.subTest(name):
                self.write(name, content)
                self.assert_refused(name, "out" + os.path.splitext(name)[1], place)

    def test_the_quality_command_refuses_them_too(self):
        for name, content, _ in rejected_files()[::3]:
            with self.subTest(name):
                self.write(name, content)
                outcome = self.run_limited("quality", name, expect=REFUSED)
                self.assertEqual(len(outcome.err.splitlines()), 1, outcome)

    def test_an_old_output_survives_a_bad_input(self):
        for name, content, _ in rejected_files()[::3]:
            with self.subTest(name):
                self.write(name, content)
                self.write("old.off", "precious")
                self.run_limited("smooth", name, "old.off", expect=REFUSED)
                self.assertEqual(self.read("old.off"), b"precious")

    def test_a_file_that_is_cut_off_within_its_data_is_refused(self):
        samples = {"a.off": sample_meshes.off(grid()), "a.ply": sample_meshes.ply(grid(), "binary_big_endian"),
                   "a.vtk": sample_meshes.legacy_vtk(grid(), binary=True), "a.stl": sample_meshes.stl(grid(), True),
                   "a.vtu": sample_meshes.vtu(grid(), "appended raw", compressed=True)}
        for name, content in samples.items():
            with self.subTest(name):
                self.write(name, content[:len(content) // 2])
                self.assert_refused(name, "out" + os.path.splitext(name)[1])


class Accepted(BadInputTest):

    def test_spellings_of_one_mesh_give_the_same_coordinates(self):
        clean = sample_meshes.off(grid())
        self.write("clean.off", clean)
        reference = self.report("smooth", "clean.off", "out.off")
        self.assertEqual(reference["input"]["free_vertices"], 4)
        text = clean.decode()
        vertices = "\n".join(f"  {x:.9E}\t{y:+.9e}\t-0.0e+00 ".replace("+-", "-") for x, y, _ in grid().points)
        colour = lambda i: f" {i} 14 61 255"
        spellings = {
            "crlf.off": sample_meshes.off(grid(), newline="\r\n"),
            "cr.off": sample_meshes.off(grid(), newline="\r"),
            "counts_on_keyword_line.off": sample_meshes.off(grid(), counts_on_keyword_line=True),
            "no_keyword.off": sample_meshes.off(grid(), keyword=""),
            "no_final_newline.off": sample_meshes.off(grid(), final_newline=False),
            "colours.off": sample_meshes.off(grid(), "COFF", colour),
            "normals.off": sample_meshes.off(grid(), "NOFF", lambda i: " 0 0 1"),
            "all_fields.off": sample_meshes.off(grid(), "STCNOFF", lambda i: f" 0 0 1{colour(i)} 0.5 0.25"),
            "face_colours.off": sample_meshes.off(grid(), face_fields=lambda i: " 0.5 0.25 1.0 1.0"),
            "edges.off": replaced(clean, b"16 18 0", b"16 18 33"),
            "comments.off": sample_meshes.off(grid(), comment=True),
            "mark.off": sample_meshes.off(grid(), mark=b"\xef\xbb\xbf"),
            "relative.obj": sample_meshes.obj(grid(), relative=True, textures=True),
            "binary.ply": sample_meshes.ply(grid(), "binary_little_endian", list_name="vertex_index"),
        }
        for name, content in spellings.items():
            with self.subTest(name):
                self.write(name, content)
                # The groups of an OBJ file look like regions, of which the others have none.
                report = self.report("smooth", name, "out" + os.path.splitext(name)[1], "--region-array", "none")
                self.assertEqual(report["coordinates_hash"], reference["coordinates_hash"])
        with self.subTest("exponents"):
            # -0 stays -0 in the file, so only what is printed of x and y can be the same.
            self.write("exponents.off", text.split("\n0 ")[0] + "\n" + vertices + "\n" +
                       "\n".join(text.splitlines()[18:]) + "\n")
            self.run_tool("smooth", "exponents.off", "exponents_out.off")
            flat = lambda name: [p[:2] for p in mesh_reader.read(self.path(name)).points]
            self.assertEqual(flat("exponents_out.off"), flat("out.off"))

    def test_regions_make_an_interface_in_every_format_that_holds_them(self):
        for name, content in {"a.vtk": sample_meshes.legacy_vtk(grid(), binary=True),
                              "b.vtk": sample_meshes.legacy_vtk(grid(), polydata=True),
                              "a.vtu": sample_meshes.vtu(grid(), "binary", compressed=True),
                              "a.vtp": sample_meshes.vtp(grid())}.items():
            with self.subTest(name):
                self.write(name, content)
                report = self.report("smooth", name, "out" + os.path.splitext(name)[1])
                self.assertEqual(report["input"]["regions"], 2)
                self.assertEqual(report["input"]["free_vertices"], 2)


class Policy(BadInputTest):
    """Odd meshes, and what is promised about each."""

    def smooth(self, text, name="odd.off"):
        """Smooths a mesh; returns (report, points before, points after, outcome of the run that printed)."""
        self.write(name, text)
        output = "out" + os.path.splitext(name)[1]
        report = self.report("smooth", name, output)
        points = [mesh_reader.read(self.path(path)).points for path in (name, output)]
        self.assertEqual(len(points[0]), len(points[1]))
        self.assertTrue(all(abs(x) < float("inf") for p in points[1] for x in p))
        return report, *points

    @staticmethod
    def moved(before, after):
        return {v for v, (p, q) in enumerate(zip(before, after)) if p != q}

    def test_ends_of_an_edge_with_three_triangles_are_fixed(self):
        points = [(0, 0), (1, 0.1), (2, 0), (0, 2), (1.1, 1.2), (2, 2.1), (1, -1), (0.9, 0.8)]
        text = "OFF\n8 7 0\n" + "".join(f"{x} {y} 0\n" for x, y in points)
        text += "3 0 1 4\n3 1 2 4\n3 2 5 4\n3 5 3 4\n3 3 0 4\n3 0 1 6\n3 0 1 7\n"
        report, before, after = self.smooth(text)
        self.assertEqual(self.moved(before, after), {4})
        self.assertEqual(report["input"]["free_vertices"], 1)

    def test_a_bow_tie_vertex_is_fixed_and_its_fans_are_smoothed(self):
        ring = [(1, 0), (0.5, 0.8), (-0.5, 0.8), (-1, 0), (-0.5, -0.8), (0.5, -0.8)]
        other = [(2.0 - x, y) for x, y in ring[1:]]
        points = [(0.2, 0.1), *ring, (2.2, 0.1), *other]
        left = [(0, 1 + i, 1 + (i + 1) % 6) for i in range(6)]
        right_ring = [1, 8, 9, 10, 11, 12]
        right = [(7, right_ring[(i + 1) % 6], right_ring[i]) for i in range(6)]
        text = f"OFF\n{len(points)} 12 0\n" + "".join(f"{x} {y} 0\n" for x, y in points)
        text += "".join(f"3 {a} {b} {c}\n" for a, b, c in left + right)
        report, before, after = self.smooth(text)
        self.assertEqual(self.moved(before, after), {0, 7})
        self.assertEqual(report["before"]["inverted"], 0)

    def test_a_clockwise_mesh_gives_the_same_as_a_counter_clockwise_one(self):
        clean = self.smooth(sample_meshes.off(grid()))
        turned = grid()
        turned.cells = [(kind, (a, c, b)) for kind, (a, b, c) in turned.cells]
        clockwise = self.smooth(sample_meshes.off(turned))
        self.assertEqual(clockwise[2], clean[2])
        self.assertEqual(clockwise[0]["input"]["reoriented_triangles"], 0)
        self.assertEqual(clockwise[0]["before"], clean[0]["before"])
        self.assertEqual(mesh_reader.read(self.path("out.off")).cells, turned.cells)

    def test_some_triangles_in_the_opposite_order_are_no_inverted_ones_and_stay_so(self):
        turned = grid()
        for i in (3, 8):
            kind, (a, b, c) = turned.cells[i]
            turned.cells[i] = (kind, (b, a, c))
        report, _, after = self.smooth(sample_meshes.off(turned))
        self.assertEqual(report["input"]["reoriented_triangles"], 2)
        self.assertEqual(report["before"]["inverted"], 0)
        self.assertEqual(mesh_reader.read(self.path("out.off")).cells, turned.cells)
        self.assertEqual(after, self.smooth(sample_meshes.off(grid()))[2])

    def test_a_triangle_without_area_is_repaired(self):
        flat = grid()
        flat.points[5] = (0.5, 0.5, 0.0)  # halfway between 1 and 4, its neighbours in one triangle
        report, _, _ = self.smooth(sample_meshes.off(flat))
        self.assertLessEqual(report["before"]["metrics"]["shape"]["min"], 0)
        self.assertGreater(report["after"]["metrics"]["shape"]["min"], 0.5)
        self.assertIsNone(report["before"]["metrics"]["condition"]["max"])

    def test_a_triangle_that_repeats_a_vertex_is_kept_and_told(self):
        text = replaced(sample_meshes.off(grid()), b"16 18 0", b"16 19 0") + b"3 0 1 1\n"
        report, before, after = self.smooth(text)
        self.assertEqual(len(self.moved(before, after)), 4)
        self.assertEqual(report["input"]["triangles"], 18)
        self.assertTrue(self.read("out.off").endswith(b"3 0 1 1\n"))
        self.assertIn("repeating a vertex", self.run_tool("smooth", "odd.off", "out.off").err)

    def test_meshes_with_nothing_to_smooth_come_back_as_they_were(self):
        for name, text in {"no_triangles.off": "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", "nothing.off": "OFF\n0 0 0\n",
                           "boundary.off": "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n"}.items():
            with self.subTest(name):
                report, _, _ = self.smooth(text, name)
                self.assertEqual(self.read("out.off").decode(), text)
                self.assertEqual(report["input"]["free_vertices"], 0)
                self.assertEqual(report["smoothing"]["moved_vertices"], 0)

    def test_two_empty_meshes_have_the_same_report(self):
        empty = [self.smooth("OFF\n0 0 0\n")[0], self.smooth("# nothing\n", "empty.obj")[0]]
        self.assertEqual(empty[0]["before"], empty[1]["before"])
        self.assertEqual(empty[0]["coordinates_hash"], empty[1]["coordinates_hash"])

    def test_inverted_triangles_that_can_be_repaired_are(self):
        tangled = grid()
        tangled.points[5], tangled.points[10] = (1.6, 1.7, 0.0), (1.3, 1.2, 0.0)
        report, _, _ = self.smooth(sample_meshes.off(tangled))
        self.assertGreater(report["before"]["inverted"], 0)
        self.assertEqual(report["after"]["inverted"], 0)

    def test_the_plane_is_kept(self):
        clean = self.smooth(sample_meshes.off(grid()))[2]
        for name, place in {"z is 5": lambda x, y, z: (x, y, 5.0), "xz": lambda x, y, z: (x, 0.0, y),
                            "yz": lambda x, y, z: (-2.5, x, y)}.items():
            with self.subTest(name):
                placed = grid()
                placed.points = [place(*p) for p in placed.points]
                _, _, after = self.smooth(sample_meshes.off(placed))
                self.assertEqual(after, [place(*p) for p in clean])

    def test_a_tilted_plane_is_kept_to_rounding(self):
        for suffix, write in {".off": sample_meshes.off, ".vtk": lambda g: sample_meshes.legacy_vtk(
                g, binary=True, scalar="float")}.items():
            with self.subTest(suffix):
                tilted = grid()
                tilted.points = [(0.6 * x, y, 0.8 * x + 3) for x, y, _ in tilted.points]
                tilted.regions = [1] * len(tilted.regions)
                report, before, after = self.smooth(write(tilted), "tilted" + suffix)
                self.assertEqual(self.moved(before, after), {5, 6, 9, 10})
                for x, _, z in after:
                    self.assertAlmostEqual(z, 0.8 / 0.6 * x + 3, delta=1e-6)
                self.assertEqual(planar_geometry.coordinates_hash(after), report["coordinates_hash"])

    def test_coordinates_far_from_the_origin_keep_their_digits(self):
        far = grid()
        far.points = [(x + 4e7, y + 3.5e6, z) for x, y, z in far.points]
        report, before, after = self.smooth(sample_meshes.off(far))
        self.assertEqual(self.moved(before, after), {5, 6, 9, 10})
        near = self.smooth(sample_meshes.off(grid()))
        self.assertAlmostEqual(report["after"]["metrics"]["shape"]["min"],
                               near[0]["after"]["metrics"]["shape"]["min"], places=5)
        # Far and near agree to the last digits that a float64 has there, up to where the tolerance stopped each.
        for p, q in zip(after, near[2]):
            self.assertAlmostEqual(p[0] - 4e7, q[0], delta=1e-6)
            self.assertAlmostEqual(p[1] - 3.5e6, q[1], delta=1e-6)
        words = self.read("out.off").decode().splitlines()[2 + 5].split()
        self.assertGreaterEqual(len(words[0].replace(".", "")), 9)

    def test_scaling_by_a_power_of_two_changes_no_bit_else_only_the_rounding(self):
        clean = self.smooth(sample_meshes.off(grid()))
        for factor in (2.0 ** 40, 2.0 ** -300, 1e200, 1e-9, 1e-200):
            with self.subTest(factor=factor):
                scaled = grid()
                scaled.points = [(factor * x, factor * y, z) for x, y, z in scaled.points]
                text = "OFF\n16 18 0\n" + "".join(f"{x!r} {y!r} {z!r}\n" for x, y, z in scaled.points)
                text += "".join(f"3 {a} {b} {c}\n" for _, (a, b, c) in scaled.cells)
                report, _, after = self.smooth(text)
                exact = factor in (2.0 ** 40, 2.0 ** -300)
                for p, q in zip(after, clean[2]):
                    for i in range(2):
                        self.assertAlmostEqual(p[i] / factor, q[i], delta=0 if exact else 1e-6)
                self.assertEqual(report["after"]["inverted"], 0)

    def test_components_that_overlap_are_smoothed_each_and_not_welded(self):
        two = grid()
        count = len(two.points)
        two.points += [(x + 0.5, y + 0.5, z) for x, y, z in two.points]
        two.cells += [(kind, tuple(v + count for v in cell)) for kind, cell in two.cells]
        report, before, after = self.smooth(sample_meshes.off(two))
        self.assertEqual(report["input"]["components"], 2)
        self.assertEqual(self.moved(before, after), {5, 6, 9, 10, 21, 22, 25, 26})

    def test_a_crack_stays_closed_and_unwelded(self):
        # The row 4 to 7 is there twice: 4 to 7 below, 8 to 11 above the crack.
        whole = grid()
        cracked = sample_meshes.Grid(3, seed=5)
        cracked.points = whole.points[:8] + whole.points[4:8] + whole.points[8:]
        lift = lambda v, above: v + 4 if v > 7 or above else v
        cracked.cells = [(kind, tuple(lift(v, max(cell) > 7) for v in cell)) for kind, cell in whole.cells]
        report, before, after = self.smooth(sample_meshes.off(cracked))
        self.assertEqual(self.moved(before, after), {13, 14})
        self.assertEqual(report["input"]["vertices"], 20)

    def test_points_of_no_cell_stay(self):
        text = replaced(sample_meshes.off(grid()), b"16 18 0", b"17 18 0")
        text = replaced(text, b"\n3 3 0\n", b"\n3 3 0\n1.5 1.25 0\n")
        report, before, after = self.smooth(text)
        self.assertEqual(self.moved(before, after), {5, 6, 9, 10})
        self.assertEqual(report["input"]["fixed_vertices"], 13)


class ExtraFiles(BadInputTest):

    def test_each_is_refused_in_one_line_or_smoothed_without_loss(self):
        folder = os.environ.get("TRISMOOTH_EXTRA_BAD_INPUTS")
        if not folder:
            self.skipTest("TRISMOOTH_EXTRA_BAD_INPUTS names no folder of files")
        for name in sorted(os.listdir(folder)):
            extension = os.path.splitext(name)[1]
            if extension[1:] not in ("off", "obj", "ply", "stl", "vtk", "vtu", "vtp"):
                continue
            with self.subTest(name):
                path, output = os.path.join(folder, name), "out" + extension
                outcome = self.run_limited("smooth", path, output, "--quiet", expect=None)
                self.assertIn(outcome.code, (GOOD, REFUSED))
                print(f"\n{name} -> {outcome.code} {outcome.err.strip().replace(folder + os.sep, '')}", end="")
                if outcome.code == REFUSED:
                    self.assert_refused(path, output)
                else:
                    before, after = mesh_reader.read(path), mesh_reader.read(self.path(output))
                    self.assertEqual(before.cells, after.cells)
                    moved = self.assert_only_free_vertices_moved(before, after)
                    print(f"moved {len(moved)}", end="")
                    os.remove(self.path(output))

    def assert_only_free_vertices_moved(self, before, after):
        moved = {v for v, (p, q) in enumerate(zip(before.points, after.points)) if p != q}
        self.assertEqual(moved & planar_geometry.fixed_vertices(before), set())
        return moved


if __name__ == "__main__":
    tool.main()
