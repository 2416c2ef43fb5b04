// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/paper/comparisons.h"

#include <algorithm>
#include <string>
#include <vector>

#include "catch.h"
#include "sample_experiment.h"

using sample::Case;
using sample::ExperimentResult;
using sample::Form;
using sample::Layout;
using sample::Order;
using sample::Spread;
using sample::Version;
using trismooth::experiments::by_size;
using trismooth::experiments::compare_all;
using trismooth::experiments::Comparison;
using trismooth::experiments::count_of;
using trismooth::experiments::overall;
using trismooth::experiments::Support;
using trismooth::experiments::support_of;
using trismooth::experiments::tally;

namespace {

const Case gpu_aos{Version::gpu, Form::swap, Order::colour, Layout::aos};
const Case gpu_soa{Version::gpu, Form::swap, Order::colour, Layout::soa};

/// A result in which GPU-AoS takes `aos` and everything else `rest`.
ExperimentResult two_times(const Spread& aos, const Spread& rest) {
  return sample::experiment({1'000}, [&](std::int64_t, const Case& what) { return what == gpu_aos ? aos : rest; });
}

Support support_with(const Spread& aos, const Spread& rest) {
  return compare_all(two_times(aos, rest), {{gpu_aos, gpu_soa}}).at(0).support;
}

}  // namespace

TEST_CASE("times speak for a claim where their ranges are apart") {
  CHECK(support_with({1, 0.9, 1.1}, {2, 1.2, 2.2}) == Support::yes);
  CHECK(support_with({2, 1.2, 2.2}, {1, 0.9, 1.1}) == Support::no);
  CHECK(support_with({1, 0.9, 1.3}, {2, 1.2, 2.2}) == Support::within_spread);
  CHECK(support_with({1, 1, 1}, {1, 1, 1}) == Support::within_spread);
}

TEST_CASE("what was measured once decides nothing") {
  ExperimentResult result = two_times({1, 1, 1}, {2, 2, 2});
  CHECK(compare_all(result, {{gpu_aos, gpu_soa}}).at(0).support == Support::yes);
  for (auto& row : result.rows) {
    row.measured->runs = row.what == gpu_soa ? 1 : 7;
  }
  CHECK(compare_all(result, {{gpu_aos, gpu_soa}}).at(0).support == Support::unknown);
}

TEST_CASE("what took no time that could be measured is not compared") {
  CHECK(compare_all(two_times({0, 0, 0}, {2, 2, 2}), {{gpu_aos, gpu_soa}}).empty());
  CHECK(compare_all(two_times({2, 2, 2}, {1, 0, 1}), {{gpu_aos, gpu_soa}}).empty());
}

TEST_CASE("a factor is held against a threshold by all of its range") {
  CHECK(support_of({50, 45, 60}, 44) == Support::yes);
  CHECK(support_of({50, 40, 60}, 44) == Support::within_spread);
  CHECK(support_of({40, 35, 43}, 44) == Support::no);
}

TEST_CASE("a comparison tells how many times as fast the first is, beside the paper's factor") {
  const ExperimentResult result = two_times({2, 1, 4}, {6, 5, 8});
  const Comparison comparison = compare_all(result, {{gpu_aos, gpu_soa}}).at(0);
  CHECK(comparison.factor.median == 3);
  CHECK(comparison.factor.least == 1.25);
  CHECK(comparison.factor.most == 8);
  CHECK(comparison.claimed_faster == gpu_aos);
  CHECK(comparison.claimed_slower == gpu_soa);
  CHECK(comparison.published == 18.8 / 16.0);
  CHECK_FALSE(comparison.sweeps);
}

TEST_CASE("a comparison of forms knows the sweeps of both") {
  const Case form_b{Version::gpu, Form::in_place, Order::unordered, Layout::aos};
  const Comparison comparison =
      compare_all(sample::experiment({1'000}, &sample::regular_time), {{form_b, gpu_aos}}).at(0);
  REQUIRE(comparison.sweeps);
  CHECK((*comparison.sweeps)[0].most == 85);
  CHECK((*comparison.sweeps)[1].median == 100);
  CHECK(comparison.published == 16.0 / 14.9);
}

TEST_CASE("what was not measured is not compared") {
  const ExperimentResult result = sample::experiment({1'000, 5'000}, [](std::int64_t size, const Case& what) {
    return size == 5'000 && what == gpu_soa ? std::nullopt : sample::regular_time(size, what);
  });
  CHECK(compare_all(result, {{gpu_aos, gpu_soa}}).size() == 1);
}

TEST_CASE("over all, a factor has the median of the medians and the widest bounds") {
  std::vector<Comparison> comparisons(3);
  comparisons[0].factor = {2, 1, 3};
  comparisons[1].factor = {5, 4, 9};
  comparisons[2].factor = {3, 0.5, 4};
  const Spread factor = overall(comparisons);
  CHECK(factor.median == 3);
  CHECK(factor.least == 0.5);
  CHECK(factor.most == 9);
}

TEST_CASE("a tally counts both sides and what cannot be told, and states the factor") {
  std::vector<Comparison> comparisons(4);
  comparisons[0].factor = {2, 1.5, 3};
  comparisons[0].support = Support::yes;
  comparisons[1].factor = {0.5, 0.25, 0.75};
  comparisons[1].support = Support::no;
  comparisons[2].factor = {1, 0.5, 1.5};
  comparisons[2].support = Support::within_spread;
  comparisons[3].factor = {4, 3, 5};
  comparisons[3].support = Support::yes;
  comparisons[3].published = 1.25;
  CHECK(count_of(comparisons, Support::yes) == 2);
  CHECK(tally(comparisons, "AoS is", "SoA") ==
        "AoS is faster in 2 of 4 comparisons, SoA in 1; 1 within the spread. AoS is 1.50 times as fast in the median, "
        "0.250 to 5.00 over all runs; in the paper 1.25 (1.25 to 1.25).");
  comparisons[2].support = Support::unknown;
  CHECK(tally(comparisons, "AoS is", "SoA").find("; 0 within the spread, 1 measured once only.") != std::string::npos);
}

TEST_CASE("factors by size leave out sizes without a comparison") {
  const ExperimentResult result = sample::experiment({1'000, 5'000, 10'000}, &sample::regular_time);
  std::vector<Comparison> comparisons(2);
  comparisons[0].vertices = 10'000;
  comparisons[0].factor = {2, 2, 2};
  comparisons[1].vertices = 1'000;
  comparisons[1].factor = {0.5, 0.5, 0.5};
  CHECK(by_size(result, comparisons) == "The median of these factors by size: 1K: 0.500; 10K: 2.00.");
}
