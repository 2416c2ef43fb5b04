// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/cgns/cgns_writer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <numeric>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>

#include "trismooth/base/text/counted.h"
#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/cgns/cgns_arrays.h"
#include "trismooth/mesh_io/cgns/cgns_elements.h"
#include "trismooth/mesh_io/document/array_components.h"
#include "trismooth/mesh_io/document/cells/group_lists.h"
#include "trismooth/mesh_io/document/format_losses.h"
#include "trismooth/mesh_io/document/free_names.h"
#include "trismooth/mesh_io/hdf5/hdf5_writer.h"

namespace trismooth {

namespace {

constexpr std::array<std::string_view, 4> names_of_dimensions{"Points", "Lines", "Faces", "Solids"};

/// Cells that are written together.
struct WrittenSection {
  std::int64_t type = 0;  ///< of all of them, or mixed
  std::vector<std::size_t> cells;
};

/// Those of each type, as programs read them that know no mixed ones (CGNS before version 4), where the types follow
/// each other; else the section as it is.
std::vector<WrittenSection> sections_by_type(WrittenSection section, const CellList& cells) {
  const auto type_of = [&cells](std::size_t cell) {
    return cgns_element_of_cell(cells.types[cell], cells[cell].size())->number;
  };
  std::vector<WrittenSection> of_types;
  for (const std::size_t cell : section.cells) {
    if (const std::int64_t type = type_of(cell); of_types.empty() || of_types.back().type != type) {
      if (std::ranges::find(of_types, type, &WrittenSection::type) != of_types.end()) {
        return {std::move(section)};
      }
      of_types.push_back({type, {}});
    }
    of_types.back().cells.push_back(cell);
  }
  return of_types;
}

/// Points, lines, faces, solids and polygons, each in the order of the document, in the order in which they come first.
/// Triangles and quadrilaterals in turn are one section.
std::vector<WrittenSection> sections_of(const CellList& cells) {
  constexpr std::size_t of_polygons = names_of_dimensions.size();
  std::array<std::size_t, of_polygons + 1> places{};  // and 1
  std::vector<WrittenSection> sections;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    const CgnsElement* const element = cgns_element_of_cell(cells.types[cell], cells[cell].size());
    if (element == nullptr && (cells.types[cell] != cell_type::polygon || cells[cell].size() < 3)) {
      continue;
    }
    const std::int64_t type = element == nullptr ? cgns_type::polygons : element->number;
    std::size_t& place =
        places.at(element == nullptr ? of_polygons : static_cast<std::size_t>(cell_type::dimension(element->type)));
    if (place == 0) {
      sections.push_back({type, {}});
      place = sections.size();
    }
    WrittenSection& section = sections[place - 1];
    section.type = section.type == type ? type : cgns_type::mixed;
    section.cells.push_back(cell);
  }
  std::vector<WrittenSection> written;
  for (WrittenSection& section : sections) {
    if (section.type == cgns_type::mixed) {
      std::ranges::move(sections_by_type(std::move(section), cells), std::back_inserter(written));
    } else {
      written.push_back(std::move(section));
    }
  }
  return written;
}

bool is_in_order(const std::vector<WrittenSection>& sections) {
  std::size_t next = 0;
  return std::ranges::all_of(sections, [&next](const WrittenSection& section) {
    const bool follows = section.cells.front() >= next;
    next = section.cells.back() + 1;
    return follows;
  });
}

class CgnsWriter {
 public:
  CgnsWriter(const std::filesystem::path& path, const MeshDocument& document)
      : file_(Hdf5Writer::make(path)), document_(document), lists_(list_groups(document)) {}

  void write() {
    write_root();
    const std::vector<double>& points = document_.points;
    for (std::size_t z = 2; z < points.size() && axes_ == 2; z += 3) {
      axes_ = points[z] != 0 || std::signbit(points[z]) ? 3 : 2;
    }
    const std::vector<WrittenSection> sections = sections_of(document_.cells);
    write_base(sections);
    write_coordinates();
    write_sections(sections);
    write_groups();
    std::vector<std::size_t> rows(document_.point_count());
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    write_arrays("PointData", "Vertex", plan_cgns_arrays(document_.point_arrays, {}), rows);
    rows.clear();
    for (const WrittenSection& section : sections) {
      std::ranges::copy_if(section.cells, std::back_inserter(rows), [this](std::size_t cell) {
        return cell_type::dimension(document_.cells.types[cell]) == dimension_;
      });
    }
    write_arrays("CellData", "CellCenter", plan_cgns_arrays(document_.cell_arrays, lists_.arrays), rows);
    file_.close();
  }

