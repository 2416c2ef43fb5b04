// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/stages/topology_stage.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/base/text/counted.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/pipeline/input/fixed_array.h"
#include "trismooth/pipeline/input/line_groups.h"
#include "trismooth/pipeline/input/map_mesh.h"
#include "trismooth/pipeline/input/near_corners.h"
#include "trismooth/pipeline/input/odd_quads.h"
#include "trismooth/pipeline/input/point_sets.h"
#include "trismooth/pipeline/input/slide_lines.h"
#include "trismooth/pipeline/stages/field_stage.h"
#include "trismooth/pipeline/stages/halfedge_way.h"
#include "trismooth/pipeline/stages/mesh_summary.h"
#include "trismooth/pipeline/stages/run_state.h"
#include "trismooth/smoothing/backend_choice.h"
#include "trismooth/smoothing/errors.h"
#include "trismooth/smoothing/result_text.h"

namespace trismooth {

namespace {

std::int64_t count_different(std::vector<std::int32_t> numbers) {
  std::ranges::sort(numbers);
  return std::unique(numbers.begin(), numbers.end()) - numbers.begin();
}

/// Flags that are set in one of the two; none where neither has any.
std::vector<std::uint8_t> united(const std::vector<std::uint8_t>& first, const std::vector<std::uint8_t>& second) {
  if (first.empty() || second.empty()) {
    return first.empty() ? second : first;
  }
  std::vector<std::uint8_t> both(first.size());
  std::ranges::transform(first, second, both.begin(),
                         [](std::uint8_t a, std::uint8_t b) { return static_cast<std::uint8_t>(a | b); });
  return both;
}

/// Sets the flags of these vertices.
void add_vertices(std::vector<std::uint8_t>& flags, const std::vector<std::int32_t>& vertices, std::size_t count) {
  if (!vertices.empty()) {
    flags.resize(count, 0);
  }
  for (const std::int32_t v : vertices) {
    flags[v] = 1;
  }
}

/// Throws std::invalid_argument for a number that is none of the vertices.
void require_vertices(const std::vector<std::int32_t>& numbers, std::int64_t count) {
  for (const std::int32_t v : numbers) {
    if (v < 0 || v >= count) {
      throw std::invalid_argument("fixed: vertex " + std::to_string(v) + " is not one of the " + std::to_string(count) +
                                  " vertices");
    }
  }
}

/// The vertices by what holds them, but for the middles that follow their sides and those that go with another vertex.
ReasonCounts count_vertices(RunState& run) {
  ReasonCounts counts = count_reasons(run.found.fixed, run.workers);
  for (const MiddleNode& middle : run.mesh.middles) {
    --counts[run.found.fixed[middle.vertex]];
  }
  for (std::size_t v = 0; v < run.mesh.merged.size(); ++v) {
    counts[run.found.fixed[v]] -= run.mesh.merged[v] != static_cast<std::int32_t>(v) ? 1 : 0;
  }
  return counts;
}

/// The vertices that the user's file names. Where rows are asked for and the mesh's own file has other numbers, a note
/// tells the two apart.
std::vector<std::int32_t> ids_of_file(RunState& run) {
  const PipelineOptions& options = run.options;
  const MeshDocument& document = run.document;
  if (!options.fixed_ids) {
    return {};
  }
  if (options.fixed_ids_are_labels) {
    return read_vertex_labels(*options.fixed_ids, document);
  }
  if (document.first_point_label && (*document.first_point_label != 0 || !document.point_labels.empty())) {
    run.note(
        "--fixed-ids takes rows of the file, which count from 0; the file has numbers of its own for its points, " +
        std::to_string(*document.first_point_label) + " for the first, which --fixed-labels takes");
  }
  return read_vertex_ids(*options.fixed_ids, run.result.input.vertices);
}

void find_sizes(RunState& run) {
  if (run.options.size_array && run.smoothing.method == Method::mean_ratio) {
    if (run.options.geographic) {
      throw std::invalid_argument(
          "--size-array has lengths or areas of no unit that --geographic could compare with those on its map; leave "
          "out "
          "one of them");
    }
    run.sizes = find_size_array(run.document, run.mesh, *run.options.size_array);
    run.result.input.size_array = run.sizes.array;
    run.result.input.sizes_are_areas = run.sizes.of_cells;
    run.smoothing.mean_ratio.target_lengths = run.sizes.lengths;
  }
}

/// Joins corners that nearly coincide, where the options want it.
void merge_near_corners(RunState& run) {
  const PipelineOptions& options = run.options;
  if (!options.merge) {
    return;
  }
  if (options.geographic || options.project || options.slide.along != Slide::off) {
    throw std::invalid_argument(std::string("--merge is for meshes as they lie in their plane; leave out ") +
                                (options.geographic ? "--geographic"
                                 : options.project  ? "--project"
                                                    : "--slide") +
                                ", or --merge");
  }
  const std::int64_t merged = merge_corners(run.mesh, *options.merge);
  run.result.input.merged_vertices = merged;
  run.note(counted(merged, "vertex goes", "vertices go") +
           " with another one within the distance of --merge; the file keeps all of them");
}

/// Whether quadrilaterals are smoothed in this run; of those that have to be held although that is asked for a note
/// says why.
Quads settled_quads(RunState& run) {
  const PipelineOptions& options = run.options;
  const auto is_quad = [&](std::size_t cell) {
    return quad_of_cell(run.document.cells.types[cell], run.document.cells[cell]).has_value();
  };
  const Backend& backend = backend_of(run.smoothing);
  if (options.quads == Quads::hold || backend.takes_quadrilaterals()) {
    return options.quads;
  }
  const std::string reason = "backend '" + backend.name() + "' smooths triangles alone here";
  std::int64_t quads = 0;
  std::int64_t triangles = 0;
  for (std::size_t cell = 0; cell < run.document.cells.size(); ++cell) {
    quads += is_quad(cell) ? 1 : 0;
    triangles += count_triangles(run.document.cells.types[cell], run.document.cells[cell]);
  }
  const std::string held = counted(quads, "quadrilateral is", "quadrilaterals are") + " held: " + reason;
  if (quads > 0 && triangles == 0) {
    throw ReadError(options.input, "holds no triangle, and " + held);
  }
  if (quads > 0) {
    run.note(held);
  }
  return Quads::hold;
}

/// Finds whether vertices of this mesh can slide where the options want it.
void settle_sliding(RunState& run) {
  if (run.options.slide.along == Slide::off) {
    return;
  }
  if (run.options.geographic) {
    throw std::invalid_argument(
        "--slide is for lines in a plane, which --geographic makes curves of; leave out one of them");
  }
  if (!run.mesh.quadratics.empty()) {
    run.note("the mesh has elements with nodes in the middle of their sides: no vertex slides");
  } else if (!run.mesh.plane.aligned) {
    run.note("the mesh lies in a tilted plane, where rounding takes points off their lines: no vertex slides");
  } else if (run.document.most_coordinate_characters > 0) {
    run.note("the file has room for few digits of a coordinate, which takes points off their lines: no vertex slides");
  } else {
    run.slide = run.options.slide.along;
  }
}

/// What the file says of lines, where vertices slide.
SlideLines slide_lines_of(const RunState& run) {
  return run.slide != Slide::off ? find_slide_lines(run.document, run.mesh, run.regions.arrays) : SlideLines{};
}

/// `lines` outlive it.
Sliding sliding_of(const RunState& run, const SlideLines& lines) {
  if (run.slide == Slide::off) {
    return {};
  }
  Sliding slide = run.options.slide;
  slide.lines = lines.lines;
  slide.line_tags = lines.tags;
  slide.links = lines.links;
  return slide;
}

/// To hold a middle holds the ends of its side, which who takes it for a vertex of the boundary may not want.
void note_held_middles(RunState& run, std::vector<std::uint8_t> held) {
  std::int64_t middles = 0;
  if (!held.empty()) {
    for (const QuadraticElement& quadratic : run.mesh.quadratics) {
      for (const std::int32_t middle : quadratic.middles) {
        // (A middle of two elements counts once.)
        middles += middle != no_corner && std::exchange(held[middle], std::uint8_t{0}) != 0 ? 1 : 0;
      }
    }
  }
  if (middles > 0) {
    run.note(
        "the program's own stage holds " + counted(middles, "middle of a side", "middles of sides") +
        ", and with them the ends of these sides; they are vertices without a face, which OpenMesh calls boundary");
  }
}

/// Quadrilaterals without thickness keep their sides together, unless no sets are to hold anything.
void hold_thin_quads(RunState& run, std::vector<std::uint8_t>& fixed) {
  if (run.mesh.elements.are_triangles() || holds_no_sets(run.options.fixed_sets)) {
    return;
  }
  // (The file's own reader has told of those of its sets.)
  std::vector<std::uint8_t> known = fixed;
  for (const NamedSet& set : run.document.implied_sets) {
    add_vertices(known, set.members, run.document.point_count());
  }
  const ThinQuads thin = find_thin_quads(run.mesh, run.document.points, known);
  fixed = united(fixed, thin.flags);
  if (thin.count > 0) {
    run.note(counted(thin.count, "quadrilateral has no thickness, as elements of interfaces and cohesive zones: its",
                     "quadrilaterals have no thickness, as elements of interfaces and cohesive zones: their") +
             " vertices are held; --fixed-set none frees them");
  }
}

/// Whether the host goes by halfedges. Beyond so many triangles their memory is more than it is worth, and the handles
/// of OpenMesh come to their end; a check alone has no use for them.
bool goes_by_halfedges(const RunState& run) {
  constexpr std::size_t most_triangles = 16'000'000;
  return run.smoothing.topology == Topology::halfedge ||
         (run.smoothing.topology != Topology::host && run.options.output && has_halfedges() &&
          run.mesh.elements.are_triangles() && run.mesh.elements.size() <= most_triangles);
}

/// `halfedges`: where the mesh has been connected by them already.
MeshRings rings_of(RunState& run, const Constraints& constraints, std::unique_ptr<const HalfedgeWay> halfedges) {
  const PlanarMesh& mesh = run.mesh;
  // Of a mesh that follows its boundary, layers go where that carries them.
  const Layers layers = run.options.deformation ? Layers::smooth : run.smoothing.used_layers();
  const auto on_host = [&] {
    if (halfedges == nullptr && goes_by_halfedges(run)) {
      halfedges = connect_by_halfedges(run);
    }
    return halfedges == nullptr ? find_mesh_rings(run.local.points, mesh.elements, constraints, run.workers, layers)
                                : halfedges->rings(run, constraints, layers);
  };
  try {
    return halfedges != nullptr
               ? on_host()
               : rings_for(run.options.smoothing, run.local.points, mesh.elements, constraints, on_host);
  } catch (const MeshError& error) {
    const bool has_quads = !mesh.elements.are_triangles();
    throw ReadError(run.options.input,
                    std::string(error.what()) + (has_quads ? "; --quads hold leaves quadrilaterals as they are" : ""));
  }
}

}  // namespace

void connect_mesh(RunState& run) {
  const PipelineOptions& options = run.options;
  if (options.halfedge_stage && options.smoothing.topology != Topology::automatic &&
      options.smoothing.topology != Topology::halfedge) {
    throw std::invalid_argument("halfedge_stage is for meshes connected by halfedges: topology 'auto' or 'halfedge'");
  }
  const MeshDocument& document = run.document;
  PlanarMesh& mesh = run.mesh;
  PipelineResult& result = run.result;
  InputSummary& input = result.input;
  const Quads quads = settled_quads(run);
  mesh = options.project ? projected_mesh(document, options.input, run.workers, quads)
                         : planar_mesh(document, options.input, run.workers, quads);
  if (options.geographic) {
    lay_on_map(mesh, document, options.input);
  } else if (looks_geographic(mesh, document)) {
    run.note(std::string(looks_geographic_note));
  }
  hold_crossed_quads(mesh);
  require_elements(std::ssize(mesh.cells), std::ssize(document.cells.types), options.input,
                   {.crossed_quads = mesh.crossed_quads});
  merge_near_corners(run);
  take_out_copies(mesh, run.workers);
  std::ranges::copy(mesh.notes, std::back_inserter(result.notes));
  run.enter_frame();
  find_sizes(run);
  run.regions = find_regions(document, mesh, options.region_arrays, run.sizes.of_cells ? run.sizes.array : "");
  const FixedArray named = find_fixed_array(document, options.fixed_array);
  HeldSets sets = find_held_sets(document, mesh.elements, options.fixed_sets, run.regions.of_triangle,
                                 options.slide.along != Slide::off);
  std::ranges::move(sets.notes, std::back_inserter(result.notes));
  std::vector<std::uint8_t> fixed = united(named.flags, sets.flags);
  hold_thin_quads(run, fixed);
  std::unique_ptr<const HalfedgeWay> halfedges;
  if (options.halfedge_stage) {
    halfedges = connect_by_halfedges(run);
    const std::vector<std::uint8_t> held = halfedges->run_stage(run);
    note_held_middles(run, held);
    fixed = united(fixed, held);
  }
  std::vector<std::int32_t> ids = ids_of_file(run);
  input.fixed_ids_vertices = count_different(ids);
  require_vertices(options.fixed_vertices, input.vertices);
  std::ranges::copy(options.fixed_vertices, std::back_inserter(ids));
  if (!mesh.quadratics.empty()) {
    add_vertices(fixed, ids, document.point_count());
    run.note(shared_middles_text(settle_middles(mesh, document.points, fixed)));
  }
  if (!mesh.merged.empty()) {
    add_vertices(fixed, ids, document.point_count());
    merge_flags(mesh, fixed);
  }
  settle_sliding(run);
  const SlideLines lines = slide_lines_of(run);
  std::ranges::copy(lines.notes, std::back_inserter(result.notes));
  run.found = rings_of(run,
                       {.fixed = fixed,
                        .fixed_ids = ids,
                        .other_cells = run.slide != Slide::off ? lines.in_other_cell : mesh.in_other_cell,
                        .regions = run.regions.of_triangle,
                        .slide = sliding_of(run, lines)},
                       std::move(halfedges));
  if (!options.project && !mesh.map && settle_plane(mesh, document, run.found.fixed, options.input, run.workers)) {
    run.enter_frame();
    // (On the way it may have become a tilted one.)
    run.found.slidable = mesh.plane.aligned ? std::move(run.found.slidable) : Slidable{};
  }
  input.quadratic_quadrilaterals = mesh.count_quadratic_quads();
  input.quadratic_triangles = std::ssize(mesh.quadratics) - input.quadratic_quadrilaterals;
  input.middle_nodes = std::ssize(mesh.middles);
  input.crossed_quadrilaterals = mesh.crossed_quads;
  result.topology = run.found.found_by;
  const MeshFacts facts{.vertices = input.vertices,
                        .elements = static_cast<std::int64_t>(mesh.elements.size()),
                        .quadrilaterals = mesh.count_quadrilaterals(),
                        .other_cells = mesh.other_cells,
                        .lines = mesh.lines,
                        .components = run.found.components,
                        .reoriented_triangles = run.found.reoriented_triangles,
                        .reasons = count_vertices(run),
                        .layers = run.found.layers,
                        .regions = run.regions};
  summarise_mesh(run, facts);
  if (are_apart(facts)) {
    run.note(describe_apart_elements(mesh.points, mesh.elements));
  }
  input.fixed_array = named.array;
  input.fixed_array_vertices = named.vertices;
  input.point_sets = std::move(sets.sets);
  input.cell_sets = summarise_cell_sets(document);
  input.line_groups = find_line_groups(document);
  find_fields(run);
}

}  // namespace trismooth
