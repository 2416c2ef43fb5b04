// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/mpi/communicator.h"
#include "trismooth/pipeline/ranks/piece_files.h"

namespace trismooth {

/// A mesh in pieces as one document, which rank 0 has: the one place where a rank holds the whole mesh. Its points are
/// in the order of their ids, its cells in that of their numbers, copies left out; a point that several pieces have is
/// the one of the lowest piece that has a cell of its own there. Arrays are those that all pieces have, but for what
/// marks copies, and those of the whole mesh (fields) that are the same in all pieces.
class WholeMesh {
 public:
  /// Piece::ids are known. Where there is one rank, and one piece that is the mesh as it stands, the piece's document
  /// is without points, cells and arrays until hand_back(). Collective. Throws ReadError on all ranks for more points
  /// or cells than 32 bits number. Complexity: n log n in the whole mesh on rank 0, in what they have on the others.
  WholeMesh(PieceFiles& files, const mpi::Communicator& ranks);

  MeshDocument document;          ///< empty on other ranks, as `ids` is
  std::vector<std::int64_t> ids;  ///< of the document's points, ascending

  /// Gives the points of all pieces the coordinates that the document has now, and the values of these point arrays,
  /// and all pieces what is added to the document, which rank 0 has (Piece::added). Copies of cells get what their
  /// cells have, those of which no piece has the cell zeros. Collective. Complexity: linear, and n log n in the cells
  /// where there are copies of some.
  void hand_back(PieceFiles& files, std::span<const std::string> point_arrays, const AddedArrays& added,
                 const mpi::Communicator& ranks);

 private:
  /// A vertex of the rank, and the point that stands for it.
  struct RankVertex {
    std::int64_t id;
    std::uint8_t is_copy;  ///< 1 where no cell of the piece's own has it
    std::int32_t piece;    ///< its place among those of the rank
    std::int32_t point;
  };

  /// Points, cells and arrays.
  void exchange_with(MeshDocument& of_piece);
  void find_vertices(const PieceFiles& files);
  void number_points(const PieceFiles& files, const mpi::Communicator& ranks);
  void gather_points(const PieceFiles& files, const mpi::Communicator& ranks);
  void gather_cells(const PieceFiles& files, const mpi::Communicator& ranks);
  void gather_arrays(const PieceFiles& files, const mpi::Communicator& ranks);
  void gather_fields(const PieceFiles& files, const mpi::Communicator& ranks);
  /// On rank 0: which cells of the document those of the pieces of each rank are, copies too; one behind the last:
  /// none.
  mpi::ByRank<std::int32_t> cells_of_ranks(const PieceFiles& files, const mpi::Communicator& ranks) const;
  std::vector<std::int32_t> cells_of_copies(std::span<const std::int32_t> copies, std::size_t rank) const;

  bool is_of_piece_ = false;                            ///< from the only piece
  std::vector<RankVertex> vertices_;                    ///< of this rank, ascending by id
  std::vector<std::vector<std::int32_t>> vertices_of_;  ///< for each piece and point: its place in vertices_
  mpi::ByRank<std::int32_t> places_;                    ///< on rank 0: the points of the vertices of each rank
  mpi::ByRank<std::uint8_t> is_taken_;                  ///< on rank 0: 1 where that rank says what the point has
  std::vector<std::size_t> cell_order_;                 ///< on rank 0: of cells as they come; empty: they stay so
};

}  // namespace trismooth
