#include "trismooth/pipeline/ranks/rank_mesh.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>

#include "trismooth/base/digits.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/pipeline/ranks/agreement.h"

namespace trismooth {

namespace {

bool has_six_nodes(const Piece& piece) {
  return !piece.mesh.quadratics.empty();
}

void require_straight(const PieceFiles& files) {
  const auto piece = std::ranges::find_if(files.pieces, &has_six_nodes);
  if (piece != files.pieces.end()) {
    throw std::invalid_argument(piece->path.string() +
                                ": holds triangles of six nodes, which are not smoothed in pieces; --gather has rank 0 "
                                "do that, with the whole mesh in its memory");
  }
}

/// The z of the vertices that cells use, from the lowest to the highest.
struct Heights {
  double lowest;
  double highest;

  bool differ() const { return lowest < highest; }
};

Heights heights_of(const PieceFiles& files, const mpi::Communicator& ranks) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  PartSums range;
  range.largest = {-infinity, -infinity};
  for (const Piece& piece : files.pieces) {
    for (std::size_t v = 0; v < piece.mesh.in_cell.size(); ++v) {
      if (piece.mesh.in_cell[v] != 0) {
        const double z = piece.document.points[3 * v + 2];
        range.largest = {std::max(range.largest[0], z), std::max(range.largest[1], -z)};
      }
    }
  }
  range = ranks.joined(range);
  return {-range.largest[1], range.largest[0]};
}

void require_one_height(const PieceFiles& files, const mpi::Communicator& ranks) {
  const Heights heights = heights_of(files, ranks);
  agree(ranks, [&] {
    if (heights.differ()) {
      throw ReadError(files.path, "z is " + shortest_digits(heights.lowest) + " to " +
                                      shortest_digits(heights.highest) +
                                      "; in pieces a mesh is smoothed that lies in a plane z = constant; --gather has "
                                      "rank 0 smooth others, with the whole mesh in its memory");
    }
  });
}

Storage storage_of_pieces(const PieceFiles& files, const mpi::Communicator& ranks) {
  const bool has_float32 = std::ranges::any_of(files.pieces, [](const Piece& piece) {
    return piece.document.point_count() > 0 && storage_of(piece.document) == Storage::float32;
  });
  return ranks.any(has_float32) ? Storage::float32 : Storage::float64;
}

}  // namespace

std::vector<Point2<double>> RankMesh::points() const {
  std::vector<Point2<double>> points(stored.size());
  std::ranges::transform(stored, points.begin(), [](const auto& xyz) { return Point2<double>{xyz[0], xyz[1]}; });
  return points;
}

std::string_view what_is_not_joined(const PieceFiles& files, const mpi::Communicator& ranks) {
  if (ranks.any(std::ranges::any_of(files.pieces, &has_six_nodes))) {
    return "triangles of six nodes";
  }
  return heights_of(files, ranks).differ() ? "a mesh that lies in no plane z = constant" : "";
}

RankMesh join_pieces(PieceFiles& files, const mpi::Communicator& ranks) {
  agree(ranks, [&] { require_straight(files); });
  require_one_height(files, ranks);
  RankMesh mesh;
  mesh.storage = storage_of_pieces(files, ranks);
  agree(ranks, [&] {
    for (const Piece& piece : files.pieces) {
      mesh.ids.insert(mesh.ids.end(), piece.ids.begin(), piece.ids.end());
    }
    std::ranges::sort(mesh.ids);
    mesh.ids.erase(std::unique(mesh.ids.begin(), mesh.ids.end()), mesh.ids.end());
    check_document_size(mesh.ids.size(), 0, files.path);
    mesh.stored.resize(mesh.ids.size());
    mesh.in_other_cell.assign(mesh.ids.size(), 0);
    for (Piece& piece : files.pieces) {
      piece.vertices.resize(piece.ids.size());
      for (std::size_t i = 0; i < piece.ids.size(); ++i) {
        const auto v = static_cast<std::size_t>(std::ranges::lower_bound(mesh.ids, piece.ids[i]) - mesh.ids.begin());
        piece.vertices[i] = static_cast<std::int32_t>(v);
        std::copy_n(piece.document.points.begin() + static_cast<std::ptrdiff_t>(3 * i), 3, mesh.stored[v].begin());
        mesh.in_other_cell[v] |= piece.mesh.in_other_cell[i];
      }
      for (std::size_t t = 0; t < piece.mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = piece.mesh.triangles[t];
        mesh.triangles.push_back({piece.vertices[static_cast<std::size_t>(a)],
                                  piece.vertices[static_cast<std::size_t>(b)],
                                  piece.vertices[static_cast<std::size_t>(c)]});
        mesh.ghost_triangles.push_back(piece.is_ghost(t) ? 1 : 0);
      }
      mesh.triangle_ids.insert(mesh.triangle_ids.end(), piece.triangle_ids.begin(), piece.triangle_ids.end());
    }
    check_document_size(0, mesh.triangles.size(), files.path);
  });
  return mesh;
}

void move_points(PieceFiles& files, const RankMesh& mesh, const std::vector<Point2<double>>& points) {
  for (Piece& piece : files.pieces) {
    for (std::size_t i = 0; i < piece.vertices.size(); ++i) {
      const auto v = static_cast<std::size_t>(piece.vertices[i]);
      if (!(points[v] == Point2<double>{mesh.stored[v][0], mesh.stored[v][1]})) {
        piece.document.points[3 * i] = points[v].x;
        piece.document.points[3 * i + 1] = points[v].y;
      }
    }
  }
}

}  // namespace trismooth
