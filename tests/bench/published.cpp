#include "trismooth/pipeline/bench/published.h"

#include <algorithm>
#include <cmath>

#include "catch.h"

using trismooth::Form;
using trismooth::bench::published_row;
using trismooth::bench::published_sizes;
using trismooth::bench::published_tables;
using trismooth::bench::PublishedTable;
using trismooth::bench::Version;

// A figure copied wrongly would not fit the others: the paper states times and their quotients, and repeats the CPU's.

TEST_CASE("the published speedups are the quotients of the published times") {
  for (const PublishedTable& table : published_tables()) {
    for (const auto& row : table.rows) {
      CAPTURE(table.number, row.vertices);
      CHECK(std::abs(row.cpu_ms / row.aos_ms - row.aos_speedup) < 0.005 * row.aos_speedup);
      CHECK(std::abs(row.cpu_ms / row.soa_ms - row.soa_speedup) < 0.005 * row.soa_speedup);
    }
  }
}

TEST_CASE("the published tables are numbered, and have the five sizes each") {
  REQUIRE(published_tables().size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    const PublishedTable& table = published_tables()[i];
    CHECK(table.number == static_cast<int>(i) + 1);
    CHECK(std::ranges::equal(table.rows, published_sizes, {}, &trismooth::bench::PublishedRow::vertices));
  }
}

TEST_CASE("both versions of a form were compared with the same serial times") {
  for (const Form form : {Form::swap, Form::in_place}) {
    for (const std::int64_t size : published_sizes) {
      CHECK(published_row(Version::gpu, form, size)->cpu_ms == published_row(Version::cdp, form, size)->cpu_ms);
    }
  }
}

TEST_CASE("the largest published speedup is the one that the paper's text names") {
  double largest = 0;
  for (const PublishedTable& table : published_tables()) {
    for (const auto& row : table.rows) {
      largest = std::max({largest, row.aos_speedup, row.soa_speedup});
    }
  }
  CHECK(largest == 44.76);
  CHECK(published_row(Version::cdp, Form::swap, 100'000)->aos_speedup == largest);
}

TEST_CASE("what the paper did not measure has no row") {
  CHECK(published_row(Version::resident, Form::swap, 1'000) == nullptr);
  CHECK(published_row(Version::serial, Form::swap, 1'000) == nullptr);
  CHECK(published_row(Version::gpu, Form::swap, 2'000) == nullptr);
}
