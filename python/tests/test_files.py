# SPDX-License-Identifier: BSD-3-Clause
"""Files: read, smoothed and written as the program does it, with nothing lost."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import trismooth
from conftest import grid
from program import off_file

pytestmark = pytest.mark.skipif(not trismooth.build_info()["files"], reason="this build has no files")
PROGRAM = os.environ.get("TRISMOOTH_PROGRAM")

MSH = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
2 1 "iron"
2 2 "air"
$EndPhysicalNames
$Nodes
{nodes}
$EndNodes
$Elements
{elements}
$EndElements
$NodeData
1
"temperature"
1
0.5
3
0
1
1
3 21.5
$EndNodeData
"""


@pytest.fixture
def msh(tmp_path):
    """A file of Gmsh with two named regions and data that only the file itself can keep."""
    points, triangles = grid(12, 9)
    group = 1 + (points[triangles].mean(axis=1)[:, 0] > 6)
    nodes = [f"{len(points)}"] + [f"{i + 1} {x!r} {y!r} 0" for i, (x, y) in enumerate(points.tolist())]
    elements = [f"{len(triangles)}"]
    elements += [f"{i + 1} 2 2 {g} {g} {a + 1} {b + 1} {c + 1}" for i, (g, (a, b, c)) in enumerate(zip(group, triangles.tolist()))]
    path = tmp_path / "in.msh"
    path.write_text(MSH.format(nodes="\n".join(nodes), elements="\n".join(elements)))
    return path


def run_program(*arguments):
    program = [PROGRAM] if PROGRAM else [sys.executable, "-m", "trismooth"]
    return subprocess.run([*program, *map(str, arguments)], capture_output=True, text=True, timeout=120)


def test_the_file_written_is_that_of_the_program_byte_for_byte(msh, tmp_path):
    mesh = trismooth.read(msh)
    result = mesh.smooth()
    assert mesh.write(tmp_path / "python.msh") == []
    assert run_program("smooth", msh, tmp_path / "program.msh").returncode == 0
    assert (tmp_path / "python.msh").read_bytes() == (tmp_path / "program.msh").read_bytes()
    assert result.moved > 0 and result.report["input"]["regions"] == 2
    assert result.mesh is mesh and np.array_equal(result.points, mesh.points)


def test_what_was_read_is_there(msh):
    mesh = trismooth.read(msh)
    points, triangles = grid(12, 9)
    assert mesh.format == "msh" and mesh.path == str(msh)
    np.testing.assert_array_equal(mesh.points[:, :2], points)
    np.testing.assert_array_equal(mesh.triangles, triangles)
    assert set(mesh.cell_types) == {5} and mesh.quadratic_triangles.shape == (0, 6)
    assert set(np.unique(mesh.cell_data["gmsh:physical"])) == {1, 2}
    assert "130 points" in repr(mesh) and "in.msh" in repr(mesh)


def test_the_quality_is_that_of_the_arrays(msh):
    mesh = trismooth.read(msh)
    expected = trismooth.quality(mesh.points, mesh.triangles).summary
    for name in trismooth.METRICS:
        assert mesh.quality()[name].mean == expected[name].mean
    result = mesh.smooth()
    assert result.before["shape"].min == expected["shape"].min
    assert mesh.quality()["shape"].min == result.after["shape"].min


def test_points_can_be_assigned_and_are_written(msh, tmp_path):
    mesh = trismooth.read(msh)
    points = mesh.points
    points[:, 0] *= 2
    mesh.points = points
    mesh.write(tmp_path / "wide.off")
    np.testing.assert_array_equal(trismooth.read(tmp_path / "wide.off").points, points)
    for wrong in (points[:-1], points[:, :2], points.astype(np.float32), points.astype(int)):
        with pytest.raises((ValueError, TypeError), match="^points: "):
            mesh.points = wrong
    nan = points.copy()
    nan[3, 1] = np.nan
    with pytest.raises(ValueError, match="^points: "):
        mesh.points = nan
    np.testing.assert_array_equal(mesh.points, points)


