"""Makes small meshes in the formats with groups and names, and reads them again by the pattern that they were made from.

All but the coordinates has to be the same bytes, so that everything else is known.
"""

import re
import struct

import sample_meshes
from mesh_reader import LINE, TRIANGLE, Mesh


class Sample:
    """A file as pieces: bytes, and (vertex, axis, code) for a coordinate, as text where the code is empty."""

    def __init__(self, extension, regions=True):
        self.extension = extension
        self.grid = sample_meshes.Grid()
        self.lines = []  # cells behind the triangles
        self.has_regions = regions
        self.pieces = []

    def add(self, *pieces):
        self.pieces += [piece.encode() if isinstance(piece, str) else piece for piece in pieces]
        return self

    def pack(self, code, *values):
        return self.add(struct.pack(code, *values))

    def coordinates(self, vertex, axes=2, code="", separator=" "):
        for axis in range(axes):
            self.add(*([separator] if axis and not code else []), (vertex, axis, code))
        return self

    def points(self):
        return range(len(self.grid.points))

    def cells(self):
        """(number, region, vertices) of each triangle."""
        return [(i, region, cell) for i, ((_, cell), region) in enumerate(zip(self.grid.cells, self.grid.regions))]

    def content(self):
        spelled = lambda x: repr(x) if x != int(x) else str(int(x))
        parts = []
        for piece in self.pieces:
            if isinstance(piece, bytes):
                parts.append(piece)
            else:
                vertex, axis, code = piece
                x = self.grid.points[vertex][axis]
                parts.append(struct.pack(code, x) if code else spelled(x).encode())
        return b"".join(parts)

    def read(self, content):
        """The mesh in a file that differs from this one in its coordinates at most."""
        pattern = b"".join(re.escape(piece) if isinstance(piece, bytes)
                           else b"(.{%d})" % struct.calcsize(piece[2]) if piece[2] else rb"([-+.0-9eE]+)"
                           for piece in self.pieces)
        match = re.fullmatch(pattern, content, re.DOTALL)
        if match is None:
            raise ValueError(f"{self.extension}: something beside coordinates has changed:\n{content[:2000]!r}")
        mesh = Mesh(content)
        found = {}
        for group, (vertex, axis, code) in enumerate((p for p in self.pieces if not isinstance(p, bytes)), 1):
            text = match.group(group)
            value = struct.unpack(code, text)[0] if code else float(text)
            found.setdefault(vertex, []).append((value, match.span(group)))
        for vertex in self.points():
            numbers = [value for value, _ in found[vertex]]
            mesh.points.append(tuple(numbers + [0.0] * (3 - len(numbers))))
            mesh.spans.append([[span for _, span in found[vertex]]])
        mesh.cells = [(TRIANGLE, cell) for _, cell in self.grid.cells] + [(LINE, line) for line in self.lines]
        if self.has_regions:
            mesh.cell_arrays["region"] = [(region,) for region in self.grid.regions] + [(0,)] * len(self.lines)
        return mesh


def ints(values):
    return " ".join(map(str, values))


def msh_lists(version, order=""):
    """Versions 1 to 2.2; binary where there is a byte order."""
    sample = Sample(".msh")
    count = len(sample.grid.points)
    if version == "1":
        sample.add(f"$NOD\n{count}\n")
    else:
        sample.add(f"$MeshFormat\n{version} {1 if order else 0} 8\n")
        if order:
            sample.pack(order + "i", 1).add("\n")
        sample.add("$EndMeshFormat\n$PhysicalNames\n1\n2 2 \"upper half\"\n$EndPhysicalNames\n"
                   f"$Nodes\n{count}\n")
    for v in sample.points():
        if order:
            sample.pack(order + "i", v + 1).coordinates(v, 3, order + "d")
        else:
            sample.add(f"{v + 1} ").coordinates(v, 3).add("\n")
    cells = sample.cells()
    sample.add("$ENDNOD\n$ELM\n" if version == "1" else ("\n" if order else "") + "$EndNodes\n$Elements\n",
               f"{len(cells)}\n")
    if order:
        sample.pack(order + "3i", 2, len(cells), 2)
    for i, region, cell in cells:
        nodes = [v + 1 for v in cell]
        if order:
            sample.pack(order + "6i", i + 1, region, region, *nodes)
        else:
            labels = (region, region, 3) if version == "1" else (2, region, region)
            sample.add(f"{i + 1} 2 {ints((*labels, *nodes))}\n")
    if version == "1":
        return sample.add("$ENDELM\n")
    return sample.add("\n" if order else "", "$EndElements\n$Other\nkept\n$EndOther\n")


