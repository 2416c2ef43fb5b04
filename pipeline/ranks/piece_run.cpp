#include "trismooth/pipeline/ranks/piece_run.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "trismooth/base/local_points.h"
#include "trismooth/base/machine/peak_memory.h"
#include "trismooth/base/machine/release.h"
#include "trismooth/base/machine/stopwatch.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/mesh_io/parallel_file.h"
#include "trismooth/mpi/overlap_smoother.h"
#include "trismooth/mpi/plan.h"
#include "trismooth/mpi/rank_layers.h"
#include "trismooth/pipeline/ranks/agreement.h"
#include "trismooth/pipeline/ranks/file_in_pieces.h"
#include "trismooth/pipeline/ranks/gathered_run.h"
#include "trismooth/pipeline/ranks/joined/implied_sets.h"
#include "trismooth/pipeline/ranks/joined/rank_boundary.h"
#include "trismooth/pipeline/ranks/joined/rank_cells.h"
#include "trismooth/pipeline/ranks/joined/rank_components.h"
#include "trismooth/pipeline/ranks/joined/rank_constraints.h"
#include "trismooth/pipeline/ranks/joined/rank_hash.h"
#include "trismooth/pipeline/ranks/joined/rank_mesh.h"
#include "trismooth/pipeline/ranks/joined/rank_quality.h"
#include "trismooth/pipeline/ranks/joined/rank_regions.h"
#include "trismooth/pipeline/ranks/joined/rank_repeats.h"
#include "trismooth/pipeline/ranks/joined/rank_topology.h"
#include "trismooth/pipeline/ranks/partition/vertex_owners.h"
#include "trismooth/pipeline/ranks/piece_files.h"
#include "trismooth/pipeline/ranks/piece_options.h"
#include "trismooth/pipeline/ranks/shared_texts.h"
#include "trismooth/pipeline/ranks/shared_vertices.h"
#include "trismooth/pipeline/ranks/single_output.h"
#include "trismooth/pipeline/ranks/vertex_numbers.h"
#include "trismooth/pipeline/stages/topology_stage.h"
#include "trismooth/pipeline/stages/warnings.h"
#include "trismooth/smoothing/backend_choice.h"

namespace trismooth {

namespace {

bool is_file(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::is_regular_file(path, error);
}

/// What stands for a rank that has the whole mesh anyway, where the serial run has nothing to share.
constexpr std::string_view is_alone = "the only rank";

/// One run: the stages in their order, as those of run_pipeline().
class PieceRun {
 public:
  /// `reading`: of an input that is not in pieces.
  PieceRun(PipelineOptions options, FileReading reading, std::shared_ptr<const mpi::Communicator> ranks)
      : options_(std::move(options)),
        reading_(reading),
        ranks_(std::move(ranks)),
        workers_(ranks_->threads(options_.smoothing.threads)) {
    options_.smoothing.threads = workers_.count();
  }

  PipelineResult run() {
    agree(*ranks_, [&] {
      options_.smoothing.validate();
      require_piece_options(options_);
    });
    begin(Stage::read);
    const bool is_one_file = !names_parallel_file(options_.input);
    std::string reason(!is_one_file ? "" : ranks_->size() == 1 ? is_alone : what_needs_whole_mesh(options_));
    bool reads_file = is_one_file;
    if (reason.empty()) {
      const Stopwatch watch;
      read();
      result_.timings_ms.read = watch.milliseconds();
      reason = run_in_pieces();
      // (What is no file on a disk can be read once.)
      reads_file = is_one_file && !ranks_->any(ranks_->rank() == 0 && !is_file(options_.input));
    }
    if (!reason.empty()) {
      run_with_whole_mesh(reason, reads_file);
    }
    complete();
    return std::move(result_);
  }

