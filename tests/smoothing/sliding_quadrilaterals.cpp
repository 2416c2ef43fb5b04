// SPDX-License-Identifier: BSD-3-Clause
// Sliding along the lines of meshes with quadrilaterals: what users are promised, by plain loops over the elements.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/mixed_meshes.h"
#include "support/same_bits.h"

namespace trismooth::sliding_quadrilaterals_test {

using mixed_meshes::MixedMesh;
using mixed_meshes::Point;
using mixed_meshes::shape_by_definition;
using Numbers = std::vector<double>;

constexpr std::array methods{Method::smart, Method::laplacian, Method::weighted, Method::mean_ratio};

struct Smoothed {
  Numbers xy;
  SmoothingResult result;

  Point at(std::int32_t v) const {
    const auto i = static_cast<std::size_t>(v);
    return {xy[2 * i], xy[2 * i + 1]};
  }
};

SmoothingOptions with(Method method, Form form = Form::in_place) {
  SmoothingOptions options;
  options.method = method;
  options.form = form;
  options.threads = 1;
  options.layers = Layers::smooth;
  return options;
}

Smoothed smoothed(const MixedMesh& mesh, const Constraints& constraints, const SmoothingOptions& options) {
  Smoothed found{mesh.xy(), {}};
  found.result = smooth(xy_points(found.xy), mesh.elements, constraints, options);
  return found;
}

Constraints sliding(Slide along, double deviation = 1e-3) {
  Constraints constraints;
  constraints.slide.along = along;
  constraints.slide.deviation = deviation;
  return constraints;
}

bool is_at(const Smoothed& found, const MixedMesh& mesh, std::int32_t v) {
  const Point& before = mesh.points[static_cast<std::size_t>(v)];
  return same_bits(found.at(v)[0], before[0]) && same_bits(found.at(v)[1], before[1]);
}

Numbers shapes(const MixedMesh& mesh, const Numbers& xy) {
  Numbers found;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    found.push_back(shape_by_definition(mesh, e, xy));
  }
  return found;
}
double smallest(const MixedMesh& mesh, const Numbers& xy) {
  return std::ranges::min(shapes(mesh, xy));
}

/// What breaks the promise that nothing gets worse: an element that was valid is not, or is worse than it was and than
/// all were around the vertices that have moved.
std::string worse_element(const MixedMesh& mesh, const Numbers& after) {
  constexpr double rounding = 1e-12;
  const Numbers xy = mesh.xy();
  const Numbers was = shapes(mesh, xy);
  const Numbers is = shapes(mesh, after);
  double threshold = std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < was.size(); ++e) {
    const std::vector<std::int32_t> corners = mesh.corners(e);
    if (std::ranges::any_of(corners, [&](std::int32_t v) {
          const auto i = 2 * static_cast<std::size_t>(v);
          return xy[i] != after[i] || xy[i + 1] != after[i + 1];
        })) {
      threshold = std::min(threshold, was[e]);
    }
  }
  for (std::size_t e = 0; e < was.size(); ++e) {
    const bool is_lost = was[e] > rounding && !(is[e] > 0);
    if (is_lost || is[e] < std::min(threshold, was[e]) - rounding) {
      return "element " + std::to_string(e) + " was " + std::to_string(was[e]) + " and is " + std::to_string(is[e]);
    }
  }
  return {};
}

/// A grid of squares, of which about so many thirds are two triangles; its sides are straight and its vertices off
/// their places, those of the sides along these.
struct UnevenSquare : MixedMesh {
  std::int32_t cells;

  UnevenSquare(std::int32_t count, double jitter, std::uint64_t seed, std::uint64_t thirds)
      : MixedMesh(count, count, jitter, seed, thirds), cells(count) {
    for (std::int32_t i = 0; i <= count; ++i) {
      points[at(i, 0)][1] = points[at(0, i)][0] = 0;
      points[at(i, count)][1] = points[at(count, i)][0] = count;
    }
    for (const std::int32_t i : {0, count}) {
      for (const std::int32_t j : {0, count}) {
        points[at(i, j)] = {static_cast<double>(i), static_cast<double>(j)};
      }
    }
  }

