// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <type_traits>
#include <vector>

#include <cuda_runtime.h>

#include "trismooth/cuda/primitives/point_array.h"
#include "trismooth/smoothing/methods/one_ring_update.h"

#include "catch.h"
#include "hard_rings.h"

/// For tests that run what evaluates vertices on the device, and compare bits with the host.
namespace update_checks {

using hard_rings::Vertex;
using trismooth::Move;
using trismooth::Point2;

inline void require_success(cudaError_t error) {
  INFO(cudaGetErrorString(error));
  REQUIRE(error == cudaSuccess);
}

inline void finish_launch() {
  require_success(cudaGetLastError());
  require_success(cudaDeviceSynchronize());
}

/// An array that host and device read and write, at first all zero. It has one element more, since none can be empty.
template <class E>
class SharedArray {
 public:
  explicit SharedArray(std::size_t size) {
    void* memory = nullptr;
    require_success(cudaMallocManaged(&memory, (size + 1) * sizeof(E)));
    std::memset(memory, 0, (size + 1) * sizeof(E));
    values_.reset(static_cast<E*>(memory));
  }
  explicit SharedArray(const std::vector<E>& values) : SharedArray(values.size()) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      values_[i] = values[i];
    }
  }
  E* data() const { return values_.get(); }
  const E& operator[](int i) const { return values_[static_cast<std::size_t>(i)]; }

 private:
  struct Free {
    void operator()(E* memory) const { cudaFree(memory); }
  };
  std::unique_ptr<E[], Free> values_;
};

template <class T>
bool same_bits(T a, T b) {
  using Bits = std::conditional_t<sizeof(T) == sizeof(std::uint32_t), std::uint32_t, std::uint64_t>;
  return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
}

template <class T>
bool same_bits(const Move<T>& a, const Move<T>& b) {
  return a.moved == b.moved && same_bits(a.position.x, b.position.x) && same_bits(a.position.y, b.position.y);
}

/// The sum by which a move is measured: see VertexMove.
template <class T, class Ring>
constexpr TRISMOOTH_HOST_DEVICE T sum_of_tally(Point2<T> position, const Ring& ring) {
  T sum = 0;
  for (int i = 0; i < ring.size(); ++i) {
    sum += squared_length(ring[i] - position);
  }
  return sum;
}

/// Vertices one after the other, each of them followed by its neighbours.
template <class T>
struct PointList {
  std::vector<Point2<T>> points;
  std::vector<std::int32_t> numbers;  ///< of the vertices
  std::vector<std::int32_t> sizes;

  explicit PointList(const std::vector<Vertex<T>>& vertices) {
    for (const Vertex<T>& vertex : vertices) {
      numbers.push_back(static_cast<std::int32_t>(points.size()));
      sizes.push_back(vertex.ring_size());
      points.push_back(vertex.position);
      points.insert(points.end(), vertex.neighbours.begin(), vertex.neighbours.end());
    }
  }

  std::vector<trismooth::cuda::PointRecord<T>> records() const {
    std::vector<trismooth::cuda::PointRecord<T>> values;
    for (const Point2<T>& point : points) {
      values.push_back({point.x, point.y});
    }
    return values;
  }
};

/// How often something was found, and where first. Counted, since a quarter of a million checks say no more.
struct Count {
  int number = 0;
  int first = -1;

  void add(bool found, int i) {
    first = found && number == 0 ? i : first;
    number += found ? 1 : 0;
  }
};

inline void require_none(const char* what, const Count& found) {
  INFO(what << ", first at " << found.first);
  CHECK(found.number == 0);
}

}  // namespace update_checks
