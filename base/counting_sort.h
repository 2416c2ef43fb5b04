// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "trismooth/base/machine/blocks.h"
#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/machine/workers.h"

namespace trismooth {

/// Sorts items of which each i of [0, size) has any number: items(i, item) calls item(key, values...) for each of them,
/// with a key from 0 to keys - 1. Calls put(place, values...) for each item, on all workers, with its place in the
/// order of the keys, which is that of the items where keys are equal. Returns where each key's places begin, and as
/// the last element how many items there are. Calls items(i, ..) twice for each i. Complexity: linear, beside some
/// numbers for each key and worker.
template <class Items, class Put>
std::vector<std::int64_t> counting_sort_of_items(std::int64_t size, std::int64_t keys, const Items& items,
                                                 const Put& put, Workers& workers) {
  constexpr std::int64_t grain = 16384;
  // A block has a counter for each key: it is no smaller than they are.
  const Blocks blocks(size, grain > 2 * keys ? grain : 2 * keys, workers);
  BulkVector<std::int64_t> places(static_cast<std::size_t>(blocks.count() * keys));
  blocks.for_each(workers, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    std::int64_t* const counts = places.data() + block * keys;
    std::fill_n(counts, keys, 0);
    for (std::int64_t i = begin; i < end; ++i) {
      items(i, [counts](auto key, const auto&... /*values*/) { ++counts[key]; });
    }
  });
  std::vector<std::int64_t> begins(static_cast<std::size_t>(keys) + 1);
  std::int64_t place = 0;
  for (std::int64_t k = 0; k < keys; ++k) {
    begins[k] = place;
    for (std::int64_t block = 0; block < blocks.count(); ++block) {
      std::int64_t& count = places[block * keys + k];
      const std::int64_t next = place + count;
      count = place;
      place = next;
    }
  }
  begins[keys] = place;
  blocks.for_each(workers, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    std::int64_t* const next = places.data() + block * keys;
    for (std::int64_t i = begin; i < end; ++i) {
      items(i, [&put, next](auto key, const auto&... values) { put(next[key]++, values...); });
    }
  });
  return begins;
}

/// Sorts the numbers i of [0, size) by key(i), from 0 to keys - 1, as counting_sort_of_items() does. Calls put(i,
/// place) for each i. Calls key(i) twice for each i, the second time before its put().
template <class Key, class Put>
std::vector<std::int64_t> counting_sort(std::int64_t size, std::int64_t keys, const Key& key, const Put& put,
                                        Workers& workers) {
  return counting_sort_of_items(
      size, keys, [&key](std::int64_t i, const auto& item) { item(key(i), i); },
      [&put](std::int64_t place, std::int64_t i) { put(i, place); }, workers);
}

/// A number and what it is sorted by.
struct KeyedNumber {
  std::uint32_t key;
  std::int32_t number;
};

/// Sorts by the keys, of which only the lowest `bits` are not 0, and keeps the order of equal ones. Takes as much
/// memory again. Complexity: linear, a pass for every eleven bits.
inline void radix_sort(BulkVector<KeyedNumber>& items, int bits, Workers& workers) {
  constexpr int bits_a_pass = 11;
  BulkVector<KeyedNumber> sorted(items.size());
  for (int shift = 0; shift < bits; shift += bits_a_pass) {
    const std::uint32_t mask =
        (1U << static_cast<unsigned>(bits - shift < bits_a_pass ? bits - shift : bits_a_pass)) - 1;
    counting_sort(
        static_cast<std::int64_t>(items.size()), std::int64_t{mask} + 1,
        [&](std::int64_t i) { return (items[i].key >> static_cast<unsigned>(shift)) & mask; },
        [&](std::int64_t i, std::int64_t place) { sorted[place] = items[i]; }, workers);
    items.swap(sorted);
  }
}

}  // namespace trismooth
