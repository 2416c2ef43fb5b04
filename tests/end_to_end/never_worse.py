"""The promise of never worse, as the README words it, on real meshes and by methods that would break it: of the two
files alone, without asking the program what it did."""

import glob
import itertools
import os

import mesh_reader
import planar_geometry
import tool

FOLDER = os.path.dirname(os.path.abspath(__file__))
MESHES = sorted(glob.glob(os.path.join(FOLDER, "..", "..", "examples", "data", "*.[ov][fft][fku]")))
# The program evaluates shapes in another order of corners and other units.
ROUNDING = 1e-12


class NeverWorseTest(tool.ToolTest):
    def test_no_element_ends_worse_than_it_was_and_than_the_worst_around_what_moved(self):
        self.assertGreaterEqual(len(MESHES), 4)
        for path in MESHES:
            before = mesh_reader.read(path)
            triangles = [t for _, t in before.triangles()]
            orientation = planar_geometry.Orientation(triangles, planar_geometry.flat(before.points))
            old = orientation.shapes(planar_geometry.flat(before.points))
            sweeps = itertools.cycle(("1", "3", "1000"))
            for method, form in itertools.product(("laplacian", "weighted"), "ab"):
                with self.subTest(mesh=os.path.basename(path), method=method, form=form):
                    output = self.path("out" + os.path.splitext(path)[1])
                    self.run_tool("smooth", path, output, "--method", method, "--form", form, "--max-sweeps",
                                  next(sweeps), "--backend", "cpu", "--quiet")
                    after = mesh_reader.read(output)
                    new = orientation.shapes(planar_geometry.flat(after.points))
                    self.check(before, after, triangles, old, new)

    def check(self, before, after, triangles, old, new):
        moved = {v for v, (p, q) in enumerate(zip(before.points, after.points)) if p != q}
        self.assertTrue(moved)
        touched = [t for t, corners in enumerate(triangles) if moved.intersection(corners)]
        worst = min(old[t] for t in touched)
        for t in touched:
            self.assertFalse(old[t] > 0 >= new[t], f"triangle {t} was valid")
            self.assertFalse(new[t] < old[t] - ROUNDING and new[t] < worst - ROUNDING,
                             f"triangle {t}: {old[t]} -> {new[t]}, the worst around a moved vertex was {worst}")


if __name__ == "__main__":
    tool.main()
