# SPDX-License-Identifier: BSD-3-Clause
"""Threads, forked processes and Ctrl-C."""

from __future__ import annotations

import multiprocessing
import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import trismooth
from conftest import grid


def in_threads(count, work):
    """Runs work(i) on so many threads and hands on what one has raised."""
    errors = []

    def guarded(i):
        try:
            work(i)
        except BaseException as error:  # noqa: BLE001
            errors.append(error)

    threads = [threading.Thread(target=guarded, args=(i,)) for i in range(count)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(120)
        assert not thread.is_alive(), "a thread hangs"
    if errors:
        raise errors[0]


def test_four_threads_with_plans_of_their_own():
    meshes = [grid(60 + 10 * i, 50, seed=i) for i in range(4)]
    expected = [trismooth.smooth(*mesh).points for mesh in meshes]

    def work(i):
        points, triangles = meshes[i]
        plan = trismooth.Plan(triangles, len(points))
        for _ in range(20):
            np.testing.assert_array_equal(plan.smooth(points).points, expected[i])

    in_threads(4, work)


def test_threads_that_share_a_plan_take_turns():
    points, triangles = grid(50, 40)
    other = grid(50, 40, seed=5)[0]
    plan = trismooth.Plan(triangles, len(points))
    expected = [plan.smooth(p).points for p in (points, other)]

    def work(i):
        for _ in range(20):
            np.testing.assert_array_equal(plan.smooth((points, other)[i % 2]).points, expected[i % 2])

    in_threads(4, work)


def test_triangles_that_change_while_their_quality_is_found_do_no_harm():
    points, triangles = grid(300, 200)
    triangles = triangles.astype(np.int32)
    end = time.monotonic() + 2

    def change():
        while time.monotonic() < end:
            triangles[::50] += 2**30
            triangles[::50] -= 2**30

    changer = threading.Thread(target=change)
    changer.start()
    while time.monotonic() < end:
        try:
            trismooth.quality(points, triangles)
        except trismooth.MeshError:
            pass
    changer.join()


def test_python_runs_on_while_a_mesh_is_smoothed(large_mesh):
    points, triangles = large_mesh
    ticks = []
    done = threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    ticker = threading.Thread(target=tick)
    ticker.start()
    begin = time.perf_counter()
    trismooth.smooth(points, triangles)
    end = time.perf_counter()
    done.set()
    ticker.join()
    assert sum(begin < t < end for t in ticks) > 5


def child_smooths(points, triangles, expected, threads):
    result = trismooth.smooth(points, triangles, threads=threads)
    os._exit(0 if np.array_equal(result.points, expected) else 3)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")
@pytest.mark.parametrize("threads", [0, 1, 4])
@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_a_forked_process_does_not_hang_and_gives_the_same_bits(threads):
    points, triangles = grid(300, 200, shift=0.45)
    expected = trismooth.smooth(points, triangles, threads=4, max_sweeps=5).points  # threads are at work before the fork
    expected = trismooth.smooth(points, triangles).points
    child = multiprocessing.get_context("fork").Process(target=child_smooths, args=(points, triangles, expected, threads))
    child.start()
    child.join(120)
    assert child.exitcode == 0


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")
@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_a_plan_works_on_in_a_forked_process_that_ends_in_the_usual_way():
    code = """
import os, sys
import numpy as np
import trismooth
sys.path.insert(0, sys.argv[1])
from conftest import grid
points, triangles = grid(300, 200)
plan = trismooth.Plan(triangles, len(points), threads=4)
expected = plan.smooth(points).points
child = os.fork()
same = np.array_equal(plan.smooth(points, quality=True).points, expected)
if child == 0:
    sys.exit(0 if same else 3)  # runs what Python and the libraries do at the end
_, status = os.waitpid(child, 0)
sys.exit(os.waitstatus_to_exitcode(status) or (0 if same else 4))
"""
    run = subprocess.run([sys.executable, "-W", "ignore", "-c", code, os.path.dirname(__file__)], timeout=120)
    assert run.returncode == 0


@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_a_pool_of_forked_workers():
    points, triangles = grid(80, 60)
    expected = trismooth.smooth(points, triangles, threads=3).points
    with multiprocessing.get_context("fork").Pool(3) as pool:
        results = pool.starmap_async(smoothed, [(points, triangles)] * 6).get(120)
    for result in results:
        np.testing.assert_array_equal(result, expected)


def smoothed(points, triangles):
    return trismooth.smooth(points, triangles).points


@pytest.fixture
def interruptible():
    """Ctrl-C as in a terminal: programs in the background of a script are started with it ignored."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def test_ctrl_c_stops_and_leaves_out_as_it_was(interruptible):
    points, triangles = grid(400, 300, shift=0.45)
    out = np.zeros_like(points)
    for _ in range(20):  # until the signal comes into a smoothing, and not between two
        is_smoothing = False
        out[:] = 0
        threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        with pytest.raises(KeyboardInterrupt):
            end = time.monotonic() + 60
            while time.monotonic() < end:
                is_smoothing = True
                trismooth.smooth(points, triangles, out=out, tolerance=0.0, max_sweeps=0, threads=1)
                is_smoothing = False
                out[:] = 0
        if is_smoothing and not out.any():
            return
    pytest.fail("Ctrl-C never stopped a smoothing")


def test_ctrl_c_is_heard_before_the_first_sweep(interruptible):
    """While a large mesh is made ready, which takes many times as long as the signal: alone, and for a plan."""
    points, triangles = grid(900, 900, shift=0.45)
    for call in (lambda: trismooth.smooth(points, triangles, threads=1, max_sweeps=1, quality=False),
                 lambda: trismooth.Plan(triangles, len(points), threads=1)):
        begin = time.monotonic()
        call()
        whole = time.monotonic() - begin
        threading.Timer(whole / 20, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        begin = time.monotonic()
        with pytest.raises(KeyboardInterrupt):
            call()
            time.sleep(10)  # it was quicker than that
        assert time.monotonic() - begin < whole


def test_no_time_is_said_and_nothing_moves():
    points, triangles = grid(30, 30)
    with pytest.warns(trismooth.MeshWarning, match="time was up before the first sweep"):
        result = trismooth.smooth(points, triangles, time_limit=0.0)
    assert (result.stop_reason, result.sweeps, result.moved) == ("time_limit", 0, 0)
    assert result.inverted == result.after.inverted
    assert str(result).startswith("no vertex moved in 0 sweeps; stopped by time_limit")
    np.testing.assert_array_equal(result.points, points)
    with pytest.warns(trismooth.MeshWarning):
        assert trismooth.smooth(points, triangles, time_limit=0.0, quality=False).inverted == -1


def test_more_time_is_advised_where_there_was_none_to_untangle():
    points, triangles = grid(30, 30)
    inside = ((points > points.min(axis=0)) & (points < points.max(axis=0))).all(axis=1)
    points[inside] = np.random.default_rng(1).uniform(points.min(), points.max(), (inside.sum(), 2))
    with pytest.warns(trismooth.MeshWarning):
        result = trismooth.smooth(points, triangles, untangle=True, time_limit=1e-9)
    (note,) = [note for note in result.notes if "inverted" in note]
    assert note.endswith("there was no time to mend all of them")


def test_two_processes_give_the_same_bits_whatever_their_threads():
    points, triangles = grid(70, 70)
    expected = trismooth.smooth(points, triangles, threads=1).points
    context = multiprocessing.get_context("spawn")
    with context.Pool(1) as pool:
        np.testing.assert_array_equal(pool.apply(smoothed, (points, triangles)), expected)
