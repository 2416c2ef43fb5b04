// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mpi/overlap_smoother.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "trismooth/base/hold.h"
#include "trismooth/base/local_points.h"
#include "trismooth/base/machine/release.h"
#include "trismooth/mpi/messenger.h"
#include "trismooth/mpi/rank_layers.h"
#include "trismooth/mpi/same_options.h"
#include "trismooth/mpi/shared_frame.h"
#include "trismooth/mpi/shared_result.h"
#include "trismooth/quality/element.h"
#include "trismooth/smoothing/backend_choice.h"
#include "trismooth/smoothing/errors.h"
#include "trismooth/smoothing/invalid_triangles.h"
#include "trismooth/smoothing/limited.h"
#include "trismooth/smoothing/noted_smoother.h"
#include "trismooth/smoothing/rings/colouring.h"
#include "trismooth/smoothing/rings/fixed_vertices.h"
#include "trismooth/smoothing/rings/one_rings.h"

namespace trismooth::mpi {

namespace {

void require_supported(const SmoothingOptions& options, const Constraints& constraints, Gather gather) {
  options.validate();
  if (constraints.slide.along != Slide::off && gather == Gather::never) {
    throw std::invalid_argument(
        "vertices do not slide in a mesh in pieces: have it gathered on one rank (Gather::where_needed), or set slide "
        "to off");
  }
  if (options.proposal) {
    throw std::invalid_argument("a proposal names vertices by the caller's numbers, which a mesh in pieces has not");
  }
  if (options.order == Order::unordered || options.execution != Execution::resident) {
    throw std::invalid_argument(
        "executions and orders of the paper's CUDA versions are not there for a mesh in pieces");
  }
}

/// What SmoothingPlan says of a component's triangles in the numbers of this rank's overlap says nothing to the caller.
TriangleTopology connected(const Overlap& overlap, Workers& workers) {
  try {
    return overlap.elements().visit([&](const auto& elements) {
      return connect_triangles(overlap.vertex_count(), elements, workers, overlap.part.ghosts);
    });
  } catch (const MeshError&) {
    throw MeshError("triangles that are connected with each other cannot be oriented consistently (" +
                    std::string(why_one_sided(overlap)) + ")");
  }
}

}  // namespace

SmoothingOptions agreed_options(const SmoothingOptions& options, const Constraints& constraints, Gather gather,
                                const Communicator& ranks) {
  SmoothingOptions agreed = options;
  ranks.on_all([&] {
    require_supported(options, constraints, gather);
    backend_of(options).require_ready();
    agreed.threads = ranks.threads(options.threads);
  });
  std::vector<OptionValue> values = option_values(options, constraints.slide);
  values.emplace_back("gather", gather != Gather::never ? 1 : 0);
  require_same(values, ranks);
  return agreed;
}

std::unique_ptr<OverlapSmoother> make_overlap_smoother(std::shared_ptr<const Communicator> communicator,
                                                       const LocalMesh& mesh, const Constraints& constraints,
                                                       const SmoothingOptions& options, Gather gather,
                                                       OverlapSmoother::Owners owners) {
  SmoothingOptions agreed = agreed_options(options, constraints, gather, *communicator);
  if (constraints.slide.along != Slide::off) {
    owners = OverlapSmoother::Owners::first;
  }
  OwnElements converted;
  ElementList elements;
  std::optional<Workers> workers;
  communicator->on_all([&] {
    workers.emplace(agreed.threads);
    elements = mesh.triangles.list(std::ssize(mesh.vertex_ids), converted);
  });
  std::string note;
  if (const Backend& backend = backend_of(agreed);
      !backend.takes_quadrilaterals_in_parts() && has_quadrilaterals(elements, *communicator)) {
    note = "quadrilaterals are smoothed in pieces by the CPUs of the ranks, not by backend '" + backend.name() + "'";
    communicator->on_all([&] {
      if (gather == Gather::never) {
        throw std::invalid_argument(
            note + ": take the CPU's, or have them gathered on one rank (Gather::where_needed), whose CPU does it");
      }
    });
    note += ": the CPU of rank 0 has smoothed all";
    agreed.backend = nullptr;
    owners = OverlapSmoother::Owners::first;
  }
  Overlap overlap =
      build_overlap(mesh, elements, constraints, owners == OverlapSmoother::Owners::first, communicator, *workers);
  return std::make_unique<OverlapSmoother>(std::move(communicator), std::move(overlap), agreed, constraints.slide,
                                           gather, owners, std::move(note));
}

OverlapSmoother::OverlapSmoother(std::shared_ptr<const Communicator> communicator, Overlap overlap,
                                 const SmoothingOptions& options, Sliding slide, Gather gather, Owners owners,
                                 std::string note)
    : communicator_(std::move(communicator)),
      options_(options),
      slide_(std::move(slide)),
      gather_(gather),
      is_gathered_(owners == Owners::first),
      note_(std::move(note)),
      overlap_(std::move(overlap)) {
  const Communicator& ranks = *communicator_;
  ranks.on_all([&] { workers_.emplace(options_.threads); });
  has_lengths_ = ranks.any(!options.mean_ratio.target_lengths.empty());
  if (has_lengths_) {
    // Never empty: that would say that no sizes are asked for.
    lengths_.assign(std::max<std::size_t>(overlap_.ids.size(), 1), 1.0);
  }
  MeshPart& part = overlap_.part;
  part.is_whole = is_gathered_;
  part.number = ranks.rank();
  part.count = ranks.size();
  part.place_on_machine = ranks.place_on_machine();
  part.has_progress = ranks.any(options.progress || options.cancel);
  ghosts_.emplace(part);
  points_.emplace(overlap_, *ghosts_, ranks, *workers_);
  ranks.on_all([&] {
    topology_ = connected(overlap_, *workers_);
    fixed_ = overlap_.elements().visit([&](const auto& elements) {
      return fixed_vertices(*topology_, elements, {.regions = overlap_.regions}, *workers_);
    });
    for (std::size_t v = 0; v < fixed_.size(); ++v) {
      fixed_[v] |= overlap_.named[v];
    }
  });
  ghosts_->update(std::span(fixed_));
  labels_ = ComponentLabels(overlap_, components(), ranks);
  count_quadrilaterals();
  release(overlap_.owners);
  count_free();
  ranks.on_all([&] {
    if (options.method == Method::mean_ratio && part.free_vertices > std::numeric_limits<std::uint32_t>::max()) {
      throw std::invalid_argument("the mean-ratio method adds up areas of 2^32 - 1 free vertices at most");
    }
  });
}

void OverlapSmoother::count_quadrilaterals() {
  const ElementList elements = overlap_.elements();
  if (elements.are_triangles()) {
    return;
  }
  std::int64_t own = 0;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    own += elements[e].size() == 4 && overlap_.counts(e) ? 1 : 0;
  }
  quadrilaterals_ = communicator_->sum(own);
}

