// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/guard/stored_point.cuh"
#include "trismooth/cuda/moving/device_rows.cuh"
#include "trismooth/cuda/moving/moved_points.h"
#include "trismooth/cuda/primitives/reduce.cuh"
#include "trismooth/smoothing/moving/carry.h"
#include "trismooth/smoothing/moving/winding.h"

namespace trismooth::cuda {

namespace {

struct EnterRescaled {
  const Point2<double>* stored;
  LocalFrame frame;
  int power;
  Point2<double>* local;

  __device__ void operator()(std::uint32_t v) const { local[v] = rescaled(frame.enter(stored[v]), power); }
};

struct LeaveWhereItWas {
  const std::uint8_t* held;
  const Point2<double>* stored;
  const Point2<double>* from;
  Storage storage;
  Point2<double>* now;

  __device__ void operator()(std::uint32_t v) const {
    now[v] = held[v] == 0 ? rounded_point(from[v], storage) : stored[v];
  }
};

struct LeaveCarried {
  const std::int32_t* carried;
  const Point2<double>* places;
  LocalFrame frame;
  Storage storage;
  Point2<double>* now;

  __device__ void operator()(std::uint32_t i) const {
    const std::int32_t v = carried[i];
    now[v] = stored_point(frame, finite_or_zero(places[v]), storage);
  }
};

struct Pick {
  const std::int32_t* vertices;
  const Point2<double>* points;
  Point2<double>* picked;

  __device__ void operator()(std::uint32_t i) const { picked[i] = points[vertices[i]]; }
};

struct AddWinding {
  TriangleList triangles;
  const std::uint8_t* reversed;
  const std::uint8_t* held;
  const Point2<double>* local;
  std::int64_t* around;

  __device__ void operator()(std::uint32_t t) const {
    const Triangle corners = canonical_corners(triangles[t], reversed[t] != 0);
    for (int i = 0; i < 3; ++i) {
      const std::int32_t v = corners[i];
      const Point2<double> from = local[corners[(i + 1) % 3]] - local[v];
      const Point2<double> to = local[corners[(i + 2) % 3]] - local[v];
      if (const std::int64_t part = Winding::of(held[v] != 0, from, to); part != 0) {
        atomicAdd(reinterpret_cast<unsigned long long*>(around + v), static_cast<unsigned long long>(part));
      }
    }
  }
};

struct IsOver {
  const std::uint8_t* held;
  const std::int64_t* around;

  TRISMOOTH_HOST_DEVICE std::uint64_t operator()(std::uint32_t v) const {
    return Winding::is_over(held[v] != 0, around[v]) ? 1 : 0;
  }
};

struct Plus {
  TRISMOOTH_HOST_DEVICE std::uint64_t operator()(std::uint64_t a, std::uint64_t b) const { return a + b; }
};

struct ShapesOf {
  TriangleList triangles;
  const std::uint8_t* reversed;
  const std::uint8_t* held;
  const Point2<double>* rest;
  const Point2<double>* now;
  double* shapes;

  TRISMOOTH_HOST_DEVICE RelativeShapes operator()(std::uint32_t t) const {
    return trismooth::relative_shapes(canonical_corners(triangles[t], reversed[t] != 0), held, rest, now, shapes[t]);
  }
};

struct JoinShapes {
  TRISMOOTH_HOST_DEVICE RelativeShapes operator()(RelativeShapes a, const RelativeShapes& b) const { return a += b; }
};

struct Stored {
  const double* values;

  TRISMOOTH_HOST_DEVICE double operator()(std::int32_t i) const { return values[i]; }
};

struct MoveOf {
  const Point2<double>* before;
  const Point2<double>* now;
  int exponent;

  TRISMOOTH_HOST_DEVICE double operator()(std::uint32_t v) const { return length_of_move(before[v], now[v], exponent); }
};

struct Larger {
  TRISMOOTH_HOST_DEVICE double operator()(double a, double b) const { return a < b ? b : a; }
};

}  // namespace

void enter_rescaled(const Context& context, const Point2<double>* stored, std::int32_t count, const LocalFrame& frame,
                    int power, Point2<double>* local) {
  for_each(context, static_cast<std::uint32_t>(count), EnterRescaled{stored, frame, power, local});
}

void leave_carried(const Context& context, const DeviceBuffer<std::int32_t>& carried, const std::uint8_t* held,
                   const Point2<double>* stored, const Point2<double>* from, const Point2<double>* places,
                   const LocalFrame& frame, Storage storage, DeviceBuffer<Point2<double>>& now) {
  for_each(context, static_cast<std::uint32_t>(now.size()), LeaveWhereItWas{held, stored, from, storage, now.data()});
  for_each(context, static_cast<std::uint32_t>(carried.size()),
           LeaveCarried{carried.data(), places, frame, storage, now.data()});
}

std::vector<Point2<double>> points_of_vertices(Context& context, const DeviceBuffer<std::int32_t>& vertices,
                                               const Point2<double>* points) {
  DeviceBuffer<Point2<double>> picked(context, vertices.size());
  for_each(context, static_cast<std::uint32_t>(vertices.size()), Pick{vertices.data(), points, picked.data()});
  return download(context, static_cast<const Point2<double>*>(picked.data()), picked.size());
}

std::vector<std::int32_t> overlapping_vertices(Context& context, const TriangleList& triangles,
                                               const std::uint8_t* reversed, const std::uint8_t* held,
                                               const Point2<double>* local, std::int32_t vertex_count) {
  DeviceBuffer<std::int64_t> around(context, static_cast<std::size_t>(vertex_count));
  around.fill_bytes(0);
  for_each(context, static_cast<std::uint32_t>(triangles.count),
           AddWinding{triangles, reversed, held, local, around.data()});
  const IsOver is_over{held, around.data()};
  std::vector<std::int32_t> found;
  if (reduce(context, static_cast<std::uint32_t>(vertex_count), std::uint64_t{0}, is_over, Plus{}) == 0) {
    return found;
  }
  const auto sums = download(context, static_cast<const std::int64_t*>(around.data()), around.size());
  const auto why_held = download(context, held, around.size());
  for (std::int32_t v = 0; v < vertex_count; ++v) {
    if (Winding::is_over(why_held[v] != 0, sums[v])) {
      found.push_back(v);
    }
  }
  return found;
}

RelativeShapes relative_shapes(Context& context, const TriangleList& triangles, const std::uint8_t* reversed,
                               const std::uint8_t* held, const Point2<double>* rest, const Point2<double>* now,
                               double& sum) {
  DeviceBuffer<double> shapes(context, static_cast<std::size_t>(triangles.count));
  const RelativeShapes all = reduce(context, static_cast<std::uint32_t>(triangles.count), RelativeShapes::none(),
                                    ShapesOf{triangles, reversed, held, rest, now, shapes.data()}, JoinShapes{});
  sum = DeviceRows(context).sum(triangles.count, Stored{shapes.data()});
  return all;
}

double largest_move(Context& context, const Point2<double>* before, const Point2<double>* now, std::int32_t count,
                    int exponent) {
  return reduce(context, static_cast<std::uint32_t>(count), 0.0, MoveOf{before, now, exponent}, Larger{});
}

}  // namespace trismooth::cuda
