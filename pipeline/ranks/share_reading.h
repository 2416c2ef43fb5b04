// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <optional>

#include "trismooth/base/machine/workers.h"
#include "trismooth/mesh_io/ranges/number_range.h"
#include "trismooth/mpi/communicator.h"
#include "trismooth/pipeline/ranks/mesh_share.h"

namespace trismooth {

/// Calls `work` on every rank, which is to do nothing collective; true on all ranks where it answers true and throws
/// nothing on any. What it throws is for whoever reads the file in another way to find again, and to say.
/// Collective.
template <class Work>
bool works_on_all(const mpi::Communicator& ranks, const Work& work) {
  bool works = false;
  try {
    works = work();
  } catch (const std::exception&) {
    works = false;
  }
  return !ranks.any(!works);
}

/// Which of `count` things are a rank's: equally many for all but for one. Local.
inline NumberRange range_of_rank(std::uint64_t count, const mpi::Communicator& ranks) {
  const auto size = static_cast<std::uint64_t>(ranks.size());
  const auto rank = static_cast<std::uint64_t>(ranks.rank());
  const std::uint64_t length = count / size;
  const std::uint64_t longer = count % size;
  const std::uint64_t first = rank * length + std::min(rank, longer);
  return {first, first + length + (rank < longer ? 1 : 0)};
}

/// Reads this rank's share of a file, if it is of a kind that can be read by ranges; nothing on all ranks where it is
/// not, or where anything in it is unusual or wrong: the file is to be read whole then. Collective; throws nothing of
/// the file.
std::optional<MeshShare> read_share(const std::filesystem::path& path, const mpi::Communicator& ranks,
                                    Workers& workers);

/// read_share() of an OFF text. A rank's lines are those that begin in its part of the bytes. Collective.
std::optional<MeshShare> read_off_share(const std::filesystem::path& path, const mpi::Communicator& ranks,
                                        Workers& workers);

/// read_share() of a binary MSH file. Collective.
std::optional<MeshShare> read_msh_share(const std::filesystem::path& path, const mpi::Communicator& ranks,
                                        Workers& workers);

/// read_share() of a .vtu file whose arrays are raw in the appended section. Collective.
std::optional<MeshShare> read_vtu_share(const std::filesystem::path& path, const mpi::Communicator& ranks,
                                        Workers& workers);

}  // namespace trismooth
