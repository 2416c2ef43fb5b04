#include "trismooth/pipeline/stages/stored_result.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <vector>

#include "trismooth/base/stopwatch.h"
#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/pipeline/stages/run_state.h"
#include "trismooth/smoothing/guard/guard_rounds.h"

namespace trismooth {

namespace {

/// Vertices that a thread takes at a time.
constexpr std::int64_t stored_grain = 8192;

/// Brings a middle to where its side's ends take it.
void follow_side(const MeshDocument& document, const MiddleNode& middle, std::span<const double> input,
                 std::span<double> points) {
  const auto [first, second] = middle.ends;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto move = [&](std::int32_t vertex) {
      const std::size_t i = 3 * static_cast<std::size_t>(vertex) + axis;
      return (points[i] - input[i]) / 2;
    };
    const std::size_t i = 3 * static_cast<std::size_t>(middle.vertex) + axis;
    points[i] = stored_coordinate(document, input[i], input[i] + (move(first) + move(second)));
  }
}

/// The mesh as it was read and as it will be stored, for the guard.
class StoredMesh : public GuardedMesh {
 public:
  /// `turned`: as UntanglingResult has it.
  StoredMesh(RunState& run, std::span<const double> input, std::span<const std::uint8_t> turned)
      : run_(run), input_(input), turned_(turned), after_(run.local.points) {
    run.workers.for_blocks(std::ssize(after_), stored_grain, [&](std::int64_t begin, std::int64_t end) {
      for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v) {
        place(v);
      }
    });
    list_middles();
  }

  bool has_moved(std::int32_t vertex) const override {
    const auto v = static_cast<std::size_t>(vertex);
    return !(after_[v] == run_.local.points[v]);
  }

  double quotient_before(std::int32_t element) const override {
    return quotient(run_.local.points, element, is_reversed(element));
  }

  double worsened(std::int32_t element) const override {
    return is_spoiled(element) ? -std::numeric_limits<double>::infinity()
                               : worsened_quotient(quotient_before(element), quotient_now(element));
  }

  void put_back(std::int32_t vertex) override {
    const auto v = static_cast<std::size_t>(vertex);
    std::copy_n(input_.begin() + static_cast<std::ptrdiff_t>(3 * v), 3,
                run_.document.points.begin() + static_cast<std::ptrdiff_t>(3 * v));
    place(v);
    if (starts_.empty()) {
      return;
    }
    for (std::int64_t i = starts_[v]; i < starts_[v + 1]; ++i) {
      const MiddleNode& middle = run_.mesh.middles[static_cast<std::size_t>(around_[static_cast<std::size_t>(i)])];
      follow_side(run_.document, middle, input_, run_.document.points);
      place(static_cast<std::size_t>(middle.vertex));
    }
  }

  /// The quotient of an element as it is stored now.
  double quotient_now(std::int32_t element) const { return quotient(after_, element, is_reversed_now(element)); }

 private:
  bool is_reversed(std::int32_t element) const { return run_.found.reversed[static_cast<std::size_t>(element)] != 0; }

  bool is_reversed_now(std::int32_t element) const {
    return is_reversed(element) != (!turned_.empty() && turned_[static_cast<std::size_t>(element)] != 0);
  }

  double quotient(const BulkVector<Point2<double>>& points, std::int32_t element, bool reversed) const {
    const auto [a, b, c] = canonical_corners(run_.mesh.triangles[static_cast<std::size_t>(element)], reversed);
    return shape_quotient(points[a], points[b], points[c]);
  }

  /// Whether the element is a quadratic one that was valid and is not any more.
  bool is_spoiled(std::int32_t element) const {
    if (quadratic_of_.empty() || quadratic_of_[static_cast<std::size_t>(element)] < 0) {
      return false;
    }
    const Triangle& corners = run_.mesh.triangles[static_cast<std::size_t>(element)];
    const auto& middles =
        run_.mesh.quadratics[static_cast<std::size_t>(quadratic_of_[static_cast<std::size_t>(element)])].middles;
    const auto is_valid = [&](const BulkVector<Point2<double>>& points, bool reversed) {
      return jacobian_bound(quadratic_nodes(corners, middles, reversed, points)).is_valid();
    };
    return !is_valid(after_, is_reversed_now(element)) && is_valid(run_.local.points, is_reversed(element));
  }

