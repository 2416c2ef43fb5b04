#include "trismooth/mpi/directory.h"

#include <stdexcept>
#include <string>
#include <unordered_map>

#include "trismooth/base/splitmix64.h"

namespace trismooth::mpi {

namespace {

struct Claim {
  std::int64_t id;
  std::int32_t owner;  ///< or nobody
};

constexpr std::int32_t nobody = -1;

struct Owner {
  std::int32_t rank;
  std::int32_t said_by;
};

}  // namespace

int home_of(std::int64_t id, const Communicator& communicator) {
  return static_cast<int>(splitmix64(static_cast<std::uint64_t>(id)) %
                          static_cast<std::uint64_t>(communicator.size()));
}

std::vector<std::int32_t> owners_of(std::span<const std::int64_t> ids, std::span<const std::int32_t> claimed,
                                    const Communicator& communicator) {
  auto claims = lists_by_rank<Claim>(communicator);
  for (std::size_t v = 0; v < ids.size(); ++v) {
    claims[static_cast<std::size_t>(home_of(ids[v], communicator))].push_back(
        {ids[v], claimed.empty() ? nobody : claimed[v]});
  }
  const ByRank<Claim> heard = communicator.exchanged(claims);
  std::unordered_map<std::int64_t, Owner> owners;
  communicator.on_all([&] {
    for (std::size_t r = 0; r < heard.size(); ++r) {
      for (const Claim& claim : heard[r]) {
        // Ranks come in their order, so the first that has a vertex is the lowest.
        const Owner said{claim.owner == nobody ? static_cast<std::int32_t>(r) : claim.owner,
                         static_cast<std::int32_t>(r)};
        const auto [place, is_first] = owners.try_emplace(claim.id, said);
        const Owner& known = place->second;
        if (!is_first && claim.owner != nobody && known.rank != claim.owner) {
          throw std::invalid_argument("ranks disagree about who owns the vertex of id " + std::to_string(claim.id) +
                                      ": by rank " + std::to_string(known.said_by) + " it is rank " +
                                      std::to_string(known.rank) + ", by rank " + std::to_string(r) + " rank " +
                                      std::to_string(claim.owner));
        }
      }
    }
  });
  auto answers = lists_by_rank<std::int32_t>(communicator);
  for (std::size_t r = 0; r < heard.size(); ++r) {
    for (const Claim& claim : heard[r]) {
      answers[r].push_back(owners.at(claim.id).rank);
    }
  }
  const ByRank<std::int32_t> told = communicator.exchanged(answers);
  std::vector<std::size_t> next(told.size(), 0);
  std::vector<std::int32_t> found(ids.size());
  for (std::size_t v = 0; v < ids.size(); ++v) {
    const auto home = static_cast<std::size_t>(home_of(ids[v], communicator));
    found[v] = told[home][next[home]++];
  }
  return found;
}

}  // namespace trismooth::mpi
