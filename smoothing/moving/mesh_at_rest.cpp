// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/moving/mesh_at_rest.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "trismooth/base/mesh_size.h"
#include "trismooth/quality/element.h"
#include "trismooth/smoothing/moving/overlaps.h"
#include "trismooth/smoothing/rings/analysed_mesh.h"

namespace trismooth {

namespace {

LocalPoints in_frame_of(std::span<const Point2<double>> points, std::span<const std::uint8_t> held, Workers& workers) {
  return local_points(
      points, [held](std::size_t v) { return !hold::is_unused(held[v]); }, workers);
}

}  // namespace

const SmoothingOptions& options_of_moving(const SmoothingOptions& options, const Constraints& constraints) {
  options.validate();
  if (constraints.slide.along != Slide::off) {
    throw std::invalid_argument(
        "slide: vertices that slide have no place of their own; say where they are, without sliding");
  }
  if (!options.mean_ratio.target_lengths.empty()) {
    throw std::invalid_argument("target_lengths: a mesh that moves has the sizes of its reference");
  }
  return options;
}

MeshAtRest::MeshAtRest(std::vector<Point2<double>> points, const IndexView& triangles, const Constraints& constraints,
                       Layers layers, Workers& workers, MeshRings& rings)
    : points_(std::move(points)) {
  check_mesh_size(std::ssize(points_), static_cast<std::int64_t>(triangles.size()),
                  triangles.may_have_quadrilaterals() ? 4 : 3);
  elements_.keep(as_triangles_where_all_are(triangles.list(std::ssize(points_), elements_), elements_));
  AnalysedMesh mesh(static_cast<std::int32_t>(points_.size()), elements(), constraints, workers);
  held_ = mesh.fixed();
  local_ = in_frame_of(points_, held_, workers);
  mesh.look_at(local_.points, elements(), layers, workers);
  layers_ = mesh.layers();
  reversed_ = mesh.reversed();
  // What is carried is not held, layers are.
  carrier_ = Carrier(mesh.rings_of(held_, elements(), workers).view(), elements(), local_.points);
  crossings_ = meetings(of_held(in_frame_of(points_, held_alone(), workers).points), most_crossings);
  overlaps_ = overlapping_vertices(elements(), reversed_, held_, local_.points, workers);
  rings = std::move(mesh).with_rings(elements(), workers);
}

std::vector<std::uint8_t> MeshAtRest::held_alone() const {
  std::vector<std::uint8_t> held = held_;
  std::ranges::replace(held, std::uint8_t{0}, hold::isolated);
  return held;
}

std::vector<Point2<double>> MeshAtRest::of_held(std::span<const Point2<double>> points) const {
  std::vector<Point2<double>> found;
  found.reserve(carrier_.held().size());
  for (const std::int32_t v : carrier_.held()) {
    found.push_back(points[v]);
  }
  return found;
}

std::vector<MeetingEdges> MeshAtRest::meetings(std::span<const Point2<double>> now, std::size_t most) const {
  return meeting_edges(carrier_.edges(), now, most);
}

void MeshAtRest::find_crossings(std::span<const Point2<double>> now, FollowResult& result) const {
  if (crossings_.size() >= most_crossings) {
    return;
  }
  const std::vector<std::int32_t>& held = carrier_.held();
  const auto& edges = carrier_.edges();
  for (const auto& [one, other, do_cross] : meetings(now, crossings_.size() + FollowResult::most_listed)) {
    // What touched at rest may touch, what crossed may do either.
    const auto at_rest = std::ranges::lower_bound(crossings_, MeetingEdges{one, other, false});
    const bool met = at_rest != crossings_.end() && at_rest->one == one && at_rest->other == other;
    if ((!met || (do_cross && !at_rest->cross)) && result.crossings.size() < FollowResult::most_listed) {
      result.crossings.push_back(
          {held[edges[one][0]], held[edges[one][1]], held[edges[other][0]], held[edges[other][1]]});
    }
  }
}

void MeshAtRest::list_overlaps(std::span<const std::int32_t> overlapping, FollowResult& result) const {
  for (const std::int32_t v : overlapping) {
    if (!std::ranges::binary_search(overlaps_, v) && result.overlaps.size() < FollowResult::most_listed) {
      result.overlaps.push_back(v);
    }
  }
}

void MeshAtRest::list_invalid(std::span<const Point2<double>> now, FollowResult& result) const {
  elements().visit([&](const auto& listed) {
    for (std::size_t e = 0; e < listed.size() && result.invalid.size() < FollowResult::most_listed; ++e) {
      if (!(quotient_at(canonical_corners(listed[e], reversed_[e] != 0), now) > 0)) {
        result.invalid.push_back(static_cast<std::int32_t>(e));
      }
    }
  });
}

}  // namespace trismooth
