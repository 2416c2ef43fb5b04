// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "trismooth/base/errors.h"
#include "trismooth/quality/quadratic_quality.h"
#include "trismooth/smoothing/middle_nodes.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/quadratic_samples.h"
#include "support/same_bits.h"
#include "support/test_meshes.h"

namespace trismooth::smooth_quadratic_test {

using test_meshes::Mesh;
using test_meshes::Point;

using Nodes = std::vector<std::int32_t>;
using Edge = std::pair<std::int32_t, std::int32_t>;

/// Triangles of six nodes: the corners of a mesh, and behind them a middle for every side.
struct CurvedMesh {
  std::vector<double> xy;
  Nodes nodes;
  std::map<Edge, std::int32_t> middles;

  std::size_t size() const { return nodes.size() / 6; }
  double at(std::int32_t v, std::size_t axis) const { return xy[2 * static_cast<std::size_t>(v) + axis]; }
};

/// Middles are off the middle by up to `bend` sides: all, or those of the boundary alone.
CurvedMesh curved(const Mesh& mesh, double bend, std::uint64_t seed, bool boundary_alone = false) {
  test_meshes::Random random(seed);
  CurvedMesh result{mesh.xy(), {}, {}};
  std::map<Edge, int> uses;
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      ++uses[std::minmax(t[i], t[(i + 1) % 3])];
    }
  }
  for (const auto& t : mesh.triangles) {
    result.nodes.insert(result.nodes.end(), t.begin(), t.end());
    for (std::size_t i = 0; i < 3; ++i) {
      const Edge edge = std::minmax(t[i], t[(i + 1) % 3]);
      const auto [found, is_new] = result.middles.emplace(edge, static_cast<std::int32_t>(result.xy.size() / 2));
      if (is_new) {
        const Point p = mesh.points[static_cast<std::size_t>(edge.first)];
        const Point q = mesh.points[static_cast<std::size_t>(edge.second)];
        const double reach = boundary_alone && uses[edge] > 1 ? 0 : bend * std::hypot(p.x - q.x, p.y - q.y);
        result.xy.push_back((p.x + q.x) / 2 + random.between(-reach, reach));
        result.xy.push_back((p.y + q.y) / 2 + random.between(-reach, reach));
      }
      result.nodes.push_back(found->second);
    }
  }
  return result;
}

double smallest_sample(const CurvedMesh& mesh, const std::vector<double>& xy, std::size_t element) {
  return smallest_jacobian_sample([&](std::size_t node, std::size_t axis) {
    return xy[2 * static_cast<std::size_t>(mesh.nodes[6 * element + node]) + axis];
  });
}

SmoothingOptions with(Method method, bool guard = true, int threads = 1) {
  SmoothingOptions options;
  options.method = method;
  options.guard = guard;
  options.threads = threads;
  options.max_sweeps = 40;
  return options;
}

/// At the fraction of its side at which the foot of its perpendicular was, a middle goes with the ends.
void check_middles_follow(const CurvedMesh& mesh, const std::vector<double>& after) {
  for (const auto& [edge, middle] : mesh.middles) {
    double along = 0;
    double length = 0;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double side = mesh.at(edge.second, axis) - mesh.at(edge.first, axis);
      along += side * (mesh.at(middle, axis) - mesh.at(edge.first, axis));
      length += side * side;
    }
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const auto move = [&](std::int32_t v) {
        return after[2 * static_cast<std::size_t>(v) + axis] - mesh.at(v, axis);
      };
      const double ends = move(edge.first) + (move(edge.second) - move(edge.first)) * (along / length);
      REQUIRE(std::abs(move(middle) - ends) <= 1e-15);
      REQUIRE((move(edge.first) != 0 || move(edge.second) != 0 || move(middle) == 0));
    }
  }
}