 private:
  /// The stages behind reading, as far as they are done in pieces: what it is for people that needs the whole mesh on
  /// one rank, which nothing has been written for then; empty where all is done. The one place that decides it.
  std::string run_in_pieces() {
    if (const std::string_view option = what_needs_whole_mesh(options_); !option.empty()) {
      return std::string(option);
    }
    if (ranks_->size() == 1 && are_numbered_without_gaps(files_)) {
      return std::string(is_alone);
    }
    if (const std::string_view kind = what_is_not_joined(files_, *ranks_); !kind.empty()) {
      return std::string(kind);
    }
    if (options_.output && options_.fields != Fields::keep && !arrays_of_places_.empty()) {
      return "the values of '" + arrays_of_places_.front() + "', which follow the mesh";
    }
    if (options_.fixed_sets.empty()) {
      if (const std::string markers = unjudged_markers(files_, *ranks_); !markers.empty()) {
        return "what " + markers + " marks";
      }
    }
    timed(Stage::topology, result_.timings_ms.topology, [&] { connect(); });
    if (has_repeated_triangles(*topology_, workers_)) {
      return "triangles that are listed again";
    }
    timed(Stage::check_before, result_.timings_ms.check_before, [&] { check_before(); });
    if (!options_.output) {
      return {};
    }
    if (is_untangled()) {
      return "the untangling of inverted triangles";
    }
    begin(Stage::smooth);
    warn();
    smooth();
    timed(Stage::check_after, result_.timings_ms.check_after, [&] { check_after(); });
    begin(Stage::write);
    write(Stopwatch());
    return {};
  }

  /// All stages by rank 0, on the mesh of the one file, which is read (again), or else on that of the pieces, with what
  /// their readers have said. `reason`: as run_in_pieces() gives it.
  void run_with_whole_mesh(const std::string& reason, bool reads_file) {
    PipelineResult read = std::exchange(result_, {});
    topology_.reset();
    quality_.reset();
    mesh_ = {};
    if (reads_file) {
      files_ = {};
      read_losses_.clear();
      read_notes_.clear();
    }
    const auto with_what_was_read = [&](PipelineResult result) {
      result.timings_ms.read += read.timings_ms.read;
      result.timings_ms.total = watch_.milliseconds();
      put_in_front(read_losses_, result.losses);
      put_in_front(read_notes_, result.notes);
      if (ranks_->size() > 1) {
        result.notes.push_back("rank 0 had the whole mesh in its memory, for " + reason);
        if (result.smoothing) {
          std::string& said = result.smoothing->backend_note;
          said = joined_notes(said, result.notes.back());
        }
      }
      return result;
    };
    PipelineOptions own = options_;
    if (options_.beside.prepare) {
      own.beside.prepare = [&](const PipelineResult& result) { options_.beside.prepare(with_what_was_read(result)); };
    }
    result_ = with_what_was_read(reads_file ? run_file_gathered(own, ranks_, workers_)
                                            : run_gathered(files_, own, ranks_, workers_));
  }

  /// Collective.
  const PipelineResult& complete() {
    result_.timings_ms.total = watch_.milliseconds();
    result_.peak_memory_bytes = ranks_->largest(peak_memory_bytes());
    return result_;
  }

  void begin(Stage stage) const {
    agree(*ranks_, [&] {
      if (options_.stage_started && options_.stage_started(stage) == Progress::stop) {
        throw Cancelled();
      }
    });
  }

  template <class Body>
  void timed(Stage stage, double& milliseconds, const Body& body) {
    begin(stage);
    const Stopwatch watch;
    body();
    milliseconds += watch.milliseconds();
  }

  void note(std::string sentence) { result_.notes.push_back(std::move(sentence)); }

  void say_warning(std::string sentence) {
    result_.warnings.push_back(std::move(sentence));
    if (options_.warned) {
      options_.warned(result_.warnings.back());
    }
  }

  void read() {
    if (names_parallel_file(options_.input)) {
      read_mesh_in_pieces();
    } else {
      read_one_file();
    }
  }

  void require_output() const {
    agree(*ranks_, [&] {
      if (ranks_->rank() == 0 && options_.written()) {
        require_own_pieces(files_, *options_.written(), options_.single);
      }
    });
  }

