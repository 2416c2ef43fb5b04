// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/paper/conclusions.h"

#include <algorithm>
#include <optional>
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
using trismooth::experiments::Conclusion;
using trismooth::experiments::conclusions_of;
using trismooth::experiments::Support;
using trismooth::experiments::Verdict;

namespace {

enum Claim { speedup, layout, form, cdp };

Conclusion conclude(Claim claim, const ExperimentResult& result) {
  const std::vector<Conclusion> all = conclusions_of(result);
  REQUIRE(all.size() == 4);
  return all[claim];
}

Conclusion conclude(Claim claim, const sample::Times& times) {
  return conclude(claim, sample::experiment({1'000, 100'000}, times));
}

/// Times that are `factor` of the regular ones for the cases that `is_meant` names.
template <class Predicate>
sample::Times scaled(double factor, const Predicate& is_meant) {
  return [=](std::int64_t vertices, const Case& what) {
    const Spread time = *sample::regular_time(vertices, what);
    const double f = is_meant(vertices, what) ? factor : 1;
    return Spread(time.median * f, time.least * f, time.most * f);
  };
}

bool says(const Conclusion& conclusion, const std::string& words) {
  return std::ranges::any_of(conclusion.findings,
                             [&](const std::string& finding) { return finding.find(words) != std::string::npos; });
}

bool is_paper_version(const Case& what) {
  return what.version == Version::gpu || what.version == Version::cdp;
}

}  // namespace

