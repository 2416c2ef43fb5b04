// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "trismooth/base/element_list.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/storage.h"
#include "trismooth/mpi/communicator.h"
#include "trismooth/mpi/overlap.h"
#include "trismooth/pipeline/ranks/piece_files.h"
#include "trismooth/pipeline/ranks/shared_numbers.h"
#include "trismooth/smoothing/options.h"

namespace trismooth {

/// What a rank has of a mesh in pieces: its pieces, with the vertices once that several of them have. Where the rank
/// has one piece, most of this is the piece's own; pieces outlive it.
struct RankMesh {
  RankMesh() = default;
  RankMesh(RankMesh&&) = default;
  RankMesh& operator=(RankMesh&&) = default;
  RankMesh(const RankMesh&) = delete;
  RankMesh& operator=(const RankMesh&) = delete;
  ~RankMesh() = default;

  SharedNumbers ids;                          ///< of the vertices in the whole mesh, ascending
  std::vector<std::uint8_t> in_other_cell;    ///< one a vertex: 1 where a cell that is no element uses it
  ElementList elements;                       ///< of piece after piece, copies of other pieces' too
  OwnElements joined_elements;                ///< where these are not those of the piece
  std::vector<std::uint8_t> ghost_triangles;  ///< one an element: 1 where it is such a copy; empty: there are none
  SharedNumbers triangle_ids;                 ///< their numbers in the whole mesh, ascending; empty: as they come
  Storage storage = Storage::float64;         ///< what coordinates are rounded to in the files

  bool is_ghost(std::size_t element) const { return !ghost_triangles.empty() && ghost_triangles[element] != 0; }
};

/// What of a mesh keeps it from being put together in pieces, for people: quadrilaterals that are to be smoothed, where
/// these options do that of whole meshes alone, elements with nodes in the middle of their sides, heights that differ.
/// Empty where nothing does. Collective.
std::string_view what_is_not_joined(const PieceFiles& files, const SmoothingOptions& options,
                                    const mpi::Communicator& ranks);

/// Whether the vertices of the rank's pieces are numbered from 0 on, with no number missing. A mesh that is gathered
/// is; where ids are missing, that is another mesh. Local.
bool are_numbered_without_gaps(const PieceFiles& files);

/// Puts the rank's pieces, of which what_is_not_joined() says nothing, together, and numbers their points
/// (Piece::vertices). Points of the pieces' planar meshes, which the documents have, are given up. Collective. Throws
/// ReadError on all ranks for more than 32 bits number.
RankMesh join_pieces(PieceFiles& files, const mpi::Communicator& ranks);

/// x, y, z of the rank's vertices, as the pieces have them. Local.
std::vector<std::array<double, 3>> places_of(const PieceFiles& files, const RankMesh& mesh);

/// x and y of the rank's vertices, as the pieces have them. Local.
std::vector<Point2<double>> points_of(const PieceFiles& files, const RankMesh& mesh);

/// Gives a point the coordinates that changed: equal ones stay as they are stored. Local.
void move_point(double& x, double& y, Point2<double> to);

/// Gives the points of all pieces of the rank the coordinates that changed, one a vertex of the rank's mesh: equal ones
/// stay as they are stored. Local.
void move_points(PieceFiles& files, std::span<const Point2<double>> points);

}  // namespace trismooth