  std::int32_t vertex(std::int32_t column, std::int32_t row) const { return row * (cells + 1) + column; }
  std::size_t at(std::int32_t column, std::int32_t row) const { return static_cast<std::size_t>(vertex(column, row)); }
};

TEST_CASE("vertices of quadrilaterals slide along straight sides, which stay the same sets of points") {
  for (const std::uint64_t thirds : {0, 1}) {
    const UnevenSquare mesh(12, 0.3, 7, thirds);
    const std::int32_t last = mesh.cells;
    for (const Method method : methods) {
      const Smoothed found = smoothed(mesh, sliding(Slide::straight), with(method));
      REQUIRE(found.result.sliding);
      CHECK(found.result.sliding->chains == 4);
      CHECK(found.result.sliding->vertices == 4 * (last - 1));
      CHECK(found.result.sliding->slid > 0);
      CHECK(worse_element(mesh, found.xy).empty());
      for (const std::int32_t column : {0, last}) {
        for (const std::int32_t row : {0, last}) {
          CHECK(is_at(found, mesh, mesh.vertex(column, row)));
        }
      }
      for (std::int32_t i = 0; i < last; ++i) {
        CHECK(found.at(mesh.vertex(i, 0))[1] == 0);
        CHECK(found.at(mesh.vertex(0, i))[0] == 0);
        CHECK(found.at(mesh.vertex(i, last))[1] == last);
        CHECK(found.at(mesh.vertex(last, i))[0] == last);
        CHECK(found.at(mesh.vertex(i, 0))[0] < found.at(mesh.vertex(i + 1, 0))[0]);
      }
    }
  }
}

TEST_CASE("sliding makes the worst quadrilateral of an uneven square better than a boundary that is held") {
  for (const std::uint64_t thirds : {0, 1}) {
    const UnevenSquare mesh(20, 0.35, 11, thirds);
    const Smoothed held = smoothed(mesh, {}, with(Method::mean_ratio));
    const Smoothed found = smoothed(mesh, sliding(Slide::straight), with(Method::mean_ratio));
    CHECK_FALSE(held.result.sliding);
    CHECK(found.result.sliding->slid > 3 * mesh.cells);
    CHECK(smallest(mesh, found.xy) > smallest(mesh, held.xy) + 0.05);
  }
}

/// Two elements on a straight line of three vertices, of which the middle one, number 1, alone may move: quadrilaterals
/// or one and a triangle.
MixedMesh strip(std::mt19937_64& random) {
  std::uniform_real_distribution<double> part(0.1, 0.9);
  MixedMesh mesh;
  mesh.points = {{0, 0}, {2 * part(random), 0}, {2, 0}, {2, 2 * part(random)}, {2 * part(random), 2 * part(random)}};
  mesh.elements = {{1, 2, 3, 4}};
  if (random() % 3 == 0) {
    mesh.elements.push_back({0, 1, 4, -1});
  } else {
    mesh.points.push_back({0, 2 * part(random)});
    mesh.elements.push_back({0, 1, 4, 5});
  }
  return mesh;
}
Constraints middle_alone(const MixedMesh& mesh, std::vector<std::int32_t>& named) {
  named = {0};
  for (std::int32_t v = 2; v < mesh.vertex_count(); ++v) {
    named.push_back(v);
  }
  Constraints constraints = sliding(Slide::straight);
  constraints.fixed_ids = named;
  return constraints;
}

