// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/coarse_boundary.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "trismooth/base/hold.h"

#include "catch.h"
#include "support/says.h"
#include "support/test_meshes.h"

namespace trismooth::coarse_boundary_test {

using test_meshes::Mesh;

/// Why vertices are held: those of edges with one triangle.
std::vector<std::uint8_t> held_of(const Mesh& mesh) {
  std::map<std::pair<std::int32_t, std::int32_t>, int> triangles_at;
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      ++triangles_at[std::minmax(t[i], t[(i + 1) % 3])];
    }
  }
  std::vector<std::uint8_t> held(mesh.points.size(), 0);
  for (const auto& [edge, count] : triangles_at) {
    if (count == 1) {
      held[edge.first] = held[edge.second] = hold::boundary;
    }
  }
  return held;
}

CoarseBoundary find(const Mesh& mesh, const std::vector<std::uint8_t>& held) {
  return trismooth::find_coarse_boundary({mesh.points, mesh.triangles, {}, 0}, held);
}
CoarseBoundary find(const Mesh& mesh) {
  return find(mesh, held_of(mesh));
}

/// columns x rows unit cells, of which the upper row has vertices on the boundary only every `step` units.
Mesh coarse_above(std::int32_t columns, std::int32_t rows, std::int32_t step) {
  Mesh mesh = test_meshes::jittered_grid(columns + 1, rows, 0, 1);
  for (auto& point : mesh.points) {
    point = {point.x * columns, point.y * (rows - 1)};
  }
  const std::int32_t row = (columns + 1) * (rows - 1);
  const std::int32_t upper = row + columns + 1;
  for (std::int32_t left = 0; left <= columns; left += step) {
    mesh.points.push_back({static_cast<double>(left), static_cast<double>(rows)});
  }
  for (std::int32_t edge = 0; edge < columns / step; ++edge) {
    const std::int32_t a = upper + edge;
    const std::int32_t b = a + 1;
    const std::int32_t middle = row + edge * step + step / 2;
    for (std::int32_t below = row + edge * step; below < row + (edge + 1) * step; ++below) {
      mesh.triangles.push_back({below, below + 1, below < middle ? a : b});
    }
    mesh.triangles.push_back({middle, b, a});
  }
  return mesh;
}

/// Both meshes, side by side.
Mesh together(Mesh mesh, const Mesh& other) {
  const std::int32_t offset = mesh.vertex_count();
  for (const auto& p : other.points) {
    mesh.points.push_back({p.x + 1000, p.y});
  }
  for (const auto& [a, b, c] : other.triangles) {
    mesh.triangles.push_back({a + offset, b + offset, c + offset});
  }
  return mesh;
}

TEST_CASE("a side with edges many times longer than those behind them is found") {
  const Mesh mesh = coarse_above(40, 40, 8);
  const CoarseBoundary found = find(mesh);
  CHECK(found.any());
  CHECK(found.boundary_edges == 40 + 39 + 39 + 2 + 5);
  CHECK(found.coarse_edges == 5);
  CHECK(found.largest_ratio >= 8 / 1.5);
  CHECK(found.largest_ratio <= 8);
  const std::string text = describe(found);
  CAPTURE(text);
  CHECK(says(text, "boundary edges more than 4 times as long as those behind them: 5 of 125 (up to "));

  Mesh scaled = mesh;
  for (auto& point : scaled.points) {
    point = {std::ldexp(point.x, -40), std::ldexp(point.y, -40)};
  }
  CHECK(find(scaled).largest_ratio == found.largest_ratio);
}

TEST_CASE("a boundary as fine as the inside, or a few times coarser, is no reason for alarm") {
  CHECK_FALSE(find(test_meshes::jittered_grid(20, 20, 0.3, 1)).any());
  CHECK_FALSE(find(test_meshes::annulus(30, 5, 0.3)).any());
  CHECK_FALSE(find(coarse_above(40, 40, 2)).any());
  CHECK_FALSE(find(coarse_above(40, 40, 4)).any());
}

TEST_CASE("flat elements along a boundary, and elements that grow towards it, are no reason for alarm") {
  Mesh flat = test_meshes::jittered_grid(30, 30, 0.2, 2);
  Mesh graded = flat;
  for (auto& point : flat.points) {
    point.y /= 1000;
  }
  CHECK_FALSE(find(flat).any());
  // From one row to the next, 1.3 times as large, in both directions: a corner cell is 2000 times the first.
  for (auto& point : graded.points) {
    point = {std::pow(1.3, 29 * point.x), std::pow(1.3, 29 * point.y)};
  }
  CHECK_FALSE(find(graded).any());
}

TEST_CASE("every boundary curve is judged by itself, by a good part of its length") {
  const Mesh fine = test_meshes::jittered_grid(60, 60, 0.2, 3);
  const CoarseBoundary found = find(together(fine, coarse_above(16, 16, 8)));
  CHECK(found.coarse_edges == 2);
  CHECK(found.boundary_edges == 4 * 59 + 16 + 2 * 15 + 2 + 2);
  // The same side of a longer curve.
  CHECK(find(coarse_above(16, 20, 8)).any());
  CHECK_FALSE(find(coarse_above(16, 40, 8)).any());
}

TEST_CASE("edges whose vertices behind are held are no reason for alarm: nothing moves there") {
  const Mesh mesh = coarse_above(40, 40, 8);
  auto held = held_of(mesh);
  for (std::size_t v = 0; v < held.size(); ++v) {
    if (mesh.points[v].y == 39 && held[v] == 0) {
      held[v] = hold::named;
    }
  }
  CHECK_FALSE(find(mesh, held).any());
  CHECK(find(mesh, held).boundary_edges == 125);
}

TEST_CASE("triangles that are listed the other way round do not matter") {
  Mesh mesh = coarse_above(40, 40, 8);
  const CoarseBoundary found = find(mesh);
  std::vector<std::uint8_t> reversed(mesh.triangles.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    reversed[t] = 1;
  }
  const CoarseBoundary again =
      trismooth::find_coarse_boundary({mesh.points, mesh.triangles, reversed, 0}, held_of(mesh));
  CHECK(again.coarse_edges == found.coarse_edges);
  CHECK(again.largest_ratio == found.largest_ratio);
}

TEST_CASE("a mesh without triangles or without free vertices has no coarse boundary") {
  CHECK_FALSE(find(Mesh{}).any());
  CHECK_FALSE(find(test_meshes::jittered_grid(2, 2, 0, 1)).any());
}

}  // namespace trismooth::coarse_boundary_test
