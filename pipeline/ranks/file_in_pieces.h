// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "trismooth/base/machine/workers.h"
#include "trismooth/mpi/communicator.h"
#include "trismooth/pipeline/pipeline.h"
#include "trismooth/pipeline/ranks/mesh_share.h"
#include "trismooth/pipeline/ranks/piece_files.h"

namespace trismooth {

/// How a file of one mesh may be read.
enum class FileReading : std::uint8_t {
  any,       ///< by ranges, or else by rank 0, which has the whole mesh for a while
  by_ranges  ///< in no other way
};

/// A file of one mesh, shared out among the ranks: one piece for each.
struct FileInPieces {
  PieceFiles files;
  InputSummary input;              ///< path, format and the groups that the file names
  std::vector<std::string> notes;  ///< what the reader has to say, on all ranks
  std::vector<std::string> losses;
  std::vector<std::string> arrays_of_places;  ///< MeshDocument::arrays_of_places, on all ranks
};

/// Throws ReadError naming the file of the options where it has what a mesh in pieces may not have yet. Local.
void require_carried(const PipelineOptions& options, const MeshDocument& document);

/// Shares out what the ranks have of the file of the options, as their PipelineOptions::written() wants it. Collective.
/// Throws on all ranks ReadError for more than 32 bits number, std::invalid_argument for cells that .pvtp does not
/// hold.
FileInPieces put_in_pieces(MeshShare share, const PipelineOptions& options, const mpi::Communicator& ranks,
                           Workers& workers);

/// Reads the file of the options, by ranges where that can be done (see read_share()), else on rank 0, which hands out
/// what it has read. Collective. Throws on all ranks ReadError as read_mesh() does and std::invalid_argument as the
/// stages of run_pipeline() do.
FileInPieces read_in_pieces(const PipelineOptions& options, FileReading reading, const mpi::Communicator& ranks,
                            Workers& workers);

}  // namespace trismooth
