#include "trismooth/pipeline/pipeline.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <future>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/resource.h>

#include "trismooth/base/errors.h"
#include "trismooth/base/local_points.h"
#include "trismooth/base/stopwatch.h"
#include "trismooth/base/workers.h"
#include "trismooth/mesh_io/bytes/compressed_file.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/halfedge/halfedge_rings.h"
#include "trismooth/mesh_io/halfedge/plane_smoothing.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/pipeline/annotations.h"
#include "trismooth/pipeline/coordinates_hash.h"
#include "trismooth/pipeline/input/fixed_array.h"
#include "trismooth/pipeline/input/planar_mesh.h"
#include "trismooth/pipeline/input/regions.h"
#include "trismooth/pipeline/input/size_array.h"
#include "trismooth/quality/coarse_boundary.h"
#include "trismooth/quality/precision_loss.h"
#include "trismooth/quality/triangle_quality.h"
#include "trismooth/smoothing/backend_choice.h"
#include "trismooth/smoothing/constraints.h"
#include "trismooth/smoothing/errors.h"
#include "trismooth/smoothing/rings/mesh_rings.h"
#include "trismooth/smoothing/sweeps/relative_sizes.h"

namespace trismooth {

namespace {

std::int64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::int64_t>(usage.ru_maxrss) * 1024;
}

std::int64_t count_different(std::vector<std::int32_t> numbers) {
  std::ranges::sort(numbers);
  return std::unique(numbers.begin(), numbers.end()) - numbers.begin();
}

/// One run over one file. The stages are called in their order; each fills its part of the result.
class Run {
 public:
  explicit Run(const PipelineOptions& options)
      : options_(options), smoothing_(options.smoothing), workers_(options.smoothing.threads) {}

  PipelineResult run() {
    const Stopwatch watch;
    options_.smoothing.validate();
    require_known_formats(options_);
    start_backend();
    timed(Stage::read, result_.timings_ms.read, [&] { read(); });
    timed(Stage::topology, result_.timings_ms.topology, [&] { connect(); });
    timed(Stage::check_before, result_.timings_ms.check_before, [&] {
      result_.before = check();
      result_.regions_before = check_regions();
    });
    if (options_.output) {
      warn_of_precision();
      warn_of_options_without_effect();
      warn_of_boundary();
      begin(Stage::smooth);
      smooth();
      timed(Stage::check_after, result_.timings_ms.check_after, [&] {
        result_.after = check();
        result_.regions_after = check_regions();
      });
      timed(Stage::write, result_.timings_ms.write, [&] { write(*options_.output, options_.annotate); });
    } else if (options_.annotated) {
      timed(Stage::write, result_.timings_ms.write, [&] { write(*options_.annotated, true); });
    }
    result_.timings_ms.total = watch.milliseconds();
    result_.peak_memory_bytes = peak_memory_bytes();
    return std::move(result_);
  }

 private:
  void begin(Stage stage) const {
    if (options_.stage_started && options_.stage_started(stage) == Progress::stop) {
      throw Cancelled();
    }
  }

  template <class Body>
  void timed(Stage stage, double& milliseconds, const Body& body) {
    begin(stage);
    const Stopwatch watch;
    body();
    milliseconds += watch.milliseconds();
  }

  /// A device starts while the file is read, if that takes long enough to be worth a thread.
  void start_backend() {
    std::error_code no_size;
    const std::uintmax_t bytes = std::filesystem::file_size(options_.input, no_size);
    const Backend* const backend = options_.smoothing.backend;
    if (backend != nullptr && options_.output && !no_size && bytes >= bytes_worth_a_thread) {
      const auto vertices = static_cast<std::int64_t>(bytes / bytes_of_vertex);
      // Where the system refuses a thread this is put off for ever, which does no harm.
      starting_ =
          std::async(std::launch::async | std::launch::deferred, [backend, vertices] { backend->start(vertices); });
    }
  }

  void read() {
    document_ = read_mesh(options_.input, options_.smoothing.threads);
    result_.losses = document_.losses;
    // What the reader says of the file is said of what another format loses.
    const bool converts = options_.output && output_format(*options_.output) != document_.format;
    std::ranges::copy(document_.notes, std::back_inserter(converts ? result_.losses : result_.notes));
    result_.input.path = options_.input;
    result_.input.format = document_.format;
    result_.input.vertices = static_cast<std::int64_t>(document_.point_count());
  }

