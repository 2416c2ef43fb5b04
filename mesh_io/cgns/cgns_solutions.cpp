// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/cgns/cgns_solutions.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <type_traits>
#include <utility>

#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/document/free_names.h"

namespace trismooth {

namespace {

/// The dataset with an array's values in a zone.
struct ZoneValues {
  const CgnsZone* zone;
  std::string data;
};

struct FoundValues {
  std::string name;
  std::vector<ZoneValues> zones;
};

/// All solutions of the zones at vertices, or at cells, by the names that arrays get.
struct FoundSolutions {
  std::map<std::string, std::size_t> places;
  std::vector<FoundValues> all;  ///< in the file's order

  const FoundValues* find(const std::string& name) const {
    const auto place = places.find(name);
    return place == places.end() ? nullptr : &all[place->second];
  }
};

class CgnsSolutionsReader {
 public:
  CgnsSolutionsReader(CgnsTree& tree, int cell_dimension, const MeshDocument& document)
      : tree_(tree), cell_dimension_(cell_dimension), document_(document) {
    for (const DataArray& array : document.cell_arrays) {
      cell_names_.take(array.name);
    }
  }

  void find(const CgnsZone& zone) {
    const std::size_t cells = cells_of(zone).size();
    std::array<bool, 2> is_first{true, true};
    for (const CgnsNode& solution : tree_.children(zone.node.path, "FlowSolution_t")) {
      const std::vector<CgnsNode> locations = tree_.children(solution.path, "GridLocation_t");
      const std::string location = locations.empty() ? std::string() : tree_.text(locations.front());
      const bool at_cells = location == "CellCenter";
      const bool is_read = at_cells || location.empty() || location == "Vertex";
      for (const CgnsNode& values : tree_.children(solution.path, "DataArray_t")) {
        const std::string name = is_first.at(at_cells ? 1 : 0) ? values.name : solution.name + "/" + values.name;
        const std::string data = tree_.data_of(values);
        const Hdf5Shape shape = data.empty() ? Hdf5Shape{} : tree_.file().shape_of(data);
        if (!is_read || !shape.type || shape.count() != (at_cells ? cells : zone.points)) {
          kept_.insert(name);
          continue;
        }
        FoundSolutions& found = at_cells ? at_cells_ : at_points_;
        const auto [place, is_new] = found.places.try_emplace(name, found.all.size());
        if (is_new) {
          found.all.push_back({name, {}});
        }
        found.all[place->second].zones.push_back({&zone, data});
      }
      if (is_read) {
        is_first.at(at_cells ? 1 : 0) = false;
      }
    }
  }

  CgnsSolutions read(std::size_t zones) {
    for (FoundSolutions* const found : {&at_points_, &at_cells_}) {
      for (const FoundValues& values : found->all) {
        if (values.zones.size() != zones) {
          kept_.insert(values.name);
          found->places.erase(values.name);
        }
      }
      for (const FoundValues& values : found->all) {
        if (found->places.contains(values.name)) {
          add(*found, values);
        }
      }
    }
    if (!kept_.empty()) {
      solutions_.notes.push_back(
          "Solutions that have no numbers at all vertices or all cells are kept in CGNS output only: " +
          list_text(kept_) + ".");
    }
    return std::move(solutions_);
  }

 private:
  /// The zone's cells of its dimension, as places in the document.
  std::vector<std::size_t> cells_of(const CgnsZone& zone) const {
    std::vector<std::size_t> cells;
    for (const CgnsSection& section : zone.sections.all()) {
      for (std::size_t cell = section.first_cell; cell < section.first_cell + section.count; ++cell) {
        if (cell_type::dimension(document_.cells.types[cell]) == cell_dimension_) {
          cells.push_back(cell);
        }
      }
    }
    return cells;
  }

