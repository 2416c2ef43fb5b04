#include "trismooth/cuda/packing/coordinates.h"
#include "trismooth/cuda/runtime/for_each.cuh"

namespace trismooth::cuda {

namespace {

/// One access for a point.
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

}  // namespace

void enter_frame(Context& context, const Point2<double>* stored, std::int32_t count, const LocalFrame* frame,
                 Point2<double>* local) {
  for_each(context, static_cast<std::uint32_t>(count),
           EnterFrame{reinterpret_cast<const double2*>(stored), frame, reinterpret_cast<double2*>(local)});
}

void widen(Context& context, const float* xy, std::int32_t count, Point2<double>* points) {
  for_each(context, static_cast<std::uint32_t>(count),
           Widen{reinterpret_cast<const float2*>(xy), reinterpret_cast<double2*>(points)});
}

void narrow(Context& context, const Point2<double>* points, std::int32_t count, float* xy) {
  for_each(context, static_cast<std::uint32_t>(count),
           Narrow{reinterpret_cast<const double2*>(points), reinterpret_cast<float2*>(xy)});
}

}  // namespace trismooth::cuda
