#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/base/local_points.h"
#include "trismooth/base/mesh_size.h"
#include "trismooth/base/stopwatch.h"
#include "trismooth/base/workers.h"
#include "trismooth/smoothing/guard/guard_turned.h"
#include "trismooth/smoothing/guard/guarded_elements.h"
#include "trismooth/smoothing/invalid_triangles.h"
#include "trismooth/smoothing/middle_nodes.h"
#include "trismooth/smoothing/rings/mesh_rings.h"
#include "trismooth/smoothing/smooth.h"

namespace trismooth {

namespace {

constexpr std::size_t nodes_of_quadratic = 6;

/// The triangles of corners, and the middles of their sides.
struct QuadraticLists {
  std::vector<Triangle> corners;
  std::vector<QuadraticTriangle> quadratics;
};

QuadraticLists listed_quadratics(std::span<const std::int32_t> nodes, std::int64_t vertex_count) {
  if (nodes.size() % nodes_of_quadratic != 0) {
    throw std::invalid_argument("triangles: " + std::to_string(nodes.size()) +
                                " vertex numbers, expected six for each triangle");
  }
  const std::size_t count = nodes.size() / nodes_of_quadratic;
  check_mesh_size(vertex_count, static_cast<std::int64_t>(count));
  QuadraticLists lists;
  lists.corners.reserve(count);
  lists.quadratics.reserve(count);
  for (std::size_t t = 0; t < count; ++t) {
    const auto of_triangle = nodes.subspan(nodes_of_quadratic * t, nodes_of_quadratic);
    for (const std::int32_t v : of_triangle) {
      if (v < 0 || v >= vertex_count) {
        throw_no_such_vertex(static_cast<std::int64_t>(t), std::to_string(v), vertex_count);
      }
    }
    lists.corners.push_back({of_triangle[0], of_triangle[1], of_triangle[2]});
    lists.quadratics.push_back({static_cast<std::int32_t>(t), {of_triangle[3], of_triangle[4], of_triangle[5]}});
  }
  return lists;
}

/// What the caller names, as flags; none where nothing is named.
std::vector<std::uint8_t> named_vertices(const Constraints& constraints, std::size_t vertex_count) {
  std::vector<std::uint8_t> named(constraints.fixed.begin(), constraints.fixed.end());
  if (!constraints.fixed_ids.empty()) {
    named.resize(vertex_count, 0);
  }
  for (const std::int32_t v : constraints.fixed_ids) {
    named[static_cast<std::size_t>(v)] = 1;
  }
  return named;
}

/// The mesh as it was and as it will be stored: its middles follow the corners.
class FollowedMesh {
 public:
  FollowedMesh(std::span<const Point2<double>> before, std::vector<Point2<double>> now,
               std::span<const MiddleNode> middles, Storage storage)
      : before_(before), now_(std::move(now)), middles_(middles), around_(now_.size(), middles), storage_(storage) {
    for (const MiddleNode& middle : middles_) {
      follow(middle);
    }
  }

  std::span<const Point2<double>> before() const { return before_; }
  const std::vector<Point2<double>>& now() const { return now_; }

  /// Calls changed(vertex) for it and for the middles that go with it.
  template <class Changed>
  void put_back(std::int32_t vertex, const Changed& changed) {
    now_[static_cast<std::size_t>(vertex)] = before_[static_cast<std::size_t>(vertex)];
    changed(vertex);
    for (const std::int32_t place : around_[vertex]) {
      const MiddleNode& middle = middles_[static_cast<std::size_t>(place)];
      follow(middle);
      changed(middle.vertex);
    }
  }

 private:
  void follow(const MiddleNode& middle) {
    const std::int32_t first = middle.ends[0];
    const std::int32_t second = middle.ends[1];
    const auto v = static_cast<std::size_t>(middle.vertex);
    const auto followed = [&](double Point2<double>::*axis) {
      const auto at = [axis](std::span<const Point2<double>> points, std::int32_t i) {
        return points[static_cast<std::size_t>(i)].*axis;
      };
      const double from = before_[v].*axis;
      const double to =
          from + middle_move(middle.share, at(before_, first), at(now_, first), at(before_, second), at(now_, second));
      const double stored = rounded_to(storage_, to);
      // One that stays keeps its bits.
      return to == from || !std::isfinite(stored) ? from : stored;
    };
    now_[v] = {followed(&Point2<double>::x), followed(&Point2<double>::y)};
  }

  std::span<const Point2<double>> before_;
  std::vector<Point2<double>> now_;
  std::span<const MiddleNode> middles_;
  MiddlesOfEnds around_;
  Storage storage_;
};

/// The same in the local frame of what it was, for the guard.
class GuardedQuadratics : public GuardedMesh {
 public:
  GuardedQuadratics(FollowedMesh& mesh, const LocalPoints& before, GuardedElements elements)
      : mesh_(mesh), before_(before), elements_(std::move(elements)), now_(entered(before.frame, mesh.now()).points) {}

