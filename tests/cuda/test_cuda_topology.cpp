// SPDX-License-Identifier: BSD-3-Clause
// What the device finds of a mesh's topology is what the host finds, in every number.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <utility>
#include <vector>

#include "trismooth/base/errors.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/cuda/topology/device_topology.h"
#include "trismooth/cuda/topology/find_rings.h"
#include "trismooth/mesh_io/halfedge/halfedge_rings.h"
#include "trismooth/pipeline/generate/random_mesh.h"
#include "trismooth/smoothing/rings/fixed_elements.h"
#include "trismooth/smoothing/rings/fixed_vertices.h"
#include "trismooth/smoothing/rings/mesh_rings.h"

#include "catch.h"
#include "support/test_meshes.h"
#include "topology_ways.h"

using test_meshes::Mesh;
using test_meshes::Random;
using topology_ways::both_ways;
using topology_ways::find_on_host;
using topology_ways::require_same_error;
using topology_ways::thrown_by;
using trismooth::Constraints;
using trismooth::FixedElements;
using trismooth::MeshRings;
using trismooth::OneRings;
using trismooth::Point2;
using trismooth::Triangle;
using trismooth::Workers;
using trismooth::cuda::NeighbourSearch;

namespace cuda = trismooth::cuda;
namespace hold = trismooth::hold;

namespace {

void require_same(const OneRings& found, const OneRings& expected) {
  REQUIRE(found.offsets == expected.offsets);
  REQUIRE(found.neighbours == expected.neighbours);
}

void require_same(const MeshRings& found, const MeshRings& expected) {
  REQUIRE(found.fixed == expected.fixed);
  REQUIRE(found.reversed == expected.reversed);
  REQUIRE(found.components == expected.components);
  REQUIRE(found.reoriented_triangles == expected.reoriented_triangles);
  require_same(found.rings, expected.rings);
}

void require_host_results(const Mesh& mesh, const Constraints& constraints = {}) {
  const MeshRings expected = find_on_host(mesh, constraints);
  for (const NeighbourSearch way : both_ways) {
    CAPTURE(static_cast<int>(way));
    require_same(cuda::find_rings_on_device(mesh.points, mesh.triangles, constraints, way), expected);
  }
}

OneRings halfedge_rings(const Mesh& mesh, const Constraints& constraints = {}) {
  Workers workers(0);
  std::vector<double> xyz;
  for (const Point2<double> p : mesh.points) {
    xyz.insert(xyz.end(), {p.x, p.y, 0});
  }
  return trismooth::read_halfedge_rings(trismooth::connect_halfedges(xyz, mesh.triangles, workers), mesh.points,
                                        mesh.triangles, constraints, workers)
      .rings;
}

void require_halfedge_rings(const Mesh& mesh) {
  const MeshRings found =
      cuda::find_rings_on_device(mesh.points, mesh.triangles, Constraints{}, NeighbourSearch::parallel);
  require_same(found.rings, halfedge_rings(mesh));
}

Mesh random_delaunay(std::int64_t vertices, std::uint64_t seed) {
  trismooth::RandomMesh mesh = trismooth::random_delaunay_mesh(vertices, seed);
  return {std::move(mesh.points), {mesh.triangles.begin(), mesh.triangles.end()}};
}

/// The same mesh with triangle t removed.
Mesh without_triangle(Mesh mesh, std::ptrdiff_t t) {
  mesh.triangles.erase(mesh.triangles.begin() + t);
  return mesh;
}

/// Stars of the given sizes around one hub, vertex 0.
Mesh stars_on_one_hub(std::initializer_list<std::int32_t> sizes) {
  Mesh mesh;
  mesh.points.push_back({0, 0});
  for (const std::int32_t size : sizes) {
    const std::int32_t base = mesh.vertex_count() - 1;
    const Mesh star = test_meshes::star(size);
    mesh.points.insert(mesh.points.end(), star.points.begin() + 1, star.points.end());
    for (const Triangle& t : star.triangles) {
      mesh.triangles.push_back({0, t[1] + base, t[2] + base});
    }
  }
  return mesh;
}

/// A sphere, laid flat: vertices 0 and 1 are both the hub of a star over the same polygon of `size` vertices.
Mesh double_hub(std::int32_t size) {
  Mesh mesh;
  mesh.points = {{0.01, 0.02}, {-0.02, 0.01}};
  const Mesh star = test_meshes::star(size);
  mesh.points.insert(mesh.points.end(), star.points.begin() + 1, star.points.end());
  for (std::int32_t i = 0; i < size; ++i) {
    const std::int32_t a = 2 + i;
    const std::int32_t b = 2 + (i + 1) % size;
    mesh.triangles.push_back({0, a, b});
    mesh.triangles.push_back({1, b, a});
  }
  return mesh;
}

}  // namespace

