// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/packing/coordinates.h"
#include "trismooth/cuda/runtime/for_each.cuh"

namespace trismooth::cuda {

namespace {

/// Reads and writes each point in one access.
struct EnterFrame {
  const double2* stored;
  const LocalFrame* frame;
  double2* local;

  __device__ void operator()(std::uint32_t v) const {
    const double2 point = stored[v];
    const auto [x, y] = frame->enter({point.x, point.y});
    local[v] = {x, y};
  }
};

struct Widen {
  const float2* from;
  double2* to;

  __device__ void operator()(std::uint32_t v) const {
    const float2 point = from[v];
    to[v] = {static_cast<double>(point.x), static_cast<double>(point.y)};
  }
};

struct Narrow {
  const double2* from;
  float2* to;

  __device__ void operator()(std::uint32_t v) const {
    const double2 point = from[v];
    to[v] = {static_cast<float>(point.x), static_cast<float>(point.y)};
  }
};

/// `has_second`: `second` is not `first` again.
template <class T>
struct EnterPacked {
  const double2* stored;
  const std::int32_t* input_index;
  const LocalFrame* frame;
  double2* before;
  PointArray<T> first;
  PointArray<T> second;
  bool has_second;

  __device__ void operator()(std::uint32_t i) const {
    const auto v = static_cast<std::int32_t>(i);
    const double2 point = stored[input_index[v]];
    const Point2<double> local = frame->enter({point.x, point.y});
    before[v] = {local.x, local.y};
    first.store(v, working_point<T>(local));
    if (has_second) {
      second.store(v, working_point<T>(local));
    }
  }
};

}  // namespace

void enter_frame(Context& context, const Point2<double>* stored, std::int32_t count, const LocalFrame* frame,
                 Point2<double>* local) {
  for_each(context, static_cast<std::uint32_t>(count),
           EnterFrame{reinterpret_cast<const double2*>(stored), frame, reinterpret_cast<double2*>(local)});
}

template <class T>
void enter_frame_packed(Context& context, const Point2<double>* stored, const VertexOrder& order,
                        const LocalFrame* frame, Point2<double>* before, const PointArray<T>& first,
                        const PointArray<T>& second) {
  for_each(context, static_cast<std::uint32_t>(order.vertex_count()),
           EnterPacked<T>{reinterpret_cast<const double2*>(stored), order.input_index.data(), frame,
                          reinterpret_cast<double2*>(before), first, second, first.points != second.points});
}
template void enter_frame_packed(Context&, const Point2<double>*, const VertexOrder&, const LocalFrame*,
                                 Point2<double>*, const PointArray<float>&, const PointArray<float>&);
template void enter_frame_packed(Context&, const Point2<double>*, const VertexOrder&, const LocalFrame*,
                                 Point2<double>*, const PointArray<double>&, const PointArray<double>&);

void widen_coordinates(Context& context, const float* xy, std::int32_t count, Point2<double>* points) {
  for_each(context, static_cast<std::uint32_t>(count),
           Widen{reinterpret_cast<const float2*>(xy), reinterpret_cast<double2*>(points)});
}

void narrow_coordinates(Context& context, const Point2<double>* points, std::int32_t count, float* xy) {
  for_each(context, static_cast<std::uint32_t>(count),
           Narrow{reinterpret_cast<const double2*>(points), reinterpret_cast<float2*>(xy)});
}

}  // namespace trismooth::cuda