def msh_blocks(version, order=""):
    """Versions 4.0 and 4.1: nodes and elements in blocks, each on an entity."""
    sample = Sample(".msh")
    is_new = version == "4.1"

    def put(codes, *values):
        if order:
            sample.pack(order + codes, *values)
        else:
            sample.add(ints(values) + "\n")

    sample.add(f"$MeshFormat\n{version} {1 if order else 0} 8\n")
    if order:
        sample.pack(order + "i", 1).add("\n")
    sample.add("$EndMeshFormat\n$Entities\n")
    put("4Q", 0, 0, 2, 0)
    for region in (1, 2):
        put("i6dQiQ", region, 0., 0., 0., 8., 8., 0., 1, region, 0)
    sample.add(("\n" if order else "") + "$EndEntities\n$Nodes\n")
    total = len(sample.grid.points)
    put(*(("4Q", 1, total, 1, total) if is_new else ("2Q", 1, total)))
    put(*(("3iQ", 2, 1, 0, total) if is_new else ("3iQ", 1, 2, 0, total)))
    if is_new:
        for v in sample.points():
            put("Q", v + 1)
    for v in sample.points():
        if not is_new:
            sample.pack(order + "i", v + 1) if order else sample.add(f"{v + 1} ")
        sample.coordinates(v, 3, order + "d" if order else "")
        sample.add("" if order else "\n")
    sample.add(("\n" if order else "") + "$EndNodes\n$Elements\n")
    cells = sample.cells()
    put(*(("4Q", 2, len(cells), 1, len(cells)) if is_new else ("2Q", 2, len(cells))))
    for wanted in (1, 2):
        block = [(i, cell) for i, region, cell in cells if region == wanted]
        put(*(("3iQ", 2, wanted, 2, len(block)) if is_new else ("3iQ", wanted, 2, 2, len(block))))
        for i, cell in block:
            put("4Q" if is_new else "4i", i + 1, *(v + 1 for v in cell))
    return sample.add(("\n" if order else "") + "$EndElements\n$Other\nkept\n$EndOther\n")


def medit(newline="\n"):
    sample = Sample(".mesh")
    sample.add(f"MeshVersionFormatted 2\nDimension\n2\n# of a test\nVertices\n{len(sample.grid.points)}\n")
    for v in sample.points():
        sample.coordinates(v).add(f" {v % 3}\n")
    sample.add(f"Triangles {len(sample.cells())}\n")
    for _, region, cell in sample.cells():
        sample.add(f"{ints(v + 1 for v in cell)} {region}\n")
    sample.add("Normals 1\n0 1\nEnd\n")
    sample.pieces = [piece.replace(b"\n", newline.encode()) if isinstance(piece, bytes) else piece
                     for piece in sample.pieces]
    return sample


def medit_binary(version, order):
    """Keyword, place of the next one, number of rows, rows; the code 54 ends it."""
    sample = Sample(".meshb")
    real = "f" if version == 1 else "d"
    place, number = ("i" if version < 3 else "q"), ("i" if version < 4 else "q")
    at = 0

    def put(codes, *values):
        nonlocal at
        at += struct.calcsize("<" + codes)
        sample.pack(order + codes, *values)

    put("ii", 1, version)
    put("i" + place + "i", 3, at + struct.calcsize("<i" + place + "i"), 2)
    for keyword, count, size in ((4, len(sample.grid.points), struct.calcsize("<2" + real + number)),
                                 (6, len(sample.cells()), struct.calcsize("<4" + number))):
        put("i" + place + number, keyword, at + struct.calcsize("<i" + place + number) + count * size, count)
        if keyword == 4:
            for v in sample.points():
                sample.coordinates(v, 2, order + real).pack(order + number, v % 3)
        else:
            for _, region, cell in sample.cells():
                sample.pack(order + "4" + number, *(v + 1 for v in cell), region)
        at += count * size
    put("i" + place, 54, 0)
    return sample


def su2():
    sample = Sample(".su2", regions=False)
    sample.add(f"% of a test\nNDIME= 2\nNELEM= {len(sample.cells())}\n")
    for i, _, cell in sample.cells():
        sample.add(f"5 {ints(cell)} {i}\n")
    sample.add(f"NPOIN= {len(sample.grid.points)}\n")
    for v in sample.points():
        sample.coordinates(v, separator="\t").add(f" {v}\n")
    sample.lines = [(v, v + 1) for v in range(8)]
    sample.add("NMARK= 1\nMARKER_TAG= lower\nMARKER_ELEMS= 8\n")
    for line in sample.lines:
        sample.add(f"3 {ints(line)}\n")
    return sample


def inp(parts=False):
    sample = Sample(".inp")
    sample.add("*HEADING\nof a test\n** kept\n", "*Part, name=Plate\n" if parts else "", "*NODE, NSET=ALL\n")
    for v in sample.points():
        sample.add(f"{v + 1},  ").coordinates(v, separator=", ").add(", 0.\n")
    for wanted in (1, 2):
        sample.add(f"*ELEMENT, TYPE=CPS3, ELSET=region{wanted}\n")
        for i, region, cell in sample.cells():
            if region == wanted:
                sample.add(f"{i + 1}, {', '.join(str(v + 1) for v in cell)}\n")
    return sample.add("*SOLID SECTION, ELSET=region1, MATERIAL=a\n1.\n*SOLID SECTION, ELSET=region2, MATERIAL=b\n1.\n",
                      "*End Part\n*Assembly, name=a\n*Instance, name=i, part=Plate\n*End Instance\n*End Assembly\n"
                      if parts else "*STEP\n*STATIC\n*END STEP\n")