  /// The type of all its values; float64 where zones differ.
  ScalarType type_of(const FoundValues& values) const {
    std::set<ScalarType> types;
    for (const ZoneValues& zone : values.zones) {
      types.insert(*tree_.file().shape_of(zone.data).type);
    }
    return types.size() == 1 ? *types.begin() : ScalarType::float64;
  }

  /// The array, with those that are its other components.
  void add(const FoundSolutions& found, const FoundValues& first) {
    std::string name = first.name;
    std::vector<const FoundValues*> components{&first};
    const auto component = [&](char axis) -> const FoundValues* {
      const FoundValues* const other = found.find(name.substr(0, name.size() - 1) + axis);
      return other != nullptr && type_of(*other) == type_of(first) ? other : nullptr;
    };
    constexpr std::string_view axes = "XYZ";
    if (name.size() > 1 && axes.find(name.back()) != std::string_view::npos &&
        found.find(name.substr(0, name.size() - 1)) == nullptr && component('X') != nullptr &&
        component('Y') != nullptr) {
      components = {component('X'), component('Y')};
      if (const FoundValues* const z = component('Z')) {
        components.push_back(z);
      }
      name.pop_back();
      // Others of it have come before.
      if (!vectors_.insert({&found, name}).second) {
        return;
      }
    }
    visit_scalar_type(type_of(first), [&](auto zero) {
      &found == &at_cells_ ? add_cell_array(name, components, zero) : add_point_array(name, components, zero);
    });
  }

  template <class T>
  void add_point_array(const std::string& name, const std::vector<const FoundValues*>& components, T /*zero*/) {
    const std::size_t width = components.size();
    tree_.spend(width * document_.point_count());
    std::vector<T> all(width * document_.point_count());
    for (std::size_t k = 0; k < width; ++k) {
      for (const ZoneValues& values : components[k]->zones) {
        const std::vector<T> own = tree_.file().read<T>(values.data);
        for (std::size_t i = 0; i < own.size(); ++i) {
          all[(values.zone->first_point + i) * width + k] = own[i];
        }
        if (std::is_floating_point_v<T>) {
          solutions_.columns.push_back(hdf5_column(tree_.file(), values.data, 0, own.size(),
                                                   {{name, static_cast<std::uint8_t>(k)}}, values.zone->first_point));
        }
      }
    }
    solutions_.point_arrays.push_back(make_data_array(name, width, std::move(all)));
  }

  template <class T>
  void add_cell_array(const std::string& name, const std::vector<const FoundValues*>& components, T /*zero*/) {
    const std::size_t width = components.size();
    tree_.spend(width * document_.cells.size());
    const T none = std::is_floating_point_v<T> ? std::numeric_limits<T>::quiet_NaN() : T{};
    std::vector<T> all(width * document_.cells.size(), none);
    for (std::size_t k = 0; k < width; ++k) {
      for (const ZoneValues& values : components[k]->zones) {
        const std::vector<T> own = tree_.file().read<T>(values.data);
        const std::vector<std::size_t> cells = cells_of(*values.zone);
        for (std::size_t i = 0; i < own.size(); ++i) {
          all[cells[i] * width + k] = own[i];
        }
      }
    }
    solutions_.cell_arrays.push_back(make_data_array(cell_names_.claim(name), width, std::move(all)));
  }

  CgnsTree& tree_;
  int cell_dimension_;
  const MeshDocument& document_;
  FoundSolutions at_points_;
  FoundSolutions at_cells_;
  std::set<std::pair<const FoundSolutions*, std::string>> vectors_;
  FreeNames cell_names_;
  std::set<std::string> kept_;
  CgnsSolutions solutions_;
};

}  // namespace

CgnsSolutions read_cgns_solutions(CgnsTree& tree, std::span<const CgnsZone> zones, int cell_dimension,
                                  const MeshDocument& document) {
  CgnsSolutionsReader reader(tree, cell_dimension, document);
  for (const CgnsZone& zone : zones) {
    reader.find(zone);
  }
  return reader.read(zones.size());
}

}  // namespace trismooth
