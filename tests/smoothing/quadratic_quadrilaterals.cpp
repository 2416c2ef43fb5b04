// SPDX-License-Identifier: BSD-3-Clause
// Smoothing quadrilaterals of eight and nine nodes, among triangles of six, and among elements of corners alone.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "trismooth/base/errors.h"
#include "trismooth/smoothing/middle_nodes.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/mixed_meshes.h"
#include "support/quadratic_samples.h"
#include "support/same_bits.h"
#include "support/test_meshes.h"

namespace trismooth::quadratic_quadrilaterals_test {

using mixed_meshes::MixedMesh;
using Numbers = std::vector<double>;
using Edge = std::pair<std::int32_t, std::int32_t>;

/// A mesh whose elements have middles, and some of its quadrilaterals centres.
struct CurvedMesh {
  MixedMesh corners;
  Numbers xy;
  std::vector<ElementNodes> elements;
  std::map<Edge, std::int32_t> middles;
  std::map<std::int32_t, std::size_t> centres;  ///< the element of each

  std::size_t nodes(std::size_t e) const { return node_count(elements[e]); }
  double at(std::int32_t v, std::size_t axis) const { return xy[2 * static_cast<std::size_t>(v) + axis]; }
  std::int32_t add(double x, double y) {
    xy.insert(xy.end(), {x, y});
    return static_cast<std::int32_t>(xy.size() / 2 - 1);
  }
};

/// Middles and centres are off the middle by up to `bend` sides. `has_centre(e)`: of a quadrilateral.
template <class HasCentre>
CurvedMesh curved(const MixedMesh& mesh, double bend, std::uint64_t seed, const HasCentre& has_centre) {
  test_meshes::Random random(seed);
  CurvedMesh result{mesh, mesh.xy(), {}, {}, {}};
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const std::vector<std::int32_t> corners = mesh.corners(e);
    ElementNodes nodes;
    nodes.fill(no_corner);
    std::ranges::copy(corners, nodes.begin());
    double x = 0;
    double y = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Edge edge = std::minmax(corners[i], corners[(i + 1) % corners.size()]);
      if (result.middles.find(edge) == result.middles.end()) {
        const double length = std::hypot(result.at(edge.first, 0) - result.at(edge.second, 0),
                                         result.at(edge.first, 1) - result.at(edge.second, 1));
        const auto between = [&](std::size_t axis) {
          return (result.at(edge.first, axis) + result.at(edge.second, axis)) / 2 +
                 random.between(-bend * length, bend * length);
        };
        const double middle_x = between(0);
        result.middles[edge] = result.add(middle_x, between(1));
      }
      nodes[corners.size() + i] = result.middles[edge];
      x += result.at(corners[i], 0) / 4;
      y += result.at(corners[i], 1) / 4;
    }
    if (corners.size() == 4 && has_centre(e)) {
      const double centre_x = x + random.between(-bend, bend);
      nodes[8] = result.add(centre_x, y + random.between(-bend, bend));
      result.centres[nodes[8]] = e;
    }
    result.elements.push_back(nodes);
  }
  return result;
}

CurvedMesh curved(const MixedMesh& mesh, double bend, std::uint64_t seed) {
  return curved(mesh, bend, seed, [](std::size_t e) { return e % 2 == 0; });
}

SmoothingOptions with(Method method, bool guard = true, int threads = 1) {
  SmoothingOptions options;
  options.method = method;
  options.untangle = Untangle::off;
  options.guard = guard;
  options.threads = threads;
  options.max_sweeps = 40;
  return options;
}

double smallest_sample(const CurvedMesh& mesh, const Numbers& xy, std::size_t e) {
  const auto at = [&](std::size_t node, std::size_t axis) {
    return xy[2 * static_cast<std::size_t>(mesh.elements[e][node]) + axis];
  };
  const std::size_t nodes = mesh.nodes(e);
  return nodes == 6 ? smallest_jacobian_sample(at) : smallest_jacobian_sample_of_quad(nodes, at);
}

