// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <limits>

#include "trismooth/cuda/primitives/reduce.cuh"
#include "trismooth/cuda/topology/element_quotients.h"
#include "trismooth/quality/element.h"

namespace trismooth::cuda {

namespace {

template <class List>
struct FixedQuotient {
  List elements;
  const Point2<double>* points;
  const std::uint8_t* reversed;
  const std::uint8_t* fixed;

  TRISMOOTH_HOST_DEVICE double operator()(std::uint32_t e) const {
    const auto corners = canonical_corners(elements[e], reversed[e] != 0);
    return all_are_fixed(corners, fixed) ? quotient_at(corners, points) : std::numeric_limits<double>::infinity();
  }
};

struct Smaller {
  TRISMOOTH_HOST_DEVICE double operator()(double a, double b) const { return b < a ? b : a; }
};

/// Both counts in one number: inverted elements above, those without area below. Neither has more than 31 bits.
constexpr unsigned bits_of_count = 32;

template <class List>
struct Invalid {
  List elements;
  const Point2<double>* stored;
  const LocalFrame* frame;
  const std::uint8_t* reversed;

  TRISMOOTH_HOST_DEVICE std::uint64_t operator()(std::uint32_t e) const {
    const double quotient = quotient_at(canonical_corners(elements[e], reversed[e] != 0),
                                        [&](std::int32_t v) { return frame->enter(stored[v]); });
    return quotient < 0 ? std::uint64_t{1} << bits_of_count : quotient == 0 ? 1 : 0;
  }
};

struct Sum {
  TRISMOOTH_HOST_DEVICE std::uint64_t operator()(std::uint64_t a, std::uint64_t b) const { return a + b; }
};

}  // namespace

template <class List>
double smallest_fixed_quotient(Context& context, const List& elements, const Point2<double>* points,
                               const std::uint8_t* reversed, const std::uint8_t* fixed) {
  return reduce(context, static_cast<std::uint32_t>(elements.count), std::numeric_limits<double>::infinity(),
                FixedQuotient<List>{elements, points, reversed, fixed}, Smaller{});
}

template <class List>
InvalidCounts invalid_elements(Context& context, const List& elements, const Point2<double>* stored,
                               const LocalFrame* frame, const std::uint8_t* reversed) {
  const std::uint64_t counts = reduce(context, static_cast<std::uint32_t>(elements.count), std::uint64_t{0},
                                      Invalid<List>{elements, stored, frame, reversed}, Sum{});
  constexpr std::uint64_t lower = (std::uint64_t{1} << bits_of_count) - 1;
  return {static_cast<std::int64_t>(counts >> bits_of_count), static_cast<std::int64_t>(counts & lower)};
}

template double smallest_fixed_quotient(Context&, const TriangleList&, const Point2<double>*, const std::uint8_t*,
                                        const std::uint8_t*);
template double smallest_fixed_quotient(Context&, const MixedList&, const Point2<double>*, const std::uint8_t*,
                                        const std::uint8_t*);
template InvalidCounts invalid_elements(Context&, const TriangleList&, const Point2<double>*, const LocalFrame*,
                                        const std::uint8_t*);
template InvalidCounts invalid_elements(Context&, const MixedList&, const Point2<double>*, const LocalFrame*,
                                        const std::uint8_t*);

}  // namespace trismooth::cuda
