# SPDX-License-Identifier: BSD-3-Clause
"""bad_pieces.py PROGRAM: what is wrong with a mesh in pieces is said once, names the file, and ends all ranks."""

import os

import pieces
import ranks_tool


class BadPieces(ranks_tool.RanksTest):
    def setUp(self):
        super().setUp()
        self.mesh = self.random_mesh(300)

    def cut(self, **options):
        return pieces.cut(self.mesh, pieces.stripes(self.mesh, 4), 4, **options)

    def refused(self, *words, name="bad.pvtu", output="out.pvtu", options=(), expect=3, run=None):
        """Every run says one thing, with these words in it, and writes nothing."""
        for ranks in (0, 3):
            outcome = (run or self.run_over)(ranks, "smooth", name, output, *options, expect=expect)
            errors = self.errors_of(outcome)
            self.assertEqual(len(errors), 1, outcome)
            for word in words:
                self.assertIn(word, errors[0])
            self.assertEqual([file for file in os.listdir(self.folder) if file.startswith("out")], [])
            self.assert_no_temporary_files()

    def test_a_launcher_of_another_mpi(self):
        pieces.write_pieces(self.path("bad.pvtu"), self.cut())
        os.environ["PMI_SIZE"] = "4"
        self.addCleanup(os.environ.pop, "PMI_SIZE")
        outcome = self.run_over(0, "smooth", "bad.pvtu", "out.pvtu", expect=2)
        self.assertIn("has started 4 processes, and MPI sees this one alone", self.errors_of(outcome)[0])
        self.assertFalse(os.path.exists(self.path("out.pvtu")))

    def test_arrays_that_one_piece_lacks(self):
        parts = self.cut()
        del parts[2].cell_arrays["load"]
        pieces.write_pieces(self.path("bad.pvtu"), parts)
        self.refused("bad_2.vtu: has not the cell array 'load'", "bad_0.vtu")

    def test_arrays_of_different_types(self):
        parts = self.cut()
        parts[3].point_arrays["height"] = [1] * len(parts[3].points)
        pieces.write_pieces(self.path("bad.pvtu"), parts)
        self.refused("bad_3.vtu: has not the point array 'height' of type float64")

    def test_coordinates_that_differ(self):
        parts = self.cut()
        shared = set(parts[2].point_arrays["GlobalNodeIds"]) & set(parts[3].point_arrays["GlobalNodeIds"])
        vertex = min(shared)
        i = parts[3].point_arrays["GlobalNodeIds"].index(vertex)
        x, y, z = parts[3].points[i]
        parts[3].points[i] = (x * (1 + 2 ** -52), y, z)
        pieces.write_pieces(self.path("bad.pvtu"), parts)
        self.refused(f"bad_3.vtu: the vertex of global id {vertex} is at", "bad_2.vtu")

    def test_ids_twice_and_negative(self):
        parts = self.cut()
        parts[1].point_arrays["GlobalNodeIds"][5] = parts[1].point_arrays["GlobalNodeIds"][9]
        pieces.write_pieces(self.path("bad.pvtu"), parts)
        self.refused("bad_1.vtu: the array of global ids 'GlobalNodeIds' gives points 5 and 9 the same number")
        parts[1].point_arrays["GlobalNodeIds"][5] = -4
        pieces.write_pieces(self.path("bad.pvtu"), parts)
        self.refused("bad_1.vtu", "gives point 5 the number -4")

    def test_copies_that_are_no_ghosts(self):
        parts = self.cut()
        parts[2].cell_arrays["vtkGhostType"] = [0] * len(parts[2].cells)
        pieces.write_pieces(self.path("bad.pvtu"), parts)
        self.refused("vtkGhostType")

    def test_slits_between_pieces(self):
        parts = self.cut(global_ids=False)
        shared = next(point for point in parts[1].points if point in parts[0].points)
        parts[0].points.append(shared)
        parts[0].point_arrays = {name: values + [0] for name, values in parts[0].point_arrays.items()}
        parts[0].point_arrays["height"][-1] = 0.5
        pieces.write_pieces(self.path("bad.pvtu"), parts)
        self.refused("bad_0.vtu: several points are at", "has points there, too", "GlobalNodeIds")

    def test_missing_and_damaged_pieces(self):
        names = pieces.write_pieces(self.path("bad.pvtu"), self.cut())
        content = self.read(names[3])
        self.write(names[3], content[:len(content) // 2])
        self.refused("bad_3.vtu:", "cut off")
        os.remove(self.path(names[3]))
        self.refused("bad_3.vtu: cannot be opened")
        self.write(names[3], "OFF\n0 0 0\n")
        self.refused("bad_3.vtu: is a file of OFF")

    def test_bad_summaries(self):
        names = pieces.write_pieces(self.path("good.pvtu"), self.cut())
        pieces.write_summary(self.path("bad.pvtu"), [*names[:2], "./" + names[0]])
        self.refused("bad.pvtu:", "names the piece './good_0.vtu' twice")
        pieces.write_summary(self.path("bad.pvtu"), [names[0], "bad.pvtu"])
        self.refused("bad.pvtu:", "names itself")
        pieces.write_summary(self.path("bad.pvtu"), [])
        self.refused("bad.pvtu:", "names no pieces")
        content = self.read("good.pvtu")
        self.write("bad.pvtu", content[:150])
        self.refused("bad.pvtu:", "cut off")
        self.write("bad.pvtu", content.replace(b'"PUnstructuredGrid"', b'"PImageData"'))
        self.refused("bad.pvtu:", "PImageData")
        self.write("bad.pvtu", content.replace(b"Source=", b"File="))
        self.refused("bad.pvtu:", "Source")
        self.refused("nowhere.pvtu: cannot be opened", name="nowhere.pvtu")

    def test_planes(self):
        parts = self.cut(global_ids=False)
        parts[2].points = [(x, y, 0.5) for x, y, _ in parts[2].points]
        pieces.write_pieces(self.path("bad.pvtu"), parts)
        self.refused("bad.pvtu: the mesh is not planar")

    def test_options(self):
        pieces.write_pieces(self.path("bad.pvtu"), self.cut())
        self.refused("--fixed-set", options=["--fixed-set", "corners"], expect=2, run=self.launch)
        self.refused("--nosuch", options=["--nosuch"], expect=2)
        self.refused("nosuch", "load, region", options=["--region-array", "nosuch"], expect=2)
        self.refused(".pvtu", output="out.vtu", expect=2)
        self.refused("ids.txt", options=["--fixed-ids", self.write("ids.txt", "12 300")], expect=3, run=self.launch)

    def test_output_over_input(self):
        names = pieces.write_pieces(self.path("bad.pvtu"), self.cut())
        pieces.write_summary(self.path("other.pvtu"), names)
        before = {name: self.read(name) for name in names}
        for ranks in (0, 3):
            outcome = self.run_over(ranks, "smooth", "other.pvtu", "bad.pvtu", expect=2)
            self.assertIn("is one of the input", self.errors_of(outcome)[0])
            self.assertEqual({name: self.read(name) for name in names}, before)


if __name__ == "__main__":
    ranks_tool.main()