TEST_CASE("corners of straight quadratic elements are smoothed as those of linear ones, sides stay straight") {
  for (const Method method : {Method::smart, Method::mean_ratio, Method::laplacian}) {
    const MixedMesh mesh(13, 11, 0.3, 7);
    const CurvedMesh straight = curved(mesh, 0, 1);
    Numbers plain = mesh.xy();
    const SmoothingResult of_corners = smooth(xy_points(plain), mesh.elements, with(method, false));
    Numbers xy = straight.xy;
    const SmoothingResult result = smooth_quadratic(xy_points(xy), straight.elements, {}, with(method, false));
    CHECK(same_bits(std::span(xy).first(plain.size()), std::span(plain)));
    CHECK(result.moved_vertices == of_corners.moved_vertices);
    CHECK(result.moved_vertices > 100);
    CHECK(result.free_vertices == of_corners.free_vertices);
    const auto at = [&](std::int32_t v, std::size_t axis) { return xy[2 * static_cast<std::size_t>(v) + axis]; };
    for (const auto& [edge, middle] : straight.middles) {
      for (const std::size_t axis : {0U, 1U}) {
        REQUIRE(std::abs(at(middle, axis) - (at(edge.first, axis) + at(edge.second, axis)) / 2) <= 1e-14);
      }
    }
    CHECK(straight.centres.size() > 20);
  }
}

TEST_CASE("a centre goes where an affine map of its parallelogram takes it, wherever in it it is") {
  test_meshes::Random random(6);
  for (int trial = 0; trial < 200; ++trial) {
    const auto number = [&] { return random.between(-1, 1); };
    const std::array<double, 2> a{number(), number()};
    const std::array<double, 2> along{1 + number() / 2, number() / 2};
    const std::array<double, 2> across{number() / 2, 1 + number() / 2};
    const double u = random.between(0.1, 0.9);
    const double v = random.between(0.1, 0.9);
    std::array<std::array<double, 3>, 5> before{};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      before[0][axis] = a[axis];
      before[1][axis] = a[axis] + along[axis];
      before[2][axis] = a[axis] + along[axis] + across[axis];
      before[3][axis] = a[axis] + across[axis];
      before[4][axis] = a[axis] + u * along[axis] + v * across[axis];
    }
    std::vector<MiddleNode> centre{{4, {0, 1, 2, 3}}};
    find_shares(centre, [&](std::int32_t i) { return before[static_cast<std::size_t>(i)]; });
    const std::array<double, 3> map{number(), number(), number()};  // x is added to, and scaled by x and by y
    const auto now = [&](std::size_t i) { return map[0] + map[1] * before[i][0] + map[2] * before[i][1]; };
    const double move = move_of(
        centre[0], [&](std::int32_t i) { return before[static_cast<std::size_t>(i)][0]; },
        [&](std::int32_t i) { return now(static_cast<std::size_t>(i)); });
    REQUIRE(before[4][0] + move == Approx(now(4)).margin(1e-12));
    // Corners that stay leave it where it is, to the bit.
    const auto stays = [&](std::int32_t i) { return before[static_cast<std::size_t>(i)][0]; };
    REQUIRE(move_of(centre[0], stays, stays) == 0);
  }
}

TEST_CASE("no quadratic element that was valid becomes invalid, by samples of the Jacobian") {
  int lost_without_guard = 0;
  std::int64_t put_back = 0;
  int valid = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Method method = std::array{Method::smart, Method::laplacian, Method::mean_ratio}[seed % 3];
    const double bend = 0.02 + 0.01 * static_cast<double>(seed % 14);
    const CurvedMesh mesh = curved(MixedMesh(9, 8, 0.25, seed, seed % 4 == 0 ? 2 : 0), bend, seed);
    Numbers guarded = mesh.xy;
    Numbers loose = mesh.xy;
    put_back += smooth_quadratic(xy_points(guarded), mesh.elements, {}, with(method)).reverted_vertices;
    smooth_quadratic(xy_points(loose), mesh.elements, {}, with(method, false));
    CAPTURE(seed);
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
      // Well above what the smallest value may be below these samples.
      if (smallest_sample(mesh, mesh.xy, e) > 0.02) {
        ++valid;
        lost_without_guard += smallest_sample(mesh, loose, e) > 0 ? 0 : 1;
        REQUIRE(smallest_sample(mesh, guarded, e) > 0);
      }
    }
  }
  CHECK(valid > 2000);
  CHECK(lost_without_guard > 0);
  CHECK(put_back > 0);
}

