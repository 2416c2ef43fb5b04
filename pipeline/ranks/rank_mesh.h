#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/base/storage.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/mpi/communicator.h"
#include "trismooth/pipeline/ranks/piece_files.h"

namespace trismooth {

/// What a rank has of a mesh in pieces: its pieces, with the vertices once that several of them have.
struct RankMesh {
  std::vector<std::int64_t> ids;              ///< of the vertices in the whole mesh, ascending
  std::vector<std::array<double, 3>> stored;  ///< their coordinates as they were read
  std::vector<std::uint8_t> in_other_cell;    ///< one a vertex: 1 where a cell that is not a triangle uses it
  std::vector<Triangle> triangles;            ///< of piece after piece, copies of other pieces' too
  std::vector<std::uint8_t> ghost_triangles;  ///< one a triangle: 1 where it is such a copy
  std::vector<std::int64_t> triangle_ids;     ///< their numbers in the whole mesh, ascending; empty: as they come
  Storage storage = Storage::float64;         ///< what coordinates are rounded to in the files

  std::vector<Point2<double>> points() const;
};

/// What of a mesh keeps it from being put together in pieces, for people: triangles of six nodes, heights that differ.
/// Empty where nothing does. Collective.
std::string_view what_is_not_joined(const PieceFiles& files, const mpi::Communicator& ranks);

/// Puts the rank's pieces together, and numbers their points (Piece::vertices). Collective. Throws ReadError on all
/// ranks for a mesh that does not lie in a plane z = constant, std::invalid_argument for triangles of six nodes.
RankMesh join_pieces(PieceFiles& files, const mpi::Communicator& ranks);

/// Gives the points of pieces the coordinates that changed.
void move_points(PieceFiles& files, const RankMesh& mesh, const std::vector<Point2<double>>& points);

}  // namespace trismooth
