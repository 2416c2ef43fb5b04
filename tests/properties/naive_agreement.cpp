// SPDX-License-Identifier: BSD-3-Clause
// The CPU backend against the contract written down with no thought of speed, bit for bit.

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "trismooth/base/rounding.h"
#include "trismooth/smoothing/sweeps/stop_rule.h"

#include "catch.h"
#include "properties/contract.h"
#include "properties/for_random_meshes.h"
#include "properties/smoothing_cases.h"
#include "support/naive_smoothing.h"
#include "support/used_frame.h"

using namespace properties;

namespace {

Point2<double> stored_as(Storage storage, Point2<double> p) {
  return storage == Storage::float64
             ? p
             : Point2<double>{trismooth::rounded_to_float32(p.x), trismooth::rounded_to_float32(p.y)};
}

template <class T>
Point2<T> narrowed(Point2<double> p) {
  return {static_cast<T>(p.x), static_cast<T>(p.y)};
}

/// Sweeps in T and the guard.
template <class T>
Run naive_run(const RandomMesh& mesh, const SmoothingOptions& options, Storage storage) {
  const Connectivity connectivity = connectivity_of(mesh);
  const std::vector<Point2<double>>& points = mesh.mesh.points;
  std::set<std::int32_t> fixed;
  for (std::int32_t v = 0; v < mesh.mesh.vertex_count(); ++v) {
    if (connectivity.fixed[v]) {
      fixed.insert(v);
    }
  }
  const naive::Rings rings = naive::one_rings(mesh.mesh.vertex_count(), connectivity.elements, fixed);
  const trismooth::LocalFrame frame = test_meshes::used_frame(mesh.mesh.points, mesh.mesh.triangles, mesh.other_cells);
  std::vector<Point2<double>> before;
  std::vector<Point2<T>> working;
  for (const Point2<double> p : points) {
    before.push_back(frame.enter(p));
    working.push_back(narrowed<T>(before.back()));
  }
  const naive::Outcome outcome = naive::smooth(working, rings, options.method, options.form, options.tolerance,
                                               options.max_sweeps, options.mean_ratio);

  Run run;
  run.result.sweeps = static_cast<std::int64_t>(outcome.sweeps.size());
  run.result.stop_reason = outcome.reason;
  // Of the elements that no sweep changes.
  double fixed_shape = std::numeric_limits<double>::infinity();
  for (const trismooth::Triangle& t : connectivity.elements) {
    if (std::ranges::all_of(t, [&](std::int32_t v) { return connectivity.fixed[v]; })) {
      fixed_shape = std::min(fixed_shape, 2 * std::sqrt(3.0) * naive::element_quotient(before, t));
    }
  }
  for (const naive::SweepCount& count : outcome.sweeps) {
    const double shape = std::min(count.min_shape, fixed_shape);
    run.result.history.push_back({static_cast<std::int64_t>(run.result.history.size()) + 1, count.changed, count.moved,
                                  count.max_relative_move,
                                  options.record_min_shape && std::isfinite(shape) ? shape : trismooth::no_target});
    run.result.vertex_updates += count.changed;
  }
  std::vector<Point2<double>> stored = points;
  std::vector<Point2<double>> after;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (!(working[v] == narrowed<T>(before[v]))) {
      const Point2<double> local{static_cast<double>(working[v].x), static_cast<double>(working[v].y)};
      stored[v] = stored_as(storage, frame.leave(local));
    }
    after.push_back(frame.enter(stored[v]));
  }
  if (options.guard) {
    const naive::Guarded guarded = naive::guard(connectivity.elements, before, after);
    run.result.guard_rounds = guarded.rounds;
    for (const std::int32_t v : guarded.reverted) {
      run.result.reverted.push_back({v, stored[v]});
    }
    run.result.reverted_vertices = static_cast<std::int64_t>(guarded.reverted.size());
  }
  for (std::size_t v = 0; v < points.size(); ++v) {
    const bool moved = !(after[v] == before[v]);
    run.result.moved_vertices += moved ? 1 : 0;
    run.result.free_vertices += connectivity.fixed[v] ? 0 : 1;
    const Point2<double> p = moved ? stored[v] : points[v];
    run.xy.insert(run.xy.end(), {p.x, p.y});
  }
  return run;
}

}  // namespace

TEST_CASE(
    "every method, form and precision gives the bits of the naive implementation, vertex by vertex and sweep by "
    "sweep") {
  for_random_meshes(3000, [](const RandomMesh& mesh) {
    return for_some_options(mesh, 2, [&](SmoothingOptions options, test_meshes::Random& random) {
      options.untangle = trismooth::Untangle::off;  // which the naive implementation does not know
      options.guard = random.below(5) != 0;
      options.record_min_shape = random.below(3) == 0;
      const Storage storage = fits_float32(mesh) && random.below(3) == 0 ? Storage::float32 : Storage::float64;
      const Run expected = options.precision == Precision::double_precision ? naive_run<double>(mesh, options, storage)
                                                                            : naive_run<float>(mesh, options, storage);
      Run found = run(mesh, options, storage);
      if (random.below(2) == 0) {
        // Where nothing is inverted, untangling changes no bit.
        options.untangle = trismooth::Untangle::on;
        const Run with_untangling = run(mesh, options, storage);
        if (with_untangling.result.untangling->inverted_before == 0) {
          found = with_untangling;
          found.result.untangling.reset();
        }
      }
      for (std::size_t i = 0; i < expected.result.history.size() && i < found.result.history.size(); ++i) {
        if (found.result.history[i].evaluated != expected.result.history[i].evaluated) {
          return fmt::format("sweep {} evaluated {} vertices instead of {}", i + 1, found.result.history[i].evaluated,
                             expected.result.history[i].evaluated);
        }
      }
      // The naive one writes a zero of either sign where a vertex is on that zero already.
      return difference_in_value(found, expected);
    });
  });
}
