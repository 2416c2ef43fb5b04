// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/joined/rank_quality.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <type_traits>
#include <utility>

#include <mpi.h>

#include "trismooth/quality/area_ratios.h"
#include "trismooth/quality/element.h"
#include "trismooth/quality/metrics.h"
#include "trismooth/quality/quality_part.h"
#include "trismooth/quality/region_part.h"

namespace trismooth {

namespace {

// Blocks of triangles may not be cut between ranks.
constexpr auto block_size = static_cast<std::int64_t>(triangles_a_quality_part);
static_assert(triangles_a_size_part == triangles_a_quality_part);
constexpr std::int64_t blocks_a_round = 64;

/// Hands a state from rank to rank, each of which adds what it has; all get what comes out at the end. The bytes of a
/// state are copied; all ranks have as many of them.
template <class State, class Add>
std::vector<State> passed_on(std::vector<State> states, const mpi::Communicator& ranks, const Add& add) {
  static_assert(std::is_trivially_copyable_v<State>);
  constexpr int tag = 7311;
  const auto bytes = static_cast<int>(states.size() * sizeof(State));
  const int last = ranks.size() - 1;
  if (ranks.rank() > 0) {
    MPI_Recv(states.data(), bytes, MPI_BYTE, ranks.rank() - 1, tag, ranks.handle(), MPI_STATUS_IGNORE);
  }
  add(states);
  if (ranks.rank() < last) {
    MPI_Send(states.data(), bytes, MPI_BYTE, ranks.rank() + 1, tag, ranks.handle());
  }
  MPI_Bcast(states.data(), bytes, MPI_BYTE, last, ranks.handle());
  return states;
}

/// The worst triangles of all ranks, from those of each.
std::vector<WorstElement> worst_of_all(const std::vector<WorstElement>& own, std::size_t count,
                                       const mpi::Communicator& ranks) {
  std::vector<WorstElement> all = ranks.of_all(own);
  std::ranges::sort(all, is_worse);
  all.resize(std::min(all.size(), count));
  return all;
}

}  // namespace

RankQuality::RankQuality(const RankTopology& topology, std::span<const std::uint8_t> reversed,
                         std::span<const std::uint8_t> held, std::span<const std::int32_t> regions,
                         std::int32_t region_count)
    : topology_(topology),
      ranks_(topology.ranks()),
      reversed_(reversed),
      blocks_((topology.triangle_count() + block_size - 1) / block_size),
      region_count_(region_count) {
  /// What goes to the rank that reports on a triangle.
  struct Reported {
    std::int32_t place;
    std::int32_t region;
    std::uint8_t all_fixed;
  };
  const mpi::Overlap& overlap = topology.overlap();
  sent_ = mpi::lists_by_rank<std::int32_t>(ranks_);
  auto sent = mpi::lists_by_rank<Reported>(ranks_);
  auto id = overlap.triangle_ids.begin();
  int rank = 0;
  for (std::size_t t = 0; t < overlap.elements().size(); ++t, ++id) {
    if (!topology.counts(t)) {
      continue;
    }
    // (Triangles stand in the order of their numbers.)
    while (*id / block_size >= first_block(rank + 1)) {
      ++rank;
    }
    const bool all_fixed = all_are_fixed(overlap.elements().triangles()[t], held);
    sent_[static_cast<std::size_t>(rank)].push_back(static_cast<std::int32_t>(t));
    sent[static_cast<std::size_t>(rank)].push_back({static_cast<std::int32_t>(*id - first_block(rank) * block_size),
                                                    regions.empty() ? 0 : regions[t],
                                                    all_fixed ? std::uint8_t{1} : std::uint8_t{0}});
  }
  const mpi::ByRank<Reported> received = ranks_.exchanged(std::move(sent));
  std::size_t count = 0;
  for (const auto& list : received) {
    count += list.size();
  }
  all_fixed_.resize(count);
  regions_.resize(region_count_ > 1 ? count : 0);
  places_ = mpi::lists_by_rank<std::int32_t>(ranks_);
  for (std::size_t r = 0; r < received.size(); ++r) {
    places_[r].reserve(received[r].size());
    for (const Reported& triangle : received[r]) {
      const auto place = static_cast<std::size_t>(triangle.place);
      places_[r].push_back(triangle.place);
      all_fixed_[place] = triangle.all_fixed;
      if (!regions_.empty()) {
        regions_[place] = triangle.region;
      }
    }
  }
  corner_numbers_.resize(std::min(count, static_cast<std::size_t>(blocks_a_round * block_size)));
  for (std::size_t t = 0; t < corner_numbers_.size(); ++t) {
    const auto corner = static_cast<std::int32_t>(3 * t);
    corner_numbers_[t] = {corner, corner + 1, corner + 2};
  }
}

std::int64_t RankQuality::rounds() const {
  const std::int64_t most_blocks = (blocks_ + ranks_.size() - 1) / ranks_.size();
  return (most_blocks + blocks_a_round - 1) / blocks_a_round;
}

std::int64_t RankQuality::first_of_round(int rank, std::int64_t round) const {
  const std::int64_t blocks = first_block(rank + 1) - first_block(rank);
  return std::min(round * blocks_a_round, blocks) * block_size;
}

BulkVector<Point2<double>> RankQuality::corners_of_round(std::span<const Point2<double>> points,
                                                         std::int64_t round) const {
  const mpi::Overlap& overlap = topology_.overlap();
  auto sent = mpi::lists_by_rank<CornerPoints>(ranks_);
  for (std::size_t r = 0; r < sent.size(); ++r) {
    const auto rank = static_cast<int>(r);
    const std::int64_t first = first_block(rank) * block_size;
    const auto begin_of = [&](std::int64_t of_round) {
      return std::ranges::lower_bound(sent_[r], first + first_of_round(rank, of_round), {}, [&](std::int32_t t) {
        return overlap.triangle_ids[static_cast<std::size_t>(t)];
      });
    };
    const std::span triangles(begin_of(round), begin_of(round + 1));
    sent[r].reserve(triangles.size());
    for (const std::int32_t t : triangles) {
      const auto triangle = static_cast<std::size_t>(t);
      sent[r].push_back(
          points_of(canonical_corners(overlap.elements().triangles()[triangle], reversed_[triangle] != 0), points));
    }
  }
  const std::int64_t first = first_of_round(ranks_.rank(), round);
  const std::int64_t last = std::min(first_of_round(ranks_.rank(), round + 1), std::ssize(all_fixed_));
  std::vector<std::span<const std::int32_t>> places;
  std::vector<std::int64_t> counts;
  for (const auto& list : places_) {
    places.emplace_back(std::ranges::lower_bound(list, first), std::ranges::lower_bound(list, last));
    counts.push_back(std::ssize(places.back()));
  }
  const mpi::ByRank<CornerPoints> received = ranks_.exchanged(std::move(sent), counts);
  BulkVector<Point2<double>> corners(static_cast<std::size_t>(3 * (last - first)));
  for (std::size_t r = 0; r < received.size(); ++r) {
    for (std::size_t i = 0; i < received[r].size(); ++i) {
      std::ranges::copy(received[r][i], corners.begin() + 3 * (places[r][i] - first));
    }
  }
  return corners;
}

template <class Visit>
void RankQuality::for_rounds(std::span<const Point2<double>> points, int exponent, const Visit& visit) const {
  for (std::int64_t round = 0; round < rounds(); ++round) {
    const BulkVector<Point2<double>> corners = corners_of_round(points, round);
    visit(TriangleView{corners, std::span(corner_numbers_).first(corners.size() / 3), {}, exponent},
          static_cast<std::size_t>(first_of_round(ranks_.rank(), round)));
  }
}

QualityReport RankQuality::report(std::span<const Point2<double>> points, const LocalFrame& frame, int threads) const {
  const QualityOptions options{.threads = threads};
  QualityParts all;
  for_rounds(points, frame.exponent, [&](const TriangleView& view, std::size_t first) {
    QualityParts made = quality_parts(view, options);
    all.parts.insert(all.parts.end(), made.parts.begin(), made.parts.end());
    for (WorstElement& element : made.worst) {
      const std::size_t place = first + static_cast<std::size_t>(element.element);
      element.element = first_block(ranks_.rank()) * block_size + static_cast<std::int64_t>(place);
      element.all_fixed = all_fixed_[place] != 0;
      element.region = regions_.empty() ? -1 : regions_[place];
      element.centroid = frame.leave(element.centroid);
      all.worst.push_back(element);
    }
  });
  const std::vector<QualityPart> total =
      passed_on(std::vector<QualityPart>(1), ranks_, [&](std::vector<QualityPart>& states) {
        for (const QualityPart& part : all.parts) {
          states.front().append(part);
        }
      });
  return report_of(total.front(), worst_of_all(all.worst, static_cast<std::size_t>(options.worst_count), ranks_),
                   frame.exponent);
}

std::vector<RegionQuality> RankQuality::regions(std::span<const Point2<double>> points) const {
  std::vector<RegionQuality> qualities;
  if (region_count_ < 2) {
    return qualities;
  }
  std::vector<std::array<double, 2>> values;
  values.reserve(regions_.size());
  for_rounds(points, 0, [&](const TriangleView& view, std::size_t /*first*/) {
    for (std::size_t corner = 0; corner < view.points.size(); corner += 3) {
      const auto value = [&](Metric metric) {
        return evaluate(metric, view.points[corner], view.points[corner + 1], view.points[corner + 2]);
      };
      values.push_back({value(Metric::shape), value(Metric::min_angle)});
    }
  });
  const std::vector<RegionPart> parts = passed_on(
      std::vector<RegionPart>(static_cast<std::size_t>(region_count_)), ranks_, [&](std::vector<RegionPart>& states) {
        for (std::size_t t = 0; t < values.size(); ++t) {
          states[static_cast<std::size_t>(regions_[t])].add(values[t][0], values[t][1]);
        }
      });
  std::ranges::transform(parts, std::back_inserter(qualities), &RegionPart::quality);
  return qualities;
}

SizeChange RankQuality::size_change(std::span<const Point2<double>> before, const LocalFrame& frame_before,
                                    std::span<const Point2<double>> after, const LocalFrame& frame_after,
                                    int threads) const {
  AreaRatios made;
  for (std::int64_t round = 0; round < rounds(); ++round) {
    const BulkVector<Point2<double>> old_corners = corners_of_round(before, round);
    const BulkVector<Point2<double>> corners = corners_of_round(after, round);
    const std::span<const Triangle> triangles = std::span(corner_numbers_).first(corners.size() / 3);
    const AreaRatios of_round = area_ratios(TriangleView{old_corners, triangles, {}, frame_before.exponent},
                                            TriangleView{corners, triangles, {}, frame_after.exponent}, threads);
    made.ratios.insert(made.ratios.end(), of_round.ratios.begin(), of_round.ratios.end());
    made.sums.insert(made.sums.end(), of_round.sums.begin(), of_round.sums.end());
  }
  const double sum = passed_on(std::vector<double>(1), ranks_, [&](std::vector<double>& states) {
                       for (const double part : made.sums) {
                         states.front() += part;
                       }
                     }).front();
  return size_change_of(
      made.ratios, sum, [this](std::vector<std::int64_t>& counts) { ranks_.sum(counts); }, threads);
}

PrecisionLoss RankQuality::precision_loss(std::span<const Point2<double>> points, int exponent, int threads) const {
  PrecisionLoss loss;
  for_rounds(points, exponent, [&](const TriangleView& view, std::size_t /*first*/) {
    const PrecisionLoss of_round = single_precision_loss(view, threads);
    loss.elements += of_round.elements;
    loss.collapsed += of_round.collapsed;
    loss.distorted += of_round.distorted;
  });
  return {ranks_.sum(loss.elements), ranks_.sum(loss.collapsed), ranks_.sum(loss.distorted)};
}

}  // namespace trismooth
