// SPDX-License-Identifier: BSD-3-Clause
// Runs every one-ring update and the quality function on the device and on the host over the same random rings and
// compares the bits: the proof that one definition of each formula serves both. Exit status 77: no device, skipped.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <utility>
#include <vector>

#include <cuda_runtime.h>

#include "trismooth/base/splitmix64.h"
#include "trismooth/smoothing/methods/methods.h"

namespace {

using trismooth::Move;
using trismooth::Point2;

constexpr int skipped = 77;
constexpr int largest_ring = 12;
constexpr int cases = 200000;
constexpr auto methods = trismooth::values_of<trismooth::Method>();

void check(cudaError_t error, const char* call, int line) {
  if (error != cudaSuccess) {
    std::fprintf(stderr, "%s:%d: %s: %s\n", __FILE__, line, call, cudaGetErrorName(error));
    std::exit(EXIT_FAILURE);
  }
}
#define CHECK_CUDA(call) check(call, #call, __LINE__)

template <class T>
struct Case {
  int ring_size;
  Point2<T> position;
  Point2<T> neighbours[largest_ring];

  __host__ __device__ int size() const { return ring_size; }
  __host__ __device__ Point2<T> operator[](int i) const { return neighbours[i]; }
  /// The vertex is number 0.
  __host__ __device__ std::int32_t number(int i) const { return i + 1; }
};

template <class T>
struct Answer {
  Move<T> by_ring[methods.size()];  ///< of the methods that know the ring alone
  Move<T> mean_ratio;
  Move<T> mean_ratio_to_shapes;
  T worst;
  unsigned long long hash;
};

/// By the mean-ratio method, of a power that goes with the case.
template <class T, bool shaped>
__host__ __device__ Move<T> mean_ratio(const Case<T>& ring, int index) {
  const trismooth::MeanRatioScales<T> scales{T(0.1) * static_cast<T>(index % 5), 1 + index % 8};
  T inverse_areas[largest_ring + 1];
  trismooth::EdgeTensor<T> edges[largest_ring + 1];
  for (int i = 0; i <= largest_ring; ++i) {
    inverse_areas[i] = T(1) + T(0.125) * static_cast<T>((index + i) % 9);
    edges[i] = {T(1), T(0.125) * static_cast<T>(index % 3), T(0.25) + T(0.5) * static_cast<T>((index + i) % 4)};
  }
  const T largest_share = T(0.5) + static_cast<T>(index % 7);
  const trismooth::MeanRatioTargets<T> targets{inverse_areas, &largest_share, &scales, shaped ? edges : nullptr};
  const trismooth::MeanRatioStep<T> step{T(1.5), T(3e-4), index % 2 == 0};
  return step.is_last ? trismooth::MeanRatio<T, shaped, true>(targets, step).update(0, ring.position, ring)
                      : trismooth::MeanRatio<T, shaped, false>(targets, step).update(0, ring.position, ring);
}

template <trismooth::Method method, class T>
__host__ __device__ Move<T> by_ring(const Case<T>& ring) {
  using Update = trismooth::UpdateOf<method>;
  if constexpr (requires { typename Update::Type; }) {
    return Update::Type::update(ring.position, ring);
  } else {
    return trismooth::stay(ring.position);
  }
}

template <class T, std::size_t... method>
__host__ __device__ Answer<T> answer(const Case<T>& ring, int index, std::index_sequence<method...> /*of all*/) {
  return {{by_ring<methods[method]>(ring)...},
          mean_ratio<T, false>(ring, index),
          mean_ratio<T, true>(ring, index),
          trismooth::worst_quotient(ring.position, ring),
          trismooth::splitmix64(static_cast<std::uint64_t>(index))};
}

template <class T>
__host__ __device__ Answer<T> answer(const Case<T>& ring, int index) {
  return answer(ring, index, std::make_index_sequence<methods.size()>());
}

template <class T>
__global__ void answer_all(const Case<T>* rings, Answer<T>* answers) {
  const int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  if (i < cases) {
    answers[i] = answer(rings[i], i);
  }
}

template <class T>
bool same_bits(const Move<T>& a, const Move<T>& b) {
  return a.moved == b.moved && std::memcmp(&a.position, &b.position, sizeof(a.position)) == 0;
}

/// Rings of every kind: convex, tangled, degenerate.
template <class T>
std::vector<Case<T>> random_rings() {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<T> coordinate(-1, 1);
  std::vector<Case<T>> rings(cases);
  for (Case<T>& ring : rings) {
    ring.ring_size = 3 + static_cast<int>(random() % (largest_ring - 2));
    ring.position = {coordinate(random) / 2, coordinate(random) / 2};
    const int kind = static_cast<int>(random() % 4);
    for (int i = 0; i < ring.ring_size; ++i) {
      const T angle = static_cast<T>(6.283185307179586) * static_cast<T>(i) / static_cast<T>(ring.ring_size);
      const T radius = kind == 0 ? T(1) : 1 + coordinate(random) / 2;
      ring.neighbours[i] = {radius * std::cos(angle), radius * std::sin(angle)};
      if (kind == 2) {
        ring.neighbours[i] = {coordinate(random), coordinate(random)};
      }
    }
    if (kind == 3) {
      ring.neighbours[1] = random() % 2 == 0 ? ring.neighbours[0] : ring.position;
    }
  }
  return rings;
}

template <class T>
int differences(const char* type) {
  const std::vector<Case<T>> rings = random_rings<T>();
  Case<T>* device_rings = nullptr;
  Answer<T>* device_answers = nullptr;
  CHECK_CUDA(cudaMalloc(&device_rings, cases * sizeof(Case<T>)));
  CHECK_CUDA(cudaMalloc(&device_answers, cases * sizeof(Answer<T>)));
  CHECK_CUDA(cudaMemcpy(device_rings, rings.data(), cases * sizeof(Case<T>), cudaMemcpyHostToDevice));
  answer_all<<<(cases + 255) / 256, 256>>>(device_rings, device_answers);
  CHECK_CUDA(cudaGetLastError());
  std::vector<Answer<T>> answers(cases);
  CHECK_CUDA(cudaMemcpy(answers.data(), device_answers, cases * sizeof(Answer<T>), cudaMemcpyDeviceToHost));
  CHECK_CUDA(cudaFree(device_rings));
  CHECK_CUDA(cudaFree(device_answers));

  int different = 0;
  int smart_moves = 0;
  int mean_ratio_moves = 0;
  for (int i = 0; i < cases; ++i) {
    const Answer<T> host = answer(rings[i], i);
    const Answer<T>& device = answers[i];
    smart_moves += host.by_ring[0].moved ? 1 : 0;
    mean_ratio_moves += host.mean_ratio.moved ? 1 : 0;
    bool same = true;
    for (std::size_t method = 0; method < methods.size(); ++method) {
      same = same && same_bits(host.by_ring[method], device.by_ring[method]);
    }
    same = same && same_bits(host.mean_ratio, device.mean_ratio) &&
           same_bits(host.mean_ratio_to_shapes, device.mean_ratio_to_shapes) && host.hash == device.hash &&
           std::memcmp(&host.worst, &device.worst, sizeof(T)) == 0;
    different += same ? 0 : 1;
  }
  std::printf("%s: %d rings, %d smart and %d mean-ratio moves, %d differ\n", type, cases, smart_moves, mean_ratio_moves,
              different);
  return different;
}

}  // namespace

int main() {
  int devices = 0;
  if (cudaGetDeviceCount(&devices) != cudaSuccess || devices == 0) {
    std::printf("skipped: no CUDA device was found\n");
    return skipped;
  }
  cudaDeviceProp properties{};
  CHECK_CUDA(cudaGetDeviceProperties(&properties, 0));
  std::printf("device: %s\n", properties.name);
  return differences<float>("float") + differences<double>("double") == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
