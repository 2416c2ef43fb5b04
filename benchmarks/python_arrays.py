# SPDX-License-Identifier: BSD-3-Clause
"""What a call from Python costs, and where the arrays are meanwhile.

    python benchmarks/python_arrays.py [--vertices 1000000] [--runs 7]

Prints, of the method of the default ("mean-ratio"): the time of a call for a mesh of 12 triangles; of a large mesh in
memory of the host, in place; and, where there is a GPU, of the same mesh in arrays of CuPy, PyTorch and JAX, with the
memory of the device that the call took and whether the result is in the memory of the input. For the C++ library:
benchmarks/flat_arrays.cpp makes the same meshes.
"""

from __future__ import annotations

import argparse
import statistics
import time

import numpy as np

import trismooth


def grid(columns: int, rows: int):
    """A grid of right triangles whose inner points are displaced: the mesh of benchmarks/flat_arrays.cpp."""
    x, y = np.meshgrid(np.arange(columns + 1.0), np.arange(rows + 1.0))
    points = np.column_stack([x.ravel(), y.ravel()])
    inner = (x > 0) & (x < columns) & (y > 0) & (y < rows)
    number = np.arange(len(points), dtype=np.uint64)
    for axis, factor in enumerate((2654435761, 2246822519)):
        offsets = ((number * np.uint64(factor)) % np.uint64(1 << 32)).astype(float) / 2.0**32 - 0.5
        points[inner.ravel(), axis] += 0.7 * offsets[inner.ravel()]
    first = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    across = columns + 1
    triangles = np.stack(
        [np.column_stack([first, first + 1, first + across + 1]), np.column_stack([first, first + across + 1, first + across])], 1
    )
    return points, triangles.reshape(-1, 3).astype(np.int32)


def milliseconds(work, runs: int):
    """The median, the least and the largest time of work(), in ms."""
    times = []
    for _ in range(runs):
        begin = time.perf_counter()
        work()
        times.append(1e3 * (time.perf_counter() - begin))
    return statistics.median(times), min(times), max(times)


def small_calls(runs: int) -> None:
    points, triangles = grid(3, 2)
    out = np.empty_like(points)
    calls = 2000

    def work(**options):
        for _ in range(calls):
            trismooth.smooth(points, triangles, **options)

    for name, options in (("out given", {"out": out}), ("out given, 1 thread", {"out": out, "threads": 1}), ("a new array and both qualities", {})):
        work(**options)
        median, least, largest = (1e3 * t / calls for t in milliseconds(lambda: work(**options), runs))
        print(f"12 triangles, {name}: {median:.1f} us ({least:.1f} to {largest:.1f})")
    plan = trismooth.Plan(triangles, len(points))

    def steps():
        for _ in range(calls):
            plan.smooth(points, out=out)

    median, least, largest = (1e3 * t / calls for t in milliseconds(steps, runs))
    print(f"12 triangles, a plan: {median:.1f} us ({least:.1f} to {largest:.1f})")


def large_on_host(points, triangles, runs: int) -> None:
    for name, options in (("in place", {}), ("in place, with both qualities", {"quality": True})):
        copies = iter([points.copy() for _ in range(runs)])

        def work():
            in_place = next(copies)
            trismooth.smooth(in_place, triangles, out=in_place, backend="cpu", **options)

        median, least, largest = milliseconds(work, runs)
        print(f"{len(points)} vertices on the CPU, {name}: {median:.1f} ms ({least:.1f} to {largest:.1f})")


def large_on_device(points, triangles, runs: int) -> None:
    for name in ("cupy", "torch", "jax"):
        try:
            library = __import__(name)
        except ImportError:
            print(f"{name}: not installed")
            continue
        if name == "cupy":
            put, pointer = library.asarray, lambda a: a.data.ptr
        elif name == "torch":
            put, pointer = (lambda a: library.from_numpy(a).cuda()), lambda a: a.data_ptr()
        else:
            library.config.update("jax_enable_x64", True)
            put, pointer = library.device_put, lambda a: a.unsafe_buffer_pointer()
        corners = put(triangles)
        trismooth.smooth(put(points), corners)  # starts CUDA, and compiles what is compiled at the first use
        arrays = [put(points) for _ in range(runs)]
        results = []

        def work():
            given = arrays.pop()
            before = pointer(given)
            result = trismooth.smooth(given, corners, out=None if name == "jax" else given)
            results.append((before, pointer(result.points), result))

        median, least, largest = milliseconds(work, runs)
        before, after, result = results[-1]
        parts = result.timings
        print(
            f"{len(points)} vertices, arrays of {name}: {median:.2f} ms ({least:.2f} to {largest:.2f}), of that preparing "
            f"{parts['prepare']:.2f}, sweeps {parts['smooth']:.2f}, guard {parts['guard']:.2f}; working memory "
            f"{result.device_memory_bytes / 2**20:.1f} MiB; transfers {parts['transfer_in'] + parts['transfer_out']:.2f} ms; "
            f"result in the memory of the input: {before == after}"
        )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--vertices", type=int, default=1_000_000)
    parser.add_argument("--runs", type=int, default=7)
    options = parser.parse_args()
    small_calls(options.runs)
    side = max(2, round(options.vertices**0.5) - 1)
    points, triangles = grid(side, side)
    large_on_host(points, triangles, options.runs)
    if "device 0" in trismooth.build_info()["devices"]:
        large_on_device(points, triangles, options.runs)


if __name__ == "__main__":
    main()