TEST_CASE("the smart rule has a vertex slide where the smallest quality of its elements of either kind grows") {
  std::mt19937_64 random(3);
  std::array<int, 2> counts{};
  for (int times = 0; times < 400; ++times) {
    const MixedMesh mesh = strip(random);
    std::vector<std::int32_t> named;
    const Constraints constraints = middle_alone(mesh, named);
    if (!(smallest(mesh, mesh.xy()) > 0)) {
      continue;
    }
    Numbers moved = mesh.xy();
    moved[2] = 1;
    const bool is_better = smallest(mesh, moved) > smallest(mesh, mesh.xy());
    // (A step of less than a 64th of the way is not made.)
    const bool is_worth_it = std::abs(mesh.points[1][0] - 1) > 2.0 / 64;
    const Smoothed found = smoothed(mesh, constraints, with(Method::smart));
    if (is_better && is_worth_it) {
      CHECK(std::abs(found.at(1)[0] - 1) < 1e-15);
      CHECK(found.at(1)[1] == 0);
    } else {
      CHECK(is_at(found, mesh, 1));
    }
    ++counts[is_better ? 1 : 0];
  }
  CHECK(std::ranges::min(counts) > 50);
}

/// The energy of a quadrilateral or a triangle by its definition: of the corners half of 1 / (their shape), of a
/// triangle 1 / shape.
double energy_by_definition(const MixedMesh& mesh, const Numbers& xy) {
  double sum = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const std::vector<std::int32_t> corners = mesh.corners(e);
    if (corners.size() == 3) {
      sum += 1 / shape_by_definition(mesh, e, xy);
      continue;
    }
    for (std::size_t i = 0; i < 4; ++i) {
      const auto edge = [&](std::size_t to) {
        const auto a = 2 * static_cast<std::size_t>(corners[i]);
        const auto b = 2 * static_cast<std::size_t>(corners[to % 4]);
        return Point{xy[b] - xy[a], xy[b + 1] - xy[a + 1]};
      };
      const Point out = edge(i + 1);
      const Point back = edge(i + 3);
      sum += (out[0] * out[0] + out[1] * out[1] + back[0] * back[0] + back[1] * back[1]) /
             (4 * (out[0] * back[1] - out[1] * back[0]));
    }
  }
  return sum;
}

TEST_CASE("by mean ratio a vertex slides to where the energy of its elements is smallest on the line") {
  std::mt19937_64 random(5);
  int looked_at = 0;
  for (int times = 0; times < 400; ++times) {
    const MixedMesh mesh = strip(random);
    Numbers xy = mesh.xy();
    if (smallest(mesh, xy) < 0.05) {
      continue;  // the rule is another one where there is no energy
    }
    std::vector<std::int32_t> named;
    const Constraints constraints = middle_alone(mesh, named);
    SmoothingOptions options = with(Method::mean_ratio);
    options.mean_ratio.size_weight = 0;
    options.mean_ratio.power = 1;
    options.guard = false;  // the energy is of all corners, the guard's quality that of the worst
    const Smoothed found = smoothed(mesh, constraints, options);
    double best = std::numeric_limits<double>::infinity();
    double place = 0;
    for (double x = 0.001; x < 2; x += 0.001) {
      xy[2] = x;
      if (const double energy = energy_by_definition(mesh, xy); smallest(mesh, xy) > 0 && energy < best) {
        best = energy;
        place = x;
      }
    }
    ++looked_at;
    CHECK(found.at(1)[1] == 0);
    CHECK(std::abs(found.at(1)[0] - place) < 0.04);  // (short steps are not made: a 64th of the way from end to end)
  }
  CHECK(looked_at > 100);
}

