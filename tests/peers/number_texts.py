# SPDX-License-Identifier: BSD-3-Clause
"""Compares two texts that are to be the same but for numbers."""

import re

# As C, Fortran and Nastran write them; no part of a word.
NUMBER = re.compile(rb"(?<![A-Za-z0-9_.])[-+]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][-+]?\d+|[-+]\d+)?(?![A-Za-z0-9_.])")


def value(text):
    """The number that the bytes state."""
    text = text.decode().replace("D", "e").replace("d", "e")
    exponent = re.fullmatch(r"([-+]?[\d.]+)([-+]\d+)", text)
    return float(exponent[1] + "e" + exponent[2] if exponent else text)


def changed_numbers(before, after):
    """[(old, new)] for every number that differs as text, in the order of the file. Raises ValueError where anything
    else differs, or where a number is written anew with the same value."""
    old_end = new_end = 0
    changed = []
    old_numbers, new_numbers = list(NUMBER.finditer(before)), list(NUMBER.finditer(after))
    if len(old_numbers) != len(new_numbers):
        raise ValueError(f"{len(old_numbers)} numbers became {len(new_numbers)}")
    for old, new in zip(old_numbers, new_numbers):
        if before[old_end:old.start()] != after[new_end:new.start()]:
            raise ValueError(f"{before[old_end:old.start()]!r} became {after[new_end:new.start()]!r}")
        old_end, new_end = old.end(), new.end()
        if old[0] != new[0]:
            if value(old[0]) == value(new[0]):
                raise ValueError(f"{old[0]!r} became {new[0]!r}, which is the same")
            changed.append((value(old[0]), value(new[0])))
    if before[old_end:] != after[new_end:]:
        raise ValueError(f"{before[old_end:]!r} became {after[new_end:]!r}")
    return changed
