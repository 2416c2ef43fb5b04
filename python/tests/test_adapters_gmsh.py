# SPDX-License-Identifier: BSD-3-Clause
"""The current model of Gmsh."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import trismooth
import trismooth.gmsh
from adapter_meshes import grid, quadratic_grid

try:
    import gmsh
except (ImportError, OSError) as error:  # OSError: a library that Gmsh needs is missing
    pytest.skip(f"no Gmsh: {error}", allow_module_level=True)

G = grid()


@pytest.fixture(autouse=True)
def session() -> Iterator[None]:
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.option.setNumber("Mesh.MeshSizeMax", 0.1)
    # Meshes as Gmsh leaves them without its own smoothing.
    gmsh.option.setNumber("Mesh.Smoothing", 0)
    gmsh.model.add("test")
    yield
    gmsh.finalize()


def coordinates() -> dict[int, bytes]:
    """The bits of the coordinates of each node, by its tag."""
    tags, places, _ = gmsh.model.mesh.getNodes()
    return {int(tag): place.tobytes() for tag, place in zip(tags, places.reshape(-1, 3))}


def moved_by(**options: Any) -> set[int]:
    before = coordinates()
    trismooth.gmsh.smooth(**{"method": "mean-ratio", **options})
    after = coordinates()
    assert after.keys() == before.keys()
    return {tag for tag in before if before[tag] != after[tag]}


def nodes_on(dimension: int, tag: int = -1) -> set[int]:
    return {int(node) for node in gmsh.model.mesh.getNodes(dimension, tag)[0]}


def nodes_of_elements(kind: int) -> set[int]:
    return {int(node) for node in gmsh.model.mesh.getElementsByType(kind)[1]}


def shake(amount: float) -> None:
    """Move all nodes inside of surfaces by up to `amount` in x and y, as a user would."""
    random = np.random.default_rng(5)
    for _, surface in gmsh.model.getEntities(2):
        tags, places, _ = gmsh.model.mesh.getNodes(2, surface)
        places = places.reshape(-1, 3)
        places[:, :2] += random.uniform(-amount, amount, (len(tags), 2))
        for tag, place in zip(tags, places):
            gmsh.model.mesh.setNode(tag, place, gmsh.model.getParametrization(2, surface, place))


def qualities(name: str = "minSICN") -> np.ndarray:
    elements = np.concatenate(gmsh.model.mesh.getElements(2)[1])
    return np.asarray(gmsh.model.mesh.getElementQualities(elements, name))


def two_squares(z: float = 0.0) -> list[int]:
    """Two squares side by side, made by OpenCASCADE."""
    occ = gmsh.model.occ
    occ.fragment([(2, occ.addRectangle(0, 0, z, 1, 1))], [(2, occ.addRectangle(1, 0, z, 1, 1))])
    occ.synchronize()
    return [tag for _, tag in gmsh.model.getEntities(2)]


def geo_square() -> int:
    """A square of Gmsh's own kernel, with a curve and a point embedded."""
    geo = gmsh.model.geo
    points = [geo.addPoint(x, y, 0) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1), (0.3, 0.3), (0.7, 0.4), (0.4, 0.8))]
    lines = [geo.addLine(points[k], points[(k + 1) % 4]) for k in range(4)]
    inner = geo.addLine(points[4], points[5])
    surface = geo.addPlaneSurface([geo.addCurveLoop(lines)])
    geo.synchronize()
    gmsh.model.mesh.embed(1, [inner], 2, surface)
    gmsh.model.mesh.embed(0, [points[6]], 2, surface)
    return int(surface)


@pytest.mark.parametrize("z", [0.0, 2.5])
def test_nodes_inside_of_surfaces_move(z: float) -> None:
    two_squares(z)
    gmsh.model.mesh.generate(2)
    shake(0.02)
    before, inside = qualities(), nodes_on(2)
    moved = moved_by()
    assert moved == inside
    assert not moved & (nodes_on(1) | nodes_on(0))
    assert qualities().min() > before.min() + 0.1
    assert qualities().mean() > before.mean() + 0.02
    assert set(gmsh.model.mesh.getNodes()[1].reshape(-1, 3)[:, 2]) == {z}


