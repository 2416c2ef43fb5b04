// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/region_quality.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

#include "trismooth/base/counting_sort.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/quality/corner_points.h"
#include "trismooth/quality/metric_lanes.h"
#include "trismooth/quality/region_part.h"

namespace trismooth {

namespace {

/// Some elements of one region: members[begin .. end). Of this size whatever the number of threads, and combined in
/// order: no rounding depends on scheduling.
struct Chunk {
  std::size_t region;
  std::size_t begin;
  std::size_t end;
};

constexpr auto chunk_size = static_cast<std::size_t>(RegionPart::triangles_a_chunk);

template <class Corners>
RegionPart part_of(const ElementView<Corners>& view, std::span<const std::int32_t> members) {
  RegionPart part;
  for (const std::int32_t element : members) {
    with_points(view, static_cast<std::size_t>(element), [&]<class Points>(const Points& corners) {
      part.add(evaluate(Metric::shape, corners), evaluate(Metric::min_angle, corners), KindMetrics<Points>::kind);
    });
  }
  return part;
}

}  // namespace

std::vector<RegionQuality> region_quality(const MeshView& view, std::span<const std::int32_t> region_of,
                                          std::int32_t region_count, int threads) {
  Workers workers(threads);
  // The elements by region, in their order within each.
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
  std::vector<RegionPart> partials(chunks.size());
  workers.for_blocks(static_cast<std::int64_t>(chunks.size()), 1, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      const auto of_chunk = std::span(members).subspan(chunks[i].begin, chunks[i].end - chunks[i].begin);
      partials[i] = view.visit([&](const auto& elements) { return part_of(elements, of_chunk); });
    }
  });

  std::vector<RegionPart> parts(static_cast<std::size_t>(region_count));
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    parts[chunks[i].region].append(partials[i]);
  }
  std::vector<RegionQuality> regions;
  std::ranges::transform(parts, std::back_inserter(regions), &RegionPart::quality);
  return regions;
}

}  // namespace trismooth
