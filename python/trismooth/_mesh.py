# SPDX-License-Identifier: BSD-3-Clause
"""Mesh files: read, smoothed, written back with nothing lost, as the program does it."""

from __future__ import annotations

import difflib
import json
import os
from contextlib import contextmanager
from typing import Any, Dict, Iterator, List, Optional, Sequence, Union

import numpy as np

from . import _arrays, _core
from ._core import QualityReport
from ._notes import in_python, warn_of
from ._result import Result
from ._smooth import Progress
from ._support import NO_FILES

Path = Union[str, "os.PathLike[str]"]

#: VTK's types of cells.
_TRIANGLE, _QUADRILATERAL, _QUADRATIC_TRIANGLE, _QUADRATIC_QUADRILATERAL, _BIQUADRATIC = 5, 9, 22, 23, 28


class FileResult(Result):
    """What a smoothing of a Mesh did: a Result, and what the program tells beside.

    Attributes
    ----------
    report : dict
        The program's JSON report: the input, what holds vertices, regions, options, sizes, fields, ...
    notes : list of str
        What one should know, one sentence each: the program's sentences, with arguments of Python in place of options.
        They were warnings.
    warnings, losses : list of str
        Those of the notes that the program calls warnings, and those of point arrays that could not follow the mesh.
    """

    __slots__ = ("report", "warnings", "losses", "_of_file")

    def __init__(self, outcome: Any, mesh: Mesh, report: Dict[str, Any]) -> None:
        kinds = [mesh.triangles, mesh.quadratic_triangles]
        if report["input"]["quadrilaterals"] > 0:
            kinds += [mesh.quadrilaterals, mesh.quadratic_quadrilaterals]
        super().__init__(outcome.outcome, mesh.points, _in_one_array([nodes for nodes in kinds if len(nodes) > 0]))
        self.mesh = mesh
        self.report = report
        self._of_file = outcome
        self.notes = _said(outcome)
        self.warnings: List[str] = [in_python(warning) for warning in outcome.warnings]
        self.losses: List[str] = [in_python(loss) for loss in outcome.losses]


    def _page(self, title: str, regions: Any, fixed: Any, threads: int) -> str:
        """What the program shows: also the mesh before, its regions, and what held vertices."""
        if regions is None and fixed is None:
            page: str = self._of_file.page(title, threads)
            return page
        return super()._page(title, regions, fixed, threads)


def _in_one_array(kinds: List[np.ndarray]) -> np.ndarray:
    """Elements of several numbers of nodes, as :func:`trismooth.smooth` takes them."""
    if not kinds:
        return np.empty((0, 3), dtype=np.int32)
    most = max(nodes.shape[1] for nodes in kinds)
    columns = most if len(kinds) == 1 or most <= 4 else 9
    padded = [np.pad(nodes, ((0, 0), (0, columns - nodes.shape[1])), constant_values=-1) for nodes in kinds]
    return np.vstack(padded)


def _said(outcome: Any) -> List[str]:
    return [in_python(sentence) for sentence in (*outcome.notes, *outcome.warnings, *outcome.losses)]


@contextmanager
def _errors_in_python() -> Iterator[None]:
    try:
        yield
    except (_core.ReadError, _core.MeshError, ValueError) as error:
        said = in_python(str(error))
        if said == str(error) or type(error) not in (_core.ReadError, _core.MeshError, ValueError):
            raise
        raise type(error)(said) from None