TEST_CASE("every mesh of the zoo, as it is, shuffled and with triangles listed either way") {
  for (const auto& [name, mesh] : test_meshes::zoo()) {
    CAPTURE(name);
    require_host_results(mesh);
    require_halfedge_rings(mesh);
    for (const std::size_t period : {1U, 2U, 3U, 7U}) {
      CAPTURE(period);
      const Mesh mixed = test_meshes::partly_reversed(test_meshes::shuffled(mesh, period), period);
      require_host_results(mixed);
      require_halfedge_rings(mixed);
    }
  }
}

TEST_CASE("random Delaunay meshes have the rings of the halfedge mesh") {
  for (const std::int64_t vertices : {4, 5, 20, 1000, 60000}) {
    CAPTURE(vertices);
    const Mesh mesh = random_delaunay(vertices, static_cast<std::uint64_t>(vertices));
    require_host_results(mesh);
    require_halfedge_rings(mesh);
    const Mesh mixed = test_meshes::partly_reversed(test_meshes::shuffled(mesh, 1), 3);
    require_host_results(mixed);
    require_halfedge_rings(mixed);
  }
}

TEST_CASE("a mesh of a million vertices") {
  const Mesh mesh = random_delaunay(1000000, 1);
  const MeshRings expected = find_on_host(mesh, {});
  // One thread takes seconds; several runs in parallel show that nothing depends on who is first.
  for (int run = 0; run < 3; ++run) {
    require_same(cuda::find_rings_on_device(mesh.points, mesh.triangles, {}, NeighbourSearch::parallel), expected);
  }
}

TEST_CASE("many components of all sizes, each with its own majority") {
  Mesh mesh;
  for (std::int32_t i = 0; i < 400; ++i) {
    const auto seed = static_cast<std::uint64_t>(i);
    Mesh part = i % 3 == 0   ? test_meshes::star(3 + i % 50, seed)
                : i % 3 == 1 ? test_meshes::jittered_grid(2 + i % 7, 2 + i % 5, 1.0, seed)
                             : test_meshes::annulus(3 + i % 9, 1 + i % 3, 0.5);
    mesh = test_meshes::together(std::move(mesh), test_meshes::partly_reversed(std::move(part), 1 + seed % 4),
                                 {3.0 * i, 0});
  }
  require_host_results(mesh);
  require_host_results(test_meshes::shuffled(mesh, 5));
  // Components one after the other in long stretches, and one triangle each.
  Mesh lone;
  for (std::int32_t i = 0; i < 10000; ++i) {
    const double x = 2 * i;
    lone.points.insert(lone.points.end(), {{x, 0}, {x + 1, 0}, {x, i % 3 == 0 ? -1.0 : i % 7 == 0 ? 0.0 : 1.0}});
    lone.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  require_host_results(lone);
}

TEST_CASE("a tie is broken by the lowest triangle that is not degenerate") {
  const std::vector<test_meshes::Point> points{{0, 0}, {1, 0}, {0.5, -2}, {0.4, -1}, {9, 9}, {0.25, -1}};
  require_host_results({points, {{0, 1, 2}, {1, 0, 3}}});
  require_host_results({points, {{1, 0, 3}, {0, 1, 2}}});
  require_host_results({points, {{2, 0, 5}, {0, 1, 2}, {1, 0, 3}}});
  require_host_results({{{0, 0}, {1, 0}, {2, 0}, {3, 0}}, {{0, 1, 2}, {1, 2, 3}}});
  // Far apart in a long list: the tie is broken by a triangle that no thread of the same warp sees.
  Mesh strip;
  constexpr std::int32_t length = 5000;
  for (std::int32_t i = 0; i <= length; ++i) {
    const double folded = i < length / 2 ? i : length - i;
    const double x = i < 100 || i > length - 100 ? 0 : folded;
    strip.points.insert(strip.points.end(), {{x, 0}, {x, 1}});
  }
  for (std::int32_t i = 0; i < length; ++i) {
    strip.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 1});
    strip.triangles.push_back({2 * i + 1, 2 * i + 2, 2 * i + 3});
  }
  require_host_results(strip);
  require_host_results(test_meshes::partly_reversed(strip, 1));
}