TEST_CASE("the claims are the paper's four, in its order") {
  const std::vector<Conclusion> all = conclusions_of(sample::experiment({1'000}, &sample::regular_time));
  REQUIRE(all.size() == 4);
  for (std::size_t i = 0; i < all.size(); ++i) {
    CHECK(all[i].number == static_cast<int>(i) + 1);
  }
  CHECK(all[0].claim.find("44 times") != std::string::npos);
}

TEST_CASE("44 times holds where one of the paper's versions reaches that with all of its spread") {
  // Regular: serial 40, CDP 4, so 10 times, with 7/9 to 9/7 of that as bounds.
  const auto only_one = [](std::int64_t vertices, const Case& what) {
    return vertices == 100'000 && what.version == Version::cdp && what.form == Form::swap && what.layout == Layout::aos;
  };
  CHECK(conclude(speedup, &sample::regular_time).verdict == Verdict::does_not);
  CHECK(conclude(speedup, scaled(0.2, only_one)).verdict == Verdict::undecided);
  const Conclusion reached = conclude(speedup, scaled(0.1, only_one));
  CHECK(reached.verdict == Verdict::holds);
  CHECK(says(reached, "100 (78-129) times: CDP-AoS, Form A, 100K vertices"));
  CHECK(says(reached, "In the paper it is 44.76 times: CDP-AoS, Form A, 100K"));
}

TEST_CASE("the resident version does not make the paper's claim hold, but is named") {
  const Conclusion conclusion = conclude(speedup, &sample::regular_time);
  CHECK(conclusion.verdict == Verdict::does_not);
  CHECK(says(conclusion, "The resident version reaches 160 "));
  CHECK(says(conclusion, "The optimised CPU version reaches 4.00 "));
}

TEST_CASE("the speedup claim also says what has become faster since the paper") {
  // Serial, Form A: 218 / 80 and 33836 / 8000; Form B: 171 / 40 and 26021 / 4000.
  CHECK(says(conclude(speedup, &sample::regular_time), "the serial CPU version is 2.73 to 6.51 times as fast here"));
}

TEST_CASE("AoS at least as fast as SoA holds where it is faster or cannot be told apart") {
  const auto soa = [](std::int64_t, const Case& what) { return what.layout == Layout::soa && is_paper_version(what); };
  // Regular: 1.25 times, within spreads of an eighth.
  const Conclusion within = conclude(layout, &sample::regular_time);
  CHECK(within.verdict == Verdict::holds);
  CHECK(within.comparisons.size() == 8);
  CHECK(conclude(layout, scaled(2, soa)).verdict == Verdict::holds);
  CHECK(conclude(layout, scaled(0.25, soa)).verdict == Verdict::does_not);
  const Conclusion part = conclude(layout, [&](std::int64_t vertices, const Case& what) {
    return scaled(vertices == 1'000 ? 0.25 : 2, soa)(vertices, what);
  });
  CHECK(part.verdict == Verdict::in_part);
  CHECK(says(part, "1K: 0.312; 100K: 2.50"));
}

TEST_CASE("Form A slower than Form B is judged by the paper's literal Form B, with the sweeps of both") {
  const Conclusion conclusion = conclude(form, &sample::regular_time);
  CHECK(conclusion.verdict == Verdict::holds);
  CHECK(conclusion.comparisons.size() == 8);
  CHECK(says(conclusion, "1K: 100 and 80 (75-85); 100K: 100 and 80 (75-85)"));
  // Twice the time for 100 sweeps instead of 80.
  CHECK(says(conclusion, "smoothing in Form A takes 1.60 times as long"));
  const auto literal = [](std::int64_t, const Case& what) { return what.order == Order::unordered; };
  CHECK(conclude(form, scaled(8, literal)).verdict == Verdict::does_not);
  CHECK(conclude(form, scaled(2, literal)).verdict == Verdict::undecided);
  const auto coloured = [](std::int64_t, const Case& what) {
    return what.form == Form::in_place && what.order == Order::colour;
  };
  const Conclusion other = conclude(form, scaled(8, coloured));
  CHECK(other.verdict == Verdict::holds);
  CHECK(says(other, "With Form B in colour order: Form B is faster in 0 of 8 comparisons, Form A in 8"));
}

TEST_CASE("CDP slightly faster than GPU is judged in both forms and layouts") {
  const Conclusion conclusion = conclude(cdp, &sample::regular_time);
  CHECK(conclusion.verdict == Verdict::holds);
  CHECK(conclusion.comparisons.size() == 8);
  CHECK(conclusion.comparisons.front().factor.median == 2);
  const auto small_cdp = [](std::int64_t vertices, const Case& what) {
    return vertices == 1'000 && what.version == Version::cdp;
  };
  CHECK(conclude(cdp, scaled(8, small_cdp)).verdict == Verdict::in_part);
  CHECK(conclude(cdp, scaled(2, [](std::int64_t, const Case& what) { return what.version == Version::cdp; })).verdict ==
        Verdict::undecided);
}

TEST_CASE("without a device the forms are judged by the CPU, and the rest says what it takes") {
  const ExperimentResult result = sample::experiment({1'000, 100'000}, &sample::cpu_time);
  for (const Claim claim : {speedup, layout, cdp}) {
    const Conclusion conclusion = conclude(claim, result);
    CHECK(conclusion.verdict == Verdict::not_measured);
    CHECK(conclusion.comparisons.empty());
    CHECK(conclusion.findings.front() == "Not measured: no device: for a <test>.");
  }
  const Conclusion forms = conclude(form, result);
  CHECK(forms.verdict == Verdict::holds);
  CHECK(forms.comparisons.size() == 4);
  CHECK(forms.findings.front().find("Judged by the CPU versions alone") == 0);
  CHECK(says(forms, "1K: 100 and 50; 100K: 100 and 50"));
}

TEST_CASE("one comparison against a claim leaves it in part where others agree, whatever agreeing means") {
  const auto soa_at = [](std::int64_t size) {
    return [size](std::int64_t vertices, const Case& what) {
      return vertices == size && what.version == Version::gpu && what.layout == Layout::soa;
    };
  };
  // Regular layouts are within their spread, which agrees with "at least as fast".
  CHECK(conclude(layout, scaled(0.25, soa_at(1'000))).verdict == Verdict::in_part);
  // Being faster takes more: a version that is within the spread at one size is not always faster.
  const auto gpu_form_b_at_1k = [](std::int64_t vertices, const Case& what) {
    return vertices == 1'000 && what.version == Version::gpu && what.order == Order::unordered;
  };
  CHECK(conclude(form, scaled(2, gpu_form_b_at_1k)).verdict == Verdict::in_part);
}

TEST_CASE("what was measured once decides on no claim") {
  ExperimentResult result = sample::experiment({1'000, 100'000}, &sample::regular_time);
  for (auto& row : result.rows) {
    row.measured->runs = 1;
  }
  for (const Conclusion& conclusion : conclusions_of(result)) {
    CHECK(conclusion.verdict == Verdict::undecided);
  }
}

TEST_CASE("times of nothing make no speedups and no verdicts") {
  const std::vector<Conclusion> all =
      conclusions_of(sample::experiment({1'000}, [](std::int64_t size, const Case& what) -> std::optional<Spread> {
        return runs_on_device(what.version) ? sample::exactly(0) : *sample::regular_time(size, what);
      }));
  for (const Conclusion& conclusion : all) {
    for (const std::string& finding : conclusion.findings) {
      CHECK(finding.find("inf") == std::string::npos);
      CHECK(finding.find("nan") == std::string::npos);
    }
  }
  CHECK(all[speedup].verdict == Verdict::not_measured);
}

TEST_CASE("reasons are those of the paper's versions") {
  const ExperimentResult result =
      sample::experiment({1'000}, &sample::cpu_time, {Version::serial, Version::cpu, Version::resident});
  CHECK(conclude(speedup, result).findings.front() == "Not measured: the experiment was not asked for what it takes.");
}

TEST_CASE("an experiment that was not asked for enough says so") {
  const ExperimentResult result = sample::experiment({1'000}, &sample::regular_time, {Version::resident});
  for (const Conclusion& conclusion : conclusions_of(result)) {
    CHECK(conclusion.verdict == Verdict::not_measured);
    CHECK(says(conclusion, "was not asked for what it takes"));
    CHECK_FALSE(says(conclusion, "Judged by"));
  }
}

TEST_CASE("conclusions follow from the numbers alone: other units change none") {
  const auto times_of = [](double unit) { return scaled(unit, [](std::int64_t, const Case&) { return true; }); };
  for (const Claim claim : {layout, form, cdp}) {
    const Conclusion one = conclude(claim, times_of(1));
    const Conclusion other = conclude(claim, times_of(1024));
    CHECK(one.verdict == other.verdict);
    CHECK(one.findings == other.findings);
  }
}
