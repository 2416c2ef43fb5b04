# SPDX-License-Identifier: BSD-3-Clause
"""Smoothing of planar finite element meshes, on the CPU and on NVIDIA GPUs.

The same bits on every backend, and never worse than the input:

    result = trismooth.smooth(points, triangles)     # arrays, or a mesh of PyVista, meshio, scikit-fem, ...
    quality = trismooth.quality(points, triangles)   # ten metrics of every triangle
    plan = trismooth.Plan(triangles, len(points))    # the same triangles again and again
    mesh = trismooth.MovingMesh(points, triangles)   # meshes that follow their boundary
    mesh = trismooth.read("in.msh")                  # files, with nothing lost
    trismooth.gmsh.smooth()                          # the current model of Gmsh
"""

from __future__ import annotations

from typing import Any

from . import adapters as adapters
from ._core import Cancelled, DeviceError, MeshError, MetricSummary, QualityReport, ReadError, SlidingResult
from ._core import SweepRecord, WorstElement, WriteError
from ._core import __version__ as __version__
from ._mesh import Mesh, read
from ._moving import FollowResult, MovingMesh
from ._notes import MeshWarning
from ._plan import Plan
from ._quality import METRICS, Quality, quality
from ._result import NotComputed, Result
from ._smooth import METHODS, smooth
from ._support import build_info

__all__ = [
    "METHODS",
    "METRICS",
    "Cancelled",
    "DeviceError",
    "FollowResult",
    "Mesh",
    "MeshError",
    "MeshWarning",
    "MetricSummary",
    "MovingMesh",
    "NotComputed",
    "Plan",
    "Quality",
    "QualityReport",
    "ReadError",
    "Result",
    "SlidingResult",
    "SweepRecord",
    "WorstElement",
    "WriteError",
    "build_info",
    "gmsh",
    "plot",
    "quality",
    "read",
    "show",
    "smooth",
]


def __getattr__(name: str) -> Any:
    # What few need, and what needs time to import, is imported when it is asked for.
    if name in ("plot", "show"):
        from . import _plot

        return getattr(_plot, name)
    if name == "gmsh":
        from importlib import import_module

        return import_module(f"{__name__}.gmsh")
    raise AttributeError(f"module '{__name__}' has no attribute '{name}'")
