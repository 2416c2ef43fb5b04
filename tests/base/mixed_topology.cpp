// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/base/errors.h"
#include "trismooth/base/hold.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/triangle_topology.h"

#include "catch.h"

namespace trismooth::mixed_topology_test {

using Elements = std::vector<MixedElement>;
using Edge = std::pair<std::int32_t, std::int32_t>;
using Corners = std::vector<std::int32_t>;

Corners corners_of(const MixedElement& element) {
  Corners corners(element.begin(), element.end());
  if (corners.back() == no_corner) {
    corners.pop_back();
  }
  return corners;
}

/// A side of an element, as it is listed.
struct Side {
  std::size_t element;
  std::int32_t halfedge;
  std::int32_t from;
};

/// What the elements on an edge are to each other, by a map of edges.
class Oracle {
 public:
  explicit Oracle(const Elements& elements) : elements_(elements) {
    for (std::size_t e = 0; e < elements.size(); ++e) {
      const Corners corners = corners_of(elements[e]);
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::int32_t next = corners[(i + 1) % corners.size()];
        sides_[std::minmax(corners[i], next)].push_back({e, static_cast<std::int32_t>(4 * e + i), corners[i]});
      }
    }
  }

  /// The side on the other side, where there is exactly one that is of no copy of the element.
  static const Side* partner(const std::vector<Side>& on_edge, std::size_t element, const Elements& elements) {
    if (on_edge.size() != 2) {
      return nullptr;
    }
    const auto sorted = [&](std::size_t e) {
      Corners corners = corners_of(elements[e]);
      std::ranges::sort(corners);
      return corners;
    };
    if (sorted(on_edge[0].element) == sorted(on_edge[1].element)) {
      return nullptr;
    }
    return on_edge[0].element == element ? &on_edge[1] : &on_edge[0];
  }

  std::map<std::int32_t, std::int32_t> twins() const {
    std::map<std::int32_t, std::int32_t> found;
    for (const auto& [edge, on_edge] : sides_) {
      for (const Side& side : on_edge) {
        const Side* const other = partner(on_edge, side.element, elements_);
        found[side.halfedge] = other != nullptr      ? other->halfedge
                               : on_edge.size() == 1 ? MatchedSides::no_twin
                                                     : MatchedSides::many_twins;
      }
    }
    return found;
  }

  /// The component of each element and whether it is listed against the lowest one there; nothing where a component is
  /// one-sided.
  std::optional<std::vector<std::pair<std::size_t, int>>> components() const {
    std::vector<std::pair<std::size_t, int>> found(elements_.size(), {elements_.size(), 0});
    std::size_t count = 0;
    for (std::size_t start = 0; start < elements_.size(); ++start) {
      if (found[start].first != elements_.size()) {
        continue;
      }
      found[start] = {count, 0};
      for (std::deque<std::size_t> queue{start}; !queue.empty(); queue.pop_front()) {
        for (const auto& [edge, on_edge] : sides_) {
          for (const Side& side : on_edge) {
            const Side* const other =
                side.element == queue.front() ? partner(on_edge, side.element, elements_) : nullptr;
            if (other == nullptr) {
              continue;
            }
            const int parity = found[side.element].second ^ (side.from == other->from ? 1 : 0);
            if (found[other->element].first == elements_.size()) {
              found[other->element] = {count, parity};
              queue.push_back(other->element);
            } else if (found[other->element].second != parity) {
              return std::nullopt;
            }
          }
        }
      }
      ++count;
    }
    return found;
  }

  /// Why the vertex is held, and how many elements it has.
  std::pair<unsigned, int> vertex(std::int32_t v) const {
    std::set<std::size_t> around;
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      if (std::ranges::count(corners_of(elements_[e]), v) > 0) {
        around.insert(e);
      }
    }
    unsigned bits = around.empty() ? hold::isolated : 0U;
    std::map<std::size_t, std::set<std::size_t>> neighbours;
    for (const auto& [edge, on_edge] : sides_) {
      if (edge.first != v && edge.second != v) {
        continue;
      }
      const Side* const other = partner(on_edge, on_edge[0].element, elements_);
      if (other != nullptr) {
        neighbours[on_edge[0].element].insert(other->element);
        neighbours[other->element].insert(on_edge[0].element);
      } else {
        bits |= on_edge.size() == 1 ? hold::boundary : hold::non_manifold;
      }
    }
    const int degree = static_cast<int>(around.size());
    int fans = 0;
    for (; !around.empty(); ++fans) {
      for (std::deque<std::size_t> queue{*around.begin()}; !queue.empty(); queue.pop_front()) {
        around.erase(queue.front());
        for (const std::size_t next : neighbours[queue.front()]) {
          if (around.erase(next) > 0) {
            queue.push_back(next);
          }
        }
      }
    }
    return {bits | (fans > 1 ? hold::bow_tie : 0U), degree};
  }

 private:
  const Elements& elements_;
  std::map<Edge, std::vector<Side>> sides_;
};

/// Quadrilaterals of a grid, some of them cut into triangles, some left out, some listed the other way round, with
/// other first corners, and some again.
Elements random_elements(std::mt19937_64& random, std::int32_t columns, std::int32_t rows) {
  const auto one_in = [&](std::uint64_t count) { return random() % count == 0; };
  Elements elements;
  const bool flips = one_in(2);
  const auto add = [&](Corners corners) {
    std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(random() % corners.size()),
                corners.end());
    if (flips && one_in(3)) {
      std::ranges::reverse(corners);
    }
    corners.resize(4, no_corner);
    elements.push_back({corners[0], corners[1], corners[2], corners[3]});
  };
  for (std::int32_t row = 0; row < rows; ++row) {
    for (std::int32_t column = 0; column < columns; ++column) {
      const std::int32_t a = row * (columns + 1) + column;
      const std::int32_t c = a + columns + 2;
      if (one_in(8)) {
        continue;
      }
      if (one_in(3)) {
        add({a, a + 1, c});
        add({a, c, c - 1});
      } else {
        add({a, a + 1, c, c - 1});
      }
      if (one_in(40)) {
        elements.push_back(elements.back());
      }
      if (one_in(40)) {
        add({a, a + 1, (columns + 1) * (rows + 1)});  // maybe a third element of the edge
      }
    }
  }
  std::ranges::shuffle(elements, random);
  return elements;
}

