// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/joined/rank_topology.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "trismooth/base/hold.h"
#include "trismooth/base/index_view.h"
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
    return function();
  } catch (const mpi::KnownToAll& known) {
    try {
      std::rethrow_exception(known.error);
    } catch (const MeshError& error) {
      throw mpi::KnownToAll{std::make_exception_ptr(ReadError(path, error.what()))};
    } catch (const std::invalid_argument& error) {
      throw mpi::KnownToAll{std::make_exception_ptr(ReadError(path, error.what()))};
    } catch (...) {
      throw known;
    }
  }
}

}  // namespace

RankTopology::RankTopology(const RankMesh& mesh, std::span<const std::uint8_t> named,
                           std::span<const std::int32_t> owners, const std::filesystem::path& path,
                           std::shared_ptr<const mpi::Communicator> ranks, Workers& workers)
    : ranks_(std::move(ranks)), own_count_(mesh.elements.size()), triangle_ids_(mesh.triangle_ids) {
  if (!mesh.ghost_triangles.empty()) {
    for (std::size_t t = 0; t < mesh.elements.size(); ++t) {
      if (!mesh.is_ghost(t)) {
        own_places_.push_back(static_cast<std::int32_t>(t));
      }
    }
    own_count_ = own_places_.size();
  }
  triangle_count_ = ranks_->sum(static_cast<std::int64_t>(own_count_));
  first_id_ = ranks_->sum_before(static_cast<std::int64_t>(own_count_));
  const IndexView elements(mesh.elements);
  const mpi::LocalMesh local{elements, mesh.ids, owners, mesh.ghost_triangles, mesh.triangle_ids};
  const Constraints constraints{.fixed = named, .other_cells = mesh.in_other_cell};
  naming_file(path, [&] { overlap_ = mpi::build_overlap(local, mesh.elements, constraints, false, ranks_, workers); });
}

void RankTopology::connect(const std::filesystem::path& path, Workers& workers) {
  naming_file(path, [&] {
    ranks_->on_all([&] {
      topology_ = overlap_.elements().visit([&](const auto& listed) {
        return connect_triangles(overlap_.vertex_count(), listed, workers, overlap_.part.ghosts);
      });
    });
  });
}

std::int32_t RankTopology::local_triangle(std::int64_t id) const {
  const auto own = static_cast<std::int64_t>(own_count_);
  const std::int64_t place =
      triangle_ids_.empty() ? id - first_id_ : std::ranges::lower_bound(triangle_ids_, id) - triangle_ids_.begin();
  if (place < 0 || place >= own || own_id(static_cast<std::size_t>(place)) != id) {
    return -1;
  }
  return own_places_.empty() ? static_cast<std::int32_t>(place) : own_places_[static_cast<std::size_t>(place)];
}

std::vector<std::uint8_t> RankTopology::held(std::span<const std::int32_t> regions, Workers& workers) const {
  std::vector<std::uint8_t> held;
  agree(*ranks_, [&] {
    held = overlap_.elements().visit(
        [&](const auto& elements) { return fixed_vertices(topology_, elements, {.regions = regions}, workers); });
    for (std::size_t v = 0; v < held.size(); ++v) {
      held[v] |= overlap_.named[v];
    }
  });
  mpi::GhostValues(overlap_.part).update(std::span(held));
  return held;
}

std::int64_t RankTopology::count_vertices(std::span<const std::uint8_t> flags) const {
  const std::vector<std::uint8_t> all = of_vertices<std::uint8_t>(flags);
  std::int64_t count = 0;
  for (std::int32_t v = 0; v < overlap_.vertex_count(); ++v) {
    count += overlap_.is_own(v) && all[static_cast<std::size_t>(v)] != 0 ? 1 : 0;
  }
  return ranks_->sum(count);
}

LocalFrame RankTopology::frame_of(std::span<const Point2<double>> points, std::span<const std::uint8_t> held) const {
  return mpi::shared_frame(points, held, *ranks_);
}

std::vector<std::uint8_t> RankTopology::reversed(std::span<const Point2<double>> local, Workers& workers) const {
  return mpi::ComponentLabels(overlap_, topology_, *ranks_).reversed(overlap_, topology_, local, *ranks_, workers);
}

mpi::Overlap RankTopology::lend_overlap(std::vector<std::int32_t> regions, std::span<const std::uint8_t> held) {
  topology_ = {};
  overlap_.regions = std::move(regions);
  for (std::size_t v = 0; v < held.size(); ++v) {
    if (overlap_.is_own(static_cast<std::int32_t>(v))) {
      overlap_.named[v] |= static_cast<std::uint8_t>(held[v] & hold::named);
    }
  }
  return std::move(overlap_);
}

}  // namespace trismooth
