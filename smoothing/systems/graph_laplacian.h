// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "trismooth/smoothing/systems/graph_view.h"

namespace trismooth {

/// A symmetric matrix of unknowns that hang together by weights: see GraphView.
struct WeightedGraph {
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int32_t> linked;
  std::vector<double> weights;  ///< the same from both sides
  std::vector<double> diagonal;

  std::int32_t size() const { return static_cast<std::int32_t>(diagonal.size()); }
  GraphView view() const { return {offsets.data(), linked.data(), weights.data(), diagonal.data(), size()}; }
};

/// Rows of weighted sums of unknowns.
struct WeightedRows {
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int32_t> unknowns;
  std::vector<double> weights;

  std::int32_t size() const { return static_cast<std::int32_t>(offsets.size()) - 1; }
  RowsView view() const { return {offsets.data(), unknowns.data(), weights.data(), size()}; }
};

/// Such a matrix with coarser and coarser ones, by which solve() finds what many unknowns have in common: what is
/// linked strongly is taken together, and answers of the groups are smoothed when they are spread over their members
/// (P. Vanek, J. Mandel, M. Brezina: Algebraic multigrid by smoothed aggregation for second and fourth order elliptic
/// problems, 1996).
class GraphLaplacian {
 public:
  struct Level {
    WeightedGraph graph;
    WeightedRows spread;  ///< by unknown: its answer out of those of the next level; no rows: this is the last level
    WeightedRows gather;  ///< the other way round
  };

  /// Of no unknowns.
  GraphLaplacian() : GraphLaplacian(WeightedGraph()) {}
  /// Weights are above 0, and every part of the graph is tied to something known: its diagonals are above the sums of
  /// its weights somewhere. Complexity: linear.
  explicit GraphLaplacian(WeightedGraph graph);

  /// The graph itself and coarser ones.
  const std::vector<Level>& levels() const { return levels_; }
  const WeightedGraph& graph() const { return levels_.front().graph; }

  /// For solve(), on the host.
  std::vector<LevelView> view() const;

 private:
  std::vector<Level> levels_;
};

}  // namespace trismooth
