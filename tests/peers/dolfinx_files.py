# SPDX-License-Identifier: BSD-3-Clause
"""XDMF by DOLFINx itself (Debian's python3-dolfinx-real, or the Python of TRISMOOTH_DOLFINX_PYTHON): meshes, tags and
functions come back with moved coordinates alone, and DOLFINx reads them."""

import json
import os
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "end_to_end"))

PYTHON = os.environ.get("TRISMOOTH_DOLFINX_PYTHON", "/usr/bin/python3")

try:
    import numpy
    if subprocess.run([PYTHON, "-c", "import dolfinx"], stderr=subprocess.DEVNULL, check=False).returncode != 0:
        raise ImportError("dolfinx")
except (ImportError, OSError) as missing:
    print(f"skipped: a package is not installed where this runs ({missing})")
    sys.exit(77)

import tool
import xdmf_files

WRITE = """
import sys
import numpy
from mpi4py import MPI
from dolfinx import fem, io, mesh

name, cells, encoding = sys.argv[1:]
plate = mesh.create_rectangle(MPI.COMM_WORLD, [[0, 0], [2, 1]], [20, 10], getattr(mesh.CellType, cells))
plate.name = "plate"
points = plate.geometry.x
inner = (points[:, 0] > 1e-9) & (points[:, 0] < 2 - 1e-9) & (points[:, 1] > 1e-9) & (points[:, 1] < 1 - 1e-9)
points[inner, :2] += numpy.random.default_rng(1).uniform(-0.03, 0.03, (inner.sum(), 2))
plate.topology.create_connectivity(1, 2)
plate.topology.create_connectivity(2, 2)
all_cells = numpy.arange(plate.topology.index_map(2).size_local, dtype=numpy.int32)
middles = mesh.compute_midpoints(plate, 2, all_cells)
material = mesh.meshtags(plate, 2, all_cells, numpy.where(middles[:, 0] < 1, 7, 9).astype(numpy.int32))
material.name = "material"
sides = numpy.sort(mesh.locate_entities_boundary(plate, 1, lambda x: numpy.isclose(x[1], 0)))
bottom = mesh.meshtags(plate, 1, sides, numpy.full(len(sides), 3, dtype=numpy.int32))
bottom.name = "bottom"
u = fem.Function(fem.FunctionSpace(plate, ("CG", 1)))
u.name = "u"
u.interpolate(lambda x: x[0] + 2 * x[1])
with io.XDMFFile(MPI.COMM_WORLD, name, "w", encoding=getattr(io.XDMFFile.Encoding, encoding)) as file:
    file.write_mesh(plate)
    file.write_meshtags(material)
    file.write_meshtags(bottom)
    for time in (0.0, 1.0):
        file.write_function(u, time)
"""

READ = """
import json
import sys
from mpi4py import MPI
from dolfinx import io, mesh

name, encoding = sys.argv[1:]
with io.XDMFFile(MPI.COMM_WORLD, name, "r", encoding=getattr(io.XDMFFile.Encoding, encoding)) as file:
    plate = file.read_mesh(name="plate")
    plate.topology.create_connectivity(1, 2)
    tags = {tag: file.read_meshtags(plate, tag) for tag in ("material", "bottom")}
middles = mesh.compute_midpoints(plate, 2, tags["material"].indices)
print(json.dumps({"points": plate.geometry.x[:, :2].tolist(), "bottom": sorted(tags["bottom"].values.tolist()),
                  "left": sorted(set(tags["material"].values[middles[:, 0] < 1].tolist())),
                  "right": sorted(set(tags["material"].values[middles[:, 0] > 1].tolist()))}))
"""


class DolfinxTest(tool.ToolTest):

    def dolfinx(self, program, *arguments):
        outcome = subprocess.run([PYTHON, "-c", program, *arguments], cwd=self.path(""), capture_output=True, text=True,
                                 check=False)
        self.assertEqual(outcome.returncode, 0, outcome.stderr)
        return outcome.stdout

    def test_dolfinx_reads_its_own_files_the_same_but_for_moved_points(self):
        for cells, elements in (("triangle", 400), ("quadrilateral", 200)):
            for encoding in ("HDF5", "ASCII"):
                with self.subTest(cells=cells, encoding=encoding):
                    self.dolfinx(WRITE, "in.xdmf", cells, encoding)
                    report = self.report("smooth", "in.xdmf", "out.xdmf")
                    read = report["input"]
                    self.assertEqual(read["triangles"] + read["quadrilaterals"], elements)
                    # The border of the materials, and the tagged sides.
                    self.assertEqual((read["held"]["interface"], read["other_cells"]), (11, 20))
                    before, after = (json.loads(self.dolfinx(READ, name, encoding)) for name in ("in.xdmf", "out.xdmf"))
                    self.assertEqual({"bottom": [3] * 20, "left": [7], "right": [9]},
                                     {key: after[key] for key in ("bottom", "left", "right")})
                    # Each in its own order: the places that are gone are those that moved.
                    places = [{tuple(point) for point in mesh["points"]} for mesh in (before, after)]
                    self.assertEqual(len(places[0] - places[1]), report["smoothing"]["moved_vertices"])
                    if encoding == "HDF5":
                        form = [xdmf_files.datasets(self.path(name)) for name in ("in.h5", "out.h5")]
                        self.assertEqual(form[0].keys(), form[1].keys())
                        for name, (values, *rest) in form[0].items():
                            self.assertEqual(list(form[1][name][1:]), rest)
                            if name != "Mesh/plate/geometry":
                                numpy.testing.assert_array_equal(form[1][name][0], values)


if __name__ == "__main__":
    tool.main()
