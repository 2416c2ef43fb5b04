#include "trismooth/mpi/plan.h"

#include <algorithm>
#include <exception>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/base/bulk_memory.h"
#include "trismooth/base/hold.h"
#include "trismooth/base/local_points.h"
#include "trismooth/base/release.h"
#include "trismooth/base/workers.h"
#include "trismooth/mpi/communicator.h"
#include "trismooth/mpi/component_labels.h"
#include "trismooth/mpi/ghost_values.h"
#include "trismooth/mpi/links.h"
#include "trismooth/mpi/overlap.h"
#include "trismooth/mpi/plan_points.h"
#include "trismooth/mpi/same_options.h"
#include "trismooth/mpi/shared_frame.h"
#include "trismooth/mpi/shared_result.h"
#include "trismooth/smoothing/backend.h"
#include "trismooth/smoothing/backend_choice.h"
#include "trismooth/smoothing/errors.h"
#include "trismooth/smoothing/rings/colouring.h"
#include "trismooth/smoothing/rings/fixed_vertices.h"
#include "trismooth/smoothing/rings/one_rings.h"
#include "trismooth/smoothing/rings/slidable.h"

namespace trismooth::mpi {

namespace {

void require_supported(const SmoothingOptions& options, const Constraints& constraints, Gather gather) {
  options.validate();
  if (constraints.slide.along != Slide::off && gather == Gather::never) {
    throw std::invalid_argument(
        "vertices do not slide in a mesh in pieces: have it gathered on one rank (Gather::where_needed), or set slide "
        "to off");
  }
  if (options.order == Order::unordered || options.execution != Execution::resident) {
    throw std::invalid_argument(
        "executions and orders of the paper's CUDA versions are not there for a mesh in pieces");
  }
}

/// What SmoothingPlan says of a component's triangles in the numbers of this rank's overlap says nothing to the caller.
TriangleTopology connected(const Overlap& overlap, Workers& workers) {
  try {
    return connect_triangles(overlap.vertex_count(), overlap.triangles, workers, overlap.part.ghosts);
  } catch (const MeshError&) {
    throw MeshError(
        "triangles that are connected with each other cannot be oriented consistently (a one-sided surface)");
  }
}

}  // namespace

class Plan::Implementation {
 public:
  Implementation(std::shared_ptr<const Communicator> communicator, const LocalMesh& mesh,
                 const Constraints& constraints, const SmoothingOptions& options, Gather gather, bool is_gathered)
      : communicator_(std::move(communicator)),
        options_(options),
        gather_(gather),
        is_gathered_(is_gathered || constraints.slide.along != Slide::off) {
    const Communicator& ranks = *communicator_;
    std::vector<Triangle> converted;
    std::span<const Triangle> triangles;
    ranks.on_all([&] {
      require_supported(options, constraints, gather);
      backend_of(options).require_ready();
      options_.threads = ranks.threads(options.threads);
      workers_.emplace(options_.threads);
      triangles = mesh.triangles.triangles(std::ssize(mesh.vertex_ids), converted);
    });
    require_same_options(options, constraints.slide, gather != Gather::never, ranks);
    has_lengths_ = ranks.any(options.method == Method::mean_ratio && !options.mean_ratio.target_lengths.empty());
    overlap_ = build_overlap(mesh, triangles, constraints, is_gathered_, communicator_, *workers_);
    release(converted);
    if (has_lengths_) {
      // Never empty: that would say that no sizes are asked for.
      lengths_.assign(std::max<std::size_t>(overlap_.ids.size(), 1), 1.0);
    }
    MeshPart& part = overlap_.part;
    part.is_whole = is_gathered_;
    part.number = ranks.rank();
    part.count = ranks.size();
    part.place_on_machine = ranks.place_on_machine();
    part.has_progress = ranks.any(static_cast<bool>(options.progress));
    ghosts_.emplace(part);
    points_.emplace(overlap_, *ghosts_, ranks, *workers_);
    ranks.on_all([&] {
      topology_ = connected(overlap_, *workers_);
      fixed_ = fixed_vertices(*topology_, overlap_.triangles, {.regions = overlap_.regions}, *workers_);
      for (std::size_t v = 0; v < fixed_.size(); ++v) {
        fixed_[v] |= overlap_.named[v];
      }
      if (is_gathered_) {
        Sliding slide = constraints.slide;
        slide.lines = overlap_.lines;
        slide.line_tags = overlap_.line_tags;
        slide.links = overlap_.links;
        slidable_ = find_slidable(overlap_.triangles, fixed_, {.regions = overlap_.regions, .slide = slide}, *workers_);
      }
    });
    ghosts_->update(std::span(fixed_));
    labels_ = ComponentLabels(overlap_, components(), ranks);
    release(overlap_.owners);
    std::int64_t own_free = 0;
    for (std::int32_t v = 0; v < overlap_.vertex_count(); ++v) {
      own_free += overlap_.is_own(v) && fixed_[static_cast<std::size_t>(v)] == 0 ? 1 : 0;
    }
    part.free_vertices = ranks.sum(own_free);
    ranks.on_all([&] {
      if (options.method == Method::mean_ratio && part.free_vertices > std::numeric_limits<std::uint32_t>::max()) {
        throw std::invalid_argument("the mean-ratio method adds up areas of 2^32 - 1 free vertices at most");
      }
    });
  }

