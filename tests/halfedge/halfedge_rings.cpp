// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/halfedge/halfedge_rings.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <random>
#include <set>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

// (MeshChecker uses omerr() without its header.)
#include <OpenMesh/Core/System/omstream.hh>
#include <OpenMesh/Tools/Utils/MeshCheckerT.hh>

#include "trismooth/base/element_list.h"
#include "trismooth/base/errors.h"
#include "trismooth/base/hold.h"
#include "trismooth/base/machine/workers.h"

#include "catch.h"
#include "support/mixed_meshes.h"
#include "support/planar_samples.h"

using planar_samples::Sample;
using trismooth::Constraints;
using trismooth::ElementList;
using trismooth::MeshRings;
using trismooth::Point2;
using trismooth::Triangle;
using trismooth::Workers;

namespace halfedge_rings_test {

std::vector<Point2<double>> points_of(const Sample& sample) {
  std::vector<Point2<double>> points;
  for (std::size_t i = 0; i < sample.xyz.size(); i += 3) {
    points.push_back({sample.xyz[i], sample.xyz[i + 1]});
  }
  return points;
}

void require_same(const MeshRings& found, const MeshRings& expected) {
  REQUIRE(found.fixed == expected.fixed);
  REQUIRE(found.reversed == expected.reversed);
  REQUIRE(found.components == expected.components);
  REQUIRE(found.reoriented_triangles == expected.reoriented_triangles);
  REQUIRE(found.rings.offsets == expected.rings.offsets);
  REQUIRE(found.rings.neighbours == expected.rings.neighbours);
  REQUIRE(found.rings.opposites == expected.rings.opposites);
  REQUIRE(found.note.empty());
  REQUIRE(found.found_by == trismooth::Topology::halfedge);
  REQUIRE(expected.found_by == trismooth::Topology::host);
}

/// By way of a halfedge mesh.
MeshRings halfedge_rings(std::span<const double> xyz, std::span<const Point2<double>> points,
                         const ElementList& elements, const Constraints& constraints, Workers& workers) {
  return trismooth::read_halfedge_rings(trismooth::connect_halfedges(xyz, elements, workers), points, elements,
                                        constraints, workers);
}

/// Some vertices named, some of other cells, and regions that change here and there.
struct RandomConstraints {
  std::vector<std::uint8_t> fixed;
  std::vector<std::int32_t> fixed_ids;
  std::vector<std::uint8_t> other_cells;
  std::vector<std::int32_t> regions;

  RandomConstraints(const Sample& sample, std::mt19937_64& random)
      : RandomConstraints(sample.xyz.size() / 3, sample.triangles.size(), random) {}
  RandomConstraints(std::size_t vertices, std::size_t elements, std::mt19937_64& random)
      : fixed(vertices), other_cells(vertices), regions(elements) {
    std::ranges::generate(fixed, [&] { return static_cast<std::uint8_t>(random() % 9 == 0 ? 2 : 0); });
    std::ranges::generate(other_cells, [&] { return static_cast<std::uint8_t>(random() % 9 == 0 ? 1 : 0); });
    std::ranges::generate(regions, [&] { return static_cast<std::int32_t>(random() % 20 == 0 ? 1 : 0); });
    if (!fixed.empty()) {
      fixed_ids = {static_cast<std::int32_t>(random() % fixed.size()), 0};
    }
  }
  Constraints view() const { return {fixed, fixed_ids, other_cells, regions}; }
};

/// The message of what the call throws, with the kind of error.
std::string thrown_by(const std::function<void()>& call) {
  try {
    call();
  } catch (const trismooth::MeshError& error) {
    return std::string("MeshError: ") + error.what();
  } catch (const std::invalid_argument& error) {
    return std::string("invalid_argument: ") + error.what();
  }
  return "nothing";
}

}  // namespace halfedge_rings_test

using namespace halfedge_rings_test;

TEST_CASE("halfedges give what the triangle list gives, in every number, for every kind of mesh") {
  std::mt19937_64 random(31);
  for (const Sample& sample : planar_samples::samples()) {
    CAPTURE(sample.name);
    const auto points = points_of(sample);
    for (const bool constrained : {false, true}) {
      const RandomConstraints named(sample, random);
      const Constraints constraints = constrained ? named.view() : Constraints{};
      for (const int threads : {1, 3}) {
        Workers workers(threads);
        const MeshRings expected = trismooth::find_mesh_rings(points, sample.triangles, constraints, workers);
        require_same(halfedge_rings(sample.xyz, points, sample.triangles, constraints, workers), expected);
      }
    }
  }
}

TEST_CASE("a component whose first triangle is listed clockwise is read the other way round") {
  std::mt19937_64 random(32);
  Sample sample = planar_samples::grid(12, 0.3, random);
  for (Triangle& triangle : sample.triangles) {
    std::swap(triangle[0], triangle[1]);
  }
  std::swap(sample.triangles[7][1], sample.triangles[7][2]);
  const auto points = points_of(sample);
  Workers workers(1);
  const MeshRings found = halfedge_rings(sample.xyz, points, sample.triangles, {}, workers);
  CHECK(found.reoriented_triangles == 1);
  CHECK(std::ranges::count(found.reversed, 1) == static_cast<std::ptrdiff_t>(sample.triangles.size()) - 1);
  require_same(found, trismooth::find_mesh_rings(points, sample.triangles, {}, workers));
}

