#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws a part of an example mesh, coloured by shape, before and after smoothing: before.svg, after.svg (method smart) and
mean_ratio.svg in docs/images; and how often which shape is there in the whole mesh: shape_histograms.svg.

    docs/make_pictures.py [PROGRAM]    PROGRAM is trismooth, by default that of build/release

Python 3 and its standard library suffice.
"""

import base64
import math
import pathlib
import struct
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parent.parent
MESH = ROOT / "examples/data/machine.vtu"
WINDOW = (62.0, 32.0, 87.0, 57.0)  # of the mesh, in its unit
SIZE = 440  # of the picture, in pixels
FORMATS = {"Int32": "i", "Int64": "q", "UInt8": "B", "Float32": "f", "Float64": "d"}
# From the worst shape to the best: red to blue, which all readers can tell apart.
COLOURS = [
    (0.0, (178, 24, 43)),
    (0.5, (239, 138, 98)),
    (0.75, (253, 219, 199)),
    (0.9, (222, 238, 246)),
    (1.0, (146, 197, 222)),
]


def read_vtu(path):
    """The points, triangles and regions of a VTU file of base64 arrays with 32-bit block sizes."""
    arrays = {}
    for element in xml.etree.ElementTree.parse(path).iter("DataArray"):
        data = base64.b64decode("".join(element.text.split()))[4:]
        kind = FORMATS[element.get("type")]
        arrays[element.get("Name") or "points"] = [value for value, in struct.iter_unpack("<" + kind, data)]
    xyz = next(values for name, values in arrays.items() if name.lower() == "points")
    corners = arrays["connectivity"]
    points = list(zip(xyz[0::3], xyz[1::3]))
    return points, list(zip(corners[0::3], corners[1::3], corners[2::3])), arrays["region"]


def shape(a, b, c):
    """The Lee-Lo quality: 1 for an equilateral triangle, 0 for a flat one."""
    cross = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    squares = sum((p[0] - q[0]) ** 2 + (p[1] - q[1]) ** 2 for p, q in ((a, b), (b, c), (c, a)))
    return 2 * math.sqrt(3) * cross / squares


def colour(value):
    for (low, one), (high, other) in zip(COLOURS, COLOURS[1:]):
        if value <= high:
            part = (max(value, low) - low) / (high - low)
            return "#%02x%02x%02x" % tuple(round(p + part * (q - p)) for p, q in zip(one, other))
    return "#%02x%02x%02x" % COLOURS[-1][1]


def interfaces(triangles, regions):
    """The edges between two regions."""
    seen = {}
    for triangle, region in zip(triangles, regions):
        for i in range(3):
            edge = tuple(sorted((triangle[i], triangle[(i + 1) % 3])))
            seen.setdefault(edge, []).append(region)
    return [edge for edge, around in seen.items() if len(around) == 2 and around[0] != around[1]]


def draw(mesh, title):
    points, triangles, regions = mesh
    left, bottom, right, top = WINDOW
    scale = SIZE / (right - left)
    pixels = [((x - left) * scale, (top - y) * scale) for x, y in points]
    shapes = [shape(*(points[v] for v in triangle)) for triangle in triangles]

    def shown(vertices):
        xs, ys = zip(*(pixels[v] for v in vertices))
        return max(xs) > 0 and min(xs) < SIZE and max(ys) > 0 and min(ys) < SIZE

    def place(v):
        return "%.1f %.1f" % pixels[v]

    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {SIZE} {SIZE}" width="{SIZE}" height="{SIZE}">',
        f"<title>{title}</title>",
        f'<rect width="{SIZE}" height="{SIZE}" fill="#ffffff"/>',
        '<g stroke="#5b6770" stroke-width=".6" stroke-linejoin="round">',
    ]
    for triangle, value in zip(triangles, shapes):
        if shown(triangle):
            a, b, c = map(place, triangle)
            lines.append(f'<path fill="{colour(value)}" d="M{a}L{b}L{c}Z"/>')
    lines.append('</g>\n<path fill="none" stroke="#111" stroke-width="2.4" stroke-linecap="round" d="')
    lines += [f"M{place(a)}L{place(b)}" for a, b in interfaces(triangles, regions) if shown((a, b))]
    lines.append('"/>\n</svg>')
    return "\n".join(lines) + "\n"


def text(x, y, words, size=12, anchor="middle", fill="#111"):
    return f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" text-anchor="{anchor}" fill="{fill}">{words}</text>'


def panel(name, shapes, left, width):
    """A histogram with a logarithmic axis: bars of 1/20, coloured as in the pictures."""
    top, bottom, most = 34, 204, 4  # pixels; the axis ends at 10^most
    unit = (bottom - top) / (most + 0.3)  # a decade; one element has a bar, too

    def height(count):
        return (math.log10(count) + 0.3) * unit if count > 0 else 0

    lines = [text(left + width / 2, 20, name, 14)]
    for decade in range(most + 1):
        y = bottom - height(10 ** decade)
        lines.append(f'<path stroke="#dde3e7" d="M{left} {y:.1f}h{width}"/>')
        lines.append(text(left - 6, y + 4, 10 ** decade, 11, "end", "#5b6770"))
    bins = 20
    counts = [0] * bins
    for value in shapes:
        counts[min(int(max(value, 0) * bins), bins - 1)] += 1
    for i, count in enumerate(counts):
        if count > 0:
            lines.append(f'<rect x="{left + i * width / bins + 0.5:.1f}" y="{bottom - height(count):.1f}" '
                         f'width="{width / bins - 1:.1f}" height="{height(count):.1f}" '
                         f'fill="{colour((i + 0.5) / bins)}" stroke="#5b6770" stroke-width=".6"/>')
    lines.append(f'<path stroke="#5b6770" d="M{left} {bottom}h{width}"/>')
    lines += [text(left + part * width, bottom + 16, f"{part:g}", 11, fill="#5b6770") for part in (0, 0.5, 1)]
    ordered = sorted(shapes)
    figures = (("smallest", ordered[0]), ("1 %", ordered[(len(ordered) + 99) // 100 - 1]),
               ("mean", math.fsum(ordered) / len(ordered)))
    for i, (figure, value) in enumerate(figures):
        lines.append(text(left + (2 * i + 1) * width / 6, bottom + 38, figure, 11, fill="#5b6770"))
        lines.append(text(left + (2 * i + 1) * width / 6, bottom + 54, f"{value:.3f}", 13))
    return lines


def draw_histograms(meshes, title):
    width, gap, height = 250, 56, 270
    size = f'{len(meshes) * (width + gap) + 12} {height}'
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {size}" width="{size.split()[0]}" height="{height}" '
        'font-family="sans-serif">',
        f"<title>{title}</title>",
        f'<rect width="{size.split()[0]}" height="{height}" fill="#ffffff"/>',
    ]
    for i, (name, (points, triangles, _)) in enumerate(meshes.items()):
        shapes = [shape(*(points[v] for v in triangle)) for triangle in triangles]
        lines += panel(name, shapes, gap + i * (width + gap), width)
    lines.append("</svg>")
    return "\n".join(lines) + "\n"


def main():
    program = sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/release/pipeline/trismooth"
    images = ROOT / "docs/images"
    meshes = {"before": read_vtu(MESH)}
    with tempfile.TemporaryDirectory() as folder:
        for method in ("smart", "mean-ratio"):
            smoothed = pathlib.Path(folder) / f"{method}.vtu"
            subprocess.run([program, "smooth", "--quiet", "--method", method, MESH, smoothed], check=True)
            meshes[method] = read_vtu(smoothed)
    names = {"before": ("before", "before smoothing"), "smart": ("after", "after smoothing"),
             "mean-ratio": ("mean_ratio", "after smoothing by the method mean-ratio")}
    for method, mesh in meshes.items():
        name, when = names[method]
        title = f"Part of {MESH.name} {when}; colour: shape, from red (bad) to blue (equilateral)"
        (images / f"{name}.svg").write_text(draw(mesh, title))
    title = f"Shapes of the triangles of {MESH.name}, numbers of triangles on a logarithmic axis"
    (images / "shape_histograms.svg").write_text(draw_histograms(meshes, title))


if __name__ == "__main__":
    main()
