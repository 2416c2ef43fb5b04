// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/slide/slide_chains.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

#include "trismooth/base/number_lists.h"
#include "trismooth/smoothing/slide/chain_runs.h"

namespace trismooth {

namespace {

/// Writes runs down as chains.
class ChainWriter {
 public:
  ChainWriter(const Slidable& slidable, const SlideElements& elements, const SlideMesh& mesh, const ChainRuns& runs)
      : slidable_(slidable), elements_(elements), mesh_(mesh), runs_(runs) {}

  SlideChains run() {
    chains_.curve = slidable_.curve;
    chains_.elements = &elements_;
    chains_.held = runs_.held;
    make_room();
    for (const LinkedRuns& linked : runs_.runs) {
      write_chain(linked.first, linked.others);
    }
    chains_.fan_at = chains_.vertices;
    order_by_colour();
    return std::move(chains_);
  }

 private:
  /// (Growing takes as long as all the rest.)
  void make_room() {
    std::size_t knots = 0;
    const auto count = [&](const ChainRun& run) { knots += run.vertices.size(); };
    for (const LinkedRuns& linked : runs_.runs) {
      count(linked.first);
      std::ranges::for_each(linked.others, count);
    }
    for (const auto room : {&SlideChains::arcs, &SlideChains::lengths, &SlideChains::limits, &SlideChains::allowed}) {
      (chains_.*room).reserve(knots);
    }
    chains_.knots.reserve(knots);
    chains_.vertices.reserve(knots);
    chains_.bends.reserve(knots);
    chains_.places.reserve(knots);
    chains_.sliders.reserve(knots);
  }

  Point2<double> point(std::int32_t v) const { return mesh_.points[v]; }
  double rounding(std::int32_t v) const { return mesh_.roundings[v]; }
  bool slides(std::int32_t v) const { return runs_.slides[v] != 0; }
  bool is_free(std::int32_t v) const { return slidable_.is_free[v] != 0; }

  void write_chain(const ChainRun& run, std::span<const ChainRun> copies) {
    const auto count = static_cast<std::int32_t>(run.vertices.size());
    SlideChain chain{static_cast<std::int32_t>(chains_.knots.size()), count,
                     static_cast<std::int32_t>(copies.size()) + 1, run.is_closed, 0};
    const auto number = static_cast<std::int32_t>(chains_.chains.size());
    add_knots(run);
    for (const ChainRun& copy : copies) {
      add_knots(copy);
    }
    const auto knot = [&](std::int32_t i) { return chains_.knots[chain.first + i % count]; };
    const auto length = [&](std::int32_t i) { return std::sqrt(squared_length(knot(i + 1) - knot(i))); };
    const std::int32_t segments = run.is_closed ? count : count - 1;
    for (std::int32_t i = 0; i < count; ++i) {
      chains_.arcs.push_back(chain.length);
      const double nearby = shortest_around(run, copies, static_cast<std::size_t>(i));
      const double allowed = slidable_.along == Slide::curves ? slidable_.deviation * nearby : 0;
      const double rounded = rounding_around(run, copies, static_cast<std::size_t>(i));
      chains_.lengths.push_back(nearby);
      chains_.bends.push_back(bends(run, copies, static_cast<std::size_t>(i), rounded) ? 1 : 0);
      chains_.limits.push_back(std::max(allowed - rounded, 2 * rounded));
      chains_.allowed.push_back(std::max(allowed, 3 * rounded));
      chains_.places.push_back({chain.length, run.is_closed || i < segments ? i : i - 1});
      chain.length += i < segments ? length(i) : 0;
      if (run.is_closed || (i > 0 && i < segments)) {
        chains_.sliders.push_back({number, chain.first + i});
      }
    }
    chains_.arcs.resize(chains_.knots.size());
    chains_.lengths.resize(chains_.knots.size());
    chains_.bends.resize(chains_.knots.size());
    chains_.limits.resize(chains_.knots.size());
    chains_.allowed.resize(chains_.knots.size());
    chains_.places.resize(chains_.knots.size());
    chains_.chains.push_back(chain);
  }

  /// Whether a run or one of its copies bends at that vertex; not at an end.
  bool bends(const ChainRun& run, std::span<const ChainRun> copies, std::size_t i, double rounded) const {
    const auto bends_at = [&](const ChainRun& of) {
      const std::size_t count = of.vertices.size();
      const auto at = [&](std::size_t place) { return point(of.vertices[place % count]); };
      return !is_straight(at(i + count - 1), at(i), at(i + 1), rounded);
    };
    const bool is_end = !run.is_closed && (i == 0 || i + 1 == run.vertices.size());
    return !is_end && (bends_at(run) || std::ranges::any_of(copies, bends_at));
  }

  /// How far rounding may have brought a vertex of a run, those next to it, and those of the copies.
  double rounding_around(const ChainRun& run, std::span<const ChainRun> copies, std::size_t i) const {
    double largest = 0;
    const auto look = [&](const ChainRun& of) {
      const std::size_t count = of.vertices.size();
      const std::size_t before = i > 0 ? i - 1 : (of.is_closed ? count - 1 : i);
      const std::size_t after = i + 1 < count ? i + 1 : (of.is_closed ? 0 : i);
      for (const std::size_t place : {before, i, after}) {
        largest = std::max(largest, rounding(of.vertices[place]));
      }
    };
    look(run);
    std::ranges::for_each(copies, look);
    return largest;
  }