def test_quadrangles_that_repeat_a_node_are_triangles() -> None:
    def model(kind: int) -> np.ndarray:
        gmsh.clear()
        surface = gmsh.model.addDiscreteEntity(2)
        x, y = (a.ravel() for a in np.meshgrid(np.arange(6.0), np.arange(6.0)))
        inner = (x > 0) & (x < 5) & (y > 0) & (y < 5)
        x = x + 0.3 * np.sin(7 * y + x) * inner
        gmsh.model.mesh.addNodes(2, surface, np.arange(1, 37), np.column_stack([x, y, 0 * x]).ravel())
        first = (np.arange(5)[:, None] * 6 + np.arange(1, 6)).ravel()
        triangles = np.concatenate([np.column_stack(t) for t in ((first, first + 1, first + 7), (first, first + 7, first + 6))])
        cells = triangles if kind == 2 else triangles[:, [0, 1, 2, 2]]
        gmsh.model.mesh.addElementsByType(surface, kind, [], cells.ravel())
        return np.asarray(trismooth.gmsh.smooth().points)

    expected = model(2)
    with pytest.warns(trismooth.MeshWarning, match="50 quadrilaterals repeat a corner"):
        found = model(3)
    np.testing.assert_array_equal(found, expected)


def test_result() -> None:
    two_squares()
    gmsh.model.mesh.generate(2)
    shake(0.02)
    result = trismooth.gmsh.smooth(method="smart", max_sweeps=3)
    assert isinstance(result, trismooth.Result)
    assert result.sweeps <= 3
    assert result.moved > 0
    assert np.array_equal(result.points, gmsh.model.mesh.getNodes()[1].reshape(-1, 3)[:, :2])
    assert result.before.inverted == result.after.inverted == 0


def test_embedded_curves_and_points_are_held() -> None:
    geo_square()
    gmsh.model.mesh.generate(2)
    shake(0.02)
    assert len(nodes_on(1, 5)) > 2
    assert moved_by() == nodes_on(2)


@pytest.mark.parametrize("make", [two_squares, geo_square])
@pytest.mark.parametrize("order", [1, 2])
def test_parameters_are_those_of_the_new_places(make: Any, order: int) -> None:
    make()
    gmsh.model.mesh.generate(2)
    gmsh.model.mesh.setOrder(order)
    assert moved_by()
    for _, surface in gmsh.model.getEntities(2):
        tags, places, parameters = gmsh.model.mesh.getNodes(2, surface, returnParametricCoord=True)
        assert len(parameters) == 2 * len(tags) > 0
        assert np.allclose(gmsh.model.getValue(2, surface, parameters), places, rtol=0, atol=1e-12)


def test_quadratic_triangles() -> None:
    gmsh.model.occ.addDisk(0, 0, 0, 1, 0.6)
    gmsh.model.occ.synchronize()
    gmsh.option.setNumber("Mesh.MeshSizeMax", 0.3)
    gmsh.model.mesh.generate(2)
    gmsh.model.mesh.setOrder(2)
    gmsh.model.mesh.setOrder(2)
    elements = gmsh.model.mesh.getElements(2)
    assert elements[0].tolist() == [9]
    moved = moved_by()
    assert moved and moved <= nodes_on(2)
    assert qualities("minSJ").min() > 0
    # Sides between nodes inside of the disk are straight, as they were.
    place = {tag: np.frombuffer(bits) for tag, bits in coordinates().items()}
    for nodes in elements[2][0].reshape(-1, 6).tolist():
        for middle, first, second in ((3, 0, 1), (4, 1, 2), (5, 2, 0)):
            ends = place[nodes[first]], place[nodes[second]]
            if nodes[middle] in nodes_on(2):
                assert np.allclose(place[nodes[middle]], sum(ends) / 2, rtol=0, atol=1e-9)


