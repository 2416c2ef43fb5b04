// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/piece_run.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include "trismooth/base/local_points.h"
#include "trismooth/base/machine/peak_memory.h"
#include "trismooth/base/machine/release.h"
#include "trismooth/base/machine/stopwatch.h"
#include "trismooth/mesh_io/document/place_values.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/mesh_io/parallel_file.h"
#include "trismooth/mpi/overlap_smoother.h"
#include "trismooth/mpi/plan.h"
#include "trismooth/mpi/rank_layers.h"
#include "trismooth/pipeline/fields/field_choice.h"
#include "trismooth/pipeline/input/odd_quads.h"
#include "trismooth/pipeline/input/point_sets.h"
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
#include "trismooth/pipeline/stages/growth_note.h"
#include "trismooth/pipeline/stages/mesh_summary.h"
#include "trismooth/pipeline/stages/staged_run.h"
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

/// What it is for people that needs the whole mesh on one rank, which nothing has been written for then.
struct NeedsWholeMesh {
  std::string reason;
};
[[noreturn]] void need_whole_mesh(std::string reason) {
  // No error, which nobody takes it for: run_pieces() goes on from it.
  throw NeedsWholeMesh{std::move(reason)};  // NOLINT(bugprone-std-exception-baseclass)
}

/// A mesh of which each rank has pieces. Throws NeedsWholeMesh, on all ranks, where that is not enough.
class PieceMesh final : public StagedMesh {
 public:
  /// `reading`: of an input that is not in pieces. The options outlive it.
  PieceMesh(const PipelineOptions& options, FileReading reading, std::shared_ptr<const mpi::Communicator> ranks)
      : run_(options), reading_(reading), ranks_(std::move(ranks)) {}

  RunContext& context() override { return run_; }
  void together(const std::function<void()>& work) const override { agree(*ranks_, work); }
  std::int64_t peak_memory() const override { return ranks_->largest(peak_memory_bytes()); }

  void read() override {
    if (names_parallel_file(run_.options.input)) {
      read_mesh_in_pieces();
    } else {
      read_one_file();
    }
    if (const std::string_view option = what_needs_whole_mesh(run_.options); !option.empty()) {
      need_whole_mesh(std::string(option));
    }
    if (ranks_->size() == 1 && are_numbered_without_gaps(files_)) {
      need_whole_mesh(std::string(is_alone));
    }
    if (const std::string_view kind = what_is_not_joined(files_, run_.options.smoothing, *ranks_); !kind.empty()) {
      need_whole_mesh(std::string(kind));
    }
    if (run_.options.output && run_.options.fields != Fields::keep && !arrays_of_places_.empty()) {
      need_whole_mesh("the values of '" + arrays_of_places_.front() + "', which follow the mesh");
    }
    if (run_.options.fixed_sets.empty()) {
      if (const std::string markers = unjudged_markers(files_, *ranks_); !markers.empty()) {
        need_whole_mesh("what " + markers + " marks");
      }
    }
    const auto has_thin_quads = [](const Piece& piece) {
      return find_thin_quads(piece.mesh, piece.document.points, {}).count > 0;
    };
    if (!holds_no_sets(run_.options.fixed_sets) && ranks_->any(std::ranges::any_of(files_.pieces, has_thin_quads))) {
      need_whole_mesh("quadrilaterals without thickness");
    }
  }

  void connect() override {
    run_.result.notes = read_notes_;
    run_.result.losses = read_losses_;
    mesh_ = join_pieces(files_, *ranks_);
    constraints_ = find_rank_constraints(files_, mesh_, run_.options, *ranks_);
    topology_.emplace(mesh_, constraints_.named, owners(), run_.options.input, ranks_, run_.workers);
    look_for_crossed_quads();
    topology_->connect(run_.options.input, run_.workers);
    if (has_repeated_triangles(*topology_, run_.workers)) {
      need_whole_mesh("triangles that are listed again");
    }
    regions_ = find_rank_regions(files_, *topology_, run_.options.region_arrays);
    held_ = topology_->held(regions_.of_triangle, run_.workers);
    std::ranges::move(settle_implied_sets(files_, mesh_, *topology_, held_),
                      std::back_inserter(run_.result.input.point_sets));
    points_ = points_of(files_, mesh_);
    enter_frame();
    reversed_ = topology_->reversed(local_.points, run_.workers);
    layers_ = mpi::hold_layers(topology_->overlap(), local_.points, reversed_, run_.options.smoothing.used_layers(),
                               false, held_, *ranks_, run_.workers);
    summarise();
    quality_.emplace(*topology_, reversed_, held_, regions_.of_triangle, regions_.count());
  }

