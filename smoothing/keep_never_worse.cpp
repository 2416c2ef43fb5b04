// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/keep_never_worse.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/base/box.h"
#include "trismooth/base/errors.h"
#include "trismooth/base/heights.h"
#include "trismooth/base/hold.h"
#include "trismooth/base/local_points.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/mesh_size.h"
#include "trismooth/base/text/digits.h"
#include "trismooth/smoothing/commit.h"
#include "trismooth/smoothing/invalid_triangles.h"
#include "trismooth/smoothing/rings/analysed_mesh.h"

namespace trismooth {

namespace {

void require_same_kind(const ConstPointView& before, const ConstPointView& after) {
  if (before.size() != after.size()) {
    throw std::invalid_argument("before has " + std::to_string(before.size()) + " points, after " +
                                std::to_string(after.size()));
  }
  if (before.storage() != after.storage()) {
    throw std::invalid_argument("before and after hold numbers of different types: one float, the other double");
  }
}

std::vector<Point2<double>> read(const ConstPointView& points, const AnalysedMesh& mesh, Workers& workers) {
  std::vector<Point2<double>> read = points.read(workers);
  if (points.components() == 3) {
    require_one_height(points, read, [&mesh] { return mesh.fixed(); });
  }
  return read;
}

/// What moves keeps its height.
void require_same_heights(const ConstPointView& before, const ConstPointView& after) {
  if (before.components() != 3 || after.components() != 3) {
    return;
  }
  for (std::size_t v = 0; v < before.size(); ++v) {
    if (std::bit_cast<std::uint64_t>(before.z(v)) != std::bit_cast<std::uint64_t>(after.z(v))) {
      throw MeshError("vertex " + std::to_string(v) + " has z " + shortest_text(after.z(v)) + ", and had " +
                      shortest_text(before.z(v)) + " before: what has moved along x and y alone can be looked at");
    }
  }
}

/// What has gone so many times the mesh's extent out of it goes back: in a frame that had it in view as well nothing
/// could be told of the others.
constexpr double too_far = 0x1p100;

/// Puts back what is held, which it lists, and what is too far away.
void put_back(std::span<const Point2<double>> before, std::span<Point2<double>> moved,
              std::span<const std::uint8_t> held, KeptMoves& kept) {
  Box box;
  for (std::size_t v = 0; v < before.size(); ++v) {
    if (!hold::is_unused(held[v])) {
      box.add(before[v]);
    }
  }
  // Halves: the whole may be beyond the range of double.
  const Point2<double> centre{box.low.x / 2 + box.high.x / 2, box.low.y / 2 + box.high.y / 2};
  const double half = std::max(box.high.x / 2 - box.low.x / 2, box.high.y / 2 - box.low.y / 2);
  const auto is_too_far = [&](Point2<double> place) {
    return half > 0 &&
           std::max(std::abs(place.x / 2 - centre.x / 2), std::abs(place.y / 2 - centre.y / 2)) / too_far > half;
  };
  for (std::size_t v = 0; v < before.size(); ++v) {
    if (moved[v] == before[v]) {
      continue;
    }
    if (held[v] != 0) {
      kept.held.push_back(static_cast<std::int32_t>(v));
    } else if (is_too_far(moved[v])) {
      kept.reverted.push_back({static_cast<std::int32_t>(v), moved[v]});
    } else {
      continue;
    }
    moved[v] = before[v];
  }
}

/// The frame of the vertices that cells use, where they were and where they are: they may have gone far.
LocalFrame frame_of_both(std::span<const Point2<double>> before, std::span<const Point2<double>> after,
                         std::span<const std::uint8_t> held) {
  Box box;
  for (std::size_t v = 0; v < before.size(); ++v) {
    if (!hold::is_unused(held[v])) {
      box.add(before[v]);
      box.add(after[v]);
    }
  }
  return local_frame(box.low, box.high);
}

/// keep_never_worse() of elements as they are listed.
template <class Corners>
KeptMoves kept_moves(const ConstPointView& before, const PointView& after, std::span<const Corners> listed,
                     const Constraints& constraints, const SmoothingOptions& options, Workers& workers) {
  AnalysedMesh mesh(static_cast<std::int32_t>(before.size()), listed, constraints, workers);
  std::vector<Point2<double>> points = read(before, mesh, workers);
  std::vector<Point2<double>> moved = read(after, mesh, workers);
  require_same_heights(before, after);
  KeptMoves kept;
  put_back(points, moved, mesh.fixed(), kept);
  const LocalPoints local = entered(frame_of_both(points, moved, mesh.fixed()), points);
  mesh.look_at(local.points, listed, Layers::smooth, workers);
  const MeshRings rings = std::move(mesh).with_rings(listed, workers);
  SmoothingResult result;
  std::vector<double> stored = numbers_of(points);
  commit({rings, listed, {}, {}, local, moved}, plane_image(before.storage()), stored, points, options, workers,
         result);
  count_invalid(
      listed, rings.reversed, [&](std::int32_t v) { return local.frame.enter(points[v]); }, workers, result);
  kept.moved_vertices = result.moved_vertices;
  const auto by_vertex = [](const RevertedVertex& a, const RevertedVertex& b) { return a.vertex < b.vertex; };
  std::vector<RevertedVertex> too_far_away = std::exchange(kept.reverted, {});
  std::ranges::merge(too_far_away, result.reverted, std::back_inserter(kept.reverted), by_vertex);
  kept.rounds = result.guard_rounds;
  kept.inverted = result.inverted;
  kept.degenerate = result.degenerate;
  after.write(points, workers);
  return kept;
}

}  // namespace

KeptMoves keep_never_worse(const ConstPointView& before, const PointView& after, const IndexView& triangles,
                           const Constraints& constraints, int threads) {
  SmoothingOptions options;
  options.threads = threads;
  options.validate();
  require_same_kind(before, after);
  if (constraints.slide.along != Slide::off) {
    throw std::invalid_argument("what has moved along lines is not told from what has left them: without sliding");
  }
  Workers workers(threads);
  const auto vertex_count = static_cast<std::int64_t>(before.size());
  check_mesh_size(vertex_count, static_cast<std::int64_t>(triangles.size()),
                  triangles.may_have_quadrilaterals() ? 4 : 3);
  OwnElements converted;
  return triangles.list(vertex_count, converted).visit([&](const auto& listed) {
    return kept_moves(before, after, listed, constraints, options, workers);
  });
}

}  // namespace trismooth