  void read_one_file() {
    FileInPieces read = read_in_pieces(options_, reading_, *ranks_, workers_);
    files_ = std::move(read.files);
    read_input_ = std::move(read.input);
    read_notes_ = std::move(read.notes);
    read_losses_ = std::move(read.losses);
    arrays_of_places_ = std::move(read.arrays_of_places);
    require_output();
  }

  void read_mesh_in_pieces() {
    files_ = read_pieces(options_.input, *ranks_, workers_);
    require_output();
    read_input_.path = options_.input;
    read_input_.format = files_.file.piece_format;
    std::set<std::string> notes;
    std::set<std::string> losses;
    for (const Piece& piece : files_.pieces) {
      notes.insert(piece.document.notes.begin(), piece.document.notes.end());
      losses.insert(piece.document.losses.begin(), piece.document.losses.end());
    }
    // What is said of pieces is said of what one file loses.
    if (options_.single) {
      losses.merge(notes);
    }
    read_notes_ = options_.single ? std::vector<std::string>{} : texts_of_all(notes, *ranks_);
    read_losses_ = texts_of_all(losses, *ranks_);
    number_vertices(files_, *ranks_);
    check_shared_vertices(files_, *ranks_);
  }

  /// Where fewer ranks have read than there are, others get work all the same.
  void share_out() {
    const bool has_enough = std::ssize(files_.file.pieces) >= ranks_->size();
    const Partition partition = options_.partition.value_or(has_enough ? Partition::keep : Partition::bisect);
    if (partition != Partition::keep) {
      owners_ = find_owners(partition, {points_of(files_, mesh_), mesh_.triangles, mesh_.ghost_triangles}, *ranks_);
    }
  }

  void connect() {
    result_.notes = read_notes_;
    result_.losses = read_losses_;
    result_.input = read_input_;
    mesh_ = join_pieces(files_, *ranks_);
    constraints_ = find_rank_constraints(files_, mesh_, options_, *ranks_);
    share_out();
    topology_.emplace(mesh_, constraints_.named, owners_, options_.input, ranks_, workers_);
    regions_ = find_rank_regions(files_, *topology_, options_.region_arrays);
    held_ = topology_->held(regions_.of_overlap, workers_);
    std::ranges::move(settle_implied_sets(files_, mesh_, *topology_, held_),
                      std::back_inserter(result_.input.point_sets));
    const std::vector<Point2<double>> points = topology_->of_vertices<Point2<double>>(points_of(files_, mesh_));
    frame_ = topology_->frame_of(points, held_);
    local_ = entered(frame_, points).points;
    reversed_ = topology_->reversed(local_, workers_);
    layers_ = mpi::hold_layers(topology_->overlap(), local_, reversed_, options_.smoothing.used_layers(), false, held_,
                               *ranks_, workers_);
    summarise();
  }

  void summarise() {
    InputSummary& input = result_.input;
    const mpi::Overlap& overlap = topology_->overlap();
    cells_ = count_rank_cells(files_, *ranks_);
    input.other_cells = cells_.others;
    input.triangles = topology_->triangle_count();
    agree(*ranks_, [&] { require_triangles(input.triangles, cells_.cells, options_.input); });
    ReasonCounts reasons{};
    std::int64_t vertices = 0;
    for (std::int32_t v = 0; v < overlap.vertex_count(); ++v) {
      if (overlap.is_own(v)) {
        ++vertices;
        ++reasons[held_[static_cast<std::size_t>(v)]];
      }
    }
    ranks_->sum(reasons);
    input.vertices = ranks_->sum(vertices);
    input.fixed_array = constraints_.fixed_array;
    input.fixed_array_vertices = topology_->count_vertices(constraints_.by_array);
    input.fixed_ids = options_.fixed_ids.value_or(std::filesystem::path{});
    input.fixed_ids_vertices = constraints_.listed;
    for (const LabelledVertices& set : constraints_.sets) {
      input.point_sets.push_back({set.name, topology_->count_vertices(set.flags), false, true});
    }
    input.free_vertices = reasons[0];
    input.fixed_vertices = input.vertices - input.free_vertices;
    input.held = count_held(reasons, layers_);
    input.regions = static_cast<std::int32_t>(regions_.names.size());
    input.region_arrays = regions_.arrays;
    for (const RegionArray& array : regions_.arrays) {
      input.region_array.append(input.region_array.empty() ? "" : ", ").append(array.name);
    }
    result_.region_names = regions_.names;
    const RankComponents components = count_components(*topology_, reversed_);
    input.components = static_cast<std::int32_t>(components.count);
    input.reoriented_triangles = components.reoriented_triangles;
    result_.notes.insert(result_.notes.begin(), regions_.notes.begin(), regions_.notes.end());
    if (cells_.cells == 0) {
      note("the pieces hold no cells: nothing to smooth");
    }
    std::ranges::copy(notes_of_other_cells(cells_.others, cells_.repeating, cells_.first_repeating),
                      std::back_inserter(result_.notes));
    std::ranges::copy(notes_of_irregular_vertices(reasons), std::back_inserter(result_.notes));
    input.layers = layers_;
    if (std::string said = note_of_layers(layers_); !said.empty()) {
      note(std::move(said));
    }
    if (options_.fixed_ids && constraints_.listed == 0) {
      say_warning(options_.fixed_ids->string() + ": names no vertices, so it holds none");
    }
  }

