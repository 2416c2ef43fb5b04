// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_writer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "trismooth/mesh_io/bytes/buffered_writer.h"
#include "trismooth/mesh_io/document/free_names.h"
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_names.h"
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_roles.h"

namespace trismooth {

namespace {

/// About what a number takes as text.
constexpr std::size_t legacy_number_bytes = 16;

bool is_finite(const DataArray& array) {
  return visit_scalar_type(array.type, [&](auto zero) {
    using T = decltype(zero);
    if constexpr (std::is_floating_point_v<T>) {
      return std::ranges::all_of(array.as<T>(), [](T value) { return std::isfinite(value); });
    } else {
      return true;
    }
  });
}

bool are_finite(std::span<const DataArray> arrays) {
  return std::ranges::all_of(arrays, [](const DataArray& array) { return is_finite(array); });
}

template <class T>
void write_points_as(VtkLegacyOutput& output, std::span<const double> points) {
  output.numbers(points.size() / 3, 3 * legacy_number_bytes, [points](VtkLegacyNumbers& numbers, std::size_t point) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      numbers.append(static_cast<T>(points[3 * point + axis]), axis == 2 ? '\n' : ' ');
    }
  });
}

void write_points(VtkLegacyOutput& output, const MeshDocument& document) {
  output.text("POINTS " + std::to_string(document.point_count()) + " " +
              std::string(vtk_legacy_type_name(document.point_type)) + "\n");
  if (document.point_type == ScalarType::float32) {
    write_points_as<float>(output, document.points);
  } else {
    write_points_as<double>(output, document.points);
  }
  output.text(vtk_legacy_metadata(document.points_description.get()));
}

void write_cells(VtkLegacyOutput& output, const CellList& cells) {
  output.text("CELLS " + std::to_string(cells.size()) + " " + std::to_string(cells.size() + cells.connectivity.size()) +
              "\n");
  output.numbers(cells.size(), 2 * legacy_number_bytes, [&cells](VtkLegacyNumbers& numbers, std::size_t cell) {
    const std::span<const std::int32_t> vertices = cells[cell];
    numbers.append(static_cast<std::int32_t>(vertices.size()), vertices.empty() ? '\n' : ' ');
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      numbers.append(vertices[i], i + 1 == vertices.size() ? '\n' : ' ');
    }
  });
  output.text("CELL_TYPES " + std::to_string(cells.size()) + "\n");
  output.numbers(cells.size(), sizeof(std::int32_t), [&cells](VtkLegacyNumbers& numbers, std::size_t cell) {
    numbers.append(std::int32_t{cells.types[cell]}, '\n');
  });
}

/// The arrays under names of which no two are the same.
std::vector<DataArray> with_free_names(std::span<const DataArray> arrays) {
  std::vector<DataArray> named(arrays.begin(), arrays.end());
  FreeNames names;
  for (DataArray& array : named) {
    array.name = names.claim(array.name.empty() ? "unnamed" : array.name);
  }
  return named;
}

/// The arrays in their order: those with a role by themselves, those between them in a FIELD each.
void write_section(VtkLegacyOutput& output, VtkLegacyData data, std::size_t rows, std::span<const DataArray> arrays) {
  if (arrays.empty()) {
    return;
  }
  output.text((data == VtkLegacyData::points ? "POINT_DATA " : "CELL_DATA ") + std::to_string(rows) + "\n");
  const std::vector<DataArray> named = with_free_names(arrays);
  const std::span<const DataArray> all(named);
  std::size_t written = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (const auto header = vtk_legacy_role_header(all[i], encode_vtk_name(all[i].name), data)) {
      output.field(all.subspan(written, i - written), {});
      output.text(*header);
      output.values(all[i]);
      written = i + 1;
    }
  }
  output.field(all.subspan(written), {});
}

}  // namespace

void VtkLegacyOutput::field(std::span<const DataArray> arrays, std::span<const std::string> taken_names) {
  if (arrays.empty()) {
    return;
  }
  FreeNames names;
  for (const std::string& name : taken_names) {
    names.take(name);
  }
  text("FIELD FieldData " + std::to_string(arrays.size()) + "\n");
  for (const DataArray& array : arrays) {
    text(encode_vtk_name(names.claim(array.name.empty() ? "unnamed" : array.name)) + " " +
         std::to_string(array.components) + " " + std::to_string(array.rows()) + " " +
         std::string(vtk_legacy_type_name(array.type)) + "\n");
    values(array);
  }
}

void VtkLegacyOutput::values(const DataArray& array) {
  visit_scalar_type(array.type, [&](auto zero) {
    const auto values = array.as<decltype(zero)>();
    this->numbers(values.size(), legacy_number_bytes, [&](VtkLegacyNumbers& numbers, std::size_t i) {
      numbers.append(values[i], (i + 1) % array.components == 0 ? '\n' : ' ');
    });
  });
  text(vtk_legacy_metadata(array.description.get()));
}

void write_vtk_legacy(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers) {
  const bool binary =
      !are_finite(document.point_arrays) || !are_finite(document.cell_arrays) || !are_finite(document.field_arrays);
  BufferedWriter writer(path);
  VtkLegacyOutput output(
      binary, [&](std::string_view block) { writer.write(block); }, workers);
  output.text("# vtk DataFile Version 3.0\nwritten by trismooth\n");
  output.text(binary ? "BINARY\n" : "ASCII\n");
  output.text("DATASET UNSTRUCTURED_GRID\n");
  output.field(document.field_arrays, {});
  write_points(output, document);
  write_cells(output, document.cells);
  write_section(output, VtkLegacyData::points, document.point_count(), document.point_arrays);
  write_section(output, VtkLegacyData::cells, document.cells.size(), document.cell_arrays);
  writer.close();
}

}  // namespace trismooth
