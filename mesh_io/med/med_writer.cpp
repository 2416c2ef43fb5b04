// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/med/med_writer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>

#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/document/array_components.h"
#include "trismooth/mesh_io/document/array_description.h"
#include "trismooth/mesh_io/document/format_losses.h"
#include "trismooth/mesh_io/hdf5/hdf5_writer.h"
#include "trismooth/mesh_io/med/med_arrays.h"
#include "trismooth/mesh_io/med/med_elements.h"
#include "trismooth/mesh_io/med/med_families.h"
#include "trismooth/mesh_io/med/med_fields.h"

namespace trismooth {

namespace {

/// No step in time.
constexpr std::int64_t no_step = -1;

class MedWriter {
 public:
  MedWriter(const std::filesystem::path& path, const MeshDocument& document)
      : file_(Hdf5Writer::make(path)), document_(document), families_(plan_med_families(document)) {}

  void write() {
    set("/INFOS_GENERALES", {{"MAJ", 3}, {"MIN", 0}, {"REL", 0}});
    write_mesh_head();
    write_nodes();
    write_elements();
    set(all_families_ + "/FAMILLE_ZERO", {{"NUM", 0}});
    write_families("NOEUD", families_.of_points);
    write_families("ELEME", families_.of_cells);
    for (const MedField& field : plan_med_fields(document_, families_.arrays).fields) {
      write_field(field);
    }
    file_.close();
  }

 private:
  /// Makes the group, with these attributes.
  void set(const std::string& group, std::initializer_list<std::pair<const char*, std::int64_t>> numbers) {
    file_.make_group(group);
    for (const auto& [name, number] : numbers) {
      file_.set_attribute(group, name, number);
    }
  }

  void set_text(const std::string& group, const std::string& name, std::string_view text) {
    file_.set_attribute(group, name, text);
  }

  /// `count`: of nodes or elements that the values are of.
  template <class T>
  void write_list(const std::string& dataset, const std::vector<T>& values, std::size_t count) {
    const std::uint64_t extent = values.size();
    file_.write<T>(dataset, std::span(&extent, 1), values);
    file_.set_attribute(dataset, "CGT", std::int64_t{1});
    file_.set_attribute(dataset, "NBR", static_cast<std::int64_t>(count));
  }

  void write_mesh_head() {
    const std::vector<double>& points = document_.points;
    for (std::size_t z = 2; z < points.size() && axes_ == 2; z += 3) {
      axes_ = points[z] != 0 || std::signbit(points[z]) ? 3 : 2;
    }
    std::int64_t dimension = 0;
    for (const std::uint8_t type : document_.cells.types) {
      dimension = std::max<std::int64_t>(dimension, cell_type::dimension(type));
    }
    const std::string mesh = "/ENS_MAA/" + mesh_name_;
    set(mesh, {{"DIM", std::min(dimension, axes_)},
               {"ESP", axes_},
               {"REP", 0},
               {"SRT", 1},
               {"TYP", 0},
               {"NXT", no_step},
               {"NXI", no_step}});
    set_text(mesh, "DES", "");
    set_text(mesh, "UNI", "");
    set_text(mesh, "UNT", "");
    std::string names;
    for (std::int64_t axis = 0; axis < axes_; ++axis) {
      std::string name(1, static_cast<char>('X' + axis));
      name.resize(med_component_size, ' ');
      names += name;
    }
    set_text(mesh, "NOM", names);
    set(step_, {{"CGT", 1},
                {"NDT", no_step},
                {"NOR", no_step},
                {"NXT", no_step},
                {"NXI", no_step},
                {"PVT", no_step},
                {"PVI", no_step}});
    file_.set_attribute(step_, "PDT", 0.0);
  }

  void write_nodes() {
    const std::string nodes = step_ + "/NOE";
    set(nodes, {{"CGT", 1}, {"CGS", 1}});
    set_text(nodes, "PFL", med_all_entities);
    const std::size_t count = document_.point_count();
    std::vector<double> by_axis;
    by_axis.reserve(count * static_cast<std::size_t>(axes_));
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(axes_); ++axis) {
      for (std::size_t i = 0; i < count; ++i) {
        by_axis.push_back(document_.points[3 * i + axis]);
      }
    }
    write_list(nodes + "/COO", by_axis, count);
    if (!families_.point_families.empty()) {
      write_list(nodes + "/FAM", families_.point_families, count);
    }
  }

