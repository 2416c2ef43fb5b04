#include <algorithm>

#include "trismooth/cuda/primitives/device_algorithms.h"
#include "trismooth/cuda/runtime/for_each.cuh"
#include "trismooth/cuda/topology/near_triangles.h"

namespace trismooth::cuda {

namespace {

/// Lists them as threads happen to run; those that there is no room for are counted still.
struct ListNear {
  TriangleList triangles;
  const std::uint8_t* fixed;
  const std::int32_t* regions;
  NearTriangle* list;
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
                     corners,
                     {reasons[0], reasons[1], reasons[2]},
                     regions == nullptr ? 0 : regions[t]};
    }
  }
};

}  // namespace

std::vector<NearTriangle> near_triangles(Context& context, const TriangleList& triangles, const std::uint8_t* fixed,
                                         const std::int32_t* regions) {
  constexpr std::uint32_t usual_size = 65536;
  std::uint32_t size = std::min(usual_size, static_cast<std::uint32_t>(triangles.count));
  for (;;) {
    DeviceBuffer<NearTriangle> list(context, size);
    DeviceBuffer<std::uint32_t> count(context, 1);
    count.fill_bytes(0);
    for_each(context, static_cast<std::uint32_t>(triangles.count),
             ListNear{triangles, fixed, regions, list.data(), size, count.data()});
    const std::uint32_t found = download(context, count.data());
    if (found <= size) {
      std::vector<NearTriangle> near(found);
      list.download(near);
      return near;
    }
    size = found;
  }
}

}  // namespace trismooth::cuda
