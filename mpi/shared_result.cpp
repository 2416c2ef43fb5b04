// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mpi/shared_result.h"

#include <string>
#include <vector>

namespace trismooth::mpi {

namespace {

/// The figures of a result. UntanglingResult without its list.
struct Figures {
  std::int64_t sweeps;
  std::int64_t vertex_updates;
  std::int64_t moved_vertices;
  std::int64_t reverted_vertices;
  std::int64_t guard_rounds;
  std::int64_t free_vertices;
  std::int64_t inverted;
  std::int64_t degenerate;
  std::int32_t colours;
  StopReason stop_reason;
  bool has_untangling;
  bool has_sliding;
  std::int64_t inverted_before;
  std::int64_t inverted_untangled;
  std::int64_t inverted_after;
  std::int64_t inverted_fixed;
  std::int32_t turned_components;
  SlidingResult sliding;
  LayersResult layers;
};

Figures figures_of(const SmoothingResult& result) {
  const UntanglingResult untangling = result.untangling.value_or(UntanglingResult{});
  return {result.sweeps,
          result.vertex_updates,
          result.moved_vertices,
          result.reverted_vertices,
          result.guard_rounds,
          result.free_vertices,
          result.inverted,
          result.degenerate,
          result.colours,
          result.stop_reason,
          result.untangling.has_value(),
          result.sliding.has_value(),
          untangling.inverted_before,
          untangling.inverted_untangled,
          untangling.inverted_after,
          untangling.inverted_fixed,
          untangling.turned_components,
          result.sliding.value_or(SlidingResult{}),
          result.layers};
}

void take(const Figures& figures, SmoothingResult& result) {
  result.sweeps = figures.sweeps;
  result.vertex_updates = figures.vertex_updates;
  result.moved_vertices = figures.moved_vertices;
  result.reverted_vertices = figures.reverted_vertices;
  result.guard_rounds = figures.guard_rounds;
  result.free_vertices = figures.free_vertices;
  result.inverted = figures.inverted;
  result.degenerate = figures.degenerate;
  result.colours = figures.colours;
  result.stop_reason = figures.stop_reason;
  if (figures.has_untangling) {
    result.untangling = UntanglingResult{figures.inverted_before, figures.inverted_untangled, figures.inverted_after,
                                         figures.inverted_fixed,  figures.turned_components,  {}};
  }
  if (figures.has_sliding) {
    result.sliding = figures.sliding;
  }
  result.layers = figures.layers;
}

void share_text(std::string& text, const Communicator& communicator) {
  std::vector<char> letters(text.begin(), text.end());
  communicator.broadcast(letters);
  text.assign(letters.begin(), letters.end());
}

}  // namespace

void share_result(SmoothingResult& result, const Communicator& communicator) {
  std::vector<Figures> figures{figures_of(result)};
  communicator.broadcast(figures);
  communicator.broadcast(result.history);
  share_text(result.backend, communicator);
  share_text(result.backend_note, communicator);
  if (communicator.rank() != 0) {
    take(figures.front(), result);
  }
}

void share_result(FollowResult& result, const Communicator& communicator) {
  share_result(result.smoothing, communicator);
  std::vector<double> numbers{result.min_relative_shape, result.mean_relative_shape, result.largest_move};
  communicator.broadcast(numbers);
  result.min_relative_shape = numbers[0];
  result.mean_relative_shape = numbers[1];
  result.largest_move = numbers[2];
  std::vector<std::int64_t> held{result.invalid_held};
  communicator.broadcast(held);
  result.invalid_held = held.front();
  communicator.broadcast(result.crossings);
  communicator.broadcast(result.overlaps);
  communicator.broadcast(result.invalid);
}

}  // namespace trismooth::mpi