class Mesh:
    """A mesh that was read from a file, with all that the file holds. Made by :func:`trismooth.read`.

    Regions, fixed vertices, planes, quadratic elements and fields are found as the program finds them: see
    docs/command_line.md.
    """

    __slots__ = ("_mesh",)

    def __init__(self, path: Path, format: Optional[str] = None, threads: int = 0) -> None:
        if not _core.has_files:
            raise RuntimeError(NO_FILES)
        path = os.fspath(path)
        if path != "-":
            os.stat(path)  # a file that is not there is FileNotFoundError, as everywhere in Python
        self._mesh = _core.FileMesh(path, format, threads)

    @property
    def path(self) -> str:
        """The file that it was read from."""
        return self._mesh.path

    @property
    def format(self) -> str:
        """The file's format: "msh", "vtu", ..."""
        return self._mesh.format

    @property
    def points(self) -> np.ndarray:
        """A copy of the coordinates, float64 of shape (N, 3). Assign an array to change them.

        Assigned numbers are rounded to float32 where the file stores them so.
        """
        return self._mesh.points

    @points.setter
    def points(self, points: Any) -> None:
        self._mesh.points = _arrays.on_host(points, "points", float)

    @property
    def triangles(self) -> np.ndarray:
        """The triangles of three nodes, int32 of shape (M, 3), in the file's order."""
        return self._mesh.cells(_TRIANGLE, 3)

    @property
    def quadratic_triangles(self) -> np.ndarray:
        """The triangles of six nodes, int32 of shape (M, 6): corners, then middles of the sides 01, 12 and 20."""
        return self._mesh.cells(_QUADRATIC_TRIANGLE, 6)

    @property
    def quadrilaterals(self) -> np.ndarray:
        """The quadrilaterals of four nodes, int32 of shape (M, 4), in the file's order."""
        return self._mesh.cells(_QUADRILATERAL, 4)

    @property
    def quadratic_quadrilaterals(self) -> np.ndarray:
        """The quadrilaterals of eight and of nine nodes, int32 of shape (M, 9): corners, then middles of the sides 01, 12,
        23 and 30, then the centre, -1 where there is none. Those of eight come first."""
        eight = self._mesh.cells(_QUADRATIC_QUADRILATERAL, 8)
        return np.vstack([np.pad(eight, ((0, 0), (0, 1)), constant_values=-1), self._mesh.cells(_BIQUADRATIC, 9)])

    @property
    def cell_types(self) -> np.ndarray:
        """VTK's type of each cell, uint8, in the file's order."""
        return self._mesh.cell_types

    @property
    def point_data(self) -> Dict[str, np.ndarray]:
        """Copies of the arrays at points, by name."""
        return self._mesh.point_data

    @property
    def cell_data(self) -> Dict[str, np.ndarray]:
        """Copies of the arrays of cells, by name: a row for each cell of any type."""
        return self._mesh.cell_data

    @property
    def notes(self) -> List[str]:
        """What the reader says of the file, one sentence each."""
        return self._mesh.notes

    def smooth(
        self,
        *,
        regions: Union[None, str, Sequence[str]] = None,
        fixed: Any = None,
        fixed_labels: Any = None,
        fixed_array: Optional[str] = None,
        fixed_sets: Union[None, str, Sequence[str]] = None,
        merge: Optional[float] = None,
        quads: str = "smooth",
        size: Optional[str] = None,
        fields: Optional[str] = None,
        field_arrays: Union[None, str, Sequence[str]] = None,
        project: Optional[str] = None,
        geographic: bool = False,
        slide: str = "off",
        method: str = "smart",
        backend: str = "auto",
        progress: Optional[Progress] = None,
        **options: Any,
    ) -> FileResult:
        """Smooths the mesh in place, as ``trismooth smooth`` does with the same options.

        Parameters
        ----------
        regions : str or list of str, optional
            Cell arrays that give regions; "none": none do. Default: those that look like it.
        fixed : array of N bools, or of vertex numbers, optional
            Vertices to hold. Numbers are rows of the file, from 0.
        fixed_labels : array of int, optional
            Vertices to hold, by the numbers that the file itself gives them: node tags of MSH, nodes of Abaqus, global
            ids of VTK, ...
        fixed_array : str, optional
            The point array whose nonzero values hold vertices. Default: "fixed", where there is one.
        fixed_sets : str or list of str, optional
            Point sets that hold vertices, and groups by their names; or "ARRAY=NUMBER": the points, and those of the
            cells, that the file gives that number, as "medit:ref=7". Default: all sets but those of areas.
        merge : float, optional
            Corners of elements that are no further apart, in the file's unit, count as one vertex: they move together,
            and the mesh keeps all of them. Default: none are joined.
        quads : {"smooth", "hold"}
            Quadrilaterals of four nodes are smoothed with the triangles, or kept with their vertices held.
        size : str, optional
            The array of sizes to aim at: edge lengths at points, or areas of cells.
        fields : {"keep", "interpolate"}, optional
            Values at points where vertices move. Default: depths and the like are interpolated.
        field_arrays : str or list of str, optional
            Patterns of the point arrays to interpolate.
        project : {"xy"}, optional
            Smooth a surface z(x, y) in x and y.
        geographic : bool
            x and y are longitude and latitude in degrees.
        slide : {"off", "straight", "curves"}
            As for :func:`trismooth.smooth`. Lines, their tags and what is periodic are those of the file;
            ``report["areas"]`` has the areas of regions before and after.
        method, backend, progress, **options
            As for :func:`trismooth.smooth`. Where ``progress`` returns False, Cancelled is raised.

        Returns
        -------
        FileResult

        Warns
        -----
        MeshWarning
            Of all that the result's notes say.

        Raises
        ------
        ReadError
            An OSError: for a mesh that is not planar, or has neither triangles nor quadrilaterals. The mesh is as it was, as it is wherever an
            exception is raised.
        """
        held = {
            "regions": regions,
            "fixed": None if fixed is None else _rows(fixed),
            "fixed_labels": None if fixed_labels is None else _labels(fixed_labels),
            "fixed_array": fixed_array,
            "fixed_sets": fixed_sets,
            "merge": merge,
            "quads": quads,
            "size": size,
            "fields": fields,
            "field_arrays": field_arrays,
            "project": project,
            "geographic": geographic,
        }
        _require_options(options, held)
        options["method"] = method
        options["backend"] = backend
        options["slide"] = slide
        report: Dict[str, Any] = {}

        def accept(outcome: Any) -> None:
            """All that may take long or raise, while the mesh is still as it was."""
            report.update(json.loads(outcome.json))
            warn_of(_said(outcome))

        with _errors_in_python():
            outcome = self._mesh.smooth(options, held, progress, accept)
        return FileResult(outcome, self, report)

    def quality(
        self, *, project: Optional[str] = None, geographic: bool = False, quads: str = "smooth", threads: int = 0
    ) -> QualityReport:
        """The quality of the mesh as it is now: what ``trismooth quality`` shows."""
        with _errors_in_python():
            outcome = self._mesh.check({"project": project, "geographic": geographic, "quads": quads}, threads)
        report = outcome.outcome.before
        assert report is not None  # a check always has it
        return report

    def write(self, path: Path, *, format: Optional[str] = None, threads: int = 0) -> List[str]:
        """Writes the mesh. In the format that was read only the coordinates that changed are other than in the file.

        Parameters
        ----------
        path : str or path
            Its extension names the format. An old file survives any failure.
        format : str, optional
            For a path whose extension names none: "off", "msh", ...

        Returns
        -------
        list of str
            What the file does not hold of the mesh, one sentence each.

        Raises
        ------
        WriteError
            An OSError.
        """
        return self._mesh.write(os.fspath(path), format, threads)

    def __repr__(self) -> str:
        return f"<trismooth.Mesh: {self.path!r}, {len(self.points)} points, {len(self.cell_types)} cells>"


