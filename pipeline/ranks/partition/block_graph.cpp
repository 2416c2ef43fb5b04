// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/partition/block_graph.h"

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>

namespace trismooth {

namespace {

/// How much two blocks have in common, or where they are the same, how much a block has.
struct Weight {
  std::int32_t first;
  std::int32_t second;
  std::int64_t weight;
};

/// Each pair once, with all that is said of it.
void join(std::vector<Weight>& weights) {
  std::ranges::sort(weights, {}, [](const Weight& w) { return std::tuple(w.first, w.second); });
  std::size_t end = 0;
  for (const Weight& w : weights) {
    if (end > 0 && weights[end - 1].first == w.first && weights[end - 1].second == w.second) {
      weights[end - 1].weight += w.weight;
    } else {
      weights[end++] = w;
    }
  }
  weights.resize(end);
}

std::vector<Weight> own_weights(std::span<const std::int32_t> block_of, const ElementList& elements,
                                std::span<const std::uint8_t> is_copy) {
  const std::int32_t blocks = block_of.empty() ? 0 : *std::ranges::max_element(block_of) + 1;
  std::vector<std::int64_t> counts(static_cast<std::size_t>(blocks), 0);
  for (const std::int32_t block : block_of) {
    ++counts[static_cast<std::size_t>(block)];
  }
  std::vector<Weight> weights;
  for (std::int32_t block = 0; block < blocks; ++block) {
    if (counts[static_cast<std::size_t>(block)] > 0) {
      weights.push_back({block, block, counts[static_cast<std::size_t>(block)]});
    }
  }
  for (std::size_t t = 0; t < elements.size(); ++t) {
    if (!is_copy.empty() && is_copy[t] != 0) {
      continue;
    }
    const std::span<const std::int32_t> corners = elements[t];
    for (std::size_t corner = 0; corner < corners.size(); ++corner) {
      const std::int32_t a = block_of[static_cast<std::size_t>(corners[corner])];
      const std::int32_t b = block_of[static_cast<std::size_t>(next_corner(corners, corner))];
      if (a != b) {
        weights.push_back({a, b, 1});
        weights.push_back({b, a, 1});
      }
    }
  }
  join(weights);
  return weights;
}

}  // namespace

BlockGraph graph_of_blocks(std::span<const std::int32_t> block_of, const ElementList& elements,
                           std::span<const std::uint8_t> is_copy, const mpi::Communicator& ranks) {
  auto sent = mpi::lists_by_rank<Weight>(ranks);
  sent[0] = own_weights(block_of, elements, is_copy);
  std::vector<Weight> weights;
  for (const auto& list : ranks.exchanged(std::move(sent))) {
    weights.insert(weights.end(), list.begin(), list.end());
  }
  join(weights);
  BlockGraph graph;
  for (const Weight& w : weights) {
    if (w.first == w.second) {
      graph.blocks.push_back(w.first);
      graph.weights.push_back(w.weight);
    }
  }
  graph.offsets.assign(graph.blocks.size() + 1, 0);
  for (const Weight& w : weights) {
    const auto place = [&](std::int32_t block) {
      return std::ranges::lower_bound(graph.blocks, block) - graph.blocks.begin();
    };
    if (w.first != w.second) {
      graph.neighbours.push_back(static_cast<std::int32_t>(place(w.second)));
      graph.edges_between.push_back(w.weight);
      ++graph.offsets[static_cast<std::size_t>(place(w.first)) + 1];
    }
  }
  for (std::size_t i = 0; i < graph.blocks.size(); ++i) {
    graph.offsets[i + 1] += graph.offsets[i];
  }
  return graph;
}

}  // namespace trismooth
