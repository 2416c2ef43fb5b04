// SPDX-License-Identifier: BSD-3-Clause
// Where smoothing ends: at fixed points that are fixed, at the solution of the linear system, at the caller's word.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include <Eigen/SparseLU>

#include "trismooth/base/local_frame.h"

#include "catch.h"
#include "properties/contract.h"
#include "properties/for_random_meshes.h"
#include "properties/smoothing_cases.h"
#include "support/naive_smoothing.h"
#include "support/used_frame.h"

using namespace properties;
using trismooth::Progress;
using trismooth::SweepRecord;

namespace {

trismooth::LocalFrame frame_of(const RandomMesh& mesh) {
  return test_meshes::used_frame(mesh.mesh.points, mesh.mesh.triangles, mesh.other_cells);
}

/// Neither frame is translated, and both are of the same scale.
bool are_alike(const trismooth::LocalFrame& a, const trismooth::LocalFrame& b) {
  return a.centre_x == 0 && a.centre_y == 0 && b.centre_x == 0 && b.centre_y == 0 && a.exponent == b.exponent;
}

naive::Rings rings_of(const RandomMesh& mesh, const Connectivity& connectivity) {
  std::set<std::int32_t> fixed;
  for (std::int32_t v = 0; v < mesh.mesh.vertex_count(); ++v) {
    if (connectivity.fixed[v]) {
      fixed.insert(v);
    }
  }
  return naive::one_rings(mesh.mesh.vertex_count(), connectivity.elements, fixed);
}

/// Where every free vertex is the mean of its neighbours.
std::vector<Point2<double>> solved(const std::vector<Point2<double>>& points, const naive::Rings& rings) {
  std::vector<int> unknown(points.size(), -1);
  int count = 0;
  for (std::size_t v = 0; v < points.size(); ++v) {
    unknown[v] = rings[v].empty() ? -1 : count++;
  }
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(count, 2);
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (unknown[v] < 0) {
      continue;
    }
    entries.emplace_back(unknown[v], unknown[v], static_cast<double>(rings[v].size()));
    for (const std::int32_t n : rings[v]) {
      if (unknown[n] >= 0) {
        entries.emplace_back(unknown[v], unknown[n], -1);
      } else {
        right.row(unknown[v]) += Eigen::RowVector2d(points[n].x, points[n].y);
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SparseLU<Eigen::SparseMatrix<double>> solver(matrix);
  const Eigen::MatrixX2d solution = solver.solve(right);
  std::vector<Point2<double>> result = points;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (unknown[v] >= 0) {
      result[v] = {solution(unknown[v], 0), solution(unknown[v], 1)};
    }
  }
  return result;
}

}  // namespace

TEST_CASE("smoothing again what stopped at its fixed point moves nothing") {
  // Where nothing was taken back, no frame was translated and no digit was lost among subnormal numbers: then what was
  // stored enters the second run's frame as it left the first run's. And the majority of no component may have turned,
  // as it may where most was tangled; nor may what could not be untangled be tried again from where it is now.
  std::int64_t looked_at = 0;
  std::int64_t moving = 0;
  for_random_meshes(2000, [&](const RandomMesh& mesh) {
    return for_some_options(mesh, 2, [&](SmoothingOptions options, test_meshes::Random& random) -> std::string {
      if (options.method == Method::mean_ratio) {
        return {};  // what it aims at it finds in the mesh, which is another one now
      }
      options.tolerance = 0;
      options.max_sweeps = random.below(4) == 0 ? 500 : 100;
      const Run first = run(mesh, options);
      const RandomMesh smoothed = at_points(mesh, first.xy);
      if (first.result.stop_reason != StopReason::fixed_point || first.result.reverted_vertices > 0 ||
          (first.result.untangling && first.result.untangling->inverted_after > 0) || !keeps_digits(first.xy) ||
          !are_alike(frame_of(mesh), frame_of(smoothed)) ||
          connectivity_of(smoothed).elements != connectivity_of(mesh).elements) {
        return {};
      }
      ++looked_at;
      moving += first.result.moved_vertices > 0 ? 1 : 0;
      const Run second = run(smoothed, options);
      if (second.result.sweeps != 1 || second.result.moved_vertices != 0) {
        return fmt::format("{} vertices moved again, in {} sweeps", second.result.moved_vertices, second.result.sweeps);
      }
      return difference(second.xy, first.xy);
    });
  });
  CHECK(5 * moving > looked_at);
}

TEST_CASE("plain averages end at the solution of the linear system, in both forms") {
  std::int64_t looked_at = 0;
  std::int64_t converged = 0;
  for_random_meshes(2000, [&](const RandomMesh& any) -> std::string {
    // In units of the frame: rounding on the way out is not what is looked at.
    RandomMesh mesh = any;
    const trismooth::LocalFrame frame = frame_of(any);
    for (auto& p : mesh.mesh.points) {
      p = frame.enter(p);
    }
    const Connectivity connectivity = connectivity_of(mesh);
    const naive::Rings rings = rings_of(mesh, connectivity);
    if (!connectivity.is_held || std::ranges::all_of(rings, [](const auto& ring) { return ring.empty(); })) {
      return {};  // closed surfaces shrink to any point, or there is nothing to solve
    }
    const std::vector<Point2<double>> expected = solved(mesh.mesh.points, rings);
    for (const Form form : {Form::swap, Form::in_place}) {
      SmoothingOptions options;
      options.method = Method::laplacian;
      options.form = form;
      options.layers = trismooth::Layers::smooth;
      options.guard = false;
      options.tolerance = 0;
      options.max_sweeps = 2000;
      options.threads = 1;
      options.progress = [](const SweepRecord& record) {
        return record.max_relative_move < 1e-14 ? Progress::stop : Progress::proceed;
      };
      const Run found = run(mesh, options);
      ++looked_at;
      if (found.result.stop_reason == StopReason::sweep_limit) {
        continue;
      }
      ++converged;
      for (std::size_t v = 0; v < expected.size(); ++v) {
        const double error =
            std::max(std::abs(found.xy[2 * v] - expected[v].x), std::abs(found.xy[2 * v + 1] - expected[v].y));
        if (!(error < 1e-9)) {
          return fmt::format("form {}: vertex {} is {} from the solution", to_string(form), v, error);
        }
      }
    }
    return {};
  });
  CHECK(10 * converged >= 9 * looked_at);
}

TEST_CASE("stopped by the callback after any sweep, the mesh is what that many sweeps make of it") {
  for_random_meshes(2000, [](const RandomMesh& mesh) {
    const Connectivity connectivity = connectivity_of(mesh);
    return for_some_options(mesh, 3, [&](SmoothingOptions options, test_meshes::Random& random) -> std::string {
      options.max_sweeps = options.mean_ratio.steady ? 100000 : 0;
      options.tolerance = 1e-3;
      const std::int64_t last = 1 + random.below(8);
      std::int64_t heard = 0;
      options.progress = [&](const SweepRecord& record) {
        heard = record.sweep == heard + 1 ? record.sweep : -1;
        return record.sweep == last ? Progress::stop : Progress::proceed;
      };
      Run stopped = run(mesh, options);
      if (heard != stopped.result.sweeps || stopped.result.sweeps > last) {
        return fmt::format("the callback heard of {} sweeps of {}", heard, stopped.result.sweeps);
      }
      options.progress = nullptr;
      options.max_sweeps = last;
      const Run limited = run(mesh, options);
      if (limited.result.stop_reason == StopReason::sweep_limit) {
        if (stopped.result.stop_reason != StopReason::cancelled) {
          return fmt::format("stopped by {}", to_string(stopped.result.stop_reason));
        }
        stopped.result.stop_reason = StopReason::sweep_limit;
      }
      const std::string wrong = difference(stopped, limited);
      return wrong.empty() ? breach(mesh, connectivity, stopped, true) : wrong;
    });
  });
}

TEST_CASE("whenever its time is up a call leaves the mesh as it was, or nowhere worse") {
  using Seconds = std::chrono::duration<double>;
  std::int64_t ended = 0;
  std::int64_t ended_before_sweeps = 0;
  for_random_meshes(3000, [&](const RandomMesh& mesh) {
    const Connectivity connectivity = connectivity_of(mesh);
    return for_some_options(mesh, 3, [&](SmoothingOptions options, test_meshes::Random& random) -> std::string {
      const auto smooth_once = [&] {
        Run run{mesh.mesh.xy(), {}};
        run.result = trismooth::smooth(trismooth::xy_points(run.xy), mesh.mesh.indices(), mesh.constraints(), options);
        return run;
      };
      const auto begin = std::chrono::steady_clock::now();
      (void)smooth_once();
      const Seconds whole = std::chrono::steady_clock::now() - begin;
      options.time_limit_seconds = random.between(0, 1) * whole.count();
      const Run run = smooth_once();
      ended += run.result.stop_reason == StopReason::time_limit ? 1 : 0;
      if (run.result.inverted < 0) {
        ++ended_before_sweeps;
        const bool is_said = run.result.stop_reason == StopReason::time_limit && run.result.sweeps == 0;
        return is_said ? difference(run.xy, mesh.mesh.xy()) : "nobody said that its time was up";
      }
      return breach(mesh, connectivity, run, true);
    });
  });
  CHECK(ended > ended_before_sweeps);
  CHECK(ended_before_sweeps > 0);
}

TEST_CASE("a quality target stops at the first sweep that reaches it, and changes nothing before") {
  std::int64_t reached = 0;
  for_random_meshes(2000, [&](const RandomMesh& mesh) {
    return for_some_options(mesh, 2, [&](SmoothingOptions options, test_meshes::Random& random) -> std::string {
      options.record_min_shape = true;
      options.max_sweeps = 12;
      const std::vector<SweepRecord> history = run(mesh, options).result.history;
      // One that some sweep reaches, or nearly.
      const double shape =
          history[static_cast<std::size_t>(random.below(static_cast<std::int32_t>(history.size())))].min_shape;
      if (!(std::abs(shape) < 1)) {
        return {};  // no triangle, or one so perfect that rounding takes it out of the range of targets
      }
      const double target = random.below(2) == 0 ? shape : std::nextafter(shape, 2);
      options.target_quality = target;
      const Run found = run(mesh, options);
      if (found.result.sweeps == 0) {
        // The mesh reached it before the first sweep, and so it reaches what every mesh does.
        options.target_quality = -1;
        const Run unswept = run(mesh, options);
        const bool is_untangled = unswept.result.untangling && unswept.result.untangling->inverted_before > 0;
        const std::string wrong = difference(found, unswept);
        return !wrong.empty() || is_untangled ? wrong : difference(found.xy, mesh.mesh.xy());
      }
      const auto first =
          std::ranges::find_if(history, [&](const SweepRecord& sweep) { return sweep.min_shape >= target; });
      options.target_quality.reset();
      options.max_sweeps = std::min<std::int64_t>(first - history.begin() + 1, options.max_sweeps);
      Run expected = run(mesh, options);
      if (first != history.end() && expected.result.stop_reason == StopReason::sweep_limit) {
        expected.result.stop_reason = StopReason::quality_target;
        ++reached;
      }
      return difference(found, expected);
    });
  });
  CHECK(reached >= meshes_of(200));
}