  /// The number_of_cell() of a triangle; 0 where another rank has it.
  std::int64_t cell_of(std::int64_t triangle) const {
    return number_of_triangle(files_, cells_.first, topology_->local_triangle(triangle));
  }

  QualityReport quality_at(std::span<const Point2<double>> points, const LocalFrame& frame) {
    QualityReport report = quality_->report(points, frame, workers_.count());
    report.degenerate += cells_.repeating;
    std::vector<std::int64_t> cells;
    for (const WorstElement& element : report.worst) {
      cells.push_back(cell_of(element.triangle));
    }
    ranks_->sum(cells);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      report.worst[i].triangle = cells[i];
    }
    return report;
  }

  void check_before() {
    quality_.emplace(*topology_, reversed_, held_, regions_.of_overlap, result_.input.regions);
    result_.before = quality_at(local_, frame_);
    result_.regions_before = quality_->regions(local_);
  }

  void warn() {
    if (options_.smoothing.precision == Precision::single_precision) {
      const PrecisionLoss loss = quality_->precision_loss(local_, frame_.exponent, workers_.count());
      if (loss.any()) {
        say_warning(warning_of(loss, options_.smoothing));
      }
    }
    if (std::string warning = warning_of_options_without_effect(options_); !warning.empty()) {
      say_warning(std::move(warning));
    }
    const CoarseBoundary coarse = find_coarse_boundary(*topology_, local_, reversed_, held_, workers_.count());
    if (coarse.any()) {
      say_warning(warning_of(coarse));
    }
    if (std::string warning = warning_of_layers(layers_); !warning.empty()) {
      say_warning(std::move(warning));
    }
  }

  /// Whether triangles are untangled, which is not done in pieces.
  bool is_untangled() const {
    return options_.smoothing.untangles() && result_.before.inverted + result_.before.degenerate - cells_.repeating > 0;
  }

  void smooth() {
    points_ = points_of(files_, mesh_);
    SmoothingResult smoothing = smooth_points();
    agree(*ranks_, [&] {
      if (smoothing.stop_reason == StopReason::cancelled) {
        throw Cancelled();
      }
    });
    move_points(files_, points_);
    hash(smoothing);
    PipelineTimings& timings = result_.timings_ms;
    timings.topology += smoothing.timings.prepare;
    timings.transfer_in = smoothing.timings.transfer_in;
    timings.untangle = smoothing.timings.untangle;
    timings.smooth = smoothing.timings.smooth;
    timings.transfer_out = smoothing.timings.transfer_out;
    timings.guard = smoothing.timings.commit;
    result_.smoothing = std::move(smoothing);
  }

