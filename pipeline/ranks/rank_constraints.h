#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/pipeline/ranks/piece_files.h"
#include "trismooth/pipeline/ranks/rank_mesh.h"

namespace trismooth {

/// The vertices that the user holds, of those that the rank has.
struct RankConstraints {
  std::string fixed_array;             ///< the point array that was obeyed, or empty
  std::vector<std::uint8_t> by_array;  ///< one flag a vertex of the rank's mesh
  std::vector<std::uint8_t> named;     ///< by_array, by a set of the file, or in the file of numbers
  std::int64_t listed = 0;             ///< different numbers in that file
};

/// The error of a file that names a vertex which no piece has.
ReadError unknown_vertex(const std::filesystem::path& path, std::int64_t id);

/// Finds them: by the point array `fixed_array` as find_fixed_array() does, and by the file `fixed_ids` of numbers in
/// the whole mesh, which rank 0 reads. Collective. Throws std::invalid_argument and ReadError on all ranks.
RankConstraints find_rank_constraints(const PieceFiles& files, const RankMesh& mesh,
                                      const std::optional<std::string>& fixed_array,
                                      const std::optional<std::filesystem::path>& fixed_ids,
                                      const mpi::Communicator& ranks);

}  // namespace trismooth
