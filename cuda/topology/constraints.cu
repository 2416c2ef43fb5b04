// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/hold.h"
#include "trismooth/cuda/primitives/atomics.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/cuda/runtime/for_each.cuh"
#include "trismooth/cuda/topology/constraints.h"
#include "trismooth/cuda/topology/vertex_fan.h"
#include "trismooth/smoothing/layers/layers.h"

namespace trismooth::cuda {

namespace {

struct PlantTriangle {
  ParityForest forest;

  TRISMOOTH_HOST_DEVICE void operator()(std::uint32_t t) const { forest.plant(t); }
};

/// One thread a vertex. The paper: a vertex is internal if every neighbour has been recorded twice.
struct DetermineConstraints {
  TriangleList triangles;
  CornersView corners;
  DeviceConstraints constraints;
  ParityForest forest;
  std::uint8_t* fixed;
  Findings* findings;

  TRISMOOTH_HOST_DEVICE void operator()(std::uint32_t v) const {
    std::uint8_t reasons = 0;
    if (constraints.fixed != nullptr && constraints.fixed[v] != 0) {
      reasons |= hold::named;
    }
    if (constraints.other_cells != nullptr && constraints.other_cells[v] != 0) {
      reasons |= hold::other_cell;
    }
    const std::uint32_t degree = corners.degree(v);
    if (degree == 0) {
      reasons |= hold::isolated;
    } else if (degree <= VertexFan::capacity) {
      reasons |= look_around(static_cast<std::int32_t>(v), corners.at(v), static_cast<int>(degree));
    }
    fixed[v] = reasons;
  }

  TRISMOOTH_HOST_DEVICE std::uint8_t look_around(std::int32_t v, const std::int32_t* own, int degree) const {
    const VertexFan fan(triangles, own, degree);
    const FanPairs pairs(fan);
    std::uint8_t reasons = pairs.is_one_fan() ? 0 : hold::bow_tie;
    for (int r = 0; r < 2 * degree; ++r) {
      const int partner = pairs.partners[r];
      if (partner == FanPairs::none) {
        reasons |= hold::boundary;
      } else if (partner == FanPairs::many) {
        reasons |= hold::non_manifold;
      } else if (partner > r) {
        const std::int32_t a = own[r / 2] / 3;
        const std::int32_t b = own[partner / 2] / 3;
        if (constraints.regions != nullptr && constraints.regions[a] != constraints.regions[b]) {
          reasons |= hold::interface;
        }
        // Each edge once, from its smaller end. Two triangles are listed alike if the neighbour comes after the vertex
        // in one and before it in the other.
        if (v < fan.neighbours[r]) {
          const std::uint32_t against = r % 2 == partner % 2 ? 1 : 0;
          if (forest.join(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), against) ==
              ParityForest::Join::contradicted) {
            set_bits(&findings->faults, Findings::one_sided);
          }
        }
      }
    }
    return reasons;
  }
};

struct HoldNamed {
  const std::int32_t* ids;
  std::int32_t vertex_count;
  std::uint8_t* fixed;
  Findings* findings;

  TRISMOOTH_HOST_DEVICE void operator()(std::uint32_t i) const {
    const std::int32_t v = ids[i];
    if (v < 0 || v >= vertex_count) {
      set_bits(&findings->faults, Findings::bad_fixed_id);
      return;
    }
    // Threads may hold the same vertex at the same time, with the same value.
    fixed[v] |= hold::named;
  }
};

struct HoldOfLayers {
  const std::int32_t* vertices;
  bool slides;
  std::uint8_t* fixed;
  std::uint8_t* before;

  TRISMOOTH_HOST_DEVICE void operator()(std::uint32_t i) const {
    std::uint8_t& reasons = fixed[vertices[i]];
    before[i] = reasons;
    reasons |= moves_in_layer(reasons, slides) ? hold::named : 0;
  }
};

}  // namespace

void determine_constraints(Context& context, const TriangleList& triangles, const CornersView& corners,
                           const DeviceConstraints& constraints, const ParityForest& forest, std::uint8_t* fixed,
                           Findings* findings) {
  for_each(context, static_cast<std::uint32_t>(triangles.count), PlantTriangle{forest});
  for_each(context, static_cast<std::uint32_t>(corners.vertex_count),
           DetermineConstraints{triangles, corners, constraints, forest, fixed, findings});
  if (constraints.fixed_ids != nullptr && constraints.fixed_id_count > 0) {
    for_each(context, static_cast<std::uint32_t>(constraints.fixed_id_count),
             HoldNamed{constraints.fixed_ids, corners.vertex_count, fixed, findings});
  }
}

std::vector<std::uint8_t> hold_of_layers(Context& context, const std::vector<std::int32_t>& vertices, bool slides,
                                         std::uint8_t* fixed) {
  const DeviceBuffer<std::int32_t> numbers(context, vertices);
  DeviceBuffer<std::uint8_t> before(context, vertices.size());
  for_each(context, static_cast<std::uint32_t>(vertices.size()),
           HoldOfLayers{numbers.data(), slides, fixed, before.data()});
  std::vector<std::uint8_t> found(vertices.size());
  before.download(found);
  return found;
}

}  // namespace trismooth::cuda
