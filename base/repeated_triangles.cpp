// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/repeated_triangles.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <functional>
#include <limits>
#include <span>
#include <tuple>

#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/prefix_sums.h"
#include "trismooth/base/splitmix64.h"
#include "trismooth/base/triangle_view.h"

namespace trismooth {

namespace {

constexpr std::int64_t triangle_grain = 16384;

/// The corners as all copies have them: from the lowest to the highest, without a branch that could be mispredicted.
Triangle as_of_copies(const Triangle& triangle) {
  const auto [a, b, c] = triangle;
  const std::int32_t low = std::min({a, b, c});
  const std::int32_t high = std::max({a, b, c});
  return {low, a ^ b ^ c ^ low ^ high, high};
}

/// Of a quadrilateral from the lowest on, in the direction in which the lower one of its neighbours comes next.
MixedElement as_of_copies(const MixedElement& element) {
  if (element[3] == no_corner) {
    const auto [low, middle, high] = as_of_copies(Triangle{element[0], element[1], element[2]});
    return {low, middle, high, no_corner};
  }
  const MixedElement corners = canonical_corners(element, false);
  return corners[1] < corners[3] ? corners : canonical_corners(element, true);
}

/// A key of the first three corners.
std::uint64_t print_of_three(std::int32_t a, std::int32_t b, std::int32_t c, std::uint64_t seed) {
  constexpr std::uint64_t odd = 0xd6e8feb86659fd93U;
  const std::uint64_t two = static_cast<std::uint64_t>(a) << 32U | static_cast<std::uint32_t>(b);
  return splitmix64(two + odd * (static_cast<std::uint64_t>(c) + seed));
}

/// Which copies of an element share: a key of its sides.
std::uint64_t print_of(const Triangle& triangle, std::uint64_t seed) {
  const auto [low, middle, high] = as_of_copies(triangle);
  return print_of_three(low, middle, high, seed);
}
std::uint64_t print_of(const MixedElement& element, std::uint64_t seed) {
  const auto [a, b, c, d] = as_of_copies(element);
  return splitmix64(print_of_three(a, b, c, seed) + static_cast<std::uint64_t>(d));
}

/// Bits that many threads set; each print has one.
class SharedBits {
 public:
  explicit SharedBits(std::size_t bits) : words_(std::bit_ceil(std::max<std::size_t>(bits, 64)) / 64, 0) {}

  /// Returns whether it was set.
  bool set(std::uint64_t print) {
    return (std::atomic_ref(words_[place(print)]).fetch_or(bit(print), std::memory_order_relaxed) & bit(print)) != 0;
  }
  bool has(std::uint64_t print) const { return (words_[place(print)] & bit(print)) != 0; }

 private:
  static std::uint64_t bit(std::uint64_t print) { return std::uint64_t{1} << (print & 63U); }
  std::size_t place(std::uint64_t print) const { return static_cast<std::size_t>(print >> 6U) & (words_.size() - 1); }

  std::vector<std::uint64_t> words_;
};

/// Those of `count` triangles that have the bit of another one: all copies with their firsts, and at most an eighth of
/// the others. number_of(i): the number of the triangle in place i.
template <class Corners, class NumberOf>
BulkVector<std::int32_t> with_common_bits(std::span<const Corners> triangles, std::size_t count,
                                          const NumberOf& number_of, std::uint64_t seed, Workers& workers) {
  constexpr std::size_t bits_a_triangle = 8;
  const auto print_at = [&](std::int64_t i) {
    return print_of(triangles[static_cast<std::size_t>(number_of(i))], seed);
  };
  SharedBits met(bits_a_triangle * count);
  SharedBits met_again(bits_a_triangle * count);
  workers.for_blocks(static_cast<std::int64_t>(count), triangle_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      if (const std::uint64_t print = print_at(i); met.set(print)) {
        met_again.set(print);
      }
    }
  });
  return numbers_of(
      static_cast<std::int64_t>(count), [&](std::int64_t i) { return met_again.has(print_at(i)); }, workers, number_of);
}

/// An element that may be there more than once.
template <class Corners>
struct Suspect {
  Corners corners;  ///< as_of_copies()
  std::int32_t triangle;

  bool operator<(const Suspect& other) const {
    return std::tie(corners, triangle) < std::tie(other.corners, other.triangle);
  }
};

template <class Corners>
std::vector<RepeatedTriangle> find_repeated(std::span<const Corners> triangles, Workers& workers) {
  const auto some = with_common_bits(
      triangles, triangles.size(), [](std::int64_t i) { return static_cast<std::int32_t>(i); }, 0, workers);
  const auto few = with_common_bits(
      triangles, some.size(), [&](std::int64_t i) { return some[static_cast<std::size_t>(i)]; }, 1, workers);
  std::vector<Suspect<Corners>> suspects;
  suspects.reserve(few.size());
  for (const std::int32_t t : few) {
    suspects.push_back({as_of_copies(triangles[static_cast<std::size_t>(t)]), t});
  }
  std::ranges::sort(suspects, std::less<>{});
  std::vector<RepeatedTriangle> repeated;
  for (std::size_t i = 1, first = 0; i < suspects.size(); ++i) {
    if (suspects[i].corners == suspects[first].corners) {
      repeated.push_back({suspects[i].triangle, suspects[first].triangle});
    } else {
      first = i;
    }
  }
  std::ranges::sort(repeated, {}, &RepeatedTriangle::triangle);
  return repeated;
}

}  // namespace

std::vector<RepeatedTriangle> find_repeated_triangles(const IndexView& triangles, Workers& workers) {
  OwnElements converted;
  return triangles.list(std::numeric_limits<std::int32_t>::max(), converted).visit([&](const auto& listed) {
    return find_repeated(listed, workers);
  });
}

std::vector<RepeatedTriangle> find_repeated_triangles(const IndexView& triangles, int threads) {
  Workers workers(threads);
  return find_repeated_triangles(triangles, workers);
}

}  // namespace trismooth
