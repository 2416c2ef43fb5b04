// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/mesh_io/data_array.h"
#include "trismooth/mesh_io/halfedge/triangle_mesh.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// The mesh of a run as OpenMesh halfedges, for a stage of the program's own: see PipelineOptions::halfedge_stage. What
/// is to be read belongs to the run and is there for as long as the call; what is to be filled in is the caller's.
struct HalfedgeStage {
  /// Vertex v is point v of the document, face e is element e, of three sides or four; faces run the same way within
  /// each component. Points are those of the file. A point whose elements form several fans (at bow ties and edges of
  /// three elements), which no halfedge mesh can hold, is there once for each fan; see `copies_of`. Points that no
  /// element uses, as the middles of sides, are isolated vertices, which OpenMesh calls boundary as well. With
  /// PipelineOptions::merge the corners of faces are the points that stay: those that go with them are isolated.
  const ElementMesh& mesh;
  /// The point of each vertex beyond those of the document: vertex points + i is a further fan of point copies_of[i].
  std::span<const std::int32_t> copies_of;
  /// The document's cell of each face, ascending; a strip has several faces.
  std::span<const std::int32_t> cells;
  /// The region of each face, from 0; empty where the file has no regions.
  std::span<const std::int32_t> regions;
  /// The mesh as its file states it.
  const MeshDocument& document;

  /// To be filled in: one byte a point of the document, not 0: the vertex is held, as those that the user names are. To
  /// hold the middle of a side holds its ends; a note says so. Empty: none.
  std::vector<std::uint8_t> fixed{};
  /// To be filled in: arrays of one row a point that the output gets beside those of the file, where its format takes
  /// arrays; make_data_array() makes one. Each has a name of its own, which no point array of the document has and
  /// which does not begin with `trismooth:`. (One called "fixed" holds vertices when the output is read again.)
  std::vector<DataArray> point_arrays{};

  /// The point of the document that a vertex of the mesh is.
  [[nodiscard]] std::int32_t point_of(OpenMesh::VertexHandle vertex) const {
    const auto points = static_cast<std::int32_t>(document.point_count());
    return vertex.idx() < points ? vertex.idx() : copies_of[static_cast<std::size_t>(vertex.idx() - points)];
  }
};

}  // namespace trismooth
