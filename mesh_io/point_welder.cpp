#include "trismooth/mesh_io/point_welder.h"

#include <bit>

namespace trismooth {

namespace {

constexpr std::int32_t empty = -1;

/// The finaliser of splitmix64: every bit of the result depends on every bit of `bits`.
std::uint64_t mix(std::uint64_t bits) {
  bits = (bits ^ (bits >> 30U)) * 0xbf58476d1ce4e5b9U;
  bits = (bits ^ (bits >> 27U)) * 0x94d049bb133111ebU;
  return bits ^ (bits >> 31U);
}

}  // namespace

PointWelder::PointWelder() : slots_(16, empty) {}

std::size_t PointWelder::first_slot(const std::array<double, 3>& point) const {
  std::uint64_t hash = 0;
  for (const double coordinate : point) {
    // Adding 0 turns -0 into 0 and changes nothing else.
    hash = mix(hash + 0x9e3779b97f4a7c15U + std::bit_cast<std::uint64_t>(coordinate + 0.0));
  }
  return static_cast<std::size_t>(hash) & (slots_.size() - 1);
}

bool PointWelder::is_at(std::int32_t number, const std::array<double, 3>& point) const {
  const double* const stored = points_.data() + 3 * static_cast<std::size_t>(number);
  return stored[0] == point[0] && stored[1] == point[1] && stored[2] == point[2];
}

std::int32_t PointWelder::weld(const std::array<double, 3>& point) {
  std::size_t slot = first_slot(point);
  while (slots_[slot] != empty) {
    if (is_at(slots_[slot], point)) {
      return slots_[slot];
    }
    slot = (slot + 1) & (slots_.size() - 1);
  }
  const auto number = static_cast<std::int32_t>(size());
  slots_[slot] = number;
  points_.insert(points_.end(), point.begin(), point.end());
  if (2 * size() > slots_.size()) {
    grow();
  }
  return number;
}

void PointWelder::grow() {
  slots_.assign(2 * slots_.size(), empty);
  for (std::size_t number = 0; number < size(); ++number) {
    std::size_t slot = first_slot({points_[3 * number], points_[3 * number + 1], points_[3 * number + 2]});
    while (slots_[slot] != empty) {
      slot = (slot + 1) & (slots_.size() - 1);
    }
    slots_[slot] = static_cast<std::int32_t>(number);
  }
}

}  // namespace trismooth
