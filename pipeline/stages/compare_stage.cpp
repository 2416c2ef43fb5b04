// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/stages/compare_stage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>

#include "trismooth/base/text/counted.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/mesh_io/standard_streams.h"
#include "trismooth/pipeline/coordinates_hash.h"
#include "trismooth/pipeline/input/map_mesh.h"
#include "trismooth/pipeline/input/matched_points.h"
#include "trismooth/pipeline/report/comparison_text.h"
#include "trismooth/pipeline/stages/run_state.h"
#include "trismooth/pipeline/stages/smooth_stage.h"
#include "trismooth/pipeline/stages/stored_result.h"
#include "trismooth/quality/element.h"
#include "trismooth/quality/orientation.h"
#include "trismooth/quality/size_change.h"
#include "trismooth/quality/text/report_text.h"

namespace trismooth {

namespace {

using Numbers = Eigen::Map<const Eigen::Vector3d>;

/// As the run had it before the other mesh took its place.
struct MeshBefore {
  BulkVector<Point2<double>> places;
  LocalPoints local;
  std::vector<std::uint8_t> reversed;
  bool is_seen_alike = true;  ///< the other one is seen from the same side
};

/// Whether the points lie where those of the run's mesh do, so that both are seen alike.
bool lies_in(const Plane& plane, const RunState& run, std::span<const double> points) {
  // As far as points may be from the plane that is found for them.
  constexpr double flatness = 1e-6;
  const double most = flatness * std::ldexp(1.0, run.local.frame.exponent);
  const Eigen::Vector3d normal = plane.normal();
  for (std::size_t v = 0; v < run.mesh.in_cell.size(); ++v) {
    if (run.mesh.in_cell[v] != 0 && !(std::abs(normal.dot(Numbers(points.data() + 3 * v) - plane.foot)) <= most)) {
      return false;
    }
  }
  return true;
}

/// Answers whether both are in one plane, or in parallel ones along the axes.
bool lay_into_plane(RunState& run, const MeshDocument& other) {
  PlanarMesh& mesh = run.mesh;
  const std::filesystem::path& path = *run.options.compared;
  bool is_same_plane = true;
  if (!run.options.project) {
    const PlaneFit fit = fit_plane(other.points, mesh.in_cell, run.document.cells, storage_of(other), run.workers);
    if (!fit.is_planar()) {
      throw ReadError(shown_input(path), fit.fault() +
                                             "; only planar meshes can be compared, or where z is a function "
                                             "of x and y with --project xy");
    }
    is_same_plane = (mesh.plane.aligned && fit.plane.aligned && mesh.plane.axes == fit.plane.axes) ||
                    lies_in(mesh.plane, run, other.points);
    if (!is_same_plane) {
      mesh.plane = fit.plane;
      run.note(shown_input(path).string() + ": lies in another plane; each mesh is measured in its own");
    }
  }
  auto points = project(mesh.plane, other.points, mesh.in_cell, run.workers);
  if (!points) {
    throw ReadError(shown_input(path),
                    "the mesh is too large: coordinates along its tilted plane are beyond the range of double; scale "
                    "it down");
  }
  mesh.points = *std::move(points);
  return is_same_plane;
}

/// What --merge joins in the one mesh is one vertex in the other as well, or the two cannot be seen as one.
void require_joined(const RunState& run) {
  const PlanarMesh& mesh = run.mesh;
  std::int64_t apart = 0;
  for (std::size_t v = 0; v < mesh.merged.size(); ++v) {
    const Point2<double> way = mesh.points[v] - mesh.points[static_cast<std::size_t>(mesh.merged[v])];
    apart += std::hypot(way.x, way.y) > *run.options.merge ? 1 : 0;
  }
  if (apart > 0) {
    throw ReadError(
        shown_input(*run.options.compared),
        fmt::format("{} that --merge joins in {} further apart here than that; compare without --merge",
                    counted(apart, "corner", "corners"), apart == 1 ? "the other mesh is" : "the other mesh are"));
  }
}

MeshBefore take_place(RunState& run, const MeshDocument& other) {
  PlanarMesh& mesh = run.mesh;
  MeshBefore before{mesh.points, {}, std::move(run.found.reversed)};
  if (mesh.map) {
    require_degrees(mesh, other, shown_input(*run.options.compared));
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
      if (mesh.in_cell[v] != 0) {
        mesh.points[v] = mesh.place(v, Numbers(other.points.data() + 3 * v));
      }
    }
  } else {
    before.is_seen_alike = lay_into_plane(run, other);
  }
  require_joined(run);
  before.local = std::exchange(run.local, {});
  run.enter_frame();
  run.found.reversed = mesh.elements.visit([&](const auto& listed) {
    const auto vertices = static_cast<std::int32_t>(mesh.points.size());
    return orient(match_sides(vertices, listed, run.workers), listed, run.local.points, run.workers).reversed;
  });
  return before;
}

/// Whether a coordinate is the same in both, but for what the numbers of one of the files can hold.
bool is_rounded(const MeshDocument& first, double of_first, const MeshDocument& second, double of_second) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();  // for what a file has no finite number for
  return stored_coordinate(second, none, of_first) == of_second ||
         stored_coordinate(first, none, of_second) == of_first;
}

