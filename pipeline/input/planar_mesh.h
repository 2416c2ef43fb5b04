// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/point2.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/pipeline/input/element_cells.h"
#include "trismooth/smoothing/middle_nodes.h"
#include "trismooth/space/geographic_map.h"
#include "trismooth/space/plane.h"

namespace trismooth {

class Workers;

/// The planar mesh that a document holds. The document outlives it, and its cells stay as they are.
struct PlanarMesh : ElementCells {
  Plane plane;
  std::optional<GeographicMap> map;   ///< where the points are longitudes and latitudes: what they are laid on
  BulkVector<Point2<double>> points;  ///< every vertex of the document in coordinates of the plane, file units
  std::vector<MiddleNode> middles;    ///< the middles that follow their corners: see settle_middles()
  std::vector<std::int32_t> merged;   ///< per vertex the one it goes with: see merge_corners(); or empty

  /// Where a vertex lies in the plane, or on the map, that is stored there.
  Point2<double> place(std::size_t vertex, const Eigen::Vector3d& stored) const {
    return map ? map->place(vertex, stored) : plane.project(stored);
  }
  /// What is stored of a vertex that moves from one place to another, before it is rounded.
  Eigen::Vector3d moved(const Eigen::Vector3d& stored, Point2<double> from, Point2<double> to) const {
    return map ? map->moved(stored, from, to) : plane.moved(stored, from, to);
  }
};

/// What keeps cells from being smoothed that are triangles or quadrilaterals.
struct UnsmoothedCells {
  std::int64_t high_order_triangles = 0;  ///< of more than six nodes
  std::int64_t high_order_quads = 0;      ///< of more than nine, or of six
  std::int64_t held_quads = 0;            ///< others
  std::int64_t crossed_quads = 0;         ///< others whose corners are not listed in turn
};

/// Throws ReadError naming `path` for a mesh of that many cells, of which none is an element that can be smoothed.
void require_elements(std::int64_t elements, std::int64_t cells, const std::filesystem::path& path,
                      const UnsmoothedCells& unsmoothed = {});

/// Throws ReadError naming `path` for more than 2,147,483,647 points or cells, which 32 bits do not number.
void check_document_size(std::size_t points, std::size_t cells, const std::filesystem::path& path);

/// The number type that coordinates are rounded to in the document's file.
Storage storage_of(const MeshDocument& document);

/// Finds the elements (see element_cells()) and the plane of the document. Throws ReadError naming `path` where the
/// vertices of cells do not lie in one plane (see fit_plane()) or have no finite coordinates in it (near the largest
/// double), or the document holds cells but no element. A document without any cell is fine: nothing to smooth.
/// Complexity: linear.
PlanarMesh planar_mesh(const MeshDocument& document, const std::filesystem::path& path, Workers& workers,
                       Quads quads = Quads::smooth);

/// planar_mesh() on the calling thread.
PlanarMesh planar_mesh(const MeshDocument& document, const std::filesystem::path& path, Quads quads = Quads::smooth);

/// planar_mesh() of a mesh that may lie in no plane, laid into the plane of x and y: z has no say. Do not settle its
/// plane.
PlanarMesh projected_mesh(const MeshDocument& document, const std::filesystem::path& path, Workers& workers,
                          Quads quads = Quads::smooth);

/// planar_mesh() of a piece of a mesh: it may have no element, or nothing at all, and no notes are made, which are for
/// the whole mesh. Throws ReadError naming `path` for too many points or cells.
PlanarMesh mesh_of_piece(const MeshDocument& document, const std::filesystem::path& path, Quads quads,
                         Workers& workers);

/// Not of a temporary: the elements may be the document's own.
PlanarMesh planar_mesh(MeshDocument&& document, const std::filesystem::path& path, Workers& workers,
                       Quads quads = Quads::smooth) = delete;
PlanarMesh planar_mesh(MeshDocument&& document, const std::filesystem::path& path,
                       Quads quads = Quads::smooth) = delete;

/// Brings the document's mesh into the plane in which it is to be smoothed, now that it is known which vertices are
/// `fixed` (not 0): see plane_of_fixed(). Throws ReadError as planar_mesh() does. True where plane and points are
/// others now.
bool settle_plane(PlanarMesh& mesh, const MeshDocument& document, std::span<const std::uint8_t> fixed,
                  const std::filesystem::path& path, Workers& workers);

/// Tells which middles of the mesh's quadratic elements follow their corners (mesh.middles), and at which fraction of
/// their sides they lie (`points`: x, y, z of every vertex of the document, as the file has them), and holds where it
/// cannot be, in `named` (a byte a vertex, or empty) and mesh.in_other_cell: see middle_nodes.h of smoothing. How many
/// stay since they are shared: SettledMiddles::shared.
std::int64_t settle_middles(PlanarMesh& mesh, std::span<const double> points, std::vector<std::uint8_t>& named);

/// The vertex numbers (from 0, separated by white space, '#' comments) of a text file. Throws ReadError, also for a
/// number that is not below `vertex_count`.
std::vector<std::int64_t> read_vertex_numbers(const std::filesystem::path& path, std::int64_t vertex_count);

/// read_vertex_numbers() of a mesh whose vertices 32 bits can number.
std::vector<std::int32_t> read_vertex_ids(const std::filesystem::path& path, std::int64_t vertex_count);

/// The vertices with these labels: the numbers that the document's own file gives its points, be it as global ids
/// (global_ids.h). Throws std::invalid_argument, which begins with `argument`, for a label that no point has, and where
/// the file gives none, or one to several points: `rows` is what takes rows instead, "fixed". Complexity: n log n in
/// the vertices where labels do not count on.
std::vector<std::int32_t> vertices_of_labels(std::span<const std::int64_t> labels, const MeshDocument& document,
                                             const std::string& argument, const std::string& rows);

/// The labels of vertices that a text file names, as read_vertex_numbers() reads them. Throws ReadError.
std::vector<std::int64_t> read_labels(const std::filesystem::path& path);

/// The error of such a file that names a label which no point has.
ReadError unknown_label(const std::filesystem::path& path, std::int64_t label);

/// The vertices whose labels a text file names: the numbers that the document's own file gives its points. Throws
/// as vertices_of_labels() where that gives none, ReadError for a label that no point has, and for what is no number.
/// Complexity: n log n in the vertices where labels do not count on.
std::vector<std::int32_t> read_vertex_labels(const std::filesystem::path& path, const MeshDocument& document);

}  // namespace trismooth
