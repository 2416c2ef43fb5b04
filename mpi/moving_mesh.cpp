// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mpi/moving_mesh.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "trismooth/base/hold.h"
#include "trismooth/base/moved_from.h"
#include "trismooth/mpi/communicator.h"
#include "trismooth/mpi/ghost_values.h"
#include "trismooth/mpi/overlap.h"
#include "trismooth/mpi/overlap_smoother.h"
#include "trismooth/mpi/plan_points.h"
#include "trismooth/mpi/same_options.h"
#include "trismooth/mpi/shared_result.h"
#include "trismooth/smoothing/moving/mesh_at_rest.h"

namespace trismooth::mpi {

namespace {

/// `ids`: what `what` calls them. Throws std::invalid_argument where one is no number of a mesh on one rank.
void require_numbers(const ArrayView<std::int64_t>& ids, const char* what) {
  constexpr std::int64_t last = std::numeric_limits<std::int32_t>::max() - 1;
  for (const std::int64_t id : ids) {
    if (id > last) {
      throw std::invalid_argument(std::string(what) + ": the whole of a mesh that moves is on rank 0, with ids up to " +
                                  std::to_string(last) + "; " + std::to_string(id) + " is above that");
    }
  }
}

/// What all ranks have is rank 0's overlap.
Overlap gathered_on_first(const std::shared_ptr<const Communicator>& ranks, const LocalMesh& mesh,
                          const Constraints& constraints, int threads) {
  ranks->on_all([&] {
    require_numbers(mesh.vertex_ids, "vertex_ids");
    require_numbers(mesh.triangle_ids, "triangle_ids");
  });
  constexpr bool is_gathered = true;
  return build_overlap(mesh, constraints, is_gathered, ranks, threads);
}

}  // namespace

class MovingMesh::Implementation {
 public:
  Implementation(std::shared_ptr<const Communicator> ranks, const ConstPointView& reference, const LocalMesh& mesh,
                 const Constraints& constraints, const SmoothingOptions& options)
      : ranks_(std::move(ranks)), overlap_(gathered_on_first(ranks_, mesh, constraints, options.threads)) {
    ranks_->on_all([&] { workers_.emplace(options.threads); });
    ghosts_.emplace(overlap_.part);
    points_.emplace(overlap_, *ghosts_, *ranks_, *workers_);
    const BulkVector<Point2<double>> all = points_->gathered(reference);
    held_alone_.resize(overlap_.ids.size());
    std::vector<std::uint8_t> held(overlap_.ids.size());
    on_first([&] {
      numbers_.assign(overlap_.ids.begin(), overlap_.ids.end());
      make(all, options);
      const std::vector<std::uint8_t> of_all = moving_->held();
      for (std::size_t v = 0; v < held.size(); ++v) {
        held[v] = of_all[number(v)];
        held_alone_[v] = held[v] == 0 ? hold::isolated : held[v];
      }
    });
    held_.resize(overlap_.callers.local_count());
    overlap_.callers.hand_back<std::uint8_t>(held, held_, *ranks_, *workers_);
  }

  const Communicator& ranks() const { return *ranks_; }
  const std::vector<std::uint8_t>& held() const { return held_; }

  std::vector<Point2<double>> points() {
    BulkVector<Point2<double>> all(overlap_.ids.size());
    on_first([&] { take(moving_->points(), all); });
    std::vector<Point2<double>> local(overlap_.callers.local_count());
    points_->hand_back(all, local);
    return local;
  }

  void go_on_from(const ConstPointView& points) {
    const BulkVector<Point2<double>> all = points_->gathered(points);
    on_first([&] {
      const std::vector<Point2<double>> of_whole = whole(all);
      moving_->go_on_from(of_whole);
    });
  }

  void take_back() {
    on_first([&] { moving_->take_back(); });
  }

  FollowResult follow(const PointView& points, MovingStart start) {
    const std::vector<OptionValue> asked{{"start", static_cast<std::int64_t>(start)}};
    require_same(asked, *ranks_);
    const Storage stored = points_->storage_of(points, Storage::float64);
    BulkVector<Point2<double>> all = points_->gathered(points);
    points_->require_one_height(points, all, held_alone_);
    FollowResult result;
    on_first([&] {
      std::vector<Point2<double>> now = whole(all);
      result = moving_->follow(now, start, stored);
      take(now, all);
      for (std::int32_t& t : result.invalid) {
        t = static_cast<std::int32_t>(overlap_.triangle_ids[static_cast<std::size_t>(t)]);
      }
      for (RevertedVertex& reverted : result.smoothing.reverted) {
        reverted.vertex =
            static_cast<std::int32_t>(std::ranges::lower_bound(numbers_, reverted.vertex) - numbers_.begin());
      }
    });
    share_result(result, *ranks_);
    if (result.smoothing.reverted_vertices > 0) {
      result.smoothing.reverted = overlap_.callers.named(result.smoothing.reverted, *ranks_);
    }
    if (result.smoothing.inverted >= 0) {
      points_->hand_back(all, points);
    }
    return result;
  }

