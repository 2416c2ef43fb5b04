// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "trismooth/base/element_list.h"
#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/mpi/communicator.h"
#include "trismooth/pipeline/ranks/joined/rank_topology.h"
#include "trismooth/quality/area_ratios.h"
#include "trismooth/quality/element.h"
#include "trismooth/quality/quality_part.h"

namespace trismooth {

/// Elements of the whole mesh, numbered from 0, which ranks report on in blocks of their numbers, whoever has them: the
/// first blocks rank 0, and so on. Their corners travel in rounds, so that no rank ever has those of all its elements.
/// All of them are Triangle, or MixedElement with triangles among them.
template <class Corners>
class ReportedElements {
 public:
  /// Those that are reported on as one, in sums whose order counts: blocks may not be cut between ranks.
  static constexpr auto block_size = static_cast<std::int64_t>(triangles_a_quality_part);
  static_assert(triangles_a_size_part == triangles_a_quality_part);

  /// Of `count` elements. for_each(visit) calls visit(e, number, facts) for those elements of the overlap that this
  /// rank counts, in the order of their numbers; facts, of type Keeper::Facts, are copied by their bytes to who reports
  /// on the element, and given to keeper.take(place, facts), by its place among the size() of those, after
  /// keeper.resize(size()). The topology and `reversed` outlive it. Collective.
  template <class ForEach, class Keeper>
  ReportedElements(const RankTopology& topology, std::span<const std::uint8_t> reversed, std::int64_t count,
                   const ForEach& for_each, Keeper&& keeper)
      : topology_(&topology),
        ranks_(&topology.ranks()),
        reversed_(reversed),
        blocks_((count + block_size - 1) / block_size),
        sent_(mpi::lists_by_rank<std::int32_t>(*ranks_)),
        sent_begins_(sent_.size()),
        places_(mpi::lists_by_rank<std::int32_t>(*ranks_)) {
    using Facts = typename std::remove_reference_t<Keeper>::Facts;
    struct Reported {
      std::int32_t place;
      Facts facts;
    };
    auto sent = mpi::lists_by_rank<Reported>(*ranks_);
    std::size_t rank = 0;
    for_each([&](std::size_t e, std::int64_t number, const Facts& facts) {
      while (number / block_size >= first_block(static_cast<int>(rank) + 1)) {
        ++rank;
      }
      const std::int64_t place = number - first_number(static_cast<int>(rank));
      for (auto& begins = sent_begins_[rank]; std::ssize(begins) * round_size <= place;) {
        begins.push_back(sent_[rank].size());
      }
      sent_[rank].push_back(static_cast<std::int32_t>(e));
      sent[rank].push_back({static_cast<std::int32_t>(place), facts});
    });
    const mpi::ByRank<Reported> received = ranks_->exchanged(std::move(sent));
    for (const auto& list : received) {
      size_ += std::ssize(list);
    }
    keeper.resize(static_cast<std::size_t>(size_));
    for (std::size_t r = 0; r < received.size(); ++r) {
      places_[r].reserve(received[r].size());
      for (const Reported& element : received[r]) {
        places_[r].push_back(element.place);
        keeper.take(static_cast<std::size_t>(element.place), element.facts);
      }
    }
  }

  /// How many are reported on here. Local.
  [[nodiscard]] std::int64_t size() const { return size_; }
  /// The number of the first one that a rank reports on. Local.
  [[nodiscard]] std::int64_t first_number(int rank) const { return first_block(rank) * block_size; }
  /// Their places here, by the rank that counts them. Local.
  [[nodiscard]] const mpi::ByRank<std::int32_t>& places() const { return places_; }
  /// Those of the overlap that this rank counts, by the rank that reports on them. Local.
  [[nodiscard]] const mpi::ByRank<std::int32_t>& sent() const { return sent_; }
  /// Rounds in which corners travel, the same on all ranks. Local.
  [[nodiscard]] std::int64_t rounds() const {
    const std::int64_t most_blocks = (blocks_ + ranks_->size() - 1) / ranks_->size();
    return (most_blocks + blocks_a_round - 1) / blocks_a_round;
  }
  /// Where those of a round begin among all that are reported here. Local.
  [[nodiscard]] std::int64_t first_of_round(std::int64_t round) const { return std::min(round * round_size, size_); }

  /// The corners of the elements of a round that are reported here, in canonical order, as many points of each as
  /// Corners has numbers; the last of a triangle is its first. `points`: of the overlap. Collective.
  BulkVector<Point2<double>> corners_of_round(std::span<const Point2<double>> points, std::int64_t round) const {
    auto sent = mpi::lists_by_rank<Points>(*ranks_);
    const std::span<const Corners> elements = topology_->overlap().elements().template as<Corners>();
    for (std::size_t r = 0; r < sent.size(); ++r) {
      const auto begin_of = [&](std::int64_t of_round) {
        const auto i = static_cast<std::size_t>(of_round);
        return i < sent_begins_[r].size() ? sent_begins_[r][i] : sent_[r].size();
      };
      for (std::size_t i = begin_of(round); i < begin_of(round + 1); ++i) {
        const auto e = static_cast<std::size_t>(sent_[r][i]);
        const Corners corners = canonical_corners(elements[e], reversed_[e] != 0);
        Points& places = sent[r].emplace_back();
        std::ranges::transform(corners, places.begin(),
                               [&](std::int32_t v) { return points[v == no_corner ? corners[0] : v]; });
      }
    }
    const std::int64_t first = first_of_round(round);
    const std::int64_t last = first_of_round(round + 1);
    std::vector<std::span<const std::int32_t>> places;
    std::vector<std::int64_t> counts;
    for (const auto& list : places_) {
      places.emplace_back(std::ranges::lower_bound(list, first), std::ranges::lower_bound(list, last));
      counts.push_back(std::ssize(places.back()));
    }
    const mpi::ByRank<Points> received = ranks_->exchanged(std::move(sent), counts);
    BulkVector<Point2<double>> corners(static_cast<std::size_t>(std::ssize(Points()) * (last - first)));
    for (std::size_t r = 0; r < received.size(); ++r) {
      for (std::size_t i = 0; i < received[r].size(); ++i) {
        std::ranges::copy(received[r][i], corners.begin() + std::ssize(Points()) * (places[r][i] - first));
      }
    }
    return corners;
  }

 private:
  using Points = std::array<Point2<double>, std::tuple_size_v<Corners>>;
  static constexpr std::int64_t blocks_a_round = 64;
  static constexpr std::int64_t round_size = blocks_a_round * block_size;

  [[nodiscard]] std::int64_t first_block(int rank) const { return blocks_ * rank / ranks_->size(); }

  const RankTopology* topology_;
  const mpi::Communicator* ranks_;
  std::span<const std::uint8_t> reversed_;
  std::int64_t blocks_;                                ///< of elements
  mpi::ByRank<std::int32_t> sent_;                     ///< elements of the overlap, by the rank that reports on them
  std::vector<std::vector<std::size_t>> sent_begins_;  ///< where those of each round begin among these
  mpi::ByRank<std::int32_t> places_;                   ///< of elements from each rank, among those reported here
  std::int64_t size_ = 0;
};

}  // namespace trismooth
