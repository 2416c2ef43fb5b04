// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/joined/overlap_triangles.h"

#include <utility>

namespace trismooth {

namespace {

/// Ids by the blocks of numbers that they are in. `for_each(visit)` visits them all, as often as it is called.
template <class ForEach>
mpi::ByRank<std::int64_t> by_blocks(const ForEach& for_each, std::int64_t block, const mpi::Communicator& ranks) {
  std::vector<std::size_t> counts(static_cast<std::size_t>(ranks.size()), 0);
  for_each([&](std::int64_t id) { ++counts[static_cast<std::size_t>(id / block)]; });
  auto lists = mpi::lists_by_rank<std::int64_t>(ranks);
  for (std::size_t r = 0; r < lists.size(); ++r) {
    lists[r].reserve(counts[r]);
  }
  for_each([&](std::int64_t id) { lists[static_cast<std::size_t>(id / block)].push_back(id); });
  return lists;
}

}  // namespace

std::vector<std::int32_t> OverlapTriangles::holders() const {
  // Numbers are shared out in blocks among ranks that keep a list of who has them.
  const std::int64_t block = topology_.triangle_count() / ranks_.size() + 1;
  const auto for_own_ids = [&](const auto& visit) {
    for (std::size_t i = 0; i < topology_.own_triangles(); ++i) {
      visit(topology_.own_id(i));
    }
  };
  const std::int64_t first = block * ranks_.rank();
  std::vector<std::int32_t> holders(static_cast<std::size_t>(block), 0);
  {
    const mpi::ByRank<std::int64_t> heard = ranks_.exchanged(by_blocks(for_own_ids, block, ranks_));
    for (std::size_t r = 0; r < heard.size(); ++r) {
      for (const std::int64_t id : heard[r]) {
        holders[static_cast<std::size_t>(id - first)] = static_cast<std::int32_t>(r);
      }
    }
  }
  const mpi::AscendingIds& ids = topology_.overlap().triangle_ids;
  const auto for_ids = [&](const auto& visit) {
    for (const std::int64_t id : ids) {
      visit(id);
    }
  };
  auto answers = mpi::lists_by_rank<std::int32_t>(ranks_);
  mpi::ByRank<std::int64_t> wanted = ranks_.exchanged(by_blocks(for_ids, block, ranks_));
  for (std::size_t r = 0; r < wanted.size(); ++r) {
    answers[r].reserve(wanted[r].size());
    for (const std::int64_t id : wanted[r]) {
      answers[r].push_back(holders[static_cast<std::size_t>(id - first)]);
    }
  }
  wanted.clear();
  const mpi::ByRank<std::int32_t> told = ranks_.exchanged(std::move(answers));
  std::vector<std::size_t> next(told.size(), 0);
  std::vector<std::int32_t> found;
  found.reserve(ids.size());
  for (const std::int64_t id : ids) {
    const auto home = static_cast<std::size_t>(id / block);
    found.push_back(told[home][next[home]++]);
  }
  return found;
}

OverlapTriangles::Lists OverlapTriangles::find_lists() const {
  Lists lists{mpi::lists_by_rank<std::int32_t>(ranks_), mpi::lists_by_rank<std::int32_t>(ranks_)};
  auto wanted = mpi::lists_by_rank<std::int64_t>(ranks_);
  {
    const std::vector<std::int32_t> holders_of = holders();
    auto id = topology_.overlap().triangle_ids.begin();
    for (std::size_t t = 0; t < holders_of.size(); ++t, ++id) {
      const auto rank = static_cast<std::size_t>(holders_of[t]);
      lists.wanted[rank].push_back(static_cast<std::int32_t>(t));
      wanted[rank].push_back(*id);
    }
  }
  const mpi::ByRank<std::int64_t> asked = ranks_.exchanged(std::move(wanted));
  for (std::size_t r = 0; r < asked.size(); ++r) {
    lists.asked[r].reserve(asked[r].size());
    for (const std::int64_t id : asked[r]) {
      lists.asked[r].push_back(topology_.local_triangle(id));
    }
  }
  return lists;
}

}  // namespace trismooth
