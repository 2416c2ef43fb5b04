# SPDX-License-Identifier: BSD-3-Clause
"""The view of a mesh in a notebook or in a browser: the one of the program's HTML report."""

from __future__ import annotations

import pathlib
import tempfile
import warnings
import webbrowser
from html import escape
from typing import TYPE_CHECKING, Any, Optional, Union

import numpy as np

from . import _arrays, _core

if TYPE_CHECKING:
    import os

    from ._result import Result

# More would make notebooks that carry the page too heavy for those who open them.
_MUCH = 5_000_000


class View:
    """A page that shows a mesh. Jupyter shows it where it is the last value of a cell.

    Attributes
    ----------
    html : str
        The page. It needs no other file and no network.
    """

    def __init__(self, html: str, height: int = 860) -> None:
        self.html = html
        self._height = height

    def save(self, file: Union[str, os.PathLike[str]]) -> pathlib.Path:
        """Write the page to a file; return its path."""
        path = pathlib.Path(file)
        path.write_text(self.html, encoding="utf-8")
        return path

    def open(self) -> pathlib.Path:
        """Open the page in the browser, as a file in the folder for such files, whose path is returned.

        Where there is no browser, a warning names the file.
        """
        folder = tempfile.mkdtemp(prefix="trismooth-")
        path = self.save(pathlib.Path(folder) / "mesh.html")
        if not webbrowser.open(path.as_uri()):
            warnings.warn(f"no browser can be opened here; the page is {path}", stacklevel=3)
        return path

    def _repr_html_(self) -> str:
        # A frame of its own: the page's names and styles do not meet the notebook's.
        return (
            f'<iframe srcdoc="{escape(self.html)}" style="width: 100%; height: {self._height}px; border: 0" '
            'sandbox="allow-scripts" allowfullscreen></iframe>'
        )

    def __repr__(self) -> str:
        return f"<trismooth.View: a page of {len(self.html):,} bytes; save(file) writes it, open() shows it>"


def _in_notebook() -> bool:
    try:
        from IPython import get_ipython
    except ImportError:
        return False
    shell: Any = get_ipython()
    return shell is not None and "IPKernelApp" in shell.config


def view(result: Result, *, regions: Any = None, fixed: Any = None, title: str = "Mesh", threads: Optional[int] = None) -> View:
    """Make the page that shows the mesh before and after. See :meth:`trismooth.Result.show`."""
    from ._support import NO_FILES

    if not _core.has_files:
        raise RuntimeError(NO_FILES)
    text = str(title).encode("utf-8", "replace").decode("utf-8")
    return View(result._page(text, regions, fixed, 0 if threads is None else threads))


def page_of_arrays(result: Result, title: str, regions: Any, fixed: Any, threads: int) -> str:
    """The page of what a result has, its points and elements."""
    from ._plot import _on_host

    def plane(points: Any) -> np.ndarray:
        return np.array(_on_host(points, "points")[:, :2], dtype=np.float64, order="C")  # a copy: others may write to it

    nodes = _on_host(result.triangles, "triangles")
    if len(nodes) == 0:
        raise ValueError("triangles: there are none to show")
    corners = nodes[:, :3] if nodes.shape[1] in (3, 6) else _arrays.element_nodes(nodes)[:, :4]
    labels, names = None, []
    if regions is not None:
        given = _on_host(regions, "regions")
        if given.shape != (len(nodes),):
            raise ValueError(f"regions: labels of shape {given.shape} for {len(nodes)} triangles")
        values, labels = np.unique(given, return_inverse=True)
        labels = labels.reshape(-1).astype(np.int32)
        names = [str(value).encode("utf-8", "replace").decode("utf-8") for value in values]
    before = None if result.input_points is None else plane(result.input_points)
    if before is None and result.moved > 0:
        warnings.warn("the view shows the mesh as it is now alone: it was smoothed in place", stacklevel=5)
    return _core.view_page(title, before, plane(result.points), np.ascontiguousarray(corners), labels, names, fixed, threads)


def show(result: Result, **options: Any) -> Optional[View]:
    """Show a result: see :meth:`trismooth.Result.show`."""
    shown = view(result, **options)
    if _in_notebook():
        if len(shown.html) > _MUCH:
            warnings.warn(
                f"the notebook grows by {len(shown.html) / 1e6:.0f} MB where the view is saved with it; "
                "result.view().open() shows it in the browser",
                stacklevel=3,
            )
        return shown
    shown.open()
    return None
