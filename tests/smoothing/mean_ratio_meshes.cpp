// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "trismooth/base/local_frame.h"
#include "trismooth/quality/quality.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/naive_mean_ratio.h"
#include "support/naive_smoothing.h"
#include "support/test_meshes.h"

namespace trismooth::mean_ratio_meshes_test {

using naive::Real;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A grid of `side` x `side` points, sheared and flattened, none of its triangles near equilateral: all alike, or the
/// flatter the lower they lie.
test_meshes::Mesh sheared_grid(std::int32_t side, bool is_graded) {
  test_meshes::Mesh mesh = test_meshes::jittered_grid(side, side, 0, 1);
  mesh.triangles.clear();
  for (std::int32_t j = 0; j + 1 < side; ++j) {
    for (std::int32_t i = 0; i + 1 < side; ++i) {
      const std::int32_t a = j * side + i;
      mesh.triangles.insert(mesh.triangles.end(), {{a, a + 1, a + side + 1}, {a, a + side + 1, a + side}});
    }
  }
  // Powers of two: coordinates and areas are exact.
  for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
    const int i = v % side;
    const int j = v / side;
    mesh.points[v] = {(i + 0.5 * j) / 64, (is_graded ? j * j : j) / 256.0};
  }
  return mesh;
}

struct Smoothed {
  std::vector<double> xy;
  trismooth::SmoothingResult result;
};

Smoothed smoothed(const test_meshes::Mesh& mesh, const MeanRatioOptions& mean_ratio, Form form = Form::in_place) {
  Smoothed run{mesh.xy(), {}};
  SmoothingOptions options;
  options.method = Method::mean_ratio;
  options.mean_ratio = mean_ratio;
  options.form = form;
  options.threads = 1;
  run.result = trismooth::smooth(trismooth::xy_points(run.xy), mesh.indices(), {}, options);
  return run;
}

trismooth::MetricSummary shapes(const test_meshes::Mesh& mesh, const std::vector<double>& xy) {
  return trismooth::quality(trismooth::xy_points(xy), mesh.indices())[trismooth::Metric::shape];
}

TEST_CASE("a sheared grid of equal areas does not move where it keeps its shapes") {
  const test_meshes::Mesh grid = sheared_grid(12, false);
  for (const Form form : {Form::swap, Form::in_place}) {
    const Smoothed kept = smoothed(grid, {1, 0, TargetShape::input}, form);
    CHECK(kept.result.moved_vertices == 0);
    CHECK(kept.xy == grid.xy());
    CHECK(kept.result.stop_reason == trismooth::StopReason::fixed_point);
  }
}

/// Layers of a grid, jittered, turned by `angle`: `aspect` times as long as high at the bottom, each 1.1 times as high
/// as the one below.
struct Layers {
  static constexpr std::int32_t side = 31;
  double aspect = 20;
  double angle = 0;

  double height(double layer) const { return std::pow(1.1, layer) / aspect; }
  test_meshes::Mesh mesh(double jitter) const {
    test_meshes::Mesh mesh = test_meshes::jittered_grid(side, side, jitter, 3);
    for (auto& p : mesh.points) {
      const double x = p.x * (side - 1);
      const double y = (std::pow(1.1, p.y * (side - 1)) - 1) / 0.1 / aspect;
      p = {std::cos(angle) * x - std::sin(angle) * y, std::sin(angle) * x + std::cos(angle) * y};
    }
    return mesh;
  }
  /// Shapes of the triangles, each stretched by as much as its layers are flattened: 1 is equilateral then.
  trismooth::MetricSummary shapes(const test_meshes::Mesh& mesh, const std::vector<double>& xy) const {
    test_meshes::Mesh stretched;
    for (const auto& t : mesh.triangles) {
      double layer = 0;
      for (const std::int32_t v : t) {
        const int row = v / side;  // of the grid, wherever the vertex is now
        layer += row / 3.0;
      }
      for (const std::int32_t v : t) {
        const double x = xy[2 * static_cast<std::size_t>(v)];
        const double y = xy[2 * static_cast<std::size_t>(v) + 1];
        stretched.points.push_back(
            {std::cos(angle) * x + std::sin(angle) * y, (std::cos(angle) * y - std::sin(angle) * x) / height(layer)});
      }
      const std::int32_t first = stretched.vertex_count() - 3;
      stretched.triangles.push_back({first, first + 1, first + 2});
    }
    return mean_ratio_meshes_test::shapes(stretched, stretched.xy());
  }
};