def test_values_that_become_depths_and_have_not_followed_are_told(tmp_path):
    points, triangles = grid(12, 9)
    lines = ["# vtk DataFile Version 3.0", "a", "ASCII", "DATASET POLYDATA", f"POINTS {len(points)} double"]
    lines += [f"{x!r} {y!r} 0" for x, y in points.tolist()]
    lines += [f"POLYGONS {len(triangles)} {4 * len(triangles)}", *("3 " + " ".join(map(str, t)) for t in triangles.tolist())]
    lines += [f"POINT_DATA {len(points)}", "SCALARS depth double 1", "LOOKUP_TABLE default"]
    path = tmp_path / "warm.vtk"
    path.write_text("\n".join(lines + [repr(x * x + y) for x, y in points.tolist()]) + "\n")
    mesh = trismooth.read(path)
    assert not any("depth" in loss and "as they were read" in loss for loss in mesh.write(tmp_path / "before.14"))
    mesh.smooth()
    said = [loss for loss in mesh.write(tmp_path / "after.14") if "as they were read" in loss]
    assert len(said) == 1 and "field_arrays=['depth']" in said[0]
    assert not any("as they were read" in loss for loss in mesh.write(tmp_path / "after.vtk"))
    again = trismooth.read(path)
    again.smooth(fields="interpolate", field_arrays=["depth"])
    assert not any("as they were read" in loss for loss in again.write(tmp_path / "follows.14"))


def test_layers_are_counted_in_files_as_in_arrays(tmp_path):
    rows = [0, 0.02, 0.04, 0.06, 1, 2, 3]
    points = np.array([[x, y] for y in rows for x in range(8)], dtype=float)
    cells = [[y * 8 + x, y * 8 + x + 1, (y + 1) * 8 + x] for y in range(6) for x in range(7)]
    cells += [[y * 8 + x + 1, (y + 1) * 8 + x + 1, (y + 1) * 8 + x] for y in range(6) for x in range(7)]
    path = off_file(tmp_path / "layers.off", points, np.array(cells))
    with pytest.warns(trismooth.MeshWarning):
        of_arrays = trismooth.smooth(points, np.array(cells))
    with pytest.warns(trismooth.MeshWarning):
        of_file = trismooth.read(path).smooth()
    assert of_arrays.layers["kept"] > 0
    assert of_file.layers == of_arrays.layers


def test_losses_of_another_format_are_told(msh, tmp_path):
    mesh = trismooth.read(msh)
    losses = mesh.write(tmp_path / "out.off")
    assert any("OFF holds no cell arrays" in loss for loss in losses), losses
    assert mesh.write(tmp_path / "shape", format="off") == losses


def test_constraints_by_name_and_number(msh):
    points = trismooth.read(msh).points

    def moved(**options):
        mesh = trismooth.read(msh)
        mesh.smooth(**options)
        return np.any(mesh.points != points, axis=1)

    held = np.arange(0, len(points), 3)
    assert not moved(fixed=held)[held].any() and moved()[held].any()
    mask = np.zeros(len(points), bool)
    mask[held] = True
    np.testing.assert_array_equal(moved(fixed=mask), moved(fixed=held))
    assert moved(regions="none").sum() > moved().sum() == moved(regions=["gmsh:physical"]).sum()


