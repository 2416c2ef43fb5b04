# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of meshes."""

from __future__ import annotations

import sys

import numpy as np
import pytest
from conftest import grid, mixed_mesh

import trismooth

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("Agg")
from matplotlib import pyplot as plt  # noqa: E402
from matplotlib.collections import LineCollection, PolyCollection  # noqa: E402
from matplotlib.colors import to_rgba  # noqa: E402

BLACK = to_rgba("#111111")
BEST = to_rgba("#92c5de")
WORST = to_rgba("#b2182b")
EQUILATERAL = np.array([[0, 0], [1, 0], [0.5, np.sqrt(0.75)]])


@pytest.fixture(autouse=True)
def close_figures():
    yield
    plt.close("all")


def collection(axes, kind):
    return next(found for found in axes.collections if type(found) is kind)


def colours(axes):
    return collection(axes, PolyCollection).get_facecolor()


def panels(figure):
    return [axes for axes in figure.axes if axes.get_title(loc="left") in ("before", "after")]


def texts(axes):
    return [text.get_text() for text in axes.texts]


def is_image(path):
    picture = plt.imread(path)
    return picture.shape[0] > 100 and picture.shape[1] > 100 and picture[..., :3].std() > 0.05


def test_before_and_after_are_side_by_side_above_a_histogram(mesh, tmp_path):
    result = trismooth.smooth(*mesh)
    figure = trismooth.plot(result)
    before, after = panels(figure)
    assert texts(before) == [
        f"shape: smallest {result.before['shape'].min:.4g}, mean {result.before['shape'].mean:.4g}"
    ]
    assert f"smallest {result.after['shape'].min:.4g}" in texts(after)[0]
    assert before.get_xlim() == after.get_xlim()
    assert before.get_aspect() == after.get_aspect() == 1
    histogram = next(axes for axes in figure.axes if axes.get_xlabel() == "shape")
    heights = [[bar.get_height() for bar in bars] for bars in histogram.containers]
    assert heights == [[0, *result.before.histogram], [0, *result.after.histogram]]
    figure.savefig(tmp_path / "plot.png")
    assert is_image(tmp_path / "plot.png")


def test_result_plots_itself(mesh):
    assert len(panels(trismooth.smooth(*mesh).plot())) == 2


def test_low_meshes_stand_one_above_the_other():
    figure = trismooth.plot(trismooth.smooth(*grid(40, 4)))
    before, after = panels(figure)
    assert before.get_subplotspec().colspan == after.get_subplotspec().colspan
    assert before.get_subplotspec().rowspan.start < after.get_subplotspec().rowspan.start


def test_in_place_there_is_only_after(mesh):
    points, triangles = mesh
    result = trismooth.smooth(points, triangles, out=points)
    figure = trismooth.plot(result)
    assert [axes.get_title(loc="left") for axes in panels(figure)] == ["after"]


def test_colours_are_the_same_for_all_meshes():
    assert np.allclose(colours(trismooth.show(EQUILATERAL, [[0, 1, 2]])), BEST, atol=0.01)
    flat = np.array([[0, 0], [1, 0], [0.5, 1e-6]])
    assert np.allclose(colours(trismooth.show(flat, [[0, 1, 2]])), WORST, atol=0.01)


def test_inverted_triangles_are_black_and_on_top():
    points, triangles = grid(4, 4, shift=0)
    points[12] = [2.9, 3.9]  # the middle, beyond the triangles around it
    measured = trismooth.quality(points, triangles)
    assert measured.summary.inverted > 0
    axes = trismooth.show(points, triangles)
    is_black = np.all(colours(axes) == BLACK, axis=1)
    assert is_black.sum() == measured.summary.inverted
    assert is_black[-measured.summary.inverted :].all()
    assert f"; {measured.summary.inverted} inverted" in texts(axes)[0]
    bar = axes.figure.axes[-1]
    assert "black: inverted" in bar.get_ylabel()


def test_inverted_triangles_have_a_place_in_the_histogram():
    points, triangles = grid(12, 9, shift=0.9)
    result = trismooth.smooth(points, triangles)
    assert result.before.inverted > 0
    histogram = next(axes for axes in trismooth.plot(result).axes if axes.get_xlabel() == "shape")
    assert histogram.containers[0][0].get_height() == result.before.inverted
    assert histogram.get_xlim()[0] < 0
    assert histogram.get_xticklabels()[0].get_text() == "< 0"


def test_three_coordinates_and_unused_vertices():
    points = np.vstack([np.column_stack([EQUILATERAL, np.full(3, 7.0)]), [[1000, 1000, 0]]])
    axes = trismooth.show(points, [[0, 1, 2]])
    assert axes.get_xlim()[1] < 1.1
    assert axes.get_ylim()[1] < 1


