// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/rings/fixed_vertices.h"

#include <atomic>
#include <cstddef>

#include "trismooth/base/hold.h"
#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/machine/relaxed_atomics.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/smoothing/rings/listed_rings.h"

namespace trismooth {

namespace {

constexpr std::int64_t fixed_grain = 16384;

}  // namespace

void hold_named_vertices(const Constraints& constraints, std::span<std::uint8_t> reasons) {
  for (std::size_t v = 0; v < constraints.fixed.size(); ++v) {
    if (constraints.fixed[v] != 0) {
      reasons[v] |= hold::named;
    }
  }
  for (std::size_t v = 0; v < constraints.other_cells.size(); ++v) {
    if (constraints.other_cells[v] != 0) {
      reasons[v] |= hold::other_cell;
    }
  }
  for (const std::int32_t v : constraints.fixed_ids) {
    reasons[v] |= hold::named;
  }
  for (const std::int32_t v : constraints.slide.lines) {
    reasons[v] |= hold::line;
  }
  for (const std::int32_t v : constraints.slide.links) {
    reasons[v] |= hold::line;
  }
}

std::vector<std::uint8_t> fixed_vertices(const TriangleTopology& topology, std::span<const Triangle> triangles,
                                         const Constraints& constraints, Workers& workers) {
  check_constraints(constraints, topology.vertex_count, std::ssize(triangles));
  std::vector<std::uint8_t> reasons = topology.hold;
  hold_named_vertices(constraints, reasons);
  if (!constraints.regions.empty()) {
    workers.for_blocks(std::ssize(triangles), fixed_grain, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t t = begin; t < end; ++t) {
        for (std::int32_t i = 0; i < 3; ++i) {
          const std::int32_t twin = topology.twins[3 * t + i];
          if (twin > 3 * t + i && constraints.regions[t] != constraints.regions[twin / 3]) {
            set_bits_relaxed(reasons[triangles[t][i]], hold::interface);
            set_bits_relaxed(reasons[triangles[t][(i + 1) % 3]], hold::interface);
          }
        }
      }
    });
  }
  return reasons;
}

std::vector<std::uint8_t> fixed_vertices(const ListedRings& listed, std::span<const Triangle> triangles,
                                         const Constraints& constraints, Workers& workers) {
  check_constraints(constraints, listed.rings.vertex_count(), std::ssize(triangles));
  std::vector<std::uint8_t> reasons = listed.hold;
  hold_named_vertices(constraints, reasons);
  if (constraints.regions.empty()) {
    return reasons;
  }
  // The triangles of a vertex are one fan: where two of them are of two regions, so are two that share an edge.
  BulkVector<std::int32_t> region(reasons.size());
  workers.for_blocks(std::ssize(triangles), fixed_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t < end; ++t) {
      for (const std::int32_t v : triangles[t]) {
        std::atomic_ref(region[v]).store(constraints.regions[t], std::memory_order_relaxed);
      }
    }
  });
  workers.for_blocks(std::ssize(triangles), fixed_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t < end; ++t) {
      for (const std::int32_t v : triangles[t]) {
        if (region[v] != constraints.regions[t]) {
          set_bits_relaxed(reasons[v], hold::interface);
        }
      }
    }
  });
  return reasons;
}

std::vector<std::uint8_t> fixed_vertices(const TriangleTopology& topology, std::span<const Triangle> triangles,
                                         const Constraints& constraints) {
  Workers one(1);
  return fixed_vertices(topology, triangles, constraints, one);
}

}  // namespace trismooth
