#include "trismooth/mesh_io/planar_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <stdexcept>
#include <string_view>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/strip_triangles.h"

namespace trismooth {

namespace {

bool is_triangle(std::uint8_t type, std::span<const std::int32_t> vertices) {
  return vertices.size() == 3 && (type == cell_type::triangle || type == cell_type::polygon);
}

bool repeats_a_vertex(std::span<const std::int32_t> triangle) {
  return triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0];
}

std::string counted(std::int64_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

/// Adds the triangles of a strip; false where it has none.
bool add_strip(std::span<const std::int32_t> strip, std::size_t cell, PlanarMesh& mesh) {
  for_each_strip_triangle(strip, [&](const Triangle& triangle) { mesh.triangles.push_back(triangle); });
  const bool has_triangles = mesh.cells.size() < mesh.triangles.size();
  mesh.cells.resize(mesh.triangles.size(), static_cast<std::int32_t>(cell));
  return has_triangles;
}

void sort_cells(const MeshDocument& document, PlanarMesh& mesh) {
  std::size_t first_repeating = 0;
  mesh.in_other_cell.assign(document.point_count(), 0);
  mesh.in_cell.assign(document.point_count(), 0);
  for (const std::int32_t v : document.cells.connectivity) {
    mesh.in_cell[static_cast<std::size_t>(v)] = 1;
  }
  mesh.triangles.reserve(document.cells.size());
  mesh.cells.reserve(document.cells.size());
  for (std::size_t c = 0; c < document.cells.size(); ++c) {
    const auto vertices = document.cells[c];
    if (document.cells.types[c] == cell_type::triangle_strip && add_strip(vertices, c, mesh)) {
      continue;
    }
    const bool triangular = is_triangle(document.cells.types[c], vertices);
    if (triangular && !repeats_a_vertex(vertices)) {
      mesh.triangles.push_back({vertices[0], vertices[1], vertices[2]});
      mesh.cells.push_back(static_cast<std::int32_t>(c));
      continue;
    }
    if (triangular && mesh.repeating_triangles++ == 0) {
      first_repeating = c;
    }
    ++mesh.other_cells;
    for (const std::int32_t v : vertices) {
      mesh.in_other_cell[static_cast<std::size_t>(v)] = 1;
    }
  }
  if (mesh.repeating_triangles > 0) {
    mesh.notes.push_back(counted(mesh.repeating_triangles, "triangle") + " repeating a vertex (the first is cell " +
                         std::to_string(first_repeating) + "): kept as they are, their vertices held fixed");
  }
  if (mesh.other_cells > mesh.repeating_triangles) {
    mesh.notes.push_back(counted(mesh.other_cells - mesh.repeating_triangles, "cell") +
                         " of other types than triangle: kept as they are, their vertices held fixed");
  }
}

std::string array_names(std::span<const DataArray> arrays) {
  std::string names;
  for (const DataArray& array : arrays) {
    names.append(names.empty() ? "" : ", ").append(array.name);
  }
  return names.empty() ? "none" : names;
}

constexpr std::array<std::string_view, 7> region_array_names{
    "region", "mat_id", "material", "MaterialIds", "CellEntityIds", "gmsh:physical", "medit:ref"};

/// The values of the array at the mesh's triangles, numbered from 0 in ascending order, all not-a-numbers last as one.
/// In the array's own type: whole numbers beyond 2^53 are not equal for being equal as doubles.
template <class T>
void number_values(const DataArray& array, const PlanarMesh& mesh, Regions& regions) {
  const auto is_nan = [](T a) { return std::isnan(static_cast<double>(a)); };
  const auto precedes = [&](T a, T b) { return a < b || (!is_nan(a) && is_nan(b)); };
  std::vector<T> of_triangle(mesh.cells.size());
  std::ranges::transform(mesh.cells, of_triangle.begin(), [&](std::int32_t cell) {
    T value{};
    std::memcpy(&value, array.bytes.data() + static_cast<std::size_t>(cell) * sizeof(T), sizeof(T));
    return value;
  });
  std::vector<T> values = of_triangle;
  std::ranges::sort(values, precedes);
  values.erase(std::unique(values.begin(), values.end(), [&](T a, T b) { return !precedes(a, b); }), values.end());
  regions.count = static_cast<std::int32_t>(values.size());
  regions.of_triangle.resize(of_triangle.size());
  std::ranges::transform(of_triangle, regions.of_triangle.begin(), [&](T value) {
    return static_cast<std::int32_t>(std::ranges::lower_bound(values, value, precedes) - values.begin());
  });
}

/// The cells that hold the triangles: fewer than these where there are strips.
std::int64_t count_triangular_cells(const PlanarMesh& mesh) {
  std::int64_t count = 0;
  for (std::size_t t = 0; t < mesh.cells.size(); ++t) {
    count += t == 0 || mesh.cells[t] != mesh.cells[t - 1] ? 1 : 0;
  }
  return count;
}

Regions number_regions(const DataArray& array, const PlanarMesh& mesh) {
  Regions regions;
  regions.array = array.name;
  visit_scalar_type(array.type, [&](auto zero) { number_values<decltype(zero)>(array, mesh, regions); });
  return regions;
}

Storage storage_of(const MeshDocument& document) {
  return document.point_type == ScalarType::float32 ? Storage::float32 : Storage::float64;
}

void lay_into_plane(PlanarMesh& mesh, const PlaneFit& fit, const MeshDocument& document,
                    const std::filesystem::path& path) {
  if (!fit.is_planar()) {
    throw ReadError(path, fit.fault() + "; only planar meshes can be smoothed");
  }
  auto points = project(fit.plane, document.points, mesh.in_cell);
  if (!points) {
    throw ReadError(path,
                    "the mesh is too large: coordinates along its tilted plane are beyond the range of double; "
                    "scale it down");
  }
  mesh.plane = fit.plane;
  mesh.points = *std::move(points);
}

}  // namespace

PlanarMesh planar_mesh(const MeshDocument& document, const std::filesystem::path& path) {
  if (document.point_count() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    throw ReadError(path, "holds more than 2147483647 vertices");
  }
  PlanarMesh mesh;
  sort_cells(document, mesh);
  if (mesh.triangles.empty() && document.cells.size() > 0) {
    throw ReadError(path, "holds " + counted(static_cast<std::int64_t>(document.cells.size()), "cell") +
                              " but no triangle; only triangle meshes can be smoothed");
  }
  if (mesh.triangles.empty()) {
    mesh.notes.emplace_back("the file holds no cells: nothing to smooth");
  }
  lay_into_plane(mesh, fit_plane(document.points, mesh.in_cell, document.cells, storage_of(document)), document, path);
  return mesh;
}

bool settle_plane(PlanarMesh& mesh, const MeshDocument& document, std::span<const std::uint8_t> fixed,
                  const std::filesystem::path& path) {
  const auto fit = plane_of_fixed(mesh.plane, document.points, mesh.in_cell, fixed, storage_of(document));
  if (fit) {
    lay_into_plane(mesh, *fit, document, path);
  }
  return fit.has_value();
}

Regions find_regions(const MeshDocument& document, const PlanarMesh& mesh, const std::optional<std::string>& name) {
  if (name) {
    const DataArray* const array = find_array(document.cell_arrays, *name);
    if (array == nullptr) {
      throw std::invalid_argument("the file has no cell array '" + *name +
                                  "' to take regions from; it has: " + array_names(document.cell_arrays));
    }
    if (array->components != 1) {
      throw std::invalid_argument("the cell array '" + *name + "' has " + std::to_string(array->components) +
                                  " components; regions need one");
    }
    return number_regions(*array, mesh);
  }
  for (const std::string_view candidate : region_array_names) {
    const DataArray* const array = find_array(document.cell_arrays, candidate);
    if (array != nullptr && array->components == 1) {
      Regions regions = number_regions(*array, mesh);
      // A different value in every cell numbers the cells; it does not group them.
      if (mesh.triangles.size() <= 1 || regions.count < count_triangular_cells(mesh)) {
        return regions;
      }
    }
  }
  return {};
}

std::vector<std::uint8_t> fixed_by_array(const MeshDocument& document, const std::string& name, bool required) {
  const DataArray* const array = find_array(document.point_arrays, name);
  if (array == nullptr) {
    if (required) {
      throw std::invalid_argument("the file has no point array '" + name +
                                  "' to take fixed vertices from; it has: " + array_names(document.point_arrays));
    }
    return {};
  }
  std::vector<std::uint8_t> fixed(document.point_count(), 0);
  for (std::size_t v = 0; v < fixed.size(); ++v) {
    for (std::size_t i = 0; i < array->components; ++i) {
      fixed[v] |= array->value(v, i) != 0 ? std::uint8_t{1} : std::uint8_t{0};
    }
  }
  return fixed;
}

}  // namespace trismooth
