// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "trismooth/base/machine/workers.h"
#include "trismooth/smoothing/guard/never_worse.h"
#include "trismooth/smoothing/smooth.h"

#include "cases.h"
#include "support/hostile_meshes.h"

namespace {

using test_meshes::Mesh;

void smooth_once(const trismooth::IndexView& elements, std::vector<double> xy, const trismooth::Sliding& slide) {
  trismooth::SmoothingOptions options;
  options.threads = 1;
  options.max_sweeps = 2;
  // A region a triangle for some of them: there are borders everywhere.
  std::vector<std::int32_t> regions(elements.size(), 0);
  regions.back() = 1;
  trismooth::smooth(trismooth::xy_points(xy), elements, {.regions = regions, .slide = slide}, options);
}

GrowthCase flat(std::string name, int size, Mesh (*make)(int), const trismooth::Sliding& slide = {}) {
  return {"flat arrays: " + std::move(name), size, [make, slide](int count, const ScratchFolder&) {
            const Mesh mesh = make(count);
            return [xy = mesh.xy(), triangles = mesh.triangles, slide] { smooth_once(triangles, xy, slide); };
          }};
}

/// A mesh of triangles whose every triangle is three quadrilaterals.
GrowthCase quadrilaterals(const std::string& name, int size, Mesh (*make)(int)) {
  return {"flat arrays of quadrilaterals: " + name, size, [make](int count, const ScratchFolder&) {
            const mixed_meshes::MixedMesh mesh = hostile_meshes::in_quadrilaterals(make(count));
            return [xy = mesh.xy(), elements = mesh.elements] { smooth_once(elements, xy, {}); };
          }};
}

/// With vertices that slide, at whatever corner.
GrowthCase sliding(std::string name, int size, Mesh (*make)(int)) {
  return flat(std::move(name), size, make, {.along = trismooth::Slide::curves, .corner_angle = 180});
}

/// A strip whose triangles are listed from both ends: trees of triangles meet at their leaves.
Mesh strip_from_both_ends(int columns) {
  Mesh mesh = test_meshes::jittered_grid(columns, 2, 0, 1);
  std::vector<trismooth::Triangle> listed;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    listed.push_back(mesh.triangles[i % 2 == 0 ? i / 2 : mesh.triangles.size() - 1 - i / 2]);
  }
  mesh.triangles = std::move(listed);
  return mesh;
}

Mesh reversed_strip(int columns) {
  Mesh mesh = test_meshes::jittered_grid(columns, 2, 0, 1);
  std::ranges::reverse(mesh.triangles);
  return mesh;
}

Mesh islands(int count) {
  Mesh mesh;
  for (int i = 0; i < count; ++i) {
    const std::int32_t first = mesh.vertex_count();
    mesh.points.insert(mesh.points.end(), {{3.0 * i, 0}, {3.0 * i + 1, 0}, {3.0 * i, 1}});
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

/// Triangles around one place where each has a vertex of its own, all a little apart.
Mesh apart_at_one_place(int count) {
  Mesh mesh;
  for (int i = 0; i < count; ++i) {
    const auto place = [&](double radius, double part) {
      const double angle = 2 * std::numbers::pi * (i + part) / count;
      mesh.points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
      return mesh.vertex_count() - 1;
    };
    const std::int32_t first = place(1e-9, 0.5);
    mesh.triangles.push_back({first, place(1, 0.1), place(1, 0.9)});
  }
  return mesh;
}

/// Long edges side by side across the axes, the closer the more there are.
Mesh slanting_bars(int count) {
  Mesh mesh;
  for (int i = 0; i < count; ++i) {
    const std::int32_t first = mesh.vertex_count();
    for (const double along : {0.0, 0.9, 1.1, 2.0}) {
      const double across = (i + (along > 0 && along < 2 ? 0.6 * (along - 0.5) : 0.3)) / count;
      mesh.points.push_back({along - across, along + across});
    }
    mesh.triangles.insert(mesh.triangles.end(), {{first, first + 1, first + 2}, {first + 1, first + 3, first + 2}});
  }
  return mesh;
}

/// Vertices in a row that all step over the place of the next: they go back one a round, from the last one on. A sliver
/// that gets better keeps the bar so low that nothing else offends.
GrowthCase rounds_of_the_guard() {
  return {"flat arrays: a round of the guard for every vertex", 800, [](int columns, const ScratchFolder&) {
            const auto mesh = std::make_shared<Mesh>(test_meshes::jittered_grid(columns, 3, 0, 1));
            for (auto& p : mesh->points) {
              p = {p.x * (columns - 1), p.y * 2};
            }
            mesh->points[static_cast<std::size_t>(columns) + 1].y = 1.9999;
            auto after = mesh->points;
            after[static_cast<std::size_t>(columns) + 1].y = 1;
            for (int i = 2; i + 1 < columns; ++i) {
              after[static_cast<std::size_t>(columns) + static_cast<std::size_t>(i)].x += 1.5;
            }
            return [mesh, after] {
              trismooth::Workers workers(1);
              const auto topology = trismooth::connect_triangles(mesh->vertex_count(), mesh->triangles, workers);
              const std::vector<std::uint8_t> reversed(mesh->triangles.size(), 0);
              const auto rings = trismooth::one_rings(topology, mesh->triangles, reversed, topology.hold, workers);
              auto points = after;
              trismooth::keep_never_worse(rings.view(), mesh->points, points, workers);
            };
          }};
}

}  // namespace

std::vector<GrowthCase> flat_array_cases() {
  return {
      flat("a chain against the order of the colours", 1100, &hostile_meshes::chain),
      flat("a hub of free neighbours", 2500, &hostile_meshes::wheel),
      flat("a vertex of many fans", 500, &hostile_meshes::windmill),
      flat("an edge of many triangles", 500, &hostile_meshes::book),
      flat("a strip listed from both ends", 500, &strip_from_both_ends),
      flat("a strip listed backwards", 500, &reversed_strip),
      flat("many components", 500, &islands),
      sliding("lines that slide, of many components", 500, &islands),
      sliding("lines that slide and touch at one place", 500, &apart_at_one_place),
      sliding("lines that slide, of long edges side by side", 500, &slanting_bars),
      quadrilaterals("a chain", 400, &hostile_meshes::chain),
      quadrilaterals("a hub of free neighbours", 800, &hostile_meshes::wheel),
      quadrilaterals("a vertex of many fans", 200, &hostile_meshes::windmill),
      quadrilaterals("an edge of many triangles", 200, &hostile_meshes::book),
      rounds_of_the_guard(),
  };
}
