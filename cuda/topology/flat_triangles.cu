// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/primitives/atomics.h"
#include "trismooth/cuda/primitives/listed.h"
#include "trismooth/cuda/runtime/for_each.cuh"
#include "trismooth/cuda/topology/flat_triangles.h"
#include "trismooth/smoothing/layers/layers.h"

namespace trismooth::cuda {

namespace {

/// How far a triangle has come: 0 is not flat, 1 is flat, and each choice that it passes adds one.
struct MarkFlat {
  TriangleList triangles;
  const Point2<double>* points;
  const std::uint8_t* reversed;
  std::uint8_t* levels;

  __device__ void operator()(std::uint32_t t) const {
    const auto [a, b, c] = canonical_corners(triangles[t], reversed[t] != 0);
    levels[t] = is_flat(points[a], points[b], points[c]) ? 1 : 0;
  }
};

struct AddAtCorners {
  TriangleList triangles;
  const Point2<double>* points;
  const std::uint8_t* reversed;
  const std::uint8_t* levels;
  std::uint8_t level;
  FlatAround* around;

  __device__ void operator()(std::uint32_t t) const {
    if (levels[t] != level) {
      return;
    }
    const Triangle corners = canonical_corners(triangles[t], reversed[t] != 0);
    const TensorUnits tensor = in_units(flat_tensor(points[corners[0]], points[corners[1]], points[corners[2]]));
    for (const std::int32_t v : corners) {
      fetch_add(&around[v].count, 1U);
      fetch_add(&around[v].sum.xx, tensor.xx);
      fetch_add(&around[v].sum.xy, tensor.xy);
    }
  }
};

struct ChooseCandidates {
  TriangleList triangles;
  const FlatAround* around;
  std::uint8_t level;
  std::uint8_t* levels;

  __device__ void operator()(std::uint32_t t) const {
    if (levels[t] != level) {
      return;
    }
    bool stays = true;
    for (const std::int32_t v : triangles[t]) {
      stays = stays && stay_in_choice(around[v], level);
    }
    levels[t] = stays ? level + 1 : level;
  }
};

struct ListCandidates {
  TriangleList triangles;
  const Point2<double>* points;
  const std::uint8_t* reversed;
  const std::uint8_t* levels;
  std::uint8_t level;
  FlatTriangle* list;
  std::uint32_t list_size;
  std::uint32_t* count;

  __device__ void operator()(std::uint32_t t) const {
    if (levels[t] < level) {
      return;
    }
    if (const std::uint32_t place = atomicAdd(count, 1U); place < list_size) {
      const Triangle corners = canonical_corners(triangles[t], reversed[t] != 0);
      list[place] = described_flat(corners, points[corners[0]], points[corners[1]], points[corners[2]]);
    }
  }
};

}  // namespace

LayerCandidates::LayerCandidates(Context& context, const TriangleList& triangles, std::int32_t vertex_count,
                                 const Point2<double>* points, const std::uint8_t* reversed)
    : context_(&context),
      triangles_(triangles),
      points_(points),
      reversed_(reversed),
      levels_(context, static_cast<std::size_t>(triangles.count)) {
  const auto count = static_cast<std::uint32_t>(triangles.count);
  DeviceBuffer<FlatAround> around(context, static_cast<std::size_t>(vertex_count));
  for_each(context, count, MarkFlat{triangles, points, reversed, levels_.data()});
  for (std::uint8_t level = 1; level <= layers_first_choices; ++level) {
    around.fill_bytes(0);
    for_each(context, count, AddAtCorners{triangles, points, reversed, levels_.data(), level, around.data()});
    for_each(context, count, ChooseCandidates{triangles, around.data(), level, levels_.data()});
  }
}

std::vector<FlatTriangle> LayerCandidates::after(int choices) const {
  const auto count = static_cast<std::uint32_t>(triangles_.count);
  const auto level = static_cast<std::uint8_t>(choices + 1);
  return listed<FlatTriangle>(*context_, count, [&](FlatTriangle* list, std::uint32_t size, std::uint32_t* found) {
    for_each(*context_, count,
             ListCandidates{triangles_, points_, reversed_, levels_.data(), level, list, size, found});
  });
}

}  // namespace trismooth::cuda
