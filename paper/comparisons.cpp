// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/paper/comparisons.h"

#include <algorithm>
#include <iterator>
#include <limits>

#include <fmt/format.h>

#include "trismooth/base/text/list_text.h"
#include "trismooth/paper/wording.h"
#include "trismooth/quality/text/report_text.h"

namespace trismooth::experiments {

namespace {

/// How many times as fast `faster` smooths as `slower`, where both were measured.
std::optional<Comparison> compare(const ExperimentResult& result, std::int64_t vertices, const Case& faster,
                                  const Case& slower, double at_least) {
  const Measurement* const one = result.find(vertices, faster);
  const Measurement* const other = result.find(vertices, slower);
  if (one == nullptr || other == nullptr || !(one->smoothing.least > 0) || !(other->smoothing.least > 0)) {
    return std::nullopt;
  }
  Comparison comparison{faster, slower, vertices, ratio(other->smoothing, one->smoothing)};
  comparison.support = one->runs > 1 && other->runs > 1 ? support_of(comparison.factor, at_least) : Support::unknown;
  const auto published_one = published_ms(faster, vertices);
  const auto published_other = published_ms(slower, vertices);
  if (published_one && published_other) {
    comparison.published = *published_other / *published_one;
  }
  if (faster.form != slower.form) {
    comparison.sweeps = {one->sweeps, other->sweeps};
  }
  return comparison;
}

std::string range_of_published(const std::vector<Comparison>& comparisons) {
  std::vector<double> factors;
  for (const Comparison& comparison : comparisons) {
    if (comparison.published) {
      factors.push_back(*comparison.published);
    }
  }
  if (factors.empty()) {
    return {};
  }
  const Spread range(std::move(factors));
  return fmt::format("; in the paper {} ({} to {})", three_digits(range.median), three_digits(range.least),
                     three_digits(range.most));
}

}  // namespace

Support support_of(const Spread& factor, double at_least) {
  if (factor.least > at_least) {
    return Support::yes;
  }
  return factor.most < at_least ? Support::no : Support::within_spread;
}

std::vector<Comparison> compare_all(const ExperimentResult& result, const std::vector<Pair>& pairs, double at_least) {
  std::vector<Comparison> comparisons;
  for (const auto& [faster, slower] : pairs) {
    for (const std::int64_t size : result.options.sizes) {
      if (const auto comparison = compare(result, size, faster, slower, at_least)) {
        comparisons.push_back(*comparison);
      }
    }
  }
  return comparisons;
}

std::int64_t count_of(const std::vector<Comparison>& comparisons, Support support) {
  return std::ranges::count(comparisons, support, &Comparison::support);
}

Spread overall(const std::vector<Comparison>& comparisons) {
  std::vector<double> medians;
  double least = std::numeric_limits<double>::infinity();
  double most = 0;
  for (const Comparison& comparison : comparisons) {
    medians.push_back(comparison.factor.median);
    least = std::min(least, comparison.factor.least);
    most = std::max(most, comparison.factor.most);
  }
  return {Spread(std::move(medians)).median, least, most};
}

std::string tally(const std::vector<Comparison>& comparisons, std::string_view faster, std::string_view slower) {
  const Spread factor = overall(comparisons);
  std::string text = fmt::format("{} faster in {} of {} comparisons, {} in {}; {} within the spread", faster,
                                 count_of(comparisons, Support::yes), comparisons.size(), slower,
                                 count_of(comparisons, Support::no), count_of(comparisons, Support::within_spread));
  if (const std::int64_t unknown = count_of(comparisons, Support::unknown); unknown > 0) {
    text += fmt::format(", {} measured once only", unknown);
  }
  return text + fmt::format(". {} {} times as fast in the median, {} to {} over all runs{}.", faster,
                            three_digits(factor.median), three_digits(factor.least), three_digits(factor.most),
                            range_of_published(comparisons));
}

std::string by_size(const ExperimentResult& result, const std::vector<Comparison>& comparisons) {
  std::string text;
  for (const std::int64_t size : result.options.sizes) {
    std::vector<Comparison> here;
    std::ranges::copy_if(comparisons, std::back_inserter(here),
                         [&](const Comparison& comparison) { return comparison.vertices == size; });
    if (!here.empty()) {
      add_to_list(text, fmt::format("{}: {}", size_text(size), three_digits(overall(here).median)), "; ");
    }
  }
  return "The median of these factors by size: " + text + ".";
}

}  // namespace trismooth::experiments
