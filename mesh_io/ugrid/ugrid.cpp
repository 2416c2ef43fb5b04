// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/bytes/hdf5_signature.h"
#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/document/array_description.h"
#include "trismooth/mesh_io/document/cells/other_cells.h"
#include "trismooth/mesh_io/document/flat_points.h"
#include "trismooth/mesh_io/document/format_losses.h"
#include "trismooth/mesh_io/document/free_names.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/netcdf/netcdf_header.h"
#include "trismooth/mesh_io/netcdf/netcdf_writer.h"
#include "trismooth/mesh_io/text/text_scanner.h"
#include "trismooth/mesh_io/ugrid/ugrid_reader.h"

namespace trismooth {

namespace {

constexpr std::int32_t no_node = -1;

bool is_face(std::uint8_t type) {
  return type == cell_type::triangle || type == cell_type::quad || type == cell_type::polygon;
}

/// Real numbers, one a point or cell.
bool is_written(const DataArray& array) {
  return array.components == 1 && (array.type == ScalarType::float32 || array.type == ScalarType::float64);
}

/// A name as netCDF has it: it begins with a letter or '_', and has no blanks and slashes; no two alike.
std::string ugrid_name(std::string name, FreeNames& names) {
  std::ranges::replace_if(
      name, [](char c) { return static_cast<unsigned char>(c) <= ' ' || c == '/' || c == '\x7f'; }, '_');
  const bool begins_well = !name.empty() && (('A' <= (name[0] & ~0x20) && (name[0] & ~0x20) <= 'Z') || name[0] == '_');
  return names.claim(begins_well ? name : "values_" + name);
}

/// An array as a variable.
struct UgridVariable {
  const DataArray* array;  ///< of the document
  std::string name;
  bool is_at_nodes;
};

/// The arrays that are written, no two of a name, and none of that of another variable.
std::vector<UgridVariable> ugrid_variables(const MeshDocument& document) {
  FreeNames taken;
  for (const char* const name :
       {"mesh2d", "mesh2d_node_x", "mesh2d_node_y", "mesh2d_face_nodes", "mesh2d_boundary_nodes"}) {
    taken.take(name);
  }
  std::vector<UgridVariable> variables;
  for (const auto* const arrays : {&document.point_arrays, &document.cell_arrays}) {
    for (const DataArray& array : *arrays) {
      if (is_written(array)) {
        variables.push_back({&array, ugrid_name(array.name, taken), arrays == &document.point_arrays});
      }
    }
  }
  return variables;
}

/// The name and the unit stay beside the variable.
std::vector<NetcdfAttribute> attributes_of(const UgridVariable& variable) {
  std::vector<NetcdfAttribute> attributes{{"mesh", "mesh2d", {}},
                                          {"location", variable.is_at_nodes ? "node" : "face", {}}};
  if (variable.name != variable.array->name) {
    attributes.push_back({"long_name", variable.array->name, {}});
  }
  if (std::string unit = unit_of(*variable.array); !unit.empty()) {
    attributes.push_back({"units", std::move(unit), {}});
  }
  return attributes;
}

void write_ugrid(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers) {
  require_flat_points(path, "UGRID", document);
  const CellList& cells = document.cells;
  std::vector<std::int32_t> faces;
  std::vector<std::int32_t> lines;
  std::size_t most = 3;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    if (is_face(cells.types[cell])) {
      faces.push_back(static_cast<std::int32_t>(cell));
      most = std::max(most, cells[cell].size());
    } else if (cells.types[cell] == cell_type::line) {
      lines.push_back(static_cast<std::int32_t>(cell));
    }
  }
  if (faces.empty() || document.points.empty()) {
    throw WriteError(path, "UGRID holds meshes of faces, of which there are none");
  }
  NetcdfWriter file;
  file.add_attribute("Conventions", "CF-1.8 UGRID-1.0");
  const std::size_t nodes_dimension = file.add_dimension("mesh2d_nNodes", document.point_count());
  const std::size_t faces_dimension = file.add_dimension("mesh2d_nFaces", faces.size());
  const std::size_t most_dimension = file.add_dimension("mesh2d_nMax_face_nodes", most);
  std::vector<NetcdfAttribute> topology{{"cf_role", "mesh_topology", {}},
                                        {"topology_dimension", "", {2}},
                                        {"node_coordinates", "mesh2d_node_x mesh2d_node_y", {}},
                                        {"face_node_connectivity", "mesh2d_face_nodes", {}},
                                        {"face_dimension", "mesh2d_nFaces", {}}};
  if (!lines.empty()) {
    topology.push_back({"boundary_node_connectivity", "mesh2d_boundary_nodes", {}});
  }
  file.add_variable(
      "mesh2d", {}, [](std::size_t /*i*/) { return std::int32_t{0}; }, std::move(topology));
  constexpr std::array<const char*, 2> names{"mesh2d_node_x", "mesh2d_node_y"};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    std::vector<NetcdfAttribute> attributes{{"standard_name",
                                             document.is_geographic
                                                 ? (axis == 0 ? "longitude" : "latitude")
                                                 : (axis == 0 ? "projection_x_coordinate" : "projection_y_coordinate"),
                                             {}}};
    if (document.is_geographic) {
      attributes.push_back({"units", axis == 0 ? "degrees_east" : "degrees_north", {}});
    }
    file.add_variable(
        names.at(axis), {nodes_dimension},
        [&points = document.points, axis](std::size_t i) { return points[3 * i + axis]; }, std::move(attributes));
  }
  file.add_variable(
      "mesh2d_face_nodes", {faces_dimension, most_dimension},
      [&cells, &faces, most](std::size_t i) {
        const auto vertices = cells[static_cast<std::size_t>(faces[i / most])];
        return i % most < vertices.size() ? vertices[i % most] : no_node;
      },
      {{"cf_role", "face_node_connectivity", {}}, {"_FillValue", "", {no_node}}, {"start_index", "", {0}}});
  if (!lines.empty()) {
    const std::size_t count = file.add_dimension("mesh2d_nBoundary_edges", lines.size());
    const std::size_t two = file.add_dimension("Two", 2);
    file.add_variable("mesh2d_boundary_nodes", {count, two},
                      [&cells, &lines](std::size_t i) { return cells[static_cast<std::size_t>(lines[i / 2])][i % 2]; },
                      {{"cf_role", "boundary_node_connectivity", {}}, {"start_index", "", {0}}});
  }
  for (const UgridVariable& variable : ugrid_variables(document)) {
    const DataArray& array = *variable.array;
    if (variable.is_at_nodes) {
      file.add_variable(
          variable.name, {nodes_dimension}, [&array](std::size_t i) { return array.value(i); },
          attributes_of(variable));
    } else {
      file.add_variable(
          variable.name, {faces_dimension},
          [&array, &faces](std::size_t i) { return array.value(static_cast<std::size_t>(faces[i])); },
          attributes_of(variable));
    }
  }
  file.write(path, workers);
}

