# SPDX-License-Identifier: BSD-3-Clause
"""partitions.py PROGRAM: how a mesh is shared out among ranks cannot be seen in the result."""

import glob
import itertools
import os
import pathlib

import pieces
import ranks_tool
import tool

# Real meshes beside the checkout, where there are any.
SHARED = pathlib.Path(__file__).resolve().parents[3] / "shared" / "meshes"
OPTIONS = ([], ["--method", "mean-ratio", "--untangle", "off"], ["--form", "a", "--precision", "single"])


class Partitions(ranks_tool.RanksTest):
    def setUp(self):
        super().setUp()
        has_metis = "METIS" in self.run_tool("info").out
        self.partitions = ("keep", "bisect", "metis") if has_metis else ("keep", "bisect")

    def check(self, whole, name, *arguments, ranks, partitions=None):
        for partition in partitions or self.partitions:
            for count in ranks:
                with self.subTest(partition=partition, ranks=count, arguments=arguments):
                    report = self.report_over(count, "smooth", name, "out" + os.path.splitext(name)[1], "--partition",
                                              partition, *arguments)
                    self.assertEqual(report["coordinates_hash"], whole["coordinates_hash"])
                    self.assertEqual(report["after"], whole["after"])

    def test_pieces_and_one_file(self):
        mesh = self.random_mesh(3000)
        order = sorted(range(len(mesh.cells)), key=pieces.stripes(mesh, 4).__getitem__)
        mesh.cells = [mesh.cells[c] for c in order]
        mesh.cell_arrays = {name: [values[c] for c in order] for name, values in mesh.cell_arrays.items()}
        pieces.write_vtu(self.path("whole.vtu"), mesh)
        pieces.write_pieces(self.path("big.pvtu"), pieces.cut(mesh, pieces.stripes(mesh, 4), 4))
        for options in OPTIONS:
            whole = self.report("smooth", "whole.vtu", "alone.vtu", *options)
            self.check(whole, "whole.vtu", *options, ranks=(2, 3, 5) if tool.thorough else (3,))
            self.check(whole, "big.pvtu", *options, ranks=(2, 3, 5, 8) if tool.thorough else (5,))

    def test_small_meshes(self):
        """Fewer vertices than blocks, and than ranks; without an edge between any."""
        apart = pieces.Mesh([(4.0 * t + x, y, 0.0) for t in range(5) for x, y in ((0, 0), (1, 0), (0, 1))],
                            [[3 * t, 3 * t + 1, 3 * t + 2] for t in range(5)])
        for name, mesh in (("few", self.random_mesh(7)), ("some", self.random_mesh(60)), ("apart", apart)):
            pieces.write_vtu(self.path(f"{name}.vtu"), mesh)
            self.check(self.report("smooth", f"{name}.vtu", "alone.vtu"), f"{name}.vtu", ranks=(3, 8))

    def test_shared_meshes(self):
        """Each mesh in turn by another partition, on another number of ranks, with other options."""
        turns = itertools.cycle(itertools.product(reversed(self.partitions), (3, 2, 8, 5), OPTIONS))
        for path in sorted(glob.glob(os.path.join(SHARED, "*.*"))):
            name = os.path.basename(path)
            if name.endswith(".md"):
                continue
            os.symlink(path, self.path(name))
            for partition, ranks, options in itertools.islice(turns, 3 if tool.thorough else 1):
                whole = self.report("smooth", name, "alone" + os.path.splitext(name)[1], *options)
                self.check(whole, name, *options, ranks=(ranks,), partitions=(partition,))

    def test_partitions_that_are_not_there(self):
        self.write("triangle.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
        wrong = ["nosuch"] if "metis" in self.partitions else ["nosuch", "metis"]
        for partition in wrong:
            outcome = self.run_over(2, "smooth", "triangle.off", "out.off", "--partition", partition, expect=2)
            self.assertIn("bisect", self.errors_of(outcome)[0])
            self.assertFalse(os.path.exists(self.path("out.off")))


if __name__ == "__main__":
    ranks_tool.main()