 private:
  /// CGNS's names of types: I4, R8, C1, and MT for nodes without data.
  void make_node(const std::string& path, std::string_view label, std::string_view type) {
    file_.make_group(path);
    set_head(path, std::string_view(path).substr(path.rfind('/') + 1), label, type);
    constexpr std::array<std::int32_t, 1> flags{1};
    file_.set_attribute<std::int32_t>(path, "flags", flags);
  }

  void set_head(const std::string& path, std::string_view name, std::string_view label, std::string_view type) {
    file_.set_attribute(path, "name", name, most_cgns_name_size + 1);
    file_.set_attribute(path, "label", label, most_cgns_name_size + 1);
    file_.set_attribute(path, "type", type, 3);
  }

  template <class T>
  void add(const std::string& path, std::string_view label, std::string_view type, const std::vector<T>& values,
           std::vector<std::uint64_t> extents = {}) {
    make_node(path, label, type);
    if (extents.empty()) {
      extents = {values.size()};
    }
    file_.write<T>(path + "/ data", extents, values);
  }

  void add_text(const std::string& path, std::string_view label, std::string_view text) {
    add(path, label, "C1", std::vector<std::int8_t>(text.begin(), text.end()));
  }

  void write_root() {
    set_head("/", "HDF5 MotherNode", "Root Node of HDF5 File", "MT");
    const auto write_text = [this](const std::string& name, std::string text, std::size_t size) {
      text.resize(size, '\0');
      const std::uint64_t extent = size;
      file_.write<std::int8_t>(name, std::span(&extent, 1), std::vector<std::int8_t>(text.begin(), text.end()));
    };
    write_text("/ format", "IEEE_LITTLE_32", 15);
    write_text("/ hdf5version", "HDF5 Version 1.8", most_cgns_name_size + 1);
    // The first that has offsets of polygons and mixed elements.
    constexpr float version = 3.4F;
    add("/CGNSLibraryVersion", "CGNSLibraryVersion_t", "R4", std::vector<float>{version});
  }

  void write_base(const std::vector<WrittenSection>& sections) {
    int dimension = 1;
    std::size_t cells = 0;
    for (int pass = 0; pass < 2; ++pass) {
      for (const WrittenSection& section : sections) {
        const int own = cell_type::dimension(document_.cells.types[section.cells.front()]);
        cells += pass == 1 && own == dimension ? section.cells.size() : 0;
        dimension = std::max(dimension, own);
      }
    }
    dimension_ = dimension;
    add(base_path_, "CGNSBase_t", "I4", std::vector<std::int32_t>{dimension, static_cast<std::int32_t>(axes_)});
    add(zone_path_, "Zone_t", "I4",
        std::vector<std::int32_t>{static_cast<std::int32_t>(document_.point_count()), static_cast<std::int32_t>(cells),
                                  0},
        {3, 1});
    add_text(zone_path_ + "/ZoneType", "ZoneType_t", "Unstructured");
  }

  void write_coordinates() {
    const std::string grid = zone_path_ + "/GridCoordinates";
    make_node(grid, "GridCoordinates_t", "MT");
    for (std::size_t axis = 0; axis < axes_; ++axis) {
      const auto write_as = [&](auto zero, std::string_view type) {
        std::vector<decltype(zero)> values;
        values.reserve(document_.point_count());
        for (std::size_t at = axis; at < document_.points.size(); at += 3) {
          values.push_back(static_cast<decltype(zero)>(document_.points[at]));
        }
        add(grid + "/Coordinate" + static_cast<char>('X' + axis), "DataArray_t", type, values);
      };
      document_.point_type == ScalarType::float32 ? write_as(float{}, "R4") : write_as(double{}, "R8");
    }
  }

