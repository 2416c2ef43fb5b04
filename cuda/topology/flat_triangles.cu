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

struct CountAtCorners {
  TriangleList triangles;
  const std::uint8_t* levels;
  std::uint8_t level;
  std::uint32_t* at;

  __device__ void operator()(std::uint32_t t) const {
    if (levels[t] != level) {
      return;
    }
    for (const std::int32_t v : triangles[t]) {
      fetch_add(&at[v], 1U);
    }
  }
};

struct ChooseCandidates {
  TriangleList triangles;
  const std::uint32_t* at;
  std::uint8_t level;
  std::uint8_t* levels;

  __device__ void operator()(std::uint32_t t) const {
    if (levels[t] != level) {
      return;
    }
    bool are_crowded = true;
    for (const std::int32_t v : triangles[t]) {
      are_crowded = are_crowded && at[v] >= layers_crowd;
    }
    levels[t] = are_crowded ? level + 1 : level;
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
  DeviceBuffer<std::uint32_t> at(context, static_cast<std::size_t>(vertex_count));
  for_each(context, count, MarkFlat{triangles, points, reversed, levels_.data()});
  for (std::uint8_t level = 1; level <= layers_first_choices; ++level) {
    at.fill_bytes(0);
    for_each(context, count, CountAtCorners{triangles, levels_.data(), level, at.data()});
    for_each(context, count, ChooseCandidates{triangles, at.data(), level, levels_.data()});
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
