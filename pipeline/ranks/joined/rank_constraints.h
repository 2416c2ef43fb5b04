// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/pipeline/pipeline.h"
#include "trismooth/pipeline/ranks/joined/rank_mesh.h"
#include "trismooth/pipeline/ranks/piece_files.h"

namespace trismooth {

/// The vertices of a label (SetLabel) that the user holds.
struct LabelledVertices {
  std::string name;
  std::vector<std::uint8_t> flags;  ///< one a vertex of the rank's mesh; joined over the ranks they are right
};

/// The vertices that the user holds, of those that the rank has.
struct RankConstraints {
  std::string fixed_array;             ///< the point array that was obeyed, or empty
  std::vector<std::uint8_t> by_array;  ///< one flag a vertex of the rank's mesh
  std::vector<std::uint8_t> named;     ///< by_array, by a set of the file, or in the file of numbers
  std::int64_t listed = 0;             ///< different numbers in that file
  std::vector<LabelledVertices> sets;  ///< of PipelineOptions::fixed_sets, each once
};

/// The numbers in the whole mesh of the vertices that PipelineOptions::fixed_ids names, which is there, by these or by
/// labels: different ones, ascending. `end`: behind the highest that there is. Of rank 0. Throws ReadError, and
/// std::invalid_argument where the pieces have no labels.
std::vector<std::int64_t> read_held_numbers(const PieceFiles& files, const PipelineOptions& options, std::int64_t end);

/// The error of such a file that names a vertex which no piece has.
ReadError unknown_vertex(const PipelineOptions& options, std::int64_t id);

/// Finds them: by the point array `fixed_array` as find_fixed_array() does, by labels of sets in pieces, and by the
/// file `fixed_ids`, which rank 0 reads. Collective. Throws std::invalid_argument and ReadError on all ranks.
RankConstraints find_rank_constraints(const PieceFiles& files, const RankMesh& mesh, const PipelineOptions& options,
                                      const mpi::Communicator& ranks);

}  // namespace trismooth
