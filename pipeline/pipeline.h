// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "trismooth/mesh_io/file_format.h"
#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/pipeline/comparison.h"
#include "trismooth/pipeline/deformation.h"
#include "trismooth/pipeline/file_groups.h"
#include "trismooth/pipeline/held_vertices.h"
#include "trismooth/pipeline/moving_fields.h"
#include "trismooth/pipeline/partition.h"
#include "trismooth/pipeline/projection.h"
#include "trismooth/pipeline/quads.h"
#include "trismooth/pipeline/region_array.h"
#include "trismooth/quality/metrics.h"
#include "trismooth/quality/quadratic_quality.h"
#include "trismooth/quality/quality_report.h"
#include "trismooth/quality/region_quality.h"
#include "trismooth/quality/size_change.h"
#include "trismooth/quality/size_fit.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"
#include "trismooth/smoothing/sliding.h"

namespace trismooth {

/// The stages of a run, in their order, for progress displays.
enum class Stage : std::uint8_t { read, topology, check_before, smooth, check_after, write };

template <>
struct EnumText<Stage> {
  static constexpr std::string_view what = "stage";
  static constexpr std::array<std::pair<Stage, std::string_view>, 6> texts{{{Stage::read, "read"},
                                                                            {Stage::topology, "topology"},
                                                                            {Stage::check_before, "check_before"},
                                                                            {Stage::smooth, "smooth"},
                                                                            {Stage::check_after, "check_after"},
                                                                            {Stage::write, "write"}}};
};

struct PipelineResult;
struct HalfedgeStage;
struct MeshPicture;

/// What belongs to the mesh that a run writes and is to be there with it or not at all, as reports. Both are called
/// where the run writes a mesh alone, by rank 0 alone; `prepare` by smooth_document() too. Empty: there is nothing.
struct BesideOutput {
  /// Is told the result, up to its last notes and times, when the mesh is complete under another name, or beside the
  /// document. Where it throws, the run does: nothing takes its place, nothing is left, the document is as it was.
  std::function<void(const PipelineResult&)> prepare;
  /// Puts in place what was prepared, right behind the mesh: a run that is killed between the two leaves no report of a
  /// mesh that is not there. Where it throws, the mesh goes back; over ranks it is in place before the pieces are, and
  /// where these cannot be, the run throws, and whoever placed it is to take it back.
  std::function<void()> place;
};

/// What to run.
struct PipelineOptions {
  std::filesystem::path input;                  ///< `-`: standard input
  std::optional<std::filesystem::path> output;  ///< absent: check only, nothing is smoothed; `-`: standard output
  std::optional<FileFormat> format;             ///< of `-`, and of files whose extension names none
  SmoothingOptions smoothing;
  std::vector<std::string> region_arrays;          ///< cell arrays; empty: those that give regions
  std::optional<std::string> fixed_array;          ///< absent: the point array "fixed", where there is one; or "none"
  std::vector<std::string> fixed_sets;             ///< point sets of the file; empty: all that are not of an area
  std::optional<std::filesystem::path> fixed_ids;  ///< a file of vertex numbers, rows of the file from 0
  bool fixed_ids_are_labels = false;               ///< those are the numbers that the mesh's own file gives its points
  /// What becomes of quadrilaterals of four nodes. They are held as well, which a note says, where the mesh is in
  /// pieces or the backend smooths triangles alone.
  Quads quads = Quads::smooth;
  std::vector<std::int32_t> fixed_vertices;  ///< vertex numbers from 0, in any order, held as well
  /// Corners of triangles that are no further apart than this, in the file's unit, count as one vertex and move
  /// together; the file keeps all of them. Absent: none are joined.
  std::optional<double> merge;
  /// Which vertices of boundaries and interfaces slide along them. Lines, their tags and links are those of the file,
  /// in place of its own. Meshes with quadratic triangles or with quadrilaterals that are smoothed, in tilted planes
  /// and in files of few digits do not slide; a note says so.
  Sliding slide{};
  /// The array that has the sizes to aim at, for Method::mean_ratio; other methods take no notice of it. In place of
  /// smoothing.mean_ratio.target_lengths.
  std::optional<std::string> size_array;
  /// What becomes of point arrays where vertices move. Absent: those that say something of places (depths) are
  /// interpolated, and those that `field_arrays` names.
  std::optional<Fields> fields;
  /// Patterns of the names of point arrays to interpolate: `*` stands for any characters, `?` for one. Empty: all,
  /// where `fields` says so.
  std::vector<std::string> field_arrays;
  /// Where the boundary goes: the mesh follows it, in place of being smoothed where it is. `smoothing` is as
  /// moving_options() has it then. For run_pipeline() and an output; without sliding, sizes, map, projection, merged
  /// corners, values that follow, and a limit of time, which would leave the mesh behind its boundary. Absent: the
  /// boundary stays.
  std::optional<Deformation> deformation;
  /// Another mesh of the same points and elements, in any format, that is compared with the input, in place of
  /// smoothing that: the result's `after` is its quality. Elements may be listed in another order or from another
  /// corner on; or they are listed alike, and points are in other rows, or missing where no element uses them. Another
  /// mesh than that is a ReadError. For run_pipeline() without a mesh to write; `-`: standard input, if `input` is not.
  std::optional<std::filesystem::path> compared;
  /// Where a mesh is smoothed that lies in no plane. The third coordinate of vertices that move is interpolated then,
  /// unless `fields` are kept. Absent: such a mesh is refused.
  std::optional<Projection> project;
  /// x is longitude and y is latitude, in degrees: smoothed on a map on which shapes are those on the sphere.
  bool geographic = false;
  /// How the mesh is shared out among the ranks of an MPI job, where the program runs in one. Absent: pieces are kept
  /// where there are at least as many as ranks, all else is bisected.
  std::optional<Partition> partition;
  /// Of a mesh in pieces: rank 0 does all but reading and writing the pieces and making sweeps, with the whole mesh in
  /// its memory. Else it does so where something is asked for that is not done in pieces, which a note says.
  bool gather = false;
  /// Of a mesh in pieces: the output is one file of any format, which rank 0 writes, with the whole mesh in its memory.
  bool single = false;
  bool annotate = false;  ///< add arrays to the output, named `trismooth:...`
  /// Where the mesh goes as it was read, with annotations; for a run without `output` alone.
  std::optional<std::filesystem::path> annotated;
  std::vector<Metric> annotated_metrics{Metric::shape};  ///< those that annotations show
  bool annotated_size_ratio = false;                     ///< they show that one, too
  bool size_ratio = false;                               ///< reports have it, which takes a while
  /// The result keeps what pictures of the mesh show, for html_report(): about 100 bytes a vertex.
  bool picture = false;
  /// A stage of the program's own between reading and smoothing, which has the mesh as OpenMesh halfedges
  /// (halfedge_stage.h): it may hold vertices and give the output arrays. Called once by the topology stage, of every
  /// run of the functions below; what it throws, the run does. The host connects the mesh by halfedges then, whatever
  /// its size: smoothing.topology is Topology::automatic or halfedge, else std::invalid_argument. Empty: there is none.
  std::function<void(HalfedgeStage&)> halfedge_stage;
  std::function<Progress(Stage)> stage_started;    ///< may answer stop: Cancelled is thrown then
  std::function<void(const std::string&)> warned;  ///< is told each warning of the result before the smoothing starts
  BesideOutput beside;                             ///< what belongs to the mesh that the run writes