def _require_options(options: Dict[str, Any], of_mesh: Dict[str, Any]) -> None:
    known = _core.option_names()
    for name in options:
        if name not in known:
            near = difflib.get_close_matches(name, [*of_mesh, *known], n=1)
            meant = f" (did you mean {near[0]!r}?)" if near else ""
            raise TypeError(f"{name!r} is no option{meant}; help(trismooth.Mesh.smooth) lists them")


def _rows(fixed: Any) -> np.ndarray:
    array = _arrays.on_host(fixed, "fixed")
    if array.dtype.kind in "US":
        raise TypeError("fixed: takes flags or numbers of vertices; groups and sets by their names: fixed_sets=[...]")
    return array


def _labels(labels: Any) -> List[int]:
    array = _arrays.on_host(labels, "fixed_labels")
    if array.ndim != 1 or (array.size > 0 and array.dtype.kind not in "iu"):
        raise TypeError(f"fixed_labels: expected whole numbers in one dimension, not {array.dtype} of shape {array.shape}")
    if array.dtype.kind == "u" and array.size > 0 and array.max() > np.iinfo(np.int64).max:
        raise ValueError(f"fixed_labels: {array.max()} is beyond 64 bits with a sign")
    numbers: List[int] = array.astype(np.int64).tolist()
    return numbers


def read(path: Path, *, format: Optional[str] = None, threads: int = 0) -> Mesh:
    """Reads a mesh file: OFF, OBJ, PLY, STL, VTK, VTU, VTP, Gmsh MSH, Medit, SU2, Abaqus, ADCIRC, 2dm, FreeFem, MFEM,
    Triangle, Nastran, UNV, XDMF, Exodus II, UGRID, MED, CGNS, SELAFIN, also compressed by gzip. Nothing is interpreted, nothing is lost.

    Parameters
    ----------
    path : str or path
        "-" is standard input.
    format : str, optional
        For a file whose extension names none.
    threads : int
        0: all. What is read does not depend on it.

    Returns
    -------
    Mesh

    Raises
    ------
    ReadError
        An OSError: for a file that is damaged or of no known format, with the place in it. FileNotFoundError for one
        that is not there.
    RuntimeError
        Where this build has no files; ``trismooth.build_info()`` says so.
    """
    return Mesh(path, format, threads)
