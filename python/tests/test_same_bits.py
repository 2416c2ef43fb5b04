# SPDX-License-Identifier: BSD-3-Clause
"""The same bits as the program, for every option."""

from __future__ import annotations

import numpy as np
import pytest

import trismooth
from conftest import grid
from program import hash_of, off_file, program_hash

pytestmark = pytest.mark.skipif(not trismooth.build_info()["files"], reason="this build has no files")
pytest.importorskip("xxhash")

COMBINATIONS = [
    {"method": method, "form": form, "precision": precision, "guard": guard}
    for method in trismooth.METHODS
    for form in ("a", "b")
    for precision in ("double", "single")
    for guard in (True, False)
]
SINGLE = [
    {"untangle": True},
    {"untangle": False},
    {"untangle": "auto"},
    {"layers": "keep"},
    {"layers": "smooth"},
    {"max_sweeps": 3},
    {"max_sweeps": 0},
    {"tolerance": 1e-2},
    {"tolerance": 0.0},
    {"target_quality": 0.2},
    {"threads": 1},
    {"threads": 5},
    {"size_weight": 0.0},
    {"size_weight": 2.5},
    {"power": 1},
    {"power": 4},
    {"target": "input-shape"},
    {"topology": "host"},
    {"topology": "halfedge"},
    {"topology": "device"},
    {"backend": "cpu"},
    {"backend": "auto"},
    {"layout": "soa", "execution": "single-block"},
    {"execution": "cdp"},
    {"time_limit": 1000.0},
    {"slide": "straight"},
    {"slide": "straight", "guard": False},
    {"slide": "straight", "method": "weighted", "precision": "single"},
    {"slide": "curves", "corner_angle": 95, "deviation": 0.1, "curve": "spline", "guard": False},
    {"slide": "curves", "curve": "polyline", "slide_coincident": True, "form": "a"},
    {"slide": "curves", "slide_coincident": False, "deviation": 0},
    # What the program has no option for: results do not depend on it.
    {"evaluation": "all"},
    {"record_min_shape": True},
]
# What the program has for meshes that move alone.
MOVING = [{"method": "mean-ratio", "steady": True}, {"method": "mean-ratio", "steady": False, "form": "a"}]


@pytest.fixture(scope="module")
def tangled_file(tmp_path_factory):
    """A mesh with some inverted triangles, in a file that holds every bit."""
    return off_file(tmp_path_factory.mktemp("bits") / "mesh.off", *grid(40, 30, shift=0.55))


@pytest.mark.parametrize("options", COMBINATIONS + SINGLE, ids=lambda options: ",".join(f"{k}={v}" for k, v in options.items()))
def test_every_option_gives_the_bits_of_the_program(tangled_file, options, tmp_path):
    mesh = trismooth.read(tangled_file)
    result = trismooth.smooth(mesh.points, mesh.triangles, **options)
    assert hash_of(result.points) == program_hash(tangled_file, options, tmp_path)
    plan = trismooth.Plan(mesh.triangles, len(mesh.points), **options)
    for _ in range(2):
        np.testing.assert_array_equal(plan.smooth(mesh.points).points, result.points)
    of_file = mesh.smooth(**options)
    assert of_file.report["coordinates_hash"] == hash_of(mesh.points) == hash_of(result.points)


@pytest.mark.parametrize("options", MOVING, ids=str)
def test_what_is_for_meshes_that_move_gives_a_plan_the_same_bits(options):
    points, triangles = grid(40, 30, shift=0.3)
    expected = trismooth.smooth(points, triangles, **options)
    plan = trismooth.Plan(triangles, len(points), **options)
    np.testing.assert_array_equal(plan.smooth(points).points, expected.points)
    unlike = trismooth.smooth(points, triangles, **{**options, "steady": not options["steady"]})
    assert (unlike.points != expected.points).any()


def test_the_list_of_options_here_is_that_of_the_module():
    from trismooth import _core

    tested = {name for options in COMBINATIONS + SINGLE + MOVING for name in options}
    # "unordered" has no bits that last, and devices are for test_device.py.
    assert set(_core.option_names()) == tested | {"order", "devices"}


def test_float32_gives_the_bits_of_a_file_of_float32(tangled_file, tmp_path):
    mesh = trismooth.read(tangled_file)
    points = mesh.points.astype(np.float32)
    single = tmp_path / "single.ply"
    header = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\nproperty float x\nproperty float y\n"
        f"property float z\nelement face {len(mesh.triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    faces = np.zeros(len(mesh.triangles), [("n", "u1"), ("v", "<i4", 3)])
    faces["n"], faces["v"] = 3, mesh.triangles
    single.write_bytes(header.encode() + points.astype("<f4").tobytes() + faces.tobytes())
    result = trismooth.smooth(points, mesh.triangles)
    assert result.points.dtype == np.float32
    assert hash_of(result.points.astype(np.float64)) == program_hash(single, {}, tmp_path)


def test_regions_fixed_vertices_and_sizes_give_the_bits_of_the_program(tangled_file, tmp_path):
    mesh = trismooth.read(tangled_file)
    points, triangles = mesh.points, mesh.triangles
    regions = (points[triangles].mean(axis=1)[:, 0] > 20).astype(int)
    ids = np.arange(0, len(points), 17)
    sizes = 1 + points[:, 0] / 10
    vtk = tmp_path / "mesh.vtk"
    lines = ["# vtk DataFile Version 3.0", "mesh", "ASCII", "DATASET UNSTRUCTURED_GRID", f"POINTS {len(points)} double"]
    lines += [f"{x!r} {y!r} {z!r}" for x, y, z in points.tolist()]
    lines += [f"CELLS {len(triangles)} {4 * len(triangles)}"] + ["3 " + " ".join(map(str, t)) for t in triangles.tolist()]
    lines += [f"CELL_TYPES {len(triangles)}"] + ["5"] * len(triangles)
    lines += [f"CELL_DATA {len(triangles)}", "SCALARS material int 1", "LOOKUP_TABLE default", *map(str, regions)]
    lines += [f"POINT_DATA {len(points)}", "SCALARS h double 1", "LOOKUP_TABLE default", *map(repr, sizes.tolist())]
    vtk.write_text("\n".join(lines) + "\n")
    (tmp_path / "ids.txt").write_text("\n".join(map(str, ids)))
    result = trismooth.smooth(points, triangles, regions=np.array(["iron", "air"])[regions], fixed=ids, size=sizes, method="mean-ratio")
    more = ["--fixed-ids", str(tmp_path / "ids.txt"), "--size-array", "h", "--method", "mean-ratio"]
    assert hash_of(result.points) == program_hash(vtk, {}, tmp_path, *more)
    read = trismooth.read(vtk)
    assert read.smooth(fixed=ids, size="h", method="mean-ratio").report["coordinates_hash"] == hash_of(result.points)
    mask = np.zeros(len(points), bool)
    mask[ids] = True
    again = trismooth.smooth(points, triangles, regions=regions + 7, fixed=mask, size=8 * sizes, method="mean-ratio")
    np.testing.assert_array_equal(again.points, result.points)
