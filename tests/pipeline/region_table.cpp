// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/report/region_table.h"

#include <algorithm>
#include <sstream>
#include <string>

#include "trismooth/base/text/printable_text.h"

#include "catch.h"
#include "support/says.h"

namespace trismooth::region_table_test {

/// Regions "r0", "r1", ...: the smallest shape is the smaller the larger the number.
PipelineResult regions(int count, bool smoothed) {
  PipelineResult result;
  for (int r = 0; r < count; ++r) {
    const double shape = 0.9 - 0.001 * r;
    result.region_names.push_back("r" + std::to_string(r));
    result.regions_before.push_back({1234567 + r, r, shape / 2, shape - 0.1, 12.25});
    if (smoothed) {
      result.regions_after.push_back({1234567 + r, 0, shape, shape + 0.05, 33.5});
    }
  }
  return result;
}

TEST_CASE("each region has a line, named by its value in the file") {
  for (const bool smoothed : {false, true}) {
    const std::string text = region_table(regions(3, smoothed));
    CAPTURE(text);
    for (const char* const words : {"region", "min shape", "r0", "r2", "1,234,569", "12.250"}) {
      CHECK(says(text, words));
    }
    CHECK(says(text, "33.500") == smoothed);
    CHECK(std::ranges::count(text, '\n') == (smoothed ? 5 : 4));
  }
}

TEST_CASE("there is no table of one region") {
  CHECK(region_table(regions(1, true)).empty());
  CHECK(region_table(PipelineResult{}).empty());
}

TEST_CASE("of many regions the worst are shown, in their order, and how many there are") {
  const std::string text = region_table(regions(30, true), 4);
  CAPTURE(text);
  CHECK_FALSE(says(text, "r25 "));
  CHECK(text.find("r26 ") < text.find("r27 "));
  CHECK(text.find("r28 ") < text.find("r29 "));
  CHECK(says(text, "the 4 worst of 30 regions"));
}

TEST_CASE("names are cut where they are long, and not so short that two regions have the same") {
  for (const bool smoothed : {false, true}) {
    PipelineResult result = regions(3, smoothed);
    result.region_names = {"machine core inner", "machine core outer", "water"};
    const std::string text = region_table(result);
    CAPTURE(text);
    CHECK(says(text, smoothed ? "machine core i.." : "machine core inner"));
    CHECK(says(text, smoothed ? "machine core o.." : "machine core outer"));
    result.region_names = {"machine core inner", "rotor", "water"};
    CHECK(says(region_table(result), "machine core inner") == !smoothed);
  }
}

TEST_CASE("no line is longer than 80 characters, whatever the names, which are in UTF-8 and control nothing") {
  PipelineResult result = regions(3, true);
  result.region_names = {"a very long name of a region, of several arrays", "\x1b[31mred", "gr\xc3\xb6\xc3\x9f"};
  const std::string table = region_table(result);
  CHECK(says(table, "gr\xc3\xb6\xc3\x9f "));
  CHECK(says(table, "\\x1b[31m.."));
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    CAPTURE(line);
    CHECK(std::ranges::count_if(line, [](char c) { return (c & 0xc0) != 0x80; }) <= 80);
    CHECK(trismooth::printable(line) == line);
  }
}

TEST_CASE("a page has every region, its name shown literally") {
  PipelineResult result = regions(40, true);
  result.region_names[0] = "<i>";
  const std::string html = region_table_html(result);
  CHECK(says(html, "&lt;i&gt;"));
  CHECK_FALSE(says(html, "<i>"));
  CHECK(says(html, ">r39<"));
}

}  // namespace trismooth::region_table_test