  /// The mesh file that the run writes, if any.
  const std::optional<std::filesystem::path>& written() const { return output ? output : annotated; }
};

/// The run was stopped by a callback; nothing was written.
struct Cancelled : std::runtime_error {
  Cancelled() : std::runtime_error("cancelled; nothing was written") {}
};

/// What was read.
struct InputSummary {
  std::filesystem::path path;  ///< for people: "standard input" for `-`
  FileFormat format = FileFormat::off;
  std::int64_t vertices = 0;
  std::int64_t triangles = 0;
  std::int64_t quadrilaterals = 0;  ///< that are elements of the mesh; those that are held are other cells
  std::int64_t other_cells = 0;
  std::int64_t lines = 0;                   ///< those of the other cells that are lines or curves
  std::int64_t crossed_quadrilaterals = 0;  ///< those of the other cells whose corners are not listed in turn: reports
                                            ///< count them as inverted
  std::int64_t quadratic_triangles = 0;     ///< those of the triangles that have six nodes
  std::int64_t quadratic_quadrilaterals = 0;  ///< those of the quadrilaterals that have eight nodes, or nine
  std::int64_t middle_nodes = 0;     ///< vertices that are neither fixed nor free, but follow the side they are on
  std::int32_t regions = 0;          ///< 0: no region array
  std::string region_array;          ///< the array that gave them, or empty; the names of several, separated by ", "
  std::int32_t components = 0;       ///< connected through edges with exactly two triangles
  std::int64_t merged_vertices = 0;  ///< that go with another one, neither fixed nor free: PipelineOptions::merge
  std::int64_t fixed_vertices = 0;
  std::int64_t free_vertices = 0;
  std::int64_t reoriented_triangles = 0;   ///< listed against their component's majority
  std::vector<RegionArray> region_arrays;  ///< the cell arrays that were obeyed, in the file's order
  std::string fixed_array;                 ///< the point array that was obeyed, or empty
  std::int64_t fixed_array_vertices = 0;   ///< where it is not zero
  std::vector<FilePointSet> point_sets;    ///< that the file has, in its order
  std::vector<FileCellSet> cell_sets;      ///< that the file has, in its order
  std::vector<FileLineGroup> line_groups;  ///< that the file has, in its order
  std::string size_array;                  ///< the array that sizes were taken from, or empty
  bool sizes_are_areas = false;            ///< of cells, not edge lengths at points
  std::filesystem::path fixed_ids;         ///< the file of vertex numbers, or empty
  std::int64_t fixed_ids_vertices = 0;     ///< that it names
  HeldVertices held;                       ///< the fixed vertices by what holds them
  LayersResult layers;                     ///< triangles that are flat in one direction

