#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "trismooth/base/bulk_memory.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/halfedge/plane.h"
#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/pipeline/geographic/geographic_map.h"
#include "trismooth/pipeline/input/cell_copies.h"
#include "trismooth/pipeline/input/middle_nodes.h"
#include "trismooth/pipeline/input/named_sides.h"
#include "trismooth/quality/quadratic_quality.h"

namespace trismooth {

class Workers;

/// The planar triangle mesh that a document holds. The document outlives it, and its cells stay as they are.
struct PlanarMesh {
  PlanarMesh() = default;
  PlanarMesh(PlanarMesh&&) = default;
  PlanarMesh& operator=(PlanarMesh&&) = default;
  PlanarMesh(const PlanarMesh&) = delete;
  PlanarMesh& operator=(const PlanarMesh&) = delete;
  ~PlanarMesh() = default;

  Plane plane;
  std::optional<GeographicMap> map;   ///< where the points are longitudes and latitudes: what they are laid on
  BulkVector<Point2<double>> points;  ///< every vertex of the document in coordinates of the plane, file units
  /// In the document's order, each in the document's vertex order. They are the document's own connectivity where it
  /// has nothing but triangles, else they are in triangles_of_cells.
  std::span<const Triangle> triangles;
  std::vector<Triangle> triangles_of_cells;
  BulkVector<std::int32_t> cells;             ///< the document's cell of each triangle, ascending; a strip has several
  std::vector<CellCopy> copies;               ///< the cells that are these triangles again: see take_out_copies()
  std::vector<QuadraticTriangle> quadratics;  ///< the triangles of six nodes
  std::vector<MiddleNode> middles;            ///< the middles that follow their sides: see settle_middles()
  std::vector<std::int32_t> merged;           ///< per vertex the one it goes with: see merge_corners(); or empty
  std::vector<std::uint8_t> in_other_cell;    ///< per vertex: 1 where a cell that is not a triangle uses it, or the
                                              ///< side of a triangle that is a named boundary
  NamedSides sides;                           ///< these sides
  std::vector<std::uint8_t> in_cell;          ///< per vertex: 1 where any cell uses it; the others have no say at all
  std::int64_t other_cells = 0;               ///< cells that are not triangles
  std::int64_t repeating_triangles = 0;       ///< those of them that are triangles but for a vertex that they repeat
  std::int64_t high_order_triangles = 0;      ///< those of them that are triangles of seven nodes, of ten, or of more
  std::vector<std::string> notes;             ///< what the user should know, one sentence each

