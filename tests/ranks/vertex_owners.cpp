// SPDX-License-Identifier: BSD-3-Clause
// How the program shares a mesh out: evenly, alike on all ranks, and with short borders.

#include "trismooth/pipeline/ranks/partition/vertex_owners.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include <mpi.h>

#include "trismooth/mpi/communicator.h"
#include "trismooth/pipeline/generate/delaunay.h"
#include "trismooth/pipeline/ranks/partition/metis_parts.h"

#include "catch.h"
#include "support/test_meshes.h"

using namespace trismooth;

namespace {

struct Whole {
  std::vector<Point2<double>> points;
  std::vector<Triangle> triangles;
};

/// The Delaunay mesh of random points, alike on all ranks: denser to the left, where `graded`.
Whole random_mesh(std::int32_t vertices, bool graded) {
  test_meshes::Random random(7);
  std::set<GridPoint> known;
  std::vector<GridPoint> points;
  while (static_cast<std::int32_t>(points.size()) < vertices) {
    const std::int32_t x = random.below(1 << 14);
    const GridPoint point{graded ? x * x : x << 14, random.below(1 << 28)};
    if (known.insert(point).second) {
      points.push_back(point);
    }
  }
  Whole mesh;
  mesh.triangles = delaunay(points);
  for (const auto& [x, y] : points) {
    mesh.points.push_back({x * 0x1p-28, y * 0x1p-28});
  }
  return mesh;
}

/// The owner of each vertex of the mesh, where ranks have triangles by turns (`pieces`), or rank 0 has all; -1 where
/// ranks disagree.
std::vector<std::int32_t> owners_of(const Whole& mesh, Partition partition, bool pieces,
                                    const mpi::Communicator& ranks) {
  std::vector<std::int32_t> number(mesh.points.size(), -1);
  std::vector<Point2<double>> points;
  std::vector<Triangle> triangles;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::size_t turn = t * static_cast<std::size_t>(ranks.size()) / mesh.triangles.size();
    if (static_cast<std::size_t>(ranks.rank()) != (pieces ? turn : 0)) {
      continue;
    }
    Triangle local{};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const auto v = static_cast<std::size_t>(mesh.triangles[t][corner]);
      if (number[v] < 0) {
        number[v] = static_cast<std::int32_t>(points.size());
        points.push_back(mesh.points[v]);
      }
      local[corner] = number[v];
    }
    triangles.push_back(local);
  }
  const std::vector<std::int32_t> owners = find_owners(partition, {points, triangles, {}}, ranks);
  std::vector<std::int32_t> highest(number.size(), -1);
  std::vector<std::int32_t> lowest(number.size(), ranks.size());
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] >= 0) {
      highest[v] = lowest[v] = owners[static_cast<std::size_t>(number[v])];
    }
  }
  const auto count = static_cast<int>(number.size());
  MPI_Allreduce(MPI_IN_PLACE, highest.data(), count, MPI_INT32_T, MPI_MAX, ranks.handle());
  MPI_Allreduce(MPI_IN_PLACE, lowest.data(), count, MPI_INT32_T, MPI_MIN, ranks.handle());
  for (std::size_t v = 0; v < number.size(); ++v) {
    highest[v] = highest[v] == lowest[v] ? highest[v] : -1;
  }
  return highest;
}

std::int64_t cut_sides(const Whole& mesh, const std::vector<std::int32_t>& owners) {
  std::int64_t cut = 0;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      cut += owners[static_cast<std::size_t>(t[corner])] != owners[static_cast<std::size_t>(t[(corner + 1) % 3])];
    }
  }
  return cut;
}

}  // namespace

TEST_CASE("ranks agree on who moves a vertex, have their share, and borders are as short as bisection's at most") {
  const mpi::Communicator ranks(MPI_COMM_WORLD);
  for (const bool graded : {false, true}) {
    const Whole mesh = random_mesh(6000, graded);
    for (const bool pieces : {false, true}) {
      INFO((graded ? "graded" : "even") << (pieces ? ", in pieces" : ", one file"));
      std::int64_t cut_by_bisection = 0;
      for (const Partition partition : {Partition::bisect, Partition::metis}) {
        if (partition == Partition::metis && metis_version().empty()) {
          continue;
        }
        INFO(std::string(EnumText<Partition>::texts[static_cast<std::size_t>(partition)].second));
        const std::vector<std::int32_t> owners = owners_of(mesh, partition, pieces, ranks);
        CHECK(owners == owners_of(mesh, partition, pieces, ranks));
        CHECK(std::ranges::count(owners, -1) == 0);
        const double share = static_cast<double>(owners.size()) / ranks.size();
        for (std::int32_t rank = 0; rank < ranks.size(); ++rank) {
          CHECK(static_cast<double>(std::ranges::count(owners, rank)) > 0.9 * share);
          CHECK(static_cast<double>(std::ranges::count(owners, rank)) < 1.1 * share);
        }
        const std::int64_t cut = cut_sides(mesh, owners);
        // A straight cut of 6000 vertices meets some 78 of them, each with two sides across, of two triangles each.
        CHECK(cut < 600 * (ranks.size() - 1) + 1);
        if (partition == Partition::bisect) {
          cut_by_bisection = cut;
        } else {
          CHECK(cut <= cut_by_bisection + cut_by_bisection / 20);
        }
      }
    }
  }
}
