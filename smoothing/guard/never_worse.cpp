// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/guard/never_worse.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "trismooth/base/machine/workers.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/smoothing/guard/element_lanes.h"
#include "trismooth/smoothing/guard/guard_tree.h"
#include "trismooth/smoothing/halo/halo.h"
#include "trismooth/smoothing/rings/ring_elements.h"

namespace trismooth {

namespace {

/// Vertices whose elements have one minimum in common.
constexpr std::int32_t vertices_a_block = 64;
/// Blocks that a thread takes at a time.
constexpr std::int64_t block_grain = 32;

/// Whether a vertex has no ring and yet is one of those that may have one.
bool has_gaps(const RingView& rings, Workers& workers) {
  constexpr std::int64_t grain = 65536;
  std::atomic<bool> found{false};
  workers.for_blocks(rings.size(), grain, [&](std::int64_t begin, std::int64_t end) {
    const auto offsets =
        rings.offsets.subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin + 1));
    if (std::ranges::adjacent_find(offsets) != offsets.end()) {
      found.store(true, std::memory_order_relaxed);
    }
  });
  return found;
}

/// Elements of one kind that are measured side by side, as many as there are lanes at a time:
/// visit(lanes, corners, count) is called when they are full, and by finish().
template <class Corners, class Visit>
class KindGatherer {
 public:
  KindGatherer(const RingView& rings, std::span<const Point2<double>> before, std::span<const Point2<double>> after,
               const FollowingNodes* nodes, const Visit& visit)
      : rings_(rings), before_(before), after_(after), nodes_(nodes), visit_(visit) {}

  /// Takes the element, or if it does not count makes as if it had never been there: without a branch, which would be
  /// guessed wrong too often.
  void add_if(bool counts, const Corners& element) {
    elements_[count_] = element;
    count_ += counts ? 1 : 0;
    if (count_ == Lanes::lanes) {
      finish();
    }
  }

  void finish() {
    if (count_ == 0) {
      return;
    }
    for (std::size_t lane = 0; lane < count_; ++lane) {
      gather(lane);
    }
    measure_(static_cast<int>(count_), lanes_);
    if (nodes_ != nullptr) {
      judge_nodes();
    }
    visit_(lanes_, elements_, count_);
    count_ = 0;
  }

 private:
  using Lanes = ElementLanes<Corners>;

  /// In canonical corner order: from the corner with the smallest input index on.
  void gather(std::size_t lane) {
    const Corners corners = from_smallest(elements_[lane], [this](std::int32_t v) { return rings_.input(v); });
    for (int corner = 0; corner < Lanes::corners; ++corner) {
      const std::int32_t v = corners[corner];
      lanes_.before_x[corner][lane] = before_[v].x;
      lanes_.before_y[corner][lane] = before_[v].y;
      lanes_.after_x[corner][lane] = after_[v].x;
      lanes_.after_y[corner][lane] = after_[v].y;
    }
  }

  void judge_nodes() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (std::size_t lane = 0; lane < count_; ++lane) {
      const bool is_touched = lanes_.quotients[lane] < infinity;
      if (is_touched && nodes_->is_spoiled(elements_[lane], false)) {
        lanes_.worsened[lane] = -infinity;
      }
    }
  }

  const RingView& rings_;
  std::span<const Point2<double>> before_;
  std::span<const Point2<double>> after_;
  const FollowingNodes* nodes_;
  const Visit& visit_;
  ElementMeasure<Corners> measure_ = element_measure<Corners>(instruction_set());
  std::size_t count_ = 0;
  std::array<Corners, Lanes::lanes> elements_;
  Lanes lanes_;
};

/// Elements of both kinds.
template <class Visit>
class ElementGatherer {
 public:
  ElementGatherer(const RingView& rings, std::span<const Point2<double>> before, std::span<const Point2<double>> after,
                  const FollowingNodes* nodes, const Visit& visit)
      : triangles_(rings, before, after, nodes, visit) {
    if (rings.has_quadrilaterals()) {
      quadrilaterals_.emplace(rings, before, after, nodes, visit);
    }
  }

  void add_if(bool counts, const Triangle& triangle) { triangles_.add_if(counts, triangle); }
  void add_if(bool counts, const MixedElement& quadrilateral) { quadrilaterals_->add_if(counts, quadrilateral); }
  void finish() {
    triangles_.finish();
    if (quadrilaterals_) {
      quadrilaterals_->finish();
    }
  }

 private:
  KindGatherer<Triangle, Visit> triangles_;
  std::optional<KindGatherer<MixedElement, Visit>> quadrilaterals_;
};