  SmoothingResult smooth(const PointView& points, Storage storage) {
    const Storage stored = points_->storage_of(points, storage);
    BulkVector<Point2<double>> mine = points_->gathered(points);
    points_->require_one_height(points, mine, fixed_);
    if (has_lengths_) {
      // In place: the smoother knows them by where they are.
      std::ranges::copy(points_->target_lengths(options_.mean_ratio.target_lengths, fixed_, options_.aims_at_sizes()),
                        lengths_.begin());
    }
    const LocalFrame frame = shared_frame(mine, fixed_, *communicator_);
    make_ready(frame, mine);
    SmoothingResult result = smoothed(mine, stored, frame);
    if (result.reverted_vertices > 0) {
      result.reverted = overlap_.callers.named(result.reverted, *communicator_);
    }
    points_->hand_back(mine, points);
    return result;
  }

  const Communicator& communicator() const { return *communicator_; }
  Traffic traffic() const { return static_cast<const Links&>(*overlap_.part.links).traffic(); }
  std::int64_t own_vertices() const { return std::ranges::count(overlap_.part.ghosts, 0); }
  std::int64_t ghost_vertices() const { return std::ssize(overlap_.ids) - own_vertices(); }

 private:
  const TriangleComponents& components() const { return topology_ ? *topology_ : components_; }

  /// Prepares the sweeps where the orientation that these points give the mesh is new.
  void make_ready(const LocalFrame& frame, std::span<const Point2<double>> mine) {
    const BulkVector<Point2<double>> local = entered(frame, mine).points;
    std::vector<std::uint8_t> reversed = labels_.reversed(overlap_, components(), local, *communicator_, *workers_);
    if (!communicator_->any(!is_ready_ || reversed != reversed_)) {
      return;
    }
    is_ready_ = false;
    smoother_.reset();
    reversed_ = std::move(reversed);
    MeshRings mesh;
    communicator_->on_all([&] {
      std::vector<std::uint8_t> without_ring = fixed_;
      for (std::size_t v = 0; v < without_ring.size(); ++v) {
        without_ring[v] |= overlap_.part.ghosts[v];
      }
      if (!topology_) {
        topology_ = connected(overlap_, *workers_);
      }
      mesh.rings = one_rings(*topology_, overlap_.triangles, reversed_, without_ring, *workers_);
      // It is found again should a component be listed the other way round: that is rare, and it takes as much memory
      // as the rings do.
      components_ = std::move(static_cast<TriangleComponents&>(*topology_));
      topology_.reset();
    });
    if (!std::exchange(is_coloured_, true)) {
      colour(mesh.rings);
    }
    mesh.slidable = slidable_;
    mesh.fixed = fixed_;
    mesh.reversed = reversed_;
    mesh.part = std::shared_ptr<const MeshPart>(std::shared_ptr<void>(), &overlap_.part);
    const auto prepare = [&] {
      smoother_ = backend_of(options_).prepare(std::move(mesh), overlap_.triangles, local, used_options());
    };
    if (is_gathered_) {
      communicator_->on_all([&] {
        if (communicator_->rank() == 0) {
          prepare();
        }
      });
    } else {
      prepare();
    }
    is_ready_ = true;
  }