def adcirc():
    sample = Sample(".14", regions=False)
    sample.add(f"a grid of a test\n{len(sample.cells())} {len(sample.grid.points)} ! NE, NP\n")
    for v in sample.points():
        sample.add(f" {v + 1} ").coordinates(v).add(" 7.5\n")
    for i, _, cell in sample.cells():
        sample.add(f"{i + 1} 3 {ints(v + 1 for v in cell)}\n")
    return sample.add("1 = Number of open boundaries\n2 = nodes of them\n2 = of the first\n1\n2\n0\n0\n")


def sms():
    sample = Sample(".2dm")
    sample.add("MESH2D\nMESHNAME \"of a test\"\nNUM_MATERIALS_PER_ELEM 1\n")
    for i, region, cell in sample.cells():
        sample.add(f"E3T {i + 1} {ints(v + 1 for v in cell)} {region}\n")
    for v in sample.points():
        sample.add(f"ND {v + 1} ").coordinates(v).add(" 7.5\n")
    return sample.add("NS 1 2 -3 \"inlet\"\nGM \"kept\"\n")


def unv():
    sample = Sample(".unv")
    sample.add("    -1\n   164\n         1  SI: of a test          2\n    -1\n    -1\n  2411\n")
    for v in sample.points():
        sample.add(f"{v + 1:10}         1         1        11\n ").coordinates(v).add(" 0\n")
    sample.add("    -1\n    -1\n  2412\n")
    for i, region, cell in sample.cells():
        sample.add(f"{i + 1:10}        91{region:10}         0         7         3\n {ints(v + 1 for v in cell)}\n")
    return sample.add("    -1\n")


def freefem():
    sample = Sample(".msh")
    sample.lines = [(v, v + 1) for v in range(8)]
    sample.add(f"{len(sample.grid.points)} {len(sample.cells())} {len(sample.lines)}\n")
    for v in sample.points():
        sample.coordinates(v).add(f" {v % 2}\n")
    for _, region, cell in sample.cells():
        sample.add(f"{ints(v + 1 for v in cell)} {region}\n")
    for line in sample.lines:
        sample.add(f"{ints(v + 1 for v in line)} 5\n")
    return sample


def mfem(version, ordering=None):
    """With an ordering, of MFEM's numbers, the places are a grid function."""
    sample = Sample(".mesh")
    sample.add(f"MFEM mesh v{version}\n\n# of a test\ndimension\n2\n\nelements\n{len(sample.cells())}\n")
    for _, region, cell in sample.cells():
        sample.add(f"{region} 2 {ints(cell)}\n")
    sample.lines = [(v, v + 1) for v in range(8)]
    sample.add(f"\nboundary\n{len(sample.lines)}\n")
    for line in sample.lines:
        sample.add(f"9 1 {ints(line)}\n")
    sample.add(f"\nvertices\n{len(sample.grid.points)}\n")
    if ordering is None:
        sample.add("2\n")
    else:
        sample.add("\nnodes\nFiniteElementSpace\nFiniteElementCollection: H1_2D_P1\nVDim: 2\n"
                   f"Ordering: {ordering}\n\n")
    if ordering == 0:
        for axis in range(2):
            for v in sample.points():
                sample.add((v, axis, ""), "\n")
    else:
        for v in sample.points():
            sample.coordinates(v).add("\n")
    return sample.add("" if version == "1.0" else "\nmfem_mesh_end\n")


def triangle():
    """The nodes, and the elements beside them."""
    sample = Sample(".node")
    sample.add(f"{len(sample.grid.points)} 2 1 1\n")
    for v in sample.points():
        sample.add(f"  {v + 1}  ").coordinates(v).add(f" {v / 4} {v % 2}\n")
    sample.add("# Generated by triangle -A\n")
    elements = f"{len(sample.cells())} 3 1\n"
    for i, region, cell in sample.cells():
        elements += f"{i + 1} {ints(v + 1 for v in cell)} {region}\n"
    return sample, elements.encode()


def every_sample():
    """{name: Sample}, of meshes in one file."""
    samples = {f"msh {version}": msh_lists(version) for version in ("1", "2", "2.1", "2.2")}
    samples.update({f"msh {version}": msh_blocks(version) for version in ("4.0", "4.1")})
    for order in "<>":
        samples.update({f"msh 2.2 {order}": msh_lists("2.2", order), f"msh 4.0 {order}": msh_blocks("4.0", order),
                        f"msh 4.1 {order}": msh_blocks("4.1", order)})
        samples.update({f"meshb {version} {order}": medit_binary(version, order) for version in (1, 2, 3, 4)})
    samples.update({"medit": medit(), "medit CR LF": medit("\r\n"), "su2": su2(), "inp": inp(),
                    "inp of parts": inp(True), "adcirc": adcirc(), "2dm": sms(), "unv": unv(), "freefem": freefem()})
    samples.update({f"mfem {version}": mfem(version) for version in ("1.0", "1.3")})
    samples.update({f"mfem nodes {ordering}": mfem("1.0", ordering) for ordering in (0, 1)})
    return samples
