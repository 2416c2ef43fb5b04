// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/orientation.h"

#include <atomic>

#include "trismooth/base/machine/workers.h"
#include "trismooth/quality/corner_points.h"
#include "trismooth/quality/orientation_sign.h"

namespace trismooth {

namespace {

constexpr std::int64_t orientation_grain = 4096;

/// Adds to votes that others add to as well.
void add(const OrientationVotes& some, OrientationVotes& all) {
  const auto sum = [](std::int64_t value, std::int64_t& total) {
    std::atomic_ref(total).fetch_add(value, std::memory_order_relaxed);
  };
  sum(some.positive, all.positive);
  sum(some.negative, all.negative);
  sum(some.triangles, all.triangles);
  sum(some.against, all.against);
  const std::atomic_ref first(all.first);
  for (std::int64_t found = first.load(std::memory_order_relaxed);
       some.first < found && !first.compare_exchange_weak(found, some.first, std::memory_order_relaxed);) {
  }
}

/// Calls vote(element, sign) for elements [begin, end) of the view, in order. The sign that counts is that of the
/// quality in every report and in the guard, where an element is so nearly degenerate that rounding gives it one.
template <class Vote>
void for_signs(const TriangleView& view, std::int64_t begin, std::int64_t end, const Vote& vote) {
  for_corners(view, static_cast<std::size_t>(begin), static_cast<std::size_t>(end),
              [&](std::size_t first, std::span<const CornerPoints> corners) {
                for (std::size_t i = 0; i < corners.size(); ++i) {
                  vote(static_cast<std::int64_t>(first + i), shape_quotient(corners[i]));
                }
              });
}
template <class Vote>
void for_signs(const ElementView<MixedElement>& view, std::int64_t begin, std::int64_t end, const Vote& vote) {
  for (std::int64_t e = begin; e < end; ++e) {
    vote(e, orientation_sign(canonical_corners(view, static_cast<std::size_t>(e)), view.points));
  }
}

template <class Corners>
std::vector<OrientationVotes> votes_of(const TriangleComponents& components, std::span<const Corners> elements,
                                       std::span<const Point2<double>> points, std::span<const std::uint8_t> left_out,
                                       Workers& workers) {
  std::vector<OrientationVotes> votes(static_cast<std::size_t>(components.components));
  const ElementView<Corners> listed{points, elements, components.parity};
  workers.for_blocks(std::ssize(elements), orientation_grain, [&](std::int64_t begin, std::int64_t end) {
    OrientationVotes some;  // of elements that follow each other in one component
    for_signs(listed, begin, end, [&](std::int64_t e, double sign) {
      if (left_out.empty() || left_out[e] == 0) {
        some.positive += sign > 0 ? 1 : 0;
        some.negative += sign < 0 ? 1 : 0;
        if (some.first == OrientationVotes::nobody && sign != 0) {
          some.first = 2 * e + (sign > 0 ? 0 : 1);
        }
        ++some.triangles;
        some.against += components.parity[e];
      }
      if (e + 1 == end || components.component[e + 1] != components.component[e]) {
        add(some, votes[components.component[e]]);
        some = {};
      }
    });
  });
  return votes;
}

template <class Corners>
Orientation oriented(const TriangleComponents& components, std::span<const Corners> elements,
                     std::span<const Point2<double>> points, Workers& workers) {
  const std::vector<OrientationVotes> votes = orientation_votes(components, elements, points, {}, workers);
  Orientation orientation;
  for (const OrientationVotes& all : votes) {
    orientation.reoriented_triangles += all.reoriented_triangles();
  }
  orientation.reversed.resize(elements.size());
  workers.for_blocks(std::ssize(elements), orientation_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t e = begin; e < end; ++e) {
      const bool flip = votes[components.component[e]].flip();
      orientation.reversed[e] = static_cast<std::uint8_t>(components.parity[e] ^ (flip ? 1U : 0U));
    }
  });
  return orientation;
}

}  // namespace

std::vector<OrientationVotes> orientation_votes(const TriangleComponents& components,
                                                std::span<const Triangle> triangles,
                                                std::span<const Point2<double>> points,
                                                std::span<const std::uint8_t> left_out, Workers& workers) {
  return votes_of(components, triangles, points, left_out, workers);
}
std::vector<OrientationVotes> orientation_votes(const TriangleComponents& components,
                                                std::span<const MixedElement> elements,
                                                std::span<const Point2<double>> points,
                                                std::span<const std::uint8_t> left_out, Workers& workers) {
  return votes_of(components, elements, points, left_out, workers);
}

Orientation orient(const TriangleComponents& components, std::span<const Triangle> triangles,
                   std::span<const Point2<double>> points, Workers& workers) {
  return oriented(components, triangles, points, workers);
}
Orientation orient(const TriangleComponents& components, std::span<const MixedElement> elements,
                   std::span<const Point2<double>> points, Workers& workers) {
  return oriented(components, elements, points, workers);
}

Orientation orient(const TriangleComponents& components, std::span<const Triangle> triangles,
                   std::span<const Point2<double>> points) {
  Workers one(1);
  return orient(components, triangles, points, one);
}

}  // namespace trismooth
