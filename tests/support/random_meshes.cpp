// SPDX-License-Identifier: BSD-3-Clause
#include "support/random_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "trismooth/base/rounding.h"
#include "trismooth/pipeline/generate/delaunay.h"

namespace random_meshes {

namespace {

using test_meshes::Point;
using test_meshes::Random;
using trismooth::Triangle;

constexpr std::int32_t most_vertices = 300;

using Edge = std::pair<std::int32_t, std::int32_t>;

Edge edge_of(const Triangle& t, std::size_t side) {
  return std::minmax({t[side], t[(side + 1) % 3]});
}

bool runs_along(const Triangle& t, const Edge& edge) {
  return (t[0] == edge.first && t[1] == edge.second) || (t[1] == edge.first && t[2] == edge.second) ||
         (t[2] == edge.first && t[0] == edge.second);
}

/// A triangle that cannot be listed so that all edges with exactly two triangles are run through both ways.
std::optional<std::size_t> triangle_that_contradicts(const std::vector<Triangle>& triangles) {
  std::map<Edge, std::vector<std::size_t>> around;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t side = 0; side < 3; ++side) {
      around[edge_of(triangles[t], side)].push_back(t);
    }
  }
  std::vector<int> turned(triangles.size(), -1);
  for (std::size_t start = 0; start < triangles.size(); ++start) {
    std::vector<std::size_t> reached;
    if (turned[start] < 0) {
      turned[start] = 0;
      reached.push_back(start);
    }
    while (!reached.empty()) {
      const std::size_t t = reached.back();
      reached.pop_back();
      for (std::size_t side = 0; side < 3; ++side) {
        const Edge edge = edge_of(triangles[t], side);
        const auto& sharing = around[edge];
        if (sharing.size() != 2) {
          continue;
        }
        const std::size_t other = sharing[0] == t ? sharing[1] : sharing[0];
        const bool alike = runs_along(triangles[t], edge) != runs_along(triangles[other], edge);
        const int wanted = alike ? turned[t] : 1 - turned[t];
        if (turned[other] < 0) {
          turned[other] = wanted;
          reached.push_back(other);
        } else if (turned[other] != wanted) {
          return other;
        }
      }
    }
  }
  return std::nullopt;
}

/// Makes one mesh, step by step.
class Maker {
 public:
  explicit Maker(std::uint64_t seed) : random_(spread(seed)) { made_.seed = seed; }

  RandomMesh make() {
    base(size_within(most_vertices));
    for (std::int32_t more = one_in(4) ? 1 + random_.below(3) : 0; more > 0; --more) {
      add_component();
    }
    change_topology();
    change_geometry();
    change_lists();
    change_scale();
    constrain();
    return std::move(made_);
  }

 private:
  /// Consecutive seeds would start the generator alike.
  static std::uint64_t spread(std::uint64_t seed) { return (seed + 1) * 0x9e3779b97f4a7c15U; }

  bool one_in(std::int32_t n) { return random_.below(n) == 0; }
  double unit() { return random_.between(0, 1); }
  std::int32_t size_within(std::int32_t limit) { return static_cast<std::int32_t>(limit * std::pow(unit(), 3)); }
  void note(const std::string& what) { made_.kind += (made_.kind.empty() ? "" : ", ") + what; }
  std::int32_t any_vertex() { return random_.below(mesh().vertex_count()); }
  Triangle& any_triangle() {
    return mesh().triangles[static_cast<std::size_t>(random_.below(static_cast<std::int32_t>(triangle_count())))];
  }
  Mesh& mesh() { return made_.mesh; }
  std::size_t triangle_count() { return mesh().triangles.size(); }
  Point random_point() {
    const double x = unit();
    return {x, unit()};
  }

  // ---- bases ----

  void base(std::int32_t size) {
    const auto side = static_cast<std::int32_t>(std::sqrt(size));
    const auto seed = static_cast<std::uint64_t>(random_.below(1 << 30));
    switch (random_.below(12)) {
      case 0:
      case 1:
      case 2:
        return delaunay(3 + size);
      case 3:
      case 4: {
        constexpr std::array jitters{0.0, 0.2, 0.45, 1.3, 4.0};
        note("grid");
        mesh() = test_meshes::jittered_grid(2 + random_.below(side + 2), 2 + random_.below(side + 2),
                                            jitters[static_cast<std::size_t>(random_.below(5))], seed);
        return;
      }
      case 5:
        note("star");
        mesh() = test_meshes::star(3 + size, seed);
        return;
      case 6:
        note("fan");
        mesh() = test_meshes::star(3 + size, seed);
        mesh().triangles.pop_back();
        return;
      case 7:
        note("annulus");
        mesh() = test_meshes::annulus(3 + side, 1 + size / (3 + side), random_.between(0.2, 0.9));
        return;
      case 8:
        return subdivided(4 + size);
      case 9:
        return closed(side);
      case 10:
        note("soup");
        mesh().triangles = test_meshes::random_soup(3 + size / 4, 1 + random_.below(1 + size / 2), random_);
        return scatter(3 + size / 4);
      default:
        return tiny();
    }
  }

