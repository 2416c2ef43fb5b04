// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/data_array.h"
#include "trismooth/mpi/communicator.h"

namespace trismooth {

/// The values of an array at these places, for each rank. Local.
template <class V>
mpi::ByRank<V> values_at(std::span<const V> values, const mpi::ByRank<std::int32_t>& places) {
  mpi::ByRank<V> lists(places.size());
  for (std::size_t r = 0; r < places.size(); ++r) {
    lists[r].reserve(places[r].size());
    for (const std::int32_t place : places[r]) {
      lists[r].push_back(values[static_cast<std::size_t>(place)]);
    }
  }
  return lists;
}

/// Lists of all ranks behind each other, that of rank 0 first. Local.
template <class V>
std::vector<V> concatenated(mpi::ByRank<V> lists) {
  std::size_t count = 0;
  for (const auto& list : lists) {
    count += list.size();
  }
  std::vector<V> all;
  all.reserve(count);
  for (auto& list : lists) {
    all.insert(all.end(), list.begin(), list.end());
    list = {};
  }
  return all;
}

/// What each rank has, on rank 0; nothing on the others. Collective.
template <class V>
mpi::ByRank<V> on_first(std::vector<V> own, const mpi::Communicator& ranks) {
  auto sent = mpi::lists_by_rank<V>(ranks);
  sent[0] = std::move(own);
  return ranks.exchanged(std::move(sent));
}

/// Bytes of the values of one point or cell. Local.
inline std::size_t row_size_of(const DataArray& array) {
  return array.components * size_of(array.type);
}

/// An array as `layout` is one, that owns these rows. Local.
inline DataArray with_rows(const DataArray& layout, std::vector<std::byte> rows) {
  auto bytes = std::make_shared<std::vector<std::byte>>(std::move(rows));
  return {layout.name, layout.type, layout.components, *bytes, bytes, layout.description};
}

/// The rows at these places, one behind the other. Local.
inline std::vector<std::byte> rows_at(std::span<const std::byte> rows, std::size_t row_size,
                                      std::span<const std::int32_t> places) {
  std::vector<std::byte> found(places.size() * row_size);
  std::byte* target = found.data();
  for (const std::int32_t place : places) {
    std::memcpy(target, rows.data() + static_cast<std::size_t>(place) * row_size, row_size);
    target += row_size;
  }
  return found;
}

/// Rows of an array, by the ranks that they go to: `places` are those of the rank's rows for each. What comes back
/// comes rank by rank; `counts` rows from each. Collective.
inline std::vector<std::byte> exchanged_rows(std::span<const std::byte> rows, std::size_t row_size,
                                             const mpi::ByRank<std::int32_t>& places,
                                             std::span<const std::int64_t> counts, const mpi::Communicator& ranks) {
  // (What is sent is counted in items, of which no list may have more than 32 bits number.)
  using Block = std::array<std::byte, 1024>;
  constexpr std::size_t block_bytes = sizeof(Block);
  const auto blocks_of = [&](std::size_t count) { return (count * row_size + block_bytes - 1) / block_bytes; };
  auto sent = mpi::lists_by_rank<Block>(ranks);
  std::vector<std::int64_t> expected;
  for (std::size_t r = 0; r < sent.size(); ++r) {
    sent[r].resize(blocks_of(places[r].size()));
    auto* target = reinterpret_cast<std::byte*>(sent[r].data());
    for (const std::int32_t place : places[r]) {
      std::memcpy(target, rows.data() + static_cast<std::size_t>(place) * row_size, row_size);
      target += row_size;
    }
    expected.push_back(static_cast<std::int64_t>(blocks_of(static_cast<std::size_t>(counts[r]))));
  }
  mpi::ByRank<Block> received = ranks.exchanged(std::move(sent), expected);
  std::vector<std::byte> all;
  for (std::size_t r = 0; r < received.size(); ++r) {
    const auto* const bytes = reinterpret_cast<const std::byte*>(received[r].data());
    all.insert(all.end(), bytes, bytes + static_cast<std::size_t>(counts[r]) * row_size);
    received[r] = {};
  }
  return all;
}

}  // namespace trismooth
