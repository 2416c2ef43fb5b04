// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/coordinates_hash.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <iterator>
#include <memory>
#include <new>

#include <fmt/format.h>
#include <xxhash.h>

namespace trismooth {

namespace {

struct StateDeleter {
  void operator()(XXH64_state_t* state) const noexcept { XXH64_freeState(state); }
};

/// XXH64 of numbers that come one after the other, as little-endian bytes.
class Hasher {
 public:
  Hasher() : state_(XXH64_createState()) {
    if (state_ == nullptr) {
      throw std::bad_alloc();
    }
    XXH64_reset(state_.get(), 0);
  }

  void add(double value) {
    auto bytes = std::bit_cast<Bytes>(value);
    if constexpr (std::endian::native != std::endian::little) {
      std::ranges::reverse(bytes);
    }
    std::ranges::copy(bytes, block_.begin() + filled_);
    filled_ += std::ssize(bytes);
    if (filled_ == std::ssize(block_)) {
      flush();
    }
  }

  std::uint64_t digest() {
    flush();
    return XXH64_digest(state_.get());
  }

 private:
  using Bytes = std::array<unsigned char, sizeof(double)>;

  void flush() {
    XXH64_update(state_.get(), block_.data(), static_cast<std::size_t>(filled_));
    filled_ = 0;
  }

  std::unique_ptr<XXH64_state_t, StateDeleter> state_;
  std::array<unsigned char, 1024 * sizeof(double)> block_;
  std::ptrdiff_t filled_ = 0;
};

}  // namespace

std::uint64_t coordinates_hash(std::span<const double> xyz) {
  if constexpr (std::endian::native == std::endian::little) {
    return XXH64(xyz.data(), xyz.size_bytes(), 0);
  } else {
    Hasher hasher;
    for (const double value : xyz) {
      hasher.add(value);
    }
    return hasher.digest();
  }
}

std::uint64_t planar_coordinates_hash(std::span<const double> xy) {
  Hasher hasher;
  for (std::size_t i = 0; i < xy.size(); i += 2) {
    hasher.add(xy[i]);
    hasher.add(xy[i + 1]);
    hasher.add(0);
  }
  return hasher.digest();
}

std::string hash_text(std::uint64_t hash) {
  return fmt::format("{:016x}", hash);
}

}  // namespace trismooth