std::vector<std::string> lost_in_ugrid(const MeshDocument& document) {
  constexpr std::array types{cell_type::triangle, cell_type::quad, cell_type::polygon, cell_type::line};
  std::vector<std::string> sentences = describe_lost_cells("UGRID", "faces and lines", types, document.cells);
  constexpr std::array written_types{cell_type::triangle, cell_type::line};
  MeshDocument kinds;  // lines stand behind faces
  for (const std::uint8_t type : document.cells.types) {
    if (is_face(type) || type == cell_type::line) {
      kinds.cells.append(is_face(type) ? cell_type::triangle : type, {});
    }
  }
  std::ranges::move(describe_new_order("UGRID", written_types, kinds.cells), std::back_inserter(sentences));
  std::string arrays;
  for (const auto* all : {&document.point_arrays, &document.cell_arrays}) {
    for (const DataArray& array : *all) {
      if (!is_written(array)) {
        add_to_list(arrays, shown_name(array));
      }
    }
  }
  if (!arrays.empty()) {
    sentences.push_back("UGRID gets arrays of real numbers, one a point or face: not written are " + arrays);
  }
  std::string renamed;
  for (const UgridVariable& variable : ugrid_variables(document)) {
    if (variable.name != variable.array->name) {
      add_to_list(renamed, trismooth::quoted(variable.array->name) + " (as " + variable.name + ")");
    }
  }
  if (!renamed.empty()) {
    sentences.push_back(
        "UGRID has names of variables without blanks and slashes that begin with a letter, each once: changed are " +
        renamed);
  }
  std::ranges::move(describe_lost_field_arrays("UGRID", document), std::back_inserter(sentences));
  std::ranges::move(describe_lost_sets("UGRID", document), std::back_inserter(sentences));
  std::ranges::move(describe_lost_z("UGRID", document), std::back_inserter(sentences));
  return sentences;
}

/// A role that a variable of each such file has. An HDF5 file has it anywhere, a classic one in its header.
bool is_ugrid(std::string_view bytes) {
  return (is_classic_netcdf(bytes) || is_hdf5(bytes)) && bytes.find("mesh_topology") != std::string_view::npos;
}

}  // namespace

const Codec ugrid_codec{{FileFormat::ugrid,
                         "ugrid",
                         "UGRID",
                         {".nc"},
                         {.names = true, .curved_cells = false, .eight_node_quads = false},
                         0},
                        &read_ugrid,
                        &write_ugrid,
                        &lost_in_ugrid,
                        &is_ugrid};

}  // namespace trismooth
