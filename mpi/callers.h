// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/mpi/communicator.h"
#include "trismooth/smoothing/result.h"

namespace trismooth::mpi {

/// The way between the vertices as a rank's caller lists them and the rank's overlap, where their owners have them.
class Callers {
 public:
  /// Of no vertex. Local.
  Callers() = default;

  /// `own_numbers`: for each local vertex its number in the overlap where this rank owns it, else not_own.
  /// `to_owners`: the local vertices that other ranks own, by these ranks. `from_callers`: own vertices that other
  /// ranks list, by these ranks, in the order of what they have in `to_owners`. Local.
  Callers(BulkVector<std::int32_t> own_numbers, ByRank<std::int32_t> to_owners, ByRank<std::int32_t> from_callers);

  static constexpr std::int32_t not_own = -1;

  /// Vertices that this rank's caller lists. Local.
  std::size_t local_count() const { return local_count_; }

  /// What the callers say of own vertices, `local` of this rank's: writes it to `all`, one value a vertex of the
  /// overlap, of which ghosts stay as they are. Where several ranks list a vertex, join(vertex, value, other) brings in
  /// what another one says; it may throw, as in Communicator::on_all(). Collective.
  template <class V, class Join>
  void bring_to_owners(std::span<const V> local, std::span<V> all, const Join& join, const Communicator& ranks,
                       Workers& workers) const {
    const ByRank<V> received = ranks.exchanged(values_of(to_owners_, local), from_counts_);
    for_own(workers, [&](std::size_t v, std::size_t number) { all[number] = local[v]; });
    if (ranks.size() == 1) {
      return;
    }
    std::vector<std::uint8_t> is_known(all.size(), 0);
    for_own(workers, [&](std::size_t /*v*/, std::size_t number) { is_known[number] = 1; });
    ranks.on_all([&] {
      for (std::size_t r = 0; r < received.size(); ++r) {
        for (std::size_t i = 0; i < received[r].size(); ++i) {
          const std::int32_t v = from_callers_[r][i];
          const auto place = static_cast<std::size_t>(v);
          if (is_known[place] != 0) {
            join(v, all[place], received[r][i]);
          } else {
            all[place] = received[r][i];
            is_known[place] = 1;
          }
        }
      }
    });
  }

  /// The other way: gives the callers, in `local`, what own vertices have in `all`. Collective.
  template <class V>
  void hand_back(std::span<const V> all, std::span<V> local, const Communicator& ranks, Workers& workers) const {
    const ByRank<V> received = ranks.exchanged(values_of(from_callers_, all), to_counts_);
    for_own(workers, [&](std::size_t v, std::size_t number) { local[v] = all[number]; });
    for (std::size_t r = 0; r < received.size(); ++r) {
      for (std::size_t i = 0; i < received[r].size(); ++i) {
        local[static_cast<std::size_t>(to_owners_[r][i])] = received[r][i];
      }
    }
  }

  /// Tells all who list a vertex that went back, in their own numbers. `reverted`: of own vertices, ascending.
  /// Ascending again. Collective.
  std::vector<RevertedVertex> named(std::span<const RevertedVertex> reverted, const Communicator& ranks) const;

 private:
  static constexpr std::int64_t grain = 16384;

  /// visit(v, number) for local vertices v that are own.
  template <class Visit>
  void for_own(Workers& workers, const Visit& visit) const {
    workers.for_blocks(static_cast<std::int64_t>(local_count_), grain, [&](std::int64_t begin, std::int64_t end) {
      for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v) {
        if (own_numbers_.empty()) {
          visit(v, v);
        } else if (own_numbers_[v] != not_own) {
          visit(v, static_cast<std::size_t>(own_numbers_[v]));
        }
      }
    });
  }

  template <class V>
  static ByRank<V> values_of(const ByRank<std::int32_t>& lists, std::span<const V> values) {
    ByRank<V> found(lists.size());
    for (std::size_t r = 0; r < lists.size(); ++r) {
      found[r].reserve(lists[r].size());
      for (const std::int32_t v : lists[r]) {
        found[r].push_back(values[static_cast<std::size_t>(v)]);
      }
    }
    return found;
  }

  std::size_t local_count_ = 0;
  BulkVector<std::int32_t> own_numbers_;  ///< empty: all are own, and numbered as here
  ByRank<std::int32_t> to_owners_;
  ByRank<std::int32_t> from_callers_;
  std::vector<std::int64_t> to_counts_;    ///< lengths of the lists
  std::vector<std::int64_t> from_counts_;  ///< lengths of those
};

}  // namespace trismooth::mpi
