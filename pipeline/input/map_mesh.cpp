// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/map_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/space/longitudes.h"

namespace trismooth {

namespace {

/// The longitudes and latitudes of the vertices of cells.
struct DegreeRange {
  double west = std::numeric_limits<double>::infinity();
  double east = -std::numeric_limits<double>::infinity();
  double south = std::numeric_limits<double>::infinity();
  double north = -std::numeric_limits<double>::infinity();
};

DegreeRange range_of(const PlanarMesh& mesh, const MeshDocument& document) {
  DegreeRange range;
  for (std::size_t v = 0; v < document.point_count(); ++v) {
    if (mesh.in_cell[v] != 0) {
      const double longitude = document.points[3 * v];
      const double latitude = document.points[3 * v + 1];
      range = {std::min(range.west, longitude), std::max(range.east, longitude), std::min(range.south, latitude),
               std::max(range.north, latitude)};
    }
  }
  return range;
}

/// The lowest longitude of the 360 degrees that the file's are among.
double west_of(const DegreeRange& range) {
  if (range.west < -180 || range.east > 360) {
    return range.west < -180 ? range.west : range.east - 360;
  }
  return range.west >= 0 && range.east > 180 ? 0 : -180;
}

/// Takes the elements out of those that are smoothed.
void set_apart(PlanarMesh& mesh, std::span<const std::int32_t> cut) {
  for (const std::int32_t t : cut) {
    for (const std::int32_t v : mesh.elements[static_cast<std::size_t>(t)]) {
      mesh.in_other_cell[v] = 1;
    }
  }
  leave_out(mesh, cut);
  mesh.other_cells += std::ssize(cut);
  mesh.notes.push_back(
      fmt::format("the mesh goes round the globe: {} {}{} across its seam {} kept as {}, {} vertices held fixed",
                  cut.size(), kind_of_elements(mesh), cut.size() == 1 ? "" : "s", cut.size() == 1 ? "is" : "are",
                  cut.size() == 1 ? "it is" : "they are", cut.size() == 1 ? "its" : "their"));
}

/// A basin in metres, which begins at the axes or has them in its middle. (The globe does so, too.)
bool is_at_axes(const DegreeRange& range) {
  constexpr double globe = 90;
  const auto is_at = [](double low, double high) { return low == 0 || high == 0 || low == -high; };
  return range.east - range.west < globe && is_at(range.west, range.east) && is_at(range.south, range.north);
}

/// Near the equator shapes are the same on the sphere, to one per cent.
bool has_shapes_of_its_own(const DegreeRange& range) {
  constexpr double same_below = 8;
  return std::max(std::abs(range.south), std::abs(range.north)) > same_below;
}

/// The mean side is one of meshes of coasts and oceans: a metre to a thousand kilometres.
bool has_sides_in_degrees(const PlanarMesh& mesh, const MeshDocument& document) {
  constexpr double shortest = 1e-5;
  constexpr double longest = 10;
  double sum = 0;
  for (const auto corners : mesh.elements) {
    const double* const a = document.points.data() + 3 * static_cast<std::size_t>(corners[0]);
    const double* const b = document.points.data() + 3 * static_cast<std::size_t>(corners[1]);
    sum += std::hypot(b[0] - a[0], b[1] - a[1]);
  }
  const double mean = sum / static_cast<double>(mesh.elements.size());
  return mean >= shortest && mean <= longest;
}

}  // namespace

void require_degrees(const PlanarMesh& mesh, const MeshDocument& document, const std::filesystem::path& path) {
  for (std::size_t v = 0; v < document.point_count(); ++v) {
    const double longitude = document.points[3 * v];
    const double latitude = document.points[3 * v + 1];
    if (mesh.in_cell[v] == 0 || (std::abs(longitude) <= 360 && std::abs(latitude) < 90)) {
      continue;
    }
    if (std::abs(latitude) == 90) {
      throw ReadError(path, fmt::format("vertex {} is at a pole, which has no place on the map of --geographic", v));
    }
    throw ReadError(path,
                    fmt::format("vertex {} is at {}, {}: no longitude and latitude in degrees, which --geographic "
                                "asks for",
                                v, longitude, latitude));
  }
}

void lay_on_map(PlanarMesh& mesh, const MeshDocument& document, const std::filesystem::path& path) {
  const Plane& plane = mesh.plane;
  if (!plane.aligned || plane.axes != std::array<int, 2>{0, 1} || !(plane.slope == Point2<double>{0, 0})) {
    throw ReadError(path,
                    "the mesh does not lie in the plane of x and y, which are longitude and latitude for "
                    "--geographic; with --project xy z has no say");
  }
  require_degrees(mesh, document, path);
  std::vector<double> longitudes(document.point_count());
  for (std::size_t v = 0; v < longitudes.size(); ++v) {
    longitudes[v] = mesh.in_cell[v] != 0 ? document.points[3 * v] : 0;
  }
  const UnwrappedLongitudes unwrapped = unwrap_longitudes(longitudes, mesh.elements);
  const bool is_seamless =
      unwrapped.cut.empty() && std::ranges::all_of(unwrapped.turns, [](int turns) { return turns == 0; });
  if (!is_seamless && !mesh.quadratics.empty()) {
    throw ReadError(path,
                    "elements with nodes in the middle of their sides lie across the jump of the longitudes, where "
                    "--geographic cannot move these nodes; turn the longitudes so that they are continuous");
  }
  if (!unwrapped.cut.empty()) {
    set_apart(mesh, unwrapped.cut);
  }
  for (std::size_t v = 0; v < longitudes.size(); ++v) {
    longitudes[v] += 360.0 * unwrapped.turns[v];
  }
  mesh.map.emplace(std::move(longitudes), west_of(range_of(mesh, document)));
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    if (mesh.in_cell[v] != 0) {
      mesh.points[v] = mesh.place(v, Eigen::Map<const Eigen::Vector3d>(document.points.data() + 3 * v));
    }
  }
}

bool looks_geographic(const PlanarMesh& mesh, const MeshDocument& document) {
  if (document.is_geographic) {
    return true;
  }
  const std::string_view format = to_string(document.format);
  if (format != "adcirc" && format != "2dm") {
    return false;
  }
  // Large as an ocean, or far from where the axes of a basin in metres meet.
  constexpr double least_extent = 3;
  constexpr double least_distance = 3;  // in extents
  const DegreeRange range = range_of(mesh, document);
  const double extent = std::max(range.east - range.west, range.north - range.south);
  const double distance = std::max(std::abs(range.east + range.west), std::abs(range.north + range.south)) / 2;
  return range.west >= -180 && range.east <= 360 && range.south >= -90 && range.north <= 90 &&
         (extent > least_extent || distance > least_distance * extent) && !is_at_axes(range) &&
         has_shapes_of_its_own(range) && has_sides_in_degrees(mesh, document);
}

}  // namespace trismooth
