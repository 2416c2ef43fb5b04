// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "trismooth/base/text/counted.h"
#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/bytes/hdf5_signature.h"
#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/document/cells/other_cells.h"
#include "trismooth/mesh_io/document/format_losses.h"
#include "trismooth/mesh_io/document/free_names.h"
#include "trismooth/mesh_io/exodus/exodus_blocks.h"
#include "trismooth/mesh_io/exodus/exodus_plan.h"
#include "trismooth/mesh_io/exodus/exodus_reader.h"
#include "trismooth/mesh_io/netcdf/netcdf_header.h"
#include "trismooth/mesh_io/netcdf/netcdf_writer.h"

namespace trismooth {

namespace {

/// A component of an array, which is a variable.
struct WrittenComponent {
  const DataArray* array = nullptr;
  std::size_t component = 0;
  std::string name;
};

std::string component_name(const DataArray& array, std::size_t component) {
  if (array.components == 1) {
    return array.name;
  }
  const ArrayDescription* const description = array.description.get();
  if (description != nullptr && component < description->component_names.size() &&
      !description->component_names[component].empty()) {
    return array.name + "_" + description->component_names[component];
  }
  constexpr std::array<const char*, 3> axes{"_x", "_y", "_z"};
  return array.name + (array.components <= axes.size() ? axes.at(component) : "_" + std::to_string(component + 1));
}

std::vector<WrittenComponent> components_of(const std::vector<DataArray>& arrays, const GroupArrays& but) {
  std::vector<WrittenComponent> all;
  FreeNames names;
  for (const DataArray& array : arrays) {
    for (std::size_t component = 0; component < array.components && !but.has(array.name); ++component) {
      all.push_back({&array, component, names.claim(component_name(array, component))});
    }
  }
  return all;
}

/// Writes a document as dimensions and variables of Exodus II, under the names of its manual.
class ExodusWriter {
 public:
  explicit ExodusWriter(const MeshDocument& document)
      : document_(document),
        plan_(make_exodus_plan(document)),
        at_nodes_(components_of(document.point_arrays, {})),
        at_elements_(components_of(document.cell_arrays, plan_.group_arrays)) {}

  void write(const std::filesystem::path& path, const FileWorkers& workers) {
    add_head();
    add_points();
    add_blocks();
    add_sets(plan_.node_sets, {"num_node_sets", "ns_status", "ns_prop1", "ns_names", "num_nod_ns", "node_ns", ""});
    add_sets(plan_.side_sets,
             {"num_side_sets", "ss_status", "ss_prop1", "ss_names", "num_side_ss", "elem_ss", "side_ss"});
    add_sets(plan_.element_sets,
             {"num_elem_sets", "els_status", "els_prop1", "els_names", "num_ele_els", "elem_els", ""});
    add_variables();
    file_.write(path, workers);
  }

 private:
  struct SetNames {
    const char* count;
    const char* status;
    const char* ids;
    const char* names;
    const char* size;
    const char* members;
    const char* sides;
  };

  void add_head() {
    constexpr double version = 8.25;
    file_.add_attribute("api_version", NetcdfType::float32, version);
    file_.add_attribute("version", NetcdfType::float32, version);
    file_.add_attribute("floating_point_word_size", NetcdfType::int32, sizeof(double));
    file_.add_attribute("file_size", NetcdfType::int32, 1);
    file_.add_attribute("title", "written by trismooth");
    constexpr std::size_t usual_length = 33;
    std::size_t longest = usual_length - 1;
    const auto look_at = [&longest](const auto& named) { longest = std::max(longest, named.name.size()); };
    std::ranges::for_each(plan_.blocks, look_at);
    for (const auto* sets : {&plan_.node_sets, &plan_.side_sets, &plan_.element_sets}) {
      std::ranges::for_each(*sets, look_at);
    }
    for (const auto* components : {&at_nodes_, &at_elements_}) {
      std::ranges::for_each(*components, look_at);
    }
    file_.add_attribute("maximum_name_length", NetcdfType::int32, static_cast<double>(longest));
    file_.add_dimension("len_string", usual_length);
    length_ = file_.add_dimension("len_name", longest + 1);
  }