void OverlapSmoother::count_free() {
  std::int64_t own_free = 0;
  for (std::int32_t v = 0; v < overlap_.vertex_count(); ++v) {
    own_free += overlap_.is_own(v) && fixed_[static_cast<std::size_t>(v)] == 0 ? 1 : 0;
  }
  overlap_.part.free_vertices = communicator_->sum(own_free);
}

void OverlapSmoother::find_layers(std::span<const Point2<double>> local, std::span<const std::uint8_t> reversed) {
  layers_ = hold_layers(overlap_, local, reversed, options_.used_layers(), slide_.along != Slide::off, fixed_,
                        *communicator_, *workers_);
  count_free();
  communicator_->on_all([&] {
    if (is_gathered_) {
      Sliding own_slide = slide_;
      own_slide.lines = overlap_.lines;
      own_slide.line_tags = overlap_.line_tags;
      own_slide.links = overlap_.links;
      slidable_ = overlap_.elements().visit([&](const auto& elements) {
        return find_slidable(elements, fixed_, {.regions = overlap_.regions, .slide = own_slide}, *workers_);
      });
    }
  });
}

SmoothingResult OverlapSmoother::smooth(const PointView& points, Storage storage) {
  CallLimit limit(options_.time_limit_seconds, used_options().cancel, CallLimit::begin_of_current());
  limit.lift();  // ranks leave together: behind a sweep
  const Storage stored = points_->storage_of(points, storage);
  BulkVector<Point2<double>> mine = points_->gathered(points);
  points_->require_one_height(points, mine, fixed_);
  if (has_lengths_) {
    // In place: the smoother knows them by where they are.
    std::ranges::copy(
        points_->target_lengths(options_.mean_ratio.target_lengths.listed(), fixed_, options_.aims_at_sizes()),
        lengths_.begin());
  }
  const LocalFrame frame = shared_frame(mine, fixed_, *communicator_);
  make_ready(frame, mine);
  if (const std::optional<CallEnd> end = agreed_end(limit)) {
    rethrow_from_callbacks();
    return ended_before_sweeps(*end, backend_of(options_).name());
  }
  SmoothingResult result = smoothed(mine, stored, frame);
  result.layers = layers_;
  result.quadrilaterals = quadrilaterals_;
  if (result.reverted_vertices > 0) {
    result.reverted = overlap_.callers.named(result.reverted, *communicator_);
  }
  points_->hand_back(mine, points);
  return result;
}

