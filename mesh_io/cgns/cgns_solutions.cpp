// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/cgns/cgns_solutions.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "trismooth/base/text/list_text.h"

namespace trismooth {

namespace {

/// The dataset with an array's values in a zone.
struct ZoneValues {
  const CgnsZone* zone;
  std::string data;
};

/// All solutions of the zones, by the names that arrays get.
class CgnsSolutionsReader {
 public:
  explicit CgnsSolutionsReader(CgnsTree& tree) : tree_(tree) {}

  void find(const CgnsZone& zone) {
    bool is_first = true;
    for (const CgnsNode& solution : tree_.children(zone.node.path, "FlowSolution_t")) {
      const std::vector<CgnsNode> locations = tree_.children(solution.path, "GridLocation_t");
      const std::string location = locations.empty() ? std::string() : tree_.text(locations.front());
      const bool at_vertices = location.empty() || location == "Vertex";
      for (const CgnsNode& values : tree_.children(solution.path, "DataArray_t")) {
        const std::string name = is_first ? values.name : solution.name + "/" + values.name;
        const std::string data = tree_.data_of(values);
        const Hdf5Shape shape = data.empty() ? Hdf5Shape{} : tree_.file().shape_of(data);
        if (!at_vertices || data.empty() || !is_real(shape) || shape.count() != zone.points) {
          kept_.insert(name);
          continue;
        }
        const auto [place, is_new] = places_.try_emplace(name, found_.size());
        if (is_new) {
          found_.push_back({name, {}});
        }
        found_[place->second].second.push_back({&zone, data});
      }
      is_first = is_first && !at_vertices;
    }
  }

  CgnsSolutions read(std::size_t zones, std::size_t points) {
    CgnsSolutions solutions;
    for (const auto& [name, values] : found_) {
      if (values.size() != zones) {
        kept_.insert(name);
        continue;
      }
      add(name, values, points, solutions);
    }
    if (!kept_.empty()) {
      solutions.notes.push_back(
          "Solutions that have no numbers at all "
          "vertices are kept in CGNS output only: " +
          list_text(kept_) + ".");
    }
    return solutions;
  }

 private:
  static bool is_real(const Hdf5Shape& shape) {
    return shape.type == ScalarType::float32 || shape.type == ScalarType::float64;
  }

  void add(const std::string& name, const std::vector<ZoneValues>& zones, std::size_t points,
           CgnsSolutions& solutions) {
    tree_.spend(points);
    const bool is_float = std::ranges::all_of(zones, [this](const ZoneValues& values) {
      return tree_.file().shape_of(values.data).type == ScalarType::float32;
    });
    const auto add_as = [&](auto zero) {
      std::vector<decltype(zero)> all(points);
      for (const ZoneValues& values : zones) {
        const std::vector<decltype(zero)> own = tree_.file().read<decltype(zero)>(values.data);
        std::ranges::copy(own, all.begin() + static_cast<std::ptrdiff_t>(values.zone->first_point));
        solutions.columns.push_back({values.data, 0, own.size(), {name, 0}, values.zone->first_point});
      }
      solutions.arrays.push_back(make_data_array(name, 1, std::move(all)));
    };
    is_float ? add_as(float{}) : add_as(double{});
  }

  CgnsTree& tree_;
  std::map<std::string, std::size_t> places_;
  std::vector<std::pair<std::string, std::vector<ZoneValues>>> found_;  ///< in the file's order
  std::set<std::string> kept_;
};

}  // namespace

CgnsSolutions read_cgns_solutions(CgnsTree& tree, std::span<const CgnsZone> zones, std::size_t points) {
  CgnsSolutionsReader reader(tree);
  for (const CgnsZone& zone : zones) {
    reader.find(zone);
  }
  return reader.read(zones.size(), points);
}

}  // namespace trismooth
