# SPDX-License-Identifier: BSD-3-Clause
"""Compares two decks of Nastran in fixed columns that are to be the same but for coordinates of GRIDs."""

import re


def nodes_and_rest(text):
    """({id: (cp, [x, y, z])} as texts, all other lines). A GRID in large field has two lines."""
    nodes, rest = {}, []
    lines = iter(text.decode().splitlines())
    for line in lines:
        if line.startswith("GRID*"):
            line = line.ljust(72)
            fields = [line[8 + 16 * i:24 + 16 * i].strip() for i in range(4)]
            second = next(lines)
            assert second.startswith("*"), second
            fields.append(second[8:24].strip())
        elif line.startswith("GRID "):
            fields = [line[8 + 8 * i:16 + 8 * i].strip() for i in range(5)]
        else:
            rest.append(line)
            continue
        nodes[int(fields[0])] = (fields[1], fields[2:])
    return nodes, rest


def value(text):
    """The number of a field."""
    exponent = re.fullmatch(r"([-+]?[\d.]+)[eEdD]?([-+]\d+)", text)
    return float(exponent[1] + "e" + exponent[2] if exponent else text)


def changed_numbers(before, after):
    """[(old, new)] for every coordinate that differs as text. Raises ValueError where anything else differs, or where a
    number is written anew with the same value."""
    (old_nodes, old_rest), (new_nodes, new_rest) = nodes_and_rest(before), nodes_and_rest(after)
    if old_rest != new_rest:
        raise ValueError("other lines differ")
    if list(old_nodes) != list(new_nodes):
        raise ValueError("other nodes, or in another order")
    changed = []
    for number, (system, place) in old_nodes.items():
        if new_nodes[number][0] != system:
            raise ValueError(f"node {number} is in another system")
        for old, new in zip(place, new_nodes[number][1]):
            if old != new:
                if value(old) == value(new):
                    raise ValueError(f"{old!r} became {new!r}, which is the same")
                changed.append((value(old), value(new)))
    return changed
