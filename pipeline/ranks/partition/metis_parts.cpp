// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/partition/metis_parts.h"

#include <stdexcept>

// The one place that knows whether the build has METIS.
#ifdef TRISMOOTH_HAS_METIS
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <new>
#include <numeric>

#include <metis.h>
#endif

namespace trismooth {

#ifdef TRISMOOTH_HAS_METIS

namespace {

/// Numbers as METIS takes them, whose sum is within its range: by a common divisor, and 1 at least.
std::vector<idx_t> scaled(const std::vector<std::int64_t>& numbers) {
  const std::int64_t most = std::numeric_limits<idx_t>::max() / 4;
  const std::int64_t sum = std::accumulate(numbers.begin(), numbers.end(), std::int64_t{0});
  const std::int64_t divisor = sum / (most - std::min(most - 1, std::ssize(numbers))) + 1;
  std::vector<idx_t> all;
  all.reserve(numbers.size());
  for (const std::int64_t number : numbers) {
    all.push_back(static_cast<idx_t>(std::max<std::int64_t>(1, number / divisor)));
  }
  return all;
}

}  // namespace

std::string metis_version() {
  return std::to_string(METIS_VER_MAJOR) + "." + std::to_string(METIS_VER_MINOR) + "." +
         std::to_string(METIS_VER_SUBMINOR);
}

std::vector<std::int32_t> metis_parts(const BlockGraph& graph, int parts) {
  constexpr std::size_t most_blocks_cut_again = 100000;  // the best of several cuts, where they are made quickly
  auto vertices = static_cast<idx_t>(graph.blocks.size());
  auto count = static_cast<idx_t>(parts);
  idx_t constraints = 1;
  std::vector<idx_t> offsets(graph.offsets.begin(), graph.offsets.end());
  std::vector<idx_t> neighbours(graph.neighbours.begin(), graph.neighbours.end());
  std::vector<idx_t> weights = scaled(graph.weights);
  std::vector<idx_t> edge_weights = scaled(graph.edges_between);
  std::array<idx_t, METIS_NOPTIONS> options{};
  METIS_SetDefaultOptions(options.data());
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_NCUTS] = graph.blocks.size() <= most_blocks_cut_again ? 4 : 1;
  std::vector<idx_t> part_of(graph.blocks.size());
  idx_t cut = 0;
  const int status =
      METIS_PartGraphKway(&vertices, &constraints, offsets.data(), neighbours.data(), weights.data(), nullptr,
                          edge_weights.data(), &count, nullptr, nullptr, options.data(), &cut, part_of.data());
  if (status == METIS_ERROR_MEMORY) {
    throw std::bad_alloc();
  }
  if (status != METIS_OK) {
    throw std::logic_error("METIS refuses the graph of blocks");
  }
  return {part_of.begin(), part_of.end()};
}

#else

std::string metis_version() {
  return {};
}

std::vector<std::int32_t> metis_parts(const BlockGraph& /*graph*/, int /*parts*/) {
  throw std::logic_error("this build has no METIS");
}

#endif

}  // namespace trismooth
