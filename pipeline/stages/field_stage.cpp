// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/stages/field_stage.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "trismooth/base/machine/stopwatch.h"
#include "trismooth/base/text/counted.h"
#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/document/place_values.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/pipeline/fields/field_choice.h"
#include "trismooth/pipeline/fields/field_transfer.h"
#include "trismooth/pipeline/fields/point_location.h"
#include "trismooth/pipeline/stages/run_state.h"
#include "trismooth/pipeline/stages/stored_result.h"

namespace trismooth {

namespace {

/// Whether files that are written back keep the values of points that were read where they have several time steps,
/// and else not.
bool has_only_steps_kept(FileFormat format) {
  return format == FileFormat::exodus || format == FileFormat::selafin;
}

/// The vertices that are elsewhere now.
std::vector<std::int32_t> moved_vertices(std::span<const Point2<double>> before,
                                         std::span<const Point2<double>> after) {
  std::vector<std::int32_t> moved;
  for (std::size_t v = 0; v < before.size(); ++v) {
    if (!(before[v] == after[v])) {
      moved.push_back(static_cast<std::int32_t>(v));
    }
  }
  return moved;
}

/// The triangles in which fields are linear, with their regions: those of the mesh, but in place of a quadrilateral the
/// two that its shorter diagonal makes of it, and in place of an element with nodes in the middle of its sides those
/// between its nodes.
class FieldTriangles {
 public:
  /// `points`: where the vertices are at which the values are known.
  FieldTriangles(const PlanarMesh& mesh, std::span<const Point2<double>> points, std::span<const std::int32_t> regions)
      : points_(points), triangles_(mesh.elements.triangles()), regions_(regions) {
    if (mesh.quadratics.empty() && mesh.elements.are_triangles()) {
      return;
    }
    constexpr std::size_t most_more = 7;  // triangles between nine nodes, less the element itself
    parts_.reserve((mesh.elements.are_triangles() ? 1 : 2) * mesh.elements.size() + most_more * mesh.quadratics.size());
    auto quadratic = mesh.quadratics.begin();
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
      const auto corners = mesh.elements[e];
      if (quadratic != mesh.quadratics.end() && static_cast<std::size_t>(quadratic->element) == e) {
        add_quadratic(corners, *quadratic++);
      } else if (corners.size() == 4) {
        add_quad({corners[0], corners[1], corners[2], corners[3]});
      } else {
        parts_.push_back({corners[0], corners[1], corners[2]});
      }
      if (!regions.empty()) {
        regions_of_parts_.resize(parts_.size(), regions[e]);
      }
    }
    triangles_ = parts_;
    regions_ = regions_of_parts_;
  }

  FieldTriangles(const FieldTriangles&) = delete;
  FieldTriangles& operator=(const FieldTriangles&) = delete;
  ~FieldTriangles() = default;

  std::span<const Triangle> triangles() const { return triangles_; }
  std::span<const std::int32_t> regions() const { return regions_; }

 private:
  void add_quad(const MixedElement& quad) {
    const auto [a, b, c, d] = quad;
    const bool by_ac = squared_length(points_[c] - points_[a]) <= squared_length(points_[d] - points_[b]);
    parts_.push_back(by_ac ? Triangle{a, b, c} : Triangle{a, b, d});
    parts_.push_back(by_ac ? Triangle{a, c, d} : Triangle{b, c, d});
  }