class Guard {
 public:
  Guard(const RingView& rings, std::span<const Point2<double>> before, std::span<Point2<double>> after,
        Workers& workers, const NumberLists& held, Halo* halo, FollowingNodes* nodes)
      : rings_(rings),
        before_(before),
        after_(after),
        workers_(workers),
        held_(held),
        halo_(halo),
        nodes_(nodes),
        has_gaps_(has_gaps(rings, workers)),
        block_count_((std::int64_t{rings.size()} + vertices_a_block - 1) / vertices_a_block),
        tree_(static_cast<std::size_t>(block_count_)) {
    if (halo != nullptr) {
      for (auto v = rings.size(); v < static_cast<std::int32_t>(before.size()); ++v) {
        if (has_moved(v)) {
          moved_ghosts_.push_back(v);
        }
      }
    }
  }

  GuardOutcome run() {
    GuardOutcome outcome;
    workers_.for_blocks(block_count_, block_grain, [&](std::int64_t begin, std::int64_t end) {
      measure(begin, end, [](std::int64_t block) { return static_cast<std::int32_t>(block); });
    });
    tree_.update();
    for (;;) {
      threshold_ = least_of_parts(halo_, tree_.total().before);
      blocks_.clear();
      tree_.find_below(threshold_, blocks_);
      if (!any_part(halo_, !blocks_.empty())) {
        break;
      }
      ++outcome.rounds;
      find_offenders();
      take_back();
      outcome.reverted.insert(outcome.reverted.end(), offenders_.begin(), offenders_.end());
    }
    std::ranges::sort(outcome.reverted);
    outcome.threshold = threshold_;
    return outcome;
  }

 private:
  bool has_moved(std::int32_t vertex) const { return !(before_[vertex] == after_[vertex]); }

  /// Calls visit(lanes, elements, count) for the elements of the block, some at a time: those whose free corner of the
  /// smallest number is in it. So every element of a free vertex is in one block.
  template <class Visit>
  void for_elements(std::int32_t block, ElementGatherer<Visit>& gatherer) const {
    const std::int32_t begin = block * vertices_a_block;
    const auto end =
        static_cast<std::int32_t>(std::min<std::int64_t>(rings_.size(), std::int64_t{begin} + vertices_a_block));
    if (has_gaps_) {
      add_elements(
          begin, end, [this](std::int32_t v) { return rings_.is_free(v); }, gatherer);
    } else {
      add_elements(
          begin, end, [](std::int32_t /*v*/) { return true; }, gatherer);
    }
    gatherer.finish();
  }

  /// `is_free(v)`: of a vertex below `end`.
  template <class IsFree, class Visit>
  void add_elements(std::int32_t begin, std::int32_t end, const IsFree& is_free,
                    ElementGatherer<Visit>& gatherer) const {
    for (std::int32_t v = begin; v < end; ++v) {
      if (!rings_.is_free(v)) {
        continue;
      }
      const auto comes_later = [&](std::int32_t other) { return other > v || !is_free(other); };
      const auto add = [&](const auto& corner) { gatherer.add_if(corner.all(comes_later), element_at(v, corner)); };
      rings_.with_ring(v, [&](const auto& around) { for_elements_around(around, add); });
    }
  }

  /// Finds the minima of the blocks block_at(begin) .. block_at(end).
  template <class BlockAt>
  void measure(std::int64_t begin, std::int64_t end, const BlockAt& block_at) {
    GuardMinimum minimum;
    const auto join = [&](const auto& lanes, const auto& /*elements*/, std::size_t count) {
      for (std::size_t lane = 0; lane < count; ++lane) {
        minimum.join({lanes.quotients[lane], lanes.worsened[lane]});
      }
    };
    ElementGatherer gatherer(rings_, before_, after_, nodes_, join);
    for (std::int64_t i = begin; i < end; ++i) {
      const std::int32_t block = block_at(i);
      minimum = {};
      for_elements(block, gatherer);
      tree_[static_cast<std::size_t>(block)] = minimum;
    }
  }