  /// Colours the free vertices as colour_free_vertices() does it in the whole mesh.
  void colour(const OneRings& rings) {
    MeshPart& part = overlap_.part;
    part.colours.assign(overlap_.ids.size(), no_colour);
    std::vector<std::uint8_t> is_free(fixed_.size());
    BulkVector<std::int32_t> waiting;
    for (std::int32_t v = 0; v < overlap_.vertex_count(); ++v) {
      is_free[static_cast<std::size_t>(v)] = fixed_[static_cast<std::size_t>(v)] == 0 ? 1 : 0;
      if (is_free[static_cast<std::size_t>(v)] != 0 && overlap_.is_own(v)) {
        waiting.push_back(v);
      }
    }
    while (communicator_->any(!waiting.empty())) {
      colour_ready(rings.view(), overlap_.ids, is_free, part.colours, waiting, *workers_);
      ghosts_->update(std::span(part.colours));
    }
    PartSums highest;
    highest.largest[0] = part.colours.empty() ? -1 : *std::ranges::max_element(part.colours);
    part.colour_count = static_cast<std::int32_t>(communicator_->joined(highest).largest[0]) + 1;
  }

  /// The caller's options for the rank's own numbers; an exception of a progress callback stops all ranks.
  SmoothingOptions used_options() {
    SmoothingOptions used = options_;
    used.mean_ratio.target_lengths = lengths_;
    if (options_.progress) {
      used.progress = [this](const SweepRecord& record) {
        try {
          return options_.progress(record);
        } catch (...) {
          callback_error_ = std::current_exception();
          return Progress::stop;
        }
      };
    }
    return used;
  }

  SmoothingResult smoothed(std::span<Point2<double>> mine, Storage stored, const LocalFrame& frame) {
    SmoothingResult result;
    try {
      result = is_gathered_ ? smoothed_here(mine, stored, frame) : smoother_->smooth(mine, stored, frame);
      result.reverted_vertices = communicator_->sum(result.reverted_vertices);
    } catch (const PartsError&) {
      // All ranks are here.
      communicator_->on_all([&] {
        if (gather_ == Gather::never) {
          throw std::invalid_argument(
              "the mesh has inverted triangles, which are not untangled in a mesh in pieces: have it gathered on one "
              "rank (Gather::where_needed), or set untangle to off");
        }
      });
      result = smoothed_gathered(mine, stored);
    }
    communicator_->on_all([&] {
      if (callback_error_) {
        std::rethrow_exception(std::exchange(callback_error_, nullptr));
      }
    });
    return result;
  }

  /// By rank 0, which has all.
  SmoothingResult smoothed_here(std::span<Point2<double>> mine, Storage stored, const LocalFrame& frame) {
    SmoothingResult result;
    communicator_->on_all([&] {
      if (communicator_->rank() == 0) {
        result = smoother_->smooth(mine, stored, frame);
      }
    });
    share_result(result, *communicator_);
    return result;
  }

