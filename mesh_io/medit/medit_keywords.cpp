// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/medit/medit_keywords.h"

#include <algorithm>
#include <array>

#include "trismooth/base/cell_list.h"
#include "trismooth/base/text/letter_case.h"

namespace trismooth {

namespace {

constexpr auto known_keywords = std::to_array<MeditKeyword>({
    {"MeshVersionFormatted", 1, MeditRole::version},
    {"Dimension", medit_code::dimension, MeditRole::dimension},
    {"FloatingPointPrecision", 155, MeditRole::precision},
    {"Vertices", medit_code::vertices, MeditRole::vertices},
    {"End", medit_code::end, MeditRole::end},

    {"Edges", 5, MeditRole::cells, cell_type::line, 2, true},
    {"Triangles", 6, MeditRole::cells, cell_type::triangle, 3, true},
    {"Quadrilaterals", 7, MeditRole::cells, cell_type::quad, 4, true},
    {"Tetrahedra", 8, MeditRole::cells, cell_type::tetrahedron, 4, true},
    {"Prisms", 9, MeditRole::cells, cell_type::wedge, 6, true},
    {"Hexahedra", 10, MeditRole::cells, cell_type::hexahedron, 8, true},
    {"Pyramids", 49, MeditRole::cells, cell_type::pyramid, 5, true},
    {"EdgesP2", 25, MeditRole::cells, cell_type::quadratic_edge, 3, true},
    {"TrianglesP2", 24, MeditRole::cells, cell_type::quadratic_triangle, 6, true},
    {"QuadrilateralsQ2", 27, MeditRole::cells, cell_type::biquadratic_quad, 9, true},
    {"TetrahedraP2", 30, MeditRole::cells, cell_type::quadratic_tetrahedron, 10, true},
    {"HexahedraQ2", 33, MeditRole::cells, cell_type::triquadratic_hexahedron, 27},
    {"PrismsP2", 86, MeditRole::cells, cell_type::biquadratic_quadratic_wedge, 18},
    {"PyramidsP2", 87, MeditRole::cells, cell_type::lagrange_pyramid, 14},
    {"EdgesP3", 92, MeditRole::cells, cell_type::cubic_line, 4},
    {"EdgesP4", 93, MeditRole::cells, cell_type::lagrange_curve, 5},
    {"TrianglesP3", 90, MeditRole::cells, cell_type::lagrange_triangle, 10},
    {"TrianglesP4", 91, MeditRole::cells, cell_type::lagrange_triangle, 15},
    {"QuadrilateralsQ3", 88, MeditRole::cells, cell_type::lagrange_quad, 16},
    {"QuadrilateralsQ4", 89, MeditRole::cells, cell_type::lagrange_quad, 25},
    {"TetrahedraP3", 96, MeditRole::cells, cell_type::lagrange_tetrahedron, 20},
    {"TetrahedraP4", 97, MeditRole::cells, cell_type::lagrange_tetrahedron, 35},
    {"HexahedraQ3", 98, MeditRole::cells, cell_type::lagrange_hexahedron, 64},
    {"HexahedraQ4", 99, MeditRole::cells, cell_type::lagrange_hexahedron, 125},
    {"PyramidsP3", 100, MeditRole::cells, cell_type::lagrange_pyramid, 30},
    {"PyramidsP4", 101, MeditRole::cells, cell_type::lagrange_pyramid, 55},
    {"PrismsP3", 102, MeditRole::cells, cell_type::lagrange_wedge, 40},
    {"PrismsP4", 103, MeditRole::cells, cell_type::lagrange_wedge, 75},

    {"Corners", medit_code::corners, MeditRole::vertex_set},
    {"RequiredVertices", medit_code::required_vertices, MeditRole::vertex_set},
    {"Ridges", 14, MeditRole::cell_set, cell_type::line},
    {"RequiredEdges", 16, MeditRole::cell_set, cell_type::line},
    {"RequiredTriangles", 17, MeditRole::cell_set, cell_type::triangle},
    {"RequiredQuadrilaterals", 18, MeditRole::cell_set, cell_type::quad},

    {"Polyhedra", 46, MeditRole::unsupported},
    {"Polygons", 47, MeditRole::unsupported},
    {"EdgesP2Ordering", 127, MeditRole::unsupported},
    {"TrianglesP2Ordering", 129, MeditRole::unsupported},
    {"QuadrilateralsQ2Ordering", 131, MeditRole::unsupported},
    {"Prisms9", 200, MeditRole::unsupported},
    {"Hexahedra12", 201, MeditRole::unsupported},
    {"Quadrilaterals6", 202, MeditRole::unsupported},
    {"BoundaryPolygonHeaders", 203, MeditRole::unsupported},
    {"InnerPolygonHeaders", 205, MeditRole::unsupported},
    {"PolyhedraHeaders", 207, MeditRole::unsupported},

    // Known by name alone.
    {"TangentAtEdgeVertices", 19, MeditRole::other},
    {"NormalAtVertices", 20, MeditRole::other},
    {"NormalAtTriangleVertices", 21, MeditRole::other},
    {"NormalAtQuadrilateralVertices", 22, MeditRole::other},
    {"AngleOfCornerBound", 23, MeditRole::other},
    {"SubDomainFromGeom", 29, MeditRole::other},
    {"ExtraVerticesAtEdges", 34, MeditRole::other},
    {"ExtraVerticesAtTriangles", 35, MeditRole::other},
    {"VerticesOnGeometricVertices", 40, MeditRole::other},
    {"VerticesOnGeometricEdges", 41, MeditRole::other},
    {"VerticesOnGeometricTriangles", 42, MeditRole::other},
    {"EdgesOnGeometricEdges", 44, MeditRole::other},
    {"BoundingBox", 50, MeditRole::other},
    {"PrivateTable", 52, MeditRole::other},
    {"TrianglesOnGeometricTriangles", 55, MeditRole::other},
    {"Tangents", 59, MeditRole::other},
    {"Normals", 60, MeditRole::other},
    {"TangentAtVertices", 61, MeditRole::other},
    {"SolAtVertices", 62, MeditRole::other},
    {"SolAtTriangles", 64, MeditRole::other},
    {"Iterations", 77, MeditRole::other},
    {"Time", 78, MeditRole::other},
    {"Comments", 81, MeditRole::other},
    {"PeriodicVertices", 82, MeditRole::other},
    {"PeriodicEdges", 83, MeditRole::other},
    {"IRefGroups", 94, MeditRole::other},
    {"DRefGroups", 95, MeditRole::other},
    {"ByteFlow", 126, MeditRole::other},
    {"ReferenceStrings", 199, MeditRole::other},
    {"BoundaryPolygonVertices", 204, MeditRole::other},
});

/// As some programs spell it.
constexpr std::string_view other_hexahedra = "Hexaedra";

}  // namespace

std::span<const MeditKeyword> medit_keywords() {
  return known_keywords;
}

const MeditKeyword* find_medit_keyword(std::string_view name) {
  if (same_letters(name, other_hexahedra)) {
    return find_medit_keyword("Hexahedra");
  }
  const auto* const found = std::ranges::find_if(
      known_keywords, [name](const MeditKeyword& keyword) { return same_letters(name, keyword.name); });
  return found == known_keywords.end() ? nullptr : found;
}

std::uint8_t quadratic_medit_type(std::uint8_t type) {
  switch (type) {
    case cell_type::line:
      return cell_type::quadratic_edge;
    case cell_type::triangle:
      return cell_type::quadratic_triangle;
    default:
      return cell_type::biquadratic_quad;
  }
}

const MeditKeyword* find_medit_keyword(std::int32_t code) {
  const auto* const found = std::ranges::find(known_keywords, code, &MeditKeyword::code);
  return found == known_keywords.end() ? nullptr : found;
}

}  // namespace trismooth