def test_quadratic_triangles_have_curved_sides():
    middles = (EQUILATERAL + np.roll(EQUILATERAL, -1, axis=0)) / 2
    middles[0] = [0.5, -0.2]
    axes = trismooth.show(np.vstack([EQUILATERAL, middles]), [[0, 1, 2, 3, 4, 5]])
    polygon = collection(axes, PolyCollection).get_paths()[0].vertices
    assert len(polygon) > 10
    # The curve goes through the middle node.
    assert np.abs(polygon - [0.5, -0.2]).max(axis=1).min() < 1e-12
    assert axes.get_ylim()[0] < -0.2


@pytest.mark.parametrize("dtype", [np.int64, np.uint32, np.uint64])
def test_quadrilaterals_have_their_four_sides_and_triangles_three(dtype):
    points, elements = mixed_mesh(jitter=0)
    axes = trismooth.show(points, elements.astype(dtype))
    polygons = [path.vertices for path in collection(axes, PolyCollection).get_paths()]
    assert len(polygons) == len(elements)
    corners = [len(np.unique(polygon.round(9), axis=0)) for polygon in polygons]
    assert (corners.count(3), corners.count(4)) == ((elements[:, 3] < 0).sum(), (elements[:, 3] >= 0).sum())
    area = sum(0.5 * abs(np.cross(p[:-1], p[1:]).sum()) for p in polygons)
    assert area == pytest.approx(12 * 9)
    assert len(collection(axes, LineCollection).get_segments()) == 2 * (12 + 9)
    result = trismooth.smooth(points, elements.astype(dtype))
    histogram = next(axes for axes in trismooth.plot(result).axes if axes.get_xlabel() == "shape")
    assert histogram.get_ylabel() == "elements"


def test_outline_is_the_boundary_and_the_borders_of_regions(mesh):
    points, triangles = mesh
    boundary = len(collection(trismooth.show(points, triangles), LineCollection).get_segments())
    assert boundary == 2 * (12 + 9)
    regions = np.where(points[triangles].mean(axis=1)[:, 0] > 6, "right", "left")
    lines = collection(trismooth.show(points, triangles, regions=regions), LineCollection).get_segments()
    # Sides of the border are there from both of their triangles.
    assert len(lines) - boundary >= 2 * 9
    trismooth.plot(trismooth.smooth(points, triangles, regions=regions), regions=regions)


def test_regions_need_a_label_for_each_triangle(mesh):
    with pytest.raises(ValueError, match="regions: 3 labels for 216 triangles"):
        trismooth.show(*mesh, regions=[1, 2, 3])


def test_window_draws_a_part_of_the_mesh(mesh):
    figure = trismooth.plot(trismooth.smooth(*mesh), window=(2, 3, 5, 6))
    for axes in panels(figure):
        assert axes.get_xlim() == (2, 5)
        assert axes.get_ylim() == (3, 6)
        assert 18 <= len(colours(axes)) < 100


def test_edges_are_thin_or_absent_in_large_meshes():
    def edges(points, triangles):
        drawn = collection(trismooth.show(points, triangles), PolyCollection)
        has_edges = np.any(drawn.get_edgecolor() != drawn.get_facecolor())
        return np.max(drawn.get_linewidth()), has_edges, drawn.get_rasterized()

    width_of_few, has_few_edges, few_are_pixels = edges(*grid(3, 2))
    width_of_many, has_many_edges, many_are_pixels = edges(*grid(250, 200))
    assert has_few_edges and not has_many_edges
    assert width_of_few > width_of_many
    assert many_are_pixels and not few_are_pixels


def test_show_draws_into_given_axes(mesh):
    figure, (left, right) = plt.subplots(1, 2)
    assert trismooth.show(*mesh, ax=right, title="mesh", colorbar=False) is right
    assert right.get_title(loc="left") == "mesh"
    assert figure.axes == [left, right]
    assert not left.collections


def test_show_takes_meshes_of_other_packages():
    meshio = pytest.importorskip("meshio")
    mesh = meshio.Mesh(EQUILATERAL, [("triangle", np.array([[0, 1, 2]]))])
    assert len(colours(trismooth.show(mesh))) == 1


def test_show_takes_lists():
    assert len(colours(trismooth.show([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]]))) == 1


def test_no_triangles_are_an_error():
    with pytest.raises(ValueError, match="triangles: there are none"):
        trismooth.show(EQUILATERAL, np.empty((0, 3), dtype=int))


def test_notebooks_show_the_figure_once(mesh, monkeypatch):
    result = trismooth.smooth(*mesh)
    monkeypatch.setattr(plt, "get_backend", lambda: "module://matplotlib_inline.backend_inline")
    figure = trismooth.plot(result)
    assert figure.number not in plt.get_fignums()


def test_without_matplotlib_the_error_says_what_to_install(mesh, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib.pyplot", None)
    with pytest.raises(ImportError, match="pip install matplotlib"):
        trismooth.show(*mesh)
    with pytest.raises(ImportError, match="pip install matplotlib"):
        trismooth.smooth(*mesh).plot()
