// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <mutex>
#include <vector>

#include "trismooth/base/machine/workers.h"

namespace trismooth {

/// What find(begin, end, found) finds in blocks of [0, size), on all workers, each from `none` on, put together by
/// join(all, found): one block at a time and in any order, so for sums of integers, smallest numbers and the like.
template <class Found, class Find, class Join>
Found joined_blocks(std::int64_t size, std::int64_t grain, Workers& workers, const Found& none, const Find& find,
                    const Join& join) {
  Found all = none;
  std::mutex joining;
  workers.for_blocks(size, grain, [&](std::int64_t begin, std::int64_t end) {
    Found found = none;
    find(begin, end, found);
    const std::lock_guard lock(joining);
    join(all, found);
  });
  return all;
}

/// What look(i, list) appends for the numbers i of [0, size), on all workers: in any order.
template <class Item, class Look>
std::vector<Item> joined_lists(std::int64_t size, std::int64_t grain, Workers& workers, const Look& look) {
  return joined_blocks(
      size, grain, workers, std::vector<Item>{},
      [&](std::int64_t begin, std::int64_t end, std::vector<Item>& found) {
        for (std::int64_t i = begin; i < end; ++i) {
          look(i, found);
        }
      },
      [](std::vector<Item>& all, const std::vector<Item>& found) {
        all.insert(all.end(), found.begin(), found.end());
      });
}

/// The sum of term(i), a whole number, over the numbers i of [0, size), on all workers.
template <class Term>
std::int64_t joined_sum(std::int64_t size, std::int64_t grain, Workers& workers, const Term& term) {
  return joined_blocks(
      size, grain, workers, std::int64_t{0},
      [&](std::int64_t begin, std::int64_t end, std::int64_t& sum) {
        for (std::int64_t i = begin; i < end; ++i) {
          sum += term(i);
        }
      },
      [](std::int64_t& all, std::int64_t sum) { all += sum; });
}

}  // namespace trismooth
