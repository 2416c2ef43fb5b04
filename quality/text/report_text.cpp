// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/text/report_text.h"

#include <algorithm>
#include <cmath>

#include "trismooth/base/text/digits.h"

namespace trismooth {

int decimals(Metric metric) {
  switch (metric) {
    case Metric::min_angle:
    case Metric::max_angle:
      return 3;
    case Metric::shape:
    case Metric::scaled_jacobian:
    case Metric::equiangle_skew:
      return 5;
    default:
      return 4;
  }
}

std::string number_text(double value, int decimals, int more) {
  if (std::isnan(value)) {
    return "-";
  }
  if (value == 0 || std::isinf(value)) {
    return value == 0 ? "0" : shortest_digits(value);
  }
  const double magnitude = std::abs(value);
  if (magnitude < std::pow(10.0, 2 - decimals) || magnitude >= 1e4) {
    return scientific_digits(value, 2 + more);
  }
  const int places_before_point = magnitude < 10 ? 1 : magnitude < 100 ? 2 : magnitude < 1000 ? 3 : 4;
  return fixed_digits(value, std::min(decimals, 6 - places_before_point) + more);
}

TextPair distinct_texts(double before, double after, int decimals) {
  constexpr int most_more = 15;  // tells any two values apart
  TextPair texts{number_text(before, decimals), number_text(after, decimals)};
  for (int more = 1; more <= most_more && before != after && texts.before == texts.after; ++more) {
    texts = {number_text(before, decimals, more), number_text(after, decimals, more)};
  }
  return texts;
}

std::string count_text(std::int64_t count) {
  std::string text = std::to_string(count);
  for (auto place = static_cast<std::ptrdiff_t>(text.size()) - 3; place > 0; place -= 3) {
    text.insert(static_cast<std::size_t>(place), ",");
  }
  return text;
}

std::string size_text(std::int64_t vertices) {
  constexpr std::int64_t thousand = 1'000;
  constexpr std::int64_t million = thousand * thousand;
  if (vertices >= million && vertices % (million / 10) == 0) {
    return shortest_digits(static_cast<double>(vertices) / million) + "M";
  }
  if (vertices >= thousand && vertices % (thousand / 10) == 0) {
    return shortest_digits(static_cast<double>(vertices) / thousand) + "K";
  }
  return count_text(vertices);
}

std::string bytes_text(std::int64_t bytes) {
  constexpr double mebibyte = 1024.0 * 1024.0;
  constexpr double gibibyte = 1024.0 * mebibyte;
  const auto size = static_cast<double>(bytes);
  if (size >= gibibyte) {
    return fixed_digits(size / gibibyte, 1) + " GiB";
  }
  return size < 9.95 * mebibyte ? fixed_digits(size / mebibyte, 2) + " MiB" : fixed_digits(size / mebibyte, 0) + " MiB";
}

ElementWords element_words(std::int64_t triangles, std::int64_t quadrilaterals) {
  return quadrilaterals == 0 ? ElementWords{"triangle", "triangles"}
         : triangles == 0    ? ElementWords{"quadrilateral", "quadrilaterals"}
                             : ElementWords{"element", "elements"};
}

std::string percent_text(double fraction) {
  if (std::isnan(fraction)) {
    return "-";
  }
  if (fraction == 0 || fraction == 1) {
    return fraction == 0 ? "0" : "100";
  }
  return fixed_digits(std::clamp(std::floor(fraction * 1e4) / 100, 0.01, 99.99), 2);
}

double worst_of(Metric metric, const MetricSummary& summary) {
  return metrics_of_any_kind()[static_cast<std::size_t>(metric)]->larger_is_better ? summary.min : summary.max;
}

std::string_view verdict(Metric metric, const MetricSummary& before, const MetricSummary& after) {
  const bool larger_is_better = metrics_of_any_kind()[static_cast<std::size_t>(metric)]->larger_is_better;
  // The size of an element is not its quality, and condition jumps from infinity to its negative at inversion.
  const bool has_sign_jump = !larger_is_better && (before.min < 0 || after.min < 0);
  if (metric == Metric::area || has_sign_jump || std::isnan(before.mean) || std::isnan(after.mean)) {
    return "";
  }
  const auto improves = [larger_is_better](double from, double to) { return larger_is_better ? to > from : to < from; };
  // A mean whose change no table shows has none: "worse" beside equal numbers would only alarm. (Of the worst element
  // as many digits are shown as a change needs.)
  constexpr double shown = 1e-6;
  const bool mean_stays = std::abs(after.mean - before.mean) <= shown * std::abs(before.mean);
  const double mean_after = mean_stays ? before.mean : after.mean;
  const double worst_before = worst_of(metric, before);
  const double worst_after = worst_of(metric, after);
  const bool better = improves(worst_before, worst_after) || improves(before.mean, mean_after);
  const bool worse = improves(worst_after, worst_before) || improves(mean_after, before.mean);
  if (better && worse) {
    return "mixed";
  }
  return better ? "better" : worse ? "worse" : "same";
}

}  // namespace trismooth