def test_quadrangles_are_smoothed_and_their_nodes_slide() -> None:
    first, second = two_squares()
    gmsh.model.mesh.setRecombine(2, second)
    gmsh.model.mesh.generate(2)
    assert 3 in gmsh.model.mesh.getElementTypes(2)
    moved = moved_by(method="mean-ratio")
    assert moved & nodes_on(2, second)
    assert moved <= nodes_on(2, first) | nodes_on(2, second)
    curves = [tag for _, tag in gmsh.model.getEntities(1)]
    for curve in curves:
        spread(curve)
    slid = moved_by(method="mean-ratio", slide="straight")
    assert slid & nodes_of_elements(3) & set().union(*(nodes_on(1, curve) for curve in curves))
    assert not slid & nodes_on(0)


@pytest.mark.parametrize("kind, incomplete", [(10, 0), (16, 1)])
def test_quadrangles_of_second_order_are_smoothed_with_their_middles(kind: int, incomplete: int) -> None:
    first, second = two_squares()
    gmsh.option.setNumber("Mesh.SecondOrderIncomplete", incomplete)
    gmsh.model.mesh.setRecombine(2, second)
    gmsh.model.mesh.generate(2)
    gmsh.model.mesh.setOrder(2)
    elements = gmsh.model.mesh.getElementsByType(kind)[1].reshape(-1, 9 if kind == 10 else 8)
    assert len(elements) > 10
    moved = moved_by(method="mean-ratio")
    assert moved & {int(node) for node in elements[:, :4].ravel()}
    assert moved & {int(node) for node in elements[:, 4:].ravel()}
    assert moved <= nodes_on(2, first) | nodes_on(2, second)


TAGS = 1000 + 7 * np.random.default_rng(11).permutation(len(G.points))


def discrete_grid(quadratic: bool = False) -> None:
    """The grid as two discrete surfaces without curves. Nodes between them are of the first."""
    q = quadratic_grid()
    points, triangles = (q.points, q.triangles) if quadratic else (G.points, G.triangles)
    tags = np.concatenate([TAGS, 50000 - np.arange(len(points) - len(TAGS))])
    owner = np.full(len(points), 9)
    owner[np.unique(triangles[G.regions == 1])] = 7
    for surface in (7, 9):
        gmsh.model.addDiscreteEntity(2, surface)
        of_surface = owner == surface
        places = np.column_stack([points[of_surface], np.zeros(of_surface.sum())])
        gmsh.model.mesh.addNodes(2, surface, tags[of_surface], places.ravel())
    for surface, region in ((7, 1), (9, 2)):
        cells = tags[triangles[G.regions == region]]
        gmsh.model.mesh.addElementsByType(surface, 9 if quadratic else 2, [], cells.ravel())


def test_discrete_surfaces_are_regions() -> None:
    discrete_grid()
    assert moved_by() == set(TAGS[G.is_inside])


def test_discrete_quadratic_triangles() -> None:
    discrete_grid(quadratic=True)
    moved = moved_by()
    assert moved & set(TAGS) == set(TAGS[G.is_inside])
    assert qualities("minSJ").min() > 0


def test_fixed_nodes() -> None:
    discrete_grid()
    fixed = TAGS[G.is_inside][[3, 5]]
    assert moved_by(fixed=fixed) == set(TAGS[G.is_inside]) - set(fixed)
    assert moved_by(fixed=[]) >= set(fixed)


def test_lines_between_nodes_of_surfaces_are_held() -> None:
    discrete_grid()
    ends = TAGS[[G.vertex(2, 3), G.vertex(3, 4)]]
    gmsh.model.addDiscreteEntity(1, 3)
    gmsh.model.mesh.addElementsByType(3, 1, [], ends)
    assert moved_by() == set(TAGS[G.is_inside]) - set(ends)


