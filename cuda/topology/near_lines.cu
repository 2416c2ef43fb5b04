// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/primitives/listed.h"
#include "trismooth/cuda/runtime/for_each.cuh"
#include "trismooth/cuda/topology/near_lines.h"

namespace trismooth::cuda {

namespace {

/// Lists them as threads happen to run; those that there is no room for are counted still.
struct ListNear {
  TriangleList triangles;
  const std::uint8_t* fixed;
  const std::int32_t* regions;
  NearElement* list;
  std::uint32_t list_size;
  std::uint32_t* count;

  __device__ void operator()(std::uint32_t t) const {
    const Triangle corners = triangles[t];
    const std::uint8_t reasons[3] = {fixed[corners[0]], fixed[corners[1]], fixed[corners[2]]};
    if (!is_held_by_lines(reasons[0]) && !is_held_by_lines(reasons[1]) && !is_held_by_lines(reasons[2])) {
      return;
    }
    if (const std::uint32_t place = atomicAdd(count, 1U); place < list_size) {
      list[place] = {static_cast<std::int32_t>(t),
                     {corners[0], corners[1], corners[2], no_corner},
                     {reasons[0], reasons[1], reasons[2]},
                     regions == nullptr ? 0 : regions[t]};
    }
  }
};

/// Lists the vertices that something else holds, as threads happen to run; all are counted.
struct ListOthers {
  const std::uint8_t* fixed;
  std::int32_t* list;
  std::uint32_t list_size;
  std::uint32_t* count;

  __device__ void operator()(std::uint32_t v) const {
    if (!is_held_otherwise(fixed[v])) {
      return;
    }
    if (const std::uint32_t place = atomicAdd(count, 1U); place < list_size) {
      list[place] = static_cast<std::int32_t>(v);
    }
  }
};

}  // namespace

NearLines near_lines(Context& context, const TriangleList& triangles, std::int32_t vertex_count,
                     const std::uint8_t* fixed, const std::int32_t* regions) {
  const auto triangle_count = static_cast<std::uint32_t>(triangles.count);
  const auto vertices = static_cast<std::uint32_t>(vertex_count);
  return {
      listed<NearElement>(context, triangle_count,
                          [&](NearElement* list, std::uint32_t size, std::uint32_t* count) {
                            for_each(context, triangle_count, ListNear{triangles, fixed, regions, list, size, count});
                          }),
      listed<std::int32_t>(context, vertices, [&](std::int32_t* list, std::uint32_t size, std::uint32_t* count) {
        for_each(context, vertices, ListOthers{fixed, list, size, count});
      })};
}

}  // namespace trismooth::cuda
