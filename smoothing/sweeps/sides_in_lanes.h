#pragma once

#include <algorithm>
#include <array>
#include <type_traits>
#include <utility>

#include "trismooth/smoothing/methods/mean_ratio_energy.h"
#include "trismooth/smoothing/methods/ring_sides.h"

namespace trismooth {

/// As many numbers as fill the narrowest SIMD register: on x86-64 every processor has 16 bytes.
template <class T>
struct LanesOf {
  static constexpr int count = static_cast<int>(16 / sizeof(T));
  // An alias may not have an attribute that depends on T.
  typedef T type __attribute__((vector_size(16)));  // NOLINT(modernize-use-using)
};
template <class T>
using Lanes = typename LanesOf<T>::type;

/// Calls visit(i) for i = 0 to count - 1, each a constant.
template <int count, class Visit>
constexpr void unrolled(const Visit& visit) {
  [&]<int... i>(std::integer_sequence<int, i...>) {
    (visit(std::integral_constant<int, i>{}), ...);
  }
  (std::make_integer_sequence<int, count>());
}

/// The `size` sides of a ring, several at once in the lanes of a register; otherwise as SidesInTurn. The last lanes may
/// have sides that came before; they are not added again.
template <class T, int size, class Fetch, class Make>
class SidesInLanes {
 public:
  SidesInLanes(const Fetch& fetch, const Make& make) {
    std::array<Neighbour, size> neighbours;
    unrolled<size>([&](auto i) { neighbours[i] = fetch(i); });
    std::array<Side, size> sides;
    unrolled<size>([&](auto i) { sides[i] = make(neighbours[i], neighbours[(i + 1) % size]); });
    unrolled<groups>([&](auto group) {
      groups_[group] = InLanes::of([&](int lane) -> const Side& { return sides[(group * lanes + lane) % size]; },
                                   [](const auto& number) { return joined(number); });
    });
  }

  template <class, int count, class Term>
  SideTotals<T, count> totals(const Term& term) const {
    using V = Lanes<T>;
    SideTotals<T, count> result;
    V smallest = V{} + result.smallest_margin;
    V largest = V{};
    // The sums of two values side by side: they fill a register, too.
    std::array<V, (count + 1) / 2> pairs{};
    unrolled<groups>([&](auto group) {
      const SideTerms<V, count> terms = term(groups_[group]);
      smallest = terms.margin < smallest ? terms.margin : smallest;
      largest = terms.share > largest ? terms.share : largest;
      unrolled<std::min(lanes, size - group * lanes)>([&](auto lane) {
        unrolled<(count + 1) / 2>([&](auto pair) {
          constexpr int first = 2 * pair;
          constexpr int second = std::min(first + 1, count - 1);
          pairs[pair] += V{terms.values[first][lane()], terms.values[second][lane()]};
        });
      });
    });
    unrolled<count>([&](auto i) { result.sums[i] = pairs[i / 2][i() % 2]; });
    unrolled<lanes>([&](auto lane) {
      result.smallest_margin = smallest[lane()] < result.smallest_margin ? smallest[lane()] : result.smallest_margin;
      result.largest_share = largest[lane()] > result.largest_share ? largest[lane()] : result.largest_share;
    });
    return result;
  }

 private:
  static constexpr int lanes = LanesOf<T>::count;
  static constexpr int groups = (size + lanes - 1) / lanes;
  using Neighbour = std::invoke_result_t<Fetch, int>;
  using Side = std::invoke_result_t<Make, Neighbour, Neighbour>;
  using InLanes = typename Side::template With<Lanes<T>>;

  /// number(0), number(1), ... in a register: written to memory one by one they would be late to be read as one.
  template <class Number>
  static Lanes<T> joined(const Number& number) {
    return [&]<int... lane>(std::integer_sequence<int, lane...>) {
      return Lanes<T>{number(lane)...};
    }
    (std::make_integer_sequence<int, lanes>());
  }

  std::array<InLanes, groups> groups_;
};

}  // namespace trismooth