TEST_CASE(
    "corners of straight triangles of six nodes are smoothed as the triangles of corners are, sides stay straight") {
  for (const Method method : {Method::smart, Method::mean_ratio}) {
    const Mesh mesh = test_meshes::jittered_grid(17, 13, 0.35, 7);
    const CurvedMesh straight = curved(mesh, 0, 1);
    std::vector<double> plain = mesh.xy();
    const SmoothingResult of_corners = trismooth::smooth(xy_points(plain), mesh.triangles, with(method));
    std::vector<double> xy = straight.xy;
    const SmoothingResult result = smooth_quadratic(xy_points(xy), straight.nodes, with(method));
    CHECK(same_bits(std::span(xy).first(plain.size()), std::span(plain)));
    CHECK(result.moved_vertices == of_corners.moved_vertices);
    CHECK(result.moved_vertices > 100);
    CHECK(result.free_vertices == of_corners.free_vertices);
    for (const auto& [edge, middle] : straight.middles) {
      for (std::size_t axis = 0; axis < 2; ++axis) {
        const auto at = [&](std::int32_t v) { return xy[2 * static_cast<std::size_t>(v) + axis]; };
        REQUIRE(std::abs(at(middle) - (at(edge.first) + at(edge.second)) / 2) <= 4e-16);
      }
    }
    check_middles_follow(straight, xy);
  }
}

TEST_CASE("no triangle of six nodes that was valid becomes invalid, by samples of the Jacobian") {
  int lost_without_guard = 0;
  std::int64_t put_back = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    const Method method = std::array{Method::smart, Method::laplacian, Method::mean_ratio}[seed % 3];
    const CurvedMesh mesh =
        curved(test_meshes::jittered_grid(11, 9, 0.3, seed), 0.02 + 0.01 * static_cast<double>(seed % 12), seed);
    std::vector<double> guarded = mesh.xy;
    std::vector<double> loose = mesh.xy;
    put_back += smooth_quadratic(xy_points(guarded), mesh.nodes, with(method)).reverted_vertices;
    smooth_quadratic(xy_points(loose), mesh.nodes, with(method, false));
    check_middles_follow(mesh, guarded);
    CAPTURE(seed);
    for (std::size_t element = 0; element < mesh.size(); ++element) {
      // Well above what the smallest value may be below these samples.
      if (smallest_sample(mesh, mesh.xy, element) > 2e-4) {
        lost_without_guard += smallest_sample(mesh, loose, element) > 0 ? 0 : 1;
        REQUIRE(smallest_sample(mesh, guarded, element) > 0);
      }
    }
  }
  CHECK(lost_without_guard > 0);
  CHECK(put_back > 0);
}

TEST_CASE("middles at a quarter of the sides at a crack's tip stay there, on their straight sides") {
  for (const Method method : {Method::smart, Method::laplacian, Method::mean_ratio}) {
    // The tip is inside of the mesh: it moves as well.
    CurvedMesh mesh = curved(test_meshes::jittered_grid(11, 9, 0.3, 4), 0, 4);
    constexpr std::int32_t tip = 4 * 11 + 5;
    int at_tip = 0;
    const auto from_tip = [&](const Edge& edge) { return edge.first == tip ? edge.second : edge.first; };
    for (const auto& [edge, middle] : mesh.middles) {
      for (std::size_t axis = 0; axis < 2 && (edge.first == tip || edge.second == tip); ++axis) {
        mesh.xy[2 * static_cast<std::size_t>(middle) + axis] =
            mesh.at(tip, axis) + (mesh.at(from_tip(edge), axis) - mesh.at(tip, axis)) / 4;
      }
    }
    std::vector<double> xy = mesh.xy;
    CHECK(smooth_quadratic(xy_points(xy), mesh.nodes, with(method)).moved_vertices > 40);
    for (const auto& [edge, middle] : mesh.middles) {
      if (edge.first == tip || edge.second == tip) {
        ++at_tip;
        for (std::size_t axis = 0; axis < 2; ++axis) {
          const auto at = [&](std::int32_t v) { return xy[2 * static_cast<std::size_t>(v) + axis]; };
          REQUIRE(at(middle) == Approx(at(tip) + (at(from_tip(edge)) - at(tip)) / 4).margin(1e-15));
        }
      }
    }
    CHECK(at_tip > 3);
    CHECK(xy[2 * tip] != mesh.xy[2 * tip]);
  }
}

