// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/paper/conclusions.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>

#include <fmt/format.h>

#include "trismooth/base/text/list_text.h"
#include "trismooth/paper/wording.h"
#include "trismooth/quality/text/report_text.h"

namespace trismooth::experiments {

namespace {

constexpr double claimed_speedup = 44;
constexpr std::array versions_of_paper{Version::gpu, Version::cdp};
constexpr std::array layouts{Layout::aos, Layout::soa};

/// `or_equal`: the claim is that nothing is slower, so what is within the spread agrees with it.
Verdict verdict_of(const std::vector<Comparison>& comparisons, bool or_equal) {
  if (comparisons.empty()) {
    return Verdict::not_measured;
  }
  const std::int64_t equal = count_of(comparisons, Support::within_spread);
  const std::int64_t against = count_of(comparisons, Support::no);
  const std::int64_t agree = count_of(comparisons, Support::yes) + (or_equal ? equal : 0);
  const std::int64_t known = std::ssize(comparisons) - count_of(comparisons, Support::unknown);
  if (known == 0 || (agree == 0 && against == 0)) {
    return Verdict::undecided;
  }
  return agree == known ? Verdict::holds : agree > 0 ? Verdict::in_part : Verdict::does_not;
}

/// The largest speedup over the serial CPU version among these cases.
struct Best {
  Case what;
  std::int64_t vertices = 0;
  Spread speedup;
};

using Speedup = std::optional<Spread> (ExperimentResult::*)(std::int64_t, const Case&) const;

std::optional<Best> best_of(const ExperimentResult& result, const std::vector<Case>& cases,
                            Speedup speedup = &ExperimentResult::speedup) {
  std::optional<Best> best;
  for (const Case& what : cases) {
    for (const std::int64_t size : result.options.sizes) {
      const auto here = (result.*speedup)(size, what);
      if (here && (!best || here->median > best->speedup.median)) {
        best = {what, size, *here};
      }
    }
  }
  return best;
}

std::string text_of(const Best& best) {
  return fmt::format("{} times: {}, {} vertices", best.speedup.text(), full_name(best.what), size_text(best.vertices));
}

std::vector<Case> cases_of_paper() {
  std::vector<Case> cases;
  for (const Version version : versions_of_paper) {
    for (const Form form : forms) {
      for (const Layout layout : layouts) {
        cases.push_back(case_of_paper(version, form, layout));
      }
    }
  }
  return cases;
}

std::string best_published() {
  double best = 0;
  std::string where;
  for (const Case& what : cases_of_paper()) {
    for (const std::int64_t size : published_sizes) {
      if (const auto speedup = published_speedup(what, size); speedup && *speedup > best) {
        best = *speedup;
        where = fmt::format("{}, {}", full_name(what), size_text(size));
      }
    }
  }
  return fmt::format("{:.2f} times: {} vertices", best, where);
}

/// How many times as fast as in the paper these cases are: "38.4 to 112". Empty where there is nothing to compare.
std::string range_over_published(const ExperimentResult& result, const std::vector<Case>& cases) {
  std::vector<double> factors;
  for (const Case& what : cases) {
    for (const std::int64_t size : result.options.sizes) {
      const Measurement* const measured = result.find(size, what);
      const auto published = published_ms(what, size);
      if (published && measured != nullptr && measured->smoothing.least > 0) {
        factors.push_back(*published / measured->smoothing.median);
      }
    }
  }
  if (factors.empty()) {
    return {};
  }
  const Spread range(std::move(factors));
  return fmt::format("{} to {}", three_digits(range.least), three_digits(range.most));
}

/// Speedups are ratios: this says which of both sides has changed more since the paper.
void add_progress_since_paper(Conclusion& conclusion, const ExperimentResult& result) {
  const std::string serial =
      range_over_published(result, {{Version::serial, Form::swap}, {Version::serial, Form::in_place}});
  const std::string versions = range_over_published(result, cases_of_paper());
  if (!serial.empty() && !versions.empty()) {
    conclusion.findings.push_back(fmt::format(
        "Beside the paper's own times the serial CPU version is {} times as fast here, the paper's versions {} times.",
        serial, versions));
  }
}

Conclusion speedup_claim(const ExperimentResult& result) {
  Conclusion conclusion{1, "The GPU implementation is up to 44 times faster than the serial CPU version."};
  std::vector<Pair> pairs;
  for (const Case& what : cases_of_paper()) {
    pairs.emplace_back(what, Case{Version::serial, what.form});
  }
  conclusion.comparisons = compare_all(result, pairs, claimed_speedup);
  if (const auto best = best_of(result, cases_of_paper())) {
    // It takes one case.
    const std::int64_t against = count_of(conclusion.comparisons, Support::no);
    conclusion.verdict = count_of(conclusion.comparisons, Support::yes) > 0 ? Verdict::holds
                         : against < std::ssize(conclusion.comparisons)     ? Verdict::undecided
                                                                            : Verdict::does_not;
    conclusion.findings.push_back(fmt::format("The most that the paper's versions reach is {}. In the paper it is {}.",
                                              text_of(*best), best_published()));
    if (const auto whole = best_of(result, cases_of_paper(), &ExperimentResult::speedup_together)) {
      conclusion.findings.push_back(fmt::format("With topology and transfer on both sides it is {}.", text_of(*whole)));
    }
  }
  add_progress_since_paper(conclusion, result);
  if (const auto best = best_of(result, cases_of(std::array{Version::resident}))) {
    conclusion.findings.push_back(fmt::format("The resident version reaches {}.", text_of(*best)));
  }
  if (const auto best = best_of(result, cases_of(std::array{Version::cpu}))) {
    conclusion.findings.push_back(fmt::format("The optimised CPU version reaches {}.", text_of(*best)));
  }
  return conclusion;
}

/// A claim that one kind of case is faster than another.
struct FasterClaim {
  int number;
  std::string claim;
  std::string faster;  ///< what a sentence calls them
  std::string slower;
  bool or_equal = false;
};

Conclusion judge(const ExperimentResult& result, const FasterClaim& claim, const std::vector<Pair>& pairs) {
  Conclusion conclusion{claim.number, claim.claim};
  conclusion.comparisons = compare_all(result, pairs);
  conclusion.verdict = verdict_of(conclusion.comparisons, claim.or_equal);
  if (!conclusion.comparisons.empty()) {
    conclusion.findings = {tally(conclusion.comparisons, claim.faster, claim.slower),
                           by_size(result, conclusion.comparisons)};
  }
  return conclusion;
}

/// What comparisons beyond the paper's show, as one more finding.
void add_finding(Conclusion& conclusion, const ExperimentResult& result, const FasterClaim& claim,
                 std::string_view where, const std::vector<Pair>& pairs) {
  const std::vector<Comparison> comparisons = compare_all(result, pairs);
  if (!comparisons.empty()) {
    conclusion.findings.push_back(fmt::format("{}: {}", where, tally(comparisons, claim.faster, claim.slower)));
  }
}

Conclusion layout_claim(const ExperimentResult& result) {
  const FasterClaim claim{2, "The layout AoS is at least as fast as SoA.", "AoS is", "SoA", true};
  const auto pairs_of = [](Version version) {
    const auto pair_of = [version](Form form) {
      return Pair(case_of_paper(version, form, Layout::aos), case_of_paper(version, form, Layout::soa));
    };
    return std::vector<Pair>{pair_of(Form::swap), pair_of(Form::in_place)};
  };
  std::vector<Pair> pairs = pairs_of(Version::gpu);
  std::ranges::copy(pairs_of(Version::cdp), std::back_inserter(pairs));
  return judge(result, claim, pairs);
}

/// Form B beside Form A in every layout that the version has, for Form B in this order.
std::vector<Pair> form_pairs(Version version, Order order) {
  std::vector<Pair> pairs;
  for (const Layout layout : layouts) {
    if (layout == Layout::aos || has_layouts(version)) {
      pairs.push_back({{version, Form::in_place, order, layout}, {version, Form::swap, Order::colour, layout}});
    }
  }
  return pairs;
}

std::string sweeps_by_size(const ExperimentResult& result, const std::vector<Comparison>& comparisons) {
  std::string text;
  for (const std::int64_t size : result.options.sizes) {
    std::array<std::vector<double>, 2> sweeps;
    for (const Comparison& comparison : comparisons) {
      if (comparison.vertices == size && comparison.sweeps) {
        for (std::size_t i = 0; i < sweeps.size(); ++i) {
          const Spread& of_form = (*comparison.sweeps)[i];
          sweeps[i].insert(sweeps[i].end(), {of_form.least, of_form.median, of_form.most});
        }
      }
    }
    if (!sweeps[0].empty()) {
      add_to_list(
          text,
          fmt::format("{}: {} and {}", size_text(size), sweeps_text(Spread(sweeps[1])), sweeps_text(Spread(sweeps[0]))),
          "; ");
    }
  }
  return "Sweeps to the stop, Form A and Form B: " + text + ".";
}

/// Whether the other cause that the paper gives, more work in a sweep, is there.
std::string sweep_cost(const std::vector<Comparison>& comparisons) {
  std::vector<double> factors;
  for (const Comparison& comparison : comparisons) {
    if (comparison.sweeps) {
      factors.push_back(comparison.factor.median * (*comparison.sweeps)[0].median / (*comparison.sweeps)[1].median);
    }
  }
  const Spread factor(std::move(factors));
  return fmt::format("For each sweep, smoothing in Form A takes {} times as long as in Form B ({} to {}).",
                     three_digits(factor.median), three_digits(factor.least), three_digits(factor.most));
}

Conclusion form_claim(const ExperimentResult& result) {
  const FasterClaim claim{3, "Form A, which swaps, is always slower than Form B, which does not.", "Form B is",
                          "Form A"};
  const auto both = [](std::array<Version, 2> versions, Order order) {
    std::vector<Pair> pairs = form_pairs(versions[0], order);
    std::ranges::copy(form_pairs(versions[1], order), std::back_inserter(pairs));
    return pairs;
  };
  Conclusion conclusion = judge(result, claim, both(versions_of_paper, Order::unordered));
  const std::vector<Pair> on_cpu = both({Version::serial, Version::cpu}, Order::colour);
  const bool on_cpu_only = conclusion.comparisons.empty();
  if (on_cpu_only) {
    conclusion = judge(result, claim, on_cpu);
  }
  if (!conclusion.comparisons.empty()) {
    conclusion.findings.push_back(sweeps_by_size(result, conclusion.comparisons));
    conclusion.findings.push_back(sweep_cost(conclusion.comparisons));
  }
  if (on_cpu_only && !conclusion.comparisons.empty()) {
    conclusion.findings.insert(conclusion.findings.begin(),
                               "Judged by the CPU versions alone: the paper's versions were not measured.");
  } else if (!on_cpu_only) {
    add_finding(conclusion, result, claim, "With Form B in colour order", both(versions_of_paper, Order::colour));
    add_finding(conclusion, result, claim, "The resident version", form_pairs(Version::resident, Order::colour));
    add_finding(conclusion, result, claim, "The CPU versions", on_cpu);
  }
  return conclusion;
}

Conclusion cdp_claim(const ExperimentResult& result) {
  const FasterClaim claim{4, "The version with CUDA dynamic parallelism is slightly faster than the one without.",
                          "CDP is", "GPU"};
  const auto pairs_in = [](Form form, Order order) {
    const auto pair_of = [&](Layout layout) {
      return Pair{{Version::cdp, form, order, layout}, {Version::gpu, form, order, layout}};
    };
    return std::vector<Pair>{pair_of(Layout::aos), pair_of(Layout::soa)};
  };
  std::vector<Pair> pairs = pairs_in(Form::swap, Order::colour);
  std::ranges::copy(pairs_in(Form::in_place, Order::unordered), std::back_inserter(pairs));
  Conclusion conclusion = judge(result, claim, pairs);
  add_finding(conclusion, result, claim, "With Form B in colour order", pairs_in(Form::in_place, Order::colour));
  return conclusion;
}

/// Why the paper's versions were not measured.
std::string why_not_measured(const ExperimentResult& result) {
  const auto row = std::ranges::find_if(result.rows, [](const Row& candidate) {
    return std::ranges::find(versions_of_paper, candidate.what.version) != versions_of_paper.end() &&
           candidate.lack != Lack::nothing;
  });
  return row == result.rows.end() ? "the experiment was not asked for what it takes" : row->missing_reason;
}

}  // namespace

std::vector<Conclusion> conclusions_of(const ExperimentResult& result) {
  std::vector<Conclusion> conclusions{speedup_claim(result), layout_claim(result), form_claim(result),
                                      cdp_claim(result)};
  for (Conclusion& conclusion : conclusions) {
    if (conclusion.verdict == Verdict::not_measured) {
      conclusion.findings.insert(conclusion.findings.begin(),
                                 fmt::format("Not measured: {}.", why_not_measured(result)));
    }
  }
  return conclusions;
}

}  // namespace trismooth::experiments