  bool has_moved(std::int32_t vertex) const override {
    const auto v = static_cast<std::size_t>(vertex);
    return !(mesh_.now()[v] == mesh_.before()[v]);
  }
  double quotient_before(std::int32_t element) const override {
    return elements_.quotient_before(before_.points, element);
  }
  double worsened(std::int32_t element) const override { return elements_.worsened(before_.points, now_, element); }
  double quotient_now(std::int32_t element) const { return elements_.quotient_now(now_, element); }

  void put_back(std::int32_t vertex) override {
    mesh_.put_back(vertex, [this](std::int32_t changed) {
      const auto v = static_cast<std::size_t>(changed);
      now_[v] = before_.frame.enter(mesh_.now()[v]);
    });
  }

 private:
  FollowedMesh& mesh_;
  const LocalPoints& before_;
  GuardedElements elements_;
  BulkVector<Point2<double>> now_;
};

/// Takes back what would spoil a quadratic element or, since middles and rounding have a say, make one worse.
void guard_quadratics(FollowedMesh& mesh, const QuadraticLists& lists, const Constraints& constraints,
                      SmoothingResult& result, const SmoothingOptions& options, Workers& workers) {
  std::vector<std::uint8_t> is_used(mesh.now().size(), 0);
  for (const Triangle& corners : lists.corners) {
    for (const std::int32_t v : corners) {
      is_used[static_cast<std::size_t>(v)] = 1;
    }
  }
  const LocalPoints before = local_points(
      mesh.before(), [&](std::size_t v) { return is_used[v] != 0 || constraints.other_cells[v] != 0; }, workers);
  const MeshRings found = find_mesh_rings(before.points, lists.corners, constraints, workers);
  const auto mesh_of = [&](std::span<const std::uint8_t> turned) {
    return std::make_unique<GuardedQuadratics>(
        mesh, before, GuardedElements(lists.corners, lists.quadratics, found.reversed, turned));
  };
  if (options.guard) {
    const std::vector<Point2<double>> unguarded(mesh.now().begin(), mesh.now().end());
    const GuardOutcome outcome =
        guard_turned(static_cast<std::int32_t>(mesh.now().size()), lists.corners, result.untangling, mesh_of, workers);
    result.guard_rounds += outcome.rounds;
    for (const std::int32_t v : outcome.reverted) {
      result.reverted.push_back({v, unguarded[static_cast<std::size_t>(v)]});
    }
    name_reverted(result, mesh.now());
  }
  if (result.untangling) {
    const auto now = mesh_of(result.untangling->turned);
    result.untangling->inverted_after =
        count_inverted(lists.corners, found.fixed, [&now](std::int32_t t) { return now->quotient_now(t); });
  }
  count_invalid(
      lists.corners, found.reversed, [&](std::int32_t v) { return before.frame.enter(mesh.now()[v]); }, workers,
      result);
}

}  // namespace

SmoothingResult smooth_quadratic(const PointView& points, const ArrayView<std::int32_t>& triangles,
                                 const Constraints& constraints, const SmoothingOptions& options) {
  options.validate();
  Workers workers(options.threads);
  const QuadraticLists lists = listed_quadratics(triangles, static_cast<std::int64_t>(points.size()));
  check_constraints(constraints, static_cast<std::int32_t>(points.size()), std::ssize(lists.corners));
  if (constraints.slide.along != Slide::off) {
    throw std::invalid_argument(
        "vertices of quadratic triangles do not slide, since the middles of sides would leave them");
  }
  std::vector<std::uint8_t> named = named_vertices(constraints, points.size());
  std::vector<std::uint8_t> in_other_cell(constraints.other_cells.begin(), constraints.other_cells.end());
  in_other_cell.resize(points.size(), 0);
  std::vector<MiddleNode> middles = settle_middles(lists.corners, lists.quadratics, named, in_other_cell);
  Constraints settled;
  settled.fixed = named;
  settled.other_cells = in_other_cell;
  settled.regions = constraints.regions;
  settled.slide = constraints.slide;
  const std::vector<Point2<double>> before = points.read(workers);
  find_shares(middles, [&before](std::int32_t vertex) {
    const Point2<double> p = before[static_cast<std::size_t>(vertex)];
    return std::array<double, 3>{p.x, p.y, 0};
  });
  SmoothingResult result = smooth(points, lists.corners, settled, options);
  const Stopwatch watch;
  FollowedMesh mesh(before, points.read(workers), middles, points.storage());
  guard_quadratics(mesh, lists, settled, result, options, workers);
  points.write(mesh.now(), workers);
  result.moved_vertices = 0;
  for (std::size_t v = 0; v < before.size(); ++v) {
    result.moved_vertices += mesh.now()[v] == before[v] ? 0 : 1;
  }
  for (const MiddleNode& middle : middles) {
    const auto v = static_cast<std::size_t>(middle.vertex);
    result.moved_vertices -= mesh.now()[v] == before[v] ? 0 : 1;
  }
  result.timings.commit += watch.milliseconds();
  return result;
}

SmoothingResult smooth_quadratic(const PointView& points, const ArrayView<std::int32_t>& triangles,
                                 const SmoothingOptions& options) {
  return smooth_quadratic(points, triangles, Constraints{}, options);
}

}  // namespace trismooth