  void add_points() {
    const std::vector<double>& points = document_.points;
    bool is_flat = true;
    for (std::size_t i = 2; i < points.size(); i += 3) {
      is_flat = is_flat && points[i] == 0;
    }
    const std::size_t axes = is_flat ? 2 : 3;
    const std::size_t dimension = file_.add_dimension("num_dim", axes);
    constexpr std::array<const char*, 3> names{"coordx", "coordy", "coordz"};
    std::vector<std::string> texts{"x", "y", "z"};
    texts.resize(axes);
    file_.add_texts("coor_names", {dimension, length_}, std::move(texts));
    if (points.empty()) {
      return;
    }
    nodes_ = file_.add_dimension("num_nodes", document_.point_count());
    for (std::size_t axis = 0; axis < axes; ++axis) {
      file_.add_variable(names.at(axis), {nodes_}, [&points, axis](std::size_t i) { return points[3 * i + axis]; });
    }
  }

  template <class Things>
  void add_names(const char* variable, std::size_t dimension, const Things& things) {
    std::vector<std::string> names;
    for (const auto& thing : things) {
      names.push_back(thing.name);
    }
    file_.add_texts(variable, {dimension, length_}, std::move(names));
  }

  template <class Things>
  void add_ids(const char* status, const char* ids, std::size_t dimension, const Things& things,
               std::vector<std::int32_t> is_there) {
    file_.add_variable(status, {dimension}, [is_there = std::move(is_there)](std::size_t i) { return is_there[i]; });
    file_.add_variable(ids, {dimension}, [&things](std::size_t i) { return static_cast<std::int32_t>(things[i].id); },
                       {{"name", "ID", {}}});
  }

  void add_blocks() {
    if (plan_.blocks.empty()) {
      return;
    }
    const std::size_t elements = file_.add_dimension("num_elem", plan_.elements);
    blocks_ = file_.add_dimension("num_el_blk", plan_.blocks.size());
    add_ids("eb_status", "eb_prop1", blocks_, plan_.blocks, std::vector<std::int32_t>(plan_.blocks.size(), 1));
    add_names("eb_names", blocks_, plan_.blocks);
    if (plan_.has_regions) {
      file_.add_variable(exodus_region_property, {blocks_},
                         [this](std::size_t i) { return static_cast<std::int32_t>(plan_.blocks[i].region); },
                         {{"name", std::string(exodus_region_name), {}}});
    }
    for (std::size_t i = 0; i < plan_.blocks.size(); ++i) {
      add_block(plan_.blocks[i], std::to_string(i + 1));
    }
    if (!plan_.keeps_order) {
      cell_of_.resize(plan_.elements);
      for (std::size_t cell = 0; cell < plan_.element_of.size(); ++cell) {
        if (plan_.element_of[cell] >= 0) {
          cell_of_[static_cast<std::size_t>(plan_.element_of[cell])] = static_cast<std::int32_t>(cell);
        }
      }
      file_.add_variable("elem_num_map", {elements}, [this](std::size_t i) { return cell_of_[i] + 1; });
    }
  }

  void add_block(const ExodusPlanBlock& block, const std::string& number) {
    const CellList& cells = document_.cells;
    elements_in_.push_back(file_.add_dimension("num_el_in_blk" + number, block.cells.size()));
    const std::size_t each = block.shape.nodes;
    if (each == 0) {
      add_polygons(block, number);
      return;
    }
    const std::size_t nodes = file_.add_dimension("num_nod_per_el" + number, each);
    file_.add_variable("connect" + number, {elements_in_.back(), nodes},
                       [&cells, &block, each](std::size_t i) {
                         return cells[static_cast<std::size_t>(block.cells[i / each])][block.shape.place(i % each)] + 1;
                       },
                       {{"elem_type", std::string(block.shape.name), {}}});
  }

