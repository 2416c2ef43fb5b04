// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/slide/chain_runs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <numeric>
#include <utility>

#include "trismooth/base/number_lists.h"
#include "trismooth/smoothing/slide/touching_lines.h"

namespace trismooth {

namespace {

/// Vertices that slide as one, by union-find.
class VertexGroups {
 public:
  explicit VertexGroups(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0); }

  std::int32_t of(std::int32_t v) {
    while (parents_[v] != v) {
      v = parents_[v] = parents_[static_cast<std::size_t>(parents_[v])];
    }
    return v;
  }
  void join(std::int32_t a, std::int32_t b) {
    any_ = true;
    const auto [low, high] = std::minmax({of(a), of(b)});
    parents_[high] = low;
  }

  /// Whether any were joined.
  bool any() const { return any_; }

 private:
  std::vector<std::int32_t> parents_;
  bool any_ = false;
};

class RunFinder {
 public:
  RunFinder(const Slidable& slidable, const SlideMesh& mesh)
      : slidable_(slidable),
        mesh_(mesh),
        sharpest_cosine_(std::cos(slidable.corner_angle * (std::numbers::pi / 180))),
        slides_(slidable.vertices.size()),
        groups_(slidable.vertices.size()),
        run_of_(slidable.vertices.size()) {}

  ChainRuns run() {
    for (std::int32_t v = 0; v < slidable_.vertex_count(); ++v) {
      slides_[v] = slidable_.may_slide(v) && !is_corner(v) ? 1 : 0;
    }
    if (std::ranges::find(slides_, 1) != slides_.end()) {
      link();
    }
    if (groups_.any()) {
      std::vector<std::pair<std::int32_t, std::int32_t>> members;
      for (std::int32_t v = 0; v < slidable_.vertex_count(); ++v) {
        members.emplace_back(groups_.of(v), v);
      }
      members_ = NumberLists(0, slidable_.vertex_count(), members);
    }
    std::vector<std::uint8_t> would_slide = slides_;
    do {
      find_runs();
    } while (!match_runs());
    for (const auto& [a, b] : together_) {
      count_unless_matched(a, would_slide);
      count_unless_matched(b, would_slide);
    }
    ChainRuns found;
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      if (first_of_run_[r] == static_cast<std::int32_t>(r)) {
        found.runs.push_back({std::move(runs_[r]), std::move(copies_[r])});
      }
    }
    found.slides = std::move(slides_);
    found.held = held_;
    return found;
  }

 private:
  Point2<double> point(std::int32_t v) const { return mesh_.points[v]; }
  double rounding(std::int32_t v) const { return mesh_.roundings[v]; }
  bool slides(std::int32_t v) const { return slides_[v] != 0; }
  void hold(std::int32_t v) { slides_[v] = 0; }
  /// Counts it where it would slide.
  void hold(std::int32_t v, std::int64_t& count) {
    count += slides(v) ? 1 : 0;
    hold(v);
  }
  const std::array<std::int32_t, 2>& neighbours(std::int32_t v) const { return slidable_.neighbours[v]; }

  /// Whether the chain turns too much.
  bool is_corner(std::int32_t v) const {
    const auto [a, b] = neighbours(v);
    const Point2<double> in = point(v) - point(a);
    const Point2<double> out = point(b) - point(v);
    const double lengths = std::sqrt(squared_length(in)) * std::sqrt(squared_length(out));
    const double forward = in.x * out.x + in.y * out.y;
    if (!(lengths > 0) || forward < sharpest_cosine_ * lengths) {
      return true;
    }
    if (slidable_.along == Slide::curves) {
      return false;
    }
    return !is_straight(point(a), point(v), point(b), std::max({rounding(a), rounding(v), rounding(b)}));
  }

  /// Joins what slides as one, and holds what may not slide for what it is joined with.
  void link() {
    for (const auto& [a, b] : slidable_.links) {
      if (a != Slidable::none && b != Slidable::none) {
        groups_.join(a, b);
      } else {
        hold(a != Slidable::none ? a : b);
      }
    }
    const TouchingLines touching = find_touching_lines(slidable_, mesh_.points);
    for (const auto& [a, b] : touching.together) {
      // (The same part of an edge of two splines that differ may be farther apart than their vertices.)
      if (slidable_.coincident && (slidable_.curve == SlideCurve::polyline || point(a) == point(b))) {
        groups_.join(a, b);
        together_.push_back({a, b});
      } else {
        hold(a, held_.in_same_place);
        hold(b, held_.in_same_place);
      }
    }
    for (std::int32_t v = 0; v < slidable_.vertex_count(); ++v) {
      if (touching.at_edges[v] != 0) {
        hold(v, held_.at_edges);
      }
    }
  }

