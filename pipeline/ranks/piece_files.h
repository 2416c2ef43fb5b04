// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "trismooth/base/machine/workers.h"
#include "trismooth/mesh_io/bytes/output_file.h"
#include "trismooth/mesh_io/parallel_file.h"
#include "trismooth/mpi/communicator.h"
#include "trismooth/pipeline/pipeline.h"
#include "trismooth/pipeline/ranks/piece.h"

namespace trismooth {

/// An array that every piece has that holds anything.
struct PieceArray {
  enum class Of : std::uint8_t { coordinates, points, cells };

  Of of = Of::points;
  ScalarType type = ScalarType::float64;
  std::uint64_t components = 1;
  std::string name;
  bool is_added = false;  ///< by this program, which the file does not have

  bool operator==(const PieceArray&) const = default;
};

/// A parallel file and the pieces of it that this rank has: contiguous blocks of pieces, one after the other.
struct PieceFiles {
  std::filesystem::path path;
  std::string bytes;  ///< of the parallel file
  ParallelFile file;
  std::vector<PieceArray> arrays;  ///< in the order of the first piece that holds anything; known to all ranks
  std::deque<Piece> pieces;
  bool was_read_whole = false;  ///< by rank 0, so what sets and markers of points hold is known
  bool have_labels = false;     ///< the pieces themselves give points their numbers in the whole mesh
  /// Of one file that was handed out: the numbers in it of points that the user names by labels, on rank 0.
  std::vector<std::int64_t> labelled;

  /// Whether pieces know the numbers of cells in the one file that they are of. Local.
  bool know_cell_ids() const {
    return std::ranges::any_of(pieces, [](const Piece& piece) { return !piece.cell_ids.empty(); });
  }
  /// The file of a piece, by its number among those of the parallel file. Local.
  std::filesystem::path path_of(std::size_t piece) const { return piece_path(path, file.pieces[piece].source); }
};

/// The coordinates and the arrays of a piece. Local.
std::vector<PieceArray> arrays_of_piece(const MeshDocument& document);

/// Reads it, and checks that all pieces have the same arrays. `quads`: what becomes of quadrilaterals. Collective.
/// Throws ReadError on all ranks.
PieceFiles read_pieces(const std::filesystem::path& path, Quads quads, const mpi::Communicator& ranks,
                       Workers& workers);

/// Where the pieces of `output` are to be, from its folder: those of the input itself where it is written back, else
/// new files beside `output`, called after it. Local.
std::vector<std::string> output_sources(const PieceFiles& files, const std::filesystem::path& output);

/// The same as paths that can be opened. Local.
std::vector<std::filesystem::path> output_pieces(const PieceFiles& files, const std::filesystem::path& output);

/// Throws std::invalid_argument where writing the pieces of `output`, or `output` itself where it is a `single` file,
/// would overwrite those of another file, the input. Local.
void require_own_pieces(const PieceFiles& files, const std::filesystem::path& output, bool single);

/// Writes the pieces with their points as they are now and with Piece::added, and the parallel file, of which no other
/// annotations are listed: all of them beside their targets first, then, when every rank has done so, in their places,
/// the parallel file last. In between `completed`, which is collective, gives the result, which `beside` is told by
/// rank 0, and what that has prepared takes its place. Collective. Throws WriteError on all ranks, and what `beside`
/// throws; whatever stood there survives that.
void write_pieces(PieceFiles& files, const std::filesystem::path& output, const mpi::Communicator& ranks,
                  Workers& workers, const std::function<const PipelineResult&()>& completed,
                  const BesideOutput& beside);

/// Takes annotations of an earlier run out of all pieces, and has none of them be written. Answers their names, those
/// of cells first, the same on all ranks. Local.
std::vector<std::string> drop_annotations(PieceFiles& files);

/// Has rank 0 tell `beside` the result. Collective. Throws what `beside` throws, on all ranks.
void prepare_beside(const BesideOutput& beside, const PipelineResult& result, const mpi::Communicator& ranks);

}  // namespace trismooth
