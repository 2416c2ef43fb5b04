#include "trismooth/mpi/plan.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <exception>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/base/bulk_memory.h"
#include "trismooth/base/hold.h"
#include "trismooth/base/local_points.h"
#include "trismooth/base/workers.h"
#include "trismooth/mpi/communicator.h"
#include "trismooth/mpi/component_labels.h"
#include "trismooth/mpi/links.h"
#include "trismooth/mpi/overlap.h"
#include "trismooth/mpi/same_options.h"
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

constexpr std::int64_t vertex_grain = 16384;

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

/// The shortest text that reads back to the same number.
std::string text_of(double value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

std::string text_of(const Point2<double>& point) {
  return "(" + text_of(point.x) + ", " + text_of(point.y) + ")";
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
    local_vertices_ = mesh.vertex_ids.size();
    has_lengths_ = ranks.any(!options.mean_ratio.target_lengths.empty());
    overlap_ = build_overlap(mesh, triangles, constraints, is_gathered_, communicator_, *workers_);
    from_callers_ = lengths_of(overlap_.from_callers);
    to_owners_ = lengths_of(overlap_.to_owners);
    MeshPart& part = overlap_.part;
    part.is_whole = is_gathered_;
    part.number = ranks.rank();
    part.count = ranks.size();
    part.place_on_machine = ranks.place_on_machine();
    part.has_progress = ranks.any(static_cast<bool>(options.progress));
    messages_.emplace(part.messages());
    ghost_exchange_ = part.ghost_exchange();
    ranks.on_all([&] {
      topology_ = connected(overlap_, *workers_);
      components_ = *topology_;
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
    update_ghosts(std::span(fixed_));
    labels_ = ComponentLabels(overlap_, components_, ranks);
    overlap_.owners = {};
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
    const Communicator& ranks = *communicator_;
    std::vector<Point2<double>> local;
    Storage stored = storage;
    ranks.on_all([&] {
      require_a_point_a_vertex(points);
      require_length_of_targets();
      stored = points.storage() == Storage::float32 ? Storage::float32 : storage;
      local = points.read(*workers_);
    });
    require_one_storage(stored);
    std::vector<Point2<double>> mine =
        gathered<Point2<double>>(local, [&](std::int32_t v, const auto& a, const auto& b) {
          if (!have_same_bits(a, b)) {
            throw std::invalid_argument("points: ranks disagree about the vertex of id " +
                                        std::to_string(overlap_.ids[static_cast<std::size_t>(v)]) + ": " + text_of(a) +
                                        " and " + text_of(b));
          }
        });
    require_one_height(points, mine);
    local = {};
    const LocalFrame frame = frame_of(mine);
    const BulkVector<Point2<double>> entered_points = entered(frame, mine).points;
    make_ready(entered_points);
    read_targets();
    SmoothingResult result = smoothed(mine, stored, frame);
    local.resize(local_vertices_);
    hand_back(mine, local);
    name_by_caller(result);
    points.write(local, *workers_);
    return result;
  }

  const Communicator& communicator() const { return *communicator_; }
  Traffic traffic() const { return static_cast<const Links&>(*overlap_.part.links).traffic(); }
  std::int64_t own_vertices() const { return std::ranges::count(overlap_.part.ghosts, 0); }
  std::int64_t ghost_vertices() const { return std::ssize(overlap_.ids) - own_vertices(); }

 private:
  template <class V>
  void update_ghosts(std::span<V> values) {
    messages_->start(ghost_exchange_, std::span<const V>(values));
    messages_->finish<V>(ghost_exchange_,
                         [&](std::int32_t v, const V& value) { values[static_cast<std::size_t>(v)] = value; });
  }

  void require_a_point_a_vertex(const PointView& points) const {
    if (points.size() != local_vertices_) {
      throw std::invalid_argument("points: " + std::to_string(points.size()) + " of them, expected one for each of " +
                                  std::to_string(local_vertices_) + " local vertices");
    }
  }

  void require_length_of_targets() const {
    const std::span<const double> lengths = options_.mean_ratio.target_lengths;
    if (!has_lengths_ || options_.method != Method::mean_ratio) {
      return;
    }
    if (lengths.size() != local_vertices_) {
      throw std::invalid_argument("MeanRatioOptions::target_lengths has " + std::to_string(lengths.size()) +
                                  " entries, expected one for each of " + std::to_string(local_vertices_) +
                                  " local vertices");
    }
  }

  void require_one_storage(Storage stored) const {
    const bool is_float = stored == Storage::float32;
    const bool are_float_somewhere = communicator_->any(is_float && local_vertices_ > 0);
    communicator_->on_all([&] {
      if (!is_float && are_float_somewhere && local_vertices_ > 0) {
        throw std::invalid_argument("points, or the storage of results: double here and float on other ranks");
      }
    });
  }

  /// What the callers have of own vertices, brought to their owners and from there to those who have them as ghosts.
  /// compare(vertex, a, b) throws where two ranks may not have these two.
  template <class V, class Compare>
  std::vector<V> gathered(std::span<const V> local, const Compare& compare) {
    const auto own = static_cast<std::size_t>(communicator_->rank());
    auto sent = lists_by_rank<V>(*communicator_);
    for (std::size_t r = 0; r < sent.size(); ++r) {
      for (std::size_t i = 0; i < overlap_.to_owners[r].size() && r != own; ++i) {
        sent[r].push_back(local[static_cast<std::size_t>(overlap_.to_owners[r][i])]);
      }
    }
    const ByRank<V> received = communicator_->exchanged(std::move(sent), from_callers_);
    std::vector<V> mine(overlap_.ids.size());
    std::vector<std::uint8_t> is_known(communicator_->size() > 1 ? mine.size() : 0, 0);
    workers_->for_blocks(std::ssize(overlap_.to_owners[own]), vertex_grain, [&](std::int64_t begin, std::int64_t end) {
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
        const auto v = static_cast<std::size_t>(overlap_.from_callers[own][i]);
        mine[v] = local[static_cast<std::size_t>(overlap_.to_owners[own][i])];
        if (!is_known.empty()) {
          is_known[v] = 1;
        }
      }
    });
    communicator_->on_all([&] {
      for (std::size_t r = 0; r < received.size(); ++r) {
        for (std::size_t i = 0; i < received[r].size(); ++i) {
          const std::int32_t v = overlap_.from_callers[r][i];
          if (is_known[static_cast<std::size_t>(v)] != 0) {
            compare(v, mine[static_cast<std::size_t>(v)], received[r][i]);
          }
          mine[static_cast<std::size_t>(v)] = received[r][i];
          is_known[static_cast<std::size_t>(v)] = 1;
        }
      }
    });
    update_ghosts(std::span(mine));
    return mine;
  }

  /// As that of base/heights.h, over all ranks.
  void require_one_height(const PointView& points, std::span<const Point2<double>> mine) {
    const bool has_heights = points.components() == 3;
    const bool are_somewhere = communicator_->any(has_heights && local_vertices_ > 0);
    communicator_->on_all([&] {
      if (!has_heights && are_somewhere && local_vertices_ > 0) {
        throw std::invalid_argument("points: two numbers each here and three on other ranks");
      }
    });
    if (!are_somewhere) {
      return;
    }
    std::vector<double> local(local_vertices_, 0.0);
    for (std::size_t v = 0; v < local.size() && has_heights; ++v) {
      local[v] = points.z(v);
    }
    const std::vector<double> heights = gathered<double>(local, [&](std::int32_t v, double a, double b) {
      if (!(a == b)) {
        throw std::invalid_argument("points: ranks disagree about z of the vertex of id " +
                                    std::to_string(overlap_.ids[static_cast<std::size_t>(v)]));
      }
    });
    // Halves, so that no difference overflows.
    const auto half_extent = [&](const auto& value_of) {
      PartSums range;
      range.largest = {-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
      for (std::size_t v = 0; v < mine.size(); ++v) {
        if (!hold::is_unused(fixed_[v])) {
          const double value = value_of(v) / 2;
          range.largest = {std::max(range.largest[0], value), std::max(range.largest[1], -value)};
        }
      }
      range = communicator_->joined(range);
      return range.largest[0] >= -range.largest[1] ? range.largest[0] + range.largest[1] : 0.0;
    };
    const double x = half_extent([&](std::size_t v) { return mine[v].x; });
    const double y = half_extent([&](std::size_t v) { return mine[v].y; });
    const double z = half_extent([&](std::size_t v) { return heights[v]; });
    communicator_->on_all([&] {
      if (!(z <= 1e-6 * std::max(x, y))) {
        throw MeshError("points: z must be the same everywhere to within 1e-6 of the mesh's extent");
      }
    });
  }

  /// The local frame of the whole mesh.
  LocalFrame frame_of(std::span<const Point2<double>> mine) const {
    PartSums low;
    PartSums high;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    low.largest = {-infinity, -infinity};
    high.largest = {-infinity, -infinity};
    for (std::size_t v = 0; v < mine.size(); ++v) {
      if (!hold::is_unused(fixed_[v])) {
        low.largest = {std::max(low.largest[0], -mine[v].x), std::max(low.largest[1], -mine[v].y)};
        high.largest = {std::max(high.largest[0], mine[v].x), std::max(high.largest[1], mine[v].y)};
      }
    }
    low = communicator_->joined(low);
    high = communicator_->joined(high);
    return local_frame({-low.largest[0], -low.largest[1]}, {high.largest[0], high.largest[1]});
  }

  /// Prepares the sweeps where the orientation that these points give the mesh is new.
  void make_ready(std::span<const Point2<double>> local) {
    std::vector<std::uint8_t> reversed = labels_.reversed(overlap_, components_, local, *communicator_, *workers_);
    const bool is_new = !is_coloured_ || reversed != reversed_;
    if (!communicator_->any(is_new)) {
      return;
    }
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
      update_ghosts(std::span(part.colours));
    }
    PartSums highest;
    highest.largest[0] = part.colours.empty() ? -1 : *std::ranges::max_element(part.colours);
    part.colour_count = static_cast<std::int32_t>(communicator_->joined(highest).largest[0]) + 1;
  }

  /// The caller's options for the rank's own numbers; an exception of a progress callback stops all ranks.
  SmoothingOptions used_options() {
    SmoothingOptions used = options_;
    used.mean_ratio.target_lengths = {};
    if (has_lengths_) {
      // Never empty: that would say that no sizes are asked for.
      lengths_.resize(std::max<std::size_t>(overlap_.ids.size(), 1), 1.0);
      used.mean_ratio.target_lengths = lengths_;
    }
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

  void read_targets() {
    if (!has_lengths_) {
      return;
    }
    const std::span<const double> own = options_.mean_ratio.target_lengths;
    const std::vector<double> local =
        own.empty() ? std::vector<double>(local_vertices_, 1.0) : std::vector<double>(own.begin(), own.end());
    const std::vector<double> found = gathered<double>(local, [&](std::int32_t v, double a, double b) {
      if (!(a == b) && !hold::is_unused(fixed_[static_cast<std::size_t>(v)])) {
        throw std::invalid_argument("MeanRatioOptions::target_lengths: ranks disagree about the vertex of id " +
                                    std::to_string(overlap_.ids[static_cast<std::size_t>(v)]));
      }
    });
    communicator_->on_all([&] {
      for (std::size_t v = 0; v < found.size() && options_.aims_at_sizes(); ++v) {
        if ((fixed_[v] & hold::isolated) == 0 && (!(found[v] > 0) || !std::isfinite(found[v]))) {
          throw std::invalid_argument("MeanRatioOptions::target_lengths: that of the vertex of id " +
                                      std::to_string(overlap_.ids[v]) + " is not a positive number");
        }
      }
    });
    std::ranges::copy(found, lengths_.begin());
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
      const LocalMesh mesh{overlap_.triangles, overlap_.ids, {}, is_copy, overlap_.triangle_ids};
      constexpr bool is_gathered = true;
      gathered_ = std::make_unique<Implementation>(
          communicator_, mesh, Constraints{.fixed = named, .other_cells = in_other_cell, .regions = overlap_.regions},
          used_options(), gather_, is_gathered);
    }
    return gathered_->smooth(PointView(mine), stored);
  }

  /// Sends what became of own vertices to all who have them.
  void hand_back(std::span<const Point2<double>> mine, std::span<Point2<double>> local) {
    const auto own = static_cast<std::size_t>(communicator_->rank());
    auto sent = lists_by_rank<Point2<double>>(*communicator_);
    for (std::size_t r = 0; r < sent.size(); ++r) {
      for (std::size_t i = 0; i < overlap_.from_callers[r].size() && r != own; ++i) {
        sent[r].push_back(mine[static_cast<std::size_t>(overlap_.from_callers[r][i])]);
      }
    }
    const ByRank<Point2<double>> received = communicator_->exchanged(std::move(sent), to_owners_);
    workers_->for_blocks(std::ssize(overlap_.to_owners[own]), vertex_grain, [&](std::int64_t begin, std::int64_t end) {
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
        local[static_cast<std::size_t>(overlap_.to_owners[own][i])] =
            mine[static_cast<std::size_t>(overlap_.from_callers[own][i])];
      }
    });
    for (std::size_t r = 0; r < received.size(); ++r) {
      for (std::size_t i = 0; i < received[r].size(); ++i) {
        local[static_cast<std::size_t>(overlap_.to_owners[r][i])] = received[r][i];
      }
    }
  }

  /// Tells all who have a vertex that went back, in their own numbers.
  void name_by_caller(SmoothingResult& result) const {
    if (result.reverted_vertices == 0) {
      return;
    }
    auto sent = lists_by_rank<RevertedVertex>(*communicator_);
    for (std::size_t r = 0; r < sent.size(); ++r) {
      for (std::size_t i = 0; i < overlap_.from_callers[r].size(); ++i) {
        const auto place =
            std::ranges::lower_bound(result.reverted, overlap_.from_callers[r][i], {}, &RevertedVertex::vertex);
        if (place != result.reverted.end() && place->vertex == overlap_.from_callers[r][i]) {
          sent[r].push_back({static_cast<std::int32_t>(i), place->position});
        }
      }
    }
    const ByRank<RevertedVertex> received = communicator_->exchanged(std::move(sent));
    result.reverted.clear();
    for (std::size_t r = 0; r < received.size(); ++r) {
      for (const auto& [place, position] : received[r]) {
        result.reverted.push_back({overlap_.to_owners[r][static_cast<std::size_t>(place)], position});
      }
    }
    std::ranges::sort(result.reverted, {}, &RevertedVertex::vertex);
  }

  std::shared_ptr<const Communicator> communicator_;
  SmoothingOptions options_;
  Gather gather_;
  bool is_gathered_;  ///< rank 0 owns all vertices
  std::optional<Workers> workers_;
  std::size_t local_vertices_ = 0;
  bool has_lengths_ = false;  ///< some rank has target lengths
  Overlap overlap_;
  std::vector<std::int64_t> from_callers_;  ///< lengths of the lists of this name
  std::vector<std::int64_t> to_owners_;     ///< likewise
  std::optional<VertexMessages> messages_;
  VertexExchange ghost_exchange_;
  TriangleComponents components_;             ///< of the overlap
  std::optional<TriangleTopology> topology_;  ///< likewise, until rings are made of it
  std::vector<std::uint8_t> fixed_;           ///< as MeshRings::fixed, ghosts as their owners have it
  Slidable slidable_;                         ///< where it is gathered
  ComponentLabels labels_;
  bool is_coloured_ = false;
  std::vector<std::uint8_t> reversed_;
  std::vector<double> lengths_;  ///< that are asked for, of the overlap
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