  /// Counts a vertex in the place of another that does not slide for that, once.
  void count_unless_matched(std::int32_t v, std::vector<std::uint8_t>& would_slide) {
    const bool would = std::exchange(would_slide[v], std::uint8_t{0}) != 0;
    held_.in_same_place += would && !slides(v) ? 1 : 0;
  }

  void find_runs() {
    runs_.clear();
    std::ranges::fill(run_of_, Slidable::none);
    for (std::int32_t v = 0; v < slidable_.vertex_count(); ++v) {
      if (slides(v) && run_of_[v] == Slidable::none) {
        add_run(v);
      }
    }
  }

  void add_run(std::int32_t v) {
    ChainRun run;
    run.vertices = walk(v, neighbours(v)[0]);
    run.is_closed = run.vertices.back() == v;
    if (run.is_closed) {
      std::rotate(run.vertices.begin(), run.vertices.end() - 1, run.vertices.end());
    } else {
      std::ranges::reverse(run.vertices);
      run.vertices.push_back(v);
      const std::vector<std::int32_t> on = walk(v, neighbours(v)[1]);
      run.vertices.insert(run.vertices.end(), on.begin(), on.end());
      // So that it is the same from wherever it was found.
      if (run.vertices.front() > run.vertices.back()) {
        std::ranges::reverse(run.vertices);
      }
    }
    for (std::size_t i = run.begin(); i < run.end(); ++i) {
      run_of_[run.vertices[i]] = static_cast<std::int32_t>(runs_.size());
    }
    runs_.push_back(std::move(run));
  }

  /// The vertices from `next` on, away from v, up to one that does not slide or to v itself.
  std::vector<std::int32_t> walk(std::int32_t v, std::int32_t next) const {
    std::vector<std::int32_t> found{next};
    for (std::int32_t last = v; next != v && slides(next);) {
      const auto [a, b] = neighbours(next);
      last = std::exchange(next, a == last ? b : a);
      found.push_back(next);
    }
    return found;
  }

  /// Puts runs together that are linked vertex by vertex. False where some are so in part: their vertices are held
  /// then, and runs are to be found again.
  bool match_runs() {
    first_of_run_.resize(runs_.size());
    std::iota(first_of_run_.begin(), first_of_run_.end(), 0);
    copies_.assign(runs_.size(), {});
    std::vector<std::int32_t> faulty;
    for (const ChainRun& run : runs_) {
      add_ends_of_tiny_segments(run, faulty);
    }
    if (groups_.any()) {
      add_partly_held_groups(faulty);
      const bool is_sound = faulty.empty();
      std::ranges::fill(first_of_run_, Slidable::none);
      // (All that slide have a run, and so have those in their groups, where nothing is faulty so far.)
      for (std::size_t r = 0; is_sound && r < runs_.size(); ++r) {
        match(static_cast<std::int32_t>(r), faulty);
      }
    }
    for (const std::int32_t v : faulty) {
      hold(v);
    }
    return faulty.empty();
  }

  /// Those that slide of groups in which others do not.
  void add_partly_held_groups(std::vector<std::int32_t>& found) {
    for (std::int32_t v = 0; v < slidable_.vertex_count(); ++v) {
      const std::span<const std::int32_t> group = members_[v];
      if (!std::ranges::all_of(group, [this](std::int32_t member) { return slides(member); })) {
        std::ranges::copy_if(group, std::back_inserter(found),
                             [&](std::int32_t member) { return group.size() > 1 && slides(member); });
      }
    }
  }

