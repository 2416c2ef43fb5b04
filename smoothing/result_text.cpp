// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/result_text.h"

#include <string_view>

#include "trismooth/base/text/counted.h"
#include "trismooth/base/text/digits.h"

namespace trismooth {

namespace {

/// "1 vertex is of layers ..": so many, of that aspect.
std::string layers_begin(std::int64_t count, double aspect) {
  return counted(count, "vertex is", "vertices are") + " of layers that are flat on purpose (aspect " +
         general_digits(aspect, 3) + " at most) and " + (count == 1 ? "is" : "are");
}

}  // namespace

std::string_view describe(StopReason reason) {
  switch (reason) {
    case StopReason::fixed_point:
      return "no vertex moved any more";
    case StopReason::tolerance:
      return "every move of the last sweep was within the tolerance";
    case StopReason::few_moves:
      return "few moves: next to nothing is left to gain";
    case StopReason::sweep_limit:
      return "the sweep limit was reached";
    case StopReason::time_limit:
      return "the time was up";
    case StopReason::quality_target:
      return "the quality target was reached";
    case StopReason::cancelled:
      break;
  }
  return "it was cancelled";
}

bool has_no_time_for_sweeps(const SmoothingResult& smoothing) {
  return smoothing.stop_reason == StopReason::time_limit && smoothing.sweeps == 0;
}

std::string no_time_text(const SmoothingResult& smoothing, std::string_view consequence) {
  return has_no_time_for_sweeps(smoothing)
             ? "the time was up before the first sweep, " + std::string(consequence) + "; give --time-limit more"
             : "";
}

std::string shared_middles_text(std::int64_t count) {
  return count == 0 ? ""
                    : counted(count, "node in the middle of a side or element is a corner",
                              "nodes in the middle of sides or elements are corners") +
                          " as well, or in the middle of others too: held, with the corners around " +
                          (count == 1 ? "it" : "them") + "; a node of its own for each side and element lets them move";
}

std::string held_layers_text(const LayersResult& layers) {
  const std::int64_t held = layers.kept + layers.kept_on_lines;
  if (held == 0) {
    return {};
  }
  const std::string sliding =
      layers.kept_on_lines > 0 ? ", " + std::to_string(layers.kept_on_lines) + " of which would slide" : "";
  return layers_begin(held, layers.kept_aspect) + " held" + sliding + "; --layers smooth moves " +
         (held == 1 ? "it" : "them");
}

std::string carried_layers_text(const LayersResult& layers) {
  if (layers.kept == 0) {
    return {};
  }
  const bool is_one = layers.kept == 1;
  return layers_begin(layers.kept, layers.kept_aspect) + " carried along as " + (is_one ? "it is" : "they are") +
         "; --layers smooth smooths " + (is_one ? "it" : "them") + ", and goes further where the boundary bends";
}

std::string left_layers_text(const LayersResult& layers) {
  if (layers.left == 0) {
    return {};
  }
  const bool is_one = layers.left == 1;
  return counted(layers.left, "vertex is", "vertices are") + " where elements are flat in one direction (aspect " +
         general_digits(layers.left_aspect, 3) + " at most) and " + (is_one ? "is" : "are") +
         " smoothed as all others; if that is on purpose, --layers keep holds " + (is_one ? "it" : "them") +
         ", and --method mean-ratio with --target input-shape keeps the shapes";
}

std::string touching_lines_text(const SlidingResult& sliding, bool may_slide_together, bool may_join) {
  std::string held;
  if (sliding.in_same_place > 0) {
    held = std::to_string(sliding.in_same_place) + " where others are, within a thousandth of an edge";
  }
  if (sliding.at_edges > 0) {
    held += (held.empty() ? "" : ", ") + std::to_string(sliding.at_edges) + " within edges of others or at their ends";
  }
  if (held.empty()) {
    return {};
  }
  const std::string_view together =
      may_slide_together && sliding.in_same_place > 0
          ? "--slide-coincident has those in the same place slide together, on splines where it is the very same; "
          : "";
  const std::string_view joined = may_join ? "--merge DISTANCE, without --slide, joins vertices that nearly coincide"
                                           : "elements of both sides that name the same vertices have none of these";
  return "lines touch without sharing vertices, so these do not slide: " + held + "; " + std::string(together) +
         std::string(joined);
}

std::string where_lines_are(const SlidingResult& sliding) {
  if (sliding.vertices == 0) {
    return "no vertex of a boundary or an interface can slide";
  }
  if (sliding.given_up) {
    return "given up: so many vertices would have gone back for it that nothing slides";
  }
  if (sliding.slid == 0) {
    return {};
  }
  return sliding.largest_deviation > 0
             ? "lines are up to " + general_digits(sliding.largest_deviation, 3) + " from where they were, " +
                   general_digits(sliding.relative_deviation, 3) + " of an edge"
             : "lines are where they were";
}

std::string sliding_text(const SlidingResult& sliding) {
  std::string where = where_lines_are(sliding);
  if (sliding.vertices == 0 || sliding.given_up) {
    return where;
  }
  return std::to_string(sliding.slid) + " of " + counted(sliding.vertices, "vertex", "vertices") + " on " +
         counted(sliding.chains, "line", "lines") + " slid" + (where.empty() ? "" : "; " + where);
}

}  // namespace trismooth