  void write_elements() {
    const CellList& cells = document_.cells;
    set(step_ + "/MAI", {{"CGT", 1}});
    std::vector<std::vector<std::size_t>>& of_element = cells_of_element_;
    of_element.resize(med_elements().size());
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
      if (const MedElement* const element = med_element_of_cell(cells.types[cell], cells[cell].size())) {
        of_element[static_cast<std::size_t>(element - med_elements().data())].push_back(cell);
      }
    }
    std::size_t next = 0;
    for (const std::vector<std::size_t>& members : of_element) {
      for (const std::size_t cell : members) {
        has_new_order_ = has_new_order_ || cell < next;
        next = cell;
      }
    }
    for (std::size_t i = 0; i < of_element.size(); ++i) {
      if (!of_element[i].empty()) {
        write_elements_of(med_elements()[i], of_element[i]);
      }
    }
  }

  void write_elements_of(const MedElement& element, const std::vector<std::size_t>& members) {
    const CellList& cells = document_.cells;
    const std::string group = step_ + "/MAI/" + std::string(element.name);
    set(group, {{"CGT", 1}, {"CGS", 1}, {"GEO", element.number}});
    set_text(group, "PFL", med_all_entities);
    std::vector<std::int64_t> nodes;
    if (element.nodes == 0) {
      std::vector<std::int64_t> begins{1};
      for (const std::size_t cell : members) {
        for (const std::int32_t vertex : cells[cell]) {
          nodes.push_back(std::int64_t{vertex} + 1);
        }
        begins.push_back(std::ssize(nodes) + 1);
      }
      write_list(group + "/INN", begins, begins.size());
      write_list(group + "/NOD", nodes, nodes.size());
    } else {
      nodes.resize(element.nodes * members.size());
      for (std::size_t i = 0; i < members.size(); ++i) {
        const std::span<const std::int32_t> vertices = cells[members[i]];
        for (std::size_t k = 0; k < element.nodes; ++k) {
          nodes[element.place(k) * members.size() + i] = std::int64_t{vertices[k]} + 1;
        }
      }
      write_list(group + "/NOD", nodes, members.size());
    }
    const auto write_numbers = [&](const std::string& name, const auto& number_of) {
      std::vector<std::int64_t> numbers;
      std::ranges::transform(members, std::back_inserter(numbers), number_of);
      write_list(group + name, numbers, members.size());
    };
    if (!families_.cell_families.empty()) {
      write_numbers("/FAM", [this](std::size_t cell) { return families_.cell_families[cell]; });
    }
    if (has_new_order_) {
      write_numbers("/NUM", [](std::size_t cell) { return static_cast<std::int64_t>(cell) + 1; });
    }
  }

  void write_families(const std::string& kind, const std::vector<MedFamily>& families) {
    for (const MedFamily& family : families) {
      std::string group = all_families_;
      group.append("/").append(kind).append("/FAM_").append(std::to_string(family.number));
      set(group, {{"NUM", family.number}});
      set(group + "/GRO", {{"NBR", std::ssize(family.groups)}});
      std::string names;
      for (const std::size_t place : family.groups) {
        std::string name = families_.group_names[place];
        name.resize(med_group_name_size, ' ');
        names += name;
      }
      file_.write_rows(group + "/GRO/NOM", med_group_name_size, names);
    }
  }

  /// Of one step, which is none in time.
  void write_field(const MedField& field) {
    const std::size_t points = field.at_points == nullptr ? 0 : document_.point_count();
    const bool is_at_cells =
        field.at_cells != nullptr &&
        std::ranges::any_of(cells_of_element_, [](const std::vector<std::size_t>& cells) { return !cells.empty(); });
    if (points == 0 && !is_at_cells) {
      return;
    }
    const DataArray& array = field.any();
    const ScalarType type = med_field_type(array);
    // MED's own numbers of these.
    const std::int64_t number = type == ScalarType::float64 ? 6 : type == ScalarType::int32 ? 24 : 26;
    const std::string group = "/CHA/" + field.name;
    set(group, {{"NCO", static_cast<std::int64_t>(array.components)}, {"TYP", number}});
    set_text(group, "MAI", mesh_name_);
    std::string names;
    for (std::size_t i = 0; i < array.components; ++i) {
      const ArrayDescription* const description = array.description.get();
      const bool has_name = description != nullptr && i < description->component_names.size();
      std::string name = has_name ? description->component_names[i] : std::string();
      name.resize(med_component_size, ' ');
      names += name;
    }
    set_text(group, "NOM", names);
    std::string unit = unit_of(array);
    unit.resize(med_component_size, ' ');
    std::string units;
    for (std::size_t i = 0; i < array.components; ++i) {
      units += unit;
    }
    set_text(group, "UNI", units);
    set_text(group, "UNT", "");
    const std::string step = group + "/-0000000000000000001-0000000000000000001";
    set(step, {{"NDT", no_step}, {"NOR", no_step}, {"RDT", no_step}, {"ROR", no_step}});
    file_.set_attribute(step, "PDT", 0.0);
    if (points > 0) {
      std::vector<std::size_t> rows(points);
      std::iota(rows.begin(), rows.end(), std::size_t{0});
      write_values(step + "/NOE", *field.at_points, rows);
    }
    for (std::size_t i = 0; is_at_cells && i < cells_of_element_.size(); ++i) {
      if (!cells_of_element_[i].empty()) {
        write_values(step + "/MAI." + std::string(med_elements()[i].name), *field.at_cells, cells_of_element_[i]);
      }
    }
  }