  /// Where a vertex lies in the plane, or on the map, that is stored there.
  Point2<double> place(std::size_t vertex, const Eigen::Vector3d& stored) const {
    return map ? map->place(vertex, stored) : plane.project(stored);
  }
  /// What is stored of a vertex that moves from one place to another, before it is rounded.
  Eigen::Vector3d moved(const Eigen::Vector3d& stored, Point2<double> from, Point2<double> to) const {
    return map ? map->moved(stored, from, to) : plane.moved(stored, from, to);
  }
};

/// A cell as a triangle.
struct CellTriangle {
  Triangle corners;
  std::optional<std::array<std::int32_t, 3>> middles;  ///< of the sides 01, 12 and 20, where it has such
  bool is_quad = false;  ///< the cell is a quadrilateral that repeats a corner, as Ansys and Abaqus write triangles
};

/// The triangle that a cell is, corners in the cell's order, but for strips: triangles of three or six nodes, VTK's
/// Lagrange triangles (type 69) of order 1 and 2 among them, polygons of three, and quadrilaterals of four or eight
/// nodes of which two corners that follow each other are the same vertex, and no other ones. Constant time.
std::optional<CellTriangle> triangle_of_cell(std::uint8_t type, std::span<const std::int32_t> vertices);

/// Whether the cell would be a triangle, did it not repeat a corner, so that it has no area.
bool is_flat_triangle(std::uint8_t type, std::span<const std::int32_t> vertices);

/// How many triangles of a mesh a cell of that type counts as, 0 where it is none.
std::int64_t count_triangles(std::uint8_t type, std::span<const std::int32_t> vertices);

/// Throws ReadError naming `path` for a mesh of that many cells, of which none is a triangle that can be smoothed;
/// `high_order` of them are triangles of more than six nodes.
void require_triangles(std::int64_t triangles, std::int64_t cells, const std::filesystem::path& path,
                       std::int64_t high_order = 0);

/// Throws ReadError naming `path` for more than 2,147,483,647 points or cells, which 32 bits do not number.
void check_document_size(std::size_t points, std::size_t cells, const std::filesystem::path& path);

/// The number type that coordinates are rounded to in the document's file.
Storage storage_of(const MeshDocument& document);

/// Finds the triangles and the plane of the document. A triangle strip counts as its triangles (see
/// strip_triangles.h), and one of six nodes as that of its corners, beside what `quadratics` says; see
/// triangle_of_cell() for the others. A note says how many quadrilaterals are triangles, and names triangles of more
/// nodes. A triangle that repeats a vertex counts as another cell: it is kept, its vertices are held, and a note says
/// so. Sides that are named boundaries (named_sides.h) hold their vertices as line cells do. Throws ReadError naming
/// `path` where the vertices of cells do not lie in one plane (see fit_plane()) or have no finite coordinates in it
/// (near the largest double), or the document holds cells but no triangle. A document without any cell is fine: nothing
/// to smooth. Complexity: linear.
PlanarMesh planar_mesh(const MeshDocument& document, const std::filesystem::path& path, Workers& workers);

/// planar_mesh() on the calling thread.
PlanarMesh planar_mesh(const MeshDocument& document, const std::filesystem::path& path);

/// planar_mesh() of a mesh that may lie in no plane, laid into the plane of x and y: z has no say. Do not settle its
/// plane.
PlanarMesh projected_mesh(const MeshDocument& document, const std::filesystem::path& path, Workers& workers);

/// planar_mesh() of a piece of a mesh: it may have no triangle, or nothing at all, and no notes are made, which are for
/// the whole mesh. Throws ReadError naming `path` for too many points or cells.
PlanarMesh mesh_of_piece(const MeshDocument& document, const std::filesystem::path& path, Workers& workers);

/// What the user should know of cells that are no triangles, one sentence each. `first_repeating`: the first triangle
/// that repeats a vertex, if it is known.
std::vector<std::string> notes_of_other_cells(std::int64_t other_cells, std::int64_t repeating_triangles,
                                              std::optional<std::size_t> first_repeating);

/// Not of a temporary: the triangles may be the document's own.
PlanarMesh planar_mesh(MeshDocument&& document, const std::filesystem::path& path, Workers& workers) = delete;
PlanarMesh planar_mesh(MeshDocument&& document, const std::filesystem::path& path) = delete;

/// Brings the document's mesh into the plane in which it is to be smoothed, now that it is known which vertices are
/// `fixed` (not 0): see plane_of_fixed(). Throws ReadError as planar_mesh() does. True where plane and points are
/// others now.
bool settle_plane(PlanarMesh& mesh, const MeshDocument& document, std::span<const std::uint8_t> fixed,
                  const std::filesystem::path& path, Workers& workers);

/// The vertex numbers (from 0, separated by white space, '#' comments) of a text file. Throws ReadError, also for a
/// number that is not below `vertex_count`.
std::vector<std::int64_t> read_vertex_numbers(const std::filesystem::path& path, std::int64_t vertex_count);

/// read_vertex_numbers() of a mesh whose vertices 32 bits can number.
std::vector<std::int32_t> read_vertex_ids(const std::filesystem::path& path, std::int64_t vertex_count);

/// The vertices with these labels: the numbers that the document's own file gives its points, be it as global ids
/// (global_ids.h). Throws std::invalid_argument, which begins with `argument`, for a label that no point has, and where
/// the file gives none, or one to several points. Complexity: n log n in the vertices where labels do not count on.
std::vector<std::int32_t> vertices_of_labels(std::span<const std::int64_t> labels, const MeshDocument& document,
                                             const std::string& argument);

/// The labels of vertices that a text file names, as read_vertex_numbers() reads them. Throws ReadError.
std::vector<std::int64_t> read_labels(const std::filesystem::path& path);

/// The error of such a file that names a label which no point has.
ReadError unknown_label(const std::filesystem::path& path, std::int64_t label);

/// The vertices whose labels a text file names: the numbers that the document's own file gives its points. Throws
/// as vertices_of_labels() where that gives none, ReadError for a label that no point has, and for what is no number.
/// Complexity: n log n in the vertices where labels do not count on.
std::vector<std::int32_t> read_vertex_labels(const std::filesystem::path& path, const MeshDocument& document);

}  // namespace trismooth
