// SPDX-License-Identifier: BSD-3-Clause
// As http://ugrid-conventions.github.io/ugrid-conventions says: a variable with the attribute cf_role = "mesh_topology"
// names all others.
#include "trismooth/mesh_io/ugrid/ugrid_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/bytes/shared_resize.h"
#include "trismooth/mesh_io/document/array_description.h"
#include "trismooth/mesh_io/document/integer_array.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/netcdf/netcdf_file.h"
#include "trismooth/mesh_io/text/blanks.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

constexpr auto most_items = static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());

/// What numbers a variable has in the place of none, and the number of the first node.
struct Numbering {
  std::optional<double> fill{};
  std::int64_t first = 0;
};

class UgridReader {
 public:
  UgridReader(const std::filesystem::path& path, std::string_view bytes, const FileWorkers& workers)
      : file_(path, bytes, workers), left_for_lines_(16 * bytes.size()), workers_(workers) {}

  MeshDocument read(FileBytes bytes) {
    find_topology();
    read_points();
    read_faces();
    read_boundary();
    read_values();
    add_notes();
    add_note_of_incomplete(file_, document_);
    document_.original = make_netcdf_original(file_, std::move(bytes), std::move(sites_));
    return std::move(document_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw ReadError(file_.path(), message); }

  void find_topology() {
    constexpr double plane = 2;
    bool has_other = false;
    std::string more;
    for (const NetcdfVariable& variable : file_.content().variables) {
      if (variable.text_of("cf_role") != "mesh_topology") {
        continue;
      }
      const NetcdfAttribute* const dimension = find_attribute(variable.attributes, "topology_dimension");
      if (dimension != nullptr && (dimension->numbers.empty() || dimension->numbers.front() != plane)) {
        has_other = true;
      } else if (topology_ == nullptr) {
        topology_ = &variable;
      } else {
        add_to_list(more, trismooth::quoted(variable.name));
      }
    }
    if (topology_ == nullptr) {
      fail(has_other ? "has a mesh of UGRID, but none of two dimensions (topology_dimension = 2)"
                     : "is netCDF without a mesh of UGRID: no variable has cf_role = \"mesh_topology\"");
    }
    if (!more.empty()) {
      document_.notes.push_back("The file has further meshes, which are not read: " + more + ".");
    }
  }

  const NetcdfVariable& variable_of(std::string_view name, const std::string& what) const {
    const NetcdfVariable* const found = file_.find(name);
    if (found == nullptr) {
      fail(what + " " + trismooth::quoted(name) + " is no variable of the file");
    }
    return *found;
  }

  void read_points() {
    const std::vector<std::string_view> names = words_of(topology_->text_of("node_coordinates"));
    if (names.size() < 2) {
      fail("its mesh " + trismooth::quoted(topology_->name) + " names no node_coordinates");
    }
    std::array<const NetcdfVariable*, 2> axes{&variable_of(names[0], "the coordinate"),
                                              &variable_of(names[1], "the coordinate")};
    const auto is_latitude = [](const NetcdfVariable& variable) {
      return variable.text_of("standard_name") == "latitude" || variable.text_of("units") == "degrees_north";
    };
    if (is_latitude(*axes[0]) && !is_latitude(*axes[1])) {
      std::swap(axes[0], axes[1]);
    }
    for (const NetcdfVariable* const axis : axes) {
      if (!is_real(axis->type) || axis->shape.size() != 1 || axis->has_records ||
          axis->dimensions != axes[0]->dimensions) {
        fail("the coordinate " + trismooth::quoted(axis->name) + " is not one real number for each node");
      }
    }
    if (axes[0] == axes[1]) {
      fail("both coordinates are " + trismooth::quoted(axes[0]->name));
    }
    node_dimension_ = axes[0]->dimensions.front();
    const std::size_t nodes = axes[0]->shape.front();
    if (nodes > most_items) {
      fail("has more nodes than 32-bit indices can tell apart");
    }
    document_.is_geographic =
        axes[0]->text_of("standard_name") == "longitude" || axes[0]->text_of("units").starts_with("degree");
    const auto is_float32 = [](const NetcdfVariable* axis) { return axis->type == NetcdfType::float32; };
    const bool is_all = is_float32(axes[0]) && is_float32(axes[1]);
    document_.point_type = is_all ? ScalarType::float32 : ScalarType::float64;
    document_.has_float32_axis = !is_all && (is_float32(axes[0]) || is_float32(axes[1]));
    shared_resize(document_.points, 3 * nodes, workers_.workers);
    for (std::uint8_t component = 0; component < 2; ++component) {
      const NetcdfVariable& axis = *axes.at(component);
      const std::vector<double> values = file_.values<double>(axis);
      for (std::size_t i = 0; i < nodes; ++i) {
        if (!std::isfinite(values[i])) {
          fail(trismooth::quoted(axis.name) + " of node " + std::to_string(i) + " (from 0) is no finite number");
        }
        document_.points[3 * i + component] = values[i];
      }
      sites_.push_back({&axis, {}, {.component = component}});
      used_.insert(&axis);
    }
  }

  /// The numbers of a table of nodes, row by row, whole or real.
  std::vector<double> table_of(const NetcdfVariable& variable, Numbering& numbering) const {
    if (variable.shape.size() != 2) {
      fail(trismooth::quoted(variable.name) + " is no table of the nodes of faces or edges");
    }
    for (const char* const name : {"_FillValue", "missing_value"}) {
      const NetcdfAttribute* const fill = find_attribute(variable.attributes, name);
      if (!numbering.fill && fill != nullptr && !fill->numbers.empty()) {
        numbering.fill = fill->numbers.front();
      }
    }
    const NetcdfAttribute* const first = find_attribute(variable.attributes, "start_index");
    if (first != nullptr && !first->numbers.empty()) {
      if (first->numbers.front() != 0 && first->numbers.front() != 1) {
        fail(trismooth::quoted(variable.name) + " numbers nodes from another start_index than 0 or 1");
      }
      numbering.first = static_cast<std::int64_t>(first->numbers.front());
    }
    return file_.values<double>(variable);
  }

  /// The node of that number, or -1 for none.
  std::int32_t node_of(double number, const Numbering& numbering, const NetcdfVariable& variable,
                       std::size_t row) const {
    if (!(number >= 0) || number == numbering.fill) {
      return -1;
    }
    const double node = number - static_cast<double>(numbering.first);
    if (node < 0 || node >= static_cast<double>(document_.point_count()) || node != std::floor(node)) {
      fail(trismooth::quoted(variable.name) + ": row " + std::to_string(row) + " (from 0) names node " +
           std::to_string(static_cast<std::int64_t>(std::min(number, 1e18))) + ", of " +
           std::to_string(document_.point_count()) + " from " + std::to_string(numbering.first));
    }
    return static_cast<std::int32_t>(node);
  }

  void read_faces() {
    const std::string_view name = topology_->text_of("face_node_connectivity");
    if (name.empty()) {
      fail("its mesh " + trismooth::quoted(topology_->name) + " has no faces (face_node_connectivity)");
    }
    const NetcdfVariable& variable = variable_of(name, "face_node_connectivity");
    used_.insert(&variable);
    Numbering numbering;
    const std::vector<double> table = table_of(variable, numbering);
    document_.first_point_label = numbering.first;
    const std::string_view dimension = topology_->text_of("face_dimension");
    const bool is_transposed = !dimension.empty() &&
                               file_.content().dimensions[variable.dimensions[1]].name == dimension &&
                               file_.content().dimensions[variable.dimensions[0]].name != dimension;
    face_dimension_ = variable.dimensions[is_transposed ? 1 : 0];
    const std::size_t faces = variable.shape[is_transposed ? 1 : 0];
    const std::size_t most = variable.shape[is_transposed ? 0 : 1];
    if (faces > most_items) {
      fail("has more faces than 32-bit indices can tell apart");
    }
    CellList& cells = document_.cells;
    cells.types.reserve(faces);
    cells.offsets.reserve(faces + 1);
    std::vector<std::int32_t> vertices;
    for (std::size_t face = 0; face < faces && most > 0; ++face) {
      vertices.clear();
      bool has_ended = false;
      for (std::size_t k = 0; k < most; ++k) {
        const std::int32_t node =
            node_of(table[is_transposed ? k * faces + face : face * most + k], numbering, variable, face);
        if (node >= 0 && has_ended) {
          fail(trismooth::quoted(variable.name) + ": row " + std::to_string(face) +
               " (from 0) has a node behind the end of its face");
        }
        has_ended = node < 0;
        if (!has_ended) {
          vertices.push_back(node);
        }
      }
      constexpr std::size_t least = 3;
      if (vertices.size() < least) {
        fail(trismooth::quoted(variable.name) + ": row " + std::to_string(face) + " (from 0) has fewer than 3 nodes");
      }
      cells.append(cell_type::of_face(vertices.size()), vertices);
    }
  }

  void read_boundary() {
    const std::string_view name = topology_->text_of("boundary_node_connectivity");
    if (name.empty()) {
      return;
    }
    const NetcdfVariable& variable = variable_of(name, "boundary_node_connectivity");
    Numbering numbering;
    const std::vector<double> table = table_of(variable, numbering);
    if (variable.shape[1] != 2) {
      fail(trismooth::quoted(variable.name) + " does not have two nodes for each edge");
    }
    if (variable.shape[0] > most_items - document_.cells.size()) {
      fail("has more faces and edges than 32-bit indices can tell apart");
    }
    for (std::size_t edge = 0; edge < variable.shape[0]; ++edge) {
      const std::array ends{node_of(table[2 * edge], numbering, variable, edge),
                            node_of(table[2 * edge + 1], numbering, variable, edge)};
      if (ends[0] < 0 || ends[1] < 0) {
        fail(trismooth::quoted(variable.name) + ": row " + std::to_string(edge) + " (from 0) has fewer than 2 nodes");
      }
      document_.cells.append(cell_type::line, ends);
    }
  }

  void read_values() {
    for (const NetcdfVariable& variable : file_.content().variables) {
      if (used_.contains(&variable) || variable.type == NetcdfType::other) {
        continue;
      }
      const bool is_packed = find_attribute(variable.attributes, "scale_factor") != nullptr ||
                             find_attribute(variable.attributes, "add_offset") != nullptr;
      const bool is_of_mesh =
          variable.dimensions == std::vector{node_dimension_} || variable.dimensions == std::vector{face_dimension_};
      if (is_packed && is_of_mesh) {
        packed_.push_back(variable.name);
      } else if (variable.dimensions == std::vector{node_dimension_}) {
        read_node_values(variable);
      } else if (variable.dimensions == std::vector{face_dimension_} && !is_derived(variable)) {
        read_face_values(variable);
      } else if (variable.dimensions.size() > 1 &&
                 std::ranges::find(variable.dimensions, node_dimension_) != variable.dimensions.end()) {
        of_times_.push_back(variable.name);
      }
    }
  }

  void read_node_values(const NetcdfVariable& variable) {
    if (is_real(variable.type)) {
      document_.point_arrays.push_back(file_.real_array(variable.name, variable, {}));
      document_.arrays_of_places.push_back(variable.name);
      sites_.push_back({&variable, {}, {variable.name, 0}});
    } else if (is_whole(variable.type)) {
      document_.point_arrays.push_back(make_integer_array(variable.name, file_.values<std::int64_t>(variable)));
    } else {
      return;
    }
    set_unit(document_.point_arrays.back(), std::string(variable.text_of("units")));
  }

  /// Lines have no such value: 0, or no number. Where these take many times the memory of the file, as with very many
  /// variables of a few faces, the variables stay in the file.
  void read_face_values(const NetcdfVariable& variable) {
    const std::size_t cells = document_.cells.size();
    const std::size_t added = (cells - variable.shape.front()) * sizeof(double);
    if (added > left_for_lines_) {
      of_times_.push_back(variable.name);
      return;
    }
    left_for_lines_ -= added;
    if (is_real(variable.type)) {
      std::vector<double> values = file_.values<double>(variable);
      values.resize(cells, std::numeric_limits<double>::quiet_NaN());
      document_.cell_arrays.push_back(make_data_array(variable.name, 1, std::move(values)));
    } else if (is_whole(variable.type)) {
      std::vector<std::int64_t> values = file_.values<std::int64_t>(variable);
      values.resize(cells);
      document_.cell_arrays.push_back(make_integer_array(variable.name, std::move(values)));
    } else {
      return;
    }
    set_unit(document_.cell_arrays.back(), std::string(variable.text_of("units")));
  }

  bool is_derived(const NetcdfVariable& variable) const {
    const std::vector<std::string_view> names = words_of(topology_->text_of("face_coordinates"));
    return std::ranges::find(names, variable.name) != names.end();
  }

  void add_notes() {
    std::string derived;
    for (const char* const attribute : {"face_coordinates", "edge_coordinates", "boundary_coordinates"}) {
      for (const std::string_view name : words_of(topology_->text_of(attribute))) {
        add_to_list(derived, name);
      }
    }
    if (!derived.empty()) {
      document_.notes.push_back(
          "Places of faces and edges stay in UGRID output as they were read, also where nodes "
          "move: " +
          derived + ".");
    }
    constexpr std::size_t most = 8;
    if (!packed_.empty()) {
      document_.notes.push_back("Values that are packed (scale_factor, add_offset) are kept in UGRID output only: " +
                                first_of_list(packed_, most) + "; 'ncpdq -U in.nc out.nc' unpacks them.");
    }
    if (!of_times_.empty()) {
      document_.notes.push_back(
          "Values of several times or layers are kept in UGRID output only: " + first_of_list(of_times_, most) + ".");
    }
  }

  NetcdfFile file_;
  std::vector<std::string> packed_;
  std::size_t left_for_lines_;  ///< bytes that values of these may take
  const FileWorkers& workers_;
  MeshDocument document_;
  const NetcdfVariable* topology_ = nullptr;
  std::size_t node_dimension_ = 0;
  std::size_t face_dimension_ = 0;
  std::vector<NetcdfSites> sites_;
  std::set<const NetcdfVariable*> used_;
  std::vector<std::string> of_times_;
};

}  // namespace

MeshDocument read_ugrid(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers) {
  const std::string_view view = bytes;
  return UgridReader(path, view, workers).read(std::move(bytes));
}

}  // namespace trismooth
