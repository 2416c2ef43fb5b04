// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "trismooth/quality/quality_report.h"

namespace trismooth {

/// Numbers as tables for people show them.

/// Decimals that suit the metric's values.
int decimals(Metric metric);

/// With `decimals`, at most six digits in all; scientific where fewer than three digits would show or the number is
/// large; "-" for NaN. `more` adds digits.
std::string number_text(double value, int decimals, int more = 0);

struct TextPair {
  std::string before;
  std::string after;
};

/// Two values in as many digits as it takes to tell them apart where they differ.
TextPair distinct_texts(double before, double after, int decimals);

/// 1234567 as 1,234,567.
std::string count_text(std::int64_t count);

/// A number of vertices: "1K", "50K", "1.5M"; "1,234" where that would not be exact.
std::string size_text(std::int64_t vertices);

/// "0.25 MiB", "213 MiB", "139.8 GiB": an amount of memory with the digits that matter.
std::string bytes_text(std::int64_t bytes);

/// What the elements of a mesh are called.
struct ElementWords {
  std::string_view one;
  std::string_view several;
};

/// "triangle" where there are no quadrilaterals, "quadrilateral" where there are no triangles, else "element".
ElementWords element_words(std::int64_t triangles, std::int64_t quadrilaterals);

/// A fraction in per cent without the sign, cut rather than rounded: 100 and 0 are said of all and of none only.
std::string percent_text(double fraction);

/// The end of the metric's range over the mesh that is the bad one.
double worst_of(Metric metric, const MetricSummary& summary);

/// "better" where of the worst value and the mean one improved and none got worse, "worse" for the opposite, "mixed",
/// "same"; empty where that cannot be said.
std::string_view verdict(Metric metric, const MetricSummary& before, const MetricSummary& after);

}  // namespace trismooth