  void add_polygons(const ExodusPlanBlock& block, const std::string& number) {
    const CellList& cells = document_.cells;
    std::vector<std::int32_t> vertices;
    for (const std::int32_t cell : block.cells) {
      std::ranges::copy(cells[static_cast<std::size_t>(cell)], std::back_inserter(vertices));
    }
    const std::size_t nodes = file_.add_dimension("num_nod_per_el" + number, vertices.size());
    file_.add_variable("connect" + number, {nodes},
                       [vertices = std::move(vertices)](std::size_t i) { return vertices[i] + 1; },
                       {{"elem_type", "nsided", {}}});
    file_.add_variable("ebepecnt" + number, {elements_in_.back()},
                       [&cells, &block](std::size_t i) {
                         return static_cast<std::int32_t>(cells[static_cast<std::size_t>(block.cells[i])].size());
                       },
                       {{"entity_type1", "NODE", {}}, {"entity_type2", "ELEM", {}}});
  }

  void add_sets(const std::vector<ExodusPlanSet>& sets, const SetNames& names) {
    if (sets.empty()) {
      return;
    }
    const std::size_t count = file_.add_dimension(names.count, sets.size());
    std::vector<std::int32_t> is_there;
    std::ranges::transform(sets, std::back_inserter(is_there),
                           [](const ExodusPlanSet& set) { return set.members.empty() ? 0 : 1; });
    add_ids(names.status, names.ids, count, sets, is_there);
    add_names(names.names, count, sets);
    for (std::size_t i = 0; i < sets.size(); ++i) {
      if (sets[i].members.empty()) {
        continue;  // a classic file has no dimensions of length 0
      }
      const std::string number = std::to_string(i + 1);
      const std::size_t size = file_.add_dimension(names.size + number, sets[i].members.size());
      file_.add_variable(names.members + number, {size},
                         [&set = sets[i]](std::size_t k) { return set.members[k] + 1; });
      if (*names.sides != '\0') {
        file_.add_variable(names.sides + number, {size}, [&set = sets[i]](std::size_t k) { return set.sides[k] + 1; });
      }
    }
  }

  /// Variables of one time step; without any the file has no step, but times, which readers ask for.
  void add_variables() {
    const bool has_nodal = !at_nodes_.empty() && document_.point_count() > 0;
    const bool has_elemental = !at_elements_.empty() && plan_.elements > 0;
    if (has_nodal) {
      add_names("name_nod_var", file_.add_dimension("num_nod_var", at_nodes_.size()), at_nodes_);
    }
    if (has_elemental) {
      const std::size_t count = file_.add_dimension("num_elem_var", at_elements_.size());
      add_names("name_elem_var", count, at_elements_);
      file_.add_variable("elem_var_tab", {blocks_, count}, [](std::size_t /*i*/) { return std::int32_t{1}; });
    }
    const std::size_t step = file_.add_record_dimension("time_step", !has_nodal && !has_elemental);
    file_.add_variable("time_whole", {step}, [](std::size_t /*i*/) { return 0.0; });
    for (std::size_t i = 0; has_nodal && i < at_nodes_.size(); ++i) {
      file_.add_variable("vals_nod_var" + std::to_string(i + 1), {step, nodes_},
                         [&from = at_nodes_[i]](std::size_t k) { return from.array->value(k, from.component); });
    }
    for (std::size_t i = 0; has_elemental && i < at_elements_.size(); ++i) {
      for (std::size_t k = 0; k < plan_.blocks.size(); ++k) {
        file_.add_variable("vals_elem_var" + std::to_string(i + 1) + "eb" + std::to_string(k + 1),
                           {step, elements_in_[k]}, [&from = at_elements_[i], &block = plan_.blocks[k]](std::size_t n) {
                             return from.array->value(static_cast<std::size_t>(block.cells[n]), from.component);
                           });
      }
    }
  }