 private:
  /// Calls `work` on rank 0; what it throws is thrown on all.
  template <class Work>
  void on_first(const Work& work) {
    ranks_->on_all([&] {
      if (ranks_->rank() == 0) {
        work();
      }
    });
  }

  std::size_t number(std::size_t v) const { return static_cast<std::size_t>(numbers_[v]); }

  void make(std::span<const Point2<double>> all, const SmoothingOptions& options) {
    std::vector<std::int32_t> fixed;
    std::vector<std::uint8_t> other_cells(vertex_count());
    for (std::size_t v = 0; v < overlap_.named.size(); ++v) {
      if ((overlap_.named[v] & hold::named) != 0) {
        fixed.push_back(numbers_[v]);
      }
      other_cells[number(v)] = overlap_.named[v] & hold::other_cell;
    }
    const std::vector<Point2<double>> reference = whole(all);
    const Constraints constraints{.fixed_ids = fixed, .other_cells = other_cells, .regions = overlap_.regions};
    overlap_.elements().visit([&]<class Corners>(std::span<const Corners> listed) {
      std::vector<Corners> elements(listed.begin(), listed.end());
      for (auto& element : elements) {
        for (std::int32_t& corner : element) {
          corner = corner == no_corner ? no_corner : numbers_[static_cast<std::size_t>(corner)];
        }
      }
      moving_.emplace(reference, elements, constraints, options);
    });
  }

  std::size_t vertex_count() const { return numbers_.empty() ? 0 : number(numbers_.size() - 1) + 1; }

  /// Of every number up to the largest; ids that nobody has are of no triangle, and anywhere.
  std::vector<Point2<double>> whole(std::span<const Point2<double>> all) const {
    std::vector<Point2<double>> points(vertex_count());
    for (std::size_t v = 0; v < all.size(); ++v) {
      points[number(v)] = all[v];
    }
    return points;
  }

  void take(std::span<const Point2<double>> points, std::span<Point2<double>> all) const {
    for (std::size_t v = 0; v < all.size(); ++v) {
      all[v] = points[number(v)];
    }
  }

  std::shared_ptr<const Communicator> ranks_;
  Overlap overlap_;
  std::optional<Workers> workers_;
  std::optional<GhostValues> ghosts_;
  std::optional<PlanPoints> points_;
  std::vector<std::uint8_t> held_;        ///< of local vertices
  std::vector<std::uint8_t> held_alone_;  ///< of the overlap: free vertices are as if nothing used them
  // On rank 0.
  std::vector<std::int32_t> numbers_;  ///< of the overlap's vertices, in the whole mesh
  std::optional<trismooth::MovingMesh> moving_;
};

MovingMesh::MovingMesh(MPI_Comm communicator, const ConstPointView& reference, const LocalMesh& mesh,
                       const Constraints& constraints, const SmoothingOptions& options) {
  const std::shared_ptr<const Communicator> ranks = joined_ranks(communicator);
  implementation_ = ranks->together([&] {
    ranks->on_all([&] { options_of_moving(options, constraints); });
    const SmoothingOptions agreed = agreed_options(options, constraints, Gather::where_needed, *ranks);
    return std::make_unique<Implementation>(ranks, reference, mesh, constraints, agreed);
  });
}

MovingMesh::MovingMesh(MPI_Comm communicator, const ConstPointView& reference, const LocalMesh& mesh,
                       const SmoothingOptions& options)
    : MovingMesh(communicator, reference, mesh, Constraints{}, options) {}

MovingMesh::MovingMesh(MovingMesh&&) noexcept = default;
MovingMesh& MovingMesh::operator=(MovingMesh&&) noexcept = default;
MovingMesh::~MovingMesh() = default;

FollowResult MovingMesh::follow(const PointView& points, MovingStart start) {
  Implementation& mesh = not_moved_from(implementation_, "mesh");
  return mesh.ranks().together([&] { return mesh.follow(points, start); });
}

void MovingMesh::take_back() {
  Implementation& mesh = not_moved_from(implementation_, "mesh");
  mesh.ranks().together([&] { mesh.take_back(); });
}

void MovingMesh::go_on_from(const ConstPointView& points) {
  Implementation& mesh = not_moved_from(implementation_, "mesh");
  mesh.ranks().together([&] { mesh.go_on_from(points); });
}

std::vector<std::uint8_t> MovingMesh::held() const {
  return not_moved_from(implementation_, "mesh").held();
}

std::vector<Point2<double>> MovingMesh::points() const {
  Implementation& mesh = not_moved_from(implementation_, "mesh");
  return mesh.ranks().together([&] { return mesh.points(); });
}

}  // namespace trismooth::mpi
