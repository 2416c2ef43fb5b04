// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mpi/directory.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/machine/release.h"
#include "trismooth/base/splitmix64.h"

namespace trismooth::mpi {

namespace {

struct Claim {
  std::int64_t id;
  std::int32_t owner;  ///< or nobody
};

constexpr std::int32_t nobody = -1;

/// A claim as it was heard.
struct HeardClaim {
  std::int64_t id;
  std::int32_t rank;  ///< that made it
  std::int32_t owner;
  std::int64_t place;  ///< in the list of that rank
};

/// The claims of all ranks, those of an id behind each other, the lowest rank first.
BulkVector<HeardClaim> sorted_claims(const ByRank<Claim>& heard) {
  BulkVector<HeardClaim> claims;
  std::size_t count = 0;
  for (const std::vector<Claim>& of_rank : heard) {
    count += of_rank.size();
  }
  claims.reserve(count);
  for (std::size_t r = 0; r < heard.size(); ++r) {
    for (std::size_t i = 0; i < heard[r].size(); ++i) {
      claims.push_back({heard[r][i].id, static_cast<std::int32_t>(r), heard[r][i].owner, static_cast<std::int64_t>(i)});
    }
  }
  std::ranges::sort(claims, {}, [](const HeardClaim& claim) { return std::pair(claim.id, claim.rank); });
  return claims;
}

}  // namespace

int home_of(std::int64_t id, const Communicator& communicator) {
  return static_cast<int>(splitmix64(static_cast<std::uint64_t>(id)) % static_cast<std::uint64_t>(communicator.size()));
}

std::vector<std::int32_t> owners_of(std::span<const std::int64_t> ids, std::span<const std::int32_t> claimed,
                                    const Communicator& communicator) {
  if (communicator.size() == 1) {
    return std::vector<std::int32_t>(ids.size(), 0);
  }
  std::vector<std::size_t> counts(static_cast<std::size_t>(communicator.size()), 0);
  for (const std::int64_t id : ids) {
    ++counts[static_cast<std::size_t>(home_of(id, communicator))];
  }
  auto claims = lists_by_rank<Claim>(communicator);
  for (std::size_t r = 0; r < claims.size(); ++r) {
    claims[r].reserve(counts[r]);
  }
  for (std::size_t v = 0; v < ids.size(); ++v) {
    claims[static_cast<std::size_t>(home_of(ids[v], communicator))].push_back(
        {ids[v], claimed.empty() ? nobody : claimed[v]});
  }
  ByRank<Claim> heard = communicator.exchanged(std::move(claims));
  const BulkVector<HeardClaim> sorted = sorted_claims(heard);
  auto answers = lists_by_rank<std::int32_t>(communicator);
  for (std::size_t r = 0; r < heard.size(); ++r) {
    answers[r].resize(heard[r].size());
  }
  release(heard);
  communicator.on_all([&] {
    for (std::size_t i = 0, first = 0; i < sorted.size(); ++i) {
      const HeardClaim& claim = sorted[i];
      if (claim.id != sorted[first].id) {
        first = i;
      }
      const HeardClaim& known = sorted[first];
      if (known.owner != claim.owner) {
        throw std::invalid_argument("ranks disagree about who owns the vertex of id " + std::to_string(claim.id) +
                                    ": by rank " + std::to_string(known.rank) + " it is rank " +
                                    std::to_string(known.owner) + ", by rank " + std::to_string(claim.rank) + " rank " +
                                    std::to_string(claim.owner));
      }
      answers[static_cast<std::size_t>(claim.rank)][static_cast<std::size_t>(claim.place)] =
          known.owner == nobody ? known.rank : known.owner;
    }
  });
  const ByRank<std::int32_t> told = communicator.exchanged(std::move(answers));
  std::vector<std::size_t> next(told.size(), 0);
  std::vector<std::int32_t> found(ids.size());
  for (std::size_t v = 0; v < ids.size(); ++v) {
    const auto home = static_cast<std::size_t>(home_of(ids[v], communicator));
    found[v] = told[home][next[home]++];
  }
  return found;
}

void require_unique(std::span<const std::int64_t> ids, const char* what, const Communicator& communicator) {
  auto sent = lists_by_rank<std::int64_t>(communicator);
  for (const std::int64_t id : ids) {
    sent[static_cast<std::size_t>(home_of(id, communicator))].push_back(id);
  }
  const ByRank<std::int64_t> heard = communicator.exchanged(std::move(sent));
  std::vector<std::pair<std::int64_t, std::size_t>> sorted;  // and the rank that has it
  for (std::size_t r = 0; r < heard.size(); ++r) {
    for (const std::int64_t id : heard[r]) {
      sorted.emplace_back(id, r);
    }
  }
  std::ranges::sort(sorted);
  communicator.on_all([&] {
    for (std::size_t i = 1; i < sorted.size(); ++i) {
      if (sorted[i].first == sorted[i - 1].first) {
        throw std::invalid_argument(std::string(what) + ": " + std::to_string(sorted[i].first) + " is on rank " +
                                    std::to_string(sorted[i - 1].second) + " and on rank " +
                                    std::to_string(sorted[i].second) + "; copies are to be in ghost_triangles");
      }
    }
  });
}

}  // namespace trismooth::mpi