@pytest.mark.parametrize("label", [lambda i: i + 1, lambda i: 2**62 + 5 * i - i % 3, lambda i: 900 - i])
def test_vertices_are_held_by_the_numbers_that_the_file_gives_them(label, tmp_path):
    side = 9
    dice = np.random.default_rng(3)
    points = [(x + s * (0 < x < side - 1 and 0 < y < side - 1), y, i) for i, (x, y, s) in
              enumerate((i % side, i // side, dice.uniform(-0.3, 0.3)) for i in range(side**2))]
    corners = [a for a in range(side * (side - 1)) if a % side < side - 1]
    cells = [c for a in corners for c in ((a, a + 1, a + side + 1), (a, a + side + 1, a + side))]
    path = tmp_path / "labelled.inp"
    path.write_text("*NODE\n" + "".join(f"{label(i)}, {x}, {y}, 0.\n" for x, y, i in points) +
                    "*ELEMENT, TYPE=CPS3\n" + "".join(f"{n + 1}, " + ", ".join(str(label(v)) for v in c) + "\n"
                                                      for n, c in enumerate(cells)))  # fmt: skip
    held = [20, 40, 41, 60]

    def moved(**options):
        mesh = trismooth.read(path)
        before = mesh.points
        mesh.smooth(method="mean-ratio", **options)
        return np.any(mesh.points != before, axis=1)

    assert moved()[held].all()
    for labels in ([label(i) for i in held], np.array([label(i) for i in held], np.uint64)):
        assert not moved(fixed_labels=labels)[held].any()
        np.testing.assert_array_equal(moved(fixed_labels=labels), moved(fixed=held))
    np.testing.assert_array_equal(moved(fixed_labels=[]), moved())
    with pytest.raises(ValueError, match="^fixed_labels: names the vertex 77777, and no point"):
        moved(fixed_labels=[77777])
    with pytest.raises(TypeError, match="^fixed_labels: expected whole numbers"):
        moved(fixed_labels=[1.0])
    with pytest.raises(ValueError, match="^fixed_labels: 9223372036854775808 is beyond"):
        moved(fixed_labels=np.array([2**63], np.uint64))
    path = tmp_path / "labelled.mesh"
    path.write_text(f"MeshVersionFormatted 2\nDimension 2\nVertices {len(points)}\n" +
                    "".join(f"{x} {y} {7 if i in held else 0}\n" for x, y, i in points) + f"Triangles {len(cells)}\n" +
                    "".join(" ".join(str(v + 1) for v in c) + " 0\n" for c in cells) + "End\n")  # fmt: skip
    np.testing.assert_array_equal(moved(fixed_sets="medit:ref=7"), moved(fixed=held, fixed_sets="none"))
    with pytest.raises(ValueError, match="'medit:ref' has: 0, 7"):
        moved(fixed_sets=["medit:ref=8"])
    trismooth.read(path).write(tmp_path / "unlabelled.off")
    with pytest.raises(ValueError, match="^fixed_labels: a file of OFF gives its points no numbers .* fixed takes"):
        trismooth.read(tmp_path / "unlabelled.off").smooth(fixed_labels=[1])


def test_what_does_not_fit_is_an_exception_and_leaves_the_mesh(msh):
    mesh = trismooth.read(msh)
    before = mesh.points
    with pytest.raises(ValueError, match="no cell array 'steel'"):
        mesh.smooth(regions="steel")
    with pytest.raises(ValueError, match="^fixed: vertex 9999"):
        mesh.smooth(fixed=[9999])
    with pytest.raises(TypeError, match="'iterations' is no option"):
        mesh.smooth(iterations=3)
    with pytest.raises(TypeError, match="'fixed_set' is no option .did you mean 'fixed_sets'"):
        mesh.smooth(fixed_set="iron")
    for names in ("iron", ["iron", "air"], np.array([b"iron"])):
        with pytest.raises(TypeError, match="^fixed: takes flags or numbers .* names: fixed_sets="):
            mesh.smooth(fixed=names)
    with pytest.raises(TypeError, match="^regions: "):
        mesh.smooth(regions=3)
    with pytest.raises(ValueError, match="choice of fields"):
        mesh.smooth(fields="move")
    with pytest.raises(trismooth.Cancelled):
        mesh.smooth(progress=lambda sweep: False)
    np.testing.assert_array_equal(mesh.points, before)


def test_names_that_are_no_utf8_go_through(tmp_path):
    path = tmp_path / "latin.vtk"
    path.write_bytes(
        b"# vtk DataFile Version 3.0\nm\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 double\n0 0 0 1 0 0 1 1 0 0 1 0 .9 .8 0\n"
        b"CELLS 4 16\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\nCELL_TYPES 4\n5 5 5 5\nCELL_DATA 4\n"
        b"SCALARS mat\xe9rial int 1\nLOOKUP_TABLE default\n1 1 1 1\n"
    )
    mesh = trismooth.read(path)
    (name,) = mesh.cell_data
    assert name.encode("utf-8", "surrogateescape") == b"mat\xe9rial"
    assert mesh.smooth(regions=name).moved == 1
    assert any("mat" in loss for loss in mesh.write(tmp_path / "out.off"))
    odd = tmp_path / os.fsdecode(b"\xe9.vtk")
    mesh.write(odd)
    assert trismooth.read(odd).path == str(odd)
    run = subprocess.run([sys.executable, "-m", "trismooth", "quality", odd], capture_output=True)
    assert run.returncode == 0


def test_a_mesh_inside_its_own_progress_is_an_error(msh):
    mesh = trismooth.read(msh)
    before = mesh.points
    with pytest.raises(RuntimeError, match="the mesh is at work"):
        mesh.smooth(progress=lambda _: mesh.points)
    np.testing.assert_array_equal(mesh.points, before)


def test_arguments_of_the_wrong_type_are_named(msh):
    mesh = trismooth.read(msh)
    for name in ("fixed_array", "size", "fields", "project", "geographic"):
        with pytest.raises(TypeError, match=f"^{name}: "):
            mesh.smooth(**{name: 5})
    for call in (lambda: trismooth.read(msh, format=5), lambda: mesh.write("x.msh", format=5)):
        with pytest.raises(TypeError, match="^format: "):
            call()
    for call in (lambda: trismooth.read(msh, threads="1"), lambda: mesh.quality(threads=1.5)):
        with pytest.raises(TypeError, match="^threads: "):
            call()


def test_files_that_cannot_be_read_or_written(tmp_path, msh):
    with pytest.raises(FileNotFoundError, match="none.msh"):
        trismooth.read(tmp_path / "none.msh")
    with pytest.raises(OSError, match="directory|folder|read"):
        trismooth.read(tmp_path)
    broken = tmp_path / "broken.off"
    broken.write_text("OFF\n3 1 0\n0 0 0\n1 0 zero\n0 1 0\n3 0 1 2\n")
    with pytest.raises(trismooth.ReadError, match="broken.off:4"):
        trismooth.read(broken)
    assert issubclass(trismooth.ReadError, OSError) and issubclass(trismooth.WriteError, OSError)
    mesh = trismooth.read(msh)
    with pytest.raises(trismooth.WriteError, match="nowhere"):
        mesh.write(tmp_path / "nowhere" / "out.msh")
    with pytest.raises(OSError, match="extension"):
        mesh.write(tmp_path / "out.xyz")
    with pytest.raises(ValueError, match="^format: unknown format 'xyz'"):
        trismooth.read(msh, format="xyz")


def test_a_mesh_that_is_not_planar_is_refused(tmp_path):
    path = tmp_path / "tent.off"
    path.write_text("OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 1\n0 1 0\n3 0 1 2\n3 0 2 3\n")
    mesh = trismooth.read(path)
    with pytest.raises(trismooth.ReadError, match="plane"):
        mesh.smooth()
    assert mesh.smooth(project="xy").moved == 0


def test_the_module_is_the_program(msh, tmp_path):
    command = [sys.executable, "-m", "trismooth"]
    done = subprocess.run([*command, "smooth", msh, tmp_path / "out.msh"], capture_output=True, text=True)
    expected = run_program("smooth", msh, tmp_path / "program.msh")
    assert done.returncode == expected.returncode == 0
    assert (tmp_path / "out.msh").read_bytes() == (tmp_path / "program.msh").read_bytes()
    assert "vertices moved" in done.stdout
    assert subprocess.run([*command, "smooth", msh], capture_output=True).returncode == 2
    assert subprocess.run([*command, "quality", "none.msh"], capture_output=True).returncode == 3
    gate = subprocess.run([*command, "quality", msh, "--require", "min_shape>=0.99"], capture_output=True)
    assert gate.returncode == 1
    assert subprocess.run([*command, "--version"], capture_output=True, text=True).stdout.strip().endswith(trismooth.__version__)


def test_the_module_ends_at_once_at_ctrl_c(tmp_path):
    fifo = tmp_path / "mesh.off"
    os.mkfifo(fifo)
    process = subprocess.Popen(
        [sys.executable, "-m", "trismooth", "quality", fifo],
        stderr=subprocess.PIPE,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # ignored in the background of a script
    )
    with open(fifo, "w", encoding="ascii"):
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        assert process.wait(20) == 130


def _soup(path):
    """A grid of 6 by 8 squares whose triangles have corners of their own."""
    points, triangles = grid(6, 8)
    return off_file(path, points[triangles].reshape(-1, 2), np.arange(triangles.size).reshape(-1, 3))


def test_corners_in_one_place_are_joined_as_the_note_says(tmp_path):
    mesh = trismooth.read(_soup(tmp_path / "soup.off"))
    with pytest.warns(trismooth.MeshWarning, match="lie where others do; merge=0 joins them"):
        assert mesh.smooth().moved == 0
    assert mesh.smooth(merge=0).free_vertices == 5 * 7
    assert np.allclose(mesh.points[:, :2], trismooth.smooth(*grid(6, 8)).points[grid(6, 8)[1]].reshape(-1, 2), atol=1e-9)
    for bad, kind in ((-1.0, ValueError), (float("nan"), ValueError), ("0", TypeError), (True, TypeError)):
        with pytest.raises(kind, match="^merge: "):
            mesh.smooth(merge=bad)


def test_notes_of_files_name_arguments_of_python(tmp_path):
    mesh = trismooth.read(_soup(tmp_path / "soup.off"))
    with pytest.warns(trismooth.MeshWarning) as caught:
        result = mesh.smooth(power=2)
    assert "the method smart takes no notice of power; method='mean-ratio' does" in result.notes
    assert result.warnings and set(result.warnings) <= set(result.notes)
    assert [str(warning.message) for warning in caught] == result.notes
    assert not any("--" in note for note in result.notes)
    space = grid(3, 3)[0]
    path = off_file(tmp_path / "bent.off", *grid(3, 3))
    path.write_text(path.read_text().replace(f"{float(space[5][0])!r} {float(space[5][1])!r} 0", "1.1 1.1 5"))
    with pytest.raises(trismooth.ReadError, match="project='xy'"):
        trismooth.read(path).smooth()
