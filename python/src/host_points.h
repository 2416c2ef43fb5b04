// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

#include <nanobind/nanobind.h>

#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/point_view.h"
#include "trismooth/python/errors.h"
#include "trismooth/python/host_array.h"
#include "trismooth/python/results.h"
#include "trismooth/quality/quality.h"

namespace trismooth::python {

/// The caller's points, copied to be smoothed: what fails leaves the caller's arrays as they are, and the caller's
/// other threads do not disturb.
class WorkingPoints {
 public:
  void read(const PointArray& points, Workers& workers) {
    numbers_.resize(points.bytes());
    digest_ = points.copy_to(numbers_.data(), workers);
    size_ = points.size();
    components_ = points.components();
    storage_ = points.storage();
  }

  PointView view() { return packed_points(numbers_.data(), size_, components_, storage_); }
  bool are_still(const PointArray& points, Workers& workers) const { return points.digest(workers) == digest_; }
  void write(const PointArray& out, Workers& workers) const { out.copy_from(numbers_.data(), workers); }

 private:
  BulkVector<std::byte> numbers_;
  std::uint64_t digest_ = 0;
  std::size_t size_ = 0;
  std::size_t components_ = 0;
  Storage storage_ = Storage::float64;
};

inline void require_same_form(const HostArray& out, const HostArray& points) {
  const bool same_shape = out.dimensions() == points.dimensions() && out.shape_text() == points.shape_text();
  if (!same_shape) {
    out.raise_value("shape " + out.shape_text() + "; that of points is " + points.shape_text());
  }
  if (out.type_text() != points.type_text()) {
    out.raise_type("its numbers are " + out.type_text() + ", those of points " + points.type_text());
  }
}

/// Of few points this thread has copied all before another one is awake.
inline int threads_to_copy(const PointArray& points, int threads) {
  constexpr std::size_t few = 32768;
  return points.size() <= few ? 1 : threads;
}

/// Smooths `points` into `out` by smooth(view, outcome), which fills in what it did; the GIL is not held while it
/// runs. `mesh_quality` makes the MeshQuality for the reports before and after; null where they are not wanted.
/// `accept` is called with the outcome before anything is written, and may raise: it has the warnings.
template <class Smooth>
Outcome smooth_into(const HostArray& points_array, const HostArray& out_array, WorkingPoints& working,
                    const std::function<MeshQuality()>& mesh_quality, int threads, const nanobind::callable& accept,
                    const Smooth& smooth) {
  require_same_form(out_array, points_array);
  const PointArray points(points_array);
  const PointArray out(out_array);
  Outcome outcome;
  bool are_still = true;
  {
    const nanobind::gil_scoped_release no_gil;
    Workers workers(threads_to_copy(points, threads));
    working.read(points, workers);
    naming_arguments([&] {
      std::optional<MeshQuality> quality;
      if (mesh_quality) {
        quality.emplace(mesh_quality());
        outcome.before = quality->report(working.view(), {.threads = threads});
      }
      smooth(working.view(), outcome);
      if (quality) {
        outcome.after = quality->report(working.view(), {.threads = threads});
        if (outcome.smoothing.inverted < 0) {  // the call was over before anybody had counted them
          outcome.smoothing.inverted = outcome.after->inverted;
          outcome.smoothing.degenerate = outcome.after->degenerate;
        }
      }
    });
    are_still = working.are_still(points, workers);
  }
  if (!are_still) {
    points_array.raise_value("changed while they were smoothed; out is as it was");
  }
  // The last moment for Ctrl-C: from here on it comes too late.
  if (PyErr_CheckSignals() != 0) {
    throw nanobind::python_error();
  }
  accept(outcome);
  const nanobind::gil_scoped_release no_gil;
  Workers workers(threads_to_copy(points, threads));
  working.write(out, workers);
  return outcome;
}

}  // namespace trismooth::python