  void scatter(std::int32_t count) {
    mesh().points.resize(static_cast<std::size_t>(count));
    std::ranges::generate(mesh().points, [&] { return random_point(); });
  }

  void delaunay(std::int32_t count) {
    const int bits = 6 + random_.below(24);
    note(fmt::format("delaunay on {} bits", bits));
    std::set<trismooth::GridPoint> distinct;
    while (static_cast<std::int32_t>(distinct.size()) < count) {
      const std::int32_t x = random_.below(1 << bits);
      distinct.insert({x, random_.below(1 << bits)});
    }
    std::vector<trismooth::GridPoint> grid(distinct.begin(), distinct.end());
    random_.shuffle(grid);
    for (const auto& [x, y] : grid) {
      mesh().points.push_back({std::ldexp(x, -bits), std::ldexp(y, -bits)});
    }
    mesh().triangles = trismooth::delaunay(grid);
  }

  /// A triangle into which points are put one by one: many vertices of three neighbours, and needles.
  void subdivided(std::int32_t count) {
    note("subdivided");
    mesh().points = {{0, 0}, {1, 0}, {0.5, 1}};
    mesh().triangles = {{0, 1, 2}};
    while (mesh().vertex_count() < count) {
      const std::int32_t v = mesh().vertex_count();
      Triangle& t = any_triangle();
      const auto [a, b, c] = t;
      const double u = random_.between(0.05, 0.6);
      const double w = random_.between(0.05, 0.35);
      const auto& p = mesh().points;
      mesh().points.push_back({p[a].x + u * (p[b].x - p[a].x) + w * (p[c].x - p[a].x),
                               p[a].y + u * (p[b].y - p[a].y) + w * (p[c].y - p[a].y)});
      t = {a, b, v};
      mesh().triangles.insert(mesh().triangles.end(), {{b, c, v}, {c, a, v}});
    }
  }

