#include "trismooth/pipeline/ranks/triangle_links.h"

#include <utility>

namespace trismooth {

std::vector<std::int32_t> TriangleLinks::holders() const {
  // Numbers are shared out in blocks among ranks that keep a list of who has them.
  const std::int64_t block = topology_.triangle_count() / ranks_.size() + 1;
  auto sent = mpi::lists_by_rank<std::int64_t>(ranks_);
  for (std::size_t i = 0; i < topology_.own_triangles(); ++i) {
    const std::int64_t id = topology_.own_id(i);
    sent[static_cast<std::size_t>(id / block)].push_back(id);
  }
  const std::int64_t first = block * ranks_.rank();
  std::vector<std::int32_t> holders(static_cast<std::size_t>(block), 0);
  const mpi::ByRank<std::int64_t> heard = ranks_.exchanged(std::move(sent));
  for (std::size_t r = 0; r < heard.size(); ++r) {
    for (const std::int64_t id : heard[r]) {
      holders[static_cast<std::size_t>(id - first)] = static_cast<std::int32_t>(r);
    }
  }
  const mpi::AscendingIds& ids = topology_.overlap().triangle_ids;
  auto asked = mpi::lists_by_rank<std::int64_t>(ranks_);
  for (const std::int64_t id : ids) {
    asked[static_cast<std::size_t>(id / block)].push_back(id);
  }
  auto answers = mpi::lists_by_rank<std::int32_t>(ranks_);
  const mpi::ByRank<std::int64_t> wanted = ranks_.exchanged(std::move(asked));
  for (std::size_t r = 0; r < wanted.size(); ++r) {
    for (const std::int64_t id : wanted[r]) {
      answers[r].push_back(holders[static_cast<std::size_t>(id - first)]);
    }
  }
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

TriangleLinks::Lists TriangleLinks::find_lists() const {
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