TEST_CASE("non-manifold edges, bow ties, triangles listed twice and isolated vertices") {
  require_host_results(test_meshes::three_on_an_edge());
  require_host_results(test_meshes::bow_tie());
  Mesh isolated = test_meshes::star(7);
  isolated.points.push_back({5, 5});
  isolated.points.push_back({6, 5});
  require_host_results(isolated);
  require_host_results({{{0, 0}, {1, 0}, {0, 1}}, {}});
  require_host_results({{{0, 0}, {1, 0}, {0, 1}}, {{0, 1, 2}, {0, 1, 2}}});
  require_host_results({{{0, 0}, {1, 0}, {0, 1}}, {{0, 1, 2}, {2, 1, 0}}});
  require_host_results({{{0, 0}, {1, 0}, {0, 1}}, {{0, 1, 2}, {2, 1, 0}, {1, 2, 0}}});
  require_host_results({{{0, 0}, {1, 0}, {0, 1}, {1, 1}}, {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}});
  // Copies beside the free ends of fans, of which the second is too large for one thread.
  for (const std::int32_t size : {6, 60}) {
    Mesh fan = test_meshes::star(size);
    fan.triangles.pop_back();
    for (const std::size_t t : {std::size_t{0}, fan.triangles.size() - 1, fan.triangles.size() / 2}) {
      fan.triangles.push_back(fan.triangles[t]);
      require_host_results(fan);
      std::swap(fan.triangles.back()[0], fan.triangles.back()[1]);
      require_host_results(fan);
    }
  }
}

TEST_CASE("triangles between random vertices: the same results or the same error") {
  Random random(17);
  std::int32_t accepted = 0;
  for (std::int32_t i = 0; i < 400; ++i) {
    CAPTURE(i);
    const std::int32_t vertices = 4 + random.below(i % 4 == 0 ? 8 : 60);
    Mesh mesh;
    for (std::int32_t v = 0; v < vertices; ++v) {
      mesh.points.push_back({random.between(0, 1), random.between(0, 1)});
    }
    mesh.triangles = test_meshes::random_soup(vertices, random.below(i % 4 == 0 ? 300 : 40), random);
    const bool fails = thrown_by([&] { find_on_host(mesh, {}); }).has_value();
    if (fails) {
      require_same_error(mesh);
    } else {
      require_host_results(mesh);
      ++accepted;
    }
  }
  CHECK(accepted > 50);
}

