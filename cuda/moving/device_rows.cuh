// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "trismooth/cuda/primitives/device_algorithms.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/cuda/runtime/for_each.cuh"
#include "trismooth/cuda/runtime/launch.h"

namespace trismooth::cuda {

namespace device_rows_details {

/// As many rows as this one block works on, round after round.
inline constexpr std::int32_t rows_of_block = 1024;

template <class Body>
__global__ void __launch_bounds__(rows_of_block) in_rounds(int rounds, std::int32_t count, Body body) {
  const auto row = static_cast<std::int32_t>(threadIdx.x);
  for (int round = 0; round < rounds; ++round) {
    if (row < count) {
      body(round, row);
    }
    __syncthreads();
  }
}

template <class Body>
struct OfRound {
  Body body;
  int round;

  __device__ void operator()(std::uint32_t row) const { body(round, static_cast<std::int32_t>(row)); }
};

template <class Term>
struct StoreTerm {
  Term term;
  double* terms;

  __device__ void operator()(std::uint32_t row) const { terms[row] = term(static_cast<std::int32_t>(row)); }
};

/// Each warp adds up its block of terms, one after the other.
template <class Number>
__global__ void add_up(const Number* terms, std::int32_t count, std::int32_t block, Number* sums, std::int32_t blocks) {
  const auto warp = static_cast<std::int32_t>(thread_index() / 32);
  if (warp >= blocks) {
    return;
  }
  const auto lane = static_cast<std::int32_t>(threadIdx.x % 32);
  const std::int32_t begin = warp * block;
  const std::int32_t end = count - begin < block ? count : begin + block;
  Number sum = 0;
  for (std::int32_t i = begin; i < end; i += 32) {
    const Number own = i + lane < end ? terms[i + lane] : Number(0);
    const std::int32_t here = end - i < 32 ? end - i : 32;
    for (std::int32_t k = 0; k < here; ++k) {
      sum += __shfl_sync(0xffffffffU, own, k);
    }
  }
  if (lane == 0) {
    sums[warp] = sum;
  }
}

}  // namespace device_rows_details

/// HostRows on a device: the same functions, the same bits. Bodies and terms are queued, sums are waited for.
class DeviceRows {
 public:
  template <class T>
  using Array = DeviceBuffer<T>;

  explicit DeviceRows(Context& context) : context_(context) {}

  template <class T>
  Array<T> zeros(std::size_t count) const {
    Array<T> array(context_, count);
    array.fill_bytes(0);
    return array;
  }

  template <class Body>
  void for_rows(std::int32_t count, const Body& body) const {
    for_each(context_, static_cast<std::uint32_t>(count), body);
  }

  template <class Body>
  void in_rounds(int rounds, std::int32_t count, const Body& body) const {
    using namespace device_rows_details;
    if (count <= rows_of_block) {
      device_rows_details::in_rounds<<<1, rows_of_block, 0, context_.stream()>>>(rounds, count, body);
      TRISMOOTH_CUDA_CHECK(cudaGetLastError());
      return;
    }
    for (int round = 0; round < rounds; ++round) {
      for_each(context_, static_cast<std::uint32_t>(count), OfRound<Body>{body, round});
    }
  }

  /// In the order of ordered_sum(): over blocks of terms, and then over these.
  template <class Term>
  double sum(std::int32_t count, const Term& term) const {
    using namespace device_rows_details;
    constexpr std::int32_t block = 1024;
    if (count == 0) {
      return 0;
    }
    const std::int32_t blocks = (count - 1) / block + 1;
    DeviceBuffer<double> terms(context_, static_cast<std::size_t>(count));
    DeviceBuffer<double> sums(context_, static_cast<std::size_t>(blocks) + 1);
    for_each(context_, static_cast<std::uint32_t>(count), StoreTerm<Term>{term, terms.data()});
    constexpr unsigned threads = 64;
    add_up<<<blocks_for(32 * std::int64_t{blocks}, threads), threads, 0, context_.stream()>>>(
        terms.data(), count, block, sums.data() + 1, blocks);
    TRISMOOTH_CUDA_CHECK(cudaGetLastError());
    add_up<<<1, 32, 0, context_.stream()>>>(sums.data() + 1, blocks, blocks, sums.data(), 1);
    TRISMOOTH_CUDA_CHECK(cudaGetLastError());
    return download(context_, static_cast<const double*>(sums.data()));
  }

 private:
  Context& context_;
};

}  // namespace trismooth::cuda