  /// A surface without any boundary, laid flat: every vertex is free.
  void closed(std::int32_t side) {
    switch (random_.below(4)) {
      case 0:
        note("two triangles back to back");
        mesh().triangles = {{0, 1, 2}, {0, 2, 1}};
        return scatter(3);
      case 1:
        note("tetrahedron");
        mesh().triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {3, 2, 1}};
        return scatter(4);
      case 2: {
        const std::int32_t size = 3 + random_.below(4 + side);
        note(fmt::format("bipyramid of {}", size));
        for (std::int32_t i = 0; i < size; ++i) {
          const std::int32_t next = (i + 1) % size;
          mesh().triangles.insert(mesh().triangles.end(), {{i, next, size}, {next, i, size + 1}});
        }
        return scatter(size + 2);
      }
      default: {
        const std::int32_t columns = 3 + random_.below(1 + side);
        const std::int32_t rows = 3 + random_.below(1 + side);
        note("torus");
        for (std::int32_t j = 0; j < rows; ++j) {
          for (std::int32_t i = 0; i < columns; ++i) {
            const auto at = [&](std::int32_t column, std::int32_t row) {
              return row % rows * columns + column % columns;
            };
            mesh().triangles.insert(mesh().triangles.end(), {{at(i, j), at(i + 1, j), at(i + 1, j + 1)},
                                                             {at(i, j), at(i + 1, j + 1), at(i, j + 1)}});
          }
        }
        return scatter(columns * rows);
      }
    }
  }

  void tiny() {
    note("tiny");
    switch (random_.below(6)) {
      case 0:
        return;
      case 1:
        return scatter(1 + random_.below(4));
      case 2:
        mesh().triangles = {{0, 1, 2}};
        return scatter(3);
      case 3:
        mesh() = test_meshes::bow_tie();
        return;
      case 4:
        mesh() = test_meshes::three_on_an_edge();
        return;
      default:
        mesh() = test_meshes::star(3 + random_.below(4));
    }
  }

  void add_component() {
    note("and");
    RandomMesh so_far = std::exchange(made_, {made_.seed, made_.kind + ":", {}, {}, {}, {}, {}});
    const std::int32_t room = std::max(most_vertices - so_far.mesh.vertex_count(), 0);
    base(size_within(room));
    const Point offset = one_in(2) ? Point{0, 0} : Point{random_.between(-2, 2), random_.between(-2, 2)};
    mesh() = test_meshes::together(std::move(so_far.mesh), mesh(), offset);
  }

  // ---- connectivity ----

  void change_topology() {
    if (triangle_count() == 0) {
      return;
    }
    repeat_at_times(5, "holes", [&] {
      std::swap(any_triangle(), mesh().triangles.back());
      mesh().triangles.pop_back();
    });
    repeat_at_times(5, "cracks", [&] { split_vertex(); });
    repeat_at_times(10, "welds", [&] { weld(any_vertex(), any_vertex()); });
    repeat_at_times(10, "third triangles on an edge", [&] {
      const Triangle t = any_triangle();
      const std::int32_t tip = one_in(2) ? any_vertex() : mesh().vertex_count();
      if (tip == mesh().vertex_count()) {
        mesh().points.push_back(random_point());
      }
      if (tip != t[0] && tip != t[1]) {
        mesh().triangles.push_back({t[1], t[0], tip});
      }
    });
    repeat_at_times(14, "triangles listed twice", [&] {
      Triangle t = any_triangle();
      random_.shuffle(t);
      mesh().triangles.push_back(t);
    });
    repeat_at_times(7, "isolated vertices", [&] { mesh().points.push_back(random_point()); });
    while (const auto culprit = triangle_that_contradicts(mesh().triangles)) {
      mesh().triangles.erase(mesh().triangles.begin() + static_cast<std::ptrdiff_t>(*culprit));
    }
  }

  template <class Action>
  void repeat_at_times(std::int32_t seldom, const std::string& what, const Action& action) {
    if (!one_in(seldom)) {
      return;
    }
    note(what);
    for (std::int32_t times = 1 + random_.below(1 + mesh().vertex_count() / 6); times > 0; --times) {
      if (triangle_count() > 0) {
        action();
      }
    }
  }

  /// Gives some of a vertex's triangles a copy of it, at the same place: cracks where they hang together, bow ties.
  void split_vertex() {
    const std::int32_t old = any_vertex();
    const std::int32_t copy = mesh().vertex_count();
    mesh().points.push_back(mesh().points[old]);
    const double x = mesh().points[old].x;
    for (Triangle& t : mesh().triangles) {
      // Mostly those on one side of it.
      const double side = mesh().points[t[0]].x + mesh().points[t[1]].x + mesh().points[t[2]].x - 3 * x;
      if (one_in(8) || side > 0) {
        std::ranges::replace(t, old, copy);
      }
    }
  }

  void weld(std::int32_t from, std::int32_t to) {
    for (Triangle& t : mesh().triangles) {
      std::ranges::replace(t, from, to);
    }
    std::erase_if(mesh().triangles, [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  }

  // ---- geometry ----

  void change_geometry() {
    if (mesh().points.empty()) {
      return;
    }
    repeat_at_times(6, "tangled", [&] { mesh().points[any_vertex()] = random_point(); });
    repeat_at_times(8, "vertices halfway", [&] {
      const Triangle& t = any_triangle();
      const Point a = mesh().points[t[0]];
      const Point b = mesh().points[t[1]];
      mesh().points[t[2]] = {(a.x + b.x) / 2, (a.y + b.y) / 2};
    });
    repeat_at_times(8, "repeated positions", [&] {
      const Triangle& t = any_triangle();
      mesh().points[t[0]] = mesh().points[t[1]];
    });
    if (one_in(5)) {
      const std::int32_t cells = 1 + random_.below(8);
      note(fmt::format("on a lattice of {}", cells));
      for_points([&](Point p) { return Point{std::round(p.x * cells), std::round(p.y * cells)}; });
    }
    if (one_in(30)) {
      const Point direction = one_in(2) ? Point{unit(), unit()} : Point{1, 0};
      note("collinear");
      for_points([&](Point p) { return Point{p.x * direction.x, p.x * direction.y}; });
    }
    if (one_in(60)) {
      note("one point");
      const Point place = random_point();
      for_points([&](Point) { return place; });
    }
    if (one_in(10)) {
      const int power = -random_.below(one_in(4) ? 100 : 30);
      note(fmt::format("aspect 2^{}", power));
      for_points([&](Point p) { return Point{p.x, std::ldexp(p.y, power)}; });
    }
    if (one_in(10)) {
      const double grading = random_.between(1, one_in(4) ? 300 : 30);
      note(fmt::format("grading 2^-{}", grading));
      for_points([&](Point p) {
        const double factor = std::exp2(-std::min(grading * std::abs(p.x), 300.0));
        return Point{p.x * factor, p.y * factor};
      });
    }
  }

  template <class Function>
  void for_points(const Function& function) {
    std::ranges::transform(mesh().points, mesh().points.begin(), function);
  }

  // ---- the order of the lists ----

  void change_lists() {
    if (one_in(2)) {
      note("shuffled");
      mesh() = test_meshes::shuffled(mesh(), static_cast<std::uint64_t>(random_.below(1 << 30)));
    }
    if (one_in(4)) {
      note("mixed orientation");
      const std::int32_t seldom = 1 + random_.below(4);
      for (Triangle& t : mesh().triangles) {
        if (one_in(seldom)) {
          std::swap(t[1], t[2]);
        }
      }
    }
  }

  // ---- the size and place of it all ----

  void change_scale() {
    if (one_in(6)) {
      constexpr std::array offsets{1.0, 3.0, 1e3, 4e7, 1e12, 0x1p52};
      const double offset = offsets[static_cast<std::size_t>(random_.below(6))];
      note(fmt::format("offset {}", offset));
      const bool along_x = !one_in(3);
      const double y = along_x && one_in(2) ? 0 : -offset;
      for_points([&](Point p) { return Point{p.x + (along_x ? offset : 0), p.y + y}; });
    }
    if (one_in(8)) {
      note("float32");
      for_points([](Point p) { return Point{trismooth::rounded_to_float32(p.x), trismooth::rounded_to_float32(p.y)}; });
    }
    if (one_in(6)) {
      // The last ones: subnormal numbers of few digits, and nearly the largest.
      constexpr std::array scales{1e-3, 1e9, 1e-9, 1e200, 1e-200, 0x1p300, 0x1p-300, 0x1p-1060, 0x1p-1022, 0x1p1018};
      const double scale = scales[static_cast<std::size_t>(random_.below(static_cast<std::int32_t>(scales.size())))];
      note(fmt::format("scale {}", scale));
      for_points([&](Point p) { return Point{p.x * scale, p.y * scale}; });
    }
    if (one_in(10)) {
      note("negative zeros");
      for_points([&](Point p) { return Point{p.x == 0 ? -0.0 : p.x, p.y == 0 && one_in(2) ? -0.0 : p.y}; });
    }
    const double largest = std::numeric_limits<double>::max();
    for_points([&](Point p) { return Point{std::clamp(p.x, -largest, largest), std::clamp(p.y, -largest, largest)}; });
    if (one_in(40)) {
      note("as large as numbers are");
      double extreme = std::numeric_limits<double>::min();
      for (const Point p : mesh().points) {
        extreme = std::max({extreme, std::abs(p.x), std::abs(p.y)});
      }
      for_points([&](Point p) { return Point{p.x / extreme * largest, p.y / extreme * largest}; });
    }
  }

  // ---- constraints ----

  void constrain() {
    const auto flags = [&](std::int32_t seldom) {
      std::vector<std::uint8_t> chosen(mesh().points.size());
      std::ranges::generate(chosen, [&] { return one_in(seldom) ? std::uint8_t{1} : std::uint8_t{0}; });
      return chosen;
    };
    if (one_in(6)) {
      note("fixed flags");
      made_.fixed = flags(2 + random_.below(20));
    }
    if (one_in(6)) {
      note("other cells");
      made_.other_cells = flags(2 + random_.below(20));
    }
    if (one_in(6) && !mesh().points.empty()) {
      note("fixed numbers");
      for (std::int32_t i = 1 + random_.below(5); i > 0; --i) {
        made_.fixed_ids.push_back(any_vertex());
      }
    }
    if (one_in(5)) {
      const double border = random_.between(-0.5, 1.5);
      const bool scattered = one_in(4);
      note("regions");
      for (const Triangle& t : mesh().triangles) {
        const bool beyond = mesh().points[t[0]].x > border;
        made_.regions.push_back(scattered ? random_.below(3) - 1 : (beyond ? 7 : 2));
      }
    }
  }

  Random random_;
  RandomMesh made_;
};

}  // namespace

RandomMesh random_mesh(std::uint64_t seed) {
  return Maker(seed).make();
}

bool is_orientable(const std::vector<Triangle>& triangles) {
  return !triangle_that_contradicts(triangles);
}

}  // namespace random_meshes