TEST_CASE("no element whose Jacobian is 0 in a corner becomes invalid, by samples of the Jacobian") {
  int lost_without_guard = 0;
  int seen = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const std::uint64_t thirds = seed % 3 == 0 ? 3 : 0;
    CurvedMesh mesh = curved(MixedMesh(4, 4, 0.25, seed, thirds), 0, seed, [&](std::size_t) { return seed % 3 == 1; });
    // Both sides of one corner leave it in one direction.
    const std::size_t e = thirds == 0 ? 5 : 10;
    const std::size_t count = mesh.corners.corners(e).size();
    const ElementNodes& nodes = mesh.elements[e];
    const std::array<std::size_t, 2> others{1, count - 1};
    const std::array<std::size_t, 2> middles{count, 2 * count - 1};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double a = mesh.at(nodes[0], axis);
      const double way = (mesh.at(nodes[1], axis) - a + mesh.at(nodes[count - 1], axis) - a) / 2;
      for (std::size_t side = 0; side < 2; ++side) {
        const double other = mesh.at(nodes[others[side]], axis);
        mesh.xy[2 * static_cast<std::size_t>(nodes[middles[side]]) + axis] = (way + other + 3 * a) / 4;
      }
    }
    if (std::abs(smallest_sample(mesh, mesh.xy, e)) > 1e-12) {
      continue;  // below 0 elsewhere
    }
    ++seen;
    Numbers guarded = mesh.xy;
    Numbers loose = mesh.xy;
    smooth_quadratic(xy_points(guarded), mesh.elements, {}, with(Method::smart));
    smooth_quadratic(xy_points(loose), mesh.elements, {}, with(Method::smart, false));
    CAPTURE(seed);
    CHECK(smallest_sample(mesh, guarded, e) > -1e-5);
    lost_without_guard += smallest_sample(mesh, loose, e) < -1e-3 ? 1 : 0;
  }
  CHECK(seen > 30);
  CHECK(lost_without_guard > 10);
}

/// Mirrored along x, all but the boundary: most elements are inverted as they are listed.
MixedMesh mirrored_inside(std::int32_t columns, std::uint64_t seed, std::uint64_t thirds) {
  MixedMesh mesh(columns, columns, 0.25, seed, thirds);
  for (std::int32_t row = 1; row < columns; ++row) {
    for (std::int32_t column = 1; column < columns; ++column) {
      const std::int32_t vertex = row * (columns + 1) + column;
      double& x = mesh.points[static_cast<std::size_t>(vertex)][0];
      x = columns - x;
    }
  }
  return mesh;
}

/// Whether each element is valid, by samples of the Jacobian. `is_turned`: clockwise is the right way round.
std::vector<bool> valid_elements(const CurvedMesh& mesh, Numbers xy, bool is_turned) {
  for (std::size_t i = 0; is_turned && i < xy.size(); i += 2) {
    xy[i] = -xy[i];
  }
  std::vector<bool> valid(mesh.elements.size());
  for (std::size_t e = 0; e < valid.size(); ++e) {
    valid[e] = smallest_sample(mesh, xy, e) > 0;
  }
  return valid;
}

TEST_CASE("a mesh that is turned over has no more invalid curved elements than it had, none of them new") {
  int turned = 0;
  int kept = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    const double bend = 0.04 * static_cast<double>(seed % 5);
    const CurvedMesh mesh = curved(mirrored_inside(8, seed, seed % 4), bend, seed);
    SmoothingOptions options = with(seed % 2 == 0 ? Method::smart : Method::mean_ratio);
    options.untangle = Untangle::on;
    Numbers xy = mesh.xy;
    const bool is_turned =
        smooth_quadratic(xy_points(xy), mesh.elements, {}, options).untangling->turned_components == 1;
    const std::vector<bool> before = valid_elements(mesh, mesh.xy, true);
    const std::vector<bool> after = valid_elements(mesh, xy, !is_turned);
    for (std::size_t e = 0; e < before.size(); ++e) {
      CHECK((!before[e] || after[e]));
    }
    CHECK(std::ranges::count(after, false) <= std::ranges::count(before, false));
    (is_turned ? turned : kept) += 1;
  }
  CHECK(turned > 10);
  CHECK(kept > 10);
}

TEST_CASE("a curved boundary of quadrilaterals keeps its bits") {
  const CurvedMesh mesh = curved(MixedMesh(9, 8, 0.25, 3, 0), 0.05, 3);
  Numbers xy = mesh.xy;
  CHECK(smooth_quadratic(xy_points(xy), mesh.elements).moved_vertices > 20);
  std::map<std::int32_t, int> uses;
  for (const ElementNodes& nodes : mesh.elements) {
    for (std::size_t i = 4; i < 8; ++i) {
      ++uses[nodes[i]];
    }
  }
  int on_boundary = 0;
  for (const auto& [middle, count] : uses) {
    const auto v = 2 * static_cast<std::size_t>(middle);
    if (count == 1) {
      ++on_boundary;
      CHECK(same_bits(std::span(xy).subspan(v, 2), std::span(mesh.xy).subspan(v, 2)));
    }
  }
  CHECK(on_boundary == 2 * (9 + 8));
}

