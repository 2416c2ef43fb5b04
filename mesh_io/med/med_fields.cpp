// SPDX-License-Identifier: BSD-3-Clause
// /CHA/<field>/<step>/NOE/<profile>/CO has the values at nodes, MAI.<type> in place of NOE those at elements, component
// by component.
#include "trismooth/mesh_io/med/med_fields.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <type_traits>
#include <utility>

#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/document/array_description.h"
#include "trismooth/mesh_io/document/free_names.h"
#include "trismooth/mesh_io/text/blanks.h"
#include "trismooth/mesh_io/text/number_text.h"

namespace trismooth {

namespace {

/// More than any tensor has.
constexpr std::uint64_t most_components = 100;

/// Values of a field at the elements of a type.
struct BlockValues {
  const MedBlock* block;
  std::string dataset;
};

class MedFieldsReader {
 public:
  MedFieldsReader(const Hdf5Reader& file, const std::string& mesh, std::span<const MedBlock> blocks,
                  const MeshDocument& document, MemberBudget& budget)
      : file_(file), mesh_(mesh), blocks_(blocks), document_(document), budget_(budget) {
    for (const DataArray& array : document.cell_arrays) {
      cell_names_.take(array.name);
    }
  }

  MedFields read() {
    if (file_.kind_of("/CHA") == Hdf5Kind::group) {
      for (const Hdf5Member& field : file_.members("/CHA")) {
        if (field.kind == Hdf5Kind::group && is_of_mesh("/CHA/" + field.name)) {
          read_field(field.name);
        }
      }
    }
    if (!kept_.empty()) {
      fields_.notes.push_back(
          "Fields that have no numbers at all nodes, or at all elements of a type, are kept in MED output only: " +
          list_text(kept_) + ".");
    }
    if (!with_units_.empty()) {
      fields_.notes.push_back(
          "Units that differ from component to component are kept in MED output only: " + list_text(with_units_) + ".");
    }
    return std::move(fields_);
  }

 private:
  bool is_of_mesh(const std::string& field) const {
    if (!file_.has_attribute(field, "MAI")) {
      return true;
    }
    const std::vector<std::string> names = file_.read_attribute_texts(field, "MAI");
    return names.size() == 1 && names.front() == mesh_;
  }

  /// The unit of all components; empty: none, or several, which no array has.
  std::string unit_of_field(const std::string& name, const std::string& field) {
    if (!file_.has_attribute(field, "UNI") || !file_.has_attribute(field, "NCO")) {
      return {};
    }
    std::string texts = list_text(file_.read_attribute_texts(field, "UNI"), {}, "");
    const std::vector<std::int64_t> components = file_.read_attribute<std::int64_t>(field, "NCO");
    std::set<std::string> units;
    const std::int64_t count = components.size() == 1 ? std::min<std::int64_t>(components[0], most_components) : 0;
    for (std::int64_t i = 0; i < count; ++i) {
      texts.resize(std::max(texts.size(), med_component_size), ' ');
      units.emplace(trimmed(std::string_view(texts).substr(0, med_component_size)));
      texts.erase(0, med_component_size);
    }
    if (units.size() > 1) {
      with_units_.insert(name);
    }
    return units.size() == 1 ? *units.begin() : std::string();
  }

  void read_field(const std::string& name) {
    const std::string field = "/CHA/" + name;
    const std::size_t point_arrays = fields_.point_arrays.size();
    const std::size_t cell_arrays = fields_.cell_arrays.size();
    read_steps(name, field);
    const std::string unit = unit_of_field(name, field);
    for (DataArray& array : std::span(fields_.point_arrays).subspan(point_arrays)) {
      set_unit(array, unit);
    }
    for (DataArray& array : std::span(fields_.cell_arrays).subspan(cell_arrays)) {
      set_unit(array, unit);
    }
  }

  void read_steps(const std::string& name, const std::string& field) {
    const std::vector<Hdf5Member> steps = file_.members(field);
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const std::string step = field + "/" + steps[i].name;
      if (steps[i].kind != Hdf5Kind::group) {
        continue;
      }
      const std::string array = steps.size() == 1 ? name : name_of_step(name, step, i);
      std::vector<BlockValues> at_elements;
      for (const Hdf5Member& support : file_.members(step)) {
        std::string values = step + "/";
        values.append(support.name).append("/").append(med_all_entities).append("/CO");
        const bool has_values = file_.kind_of(values) == Hdf5Kind::dataset;
        const MedBlock* const block = has_values ? block_of(support.name) : nullptr;
        if (block != nullptr && components_of(values, block->count)) {
          at_elements.push_back({block, std::move(values)});
        } else if (!has_values || support.name != "NOE" || !read_nodes(values, array)) {
          kept_.insert(name);
        }
      }
      if (!at_elements.empty() && !read_elements(at_elements, array)) {
        kept_.insert(name);
      }
    }
  }

