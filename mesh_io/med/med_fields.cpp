// SPDX-License-Identifier: BSD-3-Clause
// /CHA/<field>/<step>/NOE/<profile>/CO has the values, component by component.
#include "trismooth/mesh_io/med/med_fields.h"

#include <cstdint>
#include <set>
#include <utility>

#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/document/free_names.h"
#include "trismooth/mesh_io/text/number_text.h"

namespace trismooth {

namespace {

/// All nodes.
constexpr std::string_view no_profile = "MED_NO_PROFILE_INTERNAL";
/// More than any tensor has.
constexpr std::uint64_t most_components = 100;

class MedFieldsReader {
 public:
  MedFieldsReader(const Hdf5Reader& file, const std::string& mesh, std::size_t nodes, MemberBudget& budget)
      : file_(file), mesh_(mesh), nodes_(nodes), budget_(budget) {}

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
          "Fields that have no numbers at all nodes are kept in MED output only: " + list_text(kept_) + ".");
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

  void read_field(const std::string& name) {
    const std::string field = "/CHA/" + name;
    const std::vector<Hdf5Member> steps = file_.members(field);
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const std::string step = field + "/" + steps[i].name;
      if (steps[i].kind != Hdf5Kind::group) {
        continue;
      }
      for (const Hdf5Member& support : file_.members(step)) {
        std::string values = step + "/";
        values.append(support.name).append("/").append(no_profile).append("/CO");
        const bool has_all = support.name == "NOE" && file_.kind_of(values) == Hdf5Kind::dataset;
        if (!has_all || !read_values(values, steps.size() == 1 ? name : name_of_step(name, step, i))) {
          kept_.insert(name);
        }
      }
    }
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

  /// False where the dataset has no numbers for each node.
  bool read_values(const std::string& dataset, const std::string& name) {
    const Hdf5Shape shape = file_.shape_of(dataset);
    const std::uint64_t components = nodes_ == 0 ? 0 : shape.count() / nodes_;
    if (!shape.type || components == 0 || components > most_components || shape.count() % nodes_ != 0) {
      return false;
    }
    budget_.spend(static_cast<std::size_t>(shape.count()));
    const auto width = static_cast<std::size_t>(components);
    const std::string array_name = names_.claim(name);
    visit_scalar_type(*shape.type, [&](auto zero) {
      using T = decltype(zero);
      const std::vector<T> by_component = file_.read<T>(dataset);
      std::vector<T> rows(by_component.size());
      for (std::size_t row = 0; row < nodes_; ++row) {
        for (std::size_t i = 0; i < width; ++i) {
          rows[row * width + i] = by_component[i * nodes_ + row];
        }
      }
      fields_.arrays.push_back(make_data_array(array_name, width, std::move(rows)));
    });
    if (shape.type == ScalarType::float32 || shape.type == ScalarType::float64) {
      for (std::size_t i = 0; i < width; ++i) {
        fields_.columns.push_back({dataset, i * nodes_, nodes_, {array_name, static_cast<std::uint8_t>(i)}});
      }
    }
    return true;
  }

  const Hdf5Reader& file_;
  const std::string& mesh_;
  std::size_t nodes_;
  MemberBudget& budget_;
  FreeNames names_;
  std::set<std::string> kept_;
  MedFields fields_;
};

}  // namespace

MedFields read_med_fields(const Hdf5Reader& file, const std::string& mesh, std::size_t nodes, MemberBudget& budget) {
  return MedFieldsReader(file, mesh, nodes, budget).read();
}

}  // namespace trismooth