/// Rings of quadrilaterals, those of one half of every second ring cut into triangles; vertices are unevenly spaced
/// on their circles.
MixedMesh uneven_annulus(std::int32_t around, std::int32_t rings, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> off(-0.35, 0.35);
  MixedMesh mesh;
  for (std::int32_t r = 0; r < rings; ++r) {
    for (std::int32_t i = 0; i < around; ++i) {
      const double angle = 2 * std::numbers::pi * (i + off(random)) / around;
      const double radius = 0.3 + 0.7 * r / (rings - 1);
      mesh.points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
  }
  for (std::int32_t r = 0; r + 1 < rings; ++r) {
    for (std::int32_t i = 0; i < around; ++i) {
      const std::int32_t a = r * around + i;
      const std::int32_t b = r * around + (i + 1) % around;
      if (r % 2 == 1 && 2 * i < around) {
        mesh.elements.insert(mesh.elements.end(), {{a, a + around, b, -1}, {b, a + around, b + around, -1}});
      } else {
        mesh.elements.push_back({a, a + around, b + around, b});
      }
    }
  }
  return mesh;
}

double distance_to_edge(Point p, Point a, Point b) {
  const Point way{b[0] - a[0], b[1] - a[1]};
  const double squared = way[0] * way[0] + way[1] * way[1];
  const double part = std::clamp(((p[0] - a[0]) * way[0] + (p[1] - a[1]) * way[1]) / squared, 0.0, 1.0);
  return std::hypot(a[0] + part * way[0] - p[0], a[1] + part * way[1] - p[1]);
}

TEST_CASE("around holes vertices of quadrilaterals slide on the edges there were, and lines no further from these") {
  constexpr std::int32_t around = 60;
  constexpr std::int32_t rings = 8;
  const MixedMesh mesh = uneven_annulus(around, rings, 4);
  const Numbers xy = mesh.xy();
  for (const double deviation : {1e-3, 1e-2, 0.1}) {
    for (const Method method : {Method::laplacian, Method::mean_ratio}) {
      const Smoothed found = smoothed(mesh, sliding(Slide::curves, deviation), with(method));
      CHECK(found.result.sliding->chains == 2);
      CHECK(found.result.sliding->vertices == 2 * around);
      CHECK(found.result.sliding->slid > around / 2);
      CHECK(found.result.sliding->relative_deviation <= deviation);
      CHECK(worse_element(mesh, found.xy).empty());
      for (const std::int32_t first : {0, (rings - 1) * around}) {
        const auto off = [&](Point p, const auto& corner) {
          double least = std::numeric_limits<double>::infinity();
          for (std::int32_t i = 0; i < around; ++i) {
            least = std::min(least, distance_to_edge(p, corner(first + i), corner(first + (i + 1) % around)));
          }
          return least;
        };
        const auto before = [&](std::int32_t v) { return mesh.points[static_cast<std::size_t>(v)]; };
        const auto after = [&](std::int32_t v) { return found.at(v); };
        for (std::int32_t i = 0; i < around; ++i) {
          const auto length = [&](std::int32_t j) {
            const Point a = before(first + i);
            const Point b = before(first + (j + around) % around);
            return std::hypot(b[0] - a[0], b[1] - a[1]);
          };
          CHECK(off(after(first + i), before) < 1e-14);
          CHECK(off(before(first + i), after) <= deviation * std::min(length(i + 1), length(i - 1)) + 1e-14);
        }
      }
    }
  }
}

TEST_CASE("interfaces between quadrilaterals and triangles slide along themselves, and regions keep their areas") {
  const UnevenSquare square(10, 0.3, 9, 1);
  MixedMesh mesh = square;
  constexpr std::int32_t middle = 5;
  std::vector<std::int32_t> regions;
  for (std::int32_t row = 0; row <= square.cells; ++row) {
    mesh.points[square.at(middle, row)][0] = middle;
  }
  mesh.points[square.at(middle, 0)] = {middle, 0};
  mesh.points[square.at(middle, square.cells)] = {middle, static_cast<double>(square.cells)};
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const std::vector<std::int32_t> corners = mesh.corners(e);
    regions.push_back(
        std::ranges::all_of(corners, [&](std::int32_t v) { return v % (square.cells + 1) <= middle; }) ? 3 : 8);
  }
  const auto area = [&](std::int32_t region, const Numbers& xy) {
    double sum = 0;
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
      const std::vector<std::int32_t> corners = mesh.corners(e);
      for (std::size_t i = 0; i < corners.size() && regions[e] == region; ++i) {
        const auto a = 2 * static_cast<std::size_t>(corners[i]);
        const auto b = 2 * static_cast<std::size_t>(corners[(i + 1) % corners.size()]);
        sum += 0.5 * (xy[a] * xy[b + 1] - xy[a + 1] * xy[b]);
      }
    }
    return sum;
  };
  Constraints constraints = sliding(Slide::straight);
  constraints.regions = regions;
  for (const Method method : {Method::laplacian, Method::mean_ratio}) {
    const Smoothed found = smoothed(mesh, constraints, with(method));
    CHECK(found.result.sliding->chains == 7);  // two sides in two parts, and the interface
    int slid = 0;
    for (std::int32_t row = 0; row <= square.cells; ++row) {
      CHECK(found.at(square.vertex(middle, row))[0] == middle);
      slid += is_at(found, mesh, square.vertex(middle, row)) ? 0 : 1;
    }
    CHECK(slid > 2);
    CHECK(is_at(found, mesh, square.vertex(middle, 0)));
    CHECK(is_at(found, mesh, square.vertex(middle, square.cells)));
    CHECK(area(3, found.xy) == Approx(area(3, mesh.xy())).epsilon(1e-13));
    CHECK(area(8, found.xy) == Approx(area(8, mesh.xy())).epsilon(1e-13));
    CHECK(worse_element(mesh, found.xy).empty());
  }
}

