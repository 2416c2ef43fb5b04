# SPDX-License-Identifier: BSD-3-Clause
"""Compares a smoothed file with the one it was made from, byte by byte or, for XML, value by value."""

import struct
import types

from mesh_reader import compare_vtu


def assert_same_but_coordinates(test, path, output, before, after, moved):
    """All bytes are the same but those of coordinates that changed; `moved` are the vertices that have any."""
    if before.vtk_file is not None:
        assert_same_arrays(test, before.vtk_file, after.vtk_file, moved)
    else:
        assert_same_bytes(test, before, after, moved)


def assert_same_arrays(test, before, after, moved):
    options = types.SimpleNamespace(allow_points=True, allow_added=False, ignore_encoding=False)
    test.assertEqual(list(compare_vtu.differences(before, after, options)), [])
    (_, kind, _, old, _), (_, _, _, new, _) = before.sections["Points"][0], after.sections["Points"][0]
    size = 3 * struct.calcsize("<" + compare_vtu.CODES[kind])
    # Bit for bit: -0 and 0 are different here.
    changed = {v for v in range(len(old) // size) if old[v * size:(v + 1) * size] != new[v * size:(v + 1) * size]}
    test.assertEqual(changed, moved)


def flat_spans(mesh):
    """(begin, end, vertex, axis) of every coordinate, in the file's order."""
    return sorted((begin, end, vertex, axis) for vertex, places in enumerate(mesh.spans) for place in places
                  for axis, (begin, end) in enumerate(place))


def assert_same_bytes(test, before, after, moved):
    old_end = new_end = 0
    old_spans, new_spans = flat_spans(before), flat_spans(after)
    test.assertEqual(len(old_spans), len(new_spans))
    for (a, b, vertex, axis), (c, d, new_vertex, new_axis) in zip(old_spans, new_spans):
        test.assertEqual((vertex, axis), (new_vertex, new_axis))
        if before.content[old_end:a] != after.content[new_end:c]:
            test.fail(f"the bytes before vertex {vertex}, axis {axis}: {before.content[old_end:a][-80:]!r} became "
                      f"{after.content[new_end:c][-80:]!r}")
        old_end, new_end = b, d
        old, new = before.content[a:b], after.content[c:d]
        if vertex not in moved or before.points[vertex][axis] == after.points[vertex][axis]:
            if old != new:
                test.fail(f"vertex {vertex}, axis {axis} kept its value, yet {old!r} became {new!r}")
    if before.content[old_end:] != after.content[new_end:]:
        test.fail("the bytes behind the last coordinate differ")