  /// Those that slide of vertices at segments so much shorter than their run that places on them would have few digits.
  void add_ends_of_tiny_segments(const ChainRun& run, std::vector<std::int32_t>& found) const {
    const std::size_t segments = run.is_closed ? run.vertices.size() : run.vertices.size() - 1;
    const auto vertex = [&](std::size_t i) { return run.vertices[i % run.vertices.size()]; };
    const auto length = [&](std::size_t i) {
      return std::sqrt(squared_length(point(vertex(i + 1)) - point(vertex(i))));
    };
    double all = 0;
    for (std::size_t i = 0; i < segments; ++i) {
      all += length(i);
    }
    for (std::size_t i = 0; i < segments; ++i) {
      if (!(length(i) > 0x1p-30 * all)) {
        std::ranges::copy_if(std::array{vertex(i), vertex(i + 1)}, std::back_inserter(found),
                             [this](std::int32_t v) { return slides(v); });
      }
    }
  }

  std::span<const std::int32_t> group_of(std::int32_t v) { return members_[groups_.of(v)]; }

  /// Finds the copies of a run, turned as it is.
  void match(std::int32_t r, std::vector<std::int32_t>& faulty) {
    const ChainRun& run = runs_[r];
    if (first_of_run_[r] != Slidable::none) {
      return;
    }
    first_of_run_[r] = r;
    const std::int32_t start = run.vertices[run.begin()];
    const std::size_t group_size = group_of(start).size();
    for (const std::int32_t member : group_of(start)) {
      if (member == start) {
        continue;
      }
      const std::int32_t other = run_of_[member];
      ChainRun copy = runs_[other];
      if (other == r || first_of_run_[other] != Slidable::none || !turn_alike(run, copy)) {
        faulty.insert(faulty.end(), run.vertices.begin() + static_cast<std::ptrdiff_t>(run.begin()),
                      run.vertices.begin() + static_cast<std::ptrdiff_t>(run.end()));
        return;
      }
      first_of_run_[other] = r;
      copies_[r].push_back(std::move(copy));
    }
    for (std::size_t i = run.begin(); i < run.end(); ++i) {
      if (group_of(run.vertices[i]).size() != group_size) {
        faulty.push_back(run.vertices[i]);
      }
    }
  }

  /// Turns `copy` so that its vertices are in the groups of those of `run`, one after the other. False: they are not.
  bool turn_alike(const ChainRun& run, ChainRun& copy) {
    if (copy.is_closed != run.is_closed || copy.vertices.size() != run.vertices.size()) {
      return false;
    }
    const auto alike = [&] {
      for (std::size_t i = run.begin(); i < run.end(); ++i) {
        if (groups_.of(run.vertices[i]) != groups_.of(copy.vertices[i])) {
          return false;
        }
      }
      // (Vertices next to ends slide on the edges there.)
      return groups_.of(run.vertices.front()) == groups_.of(copy.vertices.front()) &&
             groups_.of(run.vertices.back()) == groups_.of(copy.vertices.back());
    };
    for (int direction = 0; direction < 2; ++direction) {
      if (copy.is_closed) {
        const auto start = std::ranges::find_if(
            copy.vertices, [&](std::int32_t v) { return groups_.of(v) == groups_.of(run.vertices.front()); });
        std::rotate(copy.vertices.begin(), start, copy.vertices.end());
      }
      if (alike()) {
        return true;
      }
      std::ranges::reverse(copy.vertices);
    }
    return false;
  }

  const Slidable& slidable_;
  const SlideMesh& mesh_;
  double sharpest_cosine_;  ///< of the turns that are no corners
  std::vector<std::uint8_t> slides_;
  HeldTouching held_;
  std::vector<std::array<std::int32_t, 2>> together_;  ///< joined since they are in the same place
  VertexGroups groups_;
  NumberLists members_;  ///< of each group, where there are any
  std::vector<ChainRun> runs_;
  std::vector<std::int32_t> run_of_;           ///< of each vertex that slides
  std::vector<std::int32_t> first_of_run_;     ///< the run that each is a copy of, maybe itself
  std::vector<std::vector<ChainRun>> copies_;  ///< of each run that is no copy
};

}  // namespace

bool is_straight(Point2<double> before, Point2<double> vertex, Point2<double> after, double rounding) {
  const Point2<double> in = vertex - before;
  const Point2<double> out = after - vertex;
  const Point2<double> chord = after - before;
  return in.x * out.x + in.y * out.y > 0 && std::abs(cross(in, chord)) <= rounding * std::sqrt(squared_length(chord));
}

ChainRuns find_chain_runs(const Slidable& slidable, const SlideMesh& mesh) {
  return RunFinder(slidable, mesh).run();
}

}  // namespace trismooth
