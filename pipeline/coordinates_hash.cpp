#include "trismooth/pipeline/coordinates_hash.h"

#include <algorithm>
#include <array>
#include <bit>
#include <memory>
#include <new>
#include <vector>

#include <fmt/format.h>
#include <xxhash.h>

namespace trismooth {

namespace {

struct StateDeleter {
  void operator()(XXH64_state_t* state) const noexcept { XXH64_freeState(state); }
};

/// The numbers are turned around one by one: the way of a big-endian machine.
[[maybe_unused]] std::uint64_t hash_of_reversed_bytes(std::span<const double> xyz) {
  const std::unique_ptr<XXH64_state_t, StateDeleter> state(XXH64_createState());
  if (state == nullptr) {
    throw std::bad_alloc();
  }
  XXH64_reset(state.get(), 0);
  for (const double value : xyz) {
    auto bytes = std::bit_cast<std::array<unsigned char, sizeof(double)>>(value);
    std::ranges::reverse(bytes);
    XXH64_update(state.get(), bytes.data(), bytes.size());
  }
  return XXH64_digest(state.get());
}

}  // namespace

std::uint64_t coordinates_hash(std::span<const double> xyz) {
  if constexpr (std::endian::native == std::endian::little) {
    return XXH64(xyz.data(), xyz.size_bytes(), 0);
  } else {
    return hash_of_reversed_bytes(xyz);
  }
}

std::uint64_t planar_coordinates_hash(std::span<const double> xy) {
  std::vector<double> xyz;
  xyz.reserve(xy.size() / 2 * 3);
  for (std::size_t i = 0; i < xy.size(); i += 2) {
    xyz.insert(xyz.end(), {xy[i], xy[i + 1], 0.0});
  }
  return coordinates_hash(xyz);
}

std::string hash_text(std::uint64_t hash) {
  return fmt::format("{:016x}", hash);
}

}  // namespace trismooth
