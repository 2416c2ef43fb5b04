// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/exodus/exodus_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/base/text/digits.h"
#include "trismooth/base/text/letter_case.h"
#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/bytes/shared_blocks.h"
#include "trismooth/mesh_io/bytes/shared_resize.h"
#include "trismooth/mesh_io/document/free_names.h"
#include "trismooth/mesh_io/document/last_step.h"
#include "trismooth/mesh_io/document/point_ids.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/exodus/exodus_blocks.h"
#include "trismooth/mesh_io/netcdf/netcdf_file.h"
#include "trismooth/mesh_io/text/number_text.h"

namespace trismooth {

namespace {

constexpr std::array<std::string_view, 3> axis_names{"coordx", "coordy", "coordz"};

class ExodusReader {
 public:
  ExodusReader(const std::filesystem::path& path, std::string_view bytes, const FileWorkers& workers)
      : file_(path, bytes, workers), bytes_(bytes.size()), workers_(workers) {}

  MeshDocument read(FileBytes bytes) {
    read_points();
    read_labels();
    const std::vector<ExodusBlock> blocks = add_exodus_blocks(file_, axes_, workers_, document_);
    add_exodus_sets(file_, blocks, axes_, document_);
    read_variables(blocks);
    add_note_of_others();
    add_note_of_incomplete(file_, document_);
    document_.original = make_netcdf_original(file_, std::move(bytes), std::move(sites_));
    return std::move(document_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw ReadError(file_.path(), message); }

  void read_points() {
    // A classic file has no dimensions of length 0.
    const std::size_t nodes = file_.length_of("num_nodes").value_or(0);
    const auto axes = file_.length_of("num_dim");
    if (!axes) {
      fail("is netCDF and no mesh of Exodus II: it has no dimension num_dim");
    }
    if (*axes != 2 && *axes != 3) {
      fail("has nodes of " + std::to_string(*axes) + " coordinates; expected 2 or 3");
    }
    if (nodes > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
      fail("has more nodes than 32-bit indices can tell apart");
    }
    axes_ = *axes;
    // Before memory is taken for them.
    for (std::size_t axis = 0; axis < axes_ && nodes > 0; ++axis) {
      sites_.push_back(site_of(axis, nodes));
    }
    const auto is_float32 = [](const NetcdfSites& site) { return site.variable->type == NetcdfType::float32; };
    const bool has_float32 = std::ranges::any_of(sites_, is_float32);
    const bool is_mixed = has_float32 && !std::ranges::all_of(sites_, is_float32);
    document_.point_type = has_float32 && !is_mixed ? ScalarType::float32 : ScalarType::float64;
    document_.has_float32_axis = is_mixed;
    shared_resize(document_.points, 3 * nodes, workers_.workers);
    for (std::size_t axis = 0; axis < sites_.size(); ++axis) {
      const std::vector<double> values = file_.values<double>(*sites_[axis].variable, sites_[axis].leading);
      const std::size_t wrong = first_wrong(workers_, nodes, sizeof(double), [&](std::size_t i) {
        document_.points[3 * i + axis] = values[i];
        return !std::isfinite(values[i]);
      });
      if (wrong < nodes) {
        fail("node " + std::to_string(wrong + 1) + " has a coordinate that is no finite number");
      }
    }
  }

  NetcdfSites site_of(std::size_t axis, std::size_t nodes) const {
    NetcdfSites site;
    site.variable = file_.find(axis_names.at(axis));
    site.column.component = static_cast<std::uint8_t>(axis);
    if (site.variable == nullptr) {
      site.variable = file_.find("coord");
      site.leading = {axis};
    }
    if (site.variable == nullptr) {
      fail("has no coordinates (" + std::string(axis_names.at(axis)) + ")");
    }
    if (!is_real(site.variable->type) || site.variable->has_records ||
        site.variable->shape.size() != site.leading.size() + 1 || site.variable->shape.back() != nodes) {
      fail("has coordinates (" + std::string(axis_names.at(axis)) + ") that are not one real number for each node");
    }
    return site;
  }

  void read_labels() {
    document_.first_point_label = 1;
    for (const char* const name : {"node_num_map", "node_map"}) {
      const NetcdfVariable* const map = file_.find(name);
      if (map != nullptr && map->shape == std::vector{document_.point_count()}) {
        set_point_labels(document_, file_.values<std::int64_t>(*map));
        return;
      }
    }
  }

  /// The names of variables; those without one are called by their number.
  std::vector<std::string> names_of(const char* variable) {
    std::vector<std::string> names;
    if (const NetcdfVariable* const found = file_.find(variable); found != nullptr) {
      FreeNames taken;
      for (const std::string& name : file_.texts(*found)) {
        names.push_back(taken.claim(name.empty() ? "variable " + std::to_string(names.size() + 1) : name));
      }
    }
    return names;
  }

  void read_variables(const std::vector<ExodusBlock>& blocks) {
    steps_ = file_.length_of("time_step").value_or(0);
    const std::vector<std::string> at_nodes = names_of("name_nod_var");
    const std::vector<std::string> at_elements = names_of("name_elem_var");
    if (steps_ == 0) {
      return;
    }
    for (std::size_t i = 0; i < at_nodes.size(); ++i) {
      read_nodal(at_nodes[i], i);
    }
    read_elemental(at_elements, blocks);
    add_note_of_steps();
  }

  void read_nodal(const std::string& name, std::size_t number) {
    NetcdfSites site;
    site.variable = file_.find("vals_nod_var" + std::to_string(number + 1));
    site.leading = {steps_ - 1};
    if (site.variable == nullptr) {
      site.variable = file_.find("vals_nod_var");
      site.leading.push_back(number);
    }
    if (site.variable == nullptr || !is_real(site.variable->type) ||
        site.variable->shape.size() != site.leading.size() + 1 ||
        site.variable->shape.back() != document_.point_count() || site.variable->shape.front() != steps_) {
      return;
    }
    document_.point_arrays.push_back(file_.real_array(name, *site.variable, site.leading));
    if (steps_ == 1) {
      site.column.array = name;
      sites_.push_back(std::move(site));
    }
    if (lower_case(name).starts_with("disp")) {
      add_to_list(displacements_, name);
    }
  }

  /// Elements of blocks that do not have a variable have no number there. Where that takes many times the memory of the
  /// file, as with many variables of a few elements each, the variables stay in the file.
  void read_elemental(const std::vector<std::string>& names, const std::vector<ExodusBlock>& blocks) {
    std::map<std::size_t, const ExodusBlock*> of_number;
    for (const ExodusBlock& block : blocks) {
      of_number.emplace(block.number, &block);
    }
    std::map<std::size_t, std::vector<std::pair<const ExodusBlock*, const NetcdfVariable*>>> parts;
    for (const NetcdfVariable& variable : file_.content().variables) {
      constexpr std::string_view beginning = "vals_elem_var";
      const std::string_view rest =
          std::string_view(variable.name).substr(std::min(beginning.size(), variable.name.size()));
      const std::size_t middle = rest.find("eb");
      if (!variable.name.starts_with(beginning) || middle == std::string_view::npos) {
        continue;
      }
      const auto number = parse_integer(rest.substr(0, middle));
      const auto block_number = parse_integer(rest.substr(middle + 2));
      const auto block = of_number.find(static_cast<std::size_t>(block_number.value_or(0)));
      if (number && *number > 0 && static_cast<std::size_t>(*number) <= names.size() && block != of_number.end() &&
          block->second->has_cells && is_real(variable.type) &&
          variable.shape == std::vector{steps_, block->second->elements}) {
        parts[static_cast<std::size_t>(*number)].emplace_back(block->second, &variable);
      }
    }
    constexpr std::size_t most_expansion = 16;
    std::size_t left = most_expansion * bytes_;
    const std::size_t each = document_.cells.size() * sizeof(double);
    std::vector<std::string> unread;
    for (const auto& [number, of_blocks] : parts) {
      if (each > left) {
        unread.push_back(names[number - 1]);
        continue;
      }
      left -= each;
      std::vector<double> values(document_.cells.size(), std::numeric_limits<double>::quiet_NaN());
      for (const auto& [block, variable] : of_blocks) {
        const std::array last{steps_ - 1};
        std::ranges::copy(file_.values<double>(*variable, last),
                          values.begin() + static_cast<std::ptrdiff_t>(block->first_cell));
      }
      document_.cell_arrays.push_back(make_data_array(names[number - 1], 1, std::move(values)));
    }
    if (!unread.empty()) {
      constexpr std::size_t most = 5;
      document_.notes.push_back("Variables of few elements, of very many, are kept in Exodus output only: " +
                                first_of_list(unread, most) + ".");
    }
  }

  void add_note_of_steps() {
    if (document_.point_arrays.empty() && document_.cell_arrays.size() < 2) {
      return;
    }
    if (steps_ > 1) {
      std::optional<double> time;
      if (const NetcdfVariable* const times = file_.find("time_whole");
          times != nullptr && is_real(times->type) && times->shape == std::vector{steps_}) {
        time = file_.values<double>(*times).back();
      }
      document_.notes.push_back(note_of_last_step("Values at nodes and elements", steps_, time, "Exodus"));
    }
    if (!displacements_.empty()) {
      document_.notes.push_back(
          "The mesh is the one without displacements, which are values at nodes: " + displacements_ + ".");
    }
  }

  void add_note_of_others() {
    struct Other {
      const char* variable;
      const char* what;
    };
    std::string others;
    for (const Other& other : {Other{"dist_fact_ns1", "distribution factors of node sets"},
                               {"dist_fact_ss1", "distribution factors of side sets"},
                               {"attrib1", "attributes of elements"},
                               {"vals_glo_var", "global variables"},
                               {"name_nset_var", "variables of node sets"},
                               {"name_sset_var", "variables of side sets"},
                               {"ed_prop1", "blocks of edges"},
                               {"fa_prop1", "blocks of faces"}}) {
      if (file_.find(other.variable) != nullptr) {
        add_to_list(others, other.what);
      }
    }
    if (!others.empty()) {
      document_.notes.push_back("Kept in Exodus output only: " + others + ".");
    }
  }

  NetcdfFile file_;
  std::size_t bytes_;  ///< of the file
  const FileWorkers& workers_;
  MeshDocument document_;
  std::size_t axes_ = 0;
  std::size_t steps_ = 0;
  std::vector<NetcdfSites> sites_;  ///< coordinates first
  std::string displacements_;
};

}  // namespace

MeshDocument read_exodus(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers) {
  const std::string_view view = bytes;
  return ExodusReader(path, view, workers).read(std::move(bytes));
}

}  // namespace trismooth