/// The root mean square length of the sides around each vertex in the local frame; 0 where it is no corner.
std::vector<double> lengths_around(const MeshView& view) {
  std::vector<double> lengths(view.points.size(), 0);
  std::vector<std::int32_t> sides(view.points.size(), 0);
  for (const auto corners : view.elements) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const auto a = static_cast<std::size_t>(corners[i]);
      const auto b = static_cast<std::size_t>(next_corner(corners, i));
      const double squared = squared_length(view.points[b] - view.points[a]);
      for (const std::size_t end : {a, b}) {
        lengths[end] += squared;
        ++sides[end];
      }
    }
  }
  for (std::size_t v = 0; v < lengths.size(); ++v) {
    lengths[v] = sides[v] > 0 ? std::sqrt(lengths[v] / sides[v]) : 0;
  }
  return lengths;
}

/// By how much vertex v differs, in the file's unit.
double displacement_of(const RunState& run, const MeshDocument& other, std::size_t v) {
  Eigen::Vector3d way = Numbers(other.points.data() + 3 * v) - Numbers(run.document.points.data() + 3 * v);
  if (run.mesh.map) {
    way.x() = std::remainder(way.x(), 360.0);
  }
  if (run.options.project) {
    way[run.mesh.plane.across()] = 0;
  }
  return std::hypot(way.x(), way.y(), way.z());
}

/// Finds the vertices that moved: one flag each.
std::vector<std::uint8_t> compare_vertices(const RunState& run, const MeshDocument& other, const MeshBefore& before,
                                           ComparisonResult& result) {
  const std::vector<double> lengths =
      lengths_around({before.local.points, run.mesh.elements, before.reversed, before.local.frame.exponent});
  std::vector<std::uint8_t> has_moved(run.mesh.points.size(), 0);
  double sum = 0;
  double relative_sum = 0;
  std::int64_t corners = 0;
  for (std::size_t v = 0; v < has_moved.size(); ++v) {
    bool differs = false;
    for (std::size_t i = 3 * v; i < 3 * v + 3; ++i) {
      const double here = run.document.points[i];
      const double there = other.points[i];
      differs = differs || here != there;
      if (here != there && !is_rounded(run.document, here, other, there)) {
        has_moved[v] = 1;
      }
    }
    if (has_moved[v] == 0) {
      result.rounded_vertices += differs ? 1 : 0;
      continue;
    }
    ++result.moved_vertices;
    const double displacement = displacement_of(run, other, v);
    sum += displacement;
    if (result.farthest_vertex < 0 || displacement > result.largest_displacement) {
      result.farthest_vertex = static_cast<std::int64_t>(v);
      result.largest_displacement = displacement;
    }
    if (lengths[v] > 0) {
      const Point2<double> way = run.mesh.points[v] - before.places[v];
      const double seen = run.mesh.map ? std::hypot(way.x, way.y) : displacement;
      const double relative = std::ldexp(seen, -before.local.frame.exponent) / lengths[v];
      result.largest_relative_displacement = std::max(result.largest_relative_displacement, relative);
      relative_sum += relative;
      ++corners;
    }
  }
  result.mean_displacement = result.moved_vertices > 0 ? sum / static_cast<double>(result.moved_vertices) : 0;
  result.mean_relative_displacement = corners > 0 ? relative_sum / static_cast<double>(corners) : 0;
  return has_moved;
}

/// What a smoothing would hold of those that moved. Middles go with their sides, and merged corners with others.
void count_held_moves(const RunState& run, std::span<const std::uint8_t> has_moved, ComparisonResult& result) {
  std::vector<std::uint8_t> follows(has_moved.size(), 0);
  for (const MiddleNode& middle : run.mesh.middles) {
    follows[middle.vertex] = 1;
  }
  for (std::size_t v = 0; v < run.mesh.merged.size(); ++v) {
    follows[v] = run.mesh.merged[v] != static_cast<std::int32_t>(v) ? 1 : 0;
  }
  ReasonCounts counts{};
  for (std::size_t v = 0; v < has_moved.size(); ++v) {
    if (has_moved[v] != 0 && follows[v] == 0) {
      ++counts[run.found.fixed[v]];
      result.held_vertices += run.found.fixed[v] != 0 ? 1 : 0;
    }
  }
  result.held = count_held(counts, {});
}

