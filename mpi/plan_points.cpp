// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mpi/plan_points.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "trismooth/base/heights.h"
#include "trismooth/base/hold.h"
#include "trismooth/base/text/digits.h"

namespace trismooth::mpi {

namespace {

std::string text_of(const Point2<double>& point) {
  return "(" + shortest_text(point.x) + ", " + shortest_text(point.y) + ")";
}

/// The extents of the points of all ranks.
HeightExtents joined(HeightExtents own, const Communicator& ranks) {
  for (std::size_t k = 0; k < own.low.size(); ++k) {
    PartSums sums;
    sums.largest = {-own.low[k], own.high[k]};
    sums = ranks.joined(sums);
    own.low[k] = -sums.largest[0];
    own.high[k] = sums.largest[1];
  }
  return own;
}

}  // namespace

BulkVector<Point2<double>> PlanPoints::gathered(const ConstPointView& points) const {
  std::vector<Point2<double>> local;
  ranks_.on_all([&] {
    if (points.size() != overlap_.callers.local_count()) {
      throw std::invalid_argument("points: " + std::to_string(points.size()) + " of them, expected one for each of " +
                                  std::to_string(overlap_.callers.local_count()) + " local vertices");
    }
    local = points.read(workers_);
  });
  BulkVector<Point2<double>> all(overlap_.ids.size());
  gather<Point2<double>>(local, all, [&](std::int32_t v, const Point2<double>& a, const Point2<double>& b) {
    if (!have_same_bits(a, b)) {
      throw std::invalid_argument("points: ranks disagree about " + name_of(v) + ": " + text_of(a) + " and " +
                                  text_of(b));
    }
  });
  return all;
}

Storage PlanPoints::storage_of(const ConstPointView& points, Storage asked) const {
  const bool is_float = asked == Storage::float32 || points.storage() == Storage::float32;
  const bool has_points = overlap_.callers.local_count() > 0;
  const bool are_float_somewhere = ranks_.any(is_float && has_points);
  ranks_.on_all([&] {
    if (!is_float && are_float_somewhere && has_points) {
      throw std::invalid_argument("points, or the storage of results: double here and float on other ranks");
    }
  });
  return (has_points ? is_float : are_float_somewhere) ? Storage::float32 : Storage::float64;
}

void PlanPoints::require_one_height(const ConstPointView& points, std::span<const Point2<double>> gathered,
                                    std::span<const std::uint8_t> fixed) const {
  const bool has_heights = points.components() == 3;
  const bool has_points = overlap_.callers.local_count() > 0;
  const bool are_somewhere = ranks_.any(has_heights && has_points);
  ranks_.on_all([&] {
    if (!has_heights && are_somewhere && has_points) {
      throw std::invalid_argument("points: two numbers each here and three on other ranks");
    }
  });
  if (!are_somewhere) {
    return;
  }
  std::vector<double> local(overlap_.callers.local_count());
  for (std::size_t v = 0; v < local.size(); ++v) {
    local[v] = points.z(v);
  }
  std::vector<double> heights(overlap_.ids.size());
  gather<double>(local, heights, [&](std::int32_t v, double a, double b) {
    if (!(a == b)) {
      throw std::invalid_argument("points: ranks disagree about z of " + name_of(v));
    }
  });
  HeightExtents extents;
  for (std::size_t v = 0; v < heights.size(); ++v) {
    if (!hold::is_unused(fixed[v])) {
      extents.add(gathered[v], heights[v]);
    }
  }
  extents = joined(extents, ranks_);
  ranks_.on_all([&] { trismooth::require_one_height(extents); });
}

std::vector<double> PlanPoints::target_lengths(std::span<const double> lengths, std::span<const std::uint8_t> fixed,
                                               bool are_used) const {
  const std::size_t count = overlap_.callers.local_count();
  ranks_.on_all([&] {
    if (lengths.size() != count) {
      throw std::invalid_argument("MeanRatioOptions::target_lengths has " + std::to_string(lengths.size()) +
                                  " entries, expected one for each of " + std::to_string(count) + " local vertices");
    }
  });
  std::vector<double> all(overlap_.ids.size(), 1.0);
  gather<double>(lengths, all, [&](std::int32_t v, double a, double b) {
    if (!(a == b) && !hold::is_unused(fixed[static_cast<std::size_t>(v)])) {
      throw std::invalid_argument("MeanRatioOptions::target_lengths: ranks disagree about " + name_of(v));
    }
  });
  ranks_.on_all([&] {
    for (std::size_t v = 0; v < all.size() && are_used; ++v) {
      if ((fixed[v] & hold::isolated) == 0 && (!(all[v] > 0) || !std::isfinite(all[v]))) {
        throw std::invalid_argument("MeanRatioOptions::target_lengths: that of " +
                                    name_of(static_cast<std::int32_t>(v)) + " is not a positive number");
      }
    }
  });
  return all;
}

void PlanPoints::hand_back(std::span<const Point2<double>> all, const PointView& points) const {
  BulkVector<Point2<double>> local(overlap_.callers.local_count());
  overlap_.callers.hand_back<Point2<double>>(all, local, ranks_, workers_);
  points.write(local, workers_);
}

std::string PlanPoints::name_of(std::int32_t v) const {
  return "the vertex of id " + std::to_string(overlap_.ids[static_cast<std::size_t>(v)]);
}

}  // namespace trismooth::mpi
