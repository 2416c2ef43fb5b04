// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/cpu_backend.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "trismooth/base/local_frame.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/quality/quality_report.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/naive_smoothing.h"
#include "support/test_meshes.h"

namespace trismooth::cpu_backend_test {

using test_meshes::Mesh;
using test_meshes::Point;

const Mesh& grid() {
  static const Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(20, 20, 0.3, 1), 2);
  return mesh;
}

struct Smoothed {
  SmoothingResult result;
  std::vector<double> xy;
};

Smoothed smoothed(const Mesh& mesh, const SmoothingOptions& options) {
  Smoothed smoothed{{}, mesh.xy()};
  smoothed.result = trismooth::smooth(trismooth::xy_points(smoothed.xy), mesh.indices(), {}, options);
  return smoothed;
}

double smallest_shape_of(const Mesh& mesh, const std::vector<double>& xy) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < xy.size(); i += 2) {
    points.push_back({xy[i], xy[i + 1]});
  }
  return trismooth::smallest_shape({points, mesh.triangles, {}, 0});
}

constexpr Form forms[] = {Form::swap, Form::in_place};

TEST_CASE("at a fixed point the last sweep, in which nothing moved, counts") {
  for (const Form form : forms) {
    SmoothingOptions options;
    options.form = form;
    options.tolerance = 0;
    const auto [result, xy] = smoothed(grid(), options);
    CHECK(result.stop_reason == StopReason::fixed_point);
    CHECK(result.sweeps > 5);
    CHECK(result.sweeps == static_cast<std::int64_t>(result.history.size()));
    CHECK(result.history.back().moved == 0);
    CHECK(result.history.back().max_relative_move == 0);
    CHECK(result.history[result.history.size() - 2].moved > 0);
    // It is one: smoothing again moves nothing, in one sweep.
    std::vector<double> again = xy;
    const SmoothingResult second = trismooth::smooth(trismooth::xy_points(again), grid().indices(), {}, options);
    CHECK(second.sweeps == 1);
    CHECK(second.stop_reason == StopReason::fixed_point);
    CHECK(second.moved_vertices == 0);
    CHECK(again == xy);
  }
}

TEST_CASE("the tolerance stops after the first sweep whose moves are all within it") {
  for (const Form form : forms) {
    for (const Method method : {Method::smart, Method::laplacian, Method::weighted}) {
      SmoothingOptions options;
      options.form = form;
      options.method = method;
      options.tolerance = 1e-2;
      const SmoothingResult result = smoothed(grid(), options).result;
      CHECK(result.stop_reason == StopReason::tolerance);
      CHECK(result.history.back().moved > 0);
      CHECK(result.history.back().max_relative_move <= 1e-2);
      for (std::size_t i = 0; i + 1 < result.history.size(); ++i) {
        CHECK(result.history[i].max_relative_move > 1e-2);
      }
    }
  }
}

TEST_CASE("the sweep limit stops after as many sweeps, and 0 is none") {
  SmoothingOptions options;
  for (const std::int64_t limit : {1, 2, 7}) {
    options.max_sweeps = limit;
    const SmoothingResult result = smoothed(grid(), options).result;
    CHECK(result.stop_reason == StopReason::sweep_limit);
    CHECK(result.sweeps == limit);
  }
  options.method = Method::laplacian;
  options.tolerance = 1e-9;
  options.max_sweeps = 0;
  const SmoothingResult result = smoothed(test_meshes::jittered_grid(60, 60, 0.3, 1), options).result;
  CHECK(result.stop_reason == StopReason::tolerance);
  CHECK(result.sweeps > 1000);
}

TEST_CASE("a quality target that is reached already means no sweep at all") {
  SmoothingOptions options;
  const double shape = smallest_shape_of(grid(), grid().xy());
  REQUIRE(shape > 0);
  options.target_quality = shape * (1 - 1e-12);
  const auto [result, xy] = smoothed(grid(), options);
  CHECK(result.stop_reason == StopReason::quality_target);
  CHECK(result.sweeps == 0);
  CHECK(result.history.empty());
  CHECK(result.vertex_updates == 0);
  CHECK(xy == grid().xy());
  options.target_quality = shape * (1 + 1e-12);
  CHECK(smoothed(grid(), options).result.sweeps > 0);
}

