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

template <class Corners>
std::vector<std::uint8_t> why_fixed(const TriangleTopology& topology, std::span<const Corners> elements,
                                    const Constraints& constraints, Workers& workers) {
  constexpr std::int32_t sides = sides_of<std::span<const Corners>>;
  check_constraints(constraints, topology.vertex_count, std::ssize(elements));
  std::vector<std::uint8_t> reasons = topology.hold;
  hold_named_vertices(constraints, reasons);
  if (!constraints.regions.empty()) {
    workers.for_blocks(std::ssize(elements), fixed_grain, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t e = begin; e < end; ++e) {
        const std::int32_t corners = corner_count(elements[e]);
        for (std::int32_t i = 0; i < corners; ++i) {
          const std::int32_t twin = topology.twins[sides * e + i];
          if (twin > sides * e + i && constraints.regions[e] != constraints.regions[twin / sides]) {
            set_bits_relaxed(reasons[elements[e][i]], hold::interface);
            set_bits_relaxed(reasons[elements[e][(i + 1) % corners]], hold::interface);
          }
        }
      }
    });
  }
  return reasons;
}

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
  return why_fixed(topology, triangles, constraints, workers);
}

std::vector<std::uint8_t> fixed_vertices(const TriangleTopology& topology, std::span<const MixedElement> elements,
                                         const Constraints& constraints, Workers& workers) {
  return why_fixed(topology, elements, constraints, workers);
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
