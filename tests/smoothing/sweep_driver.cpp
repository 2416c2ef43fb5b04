// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/sweeps/sweep_driver.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "trismooth/base/local_frame.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/naive_smoothing.h"
#include "support/sanitized.h"
#include "support/test_meshes.h"

namespace trismooth::sweep_driver_test {

using test_meshes::Mesh;
using test_meshes::Point;

/// What the sweeps make of a mesh by the naive reference.
struct Reference {
  std::vector<double> xy;
  naive::Outcome outcome;
  std::int64_t free_vertices = 0;
  double fixed_shape = 0;  ///< the smallest of the triangles without a free vertex
};

template <class T>
Reference reference(const Mesh& mesh, const SmoothingOptions& options) {
  const trismooth::LocalFrame frame = trismooth::local_frame(mesh.points);
  std::vector<Point> before;
  std::vector<Point2<T>> points;
  for (const Point p : mesh.points) {
    before.push_back(frame.enter(p));
    points.push_back({static_cast<T>(before.back().x), static_cast<T>(before.back().y)});
  }
  const std::vector<Point2<T>> start = points;
  const naive::Rings rings = naive::one_rings(mesh.vertex_count(), mesh.triangles);
  Reference result;
  result.outcome = naive::smooth(points, rings, options.method, options.form, options.tolerance, options.max_sweeps,
                                 options.mean_ratio);
  result.xy = mesh.xy();
  result.free_vertices = std::ranges::count_if(rings, [](const auto& ring) { return !ring.empty(); });
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (!(points[v] == start[v])) {
      const Point stored = frame.leave({static_cast<double>(points[v].x), static_cast<double>(points[v].y)});
      result.xy[2 * v] = stored.x;
      result.xy[2 * v + 1] = stored.y;
    }
  }
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh.triangles) {
    if (std::ranges::all_of(t, [&](std::int32_t v) { return rings[v].empty(); })) {
      smallest = std::min(smallest, naive::element_quotient(before, t));
    }
  }
  result.fixed_shape = 2 * std::sqrt(3.0) * smallest;
  return result;
}

Reference reference(const Mesh& mesh, const SmoothingOptions& options) {
  return options.precision == Precision::double_precision ? reference<double>(mesh, options)
                                                          : reference<float>(mesh, options);
}

void check_history(const SmoothingResult& result, const Reference& expected, const SmoothingOptions& options) {
  REQUIRE(result.history.size() == expected.outcome.sweeps.size());
  std::int64_t evaluated = 0;
  for (std::size_t i = 0; i < result.history.size(); ++i) {
    CAPTURE(i);
    const trismooth::SweepRecord& record = result.history[i];
    const naive::SweepCount& count = expected.outcome.sweeps[i];
    REQUIRE(record.sweep == static_cast<std::int64_t>(i) + 1);
    REQUIRE(record.moved == count.moved);
    REQUIRE(record.evaluated == (options.evaluation == Evaluation::all ? expected.free_vertices : count.changed));
    REQUIRE(record.max_relative_move == count.max_relative_move);
    if (options.record_min_shape && std::isfinite(std::min(count.min_shape, expected.fixed_shape))) {
      REQUIRE(record.min_shape == std::min(count.min_shape, expected.fixed_shape));
    } else {
      REQUIRE(std::isnan(record.min_shape));
    }
    evaluated += record.evaluated;
  }
  REQUIRE(result.vertex_updates == evaluated);
}

/// Every number of threads and both evaluations against the reference.
void check_against_reference(const Mesh& mesh, SmoothingOptions options) {
  options.guard = false;
  options.layers = trismooth::Layers::smooth;
  options.untangle = trismooth::Untangle::off;
  const Reference expected = reference(mesh, options);
  for (const Evaluation evaluation : {Evaluation::changed, Evaluation::all}) {
    for (const int threads : is_sanitized ? std::vector{1, 3} : std::vector{1, 2, 3, 8}) {
      CAPTURE(evaluation, threads);
      options.evaluation = evaluation;
      options.threads = threads;
      options.record_min_shape = threads % 2 == 1;
      std::vector<double> xy = mesh.xy();
      const SmoothingResult result = trismooth::smooth(trismooth::xy_points(xy), mesh.indices(), {}, options);
      REQUIRE(xy == expected.xy);
      REQUIRE(result.sweeps == static_cast<std::int64_t>(expected.outcome.sweeps.size()));
      REQUIRE(result.stop_reason == expected.outcome.reason);
      REQUIRE(result.free_vertices == expected.free_vertices);
      check_history(result, expected, options);
    }
  }
}

constexpr auto methods = trismooth::values_of<Method>();
constexpr Form forms[] = {Form::swap, Form::in_place};
constexpr Precision precisions[] = {Precision::double_precision, Precision::single_precision};

TEST_CASE(
    "sweeps equal the naive reference bit for bit where every sweep and every colour has work for several threads") {
  const Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(96, 96, 0.6, 1), 2);
  for (const Method method : methods) {
    for (const Form form : forms) {
      for (const Precision precision : precisions) {
        CAPTURE(method, form, precision);
        SmoothingOptions options;
        options.method = method;
        options.form = form;
        options.precision = precision;
        options.max_sweeps = 8;
        check_against_reference(mesh, options);
      }
    }
  }
}

TEST_CASE("the same holds down to the fixed point and to a coarse tolerance") {
  const Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(16, 16, 0.5, 3), 4);
  for (const Form form : forms) {
    for (const Precision precision : precisions) {
      for (const double tolerance : {0.0, 1e-3, 1e-2}) {
        CAPTURE(form, precision, tolerance);
        SmoothingOptions options;
        options.form = form;
        options.precision = precision;
        options.tolerance = tolerance;
        options.max_sweeps = 3000;
        check_against_reference(mesh, options);
        options.method = Method::laplacian;
        options.max_sweeps = 300;
        check_against_reference(mesh, options);
      }
    }
  }
}

TEST_CASE("skipping unchanged neighbourhoods saves evaluations") {
  const Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(40, 40, 0.3, 1), 2);
  for (const Form form : forms) {
    SmoothingOptions options;
    options.form = form;
    options.tolerance = 0;
    std::vector<double> xy = mesh.xy();
    const SmoothingResult changed = trismooth::smooth(trismooth::xy_points(xy), mesh.indices(), {}, options);
    options.evaluation = Evaluation::all;
    std::vector<double> again = mesh.xy();
    const SmoothingResult all = trismooth::smooth(trismooth::xy_points(again), mesh.indices(), {}, options);
    CHECK(xy == again);
    CHECK(all.vertex_updates == all.sweeps * all.free_vertices);
    CHECK(changed.vertex_updates < all.vertex_updates / 2);
  }
}

}  // namespace trismooth::sweep_driver_test