  /// The elements that values are of which stand under that name ("MAI.TR3"); null: none.
  const MedBlock* block_of(std::string_view support) const {
    constexpr std::string_view beginning = "MAI.";
    if (!support.starts_with(beginning)) {
      return nullptr;
    }
    const auto found = std::ranges::find(blocks_, support.substr(beginning.size()), &MedBlock::type);
    return found == blocks_.end() ? nullptr : &*found;
  }

  /// As meshio calls it.
  std::string name_of_step(const std::string& name, const std::string& step, std::size_t index) const {
    std::string text = name + "[" + std::to_string(index) + "]";
    if (file_.has_attribute(step, "PDT")) {
      const std::vector<double> time = file_.read_attribute<double>(step, "PDT");
      if (time.size() == 1) {
        append_number(text += " - ", time[0]);
      }
    }
    return text;
  }

  /// Of a dataset that has as many numbers for each of `count` nodes or elements; nothing where it has not, or where
  /// there are several points in an element that it is of.
  std::optional<std::size_t> components_of(const std::string& dataset, std::size_t count) const {
    const Hdf5Shape shape = file_.shape_of(dataset);
    const std::uint64_t components = count == 0 ? 0 : shape.count() / count;
    const std::string profile = dataset.substr(0, dataset.rfind('/'));
    if (!shape.type || components == 0 || components > most_components || shape.count() % count != 0) {
      return std::nullopt;
    }
    if (file_.has_attribute(profile, "NGA")) {
      const std::vector<std::int64_t> points = file_.read_attribute<std::int64_t>(profile, "NGA");
      if (points.size() != 1 || points[0] > 1) {
        return std::nullopt;
      }
    }
    return static_cast<std::size_t>(components);
  }

  /// False where the dataset has no numbers for each node.
  bool read_nodes(const std::string& dataset, const std::string& name) {
    const std::size_t nodes = document_.point_count();
    const auto components = components_of(dataset, nodes);
    if (!components) {
      return false;
    }
    const std::size_t width = *components;
    budget_.spend(nodes * width);
    const std::string array_name = names_.claim(name);
    const ScalarType type = *file_.shape_of(dataset).type;
    visit_scalar_type(type, [&](auto zero) {
      std::vector<decltype(zero)> rows(nodes * width);
      add_rows(dataset, nodes, 0, width, rows);
      fields_.point_arrays.push_back(make_data_array(array_name, width, std::move(rows)));
    });
    if (type == ScalarType::float32 || type == ScalarType::float64) {
      for (std::size_t i = 0; i < width; ++i) {
        fields_.columns.push_back(
            hdf5_column(file_, dataset, i * nodes, nodes, {{array_name, static_cast<std::uint8_t>(i)}}));
      }
    }
    return true;
  }

  /// False where the blocks have other components, or types of numbers.
  bool read_elements(const std::vector<BlockValues>& blocks, const std::string& name) {
    const std::size_t width = *components_of(blocks.front().dataset, blocks.front().block->count);
    const ScalarType type = *file_.shape_of(blocks.front().dataset).type;
    const bool are_alike = std::ranges::all_of(blocks, [&](const BlockValues& values) {
      return components_of(values.dataset, values.block->count) == width && file_.shape_of(values.dataset).type == type;
    });
    if (!are_alike) {
      return false;
    }
    budget_.spend(document_.cells.size() * width);
    visit_scalar_type(type, [&](auto zero) {
      using T = decltype(zero);
      const T none = std::is_floating_point_v<T> ? std::numeric_limits<T>::quiet_NaN() : T{};
      std::vector<T> rows(document_.cells.size() * width, none);
      for (const BlockValues& values : blocks) {
        add_rows(values.dataset, values.block->count, values.block->first, width, rows);
      }
      fields_.cell_arrays.push_back(make_data_array(cell_names_.claim(name), width, std::move(rows)));
    });
    return true;
  }

  /// The values of the dataset, of `count` nodes or elements, become the rows from `first` on.
  template <class T>
  void add_rows(const std::string& dataset, std::size_t count, std::size_t first, std::size_t width,
                std::vector<T>& rows) const {
    const std::vector<T> by_component = file_.read<T>(dataset);
    for (std::size_t row = 0; row < count; ++row) {
      for (std::size_t i = 0; i < width; ++i) {
        rows[(first + row) * width + i] = by_component[i * count + row];
      }
    }
  }

  const Hdf5Reader& file_;
  const std::string& mesh_;
  std::span<const MedBlock> blocks_;
  const MeshDocument& document_;
  MemberBudget& budget_;
  FreeNames names_;
  FreeNames cell_names_;
  std::set<std::string> kept_;
  std::set<std::string> with_units_;  ///< of several kinds
  MedFields fields_;
};

}  // namespace

MedFields read_med_fields(const Hdf5Reader& file, const std::string& mesh, std::span<const MedBlock> blocks,
                          const MeshDocument& document, MemberBudget& budget) {
  return MedFieldsReader(file, mesh, blocks, document, budget).read();
}

}  // namespace trismooth