def test_quadrangle_among_triangles_is_held() -> None:
    discrete_grid()
    corners = TAGS[[G.vertex(2, 3), G.vertex(3, 3), G.vertex(3, 4), G.vertex(2, 4)]]
    gmsh.model.mesh.addElementsByType(7, 3, [], corners)
    assert moved_by() == set(TAGS[G.is_inside]) - set(corners)


def on_line(nodes: set[int], axis: int) -> np.ndarray:
    """Coordinates of these nodes along an axis."""
    place = coordinates()
    return np.array([np.frombuffer(place[node])[axis] for node in sorted(nodes)])


def spread(curve: int) -> None:
    """Move the nodes inside of a curve along it, to uneven distances."""
    tags, _, parameters = gmsh.model.mesh.getNodes(1, curve, returnParametricCoord=True)
    (low,), (high,) = gmsh.model.getParametrizationBounds(1, curve)
    for tag, parameter in zip(tags, parameters):
        t = (parameter - low) / (high - low)
        parameter = low + (high - low) * (t + 0.12 * np.sin(6 * t))
        if low < parameter < high:
            gmsh.model.mesh.setNode(tag, gmsh.model.getValue(1, curve, [parameter]), [parameter])


def test_nodes_of_curves_slide_where_that_is_wanted() -> None:
    two_squares()
    gmsh.model.mesh.generate(2)
    shake(0.02)
    (between,) = (tag for _, tag in gmsh.model.getEntities(1) if len(gmsh.model.getAdjacencies(1, tag)[0]) == 2)
    spread(between)
    before = coordinates()
    result = trismooth.gmsh.smooth(slide="straight", method="mean-ratio")
    moved = {node for node, bits in coordinates().items() if bits != before[node]}
    assert moved & nodes_on(1, between) and not moved & nodes_on(0)
    assert np.array_equal(on_line(nodes_on(1, between), 0), np.full(len(nodes_on(1, between)), 1.0))
    assert (result.sliding.lines, result.sliding.slid) == (7, len(moved & nodes_on(1)))
    tags, places, parameters = gmsh.model.mesh.getNodes(1, between, returnParametricCoord=True)
    assert np.allclose(gmsh.model.getValue(1, between, parameters), places, rtol=0, atol=1e-12)


def test_nodes_of_embedded_curves_and_circles_slide() -> None:
    geo_square()
    gmsh.model.mesh.generate(2)
    shake(0.02)
    spread(5)
    moved = moved_by(slide="straight")
    assert moved & nodes_on(1, 5) and not moved & nodes_on(0)
    gmsh.model.add("disk")
    gmsh.model.occ.addDisk(0, 0, 0, 1, 1)
    gmsh.model.occ.synchronize()
    gmsh.model.mesh.generate(2)
    spread(1)
    assert not moved_by(slide="straight") & nodes_on(1)
    before = coordinates()
    result = trismooth.gmsh.smooth(slide="curves", deviation=0.05, method="mean-ratio")
    assert 0 < result.sliding.relative_deviation <= 0.05
    assert not {node for node, bits in coordinates().items() if bits != before[node]} & nodes_on(0)
    tags, places, parameters = gmsh.model.mesh.getNodes(1, 1, returnParametricCoord=True)
    assert np.allclose(gmsh.model.getValue(1, 1, parameters), places, rtol=0, atol=0.01)


def test_periodic_curves_slide_as_one() -> None:
    surface = gmsh.model.occ.addRectangle(0, 0, 0, 1, 1)
    gmsh.model.occ.synchronize()
    lower, right, upper, left = (abs(tag) for _, tag in gmsh.model.getBoundary([(2, surface)]))
    gmsh.model.mesh.setPeriodic(1, [right], [left], [1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1])
    gmsh.option.setNumber("Mesh.MeshSizeMax", 0.15)
    gmsh.model.mesh.setTransfiniteCurve(left, 9, "Progression", 1.3)
    gmsh.model.mesh.generate(2)
    before = on_line(nodes_on(1, left), 1)
    moved = moved_by(slide="straight")
    assert moved & nodes_on(1, left)
    _, here, there, _ = gmsh.model.mesh.getPeriodicNodes(1, right)
    assert len(here) >= 7
    place = coordinates()
    for first, second in zip(here, there):
        assert np.frombuffer(place[first])[1] == np.frombuffer(place[second])[1]
    assert (on_line(nodes_on(1, left), 1) != before).any()