TEST_CASE("triangles without a free vertex count for the quality target") {
  // A flat triangle in a component of its own, beside a perfect star.
  Mesh mesh = test_meshes::star(6);
  mesh.points[0] = {0, 0};
  const Mesh flat{{{0, 0}, {1, 0}, {0.5, 0.01}}, {{0, 1, 2}}};
  mesh = test_meshes::together(mesh, flat, {3, 0});
  SmoothingOptions options;
  options.record_min_shape = true;
  options.target_quality = 0.1;
  const auto [result, xy] = smoothed(mesh, options);
  CHECK(result.stop_reason != StopReason::quality_target);
  REQUIRE_FALSE(result.history.empty());
  CHECK(result.history.back().min_shape == smallest_shape_of(mesh, xy));
  CHECK(result.history.back().min_shape < 0.03);
}

TEST_CASE("the callback sees every sweep once, in order, from the thread that called") {
  for (const int threads : {1, 2, 8}) {
    std::vector<SweepRecord> seen;
    bool from_caller = true;
    SmoothingOptions options;
    options.threads = threads;
    options.progress = [&, caller = std::this_thread::get_id()](const SweepRecord& record) {
      seen.push_back(record);
      from_caller = from_caller && std::this_thread::get_id() == caller;
      return Progress::proceed;
    };
    const SmoothingResult result = smoothed(grid(), options).result;
    CHECK(from_caller);
    REQUIRE(seen.size() == result.history.size());
    for (std::size_t i = 0; i < seen.size(); ++i) {
      CHECK(seen[i].sweep == static_cast<std::int64_t>(i) + 1);
      CHECK(seen[i].moved == result.history[i].moved);
      CHECK(seen[i].evaluated == result.history[i].evaluated);
    }
  }
}

TEST_CASE("an exception in the callback reaches the caller, whose coordinates are untouched") {
  for (const int threads : {1, 2}) {
    SmoothingOptions options;
    options.threads = threads;
    options.progress = [](const SweepRecord& record) -> Progress {
      throw std::runtime_error("sweep " + std::to_string(record.sweep));
    };
    std::vector<double> xy = grid().xy();
    CHECK_THROWS_WITH(trismooth::smooth(trismooth::xy_points(xy), grid().indices(), {}, options), "sweep 1");
    CHECK(xy == grid().xy());
  }
}

TEST_CASE("a smoothing that is done is not called cancelled") {
  SmoothingOptions options;
  options.progress = [](const SweepRecord& record) { return record.moved == 0 ? Progress::stop : Progress::proceed; };
  options.tolerance = 0;
  CHECK(smoothed(grid(), options).result.stop_reason == StopReason::fixed_point);
}

TEST_CASE("the result says who did it") {
  SmoothingOptions options;
  options.threads = 3;
  const SmoothingResult b = smoothed(grid(), options).result;
  CHECK(b.backend == "cpu");
  CHECK_FALSE(b.device.empty());
  CHECK(b.threads == 3);
  CHECK(b.free_vertices == 18 * 18);
  CHECK(b.colours >= 3);
  CHECK(b.colours < 10);
  options.form = Form::swap;
  CHECK(smoothed(grid(), options).result.colours == 0);
  options.threads = 0;
  CHECK(smoothed(grid(), options).result.threads == Workers(0).count());
}

TEST_CASE("the unordered order is not the CPU's") {
  SmoothingOptions options;
  options.order = trismooth::Order::unordered;
  options.execution = trismooth::Execution::cdp;
  std::vector<double> xy = grid().xy();
  CHECK_THROWS_AS(trismooth::smooth(trismooth::xy_points(xy), grid().indices(), {}, options), std::invalid_argument);
  CHECK(xy == grid().xy());
}

TEST_CASE("layout and execution mean nothing to the CPU") {
  SmoothingOptions options;
  const std::vector<double> expected = smoothed(grid(), options).xy;
  options.layout = trismooth::Layout::soa;
  options.execution = trismooth::Execution::single_block;
  CHECK(smoothed(grid(), options).xy == expected);
}

