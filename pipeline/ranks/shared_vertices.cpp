// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/shared_vertices.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "trismooth/base/splitmix64.h"
#include "trismooth/base/text/digits.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mpi/directory.h"
#include "trismooth/pipeline/ranks/agreement.h"

namespace trismooth {

namespace {

struct VertexCopy {
  std::int64_t id;
  std::array<double, 3> place;
  std::int64_t piece;
};

struct TriangleCopy {
  std::array<std::int64_t, 3> corners;  ///< ascending
  std::int64_t piece;
  std::int64_t cell;
};

std::string text_of_place(const std::array<double, 3>& place) {
  return "(" + shortest_digits(place[0]) + ", " + shortest_digits(place[1]) + ", " + shortest_digits(place[2]) + ")";
}

bool have_same_bits(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return std::ranges::equal(
      a, b, {}, [](double x) { return std::bit_cast<std::uint64_t>(x); },
      [](double x) { return std::bit_cast<std::uint64_t>(x); });
}

/// For every point of this rank's pieces, one flag: 1 where several pieces have its vertex.
std::vector<std::uint8_t> shared_points(const PieceFiles& files, const mpi::Communicator& ranks) {
  auto sent = mpi::lists_by_rank<VertexCopy>(ranks);
  std::vector<std::size_t> homes;
  for (const Piece& piece : files.pieces) {
    for (std::size_t i = 0; i < piece.ids.size(); ++i) {
      const double* const xyz = piece.document.points.data() + 3 * i;
      homes.push_back(static_cast<std::size_t>(mpi::home_of(piece.ids[i], ranks)));
      sent[homes.back()].push_back({piece.ids[i], {xyz[0], xyz[1], xyz[2]}, static_cast<std::int64_t>(piece.number)});
    }
  }
  const mpi::ByRank<VertexCopy> heard = ranks.exchanged(sent);
  sent = {};
  auto answers = mpi::lists_by_rank<std::uint8_t>(ranks);
  agree(ranks, [&] {
    std::vector<std::pair<std::size_t, std::size_t>> order;  // rank and place in its list
    for (std::size_t r = 0; r < heard.size(); ++r) {
      answers[r].assign(heard[r].size(), 0);
      for (std::size_t i = 0; i < heard[r].size(); ++i) {
        order.emplace_back(r, i);
      }
    }
    const auto copy_of = [&](const auto& at) -> const VertexCopy& { return heard[at.first][at.second]; };
    std::ranges::sort(order, [&](const auto& a, const auto& b) {
      return std::tie(copy_of(a).id, copy_of(a).piece) < std::tie(copy_of(b).id, copy_of(b).piece);
    });
    for (std::size_t i = 1; i < order.size(); ++i) {
      const VertexCopy& a = copy_of(order[i - 1]);
      const VertexCopy& b = copy_of(order[i]);
      if (a.id != b.id) {
        continue;
      }
      if (!have_same_bits(a.place, b.place)) {
        throw ReadError(files.path_of(static_cast<std::size_t>(b.piece)),
                        "the vertex of global id " + std::to_string(b.id) + " is at " + text_of_place(b.place) +
                            ", and in " + files.path_of(static_cast<std::size_t>(a.piece)).string() + " at " +
                            text_of_place(a.place) + "; pieces must agree to the bit");
      }
      answers[order[i - 1].first][order[i - 1].second] = 1;
      answers[order[i].first][order[i].second] = 1;
    }
  });
  const mpi::ByRank<std::uint8_t> told = ranks.exchanged(answers);
  std::vector<std::size_t> next(told.size(), 0);
  std::vector<std::uint8_t> is_shared(homes.size());
  std::ranges::transform(homes, is_shared.begin(), [&](std::size_t home) { return told[home][next[home]++]; });
  return is_shared;
}

/// Throws ReadError where two pieces have a triangle and neither calls it a ghost.
void check_repeated_triangles(const PieceFiles& files, const std::vector<std::uint8_t>& is_shared,
                              const mpi::Communicator& ranks) {
  auto sent = mpi::lists_by_rank<TriangleCopy>(ranks);
  std::size_t first_point = 0;
  for (const Piece& piece : files.pieces) {
    for (std::size_t t = 0; t < piece.mesh.elements.triangles().size(); ++t) {
      const Triangle& corners = piece.mesh.elements.triangles()[t];
      const bool is_between = std::ranges::all_of(
          corners, [&](std::int32_t v) { return is_shared[first_point + static_cast<std::size_t>(v)] != 0; });
      if (!is_between || piece.is_ghost(t)) {
        continue;
      }
      TriangleCopy copy{{}, static_cast<std::int64_t>(piece.number), piece.mesh.cells[t]};
      std::ranges::transform(corners, copy.corners.begin(),
                             [&](std::int32_t v) { return piece.ids[static_cast<std::size_t>(v)]; });
      std::ranges::sort(copy.corners);
      sent[static_cast<std::size_t>(mpi::home_of(copy.corners[0], ranks))].push_back(copy);
    }
    first_point += piece.ids.size();
  }
  const mpi::ByRank<TriangleCopy> heard = ranks.exchanged(sent);
  agree(ranks, [&] {
    std::vector<TriangleCopy> copies;
    for (const auto& of_rank : heard) {
      copies.insert(copies.end(), of_rank.begin(), of_rank.end());
    }
    std::ranges::sort(copies, [](const TriangleCopy& a, const TriangleCopy& b) {
      return std::tie(a.corners, a.piece, a.cell) < std::tie(b.corners, b.piece, b.cell);
    });
    for (std::size_t i = 1; i < copies.size(); ++i) {
      const TriangleCopy& a = copies[i - 1];
      const TriangleCopy& b = copies[i];
      if (a.corners == b.corners && a.piece != b.piece) {
        throw ReadError(files.path_of(static_cast<std::size_t>(b.piece)),
                        "cell " + std::to_string(b.cell) + " is cell " + std::to_string(a.cell) + " of " +
                            files.path_of(static_cast<std::size_t>(a.piece)).string() +
                            " as well; copies are to be marked as such by the cell array vtkGhostType");
      }
    }
  });
}

}  // namespace

void check_shared_vertices(const PieceFiles& files, const mpi::Communicator& ranks) {
  check_repeated_triangles(files, shared_points(files, ranks), ranks);
}

}  // namespace trismooth
