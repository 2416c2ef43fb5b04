// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <vector>

#include "trismooth/paper/experiment_report.h"

#include "catch.h"
#include "sample_experiment.h"
#include "support/parsed_page.h"

using pages::count_of;
using trismooth::experiments::make_report;
using trismooth::experiments::page_of;

namespace {

std::string page_with(const sample::Times& times) {
  return page_of(make_report(sample::experiment({1'000, 5'000, 100'000}, times), "trismooth bench --sizes <1K>",
                             "2026-01-02 03:04 UTC", ""));
}

}  // namespace

TEST_CASE("the page is well-formed, stands alone and runs nothing") {
  for (const auto& times : {sample::Times(&sample::regular_time), sample::Times(&sample::cpu_time)}) {
    const pages::Parsed page = pages::parse(page_with(times).substr(std::string("<!DOCTYPE html>").size()));
    CHECK(page.error.empty());
    CHECK(page.links.empty());
    CHECK(page.count("script") == 0);
    CHECK(page.count("link") == 0);
    CHECK(page.count("svg") == 4);  // each figure for wide windows and for narrow ones
  }
}

TEST_CASE("text from outside is escaped") {
  const pages::Parsed page = pages::parse(page_with(&sample::regular_time).substr(15));
  CHECK(page.says("A <fast> GPU"));
  CHECK(page.says("trismooth bench --sizes <1K>"));
}

TEST_CASE("the page has the claims, the paper's tables beside its figures, the figures and all measurements") {
  const std::string page = page_with(&sample::regular_time);
  const pages::Parsed parsed = pages::parse(page.substr(15));
  CHECK(count_of(page, "class=\"claim\"") == 4);
  CHECK(count_of(page, ">does not hold</span>") == 1);
  for (const char* title : {"Table 1: GPU version, Form A", "Table 2: GPU version, Form B, unordered as in the paper",
                            "Table 3: CDP version, Form A", "Table 4: CDP version, Form B, unordered as in the paper",
                            "Resident version, Form A", "100K: 100,000 vertices, 200,000 triangles"}) {
    CAPTURE(title);
    CHECK(parsed.says(title));
  }
  CHECK(count_of(page, "<td class=\"paper\">44.76</td>") == 1);
  CHECK(count_of(page, "id=\"figure-3\"") == 1);
  CHECK(count_of(page, "id=\"figure-4\"") == 1);
  CHECK(count_of(page, "id=\"figure-3-narrow\"") == 1);
  CHECK(count_of(page, "id=\"figure-4-narrow\"") == 1);
  // Every case on every mesh: a row each.
  CHECK(count_of(page, "<tr><td>CDP-SoA</td>") == 9);
}

TEST_CASE("without a device the page has the CPU's numbers and no empty tables beyond the paper's") {
  const pages::Parsed page = pages::parse(page_with(&sample::cpu_time).substr(15));
  CHECK(page.says("GPU: none used"));
  CHECK(page.says("Table 4"));
  CHECK_FALSE(page.says("Beyond the paper"));
  CHECK(page.says("they need a CUDA device"));
}
