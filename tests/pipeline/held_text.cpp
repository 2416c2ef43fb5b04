// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/report/held_text.h"

#include <string>

#include "trismooth/pipeline/report/held_html.h"

#include "catch.h"
#include "support/says.h"

namespace trismooth::held_text_test {

InputSummary machine() {
  InputSummary input;
  input.vertices = 3207;
  input.fixed_vertices = 804;
  input.region_arrays = {{"region", RegionReason::known_name, 10, 672}};
  input.held = {.boundary = 140, .interface = 672, .several = 8};
  return input;
}

TEST_CASE("one line says how many vertices are held, by reason and by array") {
  CHECK(held_text(machine()) == "804 of 3207: 140 boundary, 672 interface ('region'), 8 of them both");
  InputSummary input = machine();
  input.region_arrays.push_back({"gmsh:physical", RegionReason::named, 2, 0});
  input.fixed_array = "anchors";
  input.fixed_array_vertices = 12;
  input.fixed_ids = "ids.txt";
  input.held.unused = 3;
  input.held.bow_tie = 2;
  CHECK(held_text(input) ==
        "804 of 3207: 140 boundary, 672 interface ('region', 'gmsh:physical'), 2 bow tie, 3 unused, 12 by the array "
        "'anchors', 0 by the file ids.txt, 8 of them for several reasons");
}

TEST_CASE("a mesh of which nothing is held has no reasons") {
  InputSummary input;
  input.vertices = 7;
  CHECK(held_text(input) == "0 of 7");
}

TEST_CASE("an array that was obeyed is named even where it holds nothing") {
  InputSummary input;
  input.vertices = 7;
  input.fixed_array = "fixed";
  input.region_arrays = {{"region", RegionReason::known_name, 1, 0}};
  CHECK(held_text(input) == "0 of 7: 0 interface ('region'), 0 by the array 'fixed'");
  input.regions = 1;
  CHECK(held_text(input) == "0 of 7: no interface ('region' is one region), 0 by the array 'fixed'");
}

TEST_CASE("sets and lines that the file names are named, with the vertices they hold") {
  InputSummary input = machine();
  input.point_sets = {{"Corners", 4, false, true}, {"NALL", 3207, true, false}, {"Required", 12, false, true}};
  input.line_groups = {{"inlet", 12}, {"wall", 40}};
  CHECK(
      held_text(input) ==
      "804 of 3207: 140 boundary, 672 interface ('region'), named by the file (4 'Corners', 12 'Required'), 8 of them "
      "for several reasons");
  CHECK(trismooth::line_groups_text(input) == "12 'inlet', 40 'wall'");
  const std::string html = held_html(input);
  CHECK(says(html, "not by the point set &#39;NALL&#39;<small>covers an area</small>"));
  CHECK(says(html, "by the lines &#39;wall&#39;"));
  input.line_groups.assign(40, {"x", 1});
  CHECK(says(trismooth::line_groups_text(input), "1 'x' and 28 more"));
}

TEST_CASE("a page says the same, with why each array counts, and shows names literally") {
  InputSummary input = machine();
  input.region_arrays.push_back({"<b>", RegionReason::looks_like_regions, 1, 33});
  input.fixed_array = "a & b";
  input.fixed_array_vertices = 12345;
  input.fixed_ids = "ids.txt";
  input.fixed_ids_vertices = 4;
  const std::string html = held_html(input);
  CAPTURE(html);
  for (const char* const words : {">804<", ">140<", ">672<", "&#39;region&#39;<small>10 values; by its name</small>",
                                  "&#39;&lt;b&gt;&#39;<small>1 value; looks like regions</small>",
                                  "&#39;a &amp; b&#39;", ">12,345<", "ids.txt", ">4<"}) {
    CAPTURE(words);
    CHECK(says(html, words));
  }
  CHECK_FALSE(says(html, "<b>"));
  CHECK_FALSE(says(html, "no cell"));
}

}  // namespace trismooth::held_text_test
