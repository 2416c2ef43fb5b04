// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mpi/callers.h"

#include <algorithm>
#include <utility>

#include "trismooth/base/machine/release.h"

namespace trismooth::mpi {

namespace {

bool counts_up(std::span<const std::int32_t> numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] != static_cast<std::int32_t>(i)) {
      return false;
    }
  }
  return true;
}

}  // namespace

Callers::Callers(BulkVector<std::int32_t> own_numbers, ByRank<std::int32_t> to_owners,
                 ByRank<std::int32_t> from_callers)
    : local_count_(own_numbers.size()),
      own_numbers_(std::move(own_numbers)),
      to_owners_(std::move(to_owners)),
      from_callers_(std::move(from_callers)),
      to_counts_(lengths_of(to_owners_)),
      from_counts_(lengths_of(from_callers_)) {
  if (counts_up(own_numbers_)) {
    release(own_numbers_);
  }
}

std::vector<RevertedVertex> Callers::named(std::span<const RevertedVertex> reverted, const Communicator& ranks) const {
  // Sought in the lists: there are few of them as a rule.
  const auto find = [&](std::int32_t v) {
    const auto place = std::ranges::lower_bound(reverted, v, {}, &RevertedVertex::vertex);
    return place != reverted.end() && place->vertex == v ? &*place : nullptr;
  };
  auto sent = lists_by_rank<RevertedVertex>(ranks);
  for (std::size_t r = 0; r < sent.size(); ++r) {
    for (std::size_t i = 0; i < from_callers_[r].size(); ++i) {
      if (const RevertedVertex* const found = find(from_callers_[r][i])) {
        sent[r].push_back({static_cast<std::int32_t>(i), found->position});
      }
    }
  }
  const ByRank<RevertedVertex> received = ranks.exchanged(std::move(sent));
  std::vector<RevertedVertex> all;
  for (std::size_t r = 0; r < received.size(); ++r) {
    for (const auto& [place, position] : received[r]) {
      all.push_back({to_owners_[r][static_cast<std::size_t>(place)], position});
    }
  }
  for (std::size_t v = 0; v < local_count_; ++v) {
    const std::int32_t number = own_numbers_.empty() ? static_cast<std::int32_t>(v) : own_numbers_[v];
    if (number == not_own) {
      continue;
    }
    if (const RevertedVertex* const found = find(number)) {
      all.push_back({static_cast<std::int32_t>(v), found->position});
    }
  }
  std::ranges::sort(all, {}, &RevertedVertex::vertex);
  return all;
}

}  // namespace trismooth::mpi
