// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <utility>

#include <nanobind/nanobind.h>

#include "trismooth/python/errors.h"
#include "trismooth/smoothing/options.h"

namespace trismooth::python {

/// The callbacks of a smoothing that runs without the GIL. Calls the caller's `progress` with each sweep, and looks for
/// Ctrl-C many times a second, in whatever phase. Answers stop where `progress` returns what is false, but for None;
/// what it raises, and KeyboardInterrupt, leaves the smoothing as an exception.
class Interruption {
 public:
  /// `progress`: a callable, or None. Raises TypeError for anything else.
  explicit Interruption(nanobind::object progress) : progress_(std::move(progress)) {
    if (!progress_.is_none() && PyCallable_Check(progress_.ptr()) == 0) {
      raise_type_error("progress", "a callable is needed");
    }
  }

  /// Has these options call what `current` points to by then.
  static void watch(SmoothingOptions& options, Interruption* const& current) {
    options.cancel = [&current] { return current->look(); };
    options.progress = [&current](const SweepRecord& sweep) { return current->told(sweep); };
  }

 private:
  static constexpr std::chrono::milliseconds between_looks{20};

  /// Never true: Ctrl-C is thrown.
  bool look() {
    const auto now = std::chrono::steady_clock::now();
    if (now - last_look_ >= between_looks) {
      last_look_ = now;
      const nanobind::gil_scoped_acquire gil;
      if (PyErr_CheckSignals() != 0) {
        throw nanobind::python_error();
      }
    }
    return false;
  }

  Progress told(const SweepRecord& sweep) const {
    if (progress_.is_none()) {
      return Progress::proceed;
    }
    const nanobind::gil_scoped_acquire gil;
    const nanobind::object answer = progress_(sweep);
    const int goes_on = answer.is_none() ? 1 : PyObject_IsTrue(answer.ptr());
    if (goes_on < 0) {
      throw nanobind::python_error();
    }
    return goes_on == 1 ? Progress::proceed : Progress::stop;
  }

  nanobind::object progress_;
  std::chrono::steady_clock::time_point last_look_ = std::chrono::steady_clock::now();
};

}  // namespace trismooth::python
