#pragma once

#include <limits>

#include "trismooth/base/exact_arithmetic.h"
#include "trismooth/base/host_device.h"

namespace trismooth {

/// What a method finds for one triangle around a vertex, as it stands where the vertex is tried. V: a number, or as
/// many as there are lanes, of as many triangles.
template <class V, int count>
struct SideTerms {
  V values[count];
  V margin;  ///< positive where the triangle is as it may be
  V share;   ///< share_of_error()
};

/// The same of all of them.
template <class T, int count>
struct SideTotals {
  T sums[count] = {};  ///< of the values, added in the order of the ring: the same bits whoever adds
  T smallest_margin = std::numeric_limits<T>::max();
  T largest_share = 0;

  constexpr TRISMOOTH_HOST_DEVICE void add(const SideTerms<T, count>& terms) {
    for (int i = 0; i < count; ++i) {
      sums[i] += terms.values[i];
    }
    smallest_margin = terms.margin < smallest_margin ? terms.margin : smallest_margin;
    largest_share = terms.share > largest_share ? terms.share : largest_share;
  }
};

/// The sides of a ring, one after the other. Neighbour i is fetch(i), and make(from, to) the side between two. Each
/// neighbour is fetched while the side before its own is worked on: a device waits long for its memory.
template <class Ring, class Fetch, class Make>
class SidesInTurn {
 public:
  constexpr TRISMOOTH_HOST_DEVICE SidesInTurn(const Ring& ring, const Fetch& fetch, const Make& make)
      : ring_(ring), fetch_(fetch), make_(make) {}

  /// Calls visit(side) for each.
  template <class Visit>
  constexpr TRISMOOTH_HOST_DEVICE void visit(const Visit& visit) const {
    const int size = ring_.size();
    const auto first = fetch_(0);
    auto from = first;
    auto to = fetch_(1);
    for (int i = 2; i <= size; ++i) {
      const auto following = i < size ? fetch_(i) : first;
      visit(make_(from, to));
      from = to;
      to = following;
    }
    visit(make_(from, to));
  }

  /// The totals of term(side).
  template <class T, int count, class Term>
  constexpr TRISMOOTH_HOST_DEVICE SideTotals<T, count> totals(const Term& term) const {
    SideTotals<T, count> result;
    visit([&](const auto& side) { result.add(term(side)); });
    return result;
  }

 private:
  const Ring& ring_;
  Fetch fetch_;
  Make make_;
};

/// The sides of a ring in the way that suits where it is: a ring may have a function sides(fetch, make) of its own.
template <class Ring, class Fetch, class Make>
constexpr TRISMOOTH_HOST_DEVICE auto sides_of(const Ring& ring, const Fetch& fetch, const Make& make) {
  if constexpr (requires { ring.sides(fetch, make); }) {
    return ring.sides(fetch, make);
  } else {
    return SidesInTurn<Ring, Fetch, Make>(ring, fetch, make);
  }
}

}  // namespace trismooth
