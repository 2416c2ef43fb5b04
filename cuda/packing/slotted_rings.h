// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <type_traits>

#include "trismooth/base/host_device.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/cuda/runtime/device_buffer.h"

namespace trismooth::cuda {

/// One-rings as the resident execution reads them: a record of one size for each vertex, so that the threads of a warp
/// read whole lines of memory, and nothing needs to say where a ring begins. A slot holds a neighbour's number or, in
/// 16 bits, its difference to the vertex's. Slots beyond the ring's end repeat the first one, so that a ring is closed.
/// A ring of less than 3 or more than 8 neighbours, or with one too far away for a difference, is in a list of long
/// rings; its record says where.
template <class Slot>
struct alignas(16) RingRecord {
  static_assert(std::is_same_v<Slot, std::int16_t> || std::is_same_v<Slot, std::int32_t>);
  static constexpr int slots = 8;
  static constexpr int smallest_ring = 3;

  std::int32_t words[slots * sizeof(Slot) / 4];

  TRISMOOTH_HOST_DEVICE std::int32_t slot(int i) const {
    if constexpr (sizeof(Slot) == 2) {
      return i % 2 == 0 ? static_cast<std::int16_t>(words[i / 2]) : words[i / 2] >> 16;
    } else {
      return words[i];
    }
  }
  /// Two equal slots at the beginning, which no ring has, mean that the ring is long.
  TRISMOOTH_HOST_DEVICE bool is_long() const { return slot(0) == slot(1); }
  TRISMOOTH_HOST_DEVICE std::uint32_t long_begin() const { return static_cast<std::uint32_t>(words[2]); }
  TRISMOOTH_HOST_DEVICE std::int32_t long_size() const { return words[3]; }
  static TRISMOOTH_HOST_DEVICE RingRecord of_long_ring(std::uint32_t begin, std::int32_t size) {
    RingRecord record{};
    record.words[2] = static_cast<std::int32_t>(begin);
    record.words[3] = size;
    return record;
  }

  TRISMOOTH_HOST_DEVICE std::int32_t ring_size() const {
    if (is_long()) {
      return long_size();
    }
    int size = slots;
    for (int i = slots - 1; i >= smallest_ring; --i) {
      size = slot(i) == slot(0) ? i : size;
    }
    return size;
  }
};

/// One ring of them, in memory. `long_rings` has RingRecord::slots entries or more: where a ring is short, what
/// operator[] does not read has an address that may be read all the same. compute-sanitizer takes loads that a
/// predicate turns off for loads.
template <class Slot>
class SlottedRing {
 public:
  TRISMOOTH_HOST_DEVICE SlottedRing(std::int32_t vertex, const RingRecord<Slot>& record, const std::int32_t* long_rings)
      : first_(sizeof(Slot) == 2 ? vertex : 0),
        slots_(reinterpret_cast<const Slot*>(record.words)),
        long_ring_(long_rings + (record.is_long() ? record.long_begin() : 0)),
        is_long_(record.is_long()) {}

  /// The number of neighbour `i`.
  TRISMOOTH_HOST_DEVICE std::int32_t operator[](int i) const { return is_long_ ? long_ring_[i] : first_ + slots_[i]; }
  TRISMOOTH_HOST_DEVICE bool is_long() const { return is_long_; }

 private:
  std::int32_t first_;
  const Slot* slots_;
  const std::int32_t* long_ring_;
  bool is_long_;
};

/// For kernels. Vertices from `size` on have no ring: they are fixed.
template <class Slot>
struct SlottedRingsView {
  std::int32_t size;
  const RingRecord<Slot>* records;
  const std::int32_t* long_rings;

  TRISMOOTH_HOST_DEVICE std::int32_t ring_size(std::int32_t vertex) const { return records[vertex].ring_size(); }
  TRISMOOTH_HOST_DEVICE SlottedRing<Slot> ring(std::int32_t vertex) const {
    return {vertex, records[vertex], long_rings};
  }
};

/// One ring of a mesh with quadrilaterals: a MixedRing. Most are of four quadrilaterals; their records have the four
/// neighbours and then the four vertices opposite. All others are in the list of long rings, which has an opposite for
/// each neighbour as well, no_corner in a triangle.
template <class Slot>
class SlottedMixedRing : public SlottedRing<Slot> {
 public:
  static constexpr int quadrilaterals = RingRecord<Slot>::slots / 2;  ///< of those that are in a record

  TRISMOOTH_HOST_DEVICE SlottedMixedRing(std::int32_t vertex, const RingRecord<Slot>& record,
                                         const std::int32_t* long_rings)
      : SlottedRing<Slot>(vertex, record, long_rings), count_(size_of(record)) {}

  static TRISMOOTH_HOST_DEVICE std::int32_t size_of(const RingRecord<Slot>& record) {
    return record.is_long() ? record.long_size() : quadrilaterals;
  }
  TRISMOOTH_HOST_DEVICE int size() const { return count_; }
  TRISMOOTH_HOST_DEVICE bool is_quadrilateral(int i) const {
    return !this->is_long() || (*this)[count_ + i] != no_corner;
  }

 private:
  std::int32_t count_;
};

/// SlottedRingsView of a mesh with quadrilaterals.
template <class Slot>
struct SlottedMixedRingsView {
  std::int32_t size;
  const RingRecord<Slot>* records;
  const std::int32_t* long_rings;

  TRISMOOTH_HOST_DEVICE std::int32_t ring_size(std::int32_t vertex) const {
    return SlottedMixedRing<Slot>::size_of(records[vertex]);
  }
  TRISMOOTH_HOST_DEVICE SlottedMixedRing<Slot> ring(std::int32_t vertex) const {
    return {vertex, records[vertex], long_rings};
  }
};

/// Owns them, those of triangles or those of a mesh with quadrilaterals.
template <class Slot>
struct SlottedRings {
  DeviceBuffer<RingRecord<Slot>> records;
  DeviceBuffer<std::int32_t> long_rings;

  SlottedRingsView<Slot> view() const {
    return {static_cast<std::int32_t>(records.size()), records.data(), long_rings.data()};
  }
  SlottedMixedRingsView<Slot> mixed_view() const {
    return {static_cast<std::int32_t>(records.size()), records.data(), long_rings.data()};
  }
};

}  // namespace trismooth::cuda
