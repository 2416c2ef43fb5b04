// SPDX-License-Identifier: BSD-3-Clause
#include "mpi/pieces.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>

#include "trismooth/base/splitmix64.h"

namespace mpi_tests {

namespace {

int call(int (*function)(MPI_Comm, int*)) {
  int value = 0;
  function(MPI_COMM_WORLD, &value);
  return value;
}

int rank_of_strip(const RandomMesh& mesh, const trismooth::Triangle& t, double low, double high) {
  const double x = mesh.mesh.points[static_cast<std::size_t>(t[0])].x;
  const double part = high > low ? (x / 2 - low / 2) / (high / 2 - low / 2) : 0;
  return std::clamp(static_cast<int>(part * ranks()), 0, ranks() - 1);
}

}  // namespace

int rank() {
  return call(MPI_Comm_rank);
}
int ranks() {
  return call(MPI_Comm_size);
}

Piece piece_of(const RandomMesh& mesh, Cut cut, std::uint64_t seed) {
  // Drawn alike on all ranks.
  test_meshes::Random random(trismooth::splitmix64(seed));
  const auto vertices = static_cast<std::size_t>(mesh.mesh.vertex_count());
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const auto& p : mesh.mesh.points) {
    low = std::min(low, p.x);
    high = std::max(high, p.x);
  }
  const int chosen = random.below(ranks());
  const std::vector<std::int32_t> by_metis = cut == Cut::by_metis ? metis_cut(mesh, seed) : std::vector<std::int32_t>{};
  std::vector<int> rank_of_triangle;
  for (const trismooth::Triangle& t : mesh.mesh.triangles) {
    const int drawn = random.below(ranks());
    rank_of_triangle.push_back(cut == Cut::in_strips     ? rank_of_strip(mesh, t, low, high)
                               : cut == Cut::one_has_all ? chosen
                               : cut == Cut::by_metis    ? by_metis[static_cast<std::size_t>(t[0])]
                                                         : drawn);
  }
  std::vector<std::int32_t> owner(vertices);
  for (std::int32_t& o : owner) {
    o = cut == Cut::one_owns_all ? chosen : random.below(ranks());
  }
  if (cut == Cut::by_metis) {
    owner = by_metis;
  }
  Piece piece;
  std::vector<std::int32_t> global;
  std::set<std::int32_t> known;
  const auto take = [&](std::int32_t v) {
    if (known.insert(v).second) {
      global.push_back(v);
    }
  };
  std::vector<std::size_t> own;
  for (std::size_t t = 0; t < mesh.mesh.triangles.size(); ++t) {
    const bool is_ghost = cut != Cut::one_has_all && random.below(8) == 0;
    if (rank_of_triangle[t] == rank() || (is_ghost && rank() == (rank_of_triangle[t] + 1) % ranks())) {
      own.push_back(t);
      for (const std::int32_t v : mesh.mesh.triangles[t]) {
        take(v);
      }
    }
  }
  // Isolated vertices, and some more, are somewhere.
  for (std::size_t v = 0; v < vertices; ++v) {
    if (const int where = random.below(ranks()); cut == Cut::one_has_all ? rank() == chosen : rank() == where) {
      take(static_cast<std::int32_t>(v));
    }
  }
  test_meshes::Random of_rank(trismooth::splitmix64(seed + static_cast<std::uint64_t>(rank())));
  of_rank.shuffle(global);
  piece.global = global;
  std::vector<std::int32_t> number(vertices, -1);
  for (std::size_t i = 0; i < global.size(); ++i) {
    number[static_cast<std::size_t>(global[i])] = static_cast<std::int32_t>(i);
    piece.ids.push_back(global[i]);
  }
  of_rank.shuffle(own);
  for (const std::size_t t : own) {
    const auto& [a, b, c] = mesh.mesh.triangles[t];
    piece.triangles.push_back({number[static_cast<std::size_t>(a)], number[static_cast<std::size_t>(b)],
                               number[static_cast<std::size_t>(c)]});
    piece.ghosts.push_back(rank_of_triangle[t] == rank() ? 0 : 1);
    piece.triangle_ids.push_back(static_cast<std::int64_t>(t));
    if (!mesh.regions.empty()) {
      piece.regions.push_back(mesh.regions[t]);
    }
  }
  if (cut != Cut::in_strips) {
    piece.owners = piece.local(owner);
  }
  if (!mesh.fixed.empty()) {
    piece.fixed = piece.local(mesh.fixed);
  }
  if (!mesh.other_cells.empty()) {
    piece.other_cells = piece.local(mesh.other_cells);
  }
  for (const std::int32_t v : mesh.fixed_ids) {
    if (const std::int32_t local = number[static_cast<std::size_t>(v)]; local >= 0) {
      piece.fixed_ids.push_back(local);
    }
  }
  for (const std::int32_t v : global) {
    const auto& p = mesh.mesh.points[static_cast<std::size_t>(v)];
    piece.xy.insert(piece.xy.end(), {p.x, p.y});
  }
  return piece;
}

