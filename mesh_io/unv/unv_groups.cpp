#include "trismooth/mesh_io/unv/unv_groups.h"

#include <algorithm>
#include <array>
#include <memory>
#include <set>
#include <utility>

namespace trismooth {

namespace {

/// The places of those ids that there are, ascending, each once.
std::vector<std::int32_t> places_of(const std::vector<std::int64_t>& ids, const PointIds& known) {
  std::vector<std::int32_t> places;
  for (const std::int64_t id : ids) {
    if (const auto place = known.find(id)) {
      places.push_back(*place);
    }
  }
  std::ranges::sort(places);
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

bool names_others(const std::vector<std::int64_t>& ids, const PointIds& known) {
  return std::ranges::any_of(ids, [&known](std::int64_t id) { return !known.find(id); });
}

}  // namespace

void add_unv_groups(std::vector<UnvGroup> groups, const PointIds& nodes, const PointIds& elements,
                    MeshDocument& document) {
  std::vector<std::int64_t> of_cell;
  std::set<std::int64_t> numbers;
  ArrayDescription description;
  std::string with_others;
  for (UnvGroup& group : groups) {
    if (group.name.empty()) {
      group.name = "group " + std::to_string(group.number);
    }
    if (names_others(group.nodes, nodes) || names_others(group.elements, elements)) {
      with_others.append(with_others.empty() ? "" : ", ").append(group.name);
    }
    if (std::vector<std::int32_t> points = places_of(group.nodes, nodes); !points.empty()) {
      document.point_sets.push_back({group.name, std::move(points)});
    }
    std::vector<std::int32_t> cells = places_of(group.elements, elements);
    if (cells.empty()) {
      continue;
    }
    of_cell.resize(document.cells.size());
    bool is_apart = group.number != 0 && numbers.insert(group.number).second;
    if (is_apart) {
      std::array<bool, 4> dimensions{};
      for (const std::int32_t cell : cells) {
        std::int64_t& value = of_cell[static_cast<std::size_t>(cell)];
        is_apart = is_apart && value == 0;
        if (value == 0) {
          value = group.number;
          dimensions.at(static_cast<std::size_t>(
              cell_type::dimension(document.cells.types[static_cast<std::size_t>(cell)]))) = true;
        }
      }
      for (std::size_t dimension = 0; dimension < dimensions.size(); ++dimension) {
        if (dimensions.at(dimension)) {
          description.value_names.push_back({group.number, static_cast<int>(dimension), group.name});
        }
      }
    }
    if (!is_apart) {
      document.cell_sets.push_back({group.name, std::move(cells)});
    }
  }
  if (std::ranges::any_of(of_cell, [](std::int64_t value) { return value != 0; })) {
    DataArray array = make_data_array("unv:group", 1, std::move(of_cell));
    array.description = std::make_shared<const ArrayDescription>(std::move(description));
    document.cell_arrays.push_back(std::move(array));
  }
  if (!with_others.empty()) {
    document.notes.push_back("Groups name nodes or elements that are not in the file: " + with_others + ".");
  }
}

}  // namespace trismooth
