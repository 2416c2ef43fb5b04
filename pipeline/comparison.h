// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>

#include "trismooth/mesh_io/file_format.h"
#include "trismooth/pipeline/held_vertices.h"

namespace trismooth {

/// How another mesh of the same elements differs from the mesh of a run (PipelineOptions::compared). Vertices and
/// elements are those of the run's mesh, whose number of a vertex is its row in the file. Displacements are those of
/// the vertices that moved, in the file's unit (longitudes and latitudes: in degrees); with a projection those in its
/// plane.
struct ComparisonResult {
  std::filesystem::path path;           ///< of the other mesh, for people
  FileFormat format = FileFormat::off;  ///< of the other mesh
  /// Vertices of which a coordinate is another one as it is stored. A coordinate that differs as the number type or the
  /// width of numbers of one of the files rounds that of the other is the same.
  std::int64_t moved_vertices = 0;
  std::int64_t rounded_vertices = 0;  ///< vertices that have not moved, but for such rounding
  std::int64_t held_vertices = 0;     ///< of those that moved: a smoothing of the run's mesh would hold them
  HeldVertices held{};                ///< these by what holds them; those of layers count as named
  double largest_displacement = 0;    ///< 0 where nothing moved
  double mean_displacement = 0;       ///< 0 where nothing moved
  std::int64_t farthest_vertex = -1;  ///< the one with the largest displacement; -1 where nothing moved
  /// Displacements by the root mean square length of the sides around the vertex in the run's mesh, of corners alone.
  double largest_relative_displacement = 0;
  double mean_relative_displacement = 0;    ///< likewise
  std::int64_t better_elements = 0;         ///< whose shape is larger in the other mesh, by more than 1e-12; only of
                                            ///< those with a corner that moved, as the following
  std::int64_t worse_elements = 0;          ///< whose shape is smaller
  std::int64_t newly_invalid_elements = 0;  ///< inverted or degenerate in the other mesh alone
  std::int64_t newly_valid_elements = 0;    ///< inverted or degenerate in the run's mesh alone
  std::int64_t mirrored_elements = 0;       ///< of components that the other mesh has turned over
  std::uint64_t coordinates_hash = 0;       ///< of the other mesh: see PipelineResult::coordinates_hash
};

}  // namespace trismooth
