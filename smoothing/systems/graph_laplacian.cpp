// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/systems/graph_laplacian.h"

#include <cstddef>
#include <utility>

namespace trismooth {

namespace {

/// A graph of no more unknowns is not made coarser.
constexpr std::int32_t few_unknowns = 64;

/// Strong links: those that groups are made along.
class StrongLinks {
 public:
  explicit StrongLinks(const WeightedGraph& graph) : graph_(graph) {}

  /// Calls visit(u, weight).
  template <class Visit>
  void for_each(std::int32_t v, const Visit& visit) const {
    for (std::int64_t i = graph_.offsets[v]; i < graph_.offsets[v + 1]; ++i) {
      const std::int32_t u = graph_.linked[i];
      const double weight = graph_.weights[i];
      if (weight > 0 && weight * weight > strong * strong * graph_.diagonal[v] * graph_.diagonal[u]) {
        visit(u, weight);
      }
    }
  }

 private:
  static constexpr double strong = 0.08;

  const WeightedGraph& graph_;
};

struct Groups {
  std::vector<std::int32_t> of_unknown;
  std::int32_t count = 0;
};

Groups groups_of(const WeightedGraph& graph) {
  const StrongLinks strong(graph);
  constexpr std::int32_t none = -1;
  Groups groups{std::vector<std::int32_t>(graph.diagonal.size(), none), 0};
  // Who is free with all it is strongly linked with makes a group of them.
  for (std::int32_t v = 0; v < graph.size(); ++v) {
    bool is_open = groups.of_unknown[v] == none;
    strong.for_each(v, [&](std::int32_t u, double /*weight*/) { is_open = is_open && groups.of_unknown[u] == none; });
    if (is_open) {
      groups.of_unknown[v] = groups.count;
      strong.for_each(v, [&](std::int32_t u, double /*weight*/) { groups.of_unknown[u] = groups.count; });
      ++groups.count;
    }
  }
  // The others join the group that they are linked with most strongly, or are one by themselves.
  const std::vector<std::int32_t> first = groups.of_unknown;
  for (std::int32_t v = 0; v < graph.size(); ++v) {
    if (first[v] != none) {
      continue;
    }
    double strongest = 0;
    strong.for_each(v, [&](std::int32_t u, double weight) {
      if (first[u] != none && weight > strongest) {
        strongest = weight;
        groups.of_unknown[v] = first[u];
      }
    });
    if (groups.of_unknown[v] == none) {
      groups.of_unknown[v] = groups.count++;
    }
  }
  return groups;
}

/// Collects a row whose unknowns come in any order, several times each.
class RowSum {
 public:
  explicit RowSum(std::int32_t unknowns) : place_(static_cast<std::size_t>(unknowns), none) {}

  void add(std::int32_t unknown, double weight) {
    if (place_[unknown] == none) {
      place_[unknown] = static_cast<std::int32_t>(unknowns_.size());
      unknowns_.push_back(unknown);
      weights_.push_back(0);
    }
    weights_[place_[unknown]] += weight;
  }

  /// Calls visit(unknown, weight) in the order in which unknowns came first, and is empty again.
  template <class Visit>
  void take(const Visit& visit) {
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
      visit(unknowns_[i], weights_[i]);
      place_[unknowns_[i]] = none;
    }
    unknowns_.clear();
    weights_.clear();
  }

 private:
  static constexpr std::int32_t none = -1;

