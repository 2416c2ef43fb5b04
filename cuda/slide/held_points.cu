// SPDX-License-Identifier: BSD-3-Clause
#include <vector>

#include "trismooth/cuda/runtime/for_each.cuh"
#include "trismooth/cuda/slide/held_points.h"

namespace trismooth::cuda {

namespace {

constexpr std::int32_t not_one = -1;

struct NotePlaces {
  const std::int32_t* vertices;
  std::int32_t* places;

  __device__ void operator()(std::uint32_t i) const { places[vertices[i]] = static_cast<std::int32_t>(i); }
};

struct NoteNumbers {
  const std::int32_t* input_index;
  const std::int32_t* places;
  std::int32_t* numbers;

  __device__ void operator()(std::uint32_t v) const {
    if (const std::int32_t place = places[input_index[v]]; place != not_one) {
      numbers[place] = static_cast<std::int32_t>(v);
    }
  }
};

struct Gather {
  const Point2<double>* stored;
  const std::int32_t* vertices;
  Point2<double>* gathered;

  __device__ void operator()(std::uint32_t i) const { gathered[i] = stored[vertices[i]]; }
};

struct NoteFans {
  const std::int32_t* numbers;
  std::int32_t free_count;
  std::int32_t* fan_of;

  __device__ void operator()(std::uint32_t i) const {
    if (numbers[i] >= free_count) {
      fan_of[numbers[i] - free_count] = static_cast<std::int32_t>(i);
    }
  }
};

struct PlaceHeld {
  const Point2<double>* slid;
  const std::int32_t* numbers;
  std::int32_t free_count;
  Point2<double>* after;

  __device__ void operator()(std::uint32_t i) const {
    if (numbers[i] >= free_count) {
      after[numbers[i] - free_count] = slid[i];
    }
  }
};

}  // namespace

std::vector<std::int32_t> find_packed_numbers(Context& context, const VertexOrder& order,
                                              std::span<const std::int32_t> vertices) {
  const DeviceBuffer<std::int32_t> wanted(context, vertices);
  DeviceBuffer<std::int32_t> places(context, static_cast<std::size_t>(order.vertex_count()));
  DeviceBuffer<std::int32_t> numbers(context, vertices.size());
  places.fill_bytes(0xFF);
  for_each(context, static_cast<std::uint32_t>(vertices.size()), NotePlaces{wanted.data(), places.data()});
  for_each(context, static_cast<std::uint32_t>(order.vertex_count()),
           NoteNumbers{order.input_index.data(), places.data(), numbers.data()});
  std::vector<std::int32_t> found(vertices.size());
  numbers.download(found);
  return found;
}

void gather_points(const Context& context, const Point2<double>* stored, const DeviceBuffer<std::int32_t>& vertices,
                   Point2<double>* gathered) {
  for_each(context, static_cast<std::uint32_t>(vertices.size()), Gather{stored, vertices.data(), gathered});
}

void find_fans(const Context& context, const DeviceBuffer<std::int32_t>& numbers, std::int32_t free_count,
               std::int32_t* fan_of) {
  for_each(context, static_cast<std::uint32_t>(numbers.size()), NoteFans{numbers.data(), free_count, fan_of});
}

void copy_held(const Context& context, const Point2<double>* before, std::int32_t free_count, std::int32_t held_count,
               Point2<double>* after) {
  TRISMOOTH_CUDA_CHECK(cudaMemcpyAsync(after, before + free_count,
                                       static_cast<std::size_t>(held_count) * sizeof(Point2<double>),
                                       cudaMemcpyDeviceToDevice, context.stream()));
}

void place_held(const Context& context, const Point2<double>* before, std::int32_t free_count, std::int32_t held_count,
                const DeviceBuffer<Point2<double>>& slid, const DeviceBuffer<std::int32_t>& numbers,
                Point2<double>* after) {
  copy_held(context, before, free_count, held_count, after);
  for_each(context, static_cast<std::uint32_t>(numbers.size()),
           PlaceHeld{slid.data(), numbers.data(), free_count, after});
}

}  // namespace trismooth::cuda
