# SPDX-License-Identifier: BSD-3-Clause
"""Every face smooths alike where nothing is said, and says alike what is not valid."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

import trismooth
from conftest import grid
from program import hash_of, off_file, program_hash

POINTS, TRIANGLES = grid(30, 20, seed=4, shift=0.4)

# A valid fan but for its middle, which is outside; and a triangle without area beside it that nothing can move.
FOLDED = np.array([[0, 0], [4, 0], [4, 1], [1, 1], [1, 4], [0, 4], [-3, 6], [8, 0], [9, 0], [10, 0]], float)
FAN = np.array([[0, 1, 6], [1, 2, 6], [2, 3, 6], [3, 4, 6], [4, 5, 6], [5, 0, 6], [7, 8, 9]])


def in_space(points):
    return np.column_stack([points, np.zeros(len(points))])


@pytest.mark.skipif(not trismooth.build_info()["files"], reason="this build has no files")
def test_default_calls_of_program_arrays_plans_and_files_give_the_same_bits(tmp_path):
    path = off_file(tmp_path / "mesh.off", POINTS, TRIANGLES)
    expected = program_hash(path, {}, tmp_path)
    assert expected == program_hash(path, {"method": "smart"}, tmp_path)
    points = in_space(POINTS)
    assert hash_of(trismooth.smooth(points, TRIANGLES).points) == expected
    assert hash_of(trismooth.Plan(TRIANGLES, len(points)).smooth(points).points) == expected
    mesh = trismooth.read(path)
    mesh.smooth()
    assert hash_of(mesh.points) == expected


def test_default_calls_of_meshes_and_models_are_those_of_arrays():
    expected = trismooth.smooth(POINTS, TRIANGLES, method="smart").points
    np.testing.assert_array_equal(trismooth.smooth(POINTS, TRIANGLES).points, expected)
    skfem = pytest.importorskip("skfem")
    np.testing.assert_array_equal(trismooth.smooth(skfem.MeshTri1(POINTS.T, TRIANGLES.T)).mesh.p.T, expected)


def test_the_default_call_of_the_gmsh_model_is_that_of_arrays():
    gmsh = pytest.importorskip("gmsh")
    gmsh.initialize()
    try:
        gmsh.option.setNumber("General.Verbosity", 2)
        gmsh.model.occ.addDisk(0, 0, 0, 2, 1)
        gmsh.model.occ.synchronize()
        gmsh.model.mesh.generate(2)
        before = gmsh.model.mesh.getNodes()[1]
        results = []
        for options in ({}, {"method": "smart"}, {"method": "mean-ratio"}):
            results.append(trismooth.gmsh.smooth(**options).points)
            for tag, place in zip(gmsh.model.mesh.getNodes()[0], before.reshape(-1, 3)):
                gmsh.model.mesh.setNode(int(tag), place, [])
        np.testing.assert_array_equal(results[0], results[1])
        assert (results[0] != results[2]).any()
    finally:
        gmsh.finalize()


@pytest.mark.parametrize("face", ["smooth", "plan"])
def test_what_is_not_valid_is_counted_and_said(face):
    for options, mended in (({}, False), ({"untangle": True}, True), ({"method": "mean-ratio"}, True)):
        with pytest.warns(trismooth.MeshWarning, match="triangle without area") as caught:
            if face == "smooth":
                result = trismooth.smooth(FOLDED, FAN, **options)
            else:
                result = trismooth.Plan(FAN, len(FOLDED), **options).smooth(FOLDED)
        report = trismooth.quality(result.points, FAN).summary
        assert (result.inverted, result.degenerate) == (report.inverted, report.degenerate)
        assert result.degenerate == 1 and (result.inverted == 0) == mended
        (note,) = result.notes
        assert note == str(caught[0].message) and len(caught) == 1 and caught[0].filename == __file__
        assert ("untangle=True does" in note) != mended


def test_valid_meshes_are_not_warned_of():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        result = trismooth.smooth(POINTS, TRIANGLES)
    assert (result.inverted, result.degenerate, result.notes) == (0, 0, [])


def test_options_of_another_method_are_named():
    size = np.ones(len(POINTS))
    for call in (
        lambda: trismooth.smooth(POINTS, TRIANGLES, size=size, power=2),
        lambda: trismooth.Plan(TRIANGLES, len(POINTS), size=size, power=2).smooth(POINTS),
    ):
        with pytest.warns(trismooth.MeshWarning) as caught:
            result = call()
        assert result.notes == ["the method 'smart' takes no notice of size, power; method='mean-ratio' does"]
        assert [str(warning.message) for warning in caught] == result.notes
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        trismooth.smooth(POINTS, TRIANGLES, size=size, power=2, method="mean-ratio")
