# SPDX-License-Identifier: BSD-3-Clause
"""The view of a mesh: one page, which a notebook frames and a script opens."""

import html.parser
import json
import re
import webbrowser

import numpy as np
import pytest

import trismooth

HOSTILE = "</script><img src=x onerror=alert(1)>"


def square(count=6):
    """Points of a grid of squares, shaken inside, and its triangles."""
    at = np.arange(count + 1.0)
    points = np.stack(np.meshgrid(at, at), axis=-1).reshape(-1, 2)
    inside = ((points > 0) & (points < count)).all(axis=1)
    points[inside] += 0.3 * np.sin(7 * points[inside][:, ::-1] + points[inside])
    first = (np.arange(count)[:, None] * (count + 1) + np.arange(count)).reshape(-1)
    triangles = np.stack([first, first + 1, first + count + 2, first, first + count + 2, first + count + 1], axis=1)
    return points, triangles.reshape(-1, 3).astype(np.int32)


def about(page):
    """What the page's script is told."""
    return json.loads(re.search(r'id="mesh-about">(.*?)</script>', page, re.DOTALL).group(1))


class Elements(html.parser.HTMLParser):
    def __init__(self, page):
        super().__init__()
        self.names = []
        self.feed(page)

    def handle_starttag(self, tag, attrs):
        self.names.append((tag, dict(attrs)))


@pytest.fixture
def result():
    points, triangles = square()
    return trismooth.smooth(points, triangles)


def test_the_page_has_the_mesh_before_and_after(result):
    told = about(result.view().html)
    assert told["triangles"] == len(result.triangles)
    assert told["vertices"] == len(result.points)
    assert told["moved"] is True
    # The worst elements are those of the quality of the same points.
    assert told["worst"]["before"] == [worst.triangle for worst in trismooth.quality(result.input_points, result.triangles).summary.worst]
    assert told["worst"]["after"] == [worst.triangle for worst in trismooth.quality(result.points, result.triangles).summary.worst]


def test_quadrilaterals_and_triangles_are_told_apart():
    points, triangles = square()
    quads = np.array([[0, 1, 8, 7], [1, 2, 9, 8]])
    mixed = np.vstack([quads, np.pad(triangles[4:], ((0, 0), (0, 1)), constant_values=-1)])
    told = about(trismooth.smooth(points, mixed).view().html)
    assert (told["triangles"], told["quadrilaterals"]) == (len(triangles) - 4, 2)


def test_names_of_regions_stay_text(result):
    labels = np.where(np.arange(len(result.triangles)) < 30, HOSTILE, "b")
    page = result.view(regions=labels, title=HOSTILE).html
    assert about(page)["regions"] == sorted(["b", HOSTILE])
    assert not [name for name, values in Elements(page).names if "onerror" in values]


def test_labels_that_do_not_fit_are_refused(result):
    with pytest.raises(ValueError, match=r"regions: labels of shape \(3,\) for \d+ triangles"):
        result.view(regions=[1, 2, 3])


def test_arrays_that_have_changed_since_are_refused(result):
    result.triangles = np.array(result.triangles)
    result.triangles[0, 0] = 2_000_000_000
    with pytest.raises(trismooth.MeshError, match="2000000000"):
        result.view()
    result.triangles[0, 0] = 1
    result.triangles[0, 1] = 0
    result.points = np.array(result.points)
    result.points[0] = np.nan
    with pytest.raises(trismooth.MeshError, match="vertex 0 is not finite"):
        result.view()
    result.points = result.points[:5]
    with pytest.raises(ValueError, match="another number of them than the input"):
        result.view()


def test_a_script_opens_the_page_in_the_browser(result, monkeypatch):
    opened = []
    monkeypatch.setattr(webbrowser, "open", lambda address: opened.append(address) or True)
    assert result.show() is None
    (address,) = opened
    with open(address.removeprefix("file://"), encoding="utf-8") as file:
        assert file.read() == result.view().html


def test_without_a_browser_a_warning_names_the_page(result, monkeypatch):
    monkeypatch.setattr(webbrowser, "open", lambda address: False)
    with pytest.warns(UserWarning, match=r"no browser can be opened here; the page is .*mesh\.html"):
        result.show()


def test_a_notebook_frames_the_page(result):
    view = result.view()
    ((name, values),) = Elements(view._repr_html_()).names
    assert name == "iframe"
    assert values["srcdoc"] == view.html
    assert values["sandbox"] == "allow-scripts"
    # Nothing is fetched: every address of the page is in the page.
    for _, attributes in Elements(view.html).names:
        for attribute in ("src", "href"):
            assert attributes.get(attribute, "data:").startswith("data:")


def test_the_page_is_saved(result, tmp_path):
    path = result.view(title="My mesh").save(tmp_path / "mesh.html")
    assert "<title>My mesh - trismooth</title>" in path.read_text(encoding="utf-8")


def test_a_mesh_of_a_file_is_shown_before_and_after_with_its_regions_and_holds(tmp_path):
    points, triangles = square()
    labels = np.where(points[triangles].mean(axis=1)[:, 0] < 3, 7, 9)
    file = tmp_path / "a.vtk"
    with open(file, "w", encoding="ascii") as text:
        text.write(f"# vtk DataFile Version 3.0\nm\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {len(points)} double\n")
        np.savetxt(text, np.pad(points, ((0, 0), (0, 1))))
        text.write(f"CELLS {len(triangles)} {4 * len(triangles)}\n")
        np.savetxt(text, np.pad(triangles, ((0, 0), (1, 0)), constant_values=3), fmt="%d")
        text.write(f"CELL_TYPES {len(triangles)}\n" + "5\n" * len(triangles))
        text.write(f"CELL_DATA {len(triangles)}\nSCALARS material int 1\nLOOKUP_TABLE default\n")
        np.savetxt(text, labels, fmt="%d")
    mesh = trismooth.read(file)
    before = mesh.quality()
    result = mesh.smooth()
    told = about(result.view().html)
    assert told["moved"] is True
    assert [name.split("=")[-1].split()[-1] for name in told["regions"]] == ["7", "9"]
    assert told["worst"]["before"] == [worst.triangle for worst in before.worst]
    streams = {name: count for name, count, _, _ in told["streams"]}
    assert streams["interface"] == 2 * 6  # the vertices of six edges
    assert streams["held"] == len(points)
    # Other regions than the file's are the user's.
    with pytest.warns(UserWarning, match="as it is now alone: it was smoothed in place"):
        told = about(result.view(regions=np.arange(len(triangles)) % 3).html)
    assert told["regions"] == ["0", "1", "2"]


def test_the_view_of_a_mesh_that_was_smoothed_in_place_says_that_it_has_no_before():
    points, triangles = square()
    result = trismooth.smooth(points, triangles, out=points)
    with pytest.warns(UserWarning, match="as it is now alone: it was smoothed in place"):
        assert about(result.view().html)["moved"] is False
