// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <type_traits>

#include "trismooth/base/host_device.h"

namespace trismooth {

/// Atomic operations on words that several threads read and write, in no order relative to each other (relaxed), on the
/// host and on the device. Loops and kernels follow each other in order: what one wrote the next one sees.

inline TRISMOOTH_HOST_DEVICE std::uint32_t load_relaxed(const std::uint32_t* word) {
#ifdef __CUDA_ARCH__
  return *static_cast<const volatile std::uint32_t*>(word);
#else
  return std::atomic_ref(*const_cast<std::uint32_t*>(word)).load(std::memory_order_relaxed);
#endif
}

inline TRISMOOTH_HOST_DEVICE void store_relaxed(std::uint32_t* word, std::uint32_t value) {
#ifdef __CUDA_ARCH__
  *static_cast<volatile std::uint32_t*>(word) = value;
#else
  std::atomic_ref(*word).store(value, std::memory_order_relaxed);
#endif
}

/// Writes `value` where the word is `expected`. Returns what it was.
inline TRISMOOTH_HOST_DEVICE std::uint32_t exchange_if_equal(std::uint32_t* word, std::uint32_t expected,
                                                             std::uint32_t value) {
#ifdef __CUDA_ARCH__
  return atomicCAS(word, expected, value);
#else
  std::atomic_ref(*word).compare_exchange_strong(expected, value, std::memory_order_relaxed);
  return expected;
#endif
}

/// Sets bits that others may set too. On the host. Looks first: most are set already.
template <class Word>
void set_bits_relaxed(Word& word, std::type_identity_t<Word> bits) {
  const std::atomic_ref shared(word);
  if ((shared.load(std::memory_order_relaxed) & bits) != bits) {
    shared.fetch_or(bits, std::memory_order_relaxed);
  }
}

/// Lowers the number to `value` where that is smaller, both taken as unsigned: -1 is the largest. On the host.
inline void lower_relaxed(std::int32_t& number, std::int32_t value) {
  const std::atomic_ref shared(number);
  for (std::int32_t found = shared.load(std::memory_order_relaxed);
       static_cast<std::uint32_t>(value) < static_cast<std::uint32_t>(found) &&
       !shared.compare_exchange_weak(found, value, std::memory_order_relaxed);) {
  }
}

}  // namespace trismooth