  /// Whether the other cells, of which there are some, are all lines.
  bool has_lines_alone() const { return other_cells > 0 && lines == other_cells; }
};

/// Milliseconds of each stage.
struct PipelineTimings {
  double read = 0, topology = 0, check_before = 0, transfer_in = 0, untangle = 0, smooth = 0, transfer_out = 0,
         guard = 0, check_after = 0, write = 0, total = 0, fields = 0;
};

/// The area of a region, in the file's units, before the smoothing and after it.
struct RegionArea {
  double before = 0;
  double after = 0;

  /// How much it changed, as a part of what it was.
  double relative_change() const { return before != 0 ? (after - before) / before : 0; }
};

/// What a run did and found. Cells and centroids of worst elements are those of the file, regions places in
/// `region_names`.
struct PipelineResult {
  InputSummary input;
  Topology topology = Topology::host;  ///< who found the neighbours: host, halfedge or device
  QualityReport before;                ///< `degenerate` has triangles that repeat a vertex, too; `triangles` has not
  std::optional<QualityReport> after;  ///< absent where nothing was smoothed, nor compared, as all that is of `after`
  std::optional<SmoothingResult> smoothing;          ///< absent where nothing was smoothed
  std::optional<QuadraticQuality> quadratic_before;  ///< absent where the mesh has no quadratic elements
  std::optional<QuadraticQuality>
      quadratic_after;                     ///< of the result; absent where quadratic_before is, or nothing was smoothed
  std::optional<SizeChange> size_change;   ///< absent where nothing was smoothed
  std::optional<SizeFit> size_fit_before;  ///< to the sizes asked for; absent where none were
  std::optional<SizeFit> size_fit_after;   ///< of the result; absent where size_fit_before is, or nothing was smoothed
  std::vector<InterpolatedField> fields;   ///< point arrays whose values followed the mesh
  /// Point arrays of floating point whose values stay as read where vertices moved, which nobody has asked for.
  std::vector<std::string> kept_fields;
  /// The files that belong to the mesh file, of formats of several files; of a series those of all its steps.
  std::vector<std::filesystem::path> other_outputs;
  /// Where the mesh followed its boundary: `after`, `smoothing` and all else of a result are of the worst step then.
  std::optional<DeformationResult> deformation;
  std::optional<ComparisonResult> comparison;  ///< absent where nothing was compared
  std::vector<std::string> region_names;       ///< each region's value in the file; of several arrays, "1, 7"
  std::vector<RegionArea> areas;               ///< of each region, where vertices may slide or meshes are compared; of
                                               ///< all elements together where there are no regions
  std::vector<RegionQuality> regions_before;   ///< of each region; empty where there are no two
  std::vector<RegionQuality> regions_after;    ///< of the result; empty also where nothing was smoothed
  std::uint64_t coordinates_hash = 0;          ///< XXH64 of the output coordinates x, y, z as float64
  std::uint64_t unguarded_hash = 0;            ///< coordinates_hash before the guard took vertices back
  std::vector<std::string> notes;              ///< what the user should know, one sentence each
  std::vector<std::string> losses;    ///< what the output does not hold of the input, one sentence each: always shown
  std::vector<std::string> warnings;  ///< what the user should have known before the smoothing, one sentence each
  PipelineTimings timings_ms;
  std::shared_ptr<const MeshPicture> picture;  ///< null unless it was asked for; of a mesh in pieces there is none
  std::int64_t peak_memory_bytes = 0;          ///< of this process so far
};

/// Throws where extensions name no format, before any work: WriteError for that of the output, ReadError where the
/// input has none either. The content of the input may show its format.
void require_known_formats(const PipelineOptions& options);

/// Runs the stages on one file, in the order of Stage. Throws ReadError or MeshError for an input that
/// cannot be read or is no planar triangle mesh, WriteError for an output that cannot be written,
/// std::invalid_argument for options that do not fit the input, Cancelled.
PipelineResult run_pipeline(const PipelineOptions& options);

/// Runs the stages on a mesh that has been read, or that the program has made: all but reading and writing. Throws what
/// run_pipeline() does, and MeshError for a document that require_sound() refuses. `document` is as it was wherever
/// this throws, else its points, and the point arrays that follow the mesh, are those of the result: write_mesh()
/// writes them. `options.input` names the mesh in messages ("the mesh" where it is empty); `options.output` and
/// `options.format` mean nothing: what follows the mesh is chosen for the format that the mesh was read from. The
/// result has no hash, time or loss of writing.
PipelineResult smooth_document(MeshDocument& document, const PipelineOptions& options);

/// The quality of a mesh that has been read or made, by the stages up to the smoothing. Throws MeshError for a document
/// that require_sound() refuses, and else what run_pipeline() does of reading and checking.
PipelineResult check_document(MeshDocument& document, const PipelineOptions& options);

}  // namespace trismooth