TEST_CASE("constraints of every kind, alone and together") {
  const Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(40, 30, 0.3, 3), 4);
  Random random(5);
  std::vector<std::uint8_t> fixed(mesh.points.size());
  std::vector<std::uint8_t> other_cells(mesh.points.size());
  std::vector<std::int32_t> ids;
  std::vector<std::int32_t> regions(mesh.triangles.size());
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    fixed[v] = random.below(10) == 0 ? static_cast<std::uint8_t>(1 + random.below(255)) : 0;
    other_cells[v] = random.below(10) == 0 ? 2 : 0;
  }
  for (int i = 0; i < 100; ++i) {
    ids.push_back(random.below(mesh.vertex_count()));
    ids.push_back(ids.back());
  }
  for (std::size_t t = 0; t < regions.size(); ++t) {
    regions[t] = mesh.points[mesh.triangles[t][0]].x < 0.5 ? -7 : 1000000;
  }
  require_host_results(mesh, {.fixed = fixed});
  require_host_results(mesh, {.fixed_ids = ids});
  require_host_results(mesh, {.other_cells = other_cells});
  require_host_results(mesh, {.regions = regions});
  require_host_results(mesh, {.fixed = fixed, .fixed_ids = ids, .other_cells = other_cells, .regions = regions});
  const Constraints all{.fixed = fixed, .fixed_ids = ids, .other_cells = other_cells, .regions = regions};
  const MeshRings found = cuda::find_rings_on_device(mesh.points, mesh.triangles, all, NeighbourSearch::parallel);
  std::uint8_t reasons = 0;
  for (const std::uint8_t reason : found.fixed) {
    reasons |= reason;
  }
  CHECK(reasons == (hold::boundary | hold::interface | hold::other_cell | hold::named));
  require_same(found.rings, halfedge_rings(mesh, all));
}

TEST_CASE("vertices of any number of triangles, on both sides of what one thread looks after") {
  for (const std::int32_t size : {3, 8, 31, 32, 33, 34, 63, 64, 65, 100, 257, 5000}) {
    CAPTURE(size);
    const Mesh star = test_meshes::star(size);
    require_host_results(star);
    require_halfedge_rings(star);
    const Mesh mixed = test_meshes::partly_reversed(test_meshes::shuffled(star, 2), 3);
    require_host_results(mixed);
    require_halfedge_rings(mixed);
    require_host_results(without_triangle(star, size / 2));
    require_host_results(without_triangle(mixed, 0));
    require_host_results(double_hub(size));
    require_host_results(test_meshes::partly_reversed(test_meshes::shuffled(double_hub(size), 9), 4));
  }
}

TEST_CASE("large vertices that are fixed for every reason") {
  for (const std::int32_t size : {20, 40, 3000}) {
    CAPTURE(size);
    require_host_results(stars_on_one_hub({size, size}));
    require_host_results(test_meshes::shuffled(stars_on_one_hub({3, size, 5}), 1));
    Mesh thick_spoke = test_meshes::star(size);
    thick_spoke.points.push_back({0.1, 0.1});
    thick_spoke.triangles.push_back({0, 1, size + 1});
    require_host_results(thick_spoke);
    require_host_results(test_meshes::shuffled(thick_spoke, 1));
    const Mesh star = test_meshes::star(size);
    std::vector<std::int32_t> regions(star.triangles.size(), 3);
    require_host_results(star, {.regions = regions});
    regions[7] = 4;
    require_host_results(star, {.regions = regions});
    const std::vector<std::int32_t> hub{0};
    require_host_results(star, {.fixed_ids = hub});
    // Many large vertices, and rings of free and of fixed ones side by side.
    Mesh many = test_meshes::star(size);
    for (std::int32_t i = 1; i < 20; ++i) {
      many = test_meshes::together(std::move(many),
                                   i % 3 == 0 ? without_triangle(star, i) : test_meshes::star(size + i), {3.0 * i, 1});
    }
    require_host_results(many);
    require_host_results(test_meshes::shuffled(many, 6));
  }
}

TEST_CASE("a hub of 200000 triangles") {
  const Mesh star = test_meshes::star(200000);
  require_host_results(star);
  require_halfedge_rings(star);
  const Mesh mixed = test_meshes::partly_reversed(test_meshes::shuffled(star, 2), 3);
  require_host_results(mixed);
  require_host_results(without_triangle(mixed, 12345));
}

TEST_CASE("no triangle, no vertex") {
  require_host_results({});
  require_host_results({{{1, 1}}, {}});
}

