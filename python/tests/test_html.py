# SPDX-License-Identifier: BSD-3-Clause
"""What Jupyter shows of results."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ElementTree
from types import SimpleNamespace

import numpy as np
import pytest
from conftest import grid

import trismooth
from trismooth._html import _distinct, _number, _percent, result_html


def parse(html):
    return ElementTree.fromstring(html)


def text_of(html):
    root = parse(html)
    root.remove(root.find("style"))
    return " ".join(" ".join(root.itertext()).split())


def bars(html, series):
    """The counts of a series, by the names of the bars."""
    titles = [bar.find("title").text for bar in parse(html).iter("rect") if bar.get("class") == series]
    return {title.split(":")[0].split(",")[0]: int(title.split(": ")[1].replace(",", "")) for title in titles}


@pytest.fixture
def result(mesh):
    return trismooth.smooth(*mesh)


def test_lead_says_what_happened(result):
    text = text_of(result._repr_html_())
    assert text.startswith(f"{result.moved} of {result.free_vertices} free vertices moved in {result.sweeps} sweeps; ")
    assert "No triangle is inverted." in text


def test_vertices_that_slid_are_not_among_the_free_ones(mesh):
    points, triangles = mesh
    lower = points[:, 1] == 0
    points[lower, 0] = 12 * (points[lower, 0] / 12) ** 1.1
    result = trismooth.smooth(points, triangles, slide="straight", max_sweeps=20)
    slid, vertices = result.sliding.slid, result.sliding.vertices
    assert 0 < slid < result.moved and vertices == 2 * (11 + 8)
    free = result.moved - slid
    assert free <= result.free_vertices
    text = text_of(result._repr_html_())
    sentence = f"{free} of {result.free_vertices} free vertices moved, and {slid} of {vertices} on lines slid, in 20 sweeps; "
    assert text.startswith(sentence)
    assert ". Lines are where they were. " in text


def test_vertices_that_alone_slid_are_told():
    points, triangles = grid(6, 1)
    points[1:6, 0] += 0.3
    result = trismooth.smooth(points, triangles, slide="straight", method="mean-ratio")
    text = text_of(result._repr_html_())
    assert text.startswith("0 of 0 free vertices moved, and 10 of 10 on lines slid, in ")
    bent = trismooth.smooth([[0, 0], [1.7, -0.1], [2, 0], [2, 1], [1, 1], [0, 1]], [[0, 1, 5], [1, 4, 5], [1, 3, 4], [1, 2, 3]], slide="curves", deviation=0.1)
    assert f"Lines are up to {bent.sliding.largest_deviation:.3g} from where they were, " in text_of(bent._repr_html_())


def test_where_none_can_slide_that_is_told(mesh):
    points, triangles = mesh
    is_held = (points[:, 0] % 12 == 0) | (points[:, 1] % 9 == 0)
    result = trismooth.smooth(points, triangles, slide="curves", fixed=is_held)
    text = text_of(result._repr_html_())
    assert " free vertices moved in " in text
    assert ". No vertex of a boundary or an interface can slide. " in text


def test_cards_have_the_figures_before_and_after(result):
    text = text_of(result._repr_html_())
    before, after = result.before["shape"], result.after["shape"]
    assert f"Smallest shape better {before.min:.5f} → {after.min:.5f}" in text
    assert f"Mean shape better {before.mean:.5f} → {after.mean:.5f}" in text
    assert f"{result.after['min_angle'].min:.3f}°" in text
    assert f"{result.after['max_angle'].max:.3f}°" in text
    assert "Inverted triangles same 0 → 0 of 216; 0 degenerate" in text
    assert " ms " in text


def test_histogram_has_all_triangles(result):
    html = result._repr_html_()
    assert sum(bars(html, "before").values()) == sum(bars(html, "after").values()) == 216
    expected = {f"{i / 20:.2f} to {(i + 1) / 20:.2f}": n for i, n in enumerate(result.after.histogram) if n > 0}
    assert bars(html, "after") == expected


def test_inverted_triangles_stand_out():
    points, triangles = grid(12, 9, shift=0.9)
    # One sweep without untangling leaves some of them.
    result = trismooth.smooth(points, triangles, method="smart", max_sweeps=1)
    assert 0 < result.after.inverted < result.before.inverted
    html = result._repr_html_()
    assert f"{result.after.inverted} of 216 triangles are inverted." in text_of(html)
    assert f"Inverted triangles better {result.before.inverted} → {result.after.inverted} of 216" in text_of(html)
    assert bars(html, "before")["inverted"] == result.before.inverted
    assert any(part.get("class") == "lead bad" for part in parse(html).iter("div"))


def test_unchanged_mesh_is_called_the_same():
    points, triangles = grid(3, 3, shift=0)
    result = trismooth.smooth(points, triangles, fixed=np.ones(len(points), dtype=bool))
    text = text_of(result._repr_html_())
    assert "No vertex could be improved" in text
    assert "Smallest shape same" in text
    assert "better" not in text


def test_without_quality_there_is_the_outcome(mesh):
    points, triangles = mesh
    result = trismooth.smooth(points, triangles, out=points)
    text = text_of(result._repr_html_())
    assert "free vertices moved" in text
    assert "quality=True" in text
    assert "Smallest shape" not in text


def test_quality_shows_itself(mesh):
    quality = trismooth.quality(*mesh)
    html = quality._repr_html_()
    assert text_of(html).startswith("216 triangles. No triangle is inverted.")
    assert sum(bars(html, "after").values()) == 216
    assert "→" not in html


def test_mesh_without_triangles():
    report = trismooth.quality(np.zeros((0, 2)), np.zeros((0, 3), dtype=int)).summary
    assert text_of(trismooth._quality.Quality(report, [])._repr_html_()) == "The mesh has no triangles."


def test_one_triangle_without_area():
    html = trismooth.quality([[0, 0], [1, 0], [2, 0]], [[0, 1, 2]])._repr_html_()
    assert "1 triangle. No triangle is inverted. 1 triangle is without area." in text_of(html)


def test_styles_are_for_this_element_alone(result):
    style = parse(result._repr_html_()).find("style").text
    selectors = [part.strip() for rule in re.findall(r"([^{}]+)\{", style) for part in rule.split(",")]
    assert len(selectors) > 20
    for selector in selectors:
        assert re.search(r"\.trismooth-report( |$)", selector), selector


def test_there_are_no_scripts_names_or_addresses(result):
    html = result._repr_html_()
    assert "<script" not in html
    assert "http" not in html
    # A page may show many results: an id would be there twice.
    assert not any(element.get("id") for element in parse(html).iter())


def test_texts_are_escaped():
    stand_in = SimpleNamespace(
        has_quality=False,
        moved=1,
        free_vertices=2,
        sweeps=1,
        stop_reason="<b>",
        reverted=0,
        reproducible=False,
        note="a < b & c",
        sliding=None,
        warnings=["<script>alert(1)</script>"],
        losses=[],
        timings={"smooth": 20.0},
        threads=1,
        device='<i>"GPU"</i>',
        backend="cpu",
    )
    html = result_html(stand_in)
    assert not {"b", "i", "script"} & {element.tag for element in parse(html).iter()}
    text = text_of(html)
    assert "1 of 2 free vertices moved in 1 sweep; <b>. Not reproducible." in text
    assert "a < b & c" in text
    assert '20 ms on <i>"GPU"</i>, 1 thread' in text


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.0765748, "0.07657"),
        (110.5194, "110.519"),
        (0, "0"),
        (1e-7, "1.00e-07"),
        (float("nan"), "-"),
        (float("-inf"), "-inf"),
        (-0.5, "-0.50000"),
    ],
)
def test_numbers_are_as_in_the_programs_reports(value, text):
    assert _number(value, 3 if value > 100 else 5) == text


def test_changes_are_seen():
    assert _distinct(0.5, 0.500002, 5) == ("0.50000000", "0.50000200")
    assert _distinct(0.5, 0.5, 5) == ("0.50000", "0.50000")


@pytest.mark.parametrize(
    ("fraction", "text"), [(0, "0"), (1, "100"), (0.999999, "99.99"), (1e-9, "0.01"), (0.5, "50.00")]
)
def test_only_all_are_a_hundred_percent(fraction, text):
    assert _percent(fraction) == text
