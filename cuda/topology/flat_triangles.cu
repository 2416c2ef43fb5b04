#include "trismooth/cuda/primitives/atomics.h"
#include "trismooth/cuda/primitives/listed.h"
#include "trismooth/cuda/runtime/for_each.cuh"
#include "trismooth/cuda/topology/flat_triangles.h"
#include "trismooth/smoothing/layers/layers.h"

namespace trismooth::cuda {

namespace {

/// How far a triangle has come: 0 is not flat, 1 is flat, and each choice of candidates adds one.
struct MarkFlat {
  TriangleList triangles;
  const Point2<double>* points;
  const std::uint8_t* reversed;
  std::uint8_t* levels;

  __device__ void operator()(std::uint32_t t) const {
    const Triangle corners = triangles[t];
    levels[t] = is_flat_and_valid(points[corners[0]], points[corners[1]], points[corners[2]], reversed[t] != 0) ? 1 : 0;
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
    levels[t] = are_crowded ? level + 1 : 0;
  }
};

struct ListCandidates {
  TriangleList triangles;
  const Point2<double>* points;
  const std::uint8_t* levels;
  std::uint8_t level;
  FlatTriangle* list;
  std::uint32_t list_size;
  std::uint32_t* count;

  __device__ void operator()(std::uint32_t t) const {
    if (levels[t] != level) {
      return;
    }
    if (const std::uint32_t place = atomicAdd(count, 1U); place < list_size) {
      const Triangle corners = triangles[t];
      list[place] = described_flat(corners, points[corners[0]], points[corners[1]], points[corners[2]]);
    }
  }
};

}  // namespace

std::vector<FlatTriangle> flat_candidates(Context& context, const TriangleList& triangles, std::int32_t vertex_count,
                                          const Point2<double>* points, const std::uint8_t* reversed, int choices) {
  const auto count = static_cast<std::uint32_t>(triangles.count);
  DeviceBuffer<std::uint8_t> levels(context, count);
  DeviceBuffer<std::uint32_t> at(context, static_cast<std::size_t>(vertex_count));
  for_each(context, count, MarkFlat{triangles, points, reversed, levels.data()});
  for (int choice = 0; choice < choices; ++choice) {
    const auto level = static_cast<std::uint8_t>(choice + 1);
    at.fill_bytes(0);
    for_each(context, count, CountAtCorners{triangles, levels.data(), level, at.data()});
    for_each(context, count, ChooseCandidates{triangles, at.data(), level, levels.data()});
  }
  return listed<FlatTriangle>(context, count, [&](FlatTriangle* list, std::uint32_t size, std::uint32_t* found) {
    for_each(
        context, count,
        ListCandidates{triangles, points, levels.data(), static_cast<std::uint8_t>(choices + 1), list, size, found});
  });
}

}  // namespace trismooth::cuda