  /// Takes over where the document has the vertex. One that did not move has the bits that it had.
  void place(std::size_t v) {
    const double* const now = run_.document.points.data() + 3 * v;
    const bool is_there = std::equal(now, now + 3, input_.begin() + static_cast<std::ptrdiff_t>(3 * v));
    after_[v] = is_there ? run_.local.points[v]
                         : run_.local.frame.enter(run_.mesh.place(v, Eigen::Map<const Eigen::Vector3d>(now)));
  }

  /// Lists the middles of each vertex's sides, and the quadratic triangle that each triangle is.
  void list_middles() {
    const PlanarMesh& mesh = run_.mesh;
    if (mesh.quadratics.empty()) {
      return;
    }
    quadratic_of_.resize(mesh.triangles.size(), -1);
    for (std::size_t q = 0; q < mesh.quadratics.size(); ++q) {
      quadratic_of_[static_cast<std::size_t>(mesh.quadratics[q].triangle)] = static_cast<std::int32_t>(q);
    }
    starts_.resize(after_.size() + 1, 0);
    for (const MiddleNode& middle : mesh.middles) {
      for (const std::int32_t end : middle.ends) {
        ++starts_[static_cast<std::size_t>(end) + 1];
      }
    }
    for (std::size_t v = 1; v < starts_.size(); ++v) {
      starts_[v] += starts_[v - 1];
    }
    around_.resize(static_cast<std::size_t>(starts_.back()));
    std::vector<std::int64_t> next(starts_.begin(), starts_.end() - 1);
    for (std::size_t m = 0; m < mesh.middles.size(); ++m) {
      for (const std::int32_t end : mesh.middles[m].ends) {
        around_[static_cast<std::size_t>(next[static_cast<std::size_t>(end)]++)] = static_cast<std::int32_t>(m);
      }
    }
  }

  RunState& run_;
  std::span<const double> input_;
  std::span<const std::uint8_t> turned_;
  BulkVector<Point2<double>> after_;        ///< in the local frame of the input
  std::vector<std::int32_t> quadratic_of_;  ///< of every triangle, or -1; empty where there are none
  std::vector<std::int64_t> starts_;        ///< vertex v has around_[starts_[v] .. starts_[v + 1]); likewise
  std::vector<std::int32_t> around_;        ///< middles of the sides of each vertex
};

