#pragma once

#include <chrono>
#include <utility>

#include <nanobind/nanobind.h>

#include "trismooth/python/errors.h"
#include "trismooth/smoothing/options.h"

namespace trismooth::python {

/// A progress callback for a smoothing that runs without the GIL. Calls the caller's `progress` with each sweep, and
/// looks for Ctrl-C many times a second. Answers stop where `progress` returns what is false, but for None; what it
/// raises, and KeyboardInterrupt, leaves the smoothing as an exception.
class Interruption {
 public:
  /// `progress`: a callable, or None. Raises TypeError for anything else.
  explicit Interruption(nanobind::object progress) : progress_(std::move(progress)) {
    if (!progress_.is_none() && PyCallable_Check(progress_.ptr()) == 0) {
      raise_type_error("progress", "a callable is needed");
    }
  }

  Progress operator()(const SweepRecord& sweep) {
    const auto now = std::chrono::steady_clock::now();
    const bool has_callback = !progress_.is_none();
    if (!has_callback && now - last_look_ < between_looks) {
      return Progress::proceed;
    }
    const nanobind::gil_scoped_acquire gil;
    if (now - last_look_ >= between_looks) {
      last_look_ = now;
      if (PyErr_CheckSignals() != 0) {
        throw nanobind::python_error();
      }
    }
    if (!has_callback) {
      return Progress::proceed;
    }
    const nanobind::object answer = progress_(sweep);
    const int goes_on = answer.is_none() ? 1 : PyObject_IsTrue(answer.ptr());
    if (goes_on < 0) {
      throw nanobind::python_error();
    }
    return goes_on == 1 ? Progress::proceed : Progress::stop;
  }

 private:
  static constexpr std::chrono::milliseconds between_looks{20};

  nanobind::object progress_;
  std::chrono::steady_clock::time_point last_look_ = std::chrono::steady_clock::now();
};

}  // namespace trismooth::python
