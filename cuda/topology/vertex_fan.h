// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/base/host_device.h"
#include "trismooth/cuda/topology/triangle_list.h"

namespace trismooth::cuda {

/// The triangles around one vertex of moderate degree, as one thread sees them: what each corner says of the vertex's
/// neighbours, gathered once. Record 2 k + side is the neighbour on that side of corner k (see
/// TriangleList::neighbour()). So the other record of the corner of record r is r ^ 1.
struct VertexFan {
  /// The largest degree. A vertex with more triangles is work for more than one thread.
  static constexpr int capacity = 32;

  int degree;
  std::int32_t neighbours[2 * capacity];

  TRISMOOTH_HOST_DEVICE VertexFan(const TriangleList& triangles, const std::int32_t* corners, int corner_count)
      : degree(corner_count) {
    for (int k = 0; k < degree; ++k) {
      neighbours[2 * k] = triangles.neighbour(corners[k], 0);
      neighbours[2 * k + 1] = triangles.neighbour(corners[k], 1);
    }
  }

  /// Writes the ring: the neighbours from the smallest on, counter-clockwise, `degree` of them. For vertices whose
  /// corners form one closed fan. `is_reversed(k)` tells whether corner k's triangle is listed clockwise; it is asked
  /// once, since the fan is oriented consistently.
  template <class IsReversed>
  TRISMOOTH_HOST_DEVICE void write_ring(const IsReversed& is_reversed, std::int32_t* ring) const {
    int leading = 0;  ///< the record of the neighbour with which a triangle begins, counter-clockwise
    for (int record = 1; record < 2 * degree; ++record) {
      leading = neighbours[record] < neighbours[leading] ? record : leading;
    }
    if (leading % 2 != (is_reversed(leading / 2) ? 1 : 0)) {
      leading = other_record(leading);  // that triangle ends with it; the one that begins with it is the other one
    }
    static_assert(capacity <= 32);
    std::uint32_t visited = 0;
    for (int i = 0; i < degree; ++i) {
      ring[i] = neighbours[leading];
      visited |= std::uint32_t{1} << static_cast<unsigned>(leading / 2);
      const std::int32_t trailing = neighbours[leading ^ 1];
      for (int k = 0; k < degree; ++k) {
        if ((visited >> static_cast<unsigned>(k) & 1U) == 0) {
          if (neighbours[2 * k] == trailing) {
            leading = 2 * k;
            break;
          }
          if (neighbours[2 * k + 1] == trailing) {
            leading = 2 * k + 1;
            break;
          }
        }
      }
    }
  }

 private:
  /// The second record of the same neighbour.
  TRISMOOTH_HOST_DEVICE int other_record(int record) const {
    int other = record + 1;
    while (other < 2 * degree - 1 && neighbours[other] != neighbours[record]) {
      ++other;
    }
    return other;
  }
};

/// Which records of a fan are of the same edge.
struct FanPairs {
  static constexpr std::int8_t none = -1;  ///< an edge with one triangle: the neighbour is recorded once
  static constexpr std::int8_t many = -2;  ///< an edge with three triangles or more, or with two of the same corners

  int degree;
  std::int8_t partners[2 * VertexFan::capacity];  ///< of each record: the other one of its neighbour, none, or many

  explicit TRISMOOTH_HOST_DEVICE FanPairs(const VertexFan& fan) : degree(fan.degree) {
    constexpr std::int8_t unknown = -3;
    const int records = 2 * degree;
    for (int r = 0; r < records; ++r) {
      partners[r] = unknown;
    }
    for (int r = 0; r < records; ++r) {
      if (partners[r] != unknown) {
        continue;
      }
      std::int8_t partner = none;
      for (int s = r + 1; s < records; ++s) {
        if (fan.neighbours[s] == fan.neighbours[r]) {
          const bool is_second = partner == none && fan.neighbours[s ^ 1] != fan.neighbours[r ^ 1];
          partner = is_second ? static_cast<std::int8_t>(s) : many;
        }
      }
      partners[r] = partner;
      if (partner >= 0) {
        partners[partner] = static_cast<std::int8_t>(r);
      } else if (partner == many) {
        for (int s = r + 1; s < records; ++s) {
          if (fan.neighbours[s] == fan.neighbours[r]) {
            partners[s] = many;
          }
        }
      }
    }
  }

  /// Whether all corners hang together through edges with exactly two triangles.
  TRISMOOTH_HOST_DEVICE bool is_one_fan() const {
    int reached = 1;
    // From the first corner to one end and then to the other, or once around. Partners pair records, so the walk cannot
    // come back to any corner but the first.
    for (int start = 1; start >= 0; --start) {
      for (int record = start; partners[record] >= 0;) {
        record = static_cast<int>(partners[record]);
        if (record / 2 == 0) {
          return reached == degree;
        }
        ++reached;
        record ^= 1;
      }
    }
    return reached == degree;
  }
};

}  // namespace trismooth::cuda
