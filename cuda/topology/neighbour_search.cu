// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>

#include "trismooth/cuda/primitives/atomics.h"
#include "trismooth/cuda/primitives/device_algorithms.h"
#include "trismooth/cuda/runtime/for_each.cuh"
#include "trismooth/cuda/topology/neighbour_search.h"
#include "trismooth/cuda/topology/vertex_fan.h"

namespace trismooth::cuda {

namespace {

TRISMOOTH_HOST_DEVICE bool is_valid(const Triangle& triangle, std::int32_t vertex_count) {
  const auto [a, b, c] = triangle;
  const auto in_range = [vertex_count](std::int32_t v) { return v >= 0 && v < vertex_count; };
  return in_range(a) && in_range(b) && in_range(c) && a != b && b != c && c != a;
}

/// Counts and corners share one array, which is zero at first: the corners of vertex v are counted in entry v + 2. Once
/// summed up, entry v + 1 is where those of v begin, and while they are recorded, where they go on. In the end it is
/// where they end, and those of v + 1 begin: entries 0 .. vertex_count are the offsets.
struct CountCorners {
  TriangleList triangles;
  std::int32_t vertex_count;
  std::uint32_t* counts;
  Findings* findings;

  TRISMOOTH_HOST_DEVICE void operator()(std::uint32_t t) const {
    const Triangle triangle = triangles[t];
    if (!is_valid(triangle, vertex_count)) {
      set_bits(&findings->faults, Findings::bad_triangle);
      return;
    }
    for (const std::int32_t v : triangle) {
      fetch_add(&counts[static_cast<std::size_t>(v) + 2], 1);
    }
  }
};

struct RecordCorners {
  TriangleList triangles;
  std::int32_t vertex_count;
  std::uint32_t* cursors;
  std::int32_t* corners;

  TRISMOOTH_HOST_DEVICE void operator()(std::uint32_t t) const {
    const Triangle triangle = triangles[t];
    if (!is_valid(triangle, vertex_count)) {
      return;
    }
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t place = fetch_add(&cursors[static_cast<std::size_t>(triangle[i]) + 1], 1);
      corners[place] = static_cast<std::int32_t>(3 * t + i);
    }
  }
};

/// All of it, by one thread.
struct FindAlone {
  TriangleList triangles;
  std::int32_t vertex_count;
  std::uint32_t* offsets;
  std::int32_t* corners;
  Findings* findings;

  TRISMOOTH_HOST_DEVICE void operator()(std::uint32_t /*thread*/) const {
    const auto triangle_count = static_cast<std::uint32_t>(triangles.count);
    for (std::uint32_t t = 0; t < triangle_count; ++t) {
      const Triangle triangle = triangles[t];
      if (!is_valid(triangle, vertex_count)) {
        findings->faults |= Findings::bad_triangle;
        continue;
      }
      for (const std::int32_t v : triangle) {
        ++offsets[static_cast<std::size_t>(v) + 2];
      }
    }
    for (std::size_t v = 0; v < static_cast<std::size_t>(vertex_count); ++v) {
      offsets[v + 2] += offsets[v + 1];
    }
    for (std::uint32_t t = 0; t < triangle_count; ++t) {
      const Triangle triangle = triangles[t];
      if (!is_valid(triangle, vertex_count)) {
        continue;
      }
      for (std::uint32_t i = 0; i < 3; ++i) {
        corners[offsets[static_cast<std::size_t>(triangle[i]) + 1]++] = static_cast<std::int32_t>(3 * t + i);
      }
    }
  }
};

struct FindLargeVertices {
  CornersView corners;
  Findings* findings;

  TRISMOOTH_HOST_DEVICE void operator()(std::uint32_t v) const {
    const std::uint32_t degree = corners.degree(v);
    if (degree > VertexFan::capacity) {
      fetch_add(&findings->large_vertices, 1);
      raise_to(&findings->largest_degree, degree);
    }
  }
};

}  // namespace

IncidentCorners find_neighbours(Context& context, std::int32_t vertex_count, const TriangleList& triangles,
                                NeighbourSearch way, Findings* findings) {
  const auto triangle_count = static_cast<std::uint32_t>(triangles.count);
  IncidentCorners found{{context, static_cast<std::size_t>(vertex_count) + 2},
                        {context, 3 * static_cast<std::size_t>(triangle_count)}};
  std::uint32_t* const offsets = found.offsets.data();
  std::int32_t* const corners = found.corners.data();
  found.offsets.fill_bytes(0);
  if (way == NeighbourSearch::one_thread) {
    for_one_thread(context, FindAlone{triangles, vertex_count, offsets, corners, findings});
  } else {
    for_each(context, triangle_count, CountCorners{triangles, vertex_count, offsets, findings});
    sum_up(context, offsets, static_cast<std::int64_t>(vertex_count) + 2);
    for_each(context, triangle_count, RecordCorners{triangles, vertex_count, offsets, corners});
  }
  for_each(context, static_cast<std::uint32_t>(vertex_count), FindLargeVertices{found.view(), findings});
  return found;
}

}  // namespace trismooth::cuda
