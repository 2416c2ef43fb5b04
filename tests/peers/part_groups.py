# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of other formats of which only a part is in groups, and how many triangles and lines each has."""


def squares():
    """Two squares, each cut in four by a point within, and the lines below and above."""
    points = [(0, 0), (1, 0), (2, 0), (0, 1), (1, 1), (2, 1), (0.5, 0.4), (1.5, 0.6)]
    triangles = [(corners[i], corners[(i + 1) % 4], middle)
                 for corners, middle in (((0, 1, 4, 3), 6), ((1, 2, 5, 4), 7)) for i in range(4)]
    return points, triangles, [(0, 1), (1, 2), (3, 4), (4, 5)]


def su2():
    """Markers name lines alone."""
    points, triangles, lines = squares()
    return (f"NDIME= 2\nNELEM= {len(triangles)}\n" + "".join("5 %d %d %d\n" % t for t in triangles) +
            f"NPOIN= {len(points)}\n" + "".join("%g %g\n" % p for p in points) + "NMARK= 1\nMARKER_TAG= wall\n"
            f"MARKER_ELEMS= {len(lines)}\n" + "".join("3 %d %d\n" % e for e in lines))


def medit():
    """The triangles of the left square, and two lines, have the reference 0."""
    points, triangles, lines = squares()
    return (f"MeshVersionFormatted 2\nDimension 2\nVertices\n{len(points)}\n" +
            "".join("%g %g 0\n" % p for p in points) + f"Edges\n{len(lines)}\n" +
            "".join("%d %d %d\n" % (a + 1, b + 1, 3 * (i > 1)) for i, (a, b) in enumerate(lines)) +
            f"Triangles\n{len(triangles)}\n" +
            "".join("%d %d %d %d\n" % (a + 1, b + 1, c + 1, 7 * (i > 3)) for i, (a, b, c) in enumerate(triangles)) +
            "End\n")


FILES = {"in.su2": su2, "in.mesh": medit}
TRIANGLES, LINES = 8, 4