  /// Around a centre the four quarters; else what is at each corner, and what the middles enclose.
  void add_quadratic(std::span<const std::int32_t> corners, const QuadraticElement& quadratic) {
    const auto [ab, bc, cd, da, centre] = quadratic.middles;
    const std::int32_t a = corners[0];
    const std::int32_t b = corners[1];
    const std::int32_t c = corners[2];
    if (corners.size() == 3) {
      const std::int32_t ca = cd;
      parts_.insert(parts_.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
      return;
    }
    const std::int32_t d = corners[3];
    if (centre != no_corner) {
      for (const MixedElement& quarter : {MixedElement{a, ab, centre, da}, MixedElement{ab, b, bc, centre},
                                          MixedElement{centre, bc, c, cd}, MixedElement{da, centre, cd, d}}) {
        add_quad(quarter);
      }
    } else {
      parts_.insert(parts_.end(), {{a, ab, da}, {ab, b, bc}, {bc, c, cd}, {da, cd, d}});
      add_quad({ab, bc, cd, da});
    }
  }

  std::span<const Point2<double>> points_;
  std::vector<Triangle> parts_;
  std::vector<std::int32_t> regions_of_parts_;
  std::span<const Triangle> triangles_;
  std::span<const std::int32_t> regions_;
};

/// Vertices that go with another one, which has moved as well, are of no triangle: they are where that is.
void place_merged(const PlanarMesh& mesh, std::span<const std::int32_t> moved, std::span<MeshPlace> places) {
  for (std::size_t i = 0; i < moved.size() && !mesh.merged.empty(); ++i) {
    const std::int32_t goes_with = mesh.merged[static_cast<std::size_t>(moved[i])];
    const auto found = std::ranges::lower_bound(moved, goes_with);
    if (found != moved.end() && *found == goes_with) {
      places[i] = places[static_cast<std::size_t>(found - moved.begin())];
    }
  }
}

/// Gives the vertices the third coordinate that the mesh has at their places; what became of it, as an array.
TransferredField move_heights(RunState& run, std::span<const Triangle> triangles, std::span<const std::int32_t> moved,
                              std::span<const MeshPlace> places) {
  MeshDocument& document = run.document;
  std::vector<double> heights(document.point_count());
  for (std::size_t v = 0; v < heights.size(); ++v) {
    heights[v] = document.points[3 * v + 2];
  }
  const DataArray read = make_data_array("z", 1, std::move(heights));
  TransferredField now = interpolated(read, triangles, moved, places, run.workers);
  for (const std::int32_t vertex : moved) {
    const auto v = static_cast<std::size_t>(vertex);
    if (now.array.value(v) != read.value(v)) {
      document.points[3 * v + 2] = stored_coordinate(document, read.value(v), now.array.value(v));
    }
  }
  return now;
}

/// `found` vertices have a place, of which some may be beside no value.
void report_transferred(RunState& run, const TransferredField& field, std::int64_t found) {
  const std::int64_t kept = field.kept_vertices;
  run.result.fields.push_back({field.array.name, found - kept});
  if (kept > 0) {
    run.note(
        fmt::format("{} as read in '{}': at {} there is no value ({}), with which none is interpolated; "
                    "fill them in first, or keep all values as read with --fields keep",
                    counted(kept, "vertex that moved stays", "vertices that moved stay"), field.array.name,
                    kept == 1 ? "a corner of its place" : "corners of their places", field.missing));
  }
}

}  // namespace

void find_fields(RunState& run) {
  const PipelineOptions& options = run.options;
  // Where the mesh follows its boundary vertices take their values along.
  if (!options.output || options.deformation) {
    return;
  }
  MeshDocument& document = run.document;
  const FileFormat target = output_format(*options.output, document.format, options.format);
  for (std::string& name : written_place_arrays(document, target)) {
    if (std::ranges::find(document.arrays_of_places, name) == document.arrays_of_places.end()) {
      document.arrays_of_places.push_back(std::move(name));
    }
  }
  FieldChoice choice = choose_fields(document, {options.fields, options.field_arrays, run.result.input.fixed_array,
                                                run.sizes.of_cells ? "" : run.sizes.array});
  std::ranges::move(choice.notes, std::back_inserter(run.result.notes));
  for (const std::size_t array : choice.kept) {
    const std::string& name = document.point_arrays[array].name;
    if ((target == document.format || has_arrays(target)) && writes_values_of(document, target, name)) {
      run.result.kept_fields.push_back(name);
    }
  }
  std::vector<std::string> kept;
  for (const std::size_t array : choice.arrays) {
    const std::string& name = document.point_arrays[array].name;
    if (writes_values_of(document, target, name)) {
      run.fields.push_back(array);
    } else {
      kept.push_back("'" + name + "'");
    }
  }
  if (!kept.empty()) {
    const bool is_one = kept.size() == 1;
    run.result.losses.push_back(
        fmt::format("the point {} {} {} not interpolated: {} files{} are written back with the values that were read; "
                    "written to another format, such as .vtu or .med, {}",
                    is_one ? "array" : "arrays", list_text(kept), is_one ? "is" : "are", title_of(target),
                    has_only_steps_kept(target) ? " of several time steps" : "", is_one ? "it is" : "they are"));
  }
}

void move_fields(RunState& run, const LocalPoints& input) {
  const bool has_heights = run.options.project && run.options.fields != Fields::keep;
  if (run.fields.empty() && !has_heights) {
    return;
  }
  const Stopwatch watch;
  const LocalPoints after = entered(input.frame, run.mesh.points);
  const std::vector<std::int32_t> moved = moved_vertices(input.points, after.points);
  const FieldTriangles mesh(run.mesh, input.points, run.regions.of_triangle);
  const PointLocation location(input.points, mesh.triangles(), mesh.regions());
  std::vector<MeshPlace> places = location.places_of(moved, after.points, run.workers);
  place_merged(run.mesh, moved, places);
  const auto found = std::ranges::count_if(places, [](const MeshPlace& place) { return place.triangle >= 0; });
  if (has_heights) {
    report_transferred(run, move_heights(run, mesh.triangles(), moved, places), found);
  }
  for (const std::size_t array : run.fields) {
    DataArray& field = run.document.point_arrays[array];
    TransferredField transferred = interpolated(field, mesh.triangles(), moved, places, run.workers);
    report_transferred(run, transferred, found);
    field = std::move(transferred.array);
  }
  run.result.timings_ms.fields += watch.milliseconds();
}

}  // namespace trismooth