  /// From cells to one-rings: orientation, constraints, neighbours.
  void connect() {
    mesh_ = planar_mesh(document_, options_.input, workers_);
    std::ranges::copy(mesh_.notes, std::back_inserter(result_.notes));
    enter_frame();
    find_sizes();
    regions_ = find_regions(document_, mesh_, options_.region_arrays, sizes_.of_cells ? sizes_.array : "");
    result_.notes.insert(result_.notes.begin(), regions_.notes.begin(), regions_.notes.end());
    const FixedArray named = find_fixed_array(document_, options_.fixed_array);
    const std::vector<std::int32_t> ids =
        options_.fixed_ids ? read_vertex_ids(*options_.fixed_ids, result_.input.vertices) : std::vector<std::int32_t>{};
    if (options_.fixed_ids && ids.empty()) {
      warn(options_.fixed_ids->string() + ": names no vertices, so it holds none");
    }
    found_ = find_rings(
        {.fixed = named.flags, .fixed_ids = ids, .other_cells = mesh_.in_other_cell, .regions = regions_.of_triangle});
    if (settle_plane(mesh_, document_, found_.fixed, options_.input, workers_)) {
      enter_frame();
    }
    const ReasonCounts reasons = count_reasons(found_.fixed, workers_);
    note_irregular_vertices(reasons);
    InputSummary& input = result_.input;
    input.triangles = static_cast<std::int64_t>(mesh_.triangles.size());
    input.other_cells = mesh_.other_cells;
    input.regions = regions_.count();
    input.region_arrays = regions_.arrays;
    result_.region_names = regions_.names;
    for (const RegionArray& array : regions_.arrays) {
      input.region_array.append(input.region_array.empty() ? "" : ", ").append(array.name);
    }
    input.components = found_.components;
    input.free_vertices = reasons[0];
    input.fixed_vertices = input.vertices - input.free_vertices;
    input.reoriented_triangles = found_.reoriented_triangles;
    input.fixed_array = named.array;
    input.fixed_array_vertices = named.vertices;
    input.fixed_ids = options_.fixed_ids.value_or(std::filesystem::path{});
    input.fixed_ids_vertices = count_different(ids);
    input.held = count_held(reasons);
  }

  void find_sizes() {
    if (options_.size_array && smoothing_.method == Method::mean_ratio) {
      sizes_ = find_size_array(document_, mesh_, *options_.size_array);
      result_.input.size_array = sizes_.array;
      result_.input.sizes_are_areas = sizes_.of_cells;
      smoothing_.mean_ratio.target_lengths = sizes_.lengths;
    }
  }

  MeshRings find_rings(const Constraints& constraints) {
    try {
      return rings_for(options_.smoothing, local_.points, mesh_.triangles, constraints, [&] {
        return smoothing_.topology == Topology::halfedge
                   ? find_halfedge_rings(document_.points, local_.points, mesh_.triangles, constraints, workers_)
                   : find_mesh_rings(local_.points, mesh_.triangles, constraints, workers_);
      });
    } catch (const MeshError& error) {
      throw ReadError(options_.input, error.what());
    }
  }

  void note_irregular_vertices(const ReasonCounts& counts) {
    std::int64_t non_manifold = 0;
    std::int64_t bow_ties = 0;  // beside the ends of non-manifold edges, which join several fans as well
    for (std::size_t reasons = 0; reasons < counts.size(); ++reasons) {
      const bool on_edge = (reasons & hold::non_manifold) != 0;
      non_manifold += on_edge ? counts[reasons] : 0;
      bow_ties += !on_edge && (reasons & hold::bow_tie) != 0 ? counts[reasons] : 0;
    }
    const auto note = [&](std::int64_t count, const std::string& where) {
      if (count > 0) {
        result_.notes.push_back(std::to_string(count) + (count == 1 ? " vertex " : " vertices ") + where +
                                ": held fixed");
      }
    };
    note(non_manifold, "on edges of three triangles or more");
    note(bow_ties, "where triangles meet without sharing an edge (bow ties)");
  }

  void enter_frame() {
    local_ = local_points(
        mesh_.points, [this](std::size_t v) { return mesh_.in_cell[v] != 0; }, workers_);
  }

  QualityReport check() {
    QualityReport report = quality_report(view(), {.threads = options_.smoothing.threads});
    report.degenerate += mesh_.repeating_triangles;
    for (WorstElement& element : report.worst) {
      const Triangle& corners = mesh_.triangles[static_cast<std::size_t>(element.triangle)];
      element.all_fixed = std::ranges::all_of(corners, [this](std::int32_t v) { return found_.fixed[v] != 0; });
      element.triangle = mesh_.cells[static_cast<std::size_t>(element.triangle)];
      element.centroid = local_.frame.leave(element.centroid);
    }
    return report;
  }