/// A mesh as backends take it, listed counter-clockwise.
trismooth::MeshRings found_in(const Mesh& mesh) {
  Workers workers(1);
  return trismooth::find_mesh_rings(mesh.points, mesh.triangles, {}, workers);
}

TEST_CASE("the points that a mesh is made ready with steer its order in memory and no result") {
  const Mesh& mesh = grid();
  const trismooth::MeshRings found = found_in(mesh);
  const trismooth::LocalFrame frame = trismooth::local_frame(mesh.points);
  std::vector<Point> elsewhere = mesh.points;
  test_meshes::Random random(1);
  random.shuffle(elsewhere);
  for (const Form form : forms) {
    for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
      SmoothingOptions options;
      options.form = form;
      options.precision = precision;
      const auto ordered = trismooth::cpu_backend().prepare(found, mesh.triangles, mesh.points, options);
      const auto disordered = trismooth::cpu_backend().prepare(found, mesh.triangles, elsewhere, options);
      // Twice: a prepared mesh can be smoothed as often as one likes.
      for (int i = 0; i < 2; ++i) {
        std::vector<Point> a = mesh.points;
        std::vector<Point> b = mesh.points;
        const SmoothingResult of_a = ordered->smooth(a, Storage::float64, frame);
        const SmoothingResult of_b = disordered->smooth(b, Storage::float64, frame);
        CHECK(a == b);
        CHECK(of_a.sweeps == of_b.sweeps);
        CHECK(of_a.vertex_updates == of_b.vertex_updates);
        CHECK_FALSE(a == mesh.points);
      }
    }
  }
}

TEST_CASE("a prepared mesh finds the local frame of what cells use where nobody tells it") {
  Mesh mesh = grid();
  // Far away, and of no cell: it has no say.
  mesh.points.push_back({1e9, -1e9});
  for (Point& p : mesh.points) {
    p = {3 * p.x + 50, 3 * p.y - 70};
  }
  const trismooth::MeshRings found = found_in(mesh);
  const auto cells = std::span(mesh.points).first(mesh.points.size() - 1);
  const trismooth::LocalFrame frame = trismooth::local_frame(cells);
  const auto smoother = trismooth::cpu_backend().prepare(found, mesh.triangles, mesh.points, {});
  std::vector<Point> told = mesh.points;
  std::vector<Point> untold = mesh.points;
  CHECK(smoother->smooth(told, Storage::float64, frame).moved_vertices > 0);
  smoother->smooth(untold, Storage::float64, std::nullopt);
  CHECK(told == untold);
}

TEST_CASE("a prepared mesh says why its vertices are fixed") {
  const trismooth::MeshRings found = found_in(grid());
  CHECK(trismooth::cpu_backend().prepare(found, grid().triangles, grid().points, {})->fixed() == found.fixed);
}

TEST_CASE("a prepared mesh knows its triangles without a free vertex, wherever they are by then") {
  // Two triangles of a strip, one of them flat: no vertex is free, so the smallest shape is theirs.
  Mesh strip{{{0, 0}, {1, 0}, {0.5, 0.1}, {1.5, 1}}, {{0, 1, 2}, {2, 1, 3}}};
  SmoothingOptions options;
  options.record_min_shape = true;
  const auto smoother = trismooth::cpu_backend().prepare(found_in(strip), strip.triangles, strip.points, options);
  for (const double height : {0.1, 0.2}) {
    strip.points[2].y = height;
    const double expected = 2 * std::sqrt(3.0) *
                            std::min(naive::element_quotient(strip.points, strip.triangles[0]),
                                     naive::element_quotient(strip.points, strip.triangles[1]));
    const SmoothingResult result = smoother->smooth(strip.points, Storage::float64, std::nullopt);
    REQUIRE(result.history.size() == 1);
    CHECK(result.history[0].min_shape == Approx(expected).epsilon(1e-14));
  }
}

}  // namespace trismooth::cpu_backend_test