TEST_CASE("a centre that is held holds the corners around it; threads and kinds of numbers do not matter") {
  const CurvedMesh mesh = curved(MixedMesh(15, 13, 0.25, 5), 0.03, 5);
  Numbers free = mesh.xy;
  smooth_quadratic(xy_points(free), mesh.elements, {}, with(Method::smart));
  const auto moved = [&](const Numbers& xy, std::int32_t v) {
    return xy[2 * static_cast<std::size_t>(v)] != mesh.at(v, 0);
  };
  const auto& [centre, e] = *std::ranges::find_if(mesh.centres, [&](const auto& found) {
    const ElementNodes& nodes = mesh.elements[found.second];
    return moved(free, found.first) &&
           std::all_of(nodes.begin(), nodes.begin() + 4, [&](auto v) { return moved(free, v); });
  });
  const std::vector<std::int32_t> ids{centre};
  Constraints constraints;
  constraints.fixed_ids = ids;
  Numbers held = mesh.xy;
  smooth_quadratic(xy_points(held), mesh.elements, constraints, with(Method::smart));
  for (const std::int32_t v : mesh.elements[e]) {
    CHECK_FALSE(moved(held, v));
  }
  CHECK(held != mesh.xy);
  Numbers of_many = mesh.xy;
  smooth_quadratic(xy_points(of_many), mesh.elements, {}, with(Method::smart, true, 3));
  CHECK(same_bits(std::span(of_many), std::span(free)));
}

TEST_CASE(
    "elements of every number of nodes stand in one mesh, and triangles of six nodes are those of their own list") {
  const MixedMesh grid(10, 9, 0.25, 9);
  CurvedMesh mesh = curved(grid, 0.02, 9);
  // A third of the elements have their corners alone.
  for (std::size_t e = 0; e < mesh.elements.size(); e += 3) {
    std::fill(mesh.elements[e].begin() + static_cast<std::ptrdiff_t>(grid.corners(e).size()), mesh.elements[e].end(),
              no_corner);
  }
  Numbers xy = mesh.xy;
  const SmoothingResult result = smooth_quadratic(xy_points(xy), mesh.elements, {}, with(Method::mean_ratio));
  CHECK(result.moved_vertices > 50);
  CHECK(result.inverted == 0);

  const MixedMesh of_triangles(9, 9, 0.2, 4, 3);
  const CurvedMesh six = curved(of_triangles, 0.05, 4);
  std::vector<std::int32_t> numbers;
  for (const ElementNodes& nodes : six.elements) {
    numbers.insert(numbers.end(), nodes.begin(), nodes.begin() + 6);
  }
  Numbers listed = six.xy;
  Numbers in_rows = six.xy;
  smooth_quadratic(xy_points(listed), numbers, with(Method::smart));
  smooth_quadratic(xy_points(in_rows), six.elements, {}, with(Method::smart));
  CHECK(same_bits(std::span(listed), std::span(in_rows)));
  CHECK(listed != six.xy);
}

TEST_CASE("elements of another number of nodes are refused, and nothing has moved") {
  const CurvedMesh mesh = curved(MixedMesh(4, 4, 0.2, 1, 0), 0, 1);
  Numbers xy = mesh.xy;
  for (const std::size_t left : {0U, 2U, 5U, 7U}) {
    std::vector<ElementNodes> elements = mesh.elements;
    std::fill(elements[3].begin() + static_cast<std::ptrdiff_t>(left), elements[3].end(), no_corner);
    CHECK_THROWS_AS(smooth_quadratic(xy_points(xy), elements), MeshError);
  }
  std::vector<ElementNodes> with_gap = mesh.elements;
  with_gap[1] = {0, 1, 6, no_corner, 5, no_corner, no_corner, no_corner, no_corner};
  CHECK_THROWS_AS(smooth_quadratic(xy_points(xy), with_gap), MeshError);
  for (const std::size_t place : {1U, 6U}) {
    std::vector<ElementNodes> elements = mesh.elements;
    elements[2][place] = static_cast<std::int32_t>(mesh.xy.size() / 2);
    CHECK_THROWS_AS(smooth_quadratic(xy_points(xy), elements), MeshError);
  }
  Constraints sliding;
  sliding.slide.along = Slide::straight;
  CHECK_THROWS_AS(smooth_quadratic(xy_points(xy), mesh.elements, sliding), std::invalid_argument);
  CHECK(xy == mesh.xy);
  const std::vector<ElementNodes> none;
  CHECK(smooth_quadratic(xy_points(xy), none).moved_vertices == 0);
}

}  // namespace trismooth::quadratic_quadrilaterals_test
