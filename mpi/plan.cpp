// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mpi/plan.h"

#include <memory>
#include <utility>

#include "trismooth/base/moved_from.h"
#include "trismooth/mpi/communicator.h"
#include "trismooth/mpi/overlap_smoother.h"

namespace trismooth::mpi {

class Plan::Implementation {
 public:
  explicit Implementation(std::unique_ptr<OverlapSmoother> of_overlap) : smoother(std::move(of_overlap)) {}

  std::unique_ptr<OverlapSmoother> smoother;
};

Plan::Plan(MPI_Comm communicator, const LocalMesh& mesh, const Constraints& constraints,
           const SmoothingOptions& options, Gather gather) {
  const std::shared_ptr<const Communicator> ranks = joined_ranks(communicator);
  implementation_ = ranks->together([&] {
    return std::make_unique<Implementation>(
        make_overlap_smoother(ranks, mesh, constraints, options, gather, OverlapSmoother::Owners::ranks));
  });
}

Plan::Plan(MPI_Comm communicator, const LocalMesh& mesh, const SmoothingOptions& options, Gather gather)
    : Plan(communicator, mesh, Constraints{}, options, gather) {}

Plan::Plan(Plan&&) noexcept = default;
Plan& Plan::operator=(Plan&&) noexcept = default;
Plan::~Plan() = default;

SmoothingResult Plan::smooth(const PointView& points, Storage storage) {
  OverlapSmoother& smoother = *not_moved_from(implementation_).smoother;
  return smoother.communicator().together([&] { return smoother.smooth(points, storage); });
}

Traffic Plan::traffic() const {
  return not_moved_from(implementation_).smoother->traffic();
}
std::int64_t Plan::own_vertices() const {
  return not_moved_from(implementation_).smoother->own_vertices();
}
std::int64_t Plan::ghost_vertices() const {
  return not_moved_from(implementation_).smoother->ghost_vertices();
}

}  // namespace trismooth::mpi
