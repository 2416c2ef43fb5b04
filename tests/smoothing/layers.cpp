// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/layers/layers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "trismooth/base/hold.h"
#include "trismooth/base/local_points.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/smoothing/rings/mesh_rings.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/layered_meshes.h"
#include "support/test_meshes.h"

namespace layers_test {

using layered_meshes::growing;
using test_meshes::Mesh;
using test_meshes::Point;
using test_meshes::Random;
using trismooth::Layers;
using trismooth::LayersResult;
using trismooth::Method;
using trismooth::SmoothingOptions;
using trismooth::SmoothingResult;

constexpr auto all_methods = trismooth::values_of<Method>();

Mesh layered(std::int32_t columns, std::vector<double> heights, double layer_jitter = 0) {
  Random random(7);
  return layered_meshes::rectangle({columns, std::move(heights), 8, 0.3, layer_jitter}, random);
}

std::vector<std::uint8_t> held(const Mesh& mesh, Layers layers, LayersResult& result, int threads = 1) {
  trismooth::Workers workers(threads);
  std::vector<std::uint8_t> fixed(mesh.points.size(), 0);
  const auto local = trismooth::entered(trismooth::local_frame_of_cells(mesh.points, fixed), mesh.points);
  const auto found = trismooth::find_mesh_rings(local.points, mesh.triangles, {}, workers);
  result = trismooth::hold_layers(local.points, mesh.triangles, found.reversed, layers, false, fixed, workers);
  return fixed;
}

SmoothingResult smoothed(Mesh& mesh, const SmoothingOptions& options) {
  std::vector<double> xy = mesh.xy();
  SmoothingResult result = trismooth::smooth(trismooth::xy_points(xy), mesh.indices(), options);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    mesh.points[v] = {xy[2 * v], xy[2 * v + 1]};
  }
  return result;
}

TEST_CASE("by default a boundary layer keeps its vertices, whatever the method, and the mesh beside it is smoothed") {
  const std::int32_t columns = 40;
  const std::vector<double> heights = growing(0.01, 1.3, 20);
  for (const Method method : all_methods) {
    Mesh mesh = layered(columns, heights);
    const Mesh before = mesh;
    SmoothingOptions options;
    options.method = method;
    const SmoothingResult result = smoothed(mesh, options);
    const auto of_layer = static_cast<std::size_t>(columns) * (heights.size() + 1);
    CHECK(std::equal(mesh.points.begin(), mesh.points.begin() + static_cast<std::ptrdiff_t>(of_layer),
                     before.points.begin()));
    CHECK(result.moved_vertices > 0);
    // All of its vertices but those that the boundary holds.
    CHECK(result.layers.kept == (columns - 2) * std::ssize(heights));
    // A right triangle of legs 1 and h: its edge tensor is [2, h; h, 2 h^2] or so.
    CHECK(result.layers.kept_aspect == Approx(2 / (std::sqrt(3.0) * 0.01)).epsilon(0.15));
    CHECK(result.layers.left == 0);

    options.layers = Layers::smooth;
    mesh = before;
    CHECK(smoothed(mesh, options).layers.kept == 0);
    CHECK_FALSE(std::equal(mesh.points.begin(), mesh.points.begin() + static_cast<std::ptrdiff_t>(of_layer),
                           before.points.begin()));
  }
}

TEST_CASE("a layer of one row, as thin insulation has it, is kept") {
  const Mesh mesh = layered(40, {0.05});
  LayersResult result;
  const std::vector<std::uint8_t> fixed = held(mesh, Layers::automatic, result);
  for (std::size_t v = 1; v < 39; ++v) {
    CHECK(fixed[v] == trismooth::hold::named);
    CHECK(fixed[v + 40] == trismooth::hold::named);
  }
}

TEST_CASE("where vertices slide along walls, the ends and the foot of a layer keep their places as all of it") {
  const std::int32_t columns = 40;
  const std::vector<double> heights = growing(0.01, 1.3, 20);
  for (const trismooth::Slide along : {trismooth::Slide::straight, trismooth::Slide::curves}) {
    Mesh mesh = layered(columns, heights);
    const Mesh before = mesh;
    trismooth::Constraints constraints;
    constraints.slide.along = along;
    SmoothingOptions options;
    options.method = Method::mean_ratio;
    const auto slid = [&] {
      std::vector<double> xy = before.xy();
      const auto result = trismooth::smooth(trismooth::xy_points(xy), mesh.indices(), constraints, options);
      for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        mesh.points[v] = {xy[2 * v], xy[2 * v + 1]};
      }
      return result;
    };
    const auto of_layer = static_cast<std::ptrdiff_t>(columns) * (std::ssize(heights) + 1);
    const SmoothingResult result = slid();
    CHECK(std::equal(mesh.points.begin(), mesh.points.begin() + of_layer, before.points.begin()));
    CHECK(result.sliding->slid > 0);
    // The wall, and both ends; at a corner of the domain nothing slides.
    CHECK(result.layers.kept_on_lines >= columns - 2 + 2 * (std::ssize(heights) - 1));
    CHECK(result.layers.kept == (columns - 2) * std::ssize(heights));

    options.layers = Layers::smooth;
    CHECK(slid().layers.kept_on_lines == 0);
    CHECK_FALSE(std::equal(mesh.points.begin(), mesh.points.begin() + of_layer, before.points.begin()));
  }
}

TEST_CASE("a layer that is distorted is smoothed, counted, and held where that is asked for") {
  const Mesh mesh = layered(60, std::vector<double>(8, 0.05), 0.45);
  LayersResult result;
  CHECK(std::ranges::count(held(mesh, Layers::automatic, result), 0) == mesh.vertex_count());
  CHECK(result.kept == 0);
  CHECK(result.left > 100);
  CHECK(result.left_aspect > 15);
  const std::vector<std::uint8_t> kept = held(mesh, Layers::keep, result);
  CHECK(result.kept > 100);
  CHECK(result.left == 0);
  CHECK(std::ranges::count(kept, 0) == mesh.vertex_count() - result.kept);
}

