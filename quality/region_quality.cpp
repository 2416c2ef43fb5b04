#include "trismooth/quality/region_quality.h"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "trismooth/base/counting_sort.h"
#include "trismooth/base/workers.h"
#include "trismooth/quality/corner_points.h"
#include "trismooth/quality/metrics.h"

namespace trismooth {

namespace {

/// Some triangles of one region: members[begin .. end). Of this size whatever the number of threads, and combined in
/// order: no rounding depends on scheduling.
struct Chunk {
  std::size_t region;
  std::size_t begin;
  std::size_t end;
};

constexpr std::size_t chunk_size = 1024;

/// What a chunk, or several in order, contribute; `mean_shape` is the sum as yet.
void append(RegionQuality& total, const RegionQuality& next) {
  total.triangles += next.triangles;
  total.inverted += next.inverted;
  total.min_shape = std::min(total.min_shape, next.min_shape);
  total.mean_shape += next.mean_shape;
  total.min_angle = std::min(total.min_angle, next.min_angle);
}

constexpr double unbounded = std::numeric_limits<double>::infinity();
constexpr RegionQuality nothing{0, 0, unbounded, 0, unbounded};

RegionQuality quality_of(const TriangleView& view, std::span<const std::int32_t> members) {
  RegionQuality quality = nothing;
  for (const std::int32_t triangle : members) {
    const auto [a, b, c] = corner_points(view, static_cast<std::size_t>(triangle));
    const double shape = evaluate(Metric::shape, a, b, c);
    append(quality, {1, shape < 0 ? 1 : 0, shape, shape, evaluate(Metric::min_angle, a, b, c)});
  }
  return quality;
}

}  // namespace

std::vector<RegionQuality> region_quality(const TriangleView& view, std::span<const std::int32_t> region_of,
                                          std::int32_t region_count, int threads) {
  Workers workers(threads);
  // The triangles by region, in their order within each.
  std::vector<std::int32_t> members(region_of.size());
  const std::vector<std::int64_t> offsets = counting_sort(
      std::ssize(region_of), region_count, [&](std::int64_t t) { return region_of[t]; },
      [&](std::int64_t t, std::int64_t place) { members[place] = static_cast<std::int32_t>(t); }, workers);

  std::vector<Chunk> chunks;
  for (std::size_t r = 0; r + 1 < offsets.size(); ++r) {
    const auto end = static_cast<std::size_t>(offsets[r + 1]);
    for (auto begin = static_cast<std::size_t>(offsets[r]); begin < end; begin += chunk_size) {
      chunks.push_back({r, begin, std::min(begin + chunk_size, end)});
    }
  }
  std::vector<RegionQuality> partials(chunks.size());
  workers.for_blocks(static_cast<std::int64_t>(chunks.size()), 1, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      partials[i] = quality_of(view, std::span(members).subspan(chunks[i].begin, chunks[i].end - chunks[i].begin));
    }
  });

  std::vector<RegionQuality> regions(static_cast<std::size_t>(region_count), nothing);
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    append(regions[chunks[i].region], partials[i]);
  }
  for (RegionQuality& region : regions) {
    if (region.triangles == 0) {
      region.min_shape = region.mean_shape = region.min_angle = std::numeric_limits<double>::quiet_NaN();
    } else {
      region.mean_shape /= static_cast<double>(region.triangles);
    }
  }
  return regions;
}

}  // namespace trismooth