TEST_CASE("sides, fans and components of triangles and quadrilaterals are those of a map of edges") {
  std::mt19937_64 random(5);
  int with_copies = 0;
  for (int round = 0; round < 300; ++round) {
    const auto columns = static_cast<std::int32_t>(1 + random() % 6);
    const auto rows = static_cast<std::int32_t>(1 + random() % 6);
    const std::int32_t vertices = (columns + 1) * (rows + 1) + 1;
    const Elements elements = random_elements(random, columns, rows);
    const Oracle oracle(elements);
    Workers workers(1 + round % 3);
    const auto components = oracle.components();
    REQUIRE(components);
    const TriangleTopology topology = connect_triangles(vertices, elements, workers);
    REQUIRE(topology.twins.size() == 4 * elements.size());
    for (const auto& [halfedge, twin] : oracle.twins()) {
      REQUIRE(topology.twins[halfedge] == twin);
      with_copies += twin == MatchedSides::many_twins ? 1 : 0;
    }
    for (std::size_t e = 0; e < elements.size(); ++e) {
      REQUIRE(topology.component[e] == static_cast<std::int32_t>((*components)[e].first));
      REQUIRE(topology.parity[e] == (*components)[e].second);
    }
    for (std::int32_t v = 0; v < vertices; ++v) {
      const auto [bits, degree] = oracle.vertex(v);
      REQUIRE(topology.hold[v] == bits);
      REQUIRE(topology.degree[v] == degree);
    }
  }
  CHECK(with_copies > 100);
}

TEST_CASE("triangles in places for four corners hang together as triangles do") {
  std::mt19937_64 random(7);
  std::vector<Triangle> triangles;
  Elements elements;
  for (const MixedElement& element : random_elements(random, 30, 20)) {
    if (corner_count(element) == 3) {
      triangles.push_back({element[0], element[1], element[2]});
      elements.push_back(element);
    }
  }
  REQUIRE(triangles.size() > 300);
  Workers workers(2);
  const TriangleTopology as_triangles = connect_triangles(31 * 21 + 1, triangles, workers);
  const TriangleTopology as_elements = connect_triangles(31 * 21 + 1, elements, workers);
  CHECK(as_elements.hold == as_triangles.hold);
  CHECK(std::ranges::equal(as_elements.degree, as_triangles.degree));
  CHECK(as_elements.parity == as_triangles.parity);
  CHECK(std::ranges::equal(as_elements.component, as_triangles.component));
  for (std::size_t h = 0; h < as_triangles.twins.size(); ++h) {
    const std::int32_t twin = as_triangles.twins[h];
    const std::int32_t expected = twin < 0 ? twin : 4 * (twin / 3) + twin % 3;
    REQUIRE(as_elements.twins[4 * (h / 3) + h % 3] == expected);
  }
}

TEST_CASE("elements that are none are refused, each by its number") {
  Workers workers(1);
  const auto message = [&](const Elements& elements) {
    std::string text = "none";
    try {
      (void)connect_triangles(6, elements, workers);
    } catch (const MeshError& error) {
      text = error.what();
    }
    return text;
  };
  CHECK(message({{0, 1, 2, no_corner}, {0, 2, 3, 4}}) == "none");
  CHECK(message({{0, 1, 2, 3}, {0, 1, 2, 6}}) == "element 1 names vertex 6; vertices are numbered from 0 to 5");
  CHECK(message({{0, 1, no_corner, 3}}) ==
        "element 0 names vertex -1, which is no vertex: only the last of four numbers is -1, of a triangle");
  CHECK(message({{0, 1, 2, -2}}) == "element 0 names vertex -2; vertices are numbered from 0 to 5");
  CHECK(message({{0, 1, 2, 3}, {3, 4, 5, 3}}) == "element 1 repeats a vertex");
  CHECK(message({{0, 1, 0, 3}}) == "element 0 repeats a vertex");
  CHECK(message({{0, 1, 2, 1}}) == "element 0 repeats a vertex");
  // A band of three quadrilaterals whose ends are joined the wrong way round.
  CHECK(message({{0, 1, 3, 2}, {2, 3, 5, 4}, {4, 5, 0, 1}}) ==
        "the elements connected with element 1 cannot be oriented consistently (a one-sided surface, or a "
        "quadrilateral whose corners are not listed in turn)");
}

TEST_CASE("the corners of a quadrilateral in canonical order begin with the smallest and turn to the left") {
  Corners corners{4, 9, 2, 7};
  for (int turn = 0; turn < 4; ++turn) {
    const MixedElement listed{corners[0], corners[1], corners[2], corners[3]};
    CHECK(canonical_corners(listed, false) == MixedElement{2, 7, 4, 9});
    CHECK(canonical_corners(listed, true) == MixedElement{2, 9, 4, 7});
    std::rotate(corners.begin(), corners.begin() + 1, corners.end());
  }
  CHECK(canonical_corners(MixedElement{5, 3, 8, no_corner}, false) == MixedElement{3, 8, 5, no_corner});
  CHECK(canonical_corners(MixedElement{5, 3, 8, no_corner}, true) == MixedElement{3, 5, 8, no_corner});
}

}  // namespace trismooth::mixed_topology_test