/// The corners of the components that the untangling has turned over, ascending.
std::vector<std::int32_t> turned_vertices(const RunState& run, std::span<const std::uint8_t> turned) {
  std::vector<std::int32_t> vertices;
  for (std::size_t t = 0; t < turned.size(); ++t) {
    if (turned[t] != 0) {
      vertices.insert(vertices.end(), run.mesh.triangles[t].begin(), run.mesh.triangles[t].end());
    }
  }
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

/// Runs the rounds. A component that was turned over is as it was read or as it was turned, nothing between: if one of
/// its vertices goes back, all turned components do.
GuardOutcome guard_stored(RunState& run, std::span<const double> input, SmoothingResult& smoothing) {
  const auto vertices = static_cast<std::int32_t>(run.document.point_count());
  const bool has_turned = smoothing.untangling && !smoothing.untangling->turned.empty();
  const std::vector<std::uint8_t> turned = has_turned ? smoothing.untangling->turned : std::vector<std::uint8_t>{};
  StoredMesh mesh(run, input, turned);
  GuardOutcome outcome = guard_in_rounds(vertices, run.mesh.triangles, mesh, run.workers);
  const std::vector<std::int32_t> of_turned = turned_vertices(run, turned);
  const bool is_disturbed =
      std::ranges::any_of(outcome.reverted, [&](std::int32_t v) { return std::ranges::binary_search(of_turned, v); });
  if (!is_disturbed) {
    return outcome;
  }
  for (const std::int32_t v : of_turned) {
    if (mesh.has_moved(v)) {
      mesh.put_back(v);
      outcome.reverted.push_back(v);
    }
  }
  smoothing.untangling->turned.clear();
  smoothing.untangling->turned_components = 0;
  StoredMesh as_listed(run, input, {});
  const GuardOutcome more = guard_in_rounds(vertices, run.mesh.triangles, as_listed, run.workers);
  outcome.reverted.insert(outcome.reverted.end(), more.reverted.begin(), more.reverted.end());
  outcome.rounds += more.rounds;
  return outcome;
}

/// Triangles with a free vertex that are not valid as they are stored.
std::int64_t count_inverted(RunState& run, std::span<const double> input, const UntanglingResult& untangling) {
  const StoredMesh mesh(run, input, untangling.turned);
  std::int64_t inverted = 0;
  for (std::int32_t t = 0; t < std::ssize(run.mesh.triangles); ++t) {
    const bool has_free_vertex =
        std::ranges::any_of(run.mesh.triangles[static_cast<std::size_t>(t)],
                            [&](std::int32_t v) { return run.found.fixed[static_cast<std::size_t>(v)] == 0; });
    inverted += has_free_vertex && !(mesh.quotient_now(t) > 0) ? 1 : 0;
  }
  return inverted;
}

/// Brings the points in the plane to where the document has them; how many vertices are elsewhere than in the input,
/// but for middles.
std::int64_t update_points(RunState& run, std::span<const double> input) {
  std::int64_t elsewhere = 0;
  const auto for_moved = [&](std::size_t v, std::int64_t count) {
    const double* const now = run.document.points.data() + 3 * v;
    if (run.mesh.in_cell[v] != 0) {
      run.mesh.points[v] = run.mesh.place(v, Eigen::Map<const Eigen::Vector3d>(now));
    }
    elsewhere += std::equal(now, now + 3, input.begin() + static_cast<std::ptrdiff_t>(3 * v)) ? 0 : count;
  };
  for (std::size_t v = 0; v < run.mesh.points.size(); ++v) {
    for_moved(v, 1);
  }
  for (const MiddleNode& middle : run.mesh.middles) {
    for_moved(static_cast<std::size_t>(middle.vertex), -1);
  }
  return elsewhere;
}

}  // namespace

double stored_coordinate(const MeshDocument& document, double before, double now) {
  if (now == before) {
    return before;
  }
  const double rounded = rounded_to_characters(rounded_to(storage_of(document), now),
                                               document.most_coordinate_characters, document.coordinate_form);
  // Near the largest number, the nearest that can be held may be beyond it.
  return std::isfinite(rounded) ? rounded : before;
}

bool is_stored_otherwise(const RunState& run) {
  return run.document.most_coordinate_characters > 0 || !run.mesh.middles.empty();
}

void fit_to_file(RunState& run, std::span<const double> input, std::span<double> points) {
  run.workers.for_blocks(std::ssize(points), 3 * stored_grain, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      points[i] = stored_coordinate(run.document, input[i], points[i]);
    }
  });
  run.workers.for_blocks(std::ssize(run.mesh.middles), stored_grain, [&](std::int64_t begin, std::int64_t end) {
    for (auto m = static_cast<std::size_t>(begin); m < static_cast<std::size_t>(end); ++m) {
      follow_side(run.document, run.mesh.middles[m], input, points);
    }
  });
}

void store_result(RunState& run, std::span<const double> input, SmoothingResult& smoothing) {
  const Stopwatch watch;
  fit_to_file(run, input, run.document.points);
  if (run.smoothing.guard) {
    const std::vector<double> unguarded = run.document.points;
    const GuardOutcome outcome = guard_stored(run, input, smoothing);
    smoothing.guard_rounds += outcome.rounds;
    for (const std::int32_t v : outcome.reverted) {
      const Eigen::Map<const Eigen::Vector3d> point(unguarded.data() + 3 * static_cast<std::size_t>(v));
      smoothing.reverted.push_back({v, run.mesh.place(static_cast<std::size_t>(v), point)});
    }
  }
  if (smoothing.untangling) {
    smoothing.untangling->inverted_after = count_inverted(run, input, *smoothing.untangling);
  }
  smoothing.moved_vertices = update_points(run, input);
  name_reverted(smoothing, run.mesh.points);
  smoothing.timings.commit += watch.milliseconds();
}

}  // namespace trismooth