  void write_sections(const std::vector<WrittenSection>& sections) {
    const CellList& cells = document_.cells;
    numbers_.assign(cells.size(), 0);
    std::int32_t next = 1;
    for (const auto& [type, members] : sections) {
      std::vector<std::int32_t> nodes;
      std::vector<std::int32_t> begins{0};
      for (const std::size_t cell : members) {
        const std::span<const std::int32_t> vertices = cells[cell];
        const CgnsElement* const element = cgns_element_of_cell(cells.types[cell], vertices.size());
        if (type == cgns_type::mixed) {
          nodes.push_back(static_cast<std::int32_t>(element->number));
        }
        const std::size_t first = nodes.size();
        nodes.resize(first + vertices.size());
        for (std::size_t k = 0; k < vertices.size(); ++k) {
          nodes[first + (element == nullptr ? k : element->place(k))] = vertices[k] + 1;
        }
        begins.push_back(static_cast<std::int32_t>(nodes.size()));
        numbers_[cell] = next++;
      }
      const bool is_mixed = type == cgns_type::mixed;
      const auto dimension = static_cast<std::size_t>(cell_type::dimension(cells.types[members.front()]));
      std::string section = zone_path_ + "/";
      section += is_mixed ? std::string(names_of_dimensions.at(dimension)) : cgns_section_name(type);
      add(section, "Elements_t", "I4", std::vector<std::int32_t>{static_cast<std::int32_t>(type), 0});
      const auto count = static_cast<std::int32_t>(members.size());
      add(section + "/ElementRange", "IndexRange_t", "I4", std::vector<std::int32_t>{next - count, next - 1});
      add(section + "/ElementConnectivity", "DataArray_t", "I4", nodes);
      if (is_mixed || type == cgns_type::polygons) {
        add(section + "/ElementStartOffset", "DataArray_t", "I4", begins);
      }
    }
  }

  /// A condition for the cells of each dimension that a group has, and one for
  /// its points.
  void write_groups() {
    if (lists_.names.empty()) {
      return;
    }
    const std::vector<std::string> names = fit_names(lists_.names, most_cgns_name_size, no_cgns_name_characters).names;
    std::map<std::pair<std::size_t, std::string_view>, std::vector<std::int32_t>> conditions;
    for (std::size_t cell = 0; cell < lists_.of_cells.size(); ++cell) {
      const int dimension = cell_type::dimension(document_.cells.types[cell]);
      for (const std::size_t group : lists_.of_cells[cell]) {
        if (numbers_[cell] > 0) {
          conditions[{group, location_of(dimension)}].push_back(numbers_[cell]);
        }
      }
    }
    for (std::size_t point = 0; point < lists_.of_points.size(); ++point) {
      for (const std::size_t group : lists_.of_points[point]) {
        conditions[{group, "Vertex"}].push_back(static_cast<std::int32_t>(point) + 1);
      }
    }
    const std::string all = zone_path_ + "/ZoneBC";
    make_node(all, "ZoneBC_t", "MT");
    // By the name of the group as well: what other programs show.
    std::vector<std::string> wanted;
    FreeNames free_names;
    for (const auto& [key, members] : conditions) {
      wanted.push_back(free_names.claim(lists_.names[key.first]));
    }
    const std::vector<std::string> titles = fit_names(wanted, most_cgns_name_size, no_cgns_name_characters).names;
    auto title = titles.begin();
    for (const auto& [key, members] : conditions) {
      const std::string condition = all + "/" + *title++;
      add_text(condition, "BC_t", "FamilySpecified");
      add(condition + "/PointList", "IndexArray_t", "I4", members, {members.size(), 1});
      add_text(condition + "/GridLocation", "GridLocation_t", key.second);
      add_text(condition + "/FamilyName", "FamilyName_t", names[key.first]);
    }
    for (const std::string& name : names) {
      std::string family = base_path_ + "/";
      family += name;
      make_node(family, "Family_t", "MT");
      // Gmsh's name of the group.
      add_text(family.append("/").append(name), "FamilyName_t", name);
    }
  }

