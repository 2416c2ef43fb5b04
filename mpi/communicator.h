// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <mpi.h>

#include "trismooth/mpi/error_kinds.h"
#include "trismooth/smoothing/parts/part_messenger.h"

namespace trismooth::mpi {

/// One list for each rank: what goes there, or has come from there.
template <class V>
using ByRank = std::vector<std::vector<V>>;

/// An error that all ranks throw at the same place. Communicator::on_all() makes one of what happens on one rank; who
/// makes one by hand does so on all of them, from what all have. Any other that leaves a collective function would
/// leave the others waiting: see Communicator::together().
struct KnownToAll : std::exception {
  explicit KnownToAll(std::exception_ptr known) : error(std::move(known)) {}

  std::exception_ptr error;
};

/// What a rank does before it ends all of them, having failed alone: says what has happened, the exception that is
/// being handled. Returns the exit code of the job. Throws nothing.
using LastWords = int (*)(int rank);

/// Says it on standard error: "trismooth: rank 3: out of memory". Returns 1. Local.
int say_failure(int rank);

/// Ends all ranks, as MPI_Abort(), once a launcher has had the time to pass on what has been said. Local.
[[noreturn]] void end_all(MPI_Comm communicator, int exit_code);

/// The ranks that work together, on a communicator of their own: a copy of the caller's, whose messages nobody else
/// receives.
class Communicator {
 public:
  /// Throws std::logic_error where MPI has not been initialised, or is finished. Collective.
  explicit Communicator(MPI_Comm caller, LastWords last_words = &say_failure);
  Communicator(const Communicator&) = delete;
  Communicator& operator=(const Communicator&) = delete;
  /// Collective. After MPI_Finalize() it does nothing.
  ~Communicator();

  /// The number of this rank, from 0. Local.
  int rank() const { return rank_; }
  /// How many ranks there are. Local.
  int size() const { return size_; }
  /// Threads of a rank: as many as are asked for; for 0 its share of the cores of its machine, one at least. Local.
  int threads(int asked) const;
  /// This rank's place among those that share its machine, from 0. Local.
  int place_on_machine() const { return place_on_machine_; }
  /// That of the copy, which it keeps. Local.
  MPI_Comm handle() const { return communicator_; }

  /// Sums and extremes of all ranks, on all of them: PartSums::join(). Collective.
  PartSums joined(PartSums own) const;
  /// The sum over all ranks, on all of them. Collective.
  std::int64_t sum(std::int64_t own) const;
  /// Each becomes the sum over the ranks; as many on all of them. Collective.
  void sum(std::span<std::int64_t> own) const;
  /// The largest of all ranks, on all of them. Collective.
  std::int64_t largest(std::int64_t own) const;
  /// Whether it is so on any rank, on all of them. Collective.
  bool any(bool own) const { return sum(own ? 1 : 0) > 0; }
  /// The sum over the ranks before this one. Collective.
  std::int64_t sum_before(std::int64_t own) const;

  /// Calls `work` on every rank, which is to do nothing collective. If it throws anywhere, this throws KnownToAll
  /// everywhere: the error of the lowest of these ranks, as `errors` say; std::bad_alloc as OutOfMemory. Collective.
  void on_all(const std::function<void()>& work, const ErrorKinds& errors = library_errors()) const;

