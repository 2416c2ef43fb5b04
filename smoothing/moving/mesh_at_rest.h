// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/element_list.h"
#include "trismooth/base/index_view.h"
#include "trismooth/base/local_points.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/point2.h"
#include "trismooth/smoothing/constraints.h"
#include "trismooth/smoothing/follow_result.h"
#include "trismooth/smoothing/moving/carrier.h"
#include "trismooth/smoothing/moving/crossings.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"
#include "trismooth/smoothing/rings/mesh_rings.h"

namespace trismooth {

/// The options, where a mesh can move with them. Throws std::invalid_argument as SmoothingOptions::validate(), and for
/// vertices that slide and for sizes other than the reference's.
const SmoothingOptions& options_of_moving(const SmoothingOptions& options, const Constraints& constraints);

/// The reference of a MovingMesh, with all that is found of it before it moves, on the host. Owns all it needs.
class MeshAtRest {
 public:
  /// `rings` gets the mesh for whoever smooths it, layers held. Throws as MovingMesh's constructor. Complexity: linear,
  /// but for sorting the edges of each vertex.
  MeshAtRest(std::vector<Point2<double>> points, const IndexView& triangles, const Constraints& constraints,
             Layers layers, Workers& workers, MeshRings& rings);

  ElementList elements() const { return elements_.list(); }
  const std::vector<Point2<double>>& points() const { return points_; }
  /// The points in the frame of the vertices that cells use.
  const LocalPoints& local() const { return local_; }
  /// Why each vertex is held, bits of namespace hold, without layers, which are carried.
  const std::vector<std::uint8_t>& held() const { return held_; }
  /// held() for a frame in which free vertices have no say: these are hold::isolated.
  std::vector<std::uint8_t> held_alone() const;
  /// As the reference orients its elements, see MeshRings.
  const std::vector<std::uint8_t>& reversed() const { return reversed_; }
  const LayersResult& layers() const { return layers_; }
  const Carrier& carrier() const { return carrier_; }

  /// Those of carrier().held(). Complexity: linear in these.
  std::vector<Point2<double>> of_held(std::span<const Point2<double>> points) const;

  /// FollowResult::crossings. `now`: where each vertex of carrier().held() is, in the frame of these.
  void find_crossings(std::span<const Point2<double>> now, FollowResult& result) const;
  /// FollowResult::overlaps of vertices that overlap, ascending.
  void list_overlaps(std::span<const std::int32_t> overlapping, FollowResult& result) const;
  /// FollowResult::invalid. `now`: all vertices, in a local frame. Complexity: linear.
  void list_invalid(std::span<const Point2<double>> now, FollowResult& result) const;

 private:
  static constexpr std::size_t most_crossings = 100 * FollowResult::most_listed;

  std::vector<MeetingEdges> meetings(std::span<const Point2<double>> now, std::size_t most) const;

  OwnElements elements_;
  std::vector<Point2<double>> points_;
  LocalPoints local_;
  std::vector<std::uint8_t> held_;
  std::vector<std::uint8_t> reversed_;
  LayersResult layers_;
  Carrier carrier_;
  std::vector<MeetingEdges> crossings_;
  std::vector<std::int32_t> overlaps_;
};

}  // namespace trismooth