Piece plain_piece(const RandomMesh& mesh, const std::vector<int>& rank_of_triangle) {
  const auto vertices = static_cast<std::size_t>(mesh.mesh.vertex_count());
  std::vector<std::uint8_t> is_here(vertices, rank() == 0 ? 1 : 0);
  const auto mark = [&](bool own, std::uint8_t value) {
    for (std::size_t t = 0; t < mesh.mesh.triangles.size(); ++t) {
      for (const std::int32_t v : mesh.mesh.triangles[t]) {
        if ((rank_of_triangle[t] == rank()) == own) {
          is_here[static_cast<std::size_t>(v)] = value;
        }
      }
    }
  };
  mark(false, 0);
  mark(true, 1);
  Piece piece;
  std::vector<std::int32_t> number(vertices, -1);
  for (std::size_t v = 0; v < vertices; ++v) {
    if (is_here[v] != 0) {
      number[v] = static_cast<std::int32_t>(piece.global.size());
      piece.global.push_back(static_cast<std::int32_t>(v));
      piece.ids.push_back(static_cast<std::int64_t>(v));
      piece.xy.insert(piece.xy.end(), {mesh.mesh.points[v].x, mesh.mesh.points[v].y});
    }
  }
  for (std::size_t t = 0; t < mesh.mesh.triangles.size(); ++t) {
    if (rank_of_triangle[t] == rank()) {
      const auto& [a, b, c] = mesh.mesh.triangles[t];
      piece.triangles.push_back({number[static_cast<std::size_t>(a)], number[static_cast<std::size_t>(b)],
                                 number[static_cast<std::size_t>(c)]});
      piece.triangle_ids.push_back(static_cast<std::int64_t>(t));
    }
  }
  return piece;
}

bool say_the_same(const std::string& own) {
  auto length = static_cast<int>(own.size());
  MPI_Bcast(&length, 1, MPI_INT, 0, MPI_COMM_WORLD);
  std::string first = own;
  first.resize(static_cast<std::size_t>(length));
  MPI_Bcast(first.data(), length, MPI_CHAR, 0, MPI_COMM_WORLD);
  int is_same = first == own ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &is_same, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  return is_same != 0;
}

std::string said_by_any(const std::string& own) {
  int speaker = own.empty() ? ranks() : rank();
  MPI_Allreduce(MPI_IN_PLACE, &speaker, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  if (speaker == ranks()) {
    return {};
  }
  std::string said = own;
  auto length = static_cast<int>(said.size());
  MPI_Bcast(&length, 1, MPI_INT, speaker, MPI_COMM_WORLD);
  said.resize(static_cast<std::size_t>(length));
  MPI_Bcast(said.data(), length, MPI_CHAR, speaker, MPI_COMM_WORLD);
  return "rank " + std::to_string(speaker) + ": " + said;
}

}  // namespace mpi_tests
