# SPDX-License-Identifier: BSD-3-Clause
"""Binary MSH files as Gmsh writes them, of triangles, quadrilaterals and lines."""

import struct

# By the number of corners: Gmsh's number of the type.
TYPES = {2: 1, 3: 2, 4: 3}


def runs(values):
    """(first, last + 1, value) of equal values behind each other."""
    found = []
    for i, value in enumerate(values):
        if found and found[-1][2] == value:
            found[-1][1] = i + 1
        else:
            found.append([i, i + 1, value])
    return found


def write(path, mesh, version, entity_of_point=None, entity_of_cell=None, names=(), big=False, first_tag=1):
    """`mesh.cells` are lists of vertices; `entity_of_point` and `entity_of_cell`: (dimension, tag) of each;
    `names`: (dimension, group, name) of groups, which are entities of the same number."""
    order = ">" if big else "<"
    cell_entities = entity_of_cell or [(1 if len(cell) == 2 else 2, 1) for cell in mesh.cells]
    point_entities = entity_of_point or [(2, 1)] * len(mesh.points)
    groups = {(dimension, group) for dimension, group, _ in names}
    out = [f"$MeshFormat\n{version} 1 8\n".encode(), struct.pack(order + "i", 1), b"\n$EndMeshFormat\n"]
    if names:
        out.append(f"$PhysicalNames\n{len(names)}\n".encode())
        out += [f'{dimension} {group} "{name}"\n'.encode() for dimension, group, name in names]
        out.append(b"$EndPhysicalNames\n")
    point_bytes = [struct.pack(order + "3d", *point) for point in mesh.points]
    if version == "4.1":
        entities = sorted(set(cell_entities) | set(point_entities))
        out.append(b"$Entities\n" + struct.pack(order + "4q", *(sum(d == dimension for d, _ in entities)
                                                                for dimension in range(4))))
        for dimension, tag in entities:
            group = struct.pack(order + "qi", 1, tag) if (dimension, tag) in groups else struct.pack(order + "q", 0)
            if dimension == 0:
                out.append(struct.pack(order + "i3d", tag, 0, 0, 0) + group)
            else:
                out.append(struct.pack(order + "i6d", tag, *[0] * 6) + group + struct.pack(order + "q", 0))
        out.append(b"\n$EndEntities\n$Nodes\n")
        blocks = runs(point_entities)
        out.append(struct.pack(order + "4q", len(blocks), len(mesh.points), first_tag, first_tag + len(mesh.points) - 1))
        for first, last, (dimension, tag) in blocks:
            out.append(struct.pack(order + "iiiq", dimension, tag, 0, last - first))
            out.append(struct.pack(f"{order}{last - first}q", *range(first + first_tag, last + first_tag)))
            out += point_bytes[first:last]
        out.append(b"\n$EndNodes\n$Elements\n")
        blocks = runs([(entity, len(cell)) for entity, cell in zip(cell_entities, mesh.cells)])
        out.append(struct.pack(order + "4q", len(blocks), len(mesh.cells), 1, len(mesh.cells)))
        for first, last, ((dimension, tag), size) in blocks:
            out.append(struct.pack(order + "iiiq", dimension, tag, TYPES[size], last - first))
            for c in range(first, last):
                out.append(struct.pack(f"{order}{1 + size}q", c + 1, *(v + first_tag for v in mesh.cells[c])))
    else:
        out.append(f"$Nodes\n{len(mesh.points)}\n".encode())
        for v, point in enumerate(point_bytes):
            out += [struct.pack(order + "i", v + first_tag), point]
        out.append(f"\n$EndNodes\n$Elements\n{len(mesh.cells)}\n".encode())
        for first, last, size in runs([len(cell) for cell in mesh.cells]):
            out.append(struct.pack(order + "3i", TYPES[size], last - first, 2))
            for c in range(first, last):
                dimension, tag = cell_entities[c]
                group = tag if (dimension, tag) in groups else 0
                out.append(struct.pack(f"{order}{3 + size}i", c + 1, group, tag, *(v + first_tag for v in mesh.cells[c])))
    out.append(b"\n$EndElements\n")
    with open(path, "wb") as file:
        file.write(b"".join(out))
