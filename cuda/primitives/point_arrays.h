#pragma once

#include <cstddef>
#include <cstdint>

#include "trismooth/base/point2.h"
#include "trismooth/smoothing/options.h"

namespace trismooth::cuda {

/// A point as it lies in an array of structures: one access of 8 or 16 bytes.
template <class T>
struct alignas(2 * sizeof(T)) PointRecord {
  T x;
  T y;
};
static_assert(sizeof(PointRecord<float>) == 8 && alignof(PointRecord<float>) == 8);
static_assert(offsetof(PointRecord<float>, x) == 0 && offsetof(PointRecord<float>, y) == 4);
static_assert(sizeof(PointRecord<double>) == 16 && alignof(PointRecord<double>) == 16);
static_assert(offsetof(PointRecord<double>, x) == 0 && offsetof(PointRecord<double>, y) == 8);

/// Points in device memory, as an array of structures or as a structure of arrays. Trivially copyable; the memory is
/// someone else's: 2 count numbers, aligned for PointRecord.
template <class T, Layout layout>
struct PointArrays;

template <class T>
struct PointArrays<T, Layout::aos> {
  PointRecord<T>* points;

  PointArrays() = default;
  PointArrays(T* memory, std::int64_t /*count*/) : points(reinterpret_cast<PointRecord<T>*>(memory)) {}

  TRISMOOTH_HOST_DEVICE Point2<T> load(std::int32_t vertex) const {
    const PointRecord<T> record = points[vertex];
    return {record.x, record.y};
  }
  TRISMOOTH_HOST_DEVICE void store(std::int32_t vertex, Point2<T> point) const {
    points[vertex] = PointRecord<T>{point.x, point.y};
  }
};

template <class T>
struct PointArrays<T, Layout::soa> {
  T* x;
  T* y;

  PointArrays() = default;
  PointArrays(T* memory, std::int64_t count) : x(memory), y(memory + count) {}

  TRISMOOTH_HOST_DEVICE Point2<T> load(std::int32_t vertex) const { return {x[vertex], y[vertex]}; }
  TRISMOOTH_HOST_DEVICE void store(std::int32_t vertex, Point2<T> point) const {
    x[vertex] = point.x;
    y[vertex] = point.y;
  }
};

}  // namespace trismooth::cuda