TEST_CASE("vertices of quadrilaterals that are linked slide together, and the sides stay equal") {
  UnevenSquare mesh(12, 0.3, 17, 1);
  std::vector<std::int32_t> links;
  for (std::int32_t row = 0; row <= mesh.cells; ++row) {
    mesh.points[mesh.at(mesh.cells, row)][1] = mesh.points[mesh.at(0, row)][1];
    links.insert(links.end(), {mesh.vertex(0, row), mesh.vertex(mesh.cells, row)});
  }
  Constraints constraints = sliding(Slide::straight);
  constraints.slide.links = links;
  for (const Method method : {Method::laplacian, Method::mean_ratio}) {
    const Smoothed found = smoothed(mesh, constraints, with(method));
    int slid = 0;
    for (std::int32_t row = 0; row <= mesh.cells; ++row) {
      CHECK(same_bits(found.at(mesh.vertex(0, row))[1], found.at(mesh.vertex(mesh.cells, row))[1]));
      slid += is_at(found, mesh, mesh.vertex(0, row)) ? 0 : 1;
    }
    CHECK(slid > 5);
    CHECK(worse_element(mesh, found.xy).empty());
  }
}

/// Who may slide on the lines of a mesh without holes in its lists: with two edges of one element, in one fan, and no
/// corner there; and the edges of one element.
struct Lines {
  std::vector<std::pair<std::int32_t, std::int32_t>> edges;
  std::vector<bool> is_inside;
  std::vector<bool> may_slide;

  Lines(const MixedMesh& mesh, double corner_angle)
      : is_inside(mesh.points.size(), true), may_slide(mesh.points.size(), false) {
    std::map<std::pair<std::int32_t, std::int32_t>, int> sides;
    std::vector<bool> is_used(mesh.points.size(), false);
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
      const std::vector<std::int32_t> corners = mesh.corners(e);
      for (std::size_t i = 0; i < corners.size(); ++i) {
        ++sides[std::minmax({corners[i], corners[(i + 1) % corners.size()]})];
        is_used[static_cast<std::size_t>(corners[i])] = true;
      }
    }
    std::vector<std::vector<std::int32_t>> along(mesh.points.size());
    for (const auto& [edge, count] : sides) {
      if (count == 1) {
        edges.push_back(edge);
        along[static_cast<std::size_t>(edge.first)].push_back(edge.second);
        along[static_cast<std::size_t>(edge.second)].push_back(edge.first);
      }
    }
    for (std::size_t v = 0; v < along.size(); ++v) {
      is_inside[v] = is_used[v] && along[v].empty();
      if (along[v].size() == 2) {
        const auto way_to = [&](std::size_t end) {
          const Point& p = mesh.points[static_cast<std::size_t>(along[v][end])];
          return Point{p[0] - mesh.points[v][0], p[1] - mesh.points[v][1]};
        };
        const Point back = way_to(0);
        const Point on = way_to(1);
        const double turn = std::atan2(on[0] * back[1] - on[1] * back[0], -(on[0] * back[0] + on[1] * back[1])) * 180 /
                            std::numbers::pi;
        may_slide[v] = std::abs(turn) < corner_angle + 1e-9;
      }
    }
  }
};