TEST_CASE("the orientation follows the coordinates, and says whether it has changed") {
  const Mesh mesh = test_meshes::together(test_meshes::partly_reversed(test_meshes::star(40), 3),
                                          test_meshes::jittered_grid(6, 5, 0.3, 1), {5, 0});
  Mesh mirrored = mesh;
  for (auto& p : mirrored.points) {
    p.y = -p.y;
  }
  Mesh half_mirrored = mesh;
  for (std::size_t v = 0; v <= 40; ++v) {
    half_mirrored.points[v].y = -half_mirrored.points[v].y;
  }
  Workers workers(1);
  cuda::Context context;
  const cuda::DeviceBuffer<Triangle> triangles(context, mesh.triangles);
  cuda::DeviceTopology topology(context, mesh.vertex_count(), static_cast<std::int32_t>(mesh.triangles.size()),
                                reinterpret_cast<const std::int32_t*>(triangles.data()), {}, NeighbourSearch::parallel);
  const auto orient_by = [&](const Mesh& positions) {
    const cuda::DeviceBuffer<Point2<double>> points(context, positions.points);
    const bool changed = topology.orient(points.data());
    const MeshRings expected = find_on_host(positions, {});
    const cuda::DeviceRings rings = topology.rings();
    OneRings found;
    std::vector<std::uint32_t> offsets(rings.offsets.size());
    rings.offsets.download(offsets);
    found.offsets.assign(offsets.begin(), offsets.end());
    found.neighbours.resize(rings.neighbours.size());
    rings.neighbours.download(found.neighbours);
    require_same(found, expected.rings);
    CHECK(topology.smallest_fixed_quotient(points.data()) ==
          FixedElements(positions.triangles, expected.reversed, expected.fixed, workers)
              .smallest_quotient([&](std::int32_t v) { return positions.points[v]; }));
    return changed;
  };
  CHECK(orient_by(mesh));
  CHECK_FALSE(orient_by(mesh));
  CHECK(orient_by(mirrored));
  CHECK_FALSE(orient_by(mirrored));
  CHECK(orient_by(half_mirrored));
  CHECK(orient_by(mesh));
}

TEST_CASE("the smallest quotient of the triangles without a free vertex is the host's") {
  Workers workers(1);
  for (const auto& [name, mesh] : test_meshes::zoo()) {
    CAPTURE(name);
    const MeshRings expected = find_on_host(mesh, {});
    cuda::Context context;
    const cuda::DeviceBuffer<Triangle> triangles(context, mesh.triangles);
    const cuda::DeviceBuffer<Point2<double>> points(context, mesh.points);
    cuda::DeviceTopology topology(context, mesh.vertex_count(), static_cast<std::int32_t>(mesh.triangles.size()),
                                  reinterpret_cast<const std::int32_t*>(triangles.data()), {},
                                  NeighbourSearch::one_thread);
    CHECK(topology.orient(points.data()));
    CHECK(topology.smallest_fixed_quotient(points.data()) ==
          FixedElements(mesh.triangles, expected.reversed, expected.fixed, workers)
              .smallest_quotient([&points_of = mesh.points](std::int32_t v) { return points_of[v]; }));
  }
  cuda::Context context;
  cuda::DeviceTopology nothing(context, 0, 0, nullptr, {}, NeighbourSearch::parallel);
  CHECK(nothing.orient(nullptr));
  CHECK_FALSE(nothing.orient(nullptr));
  CHECK(nothing.smallest_fixed_quotient(nullptr) == std::numeric_limits<double>::infinity());
}

TEST_CASE("device memory stays near what is announced") {
  const Mesh mesh = random_delaunay(200000, 4);
  cuda::Context context;
  const cuda::DeviceBuffer<Triangle> triangles(context, mesh.triangles);
  const cuda::DeviceBuffer<Point2<double>> points(context, mesh.points);
  const std::size_t before = context.bytes_in_use();
  {
    cuda::DeviceTopology topology(context, mesh.vertex_count(), static_cast<std::int32_t>(mesh.triangles.size()),
                                  reinterpret_cast<const std::int32_t*>(triangles.data()), {},
                                  NeighbourSearch::parallel);
    topology.orient(points.data());
    const cuda::DeviceRings rings = topology.rings();
    CHECK(context.bytes_in_use() - before < 72 * mesh.points.size());
    CHECK(context.peak_bytes() - before < 75 * mesh.points.size());
  }
  CHECK(context.bytes_in_use() == before);
}
