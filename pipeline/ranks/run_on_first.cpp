// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/run_on_first.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <mpi.h>

#include "trismooth/base/element_list.h"
#include "trismooth/base/hold.h"
#include "trismooth/base/index_view.h"
#include "trismooth/base/machine/call_limit.h"
#include "trismooth/mpi/overlap_smoother.h"
#include "trismooth/pipeline/ranks/agreement.h"
#include "trismooth/pipeline/ranks/partition/vertex_owners.h"
#include "trismooth/quality/element.h"
#include "trismooth/smoothing/backend.h"
#include "trismooth/smoothing/backend_choice.h"
#include "trismooth/smoothing/cpu_backend.h"
#include "trismooth/smoothing/noted_smoother.h"

namespace trismooth {

namespace {

/// What rank 0 wants of the others. Of options the pipeline changes no more than these.
struct RankCommand {
  enum class What : std::uint8_t { end, smooth };

  What what = What::end;
  Storage storage = Storage::float64;
  bool guard = true;
};

void share_command(RankCommand& command, const mpi::Communicator& ranks) {
  MPI_Bcast(&command, sizeof(command), MPI_BYTE, 0, ranks.handle());
}

/// How the vertices are shared out: as the ranks that have them do not, all being rank 0's, somebody has to say it.
std::vector<std::int32_t> owners_of_one_file(std::span<const Point2<double>> points, const ElementList& elements,
                                             Partition partition, const mpi::Communicator& ranks) {
  if (partition != Partition::keep) {
    return find_owners(partition, {points, elements, {}}, ranks);
  }
  std::vector<std::int32_t> owners(points.size());
  for (std::size_t v = 0; v < owners.size(); ++v) {
    owners[v] = static_cast<std::int32_t>(v * static_cast<std::size_t>(ranks.size()) / owners.size());
  }
  return owners;
}

/// The mesh of rank 0, nothing on the others.
struct MeshOfFirst {
  ElementList elements;
  std::span<const std::uint8_t> fixed;  ///< bits of namespace hold
};

/// Throws what all ranks throw. What happens on one alone ends them all: they are where they cannot be told.
SmoothingResult smooth_over_ranks(const MeshOfFirst& mesh, std::span<Point2<double>> points, Storage storage,
                                  const SmoothingOptions& options, Partition partition,
                                  const std::shared_ptr<const mpi::Communicator>& ranks) {
  return ranks->together([&] {
    std::vector<std::int64_t> ids(points.size());
    std::iota(ids.begin(), ids.end(), std::int64_t{0});
    std::vector<std::uint8_t> named(points.size(), 0);
    std::vector<std::uint8_t> in_other_cell(points.size(), 0);
    for (std::size_t v = 0; v < mesh.fixed.size(); ++v) {
      // Why else they are held the plan finds itself; who says so does not matter.
      named[v] = (mesh.fixed[v] & ~hold::isolated) != 0 ? 1 : 0;
      in_other_cell[v] = mesh.fixed[v] & hold::other_cell;
    }
    const std::vector<std::int32_t> owners = owners_of_one_file(points, mesh.elements, partition, *ranks);
    const mpi::LocalMesh local{IndexView(mesh.elements), ids, owners};
    const Constraints constraints{.fixed = named, .other_cells = in_other_cell};
    SmoothingOptions without_layers = options;
    without_layers.layers = Layers::smooth;  // they are held already
    return mpi::make_overlap_smoother(ranks, local, constraints, without_layers, mpi::Gather::never,
                                      mpi::OverlapSmoother::Owners::ranks)
        ->smooth(PointView(points), storage);
  });
}

/// Of rank 0: has the others take part.
class RankSmoother final : public PreparedSmoother {
 public:
  /// `options`: with the backend that makes the sweeps of a rank.
  RankSmoother(MeshRings mesh, const ElementList& elements, SmoothingOptions options, Partition partition,
               std::shared_ptr<const mpi::Communicator> ranks)
      : fixed_(std::move(mesh.fixed)),
        elements_(elements),
        options_(std::move(options)),
        partition_(partition),
        ranks_(std::move(ranks)) {}

  SmoothingResult smooth(std::span<Point2<double>> points, Storage storage,
                         const std::optional<LocalFrame>& /*frame*/) override {
    CallLimit::lift_current();  // the other ranks would wait for ever
    RankCommand command{RankCommand::What::smooth, storage, options_.guard};
    share_command(command, *ranks_);
    return smooth_over_ranks({elements_.list(), fixed_}, points, storage, options_, partition_, ranks_);
  }

  std::vector<std::uint8_t> fixed() const override { return fixed_; }

