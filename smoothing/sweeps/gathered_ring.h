#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/point2.h"

namespace trismooth {

/// The positions and numbers of a ring of `Size` neighbours: the compiler unrolls every loop over it.
template <class T, int Size>
struct FixedRing {
  std::array<Point2<T>, Size> positions;
  const std::int32_t* numbers;

  static constexpr int size() { return Size; }
  constexpr Point2<T> operator[](int i) const { return positions[i]; }
  constexpr std::int32_t number(int i) const { return numbers[i]; }
};

/// Those of a ring of any size, in memory that somebody else owns.
template <class T>
struct LongRing {
  std::span<const Point2<T>> positions;
  const std::int32_t* numbers;

  int size() const { return static_cast<int>(positions.size()); }
  Point2<T> operator[](int i) const { return positions[i]; }
  std::int32_t number(int i) const { return numbers[i]; }
};

/// Fetches the positions of a ring once, for all the passes of an update over it.
template <class T>
class RingGatherer {
 public:
  /// Calls `function` with a ring of the positions points[ring[0]], points[ring[1]], ...
  template <class Function>
  auto with_ring(std::span<const Point2<T>> points, std::span<const std::int32_t> ring, const Function& function) {
    switch (ring.size()) {
      case 3:
        return function(fixed<3>(points, ring));
      case 4:
        return function(fixed<4>(points, ring));
      case 5:
        return function(fixed<5>(points, ring));
      case 6:
        return function(fixed<6>(points, ring));
      case 7:
        return function(fixed<7>(points, ring));
      case 8:
        return function(fixed<8>(points, ring));
      case 9:
        return function(fixed<9>(points, ring));
      default:
        break;
    }
    return with_ring_of_any_size(points, ring, function);
  }

  /// with_ring() by code that is not unrolled.
  template <class Function>
  auto with_ring_of_any_size(std::span<const Point2<T>> points, std::span<const std::int32_t> ring,
                             const Function& function) {
    buffer_.clear();
    for (const std::int32_t neighbour : ring) {
      buffer_.push_back(points[neighbour]);
    }
    return function(LongRing<T>{buffer_, ring.data()});
  }

 private:
  template <int Size>
  static FixedRing<T, Size> fixed(std::span<const Point2<T>> points, std::span<const std::int32_t> ring) {
    FixedRing<T, Size> gathered;
    gathered.numbers = ring.data();
    for (int i = 0; i < Size; ++i) {
      gathered.positions[i] = points[ring[i]];
    }
    return gathered;
  }

  std::vector<Point2<T>> buffer_;
};

}  // namespace trismooth