  void write_values(const std::string& support, const DataArray& array, const std::vector<std::size_t>& rows) {
    file_.make_group(support);
    set_text(support, "GAU", "");
    set_text(support, "PFL", med_all_entities);
    const std::string profile = support + "/" + std::string(med_all_entities);
    set(profile, {{"NBR", std::ssize(rows)}, {"NGA", 1}});
    set_text(profile, "GAU", "");
    with_widened_type(array, [&](auto zero) {
      using T = std::conditional_t<std::is_floating_point_v<decltype(zero)>, double, decltype(zero)>;
      std::vector<T> values;
      for (std::size_t i = 0; i < array.components; ++i) {
        const std::vector<T> component = component_of<T>(array, i, rows);
        values.insert(values.end(), component.begin(), component.end());
      }
      const std::uint64_t extent = values.size();
      file_.write<T>(profile + "/CO", std::span(&extent, 1), values);
    });
  }

  Hdf5Writer file_;
  const MeshDocument& document_;
  MedFamilies families_;
  std::vector<std::vector<std::size_t>> cells_of_element_;  ///< in the order in which they are written
  std::int64_t axes_ = 2;
  bool has_new_order_ = false;  ///< elements are not in the order of cells, whose numbers they get
  const std::string mesh_name_ = "mesh";
  const std::string all_families_ = "/FAS/" + mesh_name_;
  const std::string step_ = "/ENS_MAA/" + mesh_name_ + "/-0000000000000000001-0000000000000000001";
};

}  // namespace

void write_med(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& /*workers*/) {
  MedWriter(path, document).write();
}

std::vector<std::string> lost_in_med(const MeshDocument& document) {
  std::vector<std::uint8_t> types;
  for (const MedElement& element : med_elements()) {
    if (element.is_written) {
      types.push_back(element.type);
    }
  }
  const MedFamilies families = plan_med_families(document);
  std::vector<std::string> sentences =
      describe_lost_cells("MED", "points, lines, faces and solids", types, document.cells);
  std::ranges::move(describe_lost_field_arrays("MED", document), std::back_inserter(sentences));
  std::ranges::move(describe_lost_names("MED", document, families.arrays), std::back_inserter(sentences));
  if (const MedFieldPlan plan = plan_med_fields(document, families.arrays); !plan.renamed.empty()) {
    sentences.push_back("MED has names of fields of " + std::to_string(med_field_name_size) +
                        " characters at most, each once and without slashes: changed are " + list_text(plan.renamed));
  }
  std::ranges::move(describe_widened("MED", document, families.arrays), std::back_inserter(sentences));
  std::string cut;
  for (const auto* const arrays : {&document.point_arrays, &document.cell_arrays}) {
    for (const DataArray& array : *arrays) {
      if (unit_of(array).size() > med_component_size) {
        add_to_list(cut, shown_name(array));
      }
    }
  }
  if (!cut.empty()) {
    sentences.push_back("MED has units of " + std::to_string(med_component_size) +
                        " characters at most: cut off are those of " + cut);
  }
  if (!families.renamed.empty()) {
    sentences.push_back("MED has names of groups of " + std::to_string(med_group_name_size) +
                        " characters at most, without blanks around them: changed are " + list_text(families.renamed));
  }
  for (const std::string& sentence : describe_new_order("MED", types, document.cells)) {
    sentences.push_back(sentence + ", under their old numbers (NUM)");
  }
  return sentences;
}

}  // namespace trismooth
