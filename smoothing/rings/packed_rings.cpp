// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/rings/packed_rings.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "trismooth/base/counting_sort.h"
#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/machine/prefetch.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/prefix_sums.h"
#include "trismooth/smoothing/parts/mesh_part.h"
#include "trismooth/smoothing/rings/colouring.h"
#include "trismooth/smoothing/rings/vertex_order.h"

namespace trismooth {

namespace {

constexpr std::int64_t packing_grain = 8192;
constexpr std::int64_t window = 1024;  // vertices: 16 KiB of points
constexpr std::int64_t windows_grain = 8;
constexpr std::int64_t ahead = 16;  // vertices

/// `rings` renumbered: vertex order[v] becomes v. The first `free_count` vertices of the order have rings.
PackedRings renumbered(const RingView& rings, std::span<const std::int32_t> order, std::int32_t free_count,
                       Workers& workers) {
  PackedRings packed;
  packed.input_index.resize(order.size());
  packed.offsets.resize(static_cast<std::size_t>(free_count) + 1);
  BulkVector<std::int32_t> new_number(order.size());
  workers.for_blocks(std::ssize(order), packing_grain, [&](std::int64_t begin, std::int64_t end) {
    for (auto v = static_cast<std::int32_t>(begin); v < end; ++v) {
      // The order may run through memory at random.
      prefetch(&new_number[order[std::min<std::int64_t>(v + ahead, end - 1)]]);
      new_number[order[v]] = v;
      packed.input_index[v] = rings.input(order[v]);
    }
  });
  prefix_sums<std::int64_t>(
      packed.offsets, [&](std::int64_t v) { return rings[order[v]].size(); }, workers);
  packed.neighbours.resize(static_cast<std::size_t>(packed.offsets.back()));
  packed.opposites.resize(rings.has_quadrilaterals() ? packed.neighbours.size() : 0);
  workers.for_blocks(free_count, packing_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t v = begin; v < end; ++v) {
      prefetch(&rings.offsets[order[std::min(v + 2 * ahead, end - 1)]]);
      prefetch(rings[order[std::min(v + ahead, end - 1)]].data());
      std::ranges::transform(rings[order[v]], packed.neighbours.begin() + packed.offsets[v],
                             [&](std::int32_t neighbour) { return new_number[neighbour]; });
      if (rings.has_quadrilaterals()) {
        std::ranges::transform(
            rings.mixed(order[v]).opposites, packed.opposites.begin() + packed.offsets[v],
            [&](std::int32_t opposite) { return opposite == no_corner ? no_corner : new_number[opposite]; });
      }
    }
  });
  return packed;
}

/// Writes the numbers from `first` on, in their order.
void list_all(std::span<std::int32_t> order, std::int64_t first, Workers& workers) {
  workers.for_blocks(std::ssize(order), packing_grain, [&](std::int64_t begin, std::int64_t end) {
    std::iota(order.begin() + begin, order.begin() + end, static_cast<std::int32_t>(first + begin));
  });
}

/// The free vertices' numbers by colour, each colour's in their order, and the batches of colours.
BulkVector<std::int32_t> grouped_by_colour(const Colouring& colouring, std::int32_t vertex_count,
                                           std::vector<std::int32_t>& batches, Workers& workers) {
  BulkVector<std::int32_t> order(static_cast<std::size_t>(vertex_count));
  const std::int64_t free_count = std::ssize(colouring.colours);
  const std::vector<std::int64_t> begins = counting_sort(
      free_count, colouring.count, [&](std::int64_t v) { return colouring.colours[v]; },
      [&](std::int64_t v, std::int64_t place) { order[place] = static_cast<std::int32_t>(v); }, workers);
  batches.assign(begins.begin(), begins.end());
  list_all(std::span(order).subspan(static_cast<std::size_t>(free_count)), free_count, workers);
  return order;
}

/// Adds a run behind the others, to the last of them where it goes on.
void add_run(std::vector<RingRun>& runs, const RingRun& run) {
  if (!runs.empty() && runs.back().ring_size == run.ring_size && runs.back().kind == run.kind) {
    runs.back().end = run.end;
  } else {
    runs.push_back(run);
  }
}

std::vector<RingRun> runs_of(const RingView& rings, Workers& workers) {
  const std::int64_t count = rings.size();
  std::vector<std::vector<RingRun>> blocks(static_cast<std::size_t>((count + packing_grain - 1) / packing_grain));
  workers.for_blocks(std::ssize(blocks), 1, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t block = first; block < last; ++block) {
      const std::int64_t end = std::min(count, (block + 1) * packing_grain);
      for (auto v = static_cast<std::int32_t>(block * packing_grain); v < end; ++v) {
        add_run(blocks[block], {v + 1, static_cast<std::int32_t>(rings[v].size()), rings.kind(v)});
      }
    }
  });
  std::vector<RingRun> runs;
  for (const std::vector<RingRun>& block : blocks) {
    for (const RingRun& run : block) {
      add_run(runs, run);
    }
  }
  return runs;
}

