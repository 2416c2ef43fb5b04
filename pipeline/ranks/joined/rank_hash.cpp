// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/joined/rank_hash.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <utility>
#include <vector>

#include <mpi.h>

// The state of a hash under way goes from rank to rank: its size has to be known.
#define XXH_STATIC_LINKING_ONLY
#include <xxhash.h>

#include "trismooth/base/machine/release.h"
#include "trismooth/pipeline/ranks/row_exchange.h"

namespace trismooth {

namespace {

struct PlacedVertex {
  std::int64_t id;
  std::array<double, 3> place;
};

/// The vertices by blocks of ids, a block a rank.
std::vector<PlacedVertex> by_blocks_of_ids(std::span<const std::int64_t> ids, std::vector<std::array<double, 3>> places,
                                           const mpi::Communicator& ranks) {
  const std::int64_t last = ranks.largest(ids.empty() ? 0 : *std::ranges::max_element(ids));
  // So many ids a block that the product does not overflow.
  const std::int64_t block = last / ranks.size() + 1;
  std::vector<std::size_t> counts(static_cast<std::size_t>(ranks.size()), 0);
  for (const std::int64_t id : ids) {
    ++counts[static_cast<std::size_t>(id / block)];
  }
  auto sent = mpi::lists_by_rank<PlacedVertex>(ranks);
  for (std::size_t r = 0; r < sent.size(); ++r) {
    sent[r].reserve(counts[r]);
  }
  for (std::size_t v = 0; v < ids.size(); ++v) {
    sent[static_cast<std::size_t>(ids[v] / block)].push_back({ids[v], places[v]});
  }
  release(places);
  std::vector<PlacedVertex> all = concatenated(ranks.exchanged(std::move(sent)));
  if (!std::ranges::is_sorted(all, {}, &PlacedVertex::id)) {
    std::ranges::sort(all, {}, &PlacedVertex::id);
  }
  all.erase(
      std::unique(all.begin(), all.end(), [](const PlacedVertex& a, const PlacedVertex& b) { return a.id == b.id; }),
      all.end());
  return all;
}

}  // namespace

std::uint64_t hash_over_ranks(std::span<const std::int64_t> ids, std::vector<std::array<double, 3>> places,
                              const mpi::Communicator& ranks) {
  constexpr int tag = 7312;
  static_assert(std::endian::native == std::endian::little, "the hash is of little-endian numbers");
  const std::vector<PlacedVertex> vertices = by_blocks_of_ids(ids, std::move(places), ranks);
  XXH64_state_t state;
  XXH64_reset(&state, 0);
  const int last = ranks.size() - 1;
  if (ranks.rank() > 0) {
    MPI_Recv(&state, sizeof(state), MPI_BYTE, ranks.rank() - 1, tag, ranks.handle(), MPI_STATUS_IGNORE);
  }
  for (const PlacedVertex& vertex : vertices) {
    XXH64_update(&state, vertex.place.data(), sizeof(vertex.place));
  }
  if (ranks.rank() < last) {
    MPI_Send(&state, sizeof(state), MPI_BYTE, ranks.rank() + 1, tag, ranks.handle());
  }
  std::uint64_t digest = XXH64_digest(&state);
  MPI_Bcast(&digest, 1, MPI_UINT64_T, last, ranks.handle());
  return digest;
}

}  // namespace trismooth
