// SPDX-License-Identifier: BSD-3-Clause
#include "properties/smoothing_cases.h"

#include <cmath>
#include <optional>

namespace properties {

namespace {

bool same_number(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

std::string text_of(const std::optional<trismooth::UntanglingResult>& untangling) {
  return untangling ? fmt::format("{} inverted, {} untangled, {} in the end, {} of fixed vertices, {} turned over",
                                  untangling->inverted_before, untangling->inverted_untangled,
                                  untangling->inverted_after, untangling->inverted_fixed, untangling->turned_components)
                    : "nothing";
}

}  // namespace

std::string difference(const Run& found, const Run& expected) {
  const SmoothingResult& a = found.result;
  const SmoothingResult& b = expected.result;
  if (a.sweeps != b.sweeps || a.stop_reason != b.stop_reason) {
    return fmt::format("stopped by {} after {} sweeps instead of {} after {}", to_string(a.stop_reason), a.sweeps,
                       to_string(b.stop_reason), b.sweeps);
  }
  for (std::size_t i = 0; i < b.history.size(); ++i) {
    if (a.history.size() != b.history.size() || a.history[i].sweep != b.history[i].sweep ||
        a.history[i].moved != b.history[i].moved ||
        !same_number(a.history[i].max_relative_move, b.history[i].max_relative_move) ||
        !same_number(a.history[i].min_shape, b.history[i].min_shape)) {
      return fmt::format("the history differs in sweep {}", i + 1);
    }
  }
  if (a.free_vertices != b.free_vertices || a.moved_vertices != b.moved_vertices ||
      a.reverted_vertices != b.reverted_vertices || a.guard_rounds != b.guard_rounds ||
      a.reverted.size() != b.reverted.size()) {
    return fmt::format("{} free, {} moved, {} reverted in {} rounds instead of {}, {}, {} in {}", a.free_vertices,
                       a.moved_vertices, a.reverted_vertices, a.guard_rounds, b.free_vertices, b.moved_vertices,
                       b.reverted_vertices, b.guard_rounds);
  }
  for (std::size_t i = 0; i < b.reverted.size(); ++i) {
    if (a.reverted[i].vertex != b.reverted[i].vertex || !(a.reverted[i].position == b.reverted[i].position)) {
      return fmt::format("reverted vertex {} is {} instead of {}, or was elsewhere", i, a.reverted[i].vertex,
                         b.reverted[i].vertex);
    }
  }
  if (text_of(a.untangling) != text_of(b.untangling)) {
    return fmt::format("untangling: {} instead of {}", text_of(a.untangling), text_of(b.untangling));
  }
  return difference(found.xy, expected.xy);
}

std::string difference_in_value(Run found, const Run& expected) {
  for (std::size_t i = 0; i < found.xy.size(); ++i) {
    found.xy[i] = found.xy[i] == expected.xy[i] ? expected.xy[i] : found.xy[i];
  }
  return difference(found, expected);
}

}  // namespace properties
