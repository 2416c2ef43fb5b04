// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/matched_points.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "trismooth/base/machine/workers.h"
#include "trismooth/mesh_io/errors.h"

#include "catch.h"
#include "support/scratch_folder.h"

namespace trismooth::matched_points_test {

/// As many points as it takes, each in a place of its own.
MeshDocument of_cells(std::size_t points, std::uint8_t type, const std::vector<std::vector<std::int32_t>>& cells) {
  MeshDocument document;
  document.points.resize(3 * points);
  std::iota(document.points.begin(), document.points.end(), 1.0);
  for (const auto& cell : cells) {
    document.cells.append(type, cell);
  }
  return document;
}

MatchedPoints match(const MeshDocument& mesh, const MeshDocument& other) {
  Workers workers(1);
  return match_points(mesh, "a.vtu", other, "b.vtu", workers);
}

std::string refusal(const MeshDocument& mesh, const MeshDocument& other) {
  return message_of<ReadError>([&] { match(mesh, other); });
}

/// The nodes of an element from corner `first` on, in the other sense of rotation if `turned`.
std::vector<std::int32_t> listed_from(const std::vector<std::int32_t>& nodes, std::size_t corners, std::size_t first,
                                      bool turned) {
  std::vector<std::int32_t> listed;
  for (std::size_t i = 0; i < corners; ++i) {
    listed.push_back(nodes[(first + (turned ? corners - i : i)) % corners]);
  }
  for (std::size_t i = 0; i < corners; ++i) {
    // The middle of the side from corner i on, found by its ends.
    const std::int32_t a = listed[i];
    const std::int32_t b = listed[(i + 1) % corners];
    for (std::size_t side = 0; side < corners; ++side) {
      const std::int32_t c = nodes[side];
      const std::int32_t d = nodes[(side + 1) % corners];
      if ((a == c && b == d) || (a == d && b == c)) {
        listed.push_back(nodes[corners + side]);
      }
    }
  }
  listed.insert(listed.end(), nodes.begin() + 2 * static_cast<std::ptrdiff_t>(corners), nodes.end());
  return listed;
}

TEST_CASE("elements with nodes between corners are the same from any corner on, in either sense") {
  const auto [type, corners, nodes] =
      GENERATE(std::tuple(cell_type::quadratic_triangle, std::size_t{3}, std::vector{7, 3, 5, 0, 1, 2}),
               std::tuple(cell_type::quadratic_quad, std::size_t{4}, std::vector{7, 3, 5, 4, 0, 1, 2, 6}),
               std::tuple(cell_type::biquadratic_quad, std::size_t{4}, std::vector{7, 3, 5, 4, 0, 1, 2, 6, 8}));
  const MeshDocument mesh = of_cells(9, type, {nodes});
  for (std::size_t first = 0; first < corners; ++first) {
    for (const bool turned : {false, true}) {
      CAPTURE(nodes, first, turned);
      const MatchedPoints found = match(mesh, of_cells(9, type, {listed_from(nodes, corners, first, turned)}));
      CHECK(found.points == mesh.points);
      CHECK(found.notes.empty());
    }
  }
}

TEST_CASE("elements of which two middles are exchanged are others") {
  // Beside them an element that tells which point is which.
  const MeshDocument mesh = of_cells(9, cell_type::quadratic_triangle, {{0, 1, 2, 3, 4, 5}, {1, 0, 6, 3, 7, 8}});
  const MeshDocument other = of_cells(9, cell_type::quadratic_triangle, {{0, 1, 2, 4, 3, 5}, {1, 0, 6, 3, 7, 8}});
  CHECK(refusal(mesh, other)
            .starts_with("b.vtu: element 0 has the points 0, 1, 2, 4, 3, 5 (cell 0), and in a.vtu the points 0, 1, 2, "
                         "3, 4, 5 (cell 0), all "
                         "counted from 0; two meshes are compared"));
}

TEST_CASE("the same numbers of points and elements are taken before other rows") {
  // Listed from the other end these triangles would be those of the mesh with its points in the other order.
  const MeshDocument mesh = of_cells(4, cell_type::triangle, {{0, 1, 2}, {3, 2, 1}});
  const MatchedPoints found = match(mesh, of_cells(4, cell_type::triangle, {{3, 2, 1}, {0, 1, 2}}));
  CHECK(found.points == mesh.points);
  CHECK(found.notes ==
        std::vector<std::string>{"b.vtu lists the elements in another order; their numbers here are those of a.vtu"});
}

TEST_CASE("points in other rows get those of the mesh, which keeps its own where no element has them") {
  const MeshDocument mesh = of_cells(5, cell_type::triangle, {{4, 1, 2}, {1, 0, 2}});
  const MeshDocument other = of_cells(4, cell_type::triangle, {{0, 1, 2}, {1, 3, 2}});
  const MatchedPoints found = match(mesh, other);
  CHECK(found.notes.size() == 1);
  for (const auto& [here, there] : {std::array{4, 0}, {1, 1}, {2, 2}, {0, 3}}) {
    CHECK(std::ranges::equal(std::span(found.points).subspan(3 * here, 3),
                             std::span(other.points).subspan(3 * there, 3)));
  }
  CHECK(std::ranges::equal(std::span(found.points).subspan(9, 3), std::span(mesh.points).subspan(9, 3)));
}

TEST_CASE("two points of the mesh are never one of the other, nor the other way round") {
  const MeshDocument apart = of_cells(6, cell_type::triangle, {{0, 1, 2}, {3, 4, 5}});
  const MeshDocument joined = of_cells(5, cell_type::triangle, {{0, 1, 2}, {2, 3, 4}});
  CHECK(refusal(apart, joined).starts_with("b.vtu: holds 5 points and 2 triangles, and a.vtu holds 6 points and 2"));
  CHECK(refusal(joined, apart).starts_with("b.vtu: holds 6 points and 2 triangles, and a.vtu holds 5 points and 2"));
}

TEST_CASE("other cells do not count, and meshes without elements are the same") {
  MeshDocument mesh = of_cells(4, cell_type::line, {{0, 1}, {1, 2}});
  mesh.cells.append(cell_type::triangle, std::array{0, 1, 2});
  const MeshDocument other = of_cells(4, cell_type::triangle, {{0, 1, 2}});
  CHECK(match(mesh, other).points == other.points);
  CHECK(match(of_cells(3, cell_type::line, {}), of_cells(3, cell_type::line, {})).notes.empty());
}

}  // namespace trismooth::matched_points_test
