// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/base/element_list.h"
#include "trismooth/base/local_frame.h"
#include "trismooth/mesh_io/annotation_names.h"
#include "trismooth/mesh_io/data_array.h"
#include "trismooth/pipeline/input/planar_mesh.h"
#include "trismooth/quality/metrics.h"

namespace trismooth {

class Workers;
struct MeshDocument;

/// The annotations of a run. Their names, here and in docs/command_line.md, stay:
///
///     trismooth:METRIC         cells   the metric's value (see metrics.h), of the mesh as it is written
///     trismooth:METRIC_before  cells   the same of the mesh as it was read, where it was smoothed
///     trismooth:fixed          points  1 where the vertex is held fixed, else 0
///     trismooth:displacement   points  how far the vertex has moved: x, y and z, where the mesh was smoothed

/// What a metric that is infinite, or beyond it, has for a value in a file: what Verdict gives.
inline constexpr double largest_annotation = 1e30;

/// Each of `metrics` of each cell of the file, as arrays of `cell_count` float64 in the order of `metrics`, `suffix`
/// behind their names. `cells` has the file's cell of every triangle of the view, ascending, and `copies` the cells
/// that are these triangles again; other cells have 0. The area is in the file's unit. Values are at most 1e30 in
/// amount, so that every format can hold them. Complexity: linear, and n log n in the copies.
std::vector<DataArray> metric_annotations(std::span<const Metric> metrics, const MeshView& view,
                                          std::span<const std::int32_t> cells, std::size_t cell_count, Workers& workers,
                                          std::string_view suffix = {}, std::span<const CellCopy> copies = {});

/// `reasons` has, for every vertex, what holds it (see hold.h), 0 for a free one. An array of uint8.
DataArray fixed_annotation(std::span<const std::uint8_t> reasons, Workers& workers);

/// From x, y, z of every vertex before and after. An array of float64, 3 a vertex.
DataArray displacement_annotation(std::span<const double> before, std::span<const double> after, Workers& workers);

/// The names of the annotations that the document has.
std::vector<std::string> annotations_in(const MeshDocument& document);

/// Takes annotations of an earlier run out of the document's arrays, and has none of them be written. Answers their
/// names, those of cells first.
std::vector<std::string> drop_annotations(MeshDocument& document);

/// The size ratio (size_ratio.h) of each cell, as metric_annotations() has the others: of a strip the largest.
DataArray size_ratio_annotation(const MeshView& view, std::span<const std::int32_t> cells, std::size_t cell_count,
                                Workers& workers, std::string_view suffix = {}, std::span<const CellCopy> copies = {});

/// What annotations are to show of triangles.
struct AnnotatedMetrics {
  std::vector<Metric> metrics;
  bool size_ratio = false;
};

/// The metrics that `text` names, separated by commas: "shape,min_angle,size_ratio". Throws std::invalid_argument for a
/// name that is none, with those that are, and for one that comes twice.
AnnotatedMetrics parse_metrics(std::string_view text);

}  // namespace trismooth
