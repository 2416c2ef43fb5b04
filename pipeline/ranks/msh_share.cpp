// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <set>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/ranges/msh_range.h"
#include "trismooth/pipeline/input/line_groups.h"
#include "trismooth/pipeline/ranks/document_layout.h"
#include "trismooth/pipeline/ranks/share_reading.h"
#include "trismooth/pipeline/ranks/shared_texts.h"

namespace trismooth {

namespace {

/// What elements are labelled by, in the order of the arrays.
constexpr std::array<std::string_view, 3> label_arrays{"gmsh:physical", "gmsh:geometrical", "gmsh:partition"};

/// Gives a rank whose cells have no label of a kind zeros, where others have some, as the whole file has them.
void complete_labels(MeshDocument& document, const mpi::Communicator& ranks) {
  std::vector<DataArray> complete;
  for (const std::string_view name : label_arrays) {
    const DataArray* const own = find_array(document.cell_arrays, name);
    MeshDocument layout;
    if (own != nullptr) {
      layout.cell_arrays = {*own};
    }
    const std::vector<char> known =
        first_bytes(own != nullptr ? packed_cell_layout(layout) : std::vector<char>{}, ranks);
    if (own != nullptr) {
      complete.push_back(*own);
    } else if (!known.empty()) {
      take_cell_layout(known, layout);
      DataArray zeros = make_data_array(std::string(name), 1, std::vector<std::int32_t>(document.cells.size(), 0));
      zeros.description = layout.cell_arrays.front().description;
      complete.push_back(std::move(zeros));
    }
  }
  document.cell_arrays = std::move(complete);
}

std::int32_t element_label(const DataArray* array, std::size_t cell) {
  return array == nullptr ? 0 : array->as<std::int32_t>()[cell];
}

/// Whether some entity of the geometry is in several groups: then elements may be listed once for each.
bool has_entities_in_groups(const MeshDocument& document, const mpi::Communicator& ranks) {
  using Label = std::array<std::int32_t, 3>;  // dimension, entity, group
  const DataArray* const physical = find_array(document.cell_arrays, label_arrays[0]);
  const DataArray* const geometrical = find_array(document.cell_arrays, label_arrays[1]);
  std::set<Label> labels;
  for (std::size_t c = 0; c < document.cells.size(); ++c) {
    labels.insert(
        {cell_type::dimension(document.cells.types[c]), element_label(geometrical, c), element_label(physical, c)});
  }
  for (const Label& label : ranks.of_all(std::vector(labels.begin(), labels.end()))) {
    labels.insert(label);
  }
  return std::ranges::adjacent_find(
             labels, [](const Label& a, const Label& b) { return a[0] == b[0] && a[1] == b[1]; }) != labels.end();
}

/// find_line_groups() of the whole file, on rank 0, which gets the lines of all.
std::vector<FileLineGroup> line_groups_of(const MeshDocument& document, const mpi::Communicator& ranks) {
  const DataArray* const physical = find_array(document.cell_arrays, label_arrays[0]);
  auto values = mpi::lists_by_rank<std::int32_t>(ranks);
  auto types = mpi::lists_by_rank<std::uint8_t>(ranks);
  auto sizes = mpi::lists_by_rank<std::int32_t>(ranks);
  auto corners = mpi::lists_by_rank<std::int32_t>(ranks);
  for (std::size_t c = 0; c < document.cells.size() && physical != nullptr; ++c) {
    if (cell_type::dimension(document.cells.types[c]) == 1) {
      const auto cell = document.cells[c];
      values[0].push_back(element_label(physical, c));
      types[0].push_back(document.cells.types[c]);
      sizes[0].push_back(static_cast<std::int32_t>(cell.size()));
      corners[0].insert(corners[0].end(), cell.begin(), cell.end());
    }
  }
  const auto all_values = ranks.exchanged(std::move(values));
  const auto all_types = ranks.exchanged(std::move(types));
  const auto all_sizes = ranks.exchanged(std::move(sizes));
  const auto all_corners = ranks.exchanged(std::move(corners));
  if (ranks.rank() > 0 || physical == nullptr) {
    return {};
  }
  MeshDocument lines;
  std::vector<std::int32_t> labels;
  for (std::size_t r = 0; r < all_sizes.size(); ++r) {
    std::span<const std::int32_t> rest(all_corners[r]);
    for (std::size_t i = 0; i < all_sizes[r].size(); ++i) {
      const auto size = static_cast<std::size_t>(all_sizes[r][i]);
      lines.cells.append(all_types[r][i], rest.first(size));
      rest = rest.subspan(size);
    }
    labels.insert(labels.end(), all_values[r].begin(), all_values[r].end());
  }
  DataArray array = make_data_array(physical->name, 1, std::move(labels));
  array.description = physical->description;
  lines.cell_arrays.push_back(std::move(array));
  return find_line_groups(lines);
}

}  // namespace

std::optional<MeshShare> read_msh_share(const std::filesystem::path& path, const mpi::Communicator& ranks,
                                        Workers& workers) {
  MeshShare share;
  MeshDocument& document = share.document;
  bool may_repeat = false;
  const bool is_read = works_on_all(ranks, [&] {
    const MshRanges ranges(path);
    may_repeat = ranges.may_repeat_elements();
    document = ranges.read(range_of_rank(ranges.point_count(), ranks), range_of_rank(ranges.cell_count(), ranks),
                           FileWorkers(workers));
    return true;
  });
  if (!is_read || (may_repeat && has_entities_in_groups(document, ranks))) {
    return std::nullopt;
  }
  complete_labels(document, ranks);
  share.line_groups = line_groups_of(document, ranks);
  share.implied_by.assign(document.implied_sets.empty() ? 0 : document.point_count(), 0);
  for (const NamedSet& set : document.implied_sets) {
    for (const std::int32_t point : set.members) {
      share.implied_by[static_cast<std::size_t>(point)] |=
          set.name == points_of_geometry ? implied::points : implied::curves;
    }
  }
  return share;
}

}  // namespace trismooth