  /// The length of the shortest edge at a vertex of a run or of the same one of its copies.
  double shortest_around(const ChainRun& run, std::span<const ChainRun> copies, std::size_t i) const {
    double shortest = std::numeric_limits<double>::infinity();
    const auto look = [&](const ChainRun& of) {
      const std::size_t count = of.vertices.size();
      const auto length = [&](std::size_t from, std::size_t to) {
        return std::sqrt(squared_length(point(of.vertices[to % count]) - point(of.vertices[from % count])));
      };
      if (of.is_closed || i > 0) {
        shortest = std::min(shortest, length(i + count - 1, i));
      }
      if (of.is_closed || i + 1 < count) {
        shortest = std::min(shortest, length(i, i + 1));
      }
    };
    look(run);
    std::ranges::for_each(copies, look);
    return shortest;
  }

  void add_knots(const ChainRun& run) {
    for (const std::int32_t v : run.vertices) {
      chains_.knots.push_back(point(v));
      chains_.vertices.push_back(v);
    }
  }

  /// Colours sliders that share an element, through any of their copies, differently: greedily, in the order of
  /// splitmix64(number in the mesh) of the first copy.
  void order_by_colour() {
    const auto slider_count = static_cast<std::int32_t>(chains_.sliders.size());
    // Which slider a vertex belongs to.
    std::vector<std::int32_t> slider_of(slidable_.vertices.size(), Slidable::none);
    for (std::int32_t s = 0; s < slider_count; ++s) {
      chains_.for_copies(chains_.sliders[s], [&](std::int32_t /*copy*/, std::int32_t v) { slider_of[v] = s; });
    }
    std::vector<std::int32_t> colours(chains_.sliders.size(), Slidable::none);
    std::vector<std::int32_t> sizes;  // of the colours
    std::vector<std::int32_t> taken;  // by colour: the last slider whose neighbours have it
    for (const std::int32_t v : slidable_.fans.colouring_order()) {
      const std::int32_t s = slider_of[v];
      if (s == Slidable::none || v != first_copy(s)) {
        continue;
      }
      taken.resize(sizes.size() + 1, Slidable::none);
      const Slider& slider = chains_.sliders[s];
      const auto take_colour_of = [&](std::int32_t other_vertex) {
        const std::int32_t other = slider_of[other_vertex];
        if (other != Slidable::none && colours[other] != Slidable::none) {
          taken[static_cast<std::size_t>(colours[other])] = s;
        }
      };
      chains_.for_sides(slider, [&](std::int32_t /*vertex*/, const FanSide& side) { side.for_each(take_colour_of); });
      const auto colour = static_cast<std::size_t>(
          std::ranges::find_if(taken, [s](std::int32_t by) { return by != s; }) - taken.begin());
      colours[s] = static_cast<std::int32_t>(colour);
      sizes.resize(std::max(sizes.size(), colour + 1), 0);
      ++sizes[colour];
    }
    chains_.batches.resize(sizes.size() + 1);
    std::partial_sum(sizes.begin(), sizes.end(), chains_.batches.begin() + 1);
    std::vector<std::int32_t> places = chains_.batches;
    std::vector<Slider> sorted(chains_.sliders.size());
    for (std::size_t s = 0; s < colours.size(); ++s) {
      sorted[static_cast<std::size_t>(places[colours[s]]++)] = chains_.sliders[s];
    }
    chains_.sliders = std::move(sorted);
  }

  std::int32_t first_copy(std::int32_t slider) const {
    return chains_.vertices[static_cast<std::size_t>(chains_.sliders[slider].knot)];
  }

  const Slidable& slidable_;
  const SlideElements& elements_;
  const SlideMesh& mesh_;
  const ChainRuns& runs_;
  SlideChains chains_;
};

}  // namespace

std::int64_t SlideChains::vertex_count() const {
  std::int64_t count = 0;
  for (const Slider& slider : sliders) {
    count += chains[slider.chain].copies;
  }
  return count;
}

SlidingResult SlideChains::result() const {
  return {.chains = std::ssize(chains),
          .vertices = vertex_count(),
          .in_same_place = held.in_same_place,
          .at_edges = held.at_edges};
}

void SlideChains::renumber(std::span<const std::int32_t> numbers, const SlideElements& renumbered) {
  for (std::int32_t& v : vertices) {
    v = numbers[v];
  }
  elements = &renumbered;
}

NumberLists SlideChains::neighbours(std::int32_t first, std::int32_t end) const {
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  for (const Slider& slider : sliders) {
    for_sides(slider, [&](std::int32_t v, const FanSide& side) {
      side.for_each([&](std::int32_t other) { pairs.emplace_back(v, other); });
    });
  }
  return {first, end, pairs};
}

SlideChains find_slide_chains(const Slidable& slidable, const SlideElements& elements, const SlideMesh& mesh) {
  return ChainWriter(slidable, elements, mesh, find_chain_runs(slidable, mesh)).run();
}

}  // namespace trismooth
