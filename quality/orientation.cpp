// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/orientation.h"

#include <atomic>

#include "trismooth/base/machine/workers.h"
#include "trismooth/quality/corner_points.h"

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

}  // namespace

std::vector<OrientationVotes> orientation_votes(const TriangleComponents& components,
                                                std::span<const Triangle> triangles,
                                                std::span<const Point2<double>> points,
                                                std::span<const std::uint8_t> left_out, Workers& workers) {
  std::vector<OrientationVotes> votes(static_cast<std::size_t>(components.components));
  const TriangleView listed{points, triangles, components.parity};
  workers.for_blocks(std::ssize(triangles), orientation_grain, [&](std::int64_t begin, std::int64_t end) {
    OrientationVotes some;  // of triangles that follow each other in one component
    const auto vote = [&](std::int64_t t, const CornerPoints& corners) {
      if (left_out.empty() || left_out[t] == 0) {
        // Where a triangle is nearly degenerate, rounding gives it a sign that differs with the corner that comes
        // first: the sign that counts is that of its quality in every report and in the guard.
        const double quotient = shape_quotient(corners);
        some.positive += quotient > 0 ? 1 : 0;
        some.negative += quotient < 0 ? 1 : 0;
        if (some.first == OrientationVotes::nobody && quotient != 0) {
          some.first = 2 * t + (quotient > 0 ? 0 : 1);
        }
        ++some.triangles;
        some.against += components.parity[t];
      }
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
  return votes;
}

Orientation orient(const TriangleComponents& components, std::span<const Triangle> triangles,
                   std::span<const Point2<double>> points, Workers& workers) {
  const std::vector<OrientationVotes> votes = orientation_votes(components, triangles, points, {}, workers);
  Orientation orientation;
  for (const OrientationVotes& all : votes) {
    orientation.reoriented_triangles += all.reoriented_triangles();
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
