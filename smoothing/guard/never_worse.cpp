#include "trismooth/smoothing/guard/never_worse.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

#include "trismooth/base/triangle_view.h"
#include "trismooth/base/workers.h"
#include "trismooth/smoothing/guard/guard_tree.h"

namespace trismooth {

namespace {

/// Vertices whose elements have one minimum in common.
constexpr std::int32_t vertices_a_block = 64;
/// Blocks that a thread takes at a time.
constexpr std::int64_t block_grain = 32;

class Guard {
 public:
  Guard(const RingView& rings, std::span<const Point2<double>> before, std::span<Point2<double>> after,
        Workers& workers)
      : rings_(rings),
        before_(before),
        after_(after),
        workers_(workers),
        block_count_((std::int64_t{rings.size()} + vertices_a_block - 1) / vertices_a_block),
        tree_(static_cast<std::size_t>(block_count_)) {}

  GuardOutcome run() {
    GuardOutcome outcome;
    workers_.for_blocks(block_count_, block_grain, [&](std::int64_t begin, std::int64_t end) {
      for (auto block = static_cast<std::int32_t>(begin); block < end; ++block) {
        measure(block);
      }
    });
    tree_.update();
    for (;;) {
      blocks_.clear();
      tree_.find_below(tree_.total().before, blocks_);
      if (blocks_.empty()) {
        break;
      }
      ++outcome.rounds;
      find_offenders();
      take_back();
      outcome.reverted.insert(outcome.reverted.end(), offenders_.begin(), offenders_.end());
    }
    std::ranges::sort(outcome.reverted);
    return outcome;
  }

 private:
  bool has_moved(std::int32_t vertex) const { return !(before_[vertex] == after_[vertex]); }

  /// The quotient of the element (a, b, c), counter-clockwise, in canonical corner order.
  double quotient(std::span<const Point2<double>> points, Triangle element) const {
    const auto [a, b, c] = element;
    return canonical_quotient(points[a], points[b], points[c], rings_.input(a), rings_.input(b), rings_.input(c));
  }

  /// Calls visit(element, quotient before, worsened quotient) for the elements of the block: those whose moved corner
  /// of the smallest number is in it. So every element of a moved vertex is in one block.
  template <class Visit>
  void for_elements(std::int32_t block, const Visit& visit) const {
    const auto size = std::min<std::int64_t>(vertices_a_block, rings_.size() - std::int64_t{block} * vertices_a_block);
    for (std::int32_t i = 0; i < size; ++i) {
      const std::int32_t v = block * vertices_a_block + i;
      if (!has_moved(v)) {
        continue;
      }
      const auto ring = rings_[v];
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const std::int32_t b = ring[k];
        const std::int32_t c = ring[k + 1 == ring.size() ? 0 : k + 1];
        if ((b < v && has_moved(b)) || (c < v && has_moved(c))) {
          continue;
        }
        const Triangle element{v, b, c};
        const double was = quotient(before_, element);
        visit(element, was, worsened_quotient(was, quotient(after_, element)));
      }
    }
  }

  void measure(std::int32_t block) {
    GuardMinimum minimum;
    for_elements(block, [&](const Triangle& /*element*/, double before, double worsened) {
      minimum.join({before, worsened});
    });
    tree_[static_cast<std::size_t>(block)] = minimum;
  }

  /// The moved corners of the offending elements in blocks_, each once.
  void find_offenders() {
    const double threshold = tree_.total().before;
    listed_.resize(static_cast<std::size_t>(rings_.size()), 0);
    offenders_.clear();
    std::mutex joining;
    workers_.for_blocks(std::ssize(blocks_), block_grain, [&](std::int64_t begin, std::int64_t end) {
      std::vector<std::int32_t> found;
      for (std::int64_t i = begin; i < end; ++i) {
        for_elements(blocks_[static_cast<std::size_t>(i)],
                     [&](const Triangle& element, double /*before*/, double worsened) {
                       if (worsened < threshold) {
                         std::ranges::copy_if(element, std::back_inserter(found),
                                              [&](std::int32_t v) { return has_moved(v) && list(v); });
                       }
                     });
      }
      const std::lock_guard lock(joining);
      offenders_.insert(offenders_.end(), found.begin(), found.end());
    });
  }

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
      blocks_.push_back(v / vertices_a_block);
      for (const std::int32_t neighbour : rings_[v]) {
        if (neighbour < rings_.size()) {
          blocks_.push_back(neighbour / vertices_a_block);
        }
      }
    }
    std::ranges::sort(blocks_);
    blocks_.erase(std::unique(blocks_.begin(), blocks_.end()), blocks_.end());
    workers_.for_blocks(std::ssize(blocks_), block_grain, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i < end; ++i) {
        measure(blocks_[static_cast<std::size_t>(i)]);
      }
    });
    tree_.update(blocks_);
  }

  const RingView& rings_;
  std::span<const Point2<double>> before_;
  std::span<Point2<double>> after_;
  Workers& workers_;
  std::int64_t block_count_;
  GuardTree tree_;
  std::vector<std::int32_t> blocks_;     ///< of this round: with an offender, then with elements that changed
  std::vector<std::uint8_t> listed_;     ///< per vertex: 1 where it has gone back
  std::vector<std::int32_t> offenders_;  ///< of this round
};

}  // namespace

GuardOutcome keep_never_worse(const RingView& rings, std::span<const Point2<double>> before,
                              std::span<Point2<double>> after, Workers& workers) {
  return Guard(rings, before, after, workers).run();
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