  void write_arrays(const std::string& name, std::string_view location, const CgnsArrays& arrays,
                    const std::vector<std::size_t>& rows) {
    if (arrays.components.empty() || rows.empty()) {
      return;
    }
    const std::string solution = zone_path_ + "/" + name;
    make_node(solution, "FlowSolution_t", "MT");
    add_text(solution + "/GridLocation", "GridLocation_t", location);
    for (const CgnsComponent& values : arrays.components) {
      with_widened_type(*values.array, [&](auto zero) {
        using T = decltype(zero);
        constexpr std::string_view letter = std::is_floating_point_v<T> ? "R" : "I";
        add(solution + "/" + values.name, "DataArray_t", std::string(letter) + std::to_string(sizeof(T)),
            component_of<T>(*values.array, values.component, rows));
      });
    }
  }

  std::string_view location_of(int dimension) const {
    return dimension == dimension_ ? "CellCenter" : dimension == 2 ? "FaceCenter" : "EdgeCenter";
  }

  Hdf5Writer file_;
  const std::string base_path_ = "/Base";
  const std::string zone_path_ = "/Base/Zone";
  const MeshDocument& document_;
  GroupLists lists_;
  std::size_t axes_ = 2;
  int dimension_ = 2;
  std::vector<std::int32_t> numbers_;  ///< of the element of each cell; 0: none
};

}  // namespace

void write_cgns(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& /*workers*/) {
  CgnsWriter(path, document).write();
}

namespace {

/// Cells that are written and are not of the highest dimension.
std::size_t count_cells_below(const CellList& cells) {
  std::array<std::size_t, names_of_dimensions.size()> counts{};
  std::size_t all = 0;
  for (const WrittenSection& section : sections_of(cells)) {
    for (const std::size_t cell : section.cells) {
      ++counts.at(static_cast<std::size_t>(cell_type::dimension(cells.types[cell])));
      ++all;
    }
  }
  const auto highest =
      std::ranges::find_if(counts.rbegin(), counts.rend(), [](std::size_t count) { return count > 0; });
  return highest == counts.rend() ? 0 : all - *highest;
}

}  // namespace

std::vector<std::string> lost_in_cgns(const MeshDocument& document) {
  std::vector<std::uint8_t> types;
  for (const CgnsElement& element : cgns_elements()) {
    if (element.is_written) {
      types.push_back(element.type);
    }
  }
  types.push_back(cell_type::polygon);
  const GroupLists lists = list_groups(document);
  std::vector<std::string> sentences =
      describe_lost_cells("CGNS", "points, lines, faces and solids", types, document.cells);
  const CgnsArrays of_points = plan_cgns_arrays(document.point_arrays, {});
  const CgnsArrays of_cells = plan_cgns_arrays(document.cell_arrays, lists.arrays);
  std::ranges::move(describe_lost_field_arrays("CGNS", document), std::back_inserter(sentences));
  std::ranges::move(describe_lost_names("CGNS", document, lists.arrays), std::back_inserter(sentences));
  std::ranges::move(describe_widened("CGNS", document, lists.arrays), std::back_inserter(sentences));
  if (const std::size_t cells = count_cells_below(document.cells); cells > 0 && !of_cells.components.empty()) {
    sentences.push_back("CGNS has values of the cells of the highest dimension: those of cell arrays at " +
                        counted(cells, "other cell are", "other cells are") + " not written");
  }
  std::vector<std::string> split = of_points.split;
  split.insert(split.end(), of_cells.split.begin(), of_cells.split.end());
  if (!split.empty()) {
    sentences.push_back(
        "CGNS has one number for a vertex or cell, and vectors: arrays of more components become one each: " +
        list_text(split));
  }
  std::vector<std::string> renamed = fit_names(lists.names, most_cgns_name_size, no_cgns_name_characters).renamed;
  renamed.insert(renamed.end(), of_points.renamed.begin(), of_points.renamed.end());
  renamed.insert(renamed.end(), of_cells.renamed.begin(), of_cells.renamed.end());
  if (!renamed.empty()) {
    sentences.push_back("CGNS has names of " + std::to_string(most_cgns_name_size) +
                        " characters at most, without slashes and without "
                        "blanks around them: changed are " +
                        list_text(renamed));
  }
  if (!is_in_order(sections_of(document.cells))) {
    sentences.emplace_back(
        "CGNS lists points, lines, faces and solids, and polygons, one behind the other: they are written in another "
        "order");
  }
  return sentences;
}

}  // namespace trismooth