  /// The same where that was not known before.
  SmoothingResult smoothed_gathered(std::span<Point2<double>> mine, Storage stored) {
    if (gathered_ == nullptr) {
      std::vector<std::uint8_t> is_copy(overlap_.triangles.size());
      for (std::size_t t = 0; t < is_copy.size(); ++t) {
        const auto& [a, b, c] = overlap_.triangles[t];
        is_copy[t] = overlap_.is_own(std::min({a, b, c})) ? 0 : 1;
      }
      std::vector<std::uint8_t> named(overlap_.named.size());
      std::vector<std::uint8_t> in_other_cell(overlap_.named.size());
      for (std::size_t v = 0; v < named.size(); ++v) {
        named[v] = overlap_.named[v] & hold::named;
        in_other_cell[v] = overlap_.named[v] & hold::other_cell;
      }
      const std::vector<std::int64_t> triangle_ids = overlap_.triangle_ids.listed();
      const LocalMesh mesh{overlap_.triangles, overlap_.ids, {}, is_copy, triangle_ids};
      SmoothingOptions options = used_options();
      options.mean_ratio.target_lengths = std::span(lengths_).first(has_lengths_ ? overlap_.ids.size() : 0);
      constexpr bool is_gathered = true;
      gathered_ = std::make_unique<Implementation>(
          communicator_, mesh, Constraints{.fixed = named, .other_cells = in_other_cell, .regions = overlap_.regions},
          options, gather_, is_gathered);
    }
    return gathered_->smooth(PointView(mine), stored);
  }

  std::shared_ptr<const Communicator> communicator_;
  SmoothingOptions options_;
  Gather gather_;
  bool is_gathered_;  ///< rank 0 owns all vertices
  std::optional<Workers> workers_;
  bool has_lengths_ = false;  ///< some rank has target lengths
  Overlap overlap_;
  std::optional<GhostValues> ghosts_;
  std::optional<PlanPoints> points_;
  std::optional<TriangleTopology> topology_;  ///< of the overlap, until rings are made of it
  TriangleComponents components_;             ///< what is left of it then
  std::vector<std::uint8_t> fixed_;           ///< as MeshRings::fixed, ghosts as their owners have it
  Slidable slidable_;                         ///< where it is gathered
  ComponentLabels labels_;
  bool is_coloured_ = false;
  bool is_ready_ = false;  ///< for sweeps with `reversed_`
  std::vector<std::uint8_t> reversed_;
  std::vector<double> lengths_;  ///< that are asked for, of the overlap; empty: none
  std::unique_ptr<PreparedSmoother> smoother_;
  std::exception_ptr callback_error_;
  std::unique_ptr<Implementation> gathered_;  ///< of what cannot be done in pieces, where it was needed
};

Plan::Plan(MPI_Comm communicator, const LocalMesh& mesh, const Constraints& constraints,
           const SmoothingOptions& options, Gather gather) {
  const auto ranks = std::make_shared<const Communicator>(communicator);
  implementation_ = ranks->together(
      [&] { return std::make_unique<Implementation>(ranks, mesh, constraints, options, gather, false); });
}

Plan::Plan(MPI_Comm communicator, const LocalMesh& mesh, const SmoothingOptions& options, Gather gather)
    : Plan(communicator, mesh, Constraints{}, options, gather) {}

Plan::Plan(Plan&&) noexcept = default;
Plan& Plan::operator=(Plan&&) noexcept = default;
Plan::~Plan() = default;

SmoothingResult Plan::smooth(const PointView& points, Storage storage) {
  return implementation().communicator().together([&] { return implementation_->smooth(points, storage); });
}

const Plan::Implementation& Plan::implementation() const {
  if (implementation_ == nullptr) {
    throw std::logic_error("this plan has been moved from");
  }
  return *implementation_;
}

Traffic Plan::traffic() const {
  return implementation().traffic();
}
std::int64_t Plan::own_vertices() const {
  return implementation().own_vertices();
}
std::int64_t Plan::ghost_vertices() const {
  return implementation().ghost_vertices();
}

}  // namespace trismooth::mpi