 private:
  std::vector<std::uint8_t> fixed_;
  OwnElements elements_;
  SmoothingOptions options_;
  Partition partition_;
  std::shared_ptr<const mpi::Communicator> ranks_;
};

bool has_broken_elements(const ElementList& elements, std::span<const std::uint8_t> reversed,
                         std::span<const Point2<double>> local) {
  return elements.visit([&](const auto& listed) {
    for (std::size_t e = 0; e < listed.size(); ++e) {
      if (!(quotient_at(canonical_corners(listed[e], reversed[e] != 0), local) > 0)) {
        return true;
      }
    }
    return false;
  });
}

/// All ranks, for rank 0 that has the mesh.
class RankBackend final : public Backend {
 public:
  /// `of_rank`: who makes the sweeps of a rank; null: its CPU.
  RankBackend(const Backend* of_rank, Partition partition, std::shared_ptr<const mpi::Communicator> ranks)
      : of_rank_(of_rank), partition_(partition), ranks_(std::move(ranks)) {}

  std::string name() const override { return backend_of_rank().name(); }

  std::unique_ptr<PreparedSmoother> prepare(MeshRings mesh, const ElementList& elements,
                                            std::span<const Point2<double>> local,
                                            const SmoothingOptions& options) const override {
    if (!elements.are_triangles() && !backend_of_rank().takes_quadrilaterals_in_parts()) {
      return alone(std::move(mesh), elements, local, options,
                   "quadrilaterals are smoothed, which backend '" + name() + "' does not over ranks,");
    }
    const bool slides = mesh.slidable.is_wanted();
    if (slides || (options.untangles() && has_broken_elements(elements, mesh.reversed, local))) {
      return alone(std::move(mesh), elements, local, options,
                   slides ? "vertices slide" : "inverted elements are untangled");
    }
    SmoothingOptions of_rank = options;
    of_rank.backend = of_rank_;
    return std::make_unique<RankSmoother>(std::move(mesh), elements, std::move(of_rank), partition_, ranks_);
  }

  bool takes_quadrilaterals() const override { return true; }

 private:
  const Backend& backend_of_rank() const { return of_rank_ != nullptr ? *of_rank_ : cpu_backend(); }

  std::unique_ptr<PreparedSmoother> alone(MeshRings mesh, const ElementList& elements,
                                          std::span<const Point2<double>> local, const SmoothingOptions& options,
                                          const std::string& why) const {
    return std::make_unique<NotedSmoother>(
        cpu_backend().prepare(std::move(mesh), elements, local, options),
        why + " by one rank alone, not by the " + std::to_string(ranks_->size()) + " there are");
  }

  const Backend* of_rank_;
  Partition partition_;
  std::shared_ptr<const mpi::Communicator> ranks_;
};

/// The other ranks: take part as often as rank 0 asks them to.
void follow(const SmoothingOptions& options, Partition partition,
            const std::shared_ptr<const mpi::Communicator>& ranks) {
  RankCommand command;
  for (share_command(command, *ranks); command.what == RankCommand::What::smooth; share_command(command, *ranks)) {
    SmoothingOptions own = options;
    own.guard = command.guard;
    own.progress = {};
    own.cancel = {};
    try {
      (void)smooth_over_ranks({}, {}, command.storage, own, partition, ranks);
    } catch (const std::exception&) {
      // All ranks have got it, and rank 0 tells it.
      continue;
    }
  }
}

/// Lets the other ranks go, whatever becomes of rank 0's run.
class RanksRelease {
 public:
  explicit RanksRelease(const mpi::Communicator& ranks) : ranks_(ranks) {}
  RanksRelease(const RanksRelease&) = delete;
  RanksRelease& operator=(const RanksRelease&) = delete;
  ~RanksRelease() {
    RankCommand command;
    share_command(command, ranks_);
  }

 private:
  const mpi::Communicator& ranks_;
};

}  // namespace

PipelineResult run_on_first(const PipelineOptions& options, const std::shared_ptr<const mpi::Communicator>& ranks,
                            const std::function<PipelineResult(const PipelineOptions&)>& run) {
  if (ranks->size() == 1) {
    return run(options);
  }
  const Partition partition = options.partition.value_or(Partition::bisect);
  PipelineResult result;
  std::exception_ptr error;  // of rank 0, between the sweeps: the others listen then
  if (ranks->rank() > 0) {
    follow(options.smoothing, partition, ranks);
  } else {
    const RanksRelease release(*ranks);
    try {
      const RankBackend backend(options.smoothing.backend, partition, ranks);
      PipelineOptions own = options;
      own.smoothing.backend = &backend;
      result = run(own);
    } catch (...) {
      error = std::current_exception();
    }
  }
  agree(*ranks, [&] {
    if (error) {
      std::rethrow_exception(error);
    }
  });
  return result;
}

}  // namespace trismooth