  QualityOfMesh quality() override {
    QualityOfMesh quality{
        quality_->report(local_.points, local_.frame, run_.workers.count()), quality_->regions(local_.points), {}};
    QualityReport& report = quality.report;
    if (!run_.result.smoothing && run_.options.output && run_.options.smoothing.untangles() &&
        report.inverted + report.degenerate > 0) {
      need_whole_mesh("the untangling of inverted triangles");
    }
    report.degenerate += cells_.repeating.triangles;
    std::vector<std::int64_t> cells;
    for (const WorstElement& element : report.worst) {
      cells.push_back(number_of_triangle(files_, cells_.first, topology_->local_triangle(element.element)));
    }
    ranks_->sum(cells);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      report.worst[i].element = cells[i];
    }
    return quality;
  }

  PrecisionLoss precision_loss() override {
    return quality_->precision_loss(local_.points, local_.frame.exponent, run_.workers.count());
  }

  CoarseBoundary coarse_boundary() override {
    return find_coarse_boundary(*topology_, local_.points, reversed_, held_, run_.workers.count());
  }

  SmoothingResult smooth() override {
    points_ = points_of(files_, mesh_);
    SmoothingResult smoothing = smooth_points();
    stop_if_cancelled(smoothing);
    move_points(files_, points_);
    hash(smoothing);
    const LocalPoints before = std::exchange(local_, {});
    enter_frame();
    if (has_shrunk(before.frame, local_.frame)) {
      warn_of_shrinking(run_, before.frame, local_.frame);
      local_ = entered(before.frame, topology_->of_vertices<Point2<double>>(points_of(files_, mesh_)));
    }
    const Stopwatch watch;
    run_.result.size_change =
        quality_->size_change(before.points, before.frame, local_.points, local_.frame, run_.workers.count());
    note_growth_bound(before);
    run_.result.timings_ms.check_after += watch.milliseconds();
    return smoothing;
  }

  void write(const std::function<const PipelineResult&()>& completed) override {
    if (const std::vector<std::string> dropped = drop_annotations(files_); !dropped.empty()) {
      run_.note(note_of_dropped_annotations(dropped));
    }
    keep_fields();
    if (!run_.options.single) {
      run_.result.other_outputs = output_pieces(files_, *run_.options.output);
      write_pieces(files_, *run_.options.output, *ranks_, run_.workers, completed, run_.options.beside);
    } else {
      write_single(files_, run_.options, *ranks_, run_.workers, run_.result, completed);
    }
  }

  /// All stages by rank 0 in place of these, on the mesh of the one file, which is read (again), or else on that of the
  /// pieces, with what their readers have said. `reason`: of NeedsWholeMesh. `stages`: the run that has come so far.
  void run_as_whole(const std::string& reason, const StagedRun& stages) {
    // (What is no file on a disk can be read once.)
    const PipelineResult read = std::exchange(run_.result, {});
    const bool was_read = !read.input.path.empty();
    const bool reads_file = !names_parallel_file(run_.options.input) &&
                            !(was_read && ranks_->any(ranks_->rank() == 0 && !is_file(run_.options.input)));
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
      result.timings_ms.total = stages.milliseconds();
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
    PipelineOptions own = run_.options;
    if (run_.options.beside.prepare) {
      own.beside.prepare = [&](const PipelineResult& result) {
        run_.options.beside.prepare(with_what_was_read(result));
      };
    }
    run_.result = with_what_was_read(reads_file ? run_file_gathered(own, ranks_, run_.workers)
                                                : run_gathered(files_, own, ranks_, run_.workers));
  }

 private:
  /// (Where fields are to follow, the mesh is not smoothed in pieces.)
  void keep_fields() {
    const PipelineOptions& options = run_.options;
    const bool holds_them = !options.single || has_arrays(output_format(*options.output, std::nullopt, options.format));
    for (const PieceArray& array : files_.arrays) {
      if (holds_them && array.of == PieceArray::Of::points && !array.is_added &&
          stays_unasked(array.name, array.type, {options.fields, options.field_arrays, constraints_.fixed_array, {}})) {
        run_.result.kept_fields.push_back(array.name);
      }
    }
  }

  void require_output() const {
    agree(*ranks_, [&] {
      if (ranks_->rank() == 0 && run_.options.written()) {
        require_own_pieces(files_, *run_.options.written(), run_.options.single);
      }
    });
  }

  void read_one_file() {
    FileInPieces read = read_in_pieces(run_.options, reading_, *ranks_, run_.workers);
    files_ = std::move(read.files);
    run_.result.input = std::move(read.input);
    read_notes_ = std::move(read.notes);
    read_losses_ = std::move(read.losses);
    arrays_of_places_ = std::move(read.arrays_of_places);
    require_output();
  }

  void read_mesh_in_pieces() {
    files_ = read_pieces(run_.options.input, run_.options.quads, *ranks_, run_.workers);
    require_output();
    run_.result.input.path = run_.options.input;
    run_.result.input.format = files_.file.piece_format;
    std::set<std::string> notes;
    std::set<std::string> losses;
    std::set<std::string> of_places;
    for (const Piece& piece : files_.pieces) {
      notes.insert(piece.document.notes.begin(), piece.document.notes.end());
      losses.insert(piece.document.losses.begin(), piece.document.losses.end());
      if (run_.options.single && run_.options.output) {
        const FileFormat target = output_format(*run_.options.output, std::nullopt, run_.options.format);
        const std::vector<std::string> names = written_place_arrays(piece.document, target);
        of_places.insert(names.begin(), names.end());
      }
    }
    arrays_of_places_ = texts_of_all(of_places, *ranks_);
    // What is said of pieces is said of what one file loses.
    if (run_.options.single) {
      losses.merge(notes);
    }
    read_notes_ = run_.options.single ? std::vector<std::string>{} : texts_of_all(notes, *ranks_);
    read_losses_ = texts_of_all(losses, *ranks_);
    number_vertices(files_, *ranks_);
    check_shared_vertices(files_, *ranks_);
  }

  /// Of the rank's vertices; empty: the lowest rank that has each. Where fewer ranks have read than there are, others
  /// get work all the same.
  std::vector<std::int32_t> owners() {
    const bool has_enough = std::ssize(files_.file.pieces) >= ranks_->size();
    const Partition partition = run_.options.partition.value_or(has_enough ? Partition::keep : Partition::bisect);
    return partition == Partition::keep
               ? std::vector<std::int32_t>{}
               : find_owners(partition, {points_of(files_, mesh_), mesh_.elements, mesh_.ghost_triangles}, *ranks_);
  }

  /// Rank 0 decides which quadrilaterals are held since their corners are not in turn. With them nothing is oriented.
  void look_for_crossed_quads() const {
    const mpi::Overlap& overlap = topology_->overlap();
    if (overlap.elements().are_triangles()) {
      return;  // on all ranks
    }
    const auto points = topology_->of_vertices<Point2<double>>(points_of(files_, mesh_));
    if (ranks_->any(may_have_crossed_quads(points, overlap.elements(), overlap.part.ghosts))) {
      need_whole_mesh("quadrilaterals whose corners are not listed in turn");
    }
  }

  /// The points of the overlap in their local frame, from those of the rank's vertices, which are given up.
  void enter_frame() {
    const std::vector<Point2<double>> points = topology_->of_vertices<Point2<double>>(points_);
    release(points_);
    local_ = entered(topology_->frame_of(points, held_), points);
  }

  std::int64_t count_quadrilaterals() const {
    std::int64_t own = 0;
    for (std::size_t e = 0; e < mesh_.elements.size(); ++e) {
      own += mesh_.elements[e].size() == 4 && !mesh_.is_ghost(e) ? 1 : 0;
    }
    return ranks_->sum(own);
  }

  void summarise() {
    PipelineResult& result = run_.result;
    const mpi::Overlap& overlap = topology_->overlap();
    cells_ = count_rank_cells(files_, *ranks_);
    agree(*ranks_, [&] {
      require_elements(topology_->triangle_count(), cells_.cells, run_.options.input,
                       {.held_quads = cells_.held_quads});
    });
    ReasonCounts reasons{};
    std::int64_t vertices = 0;
    for (std::int32_t v = 0; v < overlap.vertex_count(); ++v) {
      if (overlap.is_own(v)) {
        ++vertices;
        ++reasons[held_[static_cast<std::size_t>(v)]];
      }
    }
    ranks_->sum(reasons);
    if (cells_.cells == 0) {
      run_.note(names_parallel_file(run_.options.input) ? "the pieces hold no cells: nothing to smooth"
                                                        : "the file holds no cells: nothing to smooth");
    }
    std::ranges::move(
        notes_of_other_cells(cells_.others, cells_.lines, cells_.repeating,
                             overlap.elements().are_triangles() ? "triangle" : "triangle and quadrilateral"),
        std::back_inserter(result.notes));
    if (cells_.collapsed_quads > 0) {
      run_.note(note_of_collapsed_quads(cells_.collapsed_quads));
    }
    result.input.fixed_array = constraints_.fixed_array;
    result.input.fixed_array_vertices = topology_->count_vertices(constraints_.by_array);
    result.input.fixed_ids_vertices = constraints_.listed;
    for (const LabelledVertices& set : constraints_.sets) {
      result.input.point_sets.push_back({set.name, topology_->count_vertices(set.flags), false, true});
    }
    const RankComponents components = count_components(*topology_, reversed_);
    const MeshFacts facts{.vertices = ranks_->sum(vertices),
                          .elements = topology_->triangle_count(),
                          .quadrilaterals = count_quadrilaterals(),
                          .other_cells = cells_.others,
                          .lines = cells_.lines,
                          .components = components.count,
                          .reoriented_triangles = components.reoriented_triangles,
                          .reasons = reasons,
                          .layers = layers_,
                          .regions = regions_};
    if (are_apart(facts)) {
      need_whole_mesh("triangles that are all apart");
    }
    summarise_mesh(run_, facts);
  }

  SmoothingResult smooth_points() {
    const Stopwatch watch;
    SmoothingOptions options = mpi::agreed_options(run_.options.smoothing, Constraints{}, mpi::Gather::never, *ranks_);
    options.layers = Layers::smooth;  // they are held already
    mpi::OverlapSmoother smoother(ranks_, topology_->lend_overlap(std::move(regions_.of_triangle), held_), options,
                                  Sliding{}, mpi::Gather::never, mpi::OverlapSmoother::Owners::ranks);
    run_.result.timings_ms.topology += watch.milliseconds();
    SmoothingResult made = smoother.smooth(PointView(points_), mesh_.storage);
    topology_->take_back(smoother.take_overlap());
    return made;
  }

  void hash(const SmoothingResult& smoothing) {
    PipelineResult& result = run_.result;
    result.coordinates_hash = result.unguarded_hash = hash_over_ranks(mesh_.ids, places_of(files_, mesh_), *ranks_);
    if (smoothing.reverted_vertices > 0) {
      std::vector<std::array<double, 3>> places = places_of(files_, mesh_);
      for (const auto& [vertex, position] : smoothing.reverted) {
        auto& [x, y, z] = places[static_cast<std::size_t>(vertex)];
        move_point(x, y, {rounded_to(mesh_.storage, position.x), rounded_to(mesh_.storage, position.y)});
      }
      result.unguarded_hash = hash_over_ranks(mesh_.ids, std::move(places), *ranks_);
    }
  }

  MeshView view_of(const LocalPoints& points) const {
    return {points.points, topology_->overlap().elements(), reversed_, points.frame.exponent};
  }

  /// note_growth_bound() of the whole mesh. Each of the free corners is judged by the rank that owns it.
  void note_growth_bound(const LocalPoints& before) {
    const QualityReport& report = run_.result.before;
    if (!may_have_growth_note(run_.options.smoothing, report)) {
      return;
    }
    const mpi::AscendingIds& ids = topology_->overlap().triangle_ids;
    const MeshView now = view_of(local_);
    WorstFreeElement worst = worst_with_free_corner(now, held_, [this](std::size_t t) { return topology_->counts(t); });
    worst.element = worst.element < 0 ? worst.element : ids[static_cast<std::size_t>(worst.element)];
    for (const WorstFreeElement& other : ranks_->of_all(std::vector{worst})) {
      worst = std::tie(other.quotient, other.element) < std::tie(worst.quotient, worst.element) ? other : worst;
    }
    if (worst.element < 0) {
      return;
    }
    const std::int64_t cell =
        ranks_->sum(number_of_triangle(files_, cells_.first, topology_->local_triangle(worst.element)));
    std::size_t place = 0;
    for (auto id = ids.begin(); id != ids.end() && *id != worst.element; ++id) {
      ++place;
    }
    std::set<std::string> said;  // by the corners, in their order
    const auto corners = place < ids.size() ? now.elements[place] : std::span<const std::int32_t>();
    for (std::size_t corner = 0; corner < corners.size(); ++corner) {
      const std::int32_t v = corners[corner];
      if (topology_->overlap().is_own(v) && held_[static_cast<std::size_t>(v)] == 0) {
        const std::string note = growth_note(view_of(before), now, v, report, worst.quotient, cell,
                                             topology_->overlap().ids[static_cast<std::size_t>(v)]);
        if (!note.empty()) {
          said.insert(std::to_string(corner) + note);
        }
      }
    }
    if (const std::vector<std::string> all = texts_of_all(said, *ranks_); !all.empty()) {
      run_.note(all.front().substr(1));
    }
  }

  RunContext run_;
  FileReading reading_;
  std::shared_ptr<const mpi::Communicator> ranks_;
  PieceFiles files_;
  std::vector<std::string> read_notes_;        ///< of the readers of all pieces
  std::vector<std::string> read_losses_;       ///< what these say is lost
  std::vector<std::string> arrays_of_places_;  ///< point arrays of the file whose values follow the mesh by default
  RankMesh mesh_;
  RankConstraints constraints_;
  std::optional<RankTopology> topology_;
  Regions regions_;
  RankCells cells_;
  std::vector<std::uint8_t> held_;
  LayersResult layers_;
  std::vector<std::uint8_t> reversed_;
  LocalPoints local_;  ///< vertices of the overlap, as they are now
  std::optional<RankQuality> quality_;
  std::vector<Point2<double>> points_;  ///< of the rank's vertices, on their way from and to its files
};