TEST_CASE("a middle beyond an end of its side goes with that end, and none is moved by ends that stay") {
  using Place = std::array<double, 3>;
  const auto share = [](double middle) {
    return trismooth::share_of_side(Place{1, 1, 0}, Place{1 + middle, 1, 5}, Place{2, 1, 0});
  };
  CHECK(share(0.25) == 0.25);
  CHECK(share(0.5) == 0.5);
  CHECK(share(0.875) == 0.875);
  CHECK(share(-3) == 0.0625);
  CHECK(share(1e300) == 0.9375);
  CHECK(trismooth::share_of_side(Place{1, 2, 3}, Place{4, 5, 6}, Place{1, 2, 3}) == 0.5);
  CHECK(trismooth::share_of_side(Place{}, Place{}, Place{}) == 0.5);
  for (const double scale : {0x1p-1070, 0x1p-600, 0x1p600, 0x1p1022}) {
    CHECK(trismooth::share_of_side(Place{-scale, 0, 0}, Place{-scale / 2, scale, 0}, Place{scale, 0, 0}) == 0.25);
  }
  CHECK(trismooth::middle_move(0.25, 7, 7, 3, 3) == 0);
  CHECK(trismooth::middle_move(0.25, 0, 4, 0, 8) == 5);
}

TEST_CASE("a curved boundary keeps its bits") {
  const Mesh grid = test_meshes::jittered_grid(11, 9, 0.3, 3);
  const CurvedMesh mesh = curved(grid, 0.1, 3, true);
  std::vector<double> xy = mesh.xy;
  const SmoothingResult result = smooth_quadratic(xy_points(xy), mesh.nodes);
  CHECK(result.moved_vertices > 20);
  std::map<std::int32_t, int> uses;
  for (std::size_t element = 0; element < mesh.size(); ++element) {
    for (std::size_t side = 3; side < 6; ++side) {
      ++uses[mesh.nodes[6 * element + side]];
    }
  }
  int on_boundary = 0;
  for (const auto& [middle, count] : uses) {
    if (count == 1) {
      ++on_boundary;
      CHECK(same_bits(std::span(xy).subspan(2 * static_cast<std::size_t>(middle), 2),
                      std::span(mesh.xy).subspan(2 * static_cast<std::size_t>(middle), 2)));
    }
  }
  CHECK(on_boundary == 2 * (10 + 8));
}

TEST_CASE("what is held holds middles and the ends of their sides; places, heights and threads do not matter") {
  const CurvedMesh mesh = curved(test_meshes::jittered_grid(21, 19, 0.3, 5), 0.05, 5);
  std::vector<double> free = mesh.xy;
  smooth_quadratic(xy_points(free), mesh.nodes, with(Method::smart));
  const auto moved = [&](const std::vector<double>& xy, std::int32_t v) {
    return xy[2 * static_cast<std::size_t>(v)] != mesh.at(v, 0);
  };
  const auto& [edge, middle] = *std::ranges::find_if(mesh.middles, [&](const auto& side) {
    return moved(free, side.second) && moved(free, side.first.first) && moved(free, side.first.second);
  });
  const Nodes ids{middle};
  Constraints constraints;
  constraints.fixed_ids = ids;
  std::vector<double> held = mesh.xy;
  smooth_quadratic(xy_points(held), mesh.nodes, constraints, with(Method::smart));
  CHECK_FALSE(moved(held, middle));
  CHECK_FALSE(moved(held, edge.first));
  CHECK_FALSE(moved(held, edge.second));
  CHECK(held != mesh.xy);
  std::vector<double> of_many = mesh.xy;
  smooth_quadratic(xy_points(of_many), mesh.nodes, with(Method::smart, true, 3));
  CHECK(same_bits(std::span(of_many), std::span(free)));
  std::vector<std::array<float, 3>> in_space;
  for (std::size_t v = 0; 2 * v < mesh.xy.size(); ++v) {
    in_space.push_back({static_cast<float>(mesh.xy[2 * v]), static_cast<float>(mesh.xy[2 * v + 1]), 2.5F});
  }
  const std::vector<std::array<float, 3>> before = in_space;
  CHECK(smooth_quadratic(in_space, mesh.nodes).moved_vertices > 100);
  for (std::size_t v = 0; v < in_space.size(); ++v) {
    REQUIRE(in_space[v][2] == 2.5F);
  }
  CHECK(in_space != before);
}

