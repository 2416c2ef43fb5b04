// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "trismooth/base/host_device.h"
#include "trismooth/base/point2.h"

namespace trismooth {

/// How the elements around a vertex go round it, in whole numbers, whose sums are the same in any order: around a free
/// one, how often; around a held one, by how much, in 2^-44.
struct Winding {
  /// What an element adds whose edges lead from the vertex to `from` and, counter-clockwise, `to`.
  static TRISMOOTH_HOST_DEVICE std::int64_t of(bool is_held, Point2<double> from, Point2<double> to) {
    return is_held ? angle(from, to) : passes(from, to);
  }

  /// Whether the elements lie over each other: they go round more than once, or make more than a full turn.
  static TRISMOOTH_HOST_DEVICE bool is_over(bool is_held, std::int64_t sum) {
    // A slit that is closed goes round its tip once, to rounding. Where it is less than this beyond a full turn its
    // edges touch (lie_on_each_other() of crossings.cpp), so that one of both says so.
    constexpr double rounding = 1e-9;
    constexpr auto full_turn = static_cast<std::int64_t>((2 * std::numbers::pi + rounding) * units);
    return sum > (is_held ? full_turn : 1);
  }

 private:
  static constexpr double units = 0x1p44;

  /// 1 where the way from one end to another passes the axis of x, in front of the vertex, counter-clockwise, else 0,
  /// or -1 where it passes it clockwise.
  static TRISMOOTH_HOST_DEVICE std::int64_t passes(Point2<double> from, Point2<double> to) {
    const bool is_up = from.y < 0 && to.y >= 0;
    const bool is_down = from.y >= 0 && to.y < 0;
    const double turn = cross(from, to);
    return is_up && turn > 0 ? 1 : is_down && turn < 0 ? -1 : 0;
  }

  static TRISMOOTH_HOST_DEVICE std::int64_t angle(Point2<double> from, Point2<double> to) {
    const double angle = std::atan2(cross(from, to), from.x * to.x + from.y * to.y);
    return angle - angle == 0 ? std::llround(angle * units) : 0;
  }
};

}  // namespace trismooth
