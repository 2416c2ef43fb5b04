#include "trismooth/smoothing/packed_rings.h"

#include <algorithm>

#include "trismooth/smoothing/colouring.h"
#include "trismooth/smoothing/vertex_order.h"

namespace trismooth {

namespace {

constexpr std::int64_t grain = 8192;

/// Sorts the free vertices by colour, keeping their order within each (a counting sort), and notes the batches.
void group_by_colour(const OneRings& rings, std::int32_t free_count, PackedRings& packed, Workers& workers) {
  const std::span<std::int32_t> free(packed.input_index.data(), static_cast<std::size_t>(free_count));
  const Colouring colouring = colour_free_vertices(rings, free, workers);
  packed.colours = colouring.count;
  packed.batches.assign(static_cast<std::size_t>(colouring.count) + 1, 0);
  for (const std::int32_t vertex : free) {
    ++packed.batches[colouring.colours[vertex] + 1];
  }
  for (std::int32_t c = 0; c < colouring.count; ++c) {
    packed.batches[c + 1] += packed.batches[c];
  }
  std::vector<std::int32_t> place(packed.batches.begin(), packed.batches.end() - 1);
  const std::vector<std::int32_t> ungrouped(free.begin(), free.end());
  for (const std::int32_t vertex : ungrouped) {
    free[place[colouring.colours[vertex]]++] = vertex;
  }
}

}  // namespace

PackedRings pack_rings(const OneRings& rings, std::span<const Point2<double>> points, Form form, Workers& workers) {
  PackedRings packed;
  packed.input_index = hilbert_order(points, rings, workers);
  const auto free_end = std::ranges::find_if_not(packed.input_index, [&](std::int32_t v) { return rings.is_free(v); });
  const auto free_count = static_cast<std::int32_t>(free_end - packed.input_index.begin());
  if (form == Form::in_place) {
    group_by_colour(rings, free_count, packed, workers);
  } else {
    packed.batches = {0, free_count};
  }

  std::vector<std::int32_t> packed_index(packed.input_index.size());
  packed.offsets.resize(static_cast<std::size_t>(free_count) + 1);
  packed.offsets[0] = 0;
  for (std::int32_t v = 0; v < packed.vertex_count(); ++v) {
    packed_index[packed.input_index[v]] = v;
    if (v < free_count) {
      packed.offsets[v + 1] = packed.offsets[v] + static_cast<std::int64_t>(rings[packed.input_index[v]].size());
    }
  }
  packed.neighbours.resize(static_cast<std::size_t>(packed.offsets.back()));
  workers.for_blocks(free_count, grain, [&](std::int64_t begin, std::int64_t end) {
    for (auto v = static_cast<std::int32_t>(begin); v < end; ++v) {
      std::ranges::transform(rings[packed.input_index[v]], packed.neighbours.begin() + packed.offsets[v],
                             [&](std::int32_t neighbour) { return packed_index[neighbour]; });
    }
  });
  return packed;
}

}  // namespace trismooth
