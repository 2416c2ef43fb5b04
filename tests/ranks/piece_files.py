# SPDX-License-Identifier: BSD-3-Clause
"""piece_files.py PROGRAM: what is read and written of a mesh in pieces; nothing gets lost."""

import os
import signal
import subprocess

import pieces
import ranks_tool
import tool


NOT_WRITTEN = 4


class PieceFiles(ranks_tool.RanksTest):
    def setUp(self):
        super().setUp()
        self.mesh = self.random_mesh(600)
        self.parts = pieces.cut(self.mesh, pieces.stripes(self.mesh, 4), 4)
        self.names = pieces.write_pieces(self.path("big.pvtu"), self.parts)

    def test_all_but_coordinates_stays(self):
        self.launch(3, "smooth", "big.pvtu", "out.pvtu", "--quiet")
        self.assertEqual(pieces.sources(self.path("out.pvtu")), [f"out_{i}.vtu" for i in range(4)])
        self.assertEqual(self.read("out.pvtu"), self.read("big.pvtu").replace(b'"big_', b'"out_'))
        places = {}
        for part, name in zip(self.parts, self.names):
            before = pieces.read_ascii_arrays(self.path(name))
            after = pieces.read_ascii_arrays(self.path(name.replace("big", "out")))
            self.assertEqual(list(after), list(before))
            points = after.pop(("Points", "Points"))[1]
            self.assertNotEqual(points, before.pop(("Points", "Points"))[1])
            for key, (kind, words) in before.items():
                self.assertEqual(after[key][0], kind, key)
                self.assertEqual([float(w) for w in after[key][1]], [float(w) for w in words], key)
            # Copies are where the vertex is.
            for i, vertex in enumerate(part.point_arrays["GlobalNodeIds"]):
                place = [float(x) for x in points[3 * i:3 * i + 3]]
                self.assertEqual(places.setdefault(vertex, place), place)
        self.assert_no_temporary_files()

    def test_in_place(self):
        self.run_over(2, "smooth", "big.pvtu", "out.pvtu", "--quiet")
        summary = self.read("big.pvtu")
        self.run_over(2, "smooth", "big.pvtu", "big.pvtu", "--quiet")
        self.assertEqual(self.read("big.pvtu"), summary)
        for i in range(4):
            self.assertEqual(self.read(f"big_{i}.vtu"), self.read(f"out_{i}.vtu"))

    def test_pieces_stay_where_a_report_or_standard_output_cannot_be_written(self):
        self.write("whole.off", "precious")
        self.write("report.html", "precious")
        before = {name: self.read(name) for name in os.listdir(self.folder)}
        for output, more in (("big.pvtu", []), ("new.pvtu", []), ("whole.off", ["--single"])):
            for ranks in (1, 3):
                with self.subTest(output, ranks=ranks):
                    os.symlink("/dev/full", self.path("full.json"))
                    outcome = self.run_over(ranks, "smooth", "big.pvtu", output, *more, "--report", "report.html",
                                            "--report", "full.json", expect=NOT_WRITTEN)
                    self.assertIn(f"so {output} is not written either", outcome.err)
                    os.remove(self.path("full.json"))
                    self.assertEqual({name: self.read(name) for name in os.listdir(self.folder)}, before)
        with open("/dev/full", "wb") as full:
            done = subprocess.run([tool.program, "smooth", "big.pvtu", "big.pvtu"], cwd=self.folder, stdout=full,
                                  stderr=subprocess.PIPE, check=False, timeout=60)
        self.assertEqual(done.returncode, NOT_WRITTEN, done.stderr)
        self.assertEqual({name: self.read(name) for name in os.listdir(self.folder)}, before)

    def test_annotations_of_an_earlier_run_are_left_out_of_all_pieces(self):
        self.mesh.cell_arrays["trismooth:shape"] = [0.5] * len(self.mesh.cells)
        self.mesh.point_arrays["trismooth:fixed"] = [1.0] * len(self.mesh.points)
        parts = pieces.cut(self.mesh, pieces.stripes(self.mesh, 4), 4)
        pieces.write_pieces(self.path("old.pvtu"), parts)
        # Some programs list the arrays of pieces.
        listed = (b'    <PCellData>\n      <PDataArray type="Float64" Name="load"/>\n'
                  b'      <PDataArray type="Float64" Name="trismooth:shape"/>\n    </PCellData>\n')
        self.write("old.pvtu", self.read("old.pvtu").replace(b"    <PPoints>", listed + b"    <PPoints>"))
        for ranks in (1, 3):
            self.run_over(ranks, "smooth", "big.pvtu", "plain.pvtu", "--quiet")
            outcome = self.run_over(ranks, "smooth", "old.pvtu", "out.pvtu")
            self.assertIn("are left out: trismooth:shape, trismooth:fixed", outcome.err)
            self.assertEqual(self.read("out.pvtu"), self.read("old.pvtu").replace(b"old_", b"out_").replace(
                b'      <PDataArray type="Float64" Name="trismooth:shape"/>\n', b""))
            for i in range(4):
                self.assertEqual(self.read(f"out_{i}.vtu"), self.read(f"plain_{i}.vtu"))
            self.run_over(ranks, "smooth", "old.pvtu", "one.vtu", "--single")
            self.assertNotIn(b"trismooth:", self.read("one.vtu"))

    def test_depths_follow_over_any_number_of_ranks(self):
        self.mesh.point_arrays["depth"] = [x * x + y for x, y, *_ in self.mesh.points]
        pieces.write_pieces(self.path("deep.pvtu"), pieces.cut(self.mesh, pieces.stripes(self.mesh, 4), 4))
        for output in ("deep.14", "deep.2dm"):
            alone = self.report_over(1, "smooth", "deep.pvtu", output, "--single")
            self.assertEqual([field["name"] for field in alone["fields"]], ["depth"])
            written = self.read(output)
            for ranks in (2, 3):
                over = self.report_over(ranks, "smooth", "deep.pvtu", output, "--single")
                self.assertEqual(over["fields"], alone["fields"])
                self.assertEqual(self.read(output), written)

    def test_folders(self):
        os.mkdir(self.path("parts"))
        for i, name in enumerate(self.names):
            os.rename(self.path(name), self.path(f"parts/p&{i}.vtu"))
        pieces.write_summary(self.path("big.pvtu"), [f"parts/p&amp;{i}.vtu" for i in range(4)])
        os.mkdir(self.path("results"))
        self.run_over(2, "smooth", "big.pvtu", "results/a<b.pvtu", "--quiet")
        self.assertEqual(pieces.sources(self.path("results/a<b.pvtu")), [f"a&lt;b_{i}.vtu" for i in range(4)])
        self.run_over(2, "quality", "results/a<b.pvtu")

    def test_empty_pieces(self):
        whole = self.report_over(1, "smooth", "big.pvtu", "out.pvtu")
        empty = pieces.Mesh([], [])
        pieces.write_pieces(self.path("more.pvtu"), [empty, *self.parts[:2], empty, *self.parts[2:]])
        for ranks in (1, 3, 6):
            parts = self.report_over(ranks, "smooth", "more.pvtu", "out.pvtu")
            self.assertEqual(parts["coordinates_hash"], whole["coordinates_hash"])

    def test_pieces_without_ghosts(self):
        whole = self.report_over(1, "smooth", "big.pvtu", "out.pvtu")
        bare = pieces.cut(self.mesh, pieces.stripes(self.mesh, 4), 4, ghosts=False)
        pieces.write_pieces(self.path("bare.pvtu"), bare)
        self.assertEqual(self.report_over(3, "smooth", "bare.pvtu", "out.pvtu")["coordinates_hash"],
                         whole["coordinates_hash"])

    def test_polygonal_data(self):
        whole = self.report_over(1, "smooth", "big.pvtu", "out.pvtu")
        for i, part in enumerate(self.parts):
            pieces.write_vtp(self.path(f"poly_{i}.vtp"), part)
        summary = self.read("big.pvtu").decode().replace("PUnstructuredGrid", "PPolyData")
        self.write("poly.pvtp", summary.replace("big_", "poly_").replace(".vtu", ".vtp"))
        for ranks in (0, 3):
            parts = self.report_over(ranks, "smooth", "poly.pvtp", "out.pvtp")
            self.assertEqual(parts["coordinates_hash"], whole["coordinates_hash"])
            self.assertEqual(pieces.sources(self.path("out.pvtp")), [f"out_{i}.vtp" for i in range(4)])
        self.run_over(2, "quality", "out.pvtp")
        # The pieces are to be what the summary says.
        self.write("mixed.pvtp", summary)
        self.assertIn("big_0.vtu: is a file of VTK XML (unstructured grid)",
                      self.run_over(2, "quality", "mixed.pvtp", expect=3).err)

    def test_page(self):
        report = self.report_over(3, "smooth", "big.pvtu", "out.pvtu", "--report", "page.html")
        self.assertIn(report["coordinates_hash"].encode(), self.read("page.html"))

    def test_old_output_survives(self):
        self.run_over(2, "smooth", "big.pvtu", "out.pvtu", "--quiet")
        old = {name: self.read(name) for name in os.listdir(self.folder) if name.startswith("out")}
        # The last piece of the output cannot be written.
        os.remove(self.path("out_3.vtu"))
        os.mkdir(self.path("out_3.vtu"))
        del old["out_3.vtu"]
        for ranks in (0, 3):
            outcome = self.run_over(ranks, "smooth", "big.pvtu", "out.pvtu", "--method", "laplacian", expect=4)
            self.assertEqual(self.errors_of(outcome), ["trismooth: error: out_3.vtu: is a folder"])
            self.assertEqual({name: self.read(name) for name in old}, old)
            self.assert_no_temporary_files()

    def test_interrupted(self):
        # Large enough not to come to its end.
        mesh = self.random_mesh(20000)
        pieces.write_pieces(self.path("big.pvtu"), pieces.cut(mesh, pieces.stripes(mesh, 4), 4))
        self.run_over(2, "smooth", "big.pvtu", "out.pvtu", "--quiet")
        old = {name: self.read(name) for name in os.listdir(self.folder)}
        command = [*ranks_tool.launcher, "3", tool.program, "smooth", "big.pvtu", "out.pvtu", "--method", "laplacian",
                   "--max-sweeps", "0", "--tolerance", "0", "--verbose"]
        with subprocess.Popen(command, cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                              stderr=subprocess.PIPE, text=True) as job:
            # (Signals that come while ranks start are the launcher's affair.)
            lines = iter(job.stderr.readline, "")
            self.assertTrue(any(line.startswith("sweep 20:") for line in lines))
            job.send_signal(signal.SIGINT)
            rest = job.communicate(timeout=ranks_tool.longest_run)[1]
        self.assertNotEqual(job.returncode, 0)
        # Once, if the launcher still passes it on.
        self.assertLessEqual(rest.count("trismooth: error: cancelled"), 1, rest[-1000:])
        self.assertEqual({name: self.read(name) for name in os.listdir(self.folder)}, old)

    def test_messages_once(self):
        alone = self.run_over(0, "smooth", "big.pvtu", "out.pvtu", "--verbose")
        shared = self.run_over(3, "smooth", "big.pvtu", "out.pvtu", "--verbose")
        def kinds(text):
            return [line.split(":")[0] for line in text.splitlines() if not line.startswith("  ")]
        self.assertEqual(kinds(shared.out), kinds(alone.out))
        self.assertEqual(shared.err.count("\nsweep 1:"), alone.err.count("\nsweep 1:"))

    def test_nothing_to_smooth(self):
        points = pieces.Mesh([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0)], [])
        for parts in ([points], [points, pieces.Mesh([(2.0, 0.0, 0.0)], [])], [pieces.Mesh([], [])]):
            pieces.write_pieces(self.path("bare.pvtu"), parts)
            for ranks in (0, 3):
                report = self.report_over(ranks, "smooth", "bare.pvtu", "out.pvtu")
                self.assertEqual(report["input"]["triangles"], 0)
                self.assertEqual(report["input"]["vertices"], sum(len(part.points) for part in parts))
        lines = pieces.Mesh([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0)], [[0, 1]])
        lines.types = [3]
        pieces.write_pieces(self.path("bare.pvtu"), [lines])
        self.assertIn("holds 1 cell but no triangle", self.run_over(2, "quality", "bare.pvtu", expect=3).err)

    def test_other_commands(self):
        self.assertEqual(self.launch(3, "--version").out, self.launch(0, "--version").out)
        self.launch(3, "generate", "again.off", "--vertices", 600)
        self.assertEqual(self.read("again.off"), self.read("random.off"))
        self.assertEqual(len(self.errors_of(self.launch(3, "smooth", expect=2))), 1)

    def test_gates(self):
        outcome = self.launch(3, "smooth", "big.pvtu", "out.pvtu", "--quiet", "--require", "min_shape>=0.99",
                              expect=1)
        self.assertEqual(len([line for line in outcome.err.splitlines() if "min_shape" in line]), 1, outcome)
        self.assertTrue(os.path.exists(self.path("out_3.vtu")))


if __name__ == "__main__":
    ranks_tool.main()
