#include "trismooth/quality/orientation.h"

#include <algorithm>
#include <atomic>
#include <limits>

#include "trismooth/base/workers.h"
#include "trismooth/quality/corner_points.h"
#include "trismooth/quality/triangle_quality.h"

namespace trismooth {

namespace {

constexpr std::int64_t orientation_grain = 4096;

/// What the triangles of a component say of its orientation. Sums and a minimum: their order does not matter.
struct Votes {
  static constexpr std::int64_t nobody = std::numeric_limits<std::int64_t>::max();

  std::int64_t positive = 0;
  std::int64_t negative = 0;
  std::int64_t first = nobody;  ///< 2 t for the lowest-numbered triangle t that has a sign, + 1 where it is negative
  std::int64_t triangles = 0;
  std::int64_t against = 0;

  bool flip() const { return negative != positive ? negative > positive : first != nobody && first % 2 != 0; }
};

/// Adds to votes that others add to as well.
void add(const Votes& some, Votes& all) {
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

}  // namespace

Orientation orient(const TriangleComponents& components, std::span<const Triangle> triangles,
                   std::span<const Point2<double>> points, Workers& workers) {
  std::vector<Votes> votes(static_cast<std::size_t>(components.components));
  const TriangleView listed{points, triangles, components.parity};
  workers.for_blocks(std::ssize(triangles), orientation_grain, [&](std::int64_t begin, std::int64_t end) {
    Votes some;  // of triangles that follow each other in one component
    const auto vote = [&](std::int64_t t, const CornerPoints& corners) {
      // Where a triangle is nearly degenerate, rounding gives it a sign that differs with the corner that comes first:
      // the sign that counts is that of its quality in every report and in the guard.
      const auto& [a, b, c] = corners;
      const double quotient = shape_quotient(a, b, c);
      some.positive += quotient > 0 ? 1 : 0;
      some.negative += quotient < 0 ? 1 : 0;
      if (some.first == Votes::nobody && quotient != 0) {
        some.first = 2 * t + (quotient > 0 ? 0 : 1);
      }
      ++some.triangles;
      some.against += components.parity[t];
      if (t + 1 == end || components.component[t + 1] != components.component[t]) {
        add(some, votes[components.component[t]]);
        some = {};
      }
    };
    for_corners(listed, static_cast<std::size_t>(begin), static_cast<std::size_t>(end),
                [&](std::size_t first, std::span<const CornerPoints> corners) {
                  for (std::size_t i = 0; i < corners.size(); ++i) {
                    vote(static_cast<std::int64_t>(first + i), corners[i]);
                  }
                });
  });
  Orientation orientation;
  for (const Votes& all : votes) {
    orientation.reoriented_triangles += std::min(all.against, all.triangles - all.against);
  }
  orientation.reversed.resize(triangles.size());
  workers.for_blocks(std::ssize(triangles), orientation_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t < end; ++t) {
      const bool flip = votes[components.component[t]].flip();
      orientation.reversed[t] = static_cast<std::uint8_t>(components.parity[t] ^ (flip ? 1U : 0U));
    }
  });
  return orientation;
}

Orientation orient(const TriangleComponents& components, std::span<const Triangle> triangles,
                   std::span<const Point2<double>> points) {
  Workers one(1);
  return orient(components, triangles, points, one);
}

}  // namespace trismooth