TEST_CASE("layers that are flat on purpose stay as flat as they are, and what is badly made in them gets better") {
  for (const Layers layers : {Layers{20, 0}, Layers{20, 0.5}, Layers{200, 1}}) {
    const test_meshes::Mesh mesh = layers.mesh(0.25);
    const auto before = layers.shapes(mesh, mesh.xy());
    for (const Form form : {Form::swap, Form::in_place}) {
      const Smoothed kept = smoothed(mesh, {1, 0, TargetShape::input}, form);
      const auto after = layers.shapes(mesh, kept.xy);
      CAPTURE(layers.aspect, layers.angle, form, before.min, before.mean, after.min, after.mean);
      CHECK(before.mean < 0.83);
      CHECK(after.mean > 0.92);
      CHECK(after.min > before.min + 0.1);
    }
    // Equilateral triangles are other ones.
    CHECK(layers.shapes(mesh, smoothed(mesh, {1, 0, TargetShape::uniform}).xy).mean < before.mean);
  }
}

TEST_CASE("a mesh that is not flat on purpose gets nearly as good as where equilateral triangles are aimed at") {
  const test_meshes::Mesh mesh = test_meshes::jittered_grid(40, 40, 0.3, 7);
  const auto kept = shapes(mesh, smoothed(mesh, {1, 0, TargetShape::input}).xy);
  const auto uniform = shapes(mesh, smoothed(mesh, {1, 0, TargetShape::uniform}).xy);
  CHECK(kept.mean > uniform.mean - 0.02);
  CHECK(kept.min > shapes(mesh, mesh.xy()).min + 0.1);
}

TEST_CASE("every power makes shapes better, and high ones see to the worst") {
  const test_meshes::Mesh mesh = test_meshes::jittered_grid(40, 40, 0.35, 7);
  const auto before = shapes(mesh, mesh.xy());
  std::vector<trismooth::MetricSummary> after;
  for (int power = 1; power <= 8; ++power) {
    CAPTURE(power);
    const Smoothed run = smoothed(mesh, {0, power, TargetShape::uniform});
    after.push_back(shapes(mesh, run.xy));
    CHECK(after.back().mean > before.mean + 0.1);
    CHECK(after.back().min > before.min + 0.1);
    CHECK(run.result.reverted_vertices == 0);
  }
  CHECK(after[7].min > after[0].min + 0.02);
}

TEST_CASE("the more sizes weigh, the nearer areas are to the means around them before") {
  const test_meshes::Mesh mesh = test_meshes::jittered_grid(30, 30, 0.3, 8);
  const auto frame = trismooth::local_frame(mesh.points);
  std::vector<Point2<double>> local;
  for (const auto p : mesh.points) {
    local.push_back(frame.enter(p));
  }
  const naive::Rings rings = naive::one_rings(mesh.vertex_count(), mesh.triangles);
  const auto aims = naive::mean_ratio_aims(local, rings, {});
  const auto deviation = [&](const std::vector<double>& xy) {
    double sum = 0;
    for (const auto& t : mesh.triangles) {
      const auto at = [&](int i) {
        return naive::widened(
            frame.enter({xy[2 * static_cast<std::size_t>(t[i])], xy[2 * static_cast<std::size_t>(t[i]) + 1]}));
      };
      const Real inverse = (aims.inverse_areas[t[0]] + aims.inverse_areas[t[1]] + aims.inverse_areas[t[2]]) / 3.0L;
      const auto log = static_cast<double>(std::log(naive::doubled_area(at(0), at(1), at(2)) * inverse));
      sum += log * log;
    }
    return std::sqrt(sum / static_cast<double>(mesh.triangles.size()));
  };
  double last = infinity;
  double last_mean = infinity;
  for (const double weight : {0.0, 3.0, 30.0, 1000.0}) {
    const Smoothed run = smoothed(mesh, {weight, 1, TargetShape::uniform});
    CAPTURE(weight, last, deviation(run.xy), shapes(mesh, run.xy).mean);
    CHECK(deviation(run.xy) < last);
    CHECK(shapes(mesh, run.xy).mean < last_mean);
    last = deviation(run.xy);
    last_mean = shapes(mesh, run.xy).mean;
  }
}

TEST_CASE("options of the method out of range are refused") {
  for (const double weight : {-1.0, infinity, std::numeric_limits<double>::quiet_NaN()}) {
    SmoothingOptions options;
    options.mean_ratio.size_weight = weight;
    CHECK_THROWS_AS(options.validate(), std::invalid_argument);
  }
  for (const int power : {-1, 9}) {
    SmoothingOptions options;
    options.mean_ratio.power = power;
    CHECK_THROWS_AS(options.validate(), std::invalid_argument);
  }
  SmoothingOptions options;
  options.mean_ratio = {0, 8, TargetShape::input, true};
  CHECK_NOTHROW(options.validate());
  options.max_sweeps = 0;
  CHECK_THROWS_AS(options.validate(), std::invalid_argument);
}

}  // namespace trismooth::mean_ratio_meshes_test
