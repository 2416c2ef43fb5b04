#include "trismooth/smoothing/never_worse.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>

#include "trismooth/quality/triangle_view.h"

namespace trismooth {

namespace {

constexpr std::int64_t element_grain = 2048;

class Guard {
 public:
  Guard(const RingView& rings, std::span<const Point2<double>> before, std::span<Point2<double>> after,
        Workers& workers)
      : rings_(rings), before_(before), after_(after), workers_(workers) {}

  GuardOutcome run() {
    GuardOutcome outcome;
    suspect_.assign(static_cast<std::size_t>(rings_.size()), 0);
    offending_.assign(static_cast<std::size_t>(rings_.size()), 0);
    find_threshold();
    while (find_offenders()) {
      ++outcome.rounds;
      take_back(outcome.reverted);
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

  /// Calls `visit` for each element around the vertex until it answers false.
  template <class Visit>
  void for_elements(std::int32_t vertex, const Visit& visit) const {
    const auto ring = rings_[vertex];
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (!visit(Triangle{vertex, ring[i], ring[i + 1 == ring.size() ? 0 : i + 1]})) {
        return;
      }
    }
  }

  /// T, and every moved vertex is suspect to begin with.
  void find_threshold() {
    std::mutex joining;
    workers_.for_blocks(rings_.size(), element_grain, [&](std::int64_t begin, std::int64_t end) {
      double worst = std::numeric_limits<double>::infinity();
      for (auto v = static_cast<std::int32_t>(begin); v < end; ++v) {
        if (has_moved(v)) {
          suspect_[v] = 1;
          for_elements(v, [&](const Triangle& element) {
            worst = std::min(worst, quotient(before_, element));
            return true;
          });
        }
      }
      const std::lock_guard lock(joining);
      threshold_ = std::min(threshold_, worst);
    });
  }

  /// Marks the suspects that have an offending element; every moved vertex of such an element finds it by itself.
  bool find_offenders() {
    std::atomic<bool> found{false};
    workers_.for_blocks(rings_.size(), element_grain, [&](std::int64_t begin, std::int64_t end) {
      bool found_here = false;
      for (auto v = static_cast<std::int32_t>(begin); v < end; ++v) {
        if (suspect_[v] != 0) {
          suspect_[v] = 0;
          for_elements(v, [&](const Triangle& element) {
            const double after = quotient(after_, element);
            // Most elements are beyond reproach, whatever they were before.
            const bool offending =
                !(after > 0 && after >= threshold_) && offends(quotient(before_, element), after, threshold_);
            offending_[v] = offending ? 1 : 0;
            return !offending;
          });
          found_here = found_here || offending_[v] != 0;
        }
      }
      if (found_here) {
        found.store(true, std::memory_order_relaxed);
      }
    });
    return found;
  }

  /// Puts the offenders back; their elements have changed, so the moved neighbours are suspect next.
  void take_back(std::vector<std::int32_t>& reverted) {
    const auto first = static_cast<std::ptrdiff_t>(reverted.size());
    for (std::int32_t v = 0; v < rings_.size(); ++v) {
      if (offending_[v] != 0) {
        offending_[v] = 0;
        after_[v] = before_[v];
        reverted.push_back(v);
      }
    }
    for (auto v = reverted.begin() + first; v != reverted.end(); ++v) {
      for (const std::int32_t neighbour : rings_[*v]) {
        if (neighbour < rings_.size() && has_moved(neighbour)) {
          suspect_[neighbour] = 1;
        }
      }
    }
  }

  const RingView& rings_;
  std::span<const Point2<double>> before_;
  std::span<Point2<double>> after_;
  Workers& workers_;
  double threshold_ = std::numeric_limits<double>::infinity();
  std::vector<std::uint8_t> suspect_;
  std::vector<std::uint8_t> offending_;
};

}  // namespace

GuardOutcome keep_never_worse(const RingView& rings, std::span<const Point2<double>> before,
                              std::span<Point2<double>> after, Workers& workers) {
  return Guard(rings, before, after, workers).run();
}

}  // namespace trismooth
