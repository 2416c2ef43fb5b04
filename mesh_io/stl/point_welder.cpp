// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/stl/point_welder.h"

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

std::uint64_t PointWelder::hash_of(const Point& point) {
  std::uint64_t hash = 0;
  for (const double coordinate : point) {
    // Adding 0 turns -0 into 0 and changes nothing else.
    hash = mix(hash + 0x9e3779b97f4a7c15U + std::bit_cast<std::uint64_t>(coordinate + 0.0));
  }
  return hash;
}

std::size_t PointWelder::first_slot(const Point& point) const {
  return static_cast<std::size_t>(hash_of(point)) & (slots_.size() - 1);
}

std::int32_t PointWelder::add(const Point& point) {
  const auto number = static_cast<std::int32_t>(size());
  points_.insert(points_.end(), point.begin(), point.end());
  return number;
}

std::int32_t PointWelder::weld(const Point& point) {
  if (tree_) {
    const auto [place, is_new] = tree_->try_emplace(point, static_cast<std::int32_t>(size()));
    return is_new ? add(point) : place->second;
  }
  ++welded_;
  std::size_t slot = first_slot(point);
  while (slots_[slot] != empty && at(static_cast<std::size_t>(slots_[slot])) != point) {
    slot = (slot + 1) & (slots_.size() - 1);
    ++steps_;
  }
  if (slots_[slot] == empty) {
    slots_[slot] = add(point);
  }
  const std::int32_t number = slots_[slot];
  if (2 * size() > slots_.size()) {
    grow();
  }
  if (takes_too_many_steps()) {
    turn_to_tree();
  }
  return number;
}

/// In a table that is half full, scattered points take less than two steps each, and those of growing are fewer still.
bool PointWelder::takes_too_many_steps() const {
  constexpr std::size_t most_steps_each = 16;
  constexpr std::size_t for_small_tables = 1024;
  return steps_ > most_steps_each * welded_ + for_small_tables;
}

void PointWelder::grow() {
  slots_.assign(2 * slots_.size(), empty);
  for (std::size_t number = 0; number < size() && !takes_too_many_steps(); ++number) {
    std::size_t slot = first_slot(at(number));
    for (; slots_[slot] != empty; slot = (slot + 1) & (slots_.size() - 1)) {
      ++steps_;
    }
    slots_[slot] = static_cast<std::int32_t>(number);
  }
}

void PointWelder::turn_to_tree() {
  slots_ = {};
  tree_.emplace();
  for (std::size_t number = 0; number < size(); ++number) {
    tree_->emplace(at(number), static_cast<std::int32_t>(number));
  }
}

}  // namespace trismooth
