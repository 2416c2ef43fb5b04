// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/paper/published.h"

#include <algorithm>
#include <cmath>

#include "catch.h"

using trismooth::Form;
using trismooth::Layout;
using trismooth::Order;
using trismooth::experiments::published_ms;
using trismooth::experiments::published_row;
using trismooth::experiments::published_sizes;
using trismooth::experiments::published_speedup;
using trismooth::experiments::published_tables;
using trismooth::experiments::PublishedTable;
using trismooth::experiments::Version;

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
    CHECK(std::ranges::equal(table.rows, published_sizes, {}, &trismooth::experiments::PublishedRow::vertices));
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

TEST_CASE("the paper's times are those of its own cases only") {
  CHECK(published_ms({Version::gpu, Form::swap, Order::colour, Layout::soa}, 1'000) == 18.8);
  CHECK(published_ms({Version::serial, Form::in_place}, 5'000) == 1139.0);
  CHECK_FALSE(published_ms({Version::gpu, Form::swap, Order::colour, Layout::soa}, 1'001));
  CHECK_FALSE(published_ms({Version::gpu, Form::in_place, Order::colour, Layout::aos}, 1'000));
  CHECK(published_ms({Version::gpu, Form::in_place, Order::unordered, Layout::aos}, 1'000) == 14.9);
  CHECK_FALSE(published_ms({Version::resident, Form::swap}, 1'000));
  CHECK_FALSE(published_ms({Version::cpu, Form::swap}, 1'000));
}

TEST_CASE("the paper's speedups are those of its tables") {
  CHECK(published_speedup({Version::cdp, Form::swap, Order::colour, Layout::soa}, 100'000) == 40.64);
  CHECK(published_speedup({Version::gpu, Form::in_place, Order::unordered, Layout::aos}, 5'000) == 21.74);
  CHECK_FALSE(published_speedup({Version::gpu, Form::in_place, Order::colour, Layout::aos}, 5'000));
  CHECK_FALSE(published_speedup({Version::serial, Form::swap}, 5'000));
}
