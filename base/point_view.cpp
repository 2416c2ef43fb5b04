// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/point_view.h"

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>

#include "trismooth/base/errors.h"
#include "trismooth/base/machine/workers.h"

namespace trismooth {

namespace {

constexpr std::int64_t grain = 1 << 15;

}  // namespace

ConstPointView::ConstPointView(const std::byte* first, std::size_t size, std::size_t components,
                               std::ptrdiff_t point_stride, std::ptrdiff_t component_stride, Storage storage)
    : first_(first),
      size_(size),
      components_(components),
      point_stride_(point_stride),
      component_stride_(component_stride),
      storage_(storage) {
  if (components != 2 && components != 3) {
    throw std::invalid_argument("points: " + std::to_string(components) +
                                " numbers each, expected two (x, y) or three (x, y, z)");
  }
  if (size == 0) {
    return;
  }
  if (first == nullptr) {
    throw std::invalid_argument("points: a null pointer for " + std::to_string(size) + " points");
  }
  const std::size_t alignment = storage == Storage::float32 ? alignof(float) : alignof(double);
  const auto is_aligned = [&](std::size_t bytes) { return bytes % alignment == 0; };
  if (!is_aligned(reinterpret_cast<std::uintptr_t>(first)) || !is_aligned(static_cast<std::size_t>(point_stride)) ||
      !is_aligned(static_cast<std::size_t>(component_stride))) {
    throw std::invalid_argument("points: numbers must lie at multiples of " + std::to_string(alignment) +
                                " bytes, their size");
  }
}

std::vector<Point2<double>> ConstPointView::read(Workers& workers) const {
  std::vector<Point2<double>> points(size_);
  std::atomic<std::size_t> first_bad = std::numeric_limits<std::size_t>::max();
  workers.for_blocks(static_cast<std::int64_t>(size_), grain, [&](std::int64_t begin, std::int64_t end) {
    for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v) {
      points[v] = {number(v, 0), number(v, 1)};
      if (!std::isfinite(points[v].x) || !std::isfinite(points[v].y) || (components_ == 3 && !std::isfinite(z(v)))) {
        std::size_t known = first_bad;
        while (v < known && !first_bad.compare_exchange_weak(known, v)) {
        }
        return;
      }
    }
  });
  if (first_bad < size_) {
    throw MeshError("vertex " + std::to_string(first_bad) + " has a coordinate that is not finite");
  }
  return points;
}

void PointView::write(std::span<const Point2<double>> points, Workers& workers) const {
  workers.for_blocks(static_cast<std::int64_t>(size()), grain, [&](std::int64_t begin, std::int64_t end) {
    for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v) {
      if (storage() == Storage::float32) {
        number_at<float>(v, 0) = static_cast<float>(points[v].x);
        number_at<float>(v, 1) = static_cast<float>(points[v].y);
      } else {
        number_at<double>(v, 0) = points[v].x;
        number_at<double>(v, 1) = points[v].y;
      }
    }
  });
}

bool ConstPointView::are_pairs() const {
  static_assert(sizeof(Point2<double>) == 2 * sizeof(double));
  return storage_ == Storage::float64 && components_ == 2 && component_stride_ == sizeof(double) &&
         point_stride_ == sizeof(Point2<double>);
}

std::span<Point2<double>> PointView::as_pairs() const {
  if (!are_pairs()) {
    return {};
  }
  return {reinterpret_cast<Point2<double>*>(const_cast<std::byte*>(at(0, 0))), size()};
}

namespace array_layout {

void require_whole_points(std::size_t numbers, std::size_t components) {
  if (numbers % components != 0) {
    throw std::invalid_argument(
        "points: " + std::to_string(numbers) + " numbers, expected " + std::to_string(components) +
        " for each point; " +
        (components == 2 ? "xyz_points() is for x, y and z" : "xy_points() is for x and y alone"));
  }
}

void require_apart(std::size_t points, std::ptrdiff_t stride_bytes, std::size_t point_bytes) {
  if (points > 1 && static_cast<std::size_t>(std::abs(stride_bytes)) < point_bytes) {
    throw std::invalid_argument("points: a stride of " + std::to_string(stride_bytes) + " bytes for points of " +
                                std::to_string(point_bytes));
  }
}

}  // namespace array_layout

}  // namespace trismooth