void compare_elements(const MeshView& before, const MeshView& now, std::span<const std::uint8_t> has_moved,
                      ComparisonResult& result) {
  before.elements.visit([&](const auto& listed) {
    for (std::size_t e = 0; e < listed.size(); ++e) {
      const bool was_reversed = before.reversed[e] != 0;
      const bool is_reversed = now.reversed[e] != 0;
      result.mirrored_elements += was_reversed != is_reversed ? 1 : 0;
      if (std::ranges::none_of(corners_of(listed[e]), [&](std::int32_t v) { return has_moved[v] != 0; })) {
        continue;
      }
      const double was = quotient_at(canonical_corners(listed[e], was_reversed), before.points);
      const double is = quotient_at(canonical_corners(listed[e], is_reversed), now.points);
      constexpr double rounding = 1e-12;
      result.better_elements += is > was + rounding ? 1 : 0;
      result.worse_elements += is < was - rounding ? 1 : 0;
      result.newly_invalid_elements += was > 0 && !(is > 0) ? 1 : 0;
      result.newly_valid_elements += is > 0 && !(was > 0) ? 1 : 0;
    }
  });
}

}  // namespace

void check_comparison(const PipelineOptions& options) {
  if (!options.compared) {
    return;
  }
  if (options.written() || options.deformation) {
    throw std::invalid_argument("compared: two meshes are compared, and nothing is written or moved");
  }
  if (is_standard_stream(options.input) && is_standard_stream(*options.compared)) {
    throw std::invalid_argument("two meshes are compared, of which standard input can be one");
  }
}

MeshDocument read_compared(RunState& run) {
  const PipelineOptions& options = run.options;
  const std::filesystem::path path = shown_input(*options.compared);
  MeshDocument other = read_mesh(*options.compared, FileOptions{options.smoothing.threads, options.format});
  ComparisonResult& result = run.result.comparison.emplace();
  result.path = path;
  result.format = other.format;
  result.coordinates_hash = coordinates_hash(other.points);
  MatchedPoints matched = match_points(run.document, run.result.input.path, other, path, run.workers);
  other.points = std::move(matched.points);
  other.cells = {};
  for (const std::string& note : other.notes) {
    run.note(path.string() + ": " + note);
  }
  std::ranges::move(matched.notes, std::back_inserter(run.result.notes));
  return other;
}

void compare_meshes(RunState& run, const MeshDocument& other) {
  const MeshBefore before = take_place(run, other);
  const MeshView view{before.local.points, run.mesh.elements, before.reversed, before.local.frame.exponent};
  ComparisonResult& result = *run.result.comparison;
  const std::vector<std::uint8_t> has_moved = compare_vertices(run, other, before, result);
  count_held_moves(run, has_moved, result);
  compare_elements(view, run.view(), has_moved, result);
  result.mirrored_elements = before.is_seen_alike ? result.mirrored_elements : 0;
  run.result.size_change = size_change(view, run.view(), run.options.smoothing.threads);
  compare_areas(run, view);
}

void warn_of_comparison(RunContext& run) {
  const PipelineResult& result = run.result;
  const ComparisonResult& comparison = *result.comparison;
  if (comparison.held_vertices > 0) {
    const bool is_domain = comparison.held.boundary + comparison.held.interface > 0;
    run.warn(fmt::format("{} that a smoothing{} holds ({}){}",
                         counted(comparison.held_vertices, "vertex moved", "vertices moved"),
                         is_domain ? " without --slide" : "", moved_held_text(comparison),
                         is_domain ? ": the domain or its regions may have changed; " + areas_text(result) : ""));
  }
  if (comparison.mirrored_elements > 0) {
    run.warn(fmt::format("{} is mirrored against {}: {} of parts that are turned over, each seen from its own side",
                         comparison.path.string(), result.input.path.string(),
                         counted(comparison.mirrored_elements, "element", "elements")));
  }
  const auto [one, several] = element_words(result.before.triangles, result.before.quadrilaterals);
  if (comparison.newly_invalid_elements > 0) {
    run.warn(
        fmt::format("{} inverted or degenerate in {} and valid in {}",
                    counted(comparison.newly_invalid_elements, std::string(one) + " is", std::string(several) + " are"),
                    comparison.path.string(), result.input.path.string()));
  }
  if (comparison.rounded_vertices > 0) {
    run.note(fmt::format("{} by the rounding of the numbers of a file alone: taken as not moved",
                         counted(comparison.rounded_vertices, "vertex differs", "vertices differ")));
  }
}

}  // namespace trismooth