  const MeshDocument& document_;
  ExodusPlan plan_;
  std::vector<WrittenComponent> at_nodes_;
  std::vector<WrittenComponent> at_elements_;
  NetcdfWriter file_;
  std::size_t length_ = 0;  ///< the dimensions of names, nodes and blocks, and of the elements in each block
  std::size_t nodes_ = 0;
  std::size_t blocks_ = 0;
  std::vector<std::size_t> elements_in_;
  std::vector<std::int32_t> cell_of_;  ///< of elements
};

void write_exodus(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers) {
  ExodusWriter(document).write(path, workers);
}

bool is_whole(const DataArray& array) {
  return array.type != ScalarType::float32 && array.type != ScalarType::float64;
}

std::vector<std::string> lost_in_exodus(const MeshDocument& document) {
  const ExodusPlan plan = make_exodus_plan(document);
  const auto types = cell_types_where(
      [](std::uint8_t type) { return exodus_shape_of_cell(type).nodes > 0 || type == cell_type::polygon; });
  std::vector<std::string> sentences =
      describe_lost_cells("Exodus II", "points, lines, faces and solids", types, document.cells);
  std::ranges::move(describe_lost_field_arrays("Exodus II", document), std::back_inserter(sentences));
  std::string whole;
  std::vector<const DataArray*> rounded;
  for (const auto* arrays : {&document.point_arrays, &document.cell_arrays}) {
    for (const DataArray& array : *arrays) {
      if (is_whole(array) && (arrays == &document.point_arrays || !plan.group_arrays.has(array.name))) {
        add_to_list(whole, shown_name(array));
        rounded.push_back(&array);
      }
    }
  }
  if (!whole.empty()) {
    sentences.push_back("Exodus II has real numbers at nodes and elements: the whole ones of " + whole +
                        " are written as such");
  }
  std::ranges::move(describe_rounded("Exodus II", "real numbers", rounded), std::back_inserter(sentences));
  if (plan.lines_as_sides > 0) {
    sentences.push_back(
        "Exodus II has boundaries as sides of faces: " + counted(plan.lines_as_sides, "line is", "lines are") +
        " written in side sets, without values of cell arrays");
  }
  if (!plan.keeps_order) {
    sentences.emplace_back(
        "Exodus II lists cells by block, of a region and a type: they are written in another order, their old numbers "
        "are their labels (elem_num_map)");
  }
  for (const auto& [what, renumbered] :
       {std::pair("blocks", &plan.renumbered_blocks), std::pair("side sets", &plan.renumbered_sets)}) {
    if (!renumbered->empty()) {
      sentences.push_back("Exodus II numbers " + std::string(what) + " from 1 on, each number once: changed are " +
                          list_text(*renumbered));
    }
  }
  if (!plan.split.empty()) {
    sentences.push_back(
        "Exodus II has a block for each type of cell: groups of several types are several blocks, which their property "
        "'region' keeps together: " +
        list_text(plan.split));
  }
  if (!plan.renamed.empty()) {
    sentences.push_back("Exodus II has a name of its own for each block: changed are " + list_text(plan.renamed));
  }
  return sentences;
}

/// What the dimensions of each such file are called: a classic file begins with them, an HDF5 file has them anywhere.
bool is_exodus(std::string_view bytes) {
  return (is_classic_netcdf(bytes) || is_hdf5(bytes)) && bytes.find("num_dim") != std::string_view::npos &&
         (bytes.find("num_nodes") != std::string_view::npos || bytes.find("num_el_blk") != std::string_view::npos ||
          bytes.find("len_string") != std::string_view::npos);
}

}  // namespace

const Codec exodus_codec{
    {FileFormat::exodus, "exodus", "Exodus II", {".exo", ".e", ".ex2", ".g"}, {.arrays = true, .names = true}, 1},
    &read_exodus,
    &write_exodus,
    &lost_in_exodus,
    &is_exodus};

}  // namespace trismooth
