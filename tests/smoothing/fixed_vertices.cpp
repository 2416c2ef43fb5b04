// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/rings/fixed_vertices.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "trismooth/base/machine/workers.h"

#include "catch.h"
#include "support/scratch_folder.h"
#include "support/test_meshes.h"

using trismooth::Constraints;
using trismooth::fixed_vertices;
using trismooth::TriangleTopology;
using trismooth::Workers;

namespace hold = trismooth::hold;

namespace {

using Flags = std::vector<std::uint8_t>;

/// Vertex 0 in the middle of five: 0 is free, the others are boundary.
const test_meshes::Mesh& star() {
  static const test_meshes::Mesh mesh = test_meshes::star(5);
  return mesh;
}

using Ids = std::vector<std::int32_t>;

Constraints flagged(std::span<const std::uint8_t> flags) {
  Constraints constraints;
  constraints.fixed = flags;
  return constraints;
}
Constraints named(std::span<const std::int32_t> ids) {
  Constraints constraints;
  constraints.fixed_ids = ids;
  return constraints;
}
Constraints in_cells(std::span<const std::uint8_t> flags) {
  Constraints constraints;
  constraints.other_cells = flags;
  return constraints;
}
Constraints between(std::span<const std::int32_t> regions) {
  Constraints constraints;
  constraints.regions = regions;
  return constraints;
}

Flags fixed_in(const test_meshes::Mesh& mesh, const Constraints& constraints) {
  Workers workers(1);
  return fixed_vertices(trismooth::connect_triangles(mesh.vertex_count(), mesh.triangles, workers), mesh.triangles,
                        constraints);
}

std::string complaint(const Constraints& constraints) {
  return message_of<std::invalid_argument>([&] { fixed_in(star(), constraints); });
}

}  // namespace

TEST_CASE("without constraints of the caller the mesh alone fixes vertices") {
  CHECK(fixed_in(star(), Constraints{}) == Flags{0, 1, 1, 1, 1, 1});
}

TEST_CASE("flags, identifiers and other cells fix the vertices they name, and say why") {
  const Flags flags{7, 0, 1, 0, 0, 0};
  CHECK(fixed_in(star(), flagged(flags)) == Flags{hold::named, 1, 1 | hold::named, 1, 1, 1});
  const Flags cells{1, 0, 0, 0, 0, 255};
  CHECK(fixed_in(star(), in_cells(cells)) == Flags{hold::other_cell, 1, 1, 1, 1, 1 | hold::other_cell});
  const Ids ids{5, 0, 5};
  CHECK(fixed_in(star(), named(ids)) == Flags{hold::named, 1, 1, 1, 1, 1 | hold::named});
  CHECK(fixed_in(star(), {flags, ids, cells, {}})[0] == (hold::named | hold::other_cell));
}

TEST_CASE("the ends of every edge between two regions are fixed, and no others") {
  const test_meshes::Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(12, 12, 0.3, 1), 2);
  std::vector<std::int32_t> regions;
  for (const auto& t : mesh.triangles) {
    const double middle = (mesh.points[t[0]].x + mesh.points[t[1]].x + mesh.points[t[2]].x) / 3;
    regions.push_back(middle < 0.4 ? -3 : middle < 0.8 ? 2147483647 : 0);
  }
  const Flags plain = fixed_in(mesh, Constraints{});
  const Flags found = fixed_in(mesh, between(regions));
  int interfaces = 0;
  for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
    // Brute force: an edge from v whose two triangles are of different regions.
    bool at_interface = false;
    for (std::size_t s = 0; s < mesh.triangles.size(); ++s) {
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        int shared = 0;
        bool has_v = false;
        for (const std::int32_t corner : mesh.triangles[s]) {
          const bool common = std::ranges::count(mesh.triangles[t], corner) > 0;
          shared += common ? 1 : 0;
          has_v = has_v || (common && corner == v);
        }
        at_interface = at_interface || (shared == 2 && has_v && regions[s] != regions[t]);
      }
    }
    interfaces += at_interface ? 1 : 0;
    REQUIRE(int{found[v]} == (plain[v] | (at_interface ? int{hold::interface} : 0)));
  }
  CHECK(interfaces > 20);
  CHECK(fixed_in(mesh, between(Ids(mesh.triangles.size(), 5))) == plain);
}

TEST_CASE("constraints that do not fit the mesh are refused, and the message says which") {
  const Flags short_flags(5, 0);
  CHECK(complaint(flagged(short_flags)) == "Constraints::fixed has 5 entries, expected 6 or none");
  CHECK(complaint(in_cells(short_flags)) == "Constraints::other_cells has 5 entries, expected 6 or none");
  const Ids six(6, 0);
  CHECK(complaint(between(six)) == "Constraints::regions has 6 entries, expected 5 or none");
  for (const std::int32_t id : {-1, 6, 2147483647}) {
    const Ids ids{0, id};
    CHECK(complaint(named(ids)) == "fixed vertex " + std::to_string(id) + " is not one of the 6 vertices");
  }
}