  std::vector<RegionQuality> check_regions() const {
    const std::int32_t count = regions_.count();
    return count < 2 ? std::vector<RegionQuality>{}
                     : region_quality(view(), regions_.of_triangle, count, options_.smoothing.threads);
  }

  void warn_of_precision() {
    if (options_.smoothing.precision != Precision::single_precision) {
      return;
    }
    const PrecisionLoss loss = single_precision_loss(view(), options_.smoothing.threads);
    if (!loss.any()) {
      return;
    }
    warn(describe(loss) + (options_.smoothing.guard ? "; the guard checks the result in double" : "") +
         "; --precision double smooths it as it is");
  }

  void warn_of_options_without_effect() {
    const MeanRatioOptions& given = options_.smoothing.mean_ratio;
    const MeanRatioOptions usual;
    if (options_.smoothing.method == Method::mean_ratio) {
      return;
    }
    std::vector<std::string_view> names;
    if (options_.size_array) {
      names.emplace_back("--size-array");
    }
    if (given.target != usual.target) {
      names.emplace_back("--target");
    }
    if (given.size_weight != usual.size_weight) {
      names.emplace_back("--size-weight");
    }
    if (given.power != usual.power) {
      names.emplace_back("--power");
    }
    if (!names.empty()) {
      warn(fmt::format("the method {} takes no notice of {}; --method mean-ratio does",
                       to_string(options_.smoothing.method), fmt::join(names, ", ")));
    }
  }

  void warn_of_boundary() {
    if (const CoarseBoundary coarse = find_coarse_boundary(view(), found_.fixed, options_.smoothing.threads);
        coarse.any()) {
      warn(describe(coarse) + "; put more vertices on the boundary, or hold those behind it (--fixed-ids)");
    }
  }

  void warn_of_folds_put_back(const SmoothingResult& smoothing) {
    const auto& untangling = smoothing.untangling;
    if (untangling && untangling->inverted_after > untangling->inverted_untangled && smoothing.reverted_vertices > 0) {
      warn(
          fmt::format("the never-worse check put vertices back whose moves had inverted valid triangles: {} triangles "
                      "are not valid now, {} were after the untangling; --guard off leaves them moved",
                      untangling->inverted_after, untangling->inverted_untangled));
    }
  }

  void warn(std::string warning) {
    result_.warnings.push_back(std::move(warning));
    if (options_.warned) {
      options_.warned(result_.warnings.back());
    }
  }

  void smooth() {
    if (options_.annotate) {
      input_points_ = document_.points;
      metrics_before_ = metrics_of_cells("_before");
    }
    SmoothingResult smoothing = smooth_in_plane(found_, mesh_.triangles, mesh_.plane, document_.points, mesh_.points,
                                                local_, storage_of(document_), smoothing_);
    smoothing.backend_note = joined_notes(found_.note, smoothing.backend_note);
    if (smoothing.stop_reason == StopReason::cancelled) {
      throw Cancelled();
    }
    const LocalPoints input = std::exchange(local_, {});
    const std::vector<std::uint8_t> input_reversed = found_.reversed;
    enter_frame();
    if (smoothing.untangling) {
      for (std::size_t t = 0; t < smoothing.untangling->turned.size(); ++t) {
        found_.reversed[t] ^= smoothing.untangling->turned[t];
      }
    }
    warn_of_folds_put_back(smoothing);
    hash_coordinates(smoothing);
    compare_sizes({input.points, mesh_.triangles, input_reversed, input.frame.exponent});
    result_.timings_ms.topology += smoothing.timings.prepare;
    result_.timings_ms.transfer_in = smoothing.timings.transfer_in;
    result_.timings_ms.untangle = smoothing.timings.untangle;
    result_.timings_ms.smooth = smoothing.timings.smooth;
    result_.timings_ms.transfer_out = smoothing.timings.transfer_out;
    result_.timings_ms.guard = smoothing.timings.commit;
    result_.smoothing = std::move(smoothing);
  }

  void compare_sizes(const TriangleView& before) {
    const Stopwatch watch;
    const int threads = options_.smoothing.threads;
    result_.size_change = size_change(before, view(), threads);
    if (smoothing_.aims_at_sizes()) {
      const std::vector<double> asked = inverse_sizes(smoothing_, found_.fixed);
      result_.size_fit_before = size_fit(before, asked, found_.fixed, threads);
      result_.size_fit_after = size_fit(view(), asked, found_.fixed, threads);
    }
    result_.timings_ms.check_after += watch.milliseconds();
  }

