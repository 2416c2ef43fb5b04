// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "trismooth/base/host_device.h"
#include "trismooth/base/point2.h"

namespace trismooth::cuda {

/// A point as it lies in memory: one access of 8 or 16 bytes.
template <class T>
struct alignas(2 * sizeof(T)) PointRecord {
  T x;
  T y;
};
static_assert(sizeof(PointRecord<float>) == 8 && alignof(PointRecord<float>) == 8);
static_assert(offsetof(PointRecord<float>, x) == 0 && offsetof(PointRecord<float>, y) == 4);
static_assert(sizeof(PointRecord<double>) == 16 && alignof(PointRecord<double>) == 16);
static_assert(offsetof(PointRecord<double>, x) == 0 && offsetof(PointRecord<double>, y) == 8);

/// Points in device memory that belongs to someone else. Trivially copyable.
template <class T>
struct PointArray {
  PointRecord<T>* points = nullptr;

  TRISMOOTH_HOST_DEVICE Point2<T> load(std::int32_t vertex) const {
    const PointRecord<T> record = points[vertex];
    return {record.x, record.y};
  }
  TRISMOOTH_HOST_DEVICE void store(std::int32_t vertex, Point2<T> point) const {
    points[vertex] = PointRecord<T>{point.x, point.y};
  }
};

/// A point in working precision, rounded.
template <class T>
TRISMOOTH_HOST_DEVICE Point2<T> working_point(Point2<double> point) {
  return {static_cast<T>(point.x), static_cast<T>(point.y)};
}

}  // namespace trismooth::cuda
