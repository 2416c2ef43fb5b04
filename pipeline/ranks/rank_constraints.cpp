#include "trismooth/pipeline/ranks/rank_constraints.h"

#include <algorithm>

#include <mpi.h>

#include "trismooth/mesh_io/document/array_names.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/pipeline/input/fixed_array.h"
#include "trismooth/pipeline/ranks/agreement.h"

namespace trismooth {

namespace {

/// As find_fixed_array() chooses it, on ranks without pieces too.
std::string name_of_fixed_array(const PieceFiles& files, const std::optional<std::string>& name) {
  std::vector<DataArray> names;
  for (const PieceArray& array : files.arrays) {
    if (array.of == PieceArray::Of::points && !array.is_added) {
      names.emplace_back().name = array.name;
    }
  }
  const DataArray* const array = find_array_loosely(names, name.value_or("fixed"));
  return array == nullptr ? std::string() : array->name;
}

void hold_by_array(const PieceFiles& files, const std::optional<std::string>& name, RankConstraints& constraints) {
  for (const Piece& piece : files.pieces) {
    if (piece.document.point_count() == 0) {
      continue;  // which may lack arrays
    }
    const FixedArray fixed = find_fixed_array(piece.document, name);
    for (std::size_t i = 0; i < fixed.flags.size(); ++i) {
      constraints.by_array[static_cast<std::size_t>(piece.vertices[i])] |= fixed.flags[i];
    }
  }
}

void hold_by_sets(const PieceFiles& files, RankConstraints& constraints) {
  for (const Piece& piece : files.pieces) {
    for (std::size_t i = 0; i < piece.held_by_sets.size(); ++i) {
      constraints.named[static_cast<std::size_t>(piece.vertices[i])] |= piece.held_by_sets[i];
    }
  }
}

/// Different numbers, ascending, on all ranks.
std::vector<std::int64_t> read_numbers(const std::filesystem::path& path, const RankMesh& mesh,
                                       const mpi::Communicator& ranks) {
  std::int64_t highest = mesh.ids.empty() ? -1 : mesh.ids[mesh.ids.size() - 1];
  MPI_Allreduce(MPI_IN_PLACE, &highest, 1, MPI_INT64_T, MPI_MAX, ranks.handle());
  std::vector<std::int64_t> numbers;
  agree(ranks, [&] {
    if (ranks.rank() == 0) {
      numbers = read_vertex_numbers(path, highest + 1);
      std::ranges::sort(numbers);
      numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    }
  });
  ranks.broadcast(numbers);
  return numbers;
}

void hold_by_numbers(const std::filesystem::path& path, const RankMesh& mesh, const mpi::Communicator& ranks,
                     RankConstraints& constraints) {
  const std::vector<std::int64_t> numbers = read_numbers(path, mesh, ranks);
  std::vector<std::uint8_t> is_known(numbers.size(), 0);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto place = std::ranges::lower_bound(mesh.ids, numbers[i]);
    if (place != mesh.ids.end() && *place == numbers[i]) {
      is_known[i] = 1;
      constraints.named[static_cast<std::size_t>(place - mesh.ids.begin())] = 1;
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, is_known.data(), static_cast<int>(is_known.size()), MPI_UINT8_T, MPI_MAX, ranks.handle());
  agree(ranks, [&] {
    const auto unknown = std::ranges::find(is_known, 0);
    if (unknown != is_known.end()) {
      throw unknown_vertex(path, numbers[static_cast<std::size_t>(unknown - is_known.begin())]);
    }
  });
  constraints.listed = std::ssize(numbers);
}

}  // namespace

ReadError unknown_vertex(const std::filesystem::path& path, std::int64_t id) {
  return {path, "names vertex " + std::to_string(id) + ", and no piece has a point of that global id"};
}

RankConstraints find_rank_constraints(const PieceFiles& files, const RankMesh& mesh,
                                      const std::optional<std::string>& fixed_array,
                                      const std::optional<std::filesystem::path>& fixed_ids,
                                      const mpi::Communicator& ranks) {
  RankConstraints constraints;
  constraints.fixed_array = name_of_fixed_array(files, fixed_array);
  constraints.by_array.assign(mesh.ids.size(), 0);
  agree(ranks, [&] { hold_by_array(files, fixed_array, constraints); });
  constraints.named = constraints.by_array;
  hold_by_sets(files, constraints);
  if (fixed_ids) {
    hold_by_numbers(*fixed_ids, mesh, ranks, constraints);
  }
  return constraints;
}

}  // namespace trismooth