void OverlapSmoother::make_ready(const LocalFrame& frame, std::span<const Point2<double>> mine) {
  const BulkVector<Point2<double>> local = entered(frame, mine).points;
  std::vector<std::uint8_t> reversed = labels_.reversed(overlap_, components(), local, *communicator_, *workers_);
  if (!std::exchange(has_found_layers_, true)) {
    find_layers(local, reversed);
  }
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
    mesh.rings = overlap_.elements().visit(
        [&](const auto& elements) { return one_rings(*topology_, elements, reversed_, without_ring, *workers_); });
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
    smoother_ = backend_of(options_).prepare(std::move(mesh), overlap_.elements(), local, used_options());
    if (!note_.empty()) {
      smoother_ = std::make_unique<NotedSmoother>(std::move(smoother_), note_);
    }
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

void OverlapSmoother::colour(const OneRings& rings) {
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

SmoothingOptions OverlapSmoother::used_options() {
  SmoothingOptions used = options_;
  used.mean_ratio.target_lengths = lengths_;
  // What they throw waits until all ranks are there.
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
  if (options_.cancel) {
    used.cancel = [this] {
      try {
        return options_.cancel();
      } catch (...) {
        callback_error_ = std::current_exception();
        return true;
      }
    };
  }
  return used;
}

SmoothingResult OverlapSmoother::smoothed(std::span<Point2<double>> mine, Storage stored, const LocalFrame& frame) {
  SmoothingResult result;
  try {
    result = is_gathered_ ? smoothed_here(mine, stored, frame) : smoothed_in_pieces(mine, stored, frame);
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
  rethrow_from_callbacks();
  return result;
}

std::optional<CallEnd> OverlapSmoother::agreed_end(CallLimit& limit) const {
  const bool may_be_up = options_.time_limit_seconds < std::numeric_limits<double>::infinity();
  if (!may_be_up && !overlap_.part.has_progress) {
    return std::nullopt;
  }
  const std::optional<CallEnd> own = limit.end();
  if (communicator_->any(own == CallEnd::time_is_up)) {
    return CallEnd::time_is_up;
  }
  return communicator_->any(own == CallEnd::cancelled) ? std::optional(CallEnd::cancelled) : std::nullopt;
}

void OverlapSmoother::rethrow_from_callbacks() {
  communicator_->on_all([&] {
    if (callback_error_) {
      std::rethrow_exception(std::exchange(callback_error_, nullptr));
    }
  });
}

SmoothingResult OverlapSmoother::smoothed_in_pieces(std::span<Point2<double>> mine, Storage stored,
                                                    const LocalFrame& frame) {
  SmoothingResult result = smoother_->smooth(mine, stored, frame);
  ghosts_->update(mine);
  overlap_.elements().visit([&](const auto& elements) {
    count_invalid(
        elements, reversed_, [&](std::int32_t v) { return frame.enter(mine[v]); },
        [&](std::size_t t) { return overlap_.counts(corners_of(elements[t])); }, *workers_, result);
  });
  result.reverted_vertices = communicator_->sum(result.reverted_vertices);
  result.inverted = communicator_->sum(result.inverted);
  result.degenerate = communicator_->sum(result.degenerate);
  return result;
}

SmoothingResult OverlapSmoother::smoothed_here(std::span<Point2<double>> mine, Storage stored,
                                               const LocalFrame& frame) {
  SmoothingResult result;
  communicator_->on_all([&] {
    if (communicator_->rank() == 0) {
      result = smoother_->smooth(mine, stored, frame);
      overlap_.elements().visit([&](const auto& elements) {
        count_invalid(
            elements, reversed_, [&](std::int32_t v) { return frame.enter(mine[v]); }, *workers_, result);
      });
    }
  });
  share_result(result, *communicator_);
  return result;
}

SmoothingResult OverlapSmoother::smoothed_gathered(std::span<Point2<double>> mine, Storage stored) {
  if (gathered_ == nullptr) {
    std::vector<std::uint8_t> is_copy(overlap_.elements().size());
    for (std::size_t t = 0; t < is_copy.size(); ++t) {
      is_copy[t] = overlap_.counts(t) ? 0 : 1;
    }
    std::vector<std::uint8_t> named(overlap_.named.size());
    std::vector<std::uint8_t> in_other_cell(overlap_.named.size());
    for (std::size_t v = 0; v < named.size(); ++v) {
      named[v] = (overlap_.is_own(static_cast<std::int32_t>(v)) ? fixed_[v] : 0) & hold::named;
      in_other_cell[v] = overlap_.named[v] & hold::other_cell;
    }
    const std::vector<std::int64_t> triangle_ids = overlap_.triangle_ids.listed();
    const IndexView elements(overlap_.elements());
    const LocalMesh mesh{elements, overlap_.ids, {}, is_copy, triangle_ids};
    SmoothingOptions options = used_options();
    options.layers = Layers::smooth;  // they are among those named
    options.mean_ratio.target_lengths = std::span(lengths_).first(has_lengths_ ? overlap_.ids.size() : 0);
    gathered_ = make_overlap_smoother(
        communicator_, mesh, Constraints{.fixed = named, .other_cells = in_other_cell, .regions = overlap_.regions},
        options, gather_, Owners::first);
  }
  return gathered_->smooth(PointView(mine), stored);
}

Traffic OverlapSmoother::traffic() const {
  return static_cast<const Messenger&>(*overlap_.part.messenger).traffic();
}

std::int64_t OverlapSmoother::own_vertices() const {
  return std::ranges::count(overlap_.part.ghosts, 0);
}

Overlap OverlapSmoother::take_overlap() {
  smoother_.reset();
  points_.reset();
  ghosts_.reset();
  release(overlap_.part.colours);
  return std::move(overlap_);
}

}  // namespace trismooth::mpi
