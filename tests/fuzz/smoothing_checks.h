// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/local_frame.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/smoothing/constraints.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"

namespace fuzz {

using trismooth::Point2;
using trismooth::Triangle;

/// What the edges of a triangle list say, found by maps of edges: as simple as it can be, and slow.
struct NaiveTopology {
  std::vector<std::uint8_t> fixed;     ///< per vertex: it may not move
  std::vector<std::uint8_t> reversed;  ///< per triangle: listed clockwise in the consistent orientation
  std::vector<std::uint8_t> used;      ///< per vertex: a triangle or another cell uses it
  bool orientable = true;
};

/// Indices are in range, corners differ, `constraints` fit. `points`: as stored.
NaiveTopology naive_topology(std::span<const Point2<double>> points, std::span<const Triangle> triangles,
                             const trismooth::Constraints& constraints);

/// A smoothing as one who was not there sees it.
struct Smoothing {
  std::span<const Triangle> triangles;
  const NaiveTopology& topology;
  std::span<const Point2<double>> before;  ///< as stored
  std::span<const Point2<double>> after;   ///< as stored
  const trismooth::SmoothingOptions& options;
  const trismooth::SmoothingResult& result;
};

/// Everything is finite, fixed vertices have their bits, no element that was valid is not any more, none is below the
/// worst that was touched and below what it was, the result counts what happened. Throws Broken.
void require_never_worse(const Smoothing& smoothing);

/// The local frame of the points whose flag is not 0.
trismooth::LocalFrame frame_of_used(std::span<const Point2<double>> points, std::span<const std::uint8_t> used);

bool same_bits(Point2<double> a, Point2<double> b);

}  // namespace fuzz