def test_fixed_nodes_of_curves_and_discrete_surfaces() -> None:
    two_squares()
    gmsh.model.mesh.generate(2)
    for _, curve in gmsh.model.getEntities(1):
        spread(curve)
    fixed = sorted(nodes_on(1))[::2]
    moved = moved_by(slide="straight", fixed=fixed)
    assert not moved & set(fixed) and moved & nodes_on(1)
    gmsh.model.add("discrete")
    discrete_grid()
    ends = TAGS[[G.vertex(2, 3), G.vertex(3, 4)]]
    gmsh.model.addDiscreteEntity(1, 3)
    gmsh.model.mesh.addElementsByType(3, 1, [], ends)
    moved = moved_by(slide="straight")
    assert moved & set(TAGS[G.is_interface]) and not moved & set(ends)


def test_periodic_surfaces_are_held() -> None:
    occ = gmsh.model.occ
    surfaces = [occ.addRectangle(x, 0, 0, 1, 1) for x in (0, 3, 6)]
    occ.synchronize()
    shift = [1, 0, 0, 3, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
    gmsh.model.mesh.setPeriodic(2, [surfaces[1]], [surfaces[0]], shift)
    gmsh.model.mesh.generate(2)
    assert moved_by() == nodes_on(2, surfaces[2])


def test_model_can_be_written_and_read(tmp_path: Path) -> None:
    two_squares()
    gmsh.model.addPhysicalGroup(2, [1], 5, "first")
    gmsh.model.mesh.generate(2)
    shake(0.02)
    moved_by()
    gmsh.option.setNumber("Mesh.SaveAll", 1)
    gmsh.option.setNumber("Mesh.Binary", 1)
    gmsh.write(str(tmp_path / "new.msh"))
    expected = coordinates()
    gmsh.open(str(tmp_path / "new.msh"))
    assert coordinates() == expected
    assert gmsh.model.getPhysicalName(2, 5) == "first"
    assert trismooth.gmsh.smooth().after.inverted == 0


def test_faults() -> None:
    with pytest.raises(ValueError, match="the model has no triangles"):
        trismooth.gmsh.smooth()
    gmsh.model.occ.addSphere(0, 0, 0, 1)
    gmsh.model.occ.synchronize()
    gmsh.option.setNumber("Mesh.MeshSizeMax", 0.5)
    gmsh.model.mesh.generate(2)
    before = coordinates()
    with pytest.raises(ValueError, match="do not lie in one plane z = const: z goes from -1 to 1"):
        trismooth.gmsh.smooth()
    assert coordinates() == before


def test_faults_name_the_argument() -> None:
    discrete_grid()
    before = coordinates()
    with pytest.raises(ValueError, match="^fixed: the model has no node 1001"):
        trismooth.gmsh.smooth(fixed=[1000, 1001])
    with pytest.raises(TypeError, match="^fixed: expected tags of nodes"):
        trismooth.gmsh.smooth(fixed=[True, False])
    with pytest.raises(TypeError, match="^regions: "):
        trismooth.gmsh.smooth(regions="physical")
    with pytest.raises(TypeError, match="^lines: "):
        trismooth.gmsh.smooth(slide="straight", lines=[[0, 1]])
    with pytest.raises(ValueError, match="^slide: "):
        trismooth.gmsh.smooth(slide="round")
    with pytest.raises(TypeError, match="^out: "):
        trismooth.gmsh.smooth(out=np.zeros((3, 2)))
    assert coordinates() == before


def test_gmsh_that_is_not_initialized() -> None:
    gmsh.finalize()
    try:
        with pytest.raises(RuntimeError, match="gmsh is not initialized"):
            trismooth.gmsh.smooth()
    finally:
        gmsh.initialize()
