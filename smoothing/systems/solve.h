// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "trismooth/smoothing/systems/conjugate_gradients.h"
#include "trismooth/smoothing/systems/graph_view.h"

namespace trismooth {

namespace solve_details {

inline constexpr double damping = 0.75;

/// Answers where all unknowns are 0 by then, damped.
struct FirstAnswer {
  GraphView graph;
  const Point2<double>* residual;
  Point2<double>* answer;

  TRISMOOTH_HOST_DEVICE void operator()(std::int32_t v) const {
    answer[v] = times(damping / graph.diagonal[v], residual[v]);
  }
};

/// Jacobi's, damped, all unknowns at once.
struct Relax {
  GraphView graph;
  const Point2<double>* residual;
  Point2<double>* answer;
  Point2<double>* next;

  TRISMOOTH_HOST_DEVICE void operator()(std::int32_t v) const {
    const Point2<double> left = residual[v] - graph.row_times(v, answer);
    next[v] = plus(answer[v], times(damping / graph.diagonal[v], left));
  }
  /// There and back, by turns.
  TRISMOOTH_HOST_DEVICE void operator()(int round, std::int32_t v) const {
    Relax{graph, residual, round % 2 == 0 ? answer : next, round % 2 == 0 ? next : answer}(v);
  }
};

struct Left {
  GraphView graph;
  const Point2<double>* residual;
  const Point2<double>* answer;
  Point2<double>* left;

  TRISMOOTH_HOST_DEVICE void operator()(std::int32_t v) const { left[v] = residual[v] - graph.row_times(v, answer); }
};

struct Gather {
  RowsView gather;
  const Point2<double>* fine;
  Point2<double>* coarse;

  TRISMOOTH_HOST_DEVICE void operator()(std::int32_t group) const { coarse[group] = gather.row_times(group, fine); }
};

struct Spread {
  RowsView spread;
  const Point2<double>* coarse;
  Point2<double>* fine;

  TRISMOOTH_HOST_DEVICE void operator()(std::int32_t v) const { fine[v] = plus(fine[v], spread.row_times(v, coarse)); }
};

struct Apply {
  GraphView graph;

  TRISMOOTH_HOST_DEVICE Point2<double> operator()(const Point2<double>* x, std::int32_t v) const {
    return graph.row_times(v, x);
  }
};

/// Answers to residuals by a cycle over the levels, with memory of its own for each.
template <class Rows>
class Cycle {
 public:
  Cycle(std::span<const LevelView> levels, Rows& rows) : levels_(levels), rows_(rows) {
    for (const LevelView& level : levels_) {
      const auto size = static_cast<std::size_t>(level.graph.size);
      // The finest has its residual from the caller.
      memory_.push_back({rows.template zeros<Point2<double>>(memory_.empty() ? 0 : size),
                         rows.template zeros<Point2<double>>(size), rows.template zeros<Point2<double>>(size)});
    }
  }

  /// All answers to all residuals.
  void operator()(const Point2<double>* residual, Point2<double>* answer) { descend(0, residual, answer); }

 private:
  using Array = typename Rows::template Array<Point2<double>>;

  struct Memory {
    Array residual;
    Array first;
    Array next;
  };

  /// `answer` may be the next array of the level.
  void descend(std::size_t level, const Point2<double>* residual, Point2<double>* answer) {
    const GraphView& graph = levels_[level].graph;
    Point2<double>* const first = memory_[level].first.data();
    Point2<double>* const next = memory_[level].next.data();
    if (level + 1 == levels_.size()) {
      constexpr int sweeps_of_last = 60;  // an even number: they end where they begin
      rows_.for_rows(graph.size, FirstAnswer{graph, residual, answer});
      rows_.in_rounds(sweeps_of_last, graph.size, Relax{graph, residual, answer, first});
      return;
    }
    rows_.for_rows(graph.size, FirstAnswer{graph, residual, first});
    rows_.for_rows(graph.size, Left{graph, residual, first, next});
    Memory& below = memory_[level + 1];
    rows_.for_rows(levels_[level].gather.size, Gather{levels_[level].gather, next, below.residual.data()});
    descend(level + 1, below.residual.data(), below.next.data());
    rows_.for_rows(graph.size, Spread{levels_[level].spread, below.next.data(), first});
    rows_.for_rows(graph.size, Relax{graph, residual, first, answer});
  }

  std::span<const LevelView> levels_;
  Rows& rows_;
  std::vector<Memory> memory_;
};

}  // namespace solve_details

/// Solves a system by conjugate gradients, preconditioned by a cycle over its levels, those of GraphLaplacian. The
/// number of steps hardly depends on that of the unknowns. `rows`: HostRows, or what has its functions; all memory is
/// where it works. `x`: zeros, and the solution then; `right_side` is lost. Ends where the norm of the error is
/// estimated to be `largest_error`: the root of the sum over links of weight times the square of how far the errors of
/// its ends differ. The same bits wherever it works. Complexity: linear in each of some ten steps.
template <class Rows>
void solve(std::span<const LevelView> levels, Point2<double>* x, Point2<double>* right_side, double largest_error,
           Rows& rows) {
  solve_details::Cycle<Rows> cycle(levels, rows);
  const auto precondition = [&](const Point2<double>* residual, Point2<double>* answer) { cycle(residual, answer); };
  const GraphView& graph = levels.front().graph;
  constexpr double unit = 1;
  constexpr int most_steps = 1000;
  conjugate_gradients(solve_details::Apply{graph}, precondition, graph.size, x, right_side, unit, largest_error,
                      most_steps, rows);
}

}  // namespace trismooth
