// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/result_text.h"

#include <string>

#include "catch.h"

namespace trismooth::result_text_test {

TEST_CASE("what stays where lines touch is told, with what there is to do about it") {
  SlidingResult sliding;
  CHECK(touching_lines_text(sliding, true, true).empty());
  sliding.in_same_place = 20;
  const std::string together =
      "lines touch without sharing vertices, so these do not slide: 20 where others are, within a thousandth of an "
      "edge; --slide-coincident has those in the same place slide together, on splines where it is the very same; ";
  CHECK(touching_lines_text(sliding, true, true) ==
        together + "--merge DISTANCE, without --slide, joins vertices that nearly coincide");
  CHECK(touching_lines_text(sliding, true, false) ==
        together + "elements of both sides that name the same vertices have none of these");
  sliding.at_edges = 5;
  CHECK(
      touching_lines_text(sliding, false, true) ==
      "lines touch without sharing vertices, so these do not slide: 20 where others are, within a thousandth of an "
      "edge, 5 within edges of others or at their ends; --merge DISTANCE, without --slide, joins vertices that nearly "
      "coincide");
  sliding.in_same_place = 0;
  CHECK(touching_lines_text(sliding, true, true) ==
        "lines touch without sharing vertices, so these do not slide: 5 within edges of others or at their ends; "
        "--merge DISTANCE, without --slide, joins vertices that nearly coincide");
}

TEST_CASE("layers that are held, carried along or smoothed are counted, one or many, with the way out") {
  LayersResult layers;
  CHECK(held_layers_text(layers).empty());
  CHECK(carried_layers_text(layers).empty());
  CHECK(left_layers_text(layers).empty());
  layers.kept = 1;
  layers.kept_aspect = 12.345;
  CHECK(held_layers_text(layers) ==
        "1 vertex is of layers that are flat on purpose (aspect 12.3 at most) and is held; --layers smooth moves it");
  CHECK(carried_layers_text(layers) ==
        "1 vertex is of layers that are flat on purpose (aspect 12.3 at most) and is carried along as it is; --layers "
        "smooth smooths it, and goes further where the boundary bends");
  layers.kept_on_lines = 4;
  CHECK(held_layers_text(layers) ==
        "5 vertices are of layers that are flat on purpose (aspect 12.3 at most) and are held, 4 of which would slide; "
        "--layers smooth moves them");
  layers.left = 1;
  layers.left_aspect = 4.5;
  CHECK(left_layers_text(layers) ==
        "1 vertex is where elements are flat in one direction (aspect 4.5 at most) and is smoothed as all others; if "
        "that is on purpose, --layers keep holds it, and --method mean-ratio with --target input-shape keeps the "
        "shapes");
  layers.left = 7;
  layers.left_aspect = 5e6;
  CHECK(
      left_layers_text(layers) ==
      "7 vertices are where elements are flat in one direction (aspect 5e+06 at most) and are smoothed as all others; "
      "if that is on purpose, --layers keep holds them, and --method mean-ratio with --target input-shape keeps the "
      "shapes");
}

TEST_CASE("a limit of time that left none for a sweep is told, one that ended sweeps is not") {
  SmoothingResult result;
  CHECK(no_time_text(result).empty());
  result.stop_reason = StopReason::time_limit;
  CHECK(no_time_text(result) ==
        "the time was up before the first sweep, so no sweep has moved anything; give --time-limit more");
  CHECK(no_time_text(result, "so nothing was done") ==
        "the time was up before the first sweep, so nothing was done; give --time-limit more");
  result.sweeps = 1;
  CHECK(no_time_text(result).empty());
}

TEST_CASE("nodes between corners that cannot follow these are counted, with the way out") {
  CHECK(shared_middles_text(0).empty());
  CHECK(shared_middles_text(1) ==
        "1 node in the middle of a side or element is a corner as well, or in the middle of others too: held, with the "
        "corners around it; a node of its own for each side and element lets them move");
  CHECK(shared_middles_text(1200) ==
        "1200 nodes in the middle of sides or elements are corners as well, or in the middle of others too: held, with "
        "the corners around them; a node of its own for each side and element lets them move");
}

}  // namespace trismooth::result_text_test
