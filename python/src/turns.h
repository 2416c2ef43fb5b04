// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <thread>

#include <nanobind/nanobind.h>

namespace trismooth::python {

/// An object that one thread at a time works on.
struct Turns {
  std::timed_mutex mutex;
  std::atomic<std::thread::id> owner;
};

/// The turn of this thread, from its making, which waits without the GIL, to its end. Ctrl-C ends the waiting. Raises
/// RuntimeError where it is this thread's turn already: in a callback of the work itself. Made and ended with the GIL.
class Turn {
 public:
  Turn(Turns& turns, const char* what) : turns_(turns) {
    if (turns.owner == std::this_thread::get_id()) {
      PyErr_SetString(PyExc_RuntimeError,
                      (std::string(what) + " is at work, and cannot be used by what it calls").c_str());
      throw nanobind::python_error();
    }
    while (!lock_within_a_moment()) {
      if (PyErr_CheckSignals() != 0) {
        throw nanobind::python_error();
      }
    }
    turns.owner = std::this_thread::get_id();
  }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;
  ~Turn() {
    turns_.owner = std::thread::id();
    turns_.mutex.unlock();
  }

 private:
  bool lock_within_a_moment() {
    if (turns_.mutex.try_lock()) {
      return true;
    }
    const nanobind::gil_scoped_release no_gil;
    return turns_.mutex.try_lock_for(std::chrono::milliseconds(50));
  }

  Turns& turns_;
};

}  // namespace trismooth::python