  std::vector<std::int32_t> place_;
  std::vector<std::int32_t> unknowns_;
  std::vector<double> weights_;
};

/// What each unknown gets of the answers of the groups: that of its own, smoothed once along strong links.
WeightedRows spread_of(const WeightedGraph& graph, const Groups& groups) {
  const StrongLinks strong(graph);
  WeightedRows spread;
  RowSum row(groups.count);
  for (std::int32_t v = 0; v < graph.size(); ++v) {
    double of_strong = 0;
    double of_all = 0;
    strong.for_each(v, [&](std::int32_t /*u*/, double weight) { of_strong += weight; });
    for (std::int64_t i = graph.offsets[v]; i < graph.offsets[v + 1]; ++i) {
      of_all += graph.weights[i];
    }
    // Weak links count as if what they lead to were equal.
    const double diagonal = graph.diagonal[v] - (of_all - of_strong);
    constexpr double damping = 0.8;
    if (diagonal > 0) {
      row.add(groups.of_unknown[v], 1 - damping);
      strong.for_each(
          v, [&](std::int32_t u, double weight) { row.add(groups.of_unknown[u], damping * weight / diagonal); });
    } else {
      row.add(groups.of_unknown[v], 1);
    }
    row.take([&](std::int32_t group, double weight) {
      spread.unknowns.push_back(group);
      spread.weights.push_back(weight);
    });
    spread.offsets.push_back(std::ssize(spread.unknowns));
  }
  return spread;
}

WeightedRows transposed(const WeightedRows& rows, std::int32_t unknowns) {
  WeightedRows columns;
  columns.offsets.assign(static_cast<std::size_t>(unknowns) + 1, 0);
  for (const std::int32_t unknown : rows.unknowns) {
    ++columns.offsets[unknown + 1];
  }
  for (std::int32_t unknown = 0; unknown < unknowns; ++unknown) {
    columns.offsets[unknown + 1] += columns.offsets[unknown];
  }
  columns.unknowns.resize(rows.unknowns.size());
  columns.weights.resize(rows.weights.size());
  std::vector<std::int64_t> next(columns.offsets.begin(), columns.offsets.end() - 1);
  for (std::int32_t row = 0; row < rows.size(); ++row) {
    for (std::int64_t i = rows.offsets[row]; i < rows.offsets[row + 1]; ++i) {
      const std::int64_t place = next[rows.unknowns[i]]++;
      columns.unknowns[place] = row;
      columns.weights[place] = rows.weights[i];
    }
  }
  return columns;
}

/// The graph seen by the groups.
WeightedGraph gathered(const WeightedGraph& graph, const WeightedRows& spread, const WeightedRows& gather) {
  WeightedGraph coarse;
  RowSum row(gather.size());
  const auto add = [&](std::int32_t v, double weight) {
    for (std::int64_t i = spread.offsets[v]; i < spread.offsets[v + 1]; ++i) {
      row.add(spread.unknowns[i], weight * spread.weights[i]);
    }
  };
  for (std::int32_t group = 0; group < gather.size(); ++group) {
    for (std::int64_t m = gather.offsets[group]; m < gather.offsets[group + 1]; ++m) {
      const std::int32_t v = gather.unknowns[m];
      add(v, gather.weights[m] * graph.diagonal[v]);
      for (std::int64_t i = graph.offsets[v]; i < graph.offsets[v + 1]; ++i) {
        add(graph.linked[i], -gather.weights[m] * graph.weights[i]);
      }
    }
    coarse.diagonal.push_back(0);
    row.take([&](std::int32_t other, double value) {
      if (other == group) {
        coarse.diagonal.back() = value;
      } else {
        coarse.linked.push_back(other);
        coarse.weights.push_back(-value);
      }
    });
    coarse.offsets.push_back(std::ssize(coarse.linked));
  }
  return coarse;
}

}  // namespace

GraphLaplacian::GraphLaplacian(WeightedGraph graph) {
  levels_.push_back({std::move(graph), {}, {}});
  while (levels_.back().graph.size() > few_unknowns) {
    Level& fine = levels_.back();
    const Groups groups = groups_of(fine.graph);
    if (4 * std::int64_t{groups.count} > 3 * std::int64_t{fine.graph.size()}) {
      break;
    }
    fine.spread = spread_of(fine.graph, groups);
    fine.gather = transposed(fine.spread, groups.count);
    WeightedGraph coarse = gathered(fine.graph, fine.spread, fine.gather);
    levels_.push_back({std::move(coarse), {}, {}});
  }
}

std::vector<LevelView> GraphLaplacian::view() const {
  std::vector<LevelView> levels;
  for (const Level& level : levels_) {
    levels.push_back({level.graph.view(), level.spread.view(), level.gather.view()});
  }
  return levels;
}

}  // namespace trismooth
