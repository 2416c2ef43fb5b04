#include "trismooth/pipeline/stages/stored_result.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <vector>

#include "trismooth/base/stopwatch.h"
#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/pipeline/stages/run_state.h"
#include "trismooth/smoothing/guard/guard_turned.h"
#include "trismooth/smoothing/guard/guarded_elements.h"

namespace trismooth {

namespace {

/// Vertices that a thread takes at a time.
constexpr std::int64_t stored_grain = 8192;

/// Brings a middle to where its side's ends take it.
void follow_side(const MeshDocument& document, const MiddleNode& middle, std::span<const double> input,
                 std::span<double> points) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t first = 3 * static_cast<std::size_t>(middle.ends[0]) + axis;
    const std::size_t second = 3 * static_cast<std::size_t>(middle.ends[1]) + axis;
    const std::size_t i = 3 * static_cast<std::size_t>(middle.vertex) + axis;
    points[i] = stored_coordinate(
        document, input[i],
        input[i] + middle_move(middle.share, input[first], points[first], input[second], points[second]));
  }
}

/// The mesh as it was read and as it will be stored, for the guard.
class StoredMesh : public GuardedMesh {
 public:
  /// `turned`: as UntanglingResult has it.
  StoredMesh(RunState& run, std::span<const double> input, std::span<const std::uint8_t> turned)
      : run_(run),
        input_(input),
        elements_(run.mesh.triangles, run.mesh.quadratics, run.found.reversed, turned),
        middles_(run.document.point_count(), run.mesh.middles),
        after_(run.local.points) {
    run.workers.for_blocks(std::ssize(after_), stored_grain, [&](std::int64_t begin, std::int64_t end) {
      for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v) {
        place(v);
      }
    });
  }

  bool has_moved(std::int32_t vertex) const override {
    const auto v = static_cast<std::size_t>(vertex);
    return !(after_[v] == run_.local.points[v]);
  }

  double quotient_before(std::int32_t element) const override {
    return elements_.quotient_before(run_.local.points, element);
  }

  double worsened(std::int32_t element) const override {
    return elements_.worsened(run_.local.points, after_, element);
  }

  void put_back(std::int32_t vertex) override {
    const auto v = static_cast<std::size_t>(vertex);
    std::copy_n(input_.begin() + static_cast<std::ptrdiff_t>(3 * v), 3,
                run_.document.points.begin() + static_cast<std::ptrdiff_t>(3 * v));
    place(v);
    for (const std::int32_t m : middles_[vertex]) {
      const MiddleNode& middle = run_.mesh.middles[static_cast<std::size_t>(m)];
      follow_side(run_.document, middle, input_, run_.document.points);
      place(static_cast<std::size_t>(middle.vertex));
    }
  }

  /// The quotient of an element as it is stored now.
  double quotient_now(std::int32_t element) const { return elements_.quotient_now(after_, element); }

 private:
  /// Takes over where the document has the vertex. One that did not move has the bits that it had.
  void place(std::size_t v) {
    const double* const now = run_.document.points.data() + 3 * v;
    const bool is_there = std::equal(now, now + 3, input_.begin() + static_cast<std::ptrdiff_t>(3 * v));
    after_[v] = is_there ? run_.local.points[v]
                         : run_.local.frame.enter(run_.mesh.place(v, Eigen::Map<const Eigen::Vector3d>(now)));
  }

  RunState& run_;
  std::span<const double> input_;
  GuardedElements elements_;
  MiddlesOfEnds middles_;
  BulkVector<Point2<double>> after_;  ///< in the local frame of the input
};

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
    const GuardOutcome outcome = guard_turned(
        static_cast<std::int32_t>(run.document.point_count()), run.mesh.triangles, smoothing.untangling,
        [&](std::span<const std::uint8_t> turned) { return std::make_unique<StoredMesh>(run, input, turned); },
        run.workers);
    smoothing.guard_rounds += outcome.rounds;
    for (const std::int32_t v : outcome.reverted) {
      const Eigen::Map<const Eigen::Vector3d> point(unguarded.data() + 3 * static_cast<std::size_t>(v));
      smoothing.reverted.push_back({v, run.mesh.place(static_cast<std::size_t>(v), point)});
    }
  }
  if (smoothing.untangling) {
    const StoredMesh mesh(run, input, smoothing.untangling->turned);
    smoothing.untangling->inverted_after =
        count_inverted(run.mesh.triangles, run.found.fixed, [&mesh](std::int32_t t) { return mesh.quotient_now(t); });
  }
  smoothing.moved_vertices = update_points(run, input);
  name_reverted(smoothing, run.mesh.points);
  smoothing.timings.commit += watch.milliseconds();
}

}  // namespace trismooth