PipelineResult run_in_pieces(const PipelineOptions& asked, FileReading reading,
                             const std::shared_ptr<const mpi::Communicator>& ranks) {
  PipelineOptions options = asked;
  options.smoothing.threads = Workers(ranks->threads(options.smoothing.threads)).count();
  PieceMesh mesh(options, reading, ranks);
  StagedRun stages(mesh);
  agree(*ranks, [&] { require_piece_options(options); });
  try {
    const std::string_view reason = names_parallel_file(options.input) ? ""
                                    : ranks->size() == 1               ? is_alone
                                                                       : what_needs_whole_mesh(options);
    if (!reason.empty()) {
      stages.begin(Stage::read);
      need_whole_mesh(std::string(reason));
    }
    stages.read();
    stages.check_and_smooth();
    stages.write();
  } catch (const NeedsWholeMesh& needs) {
    mesh.run_as_whole(needs.reason, stages);
    stages.complete();
  }
  return std::move(mesh.context().result);
}

}  // namespace

PipelineResult run_pieces(const PipelineOptions& options, const std::shared_ptr<const mpi::Communicator>& ranks) {
  return run_in_pieces(options, FileReading::any, ranks);
}

PipelineResult run_by_ranges(const PipelineOptions& options, const std::shared_ptr<const mpi::Communicator>& ranks) {
  return run_in_pieces(options, FileReading::by_ranges, ranks);
}

}  // namespace trismooth
