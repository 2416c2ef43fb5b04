#include "trismooth/smoothing/rings/packed_rings.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "trismooth/base/workers.h"
#include "trismooth/smoothing/rings/colouring.h"
#include "trismooth/smoothing/rings/vertex_order.h"

namespace trismooth {

namespace {

constexpr std::int64_t packing_grain = 8192;
constexpr std::int64_t window = 1024;  // vertices: 16 KiB of points

/// `rings` renumbered: vertex order[v] becomes v. The first `free_count` vertices of the order have rings.
PackedRings renumbered(const RingView& rings, const std::vector<std::int32_t>& order, std::int32_t free_count,
                       Workers& workers) {
  PackedRings packed;
  packed.input_index.resize(order.size());
  packed.offsets.assign(static_cast<std::size_t>(free_count) + 1, 0);
  std::vector<std::int32_t> new_number(order.size());
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(order.size()); ++v) {
    new_number[order[v]] = v;
    packed.input_index[v] = rings.input(order[v]);
    if (v < free_count) {
      packed.offsets[v + 1] = packed.offsets[v] + static_cast<std::int64_t>(rings[order[v]].size());
    }
  }
  packed.neighbours.resize(static_cast<std::size_t>(packed.offsets.back()));
  workers.for_blocks(free_count, packing_grain, [&](std::int64_t begin, std::int64_t end) {
    for (auto v = static_cast<std::int32_t>(begin); v < end; ++v) {
      std::ranges::transform(rings[order[v]], packed.neighbours.begin() + packed.offsets[v],
                             [&](std::int32_t neighbour) { return new_number[neighbour]; });
    }
  });
  return packed;
}

/// The free vertices' numbers by colour, each colour's in their order (a counting sort), and the batches of colours.
std::vector<std::int32_t> grouped_by_colour(const Colouring& colouring, std::int32_t vertex_count,
                                            std::vector<std::int32_t>& batches) {
  batches.assign(static_cast<std::size_t>(colouring.count) + 1, 0);
  for (const std::int32_t colour : colouring.colours) {
    ++batches[colour + 1];
  }
  for (std::int32_t c = 0; c < colouring.count; ++c) {
    batches[c + 1] += batches[c];
  }
  std::vector<std::int32_t> place(batches.begin(), batches.end() - 1);
  std::vector<std::int32_t> order(static_cast<std::size_t>(vertex_count));
  const auto free_count = static_cast<std::int32_t>(colouring.colours.size());
  for (std::int32_t v = 0; v < vertex_count; ++v) {
    order[v < free_count ? place[colouring.colours[v]]++ : v] = v;
  }
  return order;
}

void sort_windows_by_ring_size(const RingView& rings, std::span<const std::int32_t> batches,
                               std::vector<std::int32_t>& order, Workers& workers) {
  for (std::size_t batch = 0; batch + 1 < batches.size(); ++batch) {
    const std::int64_t size = batches[batch + 1] - batches[batch];
    std::int32_t* const first = order.data() + batches[batch];
    workers.for_blocks((size + window - 1) / window, 1, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t w = begin; w < end; ++w) {
        std::ranges::stable_sort(first + w * window, first + std::min((w + 1) * window, size), {},
                                 [&](std::int32_t v) { return rings[v].size(); });
      }
    });
  }
}

}  // namespace

PackedRings pack_rings(const OneRings& rings, std::span<const Point2<double>> points, Form form, Workers& workers) {
  std::vector<std::int32_t> order = hilbert_order(points, rings, workers);
  const auto free_end = std::ranges::find_if_not(order, [&](std::int32_t v) { return rings.is_free(v); });
  const auto free_count = static_cast<std::int32_t>(free_end - order.begin());
  // Everything that walks over neighbours does so along the curve: that pays for renumbering twice.
  const PackedRings along_curve = renumbered(rings.view(), order, free_count, workers);

  std::vector<std::int32_t> batches{0, free_count};
  std::int32_t colours = 0;
  if (form == Form::in_place) {
    const Colouring colouring = colour_free_vertices(along_curve.view(), workers);
    colours = colouring.count;
    order = grouped_by_colour(colouring, rings.vertex_count(), batches);
  } else {
    std::iota(order.begin(), order.end(), 0);
  }
  sort_windows_by_ring_size(along_curve.view(), batches, order, workers);
  PackedRings packed = renumbered(along_curve.view(), order, free_count, workers);
  packed.batches = std::move(batches);
  packed.colours = colours;
  return packed;
}

}  // namespace trismooth
