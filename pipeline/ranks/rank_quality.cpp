#include "trismooth/pipeline/ranks/rank_quality.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include <mpi.h>

#include "trismooth/quality/area_ratios.h"
#include "trismooth/quality/metrics.h"
#include "trismooth/quality/quality_part.h"

namespace trismooth {

namespace {

// Blocks of triangles may not be cut between ranks.
constexpr auto block_size = static_cast<std::int64_t>(triangles_a_quality_part);
static_assert(triangles_a_size_part == triangles_a_quality_part);

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
  const mpi::ByRank<WorstElement> to_all(static_cast<std::size_t>(ranks.size()), own);
  std::vector<WorstElement> all;
  for (const auto& list : ranks.exchanged(to_all)) {
    all.insert(all.end(), list.begin(), list.end());
  }
  std::ranges::sort(all, is_worse);
  all.resize(std::min(all.size(), count));
  return all;
}

/// Counts of ratios by their leading bits, as size_change() finds percentiles, until one value is left. Ratios are not
/// negative, so their bits stand in their order.
double percentile_of_all(std::span<const double> ratios, std::int64_t total, std::int64_t percent,
                         const mpi::Communicator& ranks) {
  constexpr int digit_bits = 16;
  constexpr std::size_t digits = std::size_t{1} << digit_bits;
  std::int64_t rank = (total * percent + 99) / 100;
  std::uint64_t prefix = 0;
  for (int bits = 0; bits < 64; bits += digit_bits) {
    std::vector<std::int64_t> counts(digits);
    for (const double ratio : ratios) {
      const auto value = std::bit_cast<std::uint64_t>(ratio);
      if (!std::isnan(ratio) && (bits == 0 || value >> (64 - bits) == prefix)) {
        ++counts[value >> (64 - bits - digit_bits) & (digits - 1)];
      }
    }
    MPI_Allreduce(MPI_IN_PLACE, counts.data(), static_cast<int>(digits), MPI_INT64_T, MPI_SUM, ranks.handle());
    std::size_t digit = 0;
    while (counts[digit] < rank) {
      rank -= counts[digit++];
    }
    prefix = prefix << digit_bits | digit;
  }
  return std::bit_cast<double>(prefix);
}

/// What has been added up of a region. Shapes are added up in chunks of that many triangles of the region, and chunks
/// to the total, as region_quality() does it.
struct RegionSums {
  RegionQuality total{0, 0, std::numeric_limits<double>::infinity(), 0, std::numeric_limits<double>::infinity()};
  double chunk = 0;

  void add(double shape, double angle) {
    ++total.triangles;
    total.inverted += shape < 0 ? 1 : 0;
    total.min_shape = std::min(total.min_shape, shape);
    total.min_angle = std::min(total.min_angle, angle);
    chunk += shape;
    if (total.triangles % block_size == 0) {
      total.mean_shape += std::exchange(chunk, 0.0);
    }
  }

  RegionQuality quality() const {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    if (total.triangles == 0) {
      return {0, 0, nan, nan, nan};
    }
    const double sum = total.triangles % block_size == 0 ? total.mean_shape : total.mean_shape + chunk;
    RegionQuality quality = total;
    quality.mean_shape = sum / static_cast<double>(total.triangles);
    return quality;
  }
};

}  // namespace

RankQuality::RankQuality(const RankTopology& topology, std::span<const std::uint8_t> reversed,
                         std::span<const std::uint8_t> held, std::span<const std::int32_t> regions,
                         std::int32_t region_count)
    : ranks_(topology.ranks()), region_count_(region_count) {
  const mpi::Overlap& overlap = topology.overlap();
  const std::int64_t blocks = (topology.triangle_count() + block_size - 1) / block_size;
  const auto first_block = [&](int rank) { return blocks * rank / ranks_.size(); };
  sent_ = mpi::lists_by_rank<std::int32_t>(ranks_);
  auto sent = mpi::lists_by_rank<Reported>(ranks_);
  for (std::size_t t = 0; t < overlap.triangles.size(); ++t) {
    if (!topology.counts(t)) {
      continue;
    }
    const std::int64_t block = overlap.triangle_ids[t] / block_size;
    auto rank = static_cast<int>(block * ranks_.size() / blocks);
    while (block >= first_block(rank + 1)) {
      ++rank;
    }
    const Triangle& corners = overlap.triangles[t];
    const bool all_fixed = std::ranges::all_of(corners, [&](std::int32_t v) { return held[v] != 0; });
    sent_[static_cast<std::size_t>(rank)].push_back(static_cast<std::int32_t>(canonical_.size()));
    sent[static_cast<std::size_t>(rank)].push_back(
        {overlap.triangle_ids[t], regions.empty() ? 0 : regions[t], all_fixed ? std::uint8_t{1} : std::uint8_t{0}});
    canonical_.push_back(canonical_corners(corners, reversed[t] != 0));
  }
  const mpi::ByRank<Reported> received = ranks_.exchanged(sent);
  const std::int64_t first = first_block(ranks_.rank()) * block_size;
  std::size_t count = 0;
  for (const auto& list : received) {
    count += list.size();
  }
  reported_.resize(count);
  places_ = mpi::lists_by_rank<std::int64_t>(ranks_);
  for (std::size_t r = 0; r < received.size(); ++r) {
    for (const Reported& triangle : received[r]) {
      places_[r].push_back(triangle.id - first);
      reported_[static_cast<std::size_t>(triangle.id - first)] = triangle;
    }
  }
  corner_numbers_.resize(count);
  for (std::size_t t = 0; t < count; ++t) {
    const auto corner = static_cast<std::int32_t>(3 * t);
    corner_numbers_[t] = {corner, corner + 1, corner + 2};
  }
}

