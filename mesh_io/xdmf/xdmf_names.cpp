// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/xdmf/xdmf_names.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/document/free_names.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/mesh_io/xml/xml_names.h"
#include "trismooth/mesh_io/xml/xml_tree.h"

namespace trismooth {

namespace {

/// Where the values are that a name is of: in our own files, where a dimension of 0 may be that of cells with one
/// point.
enum class Center : bool { node, cell };

void add_set_arrays(const std::vector<NamedSet>& sets, std::size_t rows, std::vector<DataArray>& arrays) {
  FreeNames names;
  for (const DataArray& array : arrays) {
    names.take(array.name);
  }
  for (const NamedSet& set : sets) {
    std::vector<std::int8_t> marks(rows, 0);
    for (const std::int32_t member : set.members) {
      marks[static_cast<std::size_t>(member)] = 1;
    }
    arrays.push_back(make_data_array(names.claim(set.name), 1, std::move(marks)));
  }
}

void append_name(std::string& text, const DataArray& array, const ValueName& name, Center center, bool is_set) {
  text.append("<map key=\"").append(escape_xml_attribute(name.name));
  text.append("\" dim=\"").append(std::to_string(name.dimension));
  text.append(center == Center::node ? "\" center=\"Node" : "\" center=\"Cell");
  text.append("\" array=\"").append(escape_xml_attribute(array.name)).append(is_set ? R"(" set="1">)" : "\">");
  text.append(std::to_string(name.value)).append("</map>");
}

/// Of `arrays` those behind the first `own` are the sets.
void append_names(std::string& text, const std::vector<DataArray>& arrays, std::size_t own,
                  const std::vector<NamedSet>& sets, Center center) {
  const int dimension = center == Center::node ? 0 : 2;
  for (std::size_t i = 0; i < arrays.size(); ++i) {
    if (i >= own) {
      append_name(text, arrays[i], {1, dimension, sets[i - own].name}, center, true);
    } else if (arrays[i].description != nullptr) {
      for (const ValueName& name : arrays[i].description->value_names) {
        append_name(text, arrays[i], name, center, false);
      }
    }
  }
}

/// What the file says of an array.
struct ArrayNames {
  std::vector<ValueName> values;
  bool is_set = false;  ///< of points or cells that have the first of the values
};
using NamesOfArrays = std::map<std::string, ArrayNames, std::less<>>;

struct FoundNames {
  NamesOfArrays of_points;
  NamesOfArrays of_cells;
};

FoundNames names_in(const std::filesystem::path& file, std::string_view content) {
  FoundNames found;
  const XmlHead head = parse_xml_head(file, content, {}, {"map"});
  for (const XmlElement& map : head.root.children) {
    const std::string* const name = map.attribute("key");
    const std::string* const array = map.attribute("array");
    const auto dimension = parse_integer(map.word("dim").value_or(""));
    const auto value = parse_integer(map.text);
    if (map.name != "map" || name == nullptr || !dimension || *dimension < 0 || *dimension > 3 || !value) {
      continue;
    }
    const auto center = map.word("center");
    const bool is_of_points = center ? *center == "Node" : *dimension == 0;
    ArrayNames& names = (is_of_points ? found.of_points : found.of_cells)[array == nullptr ? "gmsh:physical" : *array];
    names.is_set = names.is_set || map.attribute("set") != nullptr;
    names.values.push_back({*value, static_cast<int>(*dimension), *name});
  }
  return found;
}

void name_values(std::vector<ValueName> values, DataArray& array) {
  // One a dimension and value: the first that the file gives.
  std::map<std::pair<int, std::int64_t>, ValueName> first;
  for (ValueName& name : values) {
    first.try_emplace(std::pair(name.dimension, name.value), std::move(name));
  }
  values.clear();
  for (auto& [key, name] : first) {
    values.push_back(std::move(name));
  }
  ArrayDescription description = array.description == nullptr ? ArrayDescription() : *array.description;
  description.value_names = std::move(values);
  array.description = std::make_shared<const ArrayDescription>(std::move(description));
}

NamedSet set_of(const ValueName& name, const DataArray& array) {
  NamedSet set{.name = name.name, .members = {}};
  for (std::size_t row = 0; row < array.rows(); ++row) {
    if (array.value(row) == static_cast<double>(name.value)) {
      set.members.push_back(static_cast<std::int32_t>(row));
    }
  }
  return set;
}

void give_names(const NamesOfArrays& all, std::vector<DataArray>& arrays, std::vector<NamedSet>& sets) {
  std::erase_if(arrays, [&](DataArray& array) {
    const auto names = all.find(array.name);
    if (names == all.end() || array.components != 1 || array.type == ScalarType::float32 ||
        array.type == ScalarType::float64) {
      return false;
    }
    if (!names->second.is_set) {
      name_values(names->second.values, array);
      return false;
    }
    sets.push_back(set_of(names->second.values.front(), array));
    return true;
  });
}

}  // namespace

XdmfWrittenArrays xdmf_written_arrays(const MeshDocument& document) {
  XdmfWrittenArrays arrays{document.point_arrays, document.cell_arrays};
  add_set_arrays(document.point_sets, document.point_count(), arrays.of_points);
  add_set_arrays(document.cell_sets, document.cells.size(), arrays.of_cells);
  return arrays;
}

std::string xdmf_names(const MeshDocument& document, const XdmfWrittenArrays& arrays) {
  std::string maps;
  append_names(maps, arrays.of_points, document.point_arrays.size(), document.point_sets, Center::node);
  append_names(maps, arrays.of_cells, document.cell_arrays.size(), document.cell_sets, Center::cell);
  return maps.empty() ? maps : "<main>" + maps + "</main>";
}

void add_xdmf_names(const std::filesystem::path& file, std::string_view content, MeshDocument& document) {
  FoundNames found;
  try {
    found = names_in(file, content);
  } catch (const ReadError&) {
    return;
  }
  give_names(found.of_points, document.point_arrays, document.point_sets);
  give_names(found.of_cells, document.cell_arrays, document.cell_sets);
}

}  // namespace trismooth
