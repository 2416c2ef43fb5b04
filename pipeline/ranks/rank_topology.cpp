#include "trismooth/pipeline/ranks/rank_topology.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "trismooth/base/hold.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mpi/component_labels.h"
#include "trismooth/mpi/shared_frame.h"
#include "trismooth/pipeline/ranks/agreement.h"
#include "trismooth/smoothing/errors.h"
#include "trismooth/smoothing/rings/fixed_vertices.h"

namespace trismooth {

namespace {

/// Calls a collective function of the mesh's connectivity: what it finds wrong is the file's fault.
template <class Function>
auto naming_file(const std::filesystem::path& path, const Function& function) {
  try {
    return known_to_all(function);
  } catch (const mpi::KnownToAll& known) {
    try {
      std::rethrow_exception(known.error);
    } catch (const MeshError& error) {
      throw mpi::KnownToAll{std::make_exception_ptr(ReadError(path, error.what()))};
    } catch (const std::invalid_argument& error) {
      throw mpi::KnownToAll{std::make_exception_ptr(ReadError(path, error.what()))};
    }
  }
}

}  // namespace

RankTopology::RankTopology(const RankMesh& mesh, std::span<const std::uint8_t> named,
                           std::span<const std::int32_t> owners, const std::filesystem::path& path,
                           std::shared_ptr<const mpi::Communicator> ranks, Workers& workers)
    : ranks_(std::move(ranks)) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.ghost_triangles[t] == 0) {
      own_triangles_.push_back(static_cast<std::int32_t>(t));
    }
  }
  triangle_count_ = ranks_->sum(std::ssize(own_triangles_));
  // A rank without triangles has no ids, whatever others have.
  const std::int64_t first_id = ranks_->sum_before(std::ssize(own_triangles_));
  if (mesh.triangle_ids.empty()) {
    own_ids_.resize(own_triangles_.size());
    std::iota(own_ids_.begin(), own_ids_.end(), first_id);
  } else {
    for (const std::int32_t t : own_triangles_) {
      own_ids_.push_back(mesh.triangle_ids[static_cast<std::size_t>(t)]);
    }
  }
  const mpi::LocalMesh local{mesh.triangles, mesh.ids, owners, mesh.ghost_triangles, mesh.triangle_ids};
  const Constraints constraints{.fixed = named, .other_cells = mesh.in_other_cell};
  naming_file(path, [&] {
    overlap_ = mpi::build_overlap(local, mesh.triangles, constraints, false, ranks_, workers);
    ranks_->on_all([&] {
      topology_ = connect_triangles(overlap_.vertex_count(), overlap_.triangles, workers, overlap_.part.ghosts);
    });
  });
  ask_for_triangles();
}

std::vector<std::int32_t> RankTopology::holders_of_triangles() const {
  // Numbers are shared out in blocks among ranks that keep a list of who has them.
  const std::int64_t block = triangle_count_ / ranks_->size() + 1;
  auto sent = mpi::lists_by_rank<std::int64_t>(*ranks_);
  for (const std::int64_t id : own_ids_) {
    sent[static_cast<std::size_t>(id / block)].push_back(id);
  }
  const std::int64_t first = block * ranks_->rank();
  std::vector<std::int32_t> holders(static_cast<std::size_t>(block), 0);
  const mpi::ByRank<std::int64_t> heard = ranks_->exchanged(std::move(sent));
  for (std::size_t r = 0; r < heard.size(); ++r) {
    for (const std::int64_t id : heard[r]) {
      holders[static_cast<std::size_t>(id - first)] = static_cast<std::int32_t>(r);
    }
  }
  auto asked = mpi::lists_by_rank<std::int64_t>(*ranks_);
  for (const std::int64_t id : overlap_.triangle_ids) {
    asked[static_cast<std::size_t>(id / block)].push_back(id);
  }
  auto answers = mpi::lists_by_rank<std::int32_t>(*ranks_);
  const mpi::ByRank<std::int64_t> wanted = ranks_->exchanged(std::move(asked));
  for (std::size_t r = 0; r < wanted.size(); ++r) {
    for (const std::int64_t id : wanted[r]) {
      answers[r].push_back(holders[static_cast<std::size_t>(id - first)]);
    }
  }
  const mpi::ByRank<std::int32_t> told = ranks_->exchanged(std::move(answers));
  std::vector<std::size_t> next(told.size(), 0);
  std::vector<std::int32_t> found;
  found.reserve(overlap_.triangle_ids.size());
  for (const std::int64_t id : overlap_.triangle_ids) {
    const auto home = static_cast<std::size_t>(id / block);
    found.push_back(told[home][next[home]++]);
  }
  return found;
}

void RankTopology::ask_for_triangles() {
  const std::vector<std::int32_t> holders = holders_of_triangles();
  wanted_triangles_ = mpi::lists_by_rank<std::int32_t>(*ranks_);
  auto wanted = mpi::lists_by_rank<std::int64_t>(*ranks_);
  for (std::size_t t = 0; t < overlap_.triangle_ids.size(); ++t) {
    const auto rank = static_cast<std::size_t>(holders[t]);
    wanted_triangles_[rank].push_back(static_cast<std::int32_t>(t));
    wanted[rank].push_back(overlap_.triangle_ids[t]);
  }
  const mpi::ByRank<std::int64_t> asked = ranks_->exchanged(std::move(wanted));
  asked_triangles_ = mpi::lists_by_rank<std::int32_t>(*ranks_);
  for (std::size_t r = 0; r < asked.size(); ++r) {
    for (const std::int64_t id : asked[r]) {
      asked_triangles_[r].push_back(local_triangle(id));
    }
  }
}

std::int32_t RankTopology::local_triangle(std::int64_t id) const {
  const auto place = std::ranges::lower_bound(own_ids_, id);
  return place != own_ids_.end() && *place == id ? own_triangles_[static_cast<std::size_t>(place - own_ids_.begin())]
                                                 : -1;
}

bool RankTopology::counts(std::size_t triangle) const {
  const auto& [a, b, c] = overlap_.triangles[triangle];
  return overlap_.is_own(std::min({a, b, c}));
}

std::vector<std::uint8_t> RankTopology::held(std::span<const std::int32_t> regions, Workers& workers) const {
  std::vector<std::uint8_t> held;
  agree(*ranks_, [&] {
    held = fixed_vertices(topology_, overlap_.triangles, {.regions = regions}, workers);
    for (std::size_t v = 0; v < held.size(); ++v) {
      held[v] |= overlap_.named[v];
    }
  });
  mpi::GhostValues(overlap_.part).update(std::span(held));
  return held;
}

LocalFrame RankTopology::frame_of(std::span<const Point2<double>> points, std::span<const std::uint8_t> held) const {
  return mpi::shared_frame(points, held, *ranks_);
}

std::vector<std::uint8_t> RankTopology::reversed(std::span<const Point2<double>> local, Workers& workers) const {
  return mpi::ComponentLabels(overlap_, topology_, *ranks_).reversed(overlap_, topology_, local, *ranks_, workers);
}

}  // namespace trismooth