  SmoothingResult smooth_points() {
    const Stopwatch watch;
    SmoothingOptions options = mpi::agreed_options(options_.smoothing, Constraints{}, mpi::Gather::never, *ranks_);
    options.layers = Layers::smooth;  // they are held already
    mpi::OverlapSmoother smoother(ranks_, topology_->lend_overlap(std::move(regions_.of_overlap), held_), options,
                                  Sliding{}, mpi::Gather::never, mpi::OverlapSmoother::Owners::ranks);
    result_.timings_ms.topology += watch.milliseconds();
    SmoothingResult made = smoother.smooth(PointView(points_), mesh_.storage);
    topology_->take_back(smoother.take_overlap());
    return made;
  }

  void hash(const SmoothingResult& smoothing) {
    result_.coordinates_hash = result_.unguarded_hash = hash_over_ranks(mesh_.ids, places_of(files_, mesh_), *ranks_);
    if (smoothing.reverted_vertices > 0) {
      std::vector<std::array<double, 3>> places = places_of(files_, mesh_);
      for (const auto& [vertex, position] : smoothing.reverted) {
        auto& [x, y, z] = places[static_cast<std::size_t>(vertex)];
        move_point(x, y, {rounded_to(mesh_.storage, position.x), rounded_to(mesh_.storage, position.y)});
      }
      result_.unguarded_hash = hash_over_ranks(mesh_.ids, std::move(places), *ranks_);
    }
  }

  void write(const Stopwatch& watch) {
    const auto completed = [&]() -> const PipelineResult& {
      result_.timings_ms.write = watch.milliseconds();
      return complete();
    };
    if (const std::vector<std::string> dropped = drop_annotations(files_); !dropped.empty()) {
      note(note_of_dropped_annotations(dropped));
    }
    if (!options_.single) {
      write_pieces(files_, *options_.output, *ranks_, workers_, completed, options_.beside);
    } else {
      write_single(files_, options_, *ranks_, workers_, result_.losses, completed);
    }
  }

  void check_after() {
    std::vector<Point2<double>> points = topology_->of_vertices<Point2<double>>(points_);
    release(points_);
    const LocalFrame frame = topology_->frame_of(points, held_);
    const BulkVector<Point2<double>> local = entered(frame, points).points;
    release(points);
    result_.after = quality_at(local, frame);
    result_.smoothing->inverted = result_.after->inverted;
    result_.smoothing->degenerate = result_.after->degenerate;
    result_.regions_after = quality_->regions(local);
    result_.size_change = quality_->size_change(local_, frame_, local, frame, workers_.count());
    for (std::string& warning : warnings_of_invalid(result_)) {
      say_warning(std::move(warning));
    }
  }

  Stopwatch watch_;
  PipelineOptions options_;
  FileReading reading_;
  std::shared_ptr<const mpi::Communicator> ranks_;
  Workers workers_;
  PipelineResult result_;
  PieceFiles files_;
  InputSummary read_input_;                    ///< what is known when it was read
  std::vector<std::string> read_notes_;        ///< of the readers of all pieces
  std::vector<std::string> read_losses_;       ///< likewise
  std::vector<std::string> arrays_of_places_;  ///< point arrays of the file whose values follow the mesh by default
  RankMesh mesh_;
  std::vector<std::int32_t> owners_;  ///< of the rank's vertices; empty: the lowest rank that has each
  RankConstraints constraints_;
  std::optional<RankTopology> topology_;
  RankRegions regions_;
  RankCells cells_;
  std::vector<std::uint8_t> held_;
  LayersResult layers_;
  std::vector<std::uint8_t> reversed_;
  LocalFrame frame_;
  BulkVector<Point2<double>> local_;  ///< vertices of the overlap before the smoothing, in that frame
  std::optional<RankQuality> quality_;
  std::vector<Point2<double>> points_;  ///< of the rank's vertices, after it
};

}  // namespace

PipelineResult run_pieces(const PipelineOptions& options, const std::shared_ptr<const mpi::Communicator>& ranks) {
  return PieceRun(options, FileReading::any, ranks).run();
}

PipelineResult run_by_ranges(const PipelineOptions& options, const std::shared_ptr<const mpi::Communicator>& ranks) {
  return PieceRun(options, FileReading::by_ranges, ranks).run();
}

}  // namespace trismooth