  /// How much comes from every rank, where `counts` go to each. Collective.
  std::vector<std::int64_t> exchanged_counts(std::span<const std::int64_t> counts) const;
  /// Sends to every rank what is for it. Collective. Complexity: what is sent and received, and linear in the ranks.
  template <class V>
  ByRank<V> exchanged(ByRank<V> to) const {
    std::vector<std::int64_t> counts(static_cast<std::size_t>(size_));
    for (std::size_t r = 0; r < to.size(); ++r) {
      counts[r] = std::ssize(to[r]);
    }
    return exchanged(std::move(to), exchanged_counts(counts));
  }
  /// Sends to every rank what is for it, where it is known how much comes from every rank: `counts`, so that nobody is
  /// asked for that. Collective.
  template <class V>
  ByRank<V> exchanged(ByRank<V> to, std::span<const std::int64_t> counts) const {
    static_assert(std::is_trivially_copyable_v<V>);
    ByRank<V> from(static_cast<std::size_t>(size_));
    std::vector<Buffer> sends;
    std::vector<Buffer> receives;
    for (std::size_t r = 0; r < from.size(); ++r) {
      if (static_cast<int>(r) == rank_) {
        from[r] = std::move(to[r]);
        continue;
      }
      from[r].resize(static_cast<std::size_t>(counts[r]));
      sends.push_back({to[r].data(), std::ssize(to[r]), static_cast<int>(r)});
      receives.push_back({from[r].data(), counts[r], static_cast<int>(r)});
    }
    exchange(sends, receives, sizeof(V));
    return from;
  }

  /// What the ranks have, one rank's after the other's, on all of them. Collective.
  template <class V>
  std::vector<V> of_all(const std::vector<V>& own) const {
    std::vector<V> all;
    for (const auto& list : exchanged(ByRank<V>(static_cast<std::size_t>(size_), own))) {
      all.insert(all.end(), list.begin(), list.end());
    }
    return all;
  }

  /// Gives all ranks what rank 0 has. Collective.
  template <class V>
  void broadcast(std::vector<V>& values) const {
    static_assert(std::is_trivially_copyable_v<V>);
    auto to = ByRank<V>(static_cast<std::size_t>(size_));
    for (int r = 1; r < size_ && rank_ == 0; ++r) {
      to[static_cast<std::size_t>(r)] = values;
    }
    ByRank<V> from = exchanged(std::move(to));
    if (rank_ != 0) {
      values = std::move(from[0]);
    }
  }

  /// Calls a collective function, and throws what it throws as KnownToAll. Anything else, memory that is used up above
  /// all, has happened on this rank, at whatever place: the others wait for it at another one, and cannot be told any
  /// more. It ends them all, with the last words, by MPI_Abort(); where there are no others it is thrown. Collective.
  template <class Function>
  auto together(const Function& function) const {
    try {
      return function();
    } catch (const KnownToAll& known) {
      std::rethrow_exception(known.error);
    } catch (...) {
      if (size_ == 1) {
        throw;
      }
      end_all(communicator_, last_words_(rank_));
    }
  }

 private:
  struct Buffer {
    void* first;
    std::int64_t count;
    int rank;
  };

  void exchange(std::span<const Buffer> sends, std::span<const Buffer> receives, std::size_t item_size) const;

  LastWords last_words_;
  MPI_Comm communicator_ = MPI_COMM_NULL;
  int rank_ = 0;
  int size_ = 1;
  int ranks_of_machine_ = 1;
  int place_on_machine_ = 0;
  MPI_Datatype sums_type_ = MPI_DATATYPE_NULL;
  MPI_Op join_ = MPI_OP_NULL;
};

/// The ranks of a caller's communicator, for what is made of them. A rank without memory for that ends them all. Throws
/// std::logic_error where MPI has not been initialised, or is finished. Collective.
std::shared_ptr<const Communicator> joined_ranks(MPI_Comm caller);

/// The lengths of lists. Local.
template <class V>
std::vector<std::int64_t> lengths_of(const ByRank<V>& lists) {
  std::vector<std::int64_t> lengths;
  for (const std::vector<V>& list : lists) {
    lengths.push_back(static_cast<std::int64_t>(list.size()));
  }
  return lengths;
}

/// Lists for as many ranks, with nothing in them. Local.
template <class V>
ByRank<V> lists_by_rank(const Communicator& communicator) {
  return ByRank<V>(static_cast<std::size_t>(communicator.size()));
}

}  // namespace trismooth::mpi
