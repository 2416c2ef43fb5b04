// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "trismooth/base/machine/ordered_sum.h"
#include "trismooth/base/machine/workers.h"

namespace trismooth {

/// Works on the rows of a system on the host's threads. What is written for rows runs on a device as well: with
/// cuda::DeviceRows, which has the same functions and gives the same bits.
class HostRows {
 public:
  template <class T>
  using Array = std::vector<T>;

  explicit HostRows(Workers& workers) : workers_(workers) {}

  /// Memory for so many values, zeros.
  template <class T>
  Array<T> zeros(std::size_t count) const {
    return Array<T>(count);
  }

  /// body(row) for all rows below `count`, in any order.
  template <class Body>
  void for_rows(std::int32_t count, const Body& body) const {
    workers_.for_blocks(count, 4096, [&](std::int64_t begin, std::int64_t end) {
      for (auto row = static_cast<std::int32_t>(begin); row < end; ++row) {
        body(row);
      }
    });
  }

  /// body(round, row) for all rows, round by round: those of a round see what the one before has left.
  template <class Body>
  void in_rounds(int rounds, std::int32_t count, const Body& body) const {
    for (int round = 0; round < rounds; ++round) {
      for_rows(count, [&](std::int32_t row) { body(round, row); });
    }
  }

  /// ordered_sum() of term(row), numbers, for all rows below `count`.
  template <class Term>
  double sum(std::int32_t count, const Term& term) const {
    return ordered_sum(count, term, workers_);
  }

 private:
  Workers& workers_;
};

}  // namespace trismooth
