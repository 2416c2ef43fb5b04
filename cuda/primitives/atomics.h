// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>

#include "trismooth/base/host_device.h"
#include "trismooth/base/machine/relaxed_atomics.h"

namespace trismooth::cuda {

/// Atomic operations on words in device memory, in no order relative to each other (relaxed), so that functions for the
/// device run on the host as well. Kernels follow each other in order: what one wrote the next one sees.

using trismooth::exchange_if_equal;
using trismooth::load_relaxed;
using trismooth::store_relaxed;

/// Returns what the word was.
inline TRISMOOTH_HOST_DEVICE std::uint32_t fetch_add(std::uint32_t* word, std::uint32_t value) {
#ifdef __CUDA_ARCH__
  return atomicAdd(word, value);
#else
  return std::atomic_ref(*word).fetch_add(value, std::memory_order_relaxed);
#endif
}

/// Sets bits that others may set too. Looks first: of many threads most find them set.
inline TRISMOOTH_HOST_DEVICE void set_bits(std::uint32_t* word, std::uint32_t bits) {
  if ((load_relaxed(word) & bits) == bits) {
    return;
  }
#ifdef __CUDA_ARCH__
  atomicOr(word, bits);
#else
  std::atomic_ref(*word).fetch_or(bits, std::memory_order_relaxed);
#endif
}

/// Raises the word to `value` where that is larger.
inline TRISMOOTH_HOST_DEVICE void raise_to(std::uint32_t* word, std::uint32_t value) {
#ifdef __CUDA_ARCH__
  atomicMax(word, value);
#else
  const std::atomic_ref shared(*word);
  for (std::uint32_t found = shared.load(std::memory_order_relaxed);
       found < value && !shared.compare_exchange_weak(found, value, std::memory_order_relaxed);) {
  }
#endif
}

}  // namespace trismooth::cuda
