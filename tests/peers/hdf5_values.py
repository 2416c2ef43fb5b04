# SPDX-License-Identifier: BSD-3-Clause
"""What differs between two HDF5 files, as h5py sees them."""

import h5py
import numpy


def changed(first, second):
    """Path of each dataset with other values -> how many there are. All else must be the same."""
    with h5py.File(first) as before, h5py.File(second) as after:
        paths = list(objects(before))
        assert paths == list(objects(after)), "other objects"
        found = {}
        for path in paths:
            old, new = before[path], after[path]
            assert sorted(old.attrs) == sorted(new.attrs), path
            for name in old.attrs:
                numpy.testing.assert_array_equal(old.attrs[name], new.attrs[name], f"{path}:{name}")
            if isinstance(old, h5py.Dataset):
                assert (old.dtype, old.shape, old.chunks, old.compression) == (new.dtype, new.shape, new.chunks,
                                                                               new.compression), path
                differing = int(numpy.count_nonzero(old[()] != new[()]))
                if differing:
                    found[path] = differing
        return found


def objects(file):
    names = ["/"]
    file.visit(names.append)
    return names