TEST_CASE("what are no triangles of six nodes is refused, and nothing has moved") {
  const CurvedMesh mesh = curved(test_meshes::jittered_grid(5, 5, 0.3, 1), 0, 1);
  std::vector<double> xy = mesh.xy;
  Nodes nodes = mesh.nodes;
  nodes.pop_back();
  CHECK_THROWS_AS(smooth_quadratic(xy_points(xy), nodes), std::invalid_argument);
  for (const std::size_t place : {1U, 4U}) {
    for (const std::int32_t wrong : {-1, static_cast<std::int32_t>(mesh.xy.size() / 2)}) {
      nodes = mesh.nodes;
      nodes[place] = wrong;
      CHECK_THROWS_AS(smooth_quadratic(xy_points(xy), nodes), trismooth::MeshError);
    }
  }
  const Nodes beyond{static_cast<std::int32_t>(mesh.xy.size() / 2)};
  Constraints constraints;
  constraints.fixed_ids = beyond;
  CHECK_THROWS_AS(smooth_quadratic(xy_points(xy), mesh.nodes, constraints), std::invalid_argument);
  CHECK(xy == mesh.xy);
  // A mesh without triangles is fine.
  const Nodes none;
  CHECK(smooth_quadratic(xy_points(xy), none).moved_vertices == 0);
}

TEST_CASE("an untangled mesh of six nodes has as few inverted triangles as it says") {
  CurvedMesh mesh = curved(test_meshes::jittered_grid(11, 9, 0.1, 2), 0, 2);
  // A corner inside is pulled over its neighbours, and its middles with it.
  constexpr std::int32_t corner = 4 * 11 + 5;
  for (const auto& [edge, middle] : mesh.middles) {
    if (edge.first == corner || edge.second == corner) {
      mesh.xy[2 * static_cast<std::size_t>(middle)] += 0.09;
    }
  }
  mesh.xy[2 * static_cast<std::size_t>(corner)] += 0.18;
  std::vector<double> xy = mesh.xy;
  const SmoothingResult result = smooth_quadratic(xy_points(xy), mesh.nodes, with(Method::mean_ratio));
  REQUIRE(result.untangling.has_value());
  CHECK(result.untangling->inverted_before > 0);
  std::int64_t inverted = 0;
  for (std::size_t element = 0; element < mesh.size(); ++element) {
    const auto at = [&](std::size_t node, std::size_t axis) {
      return xy[2 * static_cast<std::size_t>(mesh.nodes[6 * element + node]) + axis];
    };
    inverted +=
        (at(1, 0) - at(0, 0)) * (at(2, 1) - at(0, 1)) - (at(2, 0) - at(0, 0)) * (at(1, 1) - at(0, 1)) > 0 ? 0 : 1;
  }
  CHECK(result.untangling->inverted_after == inverted);
  CHECK(inverted == 0);
}

}  // namespace trismooth::smooth_quadratic_test