TEST_CASE("in meshes of both kinds only vertices of lines slide, on these, and nothing gets worse") {
  std::int64_t slid = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    const MixedMesh mesh = mixed_meshes::random_mesh(seed);
    Constraints constraints = sliding(seed % 3 == 0 ? Slide::straight : Slide::curves, seed % 2 == 0 ? 0.02 : 0.2);
    constraints.slide.corner_angle = 60;
    const Lines lines(mesh, 60);
    const SmoothingOptions options = with(methods[seed % 4], seed % 8 < 4 ? Form::in_place : Form::swap);
    INFO("mesh " << seed << ", method " << to_string(options.method) << ", form " << to_string(options.form));
    const Smoothed found = smoothed(mesh, constraints, options);
    CHECK(worse_element(mesh, found.xy).empty());
    std::int64_t slid_here = 0;
    for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
      const auto i = static_cast<std::size_t>(v);
      if (is_at(found, mesh, v) || lines.is_inside[i]) {
        continue;
      }
      CHECK(lines.may_slide[i]);
      ++slid_here;
      double off = std::numeric_limits<double>::infinity();
      for (const auto& [a, b] : lines.edges) {
        off = std::min(off, distance_to_edge(found.at(v), mesh.points[static_cast<std::size_t>(a)],
                                             mesh.points[static_cast<std::size_t>(b)]));
      }
      CHECK(off < 1e-12);
    }
    CHECK(found.result.sliding->slid == slid_here);
    slid += slid_here;
  }
  CHECK(slid > 150);
}

TEST_CASE("vertices of either kind slide to the same bits by threads, plans, evaluating all, and listed otherwise") {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const MixedMesh mesh = mixed_meshes::random_mesh(1000 + seed);
    Constraints constraints = sliding(Slide::curves, 0.1);
    constraints.slide.corner_angle = 60;
    SmoothingOptions options = with(methods[seed % 4], seed % 8 < 4 ? Form::in_place : Form::swap);
    options.precision = seed % 5 == 0 ? Precision::single_precision : Precision::double_precision;
    INFO("mesh " << seed << ", method " << to_string(options.method) << ", form " << to_string(options.form));
    const Numbers expected = smoothed(mesh, constraints, options).xy;
    CHECK(same_bits(smoothed(mesh.in_another_order(seed), constraints, options).xy, expected));
    CHECK(same_bits(smoothed(mesh.listed_from_other_corners(seed, true), constraints, options).xy, expected));
    SmoothingPlan prepared = plan(mesh.vertex_count(), mesh.elements, constraints, options);
    for (int times = 0; times < 2; ++times) {
      Numbers xy = mesh.xy();
      prepared.smooth(xy_points(xy));
      CHECK(same_bits(xy, expected));
    }
    options.threads = 4;
    CHECK(same_bits(smoothed(mesh, constraints, options).xy, expected));
    options.evaluation = Evaluation::all;
    CHECK(same_bits(smoothed(mesh, constraints, options).xy, expected));
  }
}

}  // namespace trismooth::sliding_quadrilaterals_test