TEST_CASE(
    "a thin gap one triangle across, whose sides have their vertices staggered, is told of, and held where asked for") {
  constexpr std::int32_t columns = 40;
  const std::vector<double> heights = {0, 1, 2, 3, 3.1, 4, 5, 6};
  Mesh mesh;
  for (std::size_t row = 0; row < heights.size(); ++row) {
    for (std::int32_t i = 0; i < columns; ++i) {
      mesh.points.push_back({i + (row < 4 ? 0 : 0.5), heights[row]});
    }
  }
  for (std::int32_t row = 0; row + 1 < std::ssize(heights); ++row) {
    for (std::int32_t i = 0; i + 1 < columns; ++i) {
      const std::int32_t a = row * columns + i;
      mesh.triangles.insert(mesh.triangles.end(), {{a, a + 1, a + columns}, {a + 1, a + columns + 1, a + columns}});
    }
  }
  LayersResult result;
  held(mesh, Layers::automatic, result);
  CHECK(result.kept == 0);
  // Both sides of the gap but for its ends, which lie on the boundary.
  CHECK(result.left >= 2 * (columns - 3));
  const std::vector<std::uint8_t> kept = held(mesh, Layers::keep, result);
  CHECK(result.left == 0);
  CHECK(std::count(kept.begin() + 3 * columns, kept.begin() + 5 * columns, 0) == 0);
}

TEST_CASE("what nothing moves is not told of as smoothed") {
  Mesh mesh = layered(60, std::vector<double>(8, 0.05), 0.45);
  trismooth::Constraints constraints;
  std::vector<std::int32_t> all(static_cast<std::size_t>(mesh.vertex_count()));
  std::iota(all.begin(), all.end(), 0);
  constraints.fixed_ids = all;
  std::vector<double> xy = mesh.xy();
  CHECK(trismooth::smooth(trismooth::xy_points(xy), mesh.indices(), constraints, {}).layers.left == 0);
}

TEST_CASE("meshes without layers are smoothed to the same bits with and without the search") {
  for (const double jitter : {0.0, 0.3, 0.45}) {
    for (const Method method : all_methods) {
      Mesh searched = test_meshes::jittered_grid(40, 40, jitter, 3);
      Mesh not_searched = searched;
      SmoothingOptions options;
      options.method = method;
      const SmoothingResult result = smoothed(searched, options);
      CHECK(result.layers.kept == 0);
      CHECK(result.layers.left == 0);
      options.layers = Layers::smooth;
      smoothed(not_searched, options);
      CHECK(searched.points == not_searched.points);
    }
  }
}

TEST_CASE("what is found depends on no order, place, direction or unit, and on no number of threads") {
  const Mesh mesh = layered(200, growing(0.002, 1.15, 30));
  LayersResult expected;
  const std::vector<std::uint8_t> fixed = held(mesh, Layers::automatic, expected);
  REQUIRE(expected.kept > 1000);
  const auto check = [&](const Mesh& other) {
    for (const int threads : {1, 3}) {
      LayersResult result;
      CHECK(held(other, Layers::automatic, result, threads) == fixed);
      CHECK(result.kept == expected.kept);
      CHECK(result.kept_aspect == Approx(expected.kept_aspect).epsilon(1e-6));
    }
  };
  check(mesh);
  Random random(5);
  Mesh shuffled = mesh;
  random.shuffle(shuffled.triangles);
  for (auto& triangle : shuffled.triangles) {
    std::rotate(triangle.begin(), triangle.begin() + random.below(3), triangle.end());
    if (random.below(2) == 0) {
      std::swap(triangle[0], triangle[1]);
    }
  }
  check(shuffled);
  for (const double unit : {1e-200, 1e-9, 1e150}) {
    Mesh scaled = mesh;
    const double angle = 0.7;
    for (Point& p : scaled.points) {
      p = {unit * (std::cos(angle) * p.x - std::sin(angle) * p.y),
           unit * (std::sin(angle) * p.x + std::cos(angle) * p.y)};
    }
    check(scaled);
  }
}

TEST_CASE("a plan holds the layers of its first points, whatever comes later") {
  const Mesh mesh = layered(40, growing(0.01, 1.3, 20));
  auto plan = trismooth::plan(mesh.vertex_count(), mesh.indices());
  std::vector<double> xy = mesh.xy();
  const std::int64_t kept = plan.smooth(trismooth::xy_points(xy)).layers.kept;
  REQUIRE(kept > 0);
  // Stretched, nothing is flat any more.
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    xy[2 * v + 1] *= 40;
  }
  const std::vector<double> before = xy;
  CHECK(plan.smooth(trismooth::xy_points(xy)).layers.kept == kept);
  CHECK(std::equal(xy.begin(), xy.begin() + 2 * 40 * 5, before.begin()));
}

TEST_CASE("what else holds vertices of a layer is not counted as layer") {
  const Mesh mesh = layered(40, growing(0.01, 1.3, 20));
  std::vector<double> xy = mesh.xy();
  const std::vector<std::int32_t> ids{50, 51, 52};
  trismooth::Constraints constraints;
  constraints.fixed_ids = ids;
  const std::int64_t all = trismooth::smooth(trismooth::xy_points(xy), mesh.indices()).layers.kept;
  xy = mesh.xy();
  CHECK(trismooth::smooth(trismooth::xy_points(xy), mesh.indices(), constraints).layers.kept == all - 3);
}

}  // namespace layers_test
