// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/picture/mesh_lines.h"

#include <algorithm>
#include <map>
#include <random>
#include <vector>

#include "trismooth/base/hold.h"

#include "catch.h"

namespace trismooth::mesh_lines_test {

using Edges = std::vector<EdgeEnds>;

MeshPicture picture_of(std::size_t vertices, OwnElements elements) {
  MeshPicture picture;
  picture.before.assign(vertices, {});
  picture.elements = std::move(elements);
  return picture;
}

TEST_CASE("an edge of one element is of the boundary, one of two regions an interface") {
  //  3 - 2 - 5
  //  | \ |   |
  //  0 - 1 - 4
  MeshPicture picture = picture_of(6, std::vector<MixedElement>{{0, 1, 3, -1}, {1, 2, 3, -1}, {1, 4, 5, 2}});
  CHECK(mesh_lines(picture).boundary == Edges{{0, 1}, {0, 3}, {1, 4}, {2, 3}, {2, 5}, {4, 5}});
  CHECK(mesh_lines(picture).interfaces.empty());
  picture.regions = {0, 0, 1};
  CHECK(mesh_lines(picture).boundary.size() == 6);
  CHECK(mesh_lines(picture).interfaces == Edges{{1, 2}});
  picture.held = {1, 1, 0, 1, 1, 1};  // what is free is on no line
  CHECK(mesh_lines(picture).boundary == Edges{{0, 1}, {0, 3}, {1, 4}, {4, 5}});
  CHECK(mesh_lines(picture).interfaces.empty());
}

TEST_CASE("an edge of three elements is an interface, a side without length is no edge") {
  const MeshPicture picture = picture_of(5, std::vector<Triangle>{{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {0, 0, 2}});
  const MeshLines lines = mesh_lines(picture);
  CHECK(lines.interfaces == Edges{{0, 1}, {0, 2}});
  CHECK(lines.boundary == Edges{{0, 3}, {0, 4}, {1, 2}, {1, 3}, {1, 4}});
}

TEST_CASE("a picture without elements has no lines") {
  const MeshLines lines = mesh_lines({});
  CHECK(lines.boundary.empty());
  CHECK(lines.interfaces.empty());
}

TEST_CASE("lines of any elements are those that counting in a map finds") {
  std::mt19937 random(7);
  for (int run = 0; run < 50; ++run) {
    const std::int32_t vertices = 4 + run;
    std::vector<Triangle> triangles(static_cast<std::size_t>(3 * run));
    std::vector<std::int32_t> regions;
    std::map<EdgeEnds, std::vector<std::int32_t>> regions_of;
    for (Triangle& triangle : triangles) {
      for (std::int32_t& corner : triangle) {
        corner = static_cast<std::int32_t>(random() % static_cast<unsigned>(vertices));
      }
      regions.push_back(static_cast<std::int32_t>(random() % 3));
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [low, high] = std::minmax(triangle[i], triangle[(i + 1) % 3]);
        if (low != high) {
          regions_of[{low, high}].push_back(regions.back());
        }
      }
    }
    Edges boundary;
    Edges interfaces;
    for (const auto& [edge, around] : regions_of) {
      if (around.size() == 1) {
        boundary.push_back(edge);
      } else if (around.size() > 2 || around[0] != around[1]) {
        interfaces.push_back(edge);
      }
    }
    MeshPicture picture = picture_of(static_cast<std::size_t>(vertices), triangles);
    picture.regions = regions;
    CHECK(mesh_lines(picture).boundary == boundary);
    CHECK(mesh_lines(picture).interfaces == interfaces);
  }
}

}  // namespace trismooth::mesh_lines_test