  /// The moved corners of the offending elements in blocks_, each once.
  void find_offenders() {
    const double threshold = threshold_;
    listed_.resize(before_.size(), 0);
    offenders_.clear();
    std::mutex joining;
    workers_.for_blocks(std::ssize(blocks_), block_grain, [&](std::int64_t begin, std::int64_t end) {
      std::vector<std::int32_t> found;
      const auto list_offending = [&](const auto& lanes, const auto& elements, std::size_t count) {
        for (std::size_t lane = 0; lane < count; ++lane) {
          if (lanes.worsened[lane] < threshold) {
            std::ranges::copy_if(elements[lane], std::back_inserter(found),
                                 [&](std::int32_t v) { return has_moved(v) && goes_back_here(v) && list(v); });
          }
        }
      };
      ElementGatherer gatherer(rings_, before_, after_, nodes_, list_offending);
      for (std::int64_t i = begin; i < end; ++i) {
        for_elements(blocks_[static_cast<std::size_t>(i)], gatherer);
      }
      const std::lock_guard lock(joining);
      offenders_.insert(offenders_.end(), found.begin(), found.end());
    });
  }

  /// Of a ghost its owner says so, who sees the same elements.
  bool goes_back_here(std::int32_t vertex) const { return halo_ == nullptr || vertex < rings_.size(); }

  /// True for the first who lists the vertex.
  bool list(std::int32_t vertex) {
    std::atomic_ref<std::uint8_t> listed(listed_[static_cast<std::size_t>(vertex)]);
    return listed.exchange(1, std::memory_order_relaxed) == 0;
  }

  /// Puts the offenders back and measures the blocks again that hold their elements, then or now: their own and those
  /// of their neighbours.
  void take_back() {
    blocks_.clear();
    for (const std::int32_t v : offenders_) {
      after_[v] = before_[v];
      if (nodes_ != nullptr) {
        nodes_->follow(v);
      }
      measure_again(v);
      if (v < rings_.size()) {
        rings_.for_vertices_around(v, [&](std::int32_t other) { measure_again(other); });
      } else {
        for (const std::int32_t neighbour : held_[v]) {
          measure_again(neighbour);
        }
      }
    }
    if (halo_ != nullptr) {
      halo_->update(after_);
      for (const std::int32_t ghost : moved_ghosts_) {
        if (!has_moved(ghost)) {
          for (const std::int32_t neighbour : held_[ghost]) {
            measure_again(neighbour);
          }
        }
      }
      std::erase_if(moved_ghosts_, [this](std::int32_t ghost) { return !has_moved(ghost); });
    }
    std::ranges::sort(blocks_);
    blocks_.erase(std::unique(blocks_.begin(), blocks_.end()), blocks_.end());
    workers_.for_blocks(std::ssize(blocks_), block_grain, [&](std::int64_t begin, std::int64_t end) {
      measure(begin, end, [this](std::int64_t i) { return blocks_[static_cast<std::size_t>(i)]; });
    });
    tree_.update(blocks_);
  }

  /// Lists the block of the vertex, if it is one with a ring.
  void measure_again(std::int32_t v) {
    if (v < rings_.size()) {
      blocks_.push_back(v / vertices_a_block);
    }
  }

  const RingView& rings_;
  std::span<const Point2<double>> before_;
  std::span<Point2<double>> after_;
  Workers& workers_;
  const NumberLists& held_;
  Halo* halo_;
  FollowingNodes* nodes_;
  std::vector<std::int32_t> moved_ghosts_;
  double threshold_ = 0;
  bool has_gaps_;
  std::int64_t block_count_;
  GuardTree tree_;
  std::vector<std::int32_t> blocks_;     ///< of this round: with an offender, then with elements that changed
  std::vector<std::uint8_t> listed_;     ///< per vertex: 1 where it has gone back
  std::vector<std::int32_t> offenders_;  ///< of this round
};

}  // namespace

GuardOutcome keep_never_worse(const RingView& rings, std::span<const Point2<double>> before,
                              std::span<Point2<double>> after, Workers& workers, const NumberLists& held, Halo* halo,
                              FollowingNodes* nodes) {
  return Guard(rings, before, after, workers, held, halo, nodes).run();
}

void name_reverted(SmoothingResult& result, std::span<const Point2<double>> points) {
  // By vertex, and of one vertex the first first.
  std::vector<std::pair<std::int32_t, std::size_t>> order;
  order.reserve(result.reverted.size());
  for (std::size_t i = 0; i < result.reverted.size(); ++i) {
    order.emplace_back(result.reverted[i].vertex, i);
  }
  std::ranges::sort(order);
  std::vector<RevertedVertex> named;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto [vertex, place] = order[i];
    const bool is_first = i == 0 || order[i - 1].first != vertex;
    if (is_first && !(result.reverted[place].position == points[vertex])) {
      named.push_back(result.reverted[place]);
    }
  }
  result.reverted = std::move(named);
  result.reverted_vertices = std::ssize(result.reverted);
}

}  // namespace trismooth
