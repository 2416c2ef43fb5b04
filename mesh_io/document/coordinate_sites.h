#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/data_array.h"

namespace trismooth {

/// How a file writes its coordinates.
enum class CoordinateEncoding : std::uint8_t { text, little_endian, big_endian };

/// Where in a file's bytes the coordinates of each vertex stand.
struct CoordinateSites {
  CoordinateEncoding encoding = CoordinateEncoding::text;
  ScalarType type = ScalarType::float64;  ///< for text of floating point, what a reader rounds to
  std::vector<ScalarType> axis_types;     ///< of x, y and z where they differ; empty where all are of `type`
  std::vector<std::uint64_t> offsets;     ///< byte offsets of x, y, z: three a site; sites in the file's order
  std::vector<std::int32_t> vertices;     ///< the vertex at each site; empty where site i is vertex i
};

/// Writes `bytes` to the plain path `path`, each coordinate that differs from its site's value replaced by that of
/// `points` (x, y, z of every vertex, representable in their types), every other byte as it is, and then `suffix`.
/// Text coordinates get the shortest text that reads back to the same value. Throws WriteError.
void write_patched(const std::filesystem::path& path, std::string_view bytes, const CoordinateSites& sites,
                   std::span<const double> points, std::string_view suffix, const FileWorkers& workers);

}  // namespace trismooth
