// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace trismooth {

/// What all parts of a mesh find together: sums of integers and largest numbers, so that no order of joining matters.
struct PartSums {
  std::array<std::int64_t, 8> sums{};
  std::array<double, 2> largest{};  ///< of numbers, or minus infinity

  void join(const PartSums& other) {
    for (std::size_t i = 0; i < sums.size(); ++i) {
      // Sums of bits above 2^63 wrap around, as they do without a sign.
      sums[i] =
          static_cast<std::int64_t>(static_cast<std::uint64_t>(sums[i]) + static_cast<std::uint64_t>(other.sums[i]));
    }
    for (std::size_t i = 0; i < largest.size(); ++i) {
      largest[i] = largest[i] < other.largest[i] ? other.largest[i] : largest[i];
    }
  }
};

/// The way to those who smooth the other parts of a mesh: MPI's, or whatever else there is. All parts make the same
/// calls in the same order, on one thread each.
class PartMessenger {
 public:
  PartMessenger() = default;
  PartMessenger(const PartMessenger&) = delete;
  PartMessenger& operator=(const PartMessenger&) = delete;
  virtual ~PartMessenger() = default;

  /// What goes to a part, or comes from it.
  struct Message {
    int part;
    std::span<std::byte> bytes;
  };

  /// Begins to send and to receive. A part is in each list once at most, and messages between two parts are of one
  /// length on both sides. The memory is the caller's, who leaves it alone until finish(). One exchange at a time.
  virtual void start(std::span<const Message> sends, std::span<const Message> receives) = 0;
  /// Waits until all is there that start() has begun.
  virtual void finish() = 0;
  /// Brings in what the other parts have: the same for all of them afterwards.
  virtual void join(PartSums& sums) = 0;
};

}  // namespace trismooth
