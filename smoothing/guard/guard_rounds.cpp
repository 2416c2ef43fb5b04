#include "trismooth/smoothing/guard/guard_rounds.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "trismooth/base/workers.h"

namespace trismooth {

namespace {

/// Elements that a thread takes at a time.
constexpr std::int64_t element_grain = 4096;

/// Elements by a value, the smallest first. Values may be old: whoever takes one looks whether it still holds.
class ElementQueue {
 public:
  using Entry = std::pair<double, std::int32_t>;

  explicit ElementQueue(std::vector<Entry> entries) : entries_(std::move(entries)) {
    std::ranges::make_heap(entries_, std::greater<>());
  }

  bool empty() const { return entries_.empty(); }
  const Entry& first() const { return entries_.front(); }
  void drop_first() {
    std::ranges::pop_heap(entries_, std::greater<>());
    entries_.pop_back();
  }
  void add(const Entry& entry) {
    entries_.push_back(entry);
    std::ranges::push_heap(entries_, std::greater<>());
  }

 private:
  std::vector<Entry> entries_;
};

class GuardRounds {
 public:
  GuardRounds(std::int32_t vertex_count, std::span<const Triangle> elements, GuardedMesh& mesh, Workers& workers)
      : elements_(elements),
        mesh_(mesh),
        worsened_(elements.size(), infinity),
        starts_(static_cast<std::size_t>(vertex_count) + 1, 0),
        before_(evaluate(workers)),
        offending_(worsened_entries()) {
    list_elements();
  }

  GuardOutcome run() {
    GuardOutcome outcome;
    for (;;) {
      find_offenders(threshold());
      if (offenders_.empty()) {
        break;
      }
      ++outcome.rounds;
      take_back();
      outcome.reverted.insert(outcome.reverted.end(), offenders_.begin(), offenders_.end());
    }
    std::ranges::sort(outcome.reverted);
    return outcome;
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  bool is_touched(std::int32_t element) const {
    return std::ranges::any_of(elements_[static_cast<std::size_t>(element)],
                               [this](std::int32_t v) { return mesh_.has_moved(v); });
  }

  /// Evaluates the touched elements; their quotients before.
  std::vector<ElementQueue::Entry> evaluate(Workers& workers) {
    std::vector<double> before(elements_.size(), infinity);
    workers.for_blocks(std::ssize(elements_), element_grain, [&](std::int64_t begin, std::int64_t end) {
      for (auto e = static_cast<std::int32_t>(begin); e < static_cast<std::int32_t>(end); ++e) {
        if (is_touched(e)) {
          before[static_cast<std::size_t>(e)] = mesh_.quotient_before(e);
          worsened_[static_cast<std::size_t>(e)] = mesh_.worsened(e);
        }
      }
    });
    return below_infinity(before);
  }

  std::vector<ElementQueue::Entry> worsened_entries() const { return below_infinity(worsened_); }

  static std::vector<ElementQueue::Entry> below_infinity(const std::vector<double>& values) {
    std::vector<ElementQueue::Entry> entries;
    for (std::size_t e = 0; e < values.size(); ++e) {
      if (values[e] < infinity) {
        entries.emplace_back(values[e], static_cast<std::int32_t>(e));
      }
    }
    return entries;
  }

  /// Lists the elements of each moved vertex.
  void list_elements() {
    const auto for_moved_corners = [this](const auto& visit) {
      for (std::size_t e = 0; e < elements_.size(); ++e) {
        for (const std::int32_t v : elements_[e]) {
          if (mesh_.has_moved(v)) {
            visit(static_cast<std::size_t>(v), static_cast<std::int32_t>(e));
          }
        }
      }
    };
    for_moved_corners([this](std::size_t v, std::int32_t /*e*/) { ++starts_[v + 1]; });
    for (std::size_t v = 1; v < starts_.size(); ++v) {
      starts_[v] += starts_[v - 1];
    }
    around_.resize(static_cast<std::size_t>(starts_.back()));
    std::vector<std::int64_t> next(starts_.begin(), starts_.end() - 1);
    for_moved_corners([&](std::size_t v, std::int32_t e) { around_[static_cast<std::size_t>(next[v]++)] = e; });
  }

  /// The smallest quotient before of the elements that are touched now.
  double threshold() {
    while (!before_.empty() && !is_touched(before_.first().second)) {
      before_.drop_first();
    }
    return before_.empty() ? -infinity : before_.first().first;
  }

  /// The moved corners of the elements that offend, each once.
  void find_offenders(double threshold) {
    offenders_.clear();
    while (!offending_.empty() && offending_.first().first < threshold) {
      const auto [worsened, element] = offending_.first();
      offending_.drop_first();
      if (worsened == worsened_[static_cast<std::size_t>(element)]) {
        std::ranges::copy_if(elements_[static_cast<std::size_t>(element)], std::back_inserter(offenders_),
                             [this](std::int32_t v) { return mesh_.has_moved(v); });
      }
    }
    std::ranges::sort(offenders_);
    offenders_.erase(std::unique(offenders_.begin(), offenders_.end()), offenders_.end());
  }

  void take_back() {
    for (const std::int32_t v : offenders_) {
      mesh_.put_back(v);
    }
    std::vector<std::int32_t> changed;
    for (const std::int32_t vertex : offenders_) {
      const auto v = static_cast<std::size_t>(vertex);
      changed.insert(changed.end(), around_.begin() + starts_[v], around_.begin() + starts_[v + 1]);
    }
    std::ranges::sort(changed);
    changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
    for (const std::int32_t element : changed) {
      double& worsened = worsened_[static_cast<std::size_t>(element)];
      worsened = mesh_.worsened(element);
      if (worsened < infinity) {
        offending_.add({worsened, element});
      }
    }
  }

  std::span<const Triangle> elements_;
  GuardedMesh& mesh_;
  std::vector<double> worsened_;         ///< of every element, now
  std::vector<std::int64_t> starts_;     ///< vertex v has around_[starts_[v] .. starts_[v + 1])
  std::vector<std::int32_t> around_;     ///< the elements of each vertex that has moved
  ElementQueue before_;                  ///< touched elements by their quotient before
  ElementQueue offending_;               ///< elements that got worse, by what they were brought down to
  std::vector<std::int32_t> offenders_;  ///< of this round
};

}  // namespace

GuardOutcome guard_in_rounds(std::int32_t vertex_count, std::span<const Triangle> elements, GuardedMesh& mesh,
                             Workers& workers) {
  return GuardRounds(vertex_count, elements, mesh, workers).run();
}

}  // namespace trismooth