std::vector<Point2<double>> RankQuality::corners_at(std::span<const Point2<double>> points) const {
  using Corners = std::array<Point2<double>, 3>;
  auto sent = mpi::lists_by_rank<Corners>(ranks_);
  for (std::size_t r = 0; r < sent.size(); ++r) {
    for (const std::int32_t t : sent_[r]) {
      const auto& [a, b, c] = canonical_[static_cast<std::size_t>(t)];
      sent[r].push_back({points[static_cast<std::size_t>(a)], points[static_cast<std::size_t>(b)],
                         points[static_cast<std::size_t>(c)]});
    }
  }
  const mpi::ByRank<Corners> received = ranks_.exchanged(sent);
  std::vector<Point2<double>> corners(3 * reported_.size());
  for (std::size_t r = 0; r < received.size(); ++r) {
    for (std::size_t i = 0; i < received[r].size(); ++i) {
      std::ranges::copy(received[r][i], corners.begin() + static_cast<std::ptrdiff_t>(3 * places_[r][i]));
    }
  }
  return corners;
}

TriangleView RankQuality::view(std::span<const Point2<double>> corners, int exponent) const {
  return {corners, corner_numbers_, {}, exponent};
}

QualityReport RankQuality::report(std::span<const Point2<double>> corners, const LocalFrame& frame, int threads) const {
  const QualityOptions options{.threads = threads};
  QualityParts made = quality_parts(view(corners, frame.exponent), options);
  for (WorstElement& element : made.worst) {
    const Reported& triangle = reported_[static_cast<std::size_t>(element.triangle)];
    element.triangle = triangle.id;
    element.all_fixed = triangle.all_fixed != 0;
    element.region = region_count_ > 1 ? triangle.region : -1;
    element.centroid = frame.leave(element.centroid);
  }
  const std::vector<QualityPart> total =
      passed_on(std::vector<QualityPart>(1), ranks_, [&](std::vector<QualityPart>& states) {
        for (const QualityPart& part : made.parts) {
          states.front().append(part);
        }
      });
  return report_of(total.front(), worst_of_all(made.worst, static_cast<std::size_t>(options.worst_count), ranks_),
                   frame.exponent);
}

std::vector<RegionQuality> RankQuality::regions(std::span<const Point2<double>> corners) const {
  std::vector<RegionQuality> qualities;
  if (region_count_ < 2) {
    return qualities;
  }
  std::vector<std::array<double, 2>> values(reported_.size());
  for (std::size_t t = 0; t < values.size(); ++t) {
    const auto value = [&](Metric metric) {
      return evaluate(metric, corners[3 * t], corners[3 * t + 1], corners[3 * t + 2]);
    };
    values[t] = {value(Metric::shape), value(Metric::min_angle)};
  }
  const std::vector<RegionSums> sums = passed_on(
      std::vector<RegionSums>(static_cast<std::size_t>(region_count_)), ranks_, [&](std::vector<RegionSums>& states) {
        for (std::size_t t = 0; t < values.size(); ++t) {
          states[static_cast<std::size_t>(reported_[t].region)].add(values[t][0], values[t][1]);
        }
      });
  for (const RegionSums& of_region : sums) {
    qualities.push_back(of_region.quality());
  }
  return qualities;
}

SizeChange RankQuality::size_change(std::span<const Point2<double>> before, const LocalFrame& frame_before,
                                    std::span<const Point2<double>> after, const LocalFrame& frame_after,
                                    int threads) const {
  const AreaRatios made = area_ratios(view(before, frame_before.exponent), view(after, frame_after.exponent), threads);
  SizeChange change;
  change.triangles = ranks_.sum(std::ranges::count_if(made.ratios, [](double ratio) { return !std::isnan(ratio); }));
  change.left_out = ranks_.sum(std::ssize(made.ratios)) - change.triangles;
  const double sum = passed_on(std::vector<double>(1), ranks_, [&](std::vector<double>& states) {
                       for (const double part : made.sums) {
                         states.front() += part;
                       }
                     }).front();
  if (change.triangles == 0) {
    change.rms_log_ratio = change.ratio_p1 = change.ratio_p99 = std::numeric_limits<double>::quiet_NaN();
    return change;
  }
  change.rms_log_ratio = std::sqrt(sum / static_cast<double>(change.triangles));
  change.ratio_p1 = percentile_of_all(made.ratios, change.triangles, 1, ranks_);
  change.ratio_p99 = percentile_of_all(made.ratios, change.triangles, 99, ranks_);
  return change;
}

}  // namespace trismooth
