// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/joined/rank_constraints.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include <mpi.h>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/pipeline/input/fixed_array.h"
#include "trismooth/pipeline/input/planar_mesh.h"
#include "trismooth/pipeline/input/point_sets.h"
#include "trismooth/pipeline/input/set_labels.h"
#include "trismooth/pipeline/ranks/agreement.h"
#include "trismooth/pipeline/ranks/shared_texts.h"

namespace trismooth {

namespace {

/// On ranks without pieces too. Throws as find_fixed_array() does.
std::string name_of_fixed_array(const PieceFiles& files, const std::optional<std::string>& name) {
  MeshDocument with_names;
  for (const PieceArray& array : files.arrays) {
    if (array.of == PieceArray::Of::points && !array.is_added) {
      with_names.point_arrays.emplace_back().name = array.name;
    }
  }
  return find_fixed_array(with_names, name).array;
}

void hold_by_array(const PieceFiles& files, RankConstraints& constraints) {
  for (const Piece& piece : files.pieces) {
    if (constraints.fixed_array.empty() || piece.document.point_count() == 0) {
      continue;  // which may lack arrays
    }
    const FixedArray fixed = find_fixed_array(piece.document, constraints.fixed_array);
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

/// The names of arrays that give labels, as label_arrays() has them, on ranks without pieces too.
std::vector<std::string> label_arrays_of(const PieceFiles& files) {
  std::vector<std::string> names;
  for (const PieceArray& array : files.arrays) {
    if (array.of != PieceArray::Of::coordinates && !array.is_added) {
      add_label_array(names, array.name, array.components);
    }
  }
  return names;
}

/// The lowest values that any piece has in the array. Collective.
std::vector<std::string> values_of_all(const PieceFiles& files, const std::string& array,
                                       const mpi::Communicator& ranks) {
  std::set<std::string> values;
  for (const Piece& piece : files.pieces) {
    std::ranges::move(label_values(piece.document, array), std::inserter(values, values.end()));
  }
  return texts_of_all(values, ranks);
}

/// The values of that name, of all arrays. Collective.
std::vector<SetLabel> meant_by(const PieceFiles& files, std::span<const std::string> arrays, const std::string& name,
                               const mpi::Communicator& ranks) {
  std::vector<SetLabel> meant;
  for (const std::string& array : arrays) {
    const auto has_points = [&](const Piece& piece) {
      const std::vector<std::uint8_t> flags = points_of_label(piece.document, {array, name}, piece.ghost_cells);
      return std::ranges::find(flags, 1) != flags.end();
    };
    if (ranks.any(std::ranges::any_of(files.pieces, has_points))) {
      meant.push_back({array, name});
    }
  }
  return meant;
}

/// The label of a name: nothing for `no_sets`. Collective. Throws std::invalid_argument on all ranks.
std::optional<SetLabel> label_of(const PieceFiles& files, std::span<const std::string> arrays, const std::string& name,
                                 const mpi::Communicator& ranks) {
  std::optional<SetLabel> label = find_label(arrays, name);
  if (label || name == no_sets) {
    return label;
  }
  const std::vector<SetLabel> meant = meant_by(files, arrays, name, ranks);
  if (is_bare_label(name, meant)) {
    return meant.front();
  }
  std::set<std::string> own;
  for (const Piece& piece : files.pieces) {
    std::ranges::move(names_of_values(piece.document), std::inserter(own, own.end()));
  }
  const std::vector<std::string> names = texts_of_all(own, ranks);
  agree(ranks, [&] { throw complain_of_set(name, names, arrays, meant); });
  return std::nullopt;
}

/// Of pieces: what one file holds by sets is known.
void hold_by_labels(const PieceFiles& files, const std::vector<std::string>& names, const mpi::Communicator& ranks,
                    RankConstraints& constraints) {
  const std::vector<std::string> arrays = label_arrays_of(files);
  for (const std::string& name : names) {
    const std::optional<SetLabel> label = label_of(files, arrays, name, ranks);
    if (!label || std::ranges::count(constraints.sets, label->name(), &LabelledVertices::name) != 0) {
      continue;
    }
    LabelledVertices set{label->name(), std::vector<std::uint8_t>(constraints.named.size(), 0)};
    for (const Piece& piece : files.pieces) {
      const std::vector<std::uint8_t> flags = points_of_label(piece.document, *label, piece.ghost_cells);
      for (std::size_t i = 0; i < flags.size(); ++i) {
        const auto v = static_cast<std::size_t>(piece.vertices[i]);
        set.flags[v] |= flags[i];
        constraints.named[v] |= flags[i];
      }
    }
    if (!ranks.any(std::ranges::count(set.flags, 1) > 0)) {
      const std::vector<std::string> values = values_of_all(files, label->array, ranks);
      agree(ranks, [&] { throw complain_of_value(*label, values); });
    }
    constraints.sets.push_back(std::move(set));
  }
}

void hold_by_numbers(const PieceFiles& files, const PipelineOptions& options, const RankMesh& mesh,
                     const mpi::Communicator& ranks, RankConstraints& constraints) {
  const std::int64_t highest = ranks.largest(mesh.ids.empty() ? -1 : mesh.ids[mesh.ids.size() - 1]);
  std::vector<std::int64_t> numbers;
  agree(ranks, [&] {
    if (ranks.rank() == 0) {
      numbers = read_held_numbers(files, options, highest + 1);
    }
  });
  ranks.broadcast(numbers);
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
      throw unknown_vertex(options, numbers[static_cast<std::size_t>(unknown - is_known.begin())]);
    }
  });
  constraints.listed = std::ssize(numbers);
}

}  // namespace

std::vector<std::int64_t> read_held_numbers(const PieceFiles& files, const PipelineOptions& options, std::int64_t end) {
  const bool are_of_file = options.fixed_ids_are_labels && files.was_read_whole;
  if (options.fixed_ids_are_labels && !are_of_file && !files.have_labels) {
    throw std::invalid_argument(
        "'--fixed-labels': the pieces give their points no numbers in the whole mesh (a point array GlobalNodeIds); "
        "--fixed-ids takes those by which they are counted, from 0, as they come over the pieces");
  }
  std::vector<std::int64_t> numbers = are_of_file                    ? files.labelled
                                      : options.fixed_ids_are_labels ? read_labels(*options.fixed_ids)
                                                                     : read_vertex_numbers(*options.fixed_ids, end);
  std::ranges::sort(numbers);
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

ReadError unknown_vertex(const PipelineOptions& options, std::int64_t id) {
  return options.fixed_ids_are_labels
             ? unknown_label(*options.fixed_ids, id)
             : ReadError(*options.fixed_ids,
                         "names vertex " + std::to_string(id) + ", and no piece has a point of that global id");
}

RankConstraints find_rank_constraints(const PieceFiles& files, const RankMesh& mesh, const PipelineOptions& options,
                                      const mpi::Communicator& ranks) {
  RankConstraints constraints;
  constraints.by_array.assign(mesh.ids.size(), 0);
  agree(ranks, [&] {
    constraints.fixed_array = name_of_fixed_array(files, options.fixed_array);
    hold_by_array(files, constraints);
  });
  constraints.named = constraints.by_array;
  hold_by_sets(files, constraints);
  if (!files.was_read_whole) {
    hold_by_labels(files, options.fixed_sets, ranks, constraints);
  }
  if (options.fixed_ids) {
    hold_by_numbers(files, options, mesh, ranks, constraints);
  }
  return constraints;
}

}  // namespace trismooth