/// Sorts no more than a window of vertices, which ascend, by the sizes of their rings and by their kinds, and keeps the
/// order of equal ones.
void sort_by_ring_size(const RingView& rings, std::span<std::int32_t> vertices) {
  constexpr std::size_t kinds = 3;
  constexpr std::size_t usual_keys = 64 * kinds;
  const auto key_of = [&](std::int32_t v) { return kinds * rings[v].size() + static_cast<std::size_t>(rings.kind(v)); };
  std::array<std::int32_t, usual_keys + 1> places{};
  for (const std::int32_t v : vertices) {
    const std::size_t key = key_of(v);
    if (key >= usual_keys) {
      std::ranges::sort(vertices, {}, [&](std::int32_t w) { return std::pair(key_of(w), w); });
      return;
    }
    ++places[key + 1];
  }
  std::partial_sum(places.begin(), places.end(), places.begin());
  std::array<std::int32_t, window> sorted;
  for (const std::int32_t v : vertices) {
    sorted[places[key_of(v)]++] = v;
  }
  std::copy_n(sorted.begin(), vertices.size(), vertices.begin());
}

void sort_windows_by_ring_size(const RingView& rings, std::span<const std::int32_t> batches,
                               std::span<std::int32_t> order, Workers& workers) {
  for (std::size_t batch = 0; batch + 1 < batches.size(); ++batch) {
    const std::int64_t size = batches[batch + 1] - batches[batch];
    const auto vertices = order.subspan(static_cast<std::size_t>(batches[batch]), static_cast<std::size_t>(size));
    workers.for_blocks((size + window - 1) / window, windows_grain, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t w = begin; w < end; ++w) {
        const std::int64_t first = w * window;
        sort_by_ring_size(rings, vertices.subspan(static_cast<std::size_t>(first),
                                                  static_cast<std::size_t>(std::min(window, size - first))));
      }
    });
  }
}

/// The colours of a part as its batches: those of its vertices that are ghosts elsewhere are even, the others odd.
Colouring batches_of_part(const MeshPart& part, const RingView& rings, Form form) {
  std::vector<std::uint8_t> is_awaited(part.ghosts.size(), 0);
  for (const MeshPart::Neighbour& neighbour : part.neighbours) {
    for (const std::int32_t v : neighbour.sends) {
      is_awaited[v] = 1;
    }
  }
  Colouring colouring;
  colouring.count = form == Form::in_place ? 2 * part.colour_count : 2;
  colouring.colours.resize(static_cast<std::size_t>(rings.size()));
  for (std::int32_t v = 0; v < rings.size(); ++v) {
    const std::int32_t input = rings.input(v);
    const std::int32_t colour = form == Form::in_place ? part.colours[input] : 0;
    colouring.colours[v] = 2 * colour + (is_awaited[input] != 0 ? 0 : 1);
  }
  return colouring;
}

/// Puts ghosts that are free first among vertices without a ring; how many they are.
std::int32_t put_free_ghosts_first(const MeshPart& part, std::span<std::int32_t> ringless) {
  const auto rest =
      std::partition(ringless.begin(), ringless.end(), [&](std::int32_t v) { return part.colours[v] != no_colour; });
  return static_cast<std::int32_t>(rest - ringless.begin());
}

}  // namespace

PackedRings pack_rings(OneRings rings, std::span<const Point2<double>> points, Form form, Workers& workers,
                       const MeshPart* part) {
  BulkVector<std::int32_t> order = hilbert_order(points, rings, workers);
  const auto free_end =
      std::partition_point(order.begin(), order.end(), [&](std::int32_t v) { return rings.is_free(v); });
  const auto free_count = static_cast<std::int32_t>(free_end - order.begin());
  const std::int32_t free_ghosts =
      part == nullptr ? 0
                      : put_free_ghosts_first(*part, std::span(order).subspan(static_cast<std::size_t>(free_count)));
  // Everything that walks over neighbours does so along the curve: that pays for renumbering twice.
  const PackedRings along_curve = renumbered(rings.view(), order, free_count, workers);
  const std::int32_t vertex_count = rings.vertex_count();
  rings = {};

  std::vector<std::int32_t> batches{0, free_count};
  std::int32_t colours = 0;
  if (part != nullptr) {
    const Colouring colouring = batches_of_part(*part, along_curve.view(), form);
    colours = form == Form::in_place ? part->colour_count : 0;
    order = grouped_by_colour(colouring, vertex_count, batches, workers);
  } else if (form == Form::in_place) {
    const Colouring colouring = colour_free_vertices(along_curve.view(), workers);
    colours = colouring.count;
    order = grouped_by_colour(colouring, vertex_count, batches, workers);
  } else {
    list_all(order, 0, workers);
  }
  sort_windows_by_ring_size(along_curve.view(), batches, order, workers);
  PackedRings packed = renumbered(along_curve.view(), order, free_count, workers);
  packed.runs = runs_of(packed.view(), workers);
  packed.batches = std::move(batches);
  packed.colours = colours;
  packed.free_ghosts = free_ghosts;
  return packed;
}

}  // namespace trismooth
