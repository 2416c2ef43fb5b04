// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "trismooth/base/point2.h"

namespace trismooth {

/// A free vertex and the triangles around it, as a method of the caller's own sees them in a sweep. Positions are those
/// of the moment, in the caller's coordinates (to the last digits of them: they have been through the local frame); of
/// a mesh in a tilted plane of space, which an OpenMesh mesh or a file may have, along two axes in that plane.
struct VertexNeighbourhood {
  std::int32_t vertex = 0;    ///< its number
  Point2<double> position{};  ///< where it is
  /// Its neighbours, counter-clockwise: the vertex, neighbours[i] and neighbours[(i + 1) % size] are a triangle. For
  /// the time of the call.
  std::span<const Point2<double>> neighbours{};
  std::span<const std::int32_t> numbers{};  ///< of the neighbours
};

/// When a vertex goes where a proposal wants it.
enum class Acceptance : std::uint8_t {
  better_worst,  ///< where the smallest shape around it gets larger, and no more triangles are inverted: Method::smart
  lower_energy,  ///< where Proposal::energy gets smaller
  always,
};

/// A method of the caller's own, in place of SmoothingOptions::method. Its functions are called by several threads at
/// once, for vertices that share no edge in Form B, in any order within a colour; as long as what they answer depends
/// on what they are given alone, the result is the same bits for every number of threads. What they throw, smooth()
/// throws, and the points are untouched. The guard, constraints, stops and records are those of every method.
struct Proposal {
  /// Where the vertex is to go; it stays for nothing, no finite point, or one some extents of the mesh outside. Or
  /// empty.
  std::function<std::optional<Point2<double>>(const VertexNeighbourhood&)> place{};
  Acceptance accept = Acceptance::better_worst;
  /// With Acceptance::lower_energy: what is to get smaller, of a vertex where it is and where it would be.
  std::function<double(const VertexNeighbourhood&)> energy{};

  /// Whether there is one.
  explicit operator bool() const { return static_cast<bool>(place); }
};

}  // namespace trismooth