TEST_CASE("a large mesh gives the same with any number of threads") {
  std::mt19937_64 random(33);
  const Sample sample = planar_samples::shuffled(planar_samples::grid(150, 0.3, random), random);
  const auto points = points_of(sample);
  const RandomConstraints named(sample, random);
  Workers one(1);
  const MeshRings expected = trismooth::find_mesh_rings(points, sample.triangles, named.view(), one);
  for (const int threads : {1, 2, 5}) {
    Workers workers(threads);
    require_same(halfedge_rings(sample.xyz, points, sample.triangles, named.view(), workers), expected);
  }
}

TEST_CASE("halfedges give what the list of elements gives where quadrilaterals are among them") {
  std::mt19937_64 random(34);
  unsigned met = 0;
  std::int64_t turned = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    const mixed_meshes::MixedMesh mesh = mixed_meshes::random_mesh(seed).listed_from_other_corners(seed, seed % 2 == 0);
    std::vector<Point2<double>> points;
    std::vector<double> xyz;
    for (const auto& [x, y] : mesh.points) {
      points.push_back({x, y});
      xyz.insert(xyz.end(), {x, y, 0});
    }
    const RandomConstraints named(points.size(), mesh.elements.size(), random);
    for (const Constraints& constraints : {Constraints{}, named.view()}) {
      for (const int threads : {1, 3}) {
        Workers workers(threads);
        const MeshRings expected = trismooth::find_mesh_rings(points, ElementList(mesh.elements), constraints, workers);
        require_same(halfedge_rings(xyz, points, mesh.elements, constraints, workers), expected);
        turned += std::ranges::count(expected.reversed, 1);
        for (const std::uint8_t reasons : expected.fixed) {
          met |= reasons;
        }
      }
    }
    // Faces are the elements, and each vertex is there once for each fan of them.
    Workers workers(1);
    const trismooth::ConnectedMesh connected = trismooth::connect_halfedges(xyz, mesh.elements, workers);
    const trismooth::ElementMesh& halfedges = connected.halfedges.mesh;
    std::ostringstream complaints;
    OpenMesh::Utils::MeshCheckerT<trismooth::ElementMesh>(halfedges).check(
        OpenMesh::Utils::MeshCheckerT<trismooth::ElementMesh>::CHECK_ALL, complaints);
    CHECK(complaints.str().empty());
    REQUIRE(halfedges.n_faces() == mesh.elements.size());
    for (const auto face : halfedges.faces()) {
      std::set<std::int32_t> corners;
      for (const auto corner : halfedges.fv_range(face)) {
        const int beyond = corner.idx() - mesh.vertex_count();
        corners.insert(beyond < 0 ? corner.idx() : connected.halfedges.copies_of[static_cast<std::size_t>(beyond)]);
      }
      const std::vector<std::int32_t> listed = mesh.corners(static_cast<std::size_t>(face.idx()));
      CHECK(corners == std::set<std::int32_t>(listed.begin(), listed.end()));
    }
  }
  CHECK((met & trismooth::hold::bow_tie) != 0);
  CHECK((met & trismooth::hold::interface) != 0);
  CHECK(turned > 100);
}

TEST_CASE("halfedges refuse what the triangle list refuses, with the same words") {
  const std::vector<double> xyz{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 0, 0, 2, 1, 0};
  const std::vector<Point2<double>> points{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}, {2, 1}};
  const std::vector<Triangle> good{{0, 1, 2}, {0, 2, 3}};
  const std::vector<Triangle> moebius{{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {3, 4, 0}, {4, 0, 1}};
  const std::vector<std::uint8_t> three(3, 0);
  const std::vector<std::int32_t> ids{6};
  struct Case {
    std::vector<Triangle> triangles;
    Constraints constraints;
    std::string words;
  };
  for (const Case& refused : {Case{{{0, 1, 6}}, {}, "6"}, Case{{{0, 1, 2}, {0, -1, 2}}, {}, "-1"},
                              Case{{{0, 1, 2}, {3, 3, 2}}, {}, "repeats a vertex"}, Case{moebius, {}, "one-sided"},
                              Case{good, {.fixed = three}, "has 3 entries"}, Case{good, {.fixed_ids = ids}, "vertex 6"},
                              Case{good, {.regions = ids}, "has 1 entries"}}) {
    CAPTURE(refused.words);
    Workers workers(1);
    const std::string expected =
        thrown_by([&] { trismooth::find_mesh_rings(points, refused.triangles, refused.constraints, workers); });
    CHECK(expected.find(refused.words) != std::string::npos);
    CHECK(thrown_by([&] { halfedge_rings(xyz, points, refused.triangles, refused.constraints, workers); }) == expected);
  }
}
