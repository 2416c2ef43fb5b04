// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "trismooth/base/element_list.h"
#include "trismooth/base/point2.h"
#include "trismooth/pipeline/input/planar_mesh.h"

namespace trismooth {

/// Joins corners of elements that are not further apart than `distance` (from 0): for each vertex the one that it
/// joins, which is the first of the mesh that is so near, and that joins itself; vertices of no element join
/// themselves. No two vertices of which others are joined to are so near each other. Corners are finite. Complexity:
/// linear.
std::vector<std::int32_t> join_near_corners(std::span<const Point2<double>> points, const ElementList& elements,
                                            double distance);

/// Joins the mesh's corners so: its elements are of the vertices that others join, which alone are smoothed, and
/// `merged` says who goes with whom. What holds one of them holds all. Returns how many go with another one. Throws
/// std::invalid_argument where two corners of an element would join, and for a mesh with triangles of six nodes.
std::int64_t merge_corners(PlanarMesh& mesh, double distance);

/// Sets flags of a vertex (none: no vertex has one) for the vertex that it goes with.
void merge_flags(const PlanarMesh& mesh, std::vector<std::uint8_t>& flags);

/// Takes vertices that go with another one to where that is, if it has moved. `points`: x, y, z a vertex, `before` as
/// they were.
void follow_merged(const PlanarMesh& mesh, std::span<const double> before, std::span<double> points);

/// The length of the shortest side that is not of length 0; infinite where there is none.
double shortest_side(std::span<const Point2<double>> points, const ElementList& elements);

/// Why no vertex of a mesh is free whose elements share no side, one sentence: whether their corners nearly coincide,
/// which is within a tenth of the shortest side, and at which distance.
std::string describe_apart_elements(std::span<const Point2<double>> points, const ElementList& elements);

}  // namespace trismooth