  void hash_coordinates(const SmoothingResult& smoothing) {
    result_.coordinates_hash = result_.unguarded_hash = coordinates_hash(document_.points);
    if (smoothing.reverted.empty()) {
      return;
    }
    std::vector<double> unguarded = document_.points;
    for (const auto& [vertex, position] : smoothing.reverted) {
      Eigen::Map<Eigen::Vector3d> point(unguarded.data() + 3 * static_cast<std::size_t>(vertex));
      const Eigen::Vector3d moved = mesh_.plane.moved(point, mesh_.points[static_cast<std::size_t>(vertex)], position);
      point = rounded_to(storage_of(document_), moved);
    }
    result_.unguarded_hash = coordinates_hash(unguarded);
  }

  void write(const std::filesystem::path& path, bool annotate) {
    const FileFormat target = output_format(path);
    std::ranges::copy(what_is_lost(document_, target), std::back_inserter(result_.losses));
    const bool annotates = annotate && takes_added_arrays(document_, target);
    if (annotate && !annotates) {
      result_.notes.push_back("--annotate has no effect: " +
                              (target == FileFormat::ply
                                   ? std::string("a PLY file that was read is written back with nothing added")
                                   : "." + std::string(to_string(target)) + " holds no arrays") +
                              "; write " + (is_available(FileFormat::vtu) ? ".vtu" : ".vtk") + " to get them");
    }
    if (!annotates && has_arrays(target)) {
      note_old_annotations();
    }
    write_mesh(path, document_, annotates ? annotations() : AddedArrays{}, options_.smoothing.threads);
  }

  void note_old_annotations() {
    std::string names;
    for (const auto& arrays : {std::span(document_.cell_arrays), std::span(document_.point_arrays)}) {
      for (const DataArray& array : arrays) {
        if (is_annotation(array.name)) {
          names.append(names.empty() ? "" : ", ").append(array.name);
        }
      }
    }
    if (!names.empty()) {
      result_.notes.push_back("annotations of an earlier run are kept, and show that mesh: " + names +
                              "; --annotate makes new ones");
    }
  }

  TriangleView view(const LocalPoints& local) const {
    return {local.points, mesh_.triangles, found_.reversed, local.frame.exponent};
  }
  TriangleView view() const { return view(local_); }

  std::vector<DataArray> metrics_of_cells(std::string_view suffix = {}) {
    return metric_annotations(options_.annotated_metrics, view(), mesh_.cells, document_.cells.size(), workers_,
                              suffix);
  }

  AddedArrays annotations() {
    AddedArrays added;
    added.cell_arrays = metrics_of_cells();
    std::ranges::copy(metrics_before_, std::back_inserter(added.cell_arrays));
    added.point_arrays.push_back(fixed_annotation(found_.fixed, workers_));
    if (result_.smoothing) {
      added.point_arrays.push_back(displacement_annotation(input_points_, document_.points, workers_));
    }
    return added;
  }

  static constexpr std::uintmax_t bytes_worth_a_thread = std::uintmax_t{1} << 20;
  /// What a vertex and its two triangles take in a file, about.
  static constexpr std::uintmax_t bytes_of_vertex = 64;

  const PipelineOptions& options_;
  std::future<void> starting_;  ///< the backend
  SmoothingOptions smoothing_;  ///< with the sizes of the file, where it is asked for them
  Workers workers_;
  PipelineResult result_;
  MeshDocument document_;
  PlanarMesh mesh_;
  LocalPoints local_;  ///< mesh_.points in their local frame: those of the input, after the smoothing of the result
  SizeArray sizes_;
  Regions regions_;
  MeshRings found_;
  std::vector<double> input_points_;       ///< for annotations of a smoothing
  std::vector<DataArray> metrics_before_;  ///< likewise
};

}  // namespace

void require_known_formats(const PipelineOptions& options) {
  const auto& output = options.written();
  if (output && !format_of(options.input) && !format_of(*output) && !compression_named(options.input)) {
    throw ReadError(options.input, "the extension '" + options.input.extension().string() +
                                       "' names no format, nor does that of the output, " + output->string() +
                                       "; known are " + format_list());
  }
  input_format(options.input);
  if (output) {
    output_format(*output);
  }
}

PipelineResult run_pipeline(const PipelineOptions& options) {
  return Run(options).run();
}

}  // namespace trismooth
