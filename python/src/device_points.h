// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <cuda_runtime_api.h>
#include <nanobind/nanobind.h>

#include "trismooth/base/heights.h"
#include "trismooth/base/point2.h"
#include "trismooth/cuda/parts/device_scope.h"
#include "trismooth/cuda/primitives/strided_rows.h"
#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/python/device_array.h"
#include "trismooth/python/errors.h"
#include "trismooth/python/results.h"

namespace trismooth::python {

/// The stream that a library of Python's calls by this number, DLPack's.
inline cudaStream_t stream_of(std::uintptr_t number) {
  constexpr std::uintptr_t default_stream = 1;
  // NOLINTNEXTLINE(performance-no-int-to-ptr): so Python's libraries hand streams on
  return number == default_stream ? nullptr : reinterpret_cast<cudaStream_t>(number);
}

/// A caller's points on a device, and where they go when something has been done to them there.
class DevicePoints {
 public:
  /// `points_capsule`, `out_capsule`: see DeviceArray; they may be of the same array. `is_new`: nobody minds what is in
  /// `out` where a call fails. Raises TypeError and ValueError for arrays of another form than one float64 or float32
  /// point of two or three numbers for each of `vertex_count` vertices, on that device.
  DevicePoints(nanobind::handle points_capsule, nanobind::handle out_capsule, bool is_new, int device,
               std::int64_t vertex_count)
      : points_(points_capsule, "points"), out_(out_capsule, "out"), is_new_(is_new), device_(device) {
    if (points_.kind() != 'f' || (points_.item_size() != sizeof(float) && points_.item_size() != sizeof(double))) {
      points_.raise_type("float64 or float32 is needed, not " + points_.type_text());
    }
    if (points_.dimensions() != 2 || (points_.extent(1) != 2 && points_.extent(1) != 3)) {
      points_.raise_value("shape " + points_.shape_text() + "; expected (N, 2) or (N, 3), a vertex a row");
    }
    points_.require_device(device);
    if (static_cast<std::int64_t>(points_.extent(0)) != vertex_count) {
      points_.raise_value("shape " + points_.shape_text() + "; there are " + std::to_string(vertex_count) +
                          " vertices");
    }
    out_.require_device(device);
    if (out_.shape_text() != points_.shape_text()) {
      out_.raise_value("shape " + out_.shape_text() + "; that of points is " + points_.shape_text());
    }
    if (out_.type_text() != points_.type_text()) {
      out_.raise_type("its numbers are " + out_.type_text() + ", those of points " + points_.type_text());
    }
  }

  /// Calls smooth(xy, outcome) with x and y of all points, a float* or double* on the device, without the GIL, and puts
  /// them into `out`. `fixed()`: bits of namespace hold, one a vertex, for points with heights. `accept`: None, so that
  /// `out` may have half of it where `smooth` throws; or a callable that is called with the outcome, and may raise, so
  /// that `out` has none of it.
  template <class Smooth, class Fixed>
  Outcome smoothed(cuda::Context& context, const nanobind::object& accept, const Smooth& smooth, const Fixed& fixed) {
    return points_.item_size() == sizeof(float) ? smoothed_numbers<float>(context, accept, smooth, fixed)
                                                : smoothed_numbers<double>(context, accept, smooth, fixed);
  }

 private:
  template <class T, class Smooth, class Fixed>
  Outcome smoothed_numbers(cuda::Context& context, const nanobind::object& accept, const Smooth& smooth,
                           const Fixed& fixed) {
    const bool in_place = out_.data() == points_.data();
    const bool has_heights = points_.extent(1) == 3;
    const bool is_direct = out_.is_packed(2, 2 * sizeof(T)) && (is_new_ || (in_place && accept.is_none()));
    Outcome outcome;
    const cuda::DeviceScope scope(device_);
    cuda::DeviceBuffer<T> scratch;
    T* xy = reinterpret_cast<T*>(out_.data());
    {
      const nanobind::gil_scoped_release no_gil;
      naming_arguments([&] {
        if (has_heights) {
          require_heights<T>(context, fixed);
        }
        if (!is_direct) {
          scratch = cuda::DeviceBuffer<T>(context, 2 * points_.extent(0));
          xy = scratch.data();
        }
        if (!is_direct || !in_place) {
          cuda::gather_rows(context, points_.rows(2), xy);
        }
        smooth(xy, outcome);
      });
    }
    if (!accept.is_none()) {
      // The last moment for Ctrl-C: from here on it comes too late.
      if (PyErr_CheckSignals() != 0) {
        throw nanobind::python_error();
      }
      accept(outcome);
    }
    const nanobind::gil_scoped_release no_gil;
    if (!is_direct) {
      cuda::scatter_rows(context, xy, out_.rows(2));
      if (has_heights && !in_place) {
        cuda::gather_rows(context, points_.rows(1, 2), xy);
        cuda::scatter_rows(context, xy, out_.rows(1, 2));
      }
      context.synchronize();
    }
    return outcome;
  }

  /// On the host: an array with heights is copied anyway.
  template <class T, class Fixed>
  void require_heights(cuda::Context& context, const Fixed& fixed) {
    const std::size_t count = points_.extent(0);
    cuda::DeviceBuffer<T> packed(context, 3 * count);
    cuda::gather_rows(context, points_.rows(3), packed.data());
    std::vector<std::array<T, 3>> numbers(count);
    static_assert(sizeof(numbers[0]) == 3 * sizeof(T));
    packed.download(std::span(count == 0 ? nullptr : numbers.front().data(), 3 * count));
    std::vector<Point2<double>> pairs(count);
    std::ranges::transform(numbers, pairs.begin(), [](const std::array<T, 3>& p) {
      return Point2<double>{p[0], p[1]};
    });
    const auto is_finite = [](const std::array<T, 3>& p) { return std::isfinite(p[2]); };
    if (const auto bad = std::ranges::find_if_not(numbers, is_finite); bad != numbers.end()) {
      throw MeshError("vertex " + std::to_string(bad - numbers.begin()) + " has a coordinate that is not finite");
    }
    require_one_height(numbers, pairs, fixed);
  }

  DeviceArray points_;
  DeviceArray out_;
  bool is_new_;
  int device_;
};

}  // namespace trismooth::python
