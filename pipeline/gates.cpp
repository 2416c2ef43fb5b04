// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/gates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "trismooth/base/text/list_text.h"
#include "trismooth/base/text/suggestion.h"
#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/pipeline/deformation.h"
#include "trismooth/quality/metrics.h"
#include "trismooth/quality/size_ratio.h"

namespace trismooth {

namespace {

constexpr std::array<std::pair<std::string_view, double MetricSummary::*>, 5> statistics{
    {{"min_", &MetricSummary::min},
     {"mean_", &MetricSummary::mean},
     {"max_", &MetricSummary::max},
     {"stddev_", &MetricSummary::stddev},
     {"acceptable_", &MetricSummary::acceptable_fraction}}};

constexpr std::string_view invalid_quadratic = "invalid_quadratic";
constexpr std::string_view crossings = "crossings";
constexpr std::string_view overlaps = "overlaps";

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t";
  const std::size_t begin = text.find_first_not_of(blanks);
  return begin == std::string_view::npos ? std::string_view{}
                                         : text.substr(begin, text.find_last_not_of(blanks) + 1 - begin);
}

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// The name of a kind of elements in gates of these alone.
constexpr std::array<std::pair<std::string_view, ElementKind>, 2> kinds{
    {{"triangle.", ElementKind::triangle}, {"quadrilateral.", ElementKind::quadrilateral}}};

/// What a report has of some elements by the name: of all of them, or of those of one kind.
template <class Quality>
std::optional<double> find_value_of(std::string_view name, const Quality& quality) {
  if (name == "inverted") {
    return static_cast<double>(quality.inverted);
  }
  if (name == "degenerate") {
    return static_cast<double>(quality.degenerate);
  }
  // The extreme angles of the mesh go by the metrics' own names: nobody means min_min_angle by another.
  if (name == info(Metric::min_angle).name) {
    return quality[Metric::min_angle].min;
  }
  if (name == info(Metric::max_angle).name) {
    return quality[Metric::max_angle].max;
  }
  for (const auto& [prefix, statistic] : statistics) {
    if (name.starts_with(prefix)) {
      if (const MetricInfo* const metric = find_metric(name.substr(prefix.size()))) {
        return quality[metric->metric].*statistic;
      }
    }
  }
  return std::nullopt;
}

/// The names of the statistics of these metrics.
template <class Metrics>
std::vector<std::string> statistics_of(const Metrics& metrics) {
  std::vector<std::string> names;
  for (const std::string_view metric : metrics) {
    for (const auto& [prefix, statistic] : statistics) {
      names.emplace_back(prefix).append(metric);
    }
  }
  return names;
}

std::vector<std::string> names_of_kind(ElementKind kind) {
  std::vector<std::string_view> metrics;
  std::ranges::transform(all_metrics(kind), std::back_inserter(metrics), &MetricInfo::name);
  std::vector<std::string> names = statistics_of(metrics);
  names.insert(names.end(), {"inverted", "degenerate", std::string(info(Metric::min_angle).name),
                             std::string(info(Metric::max_angle).name)});
  return names;
}

/// What the report has of one kind by the name; no number where it has no such elements. Nothing for a metric that they
/// have none of.
std::optional<double> find_value_of(std::string_view name, const QualityReport& report, ElementKind kind) {
  if (std::ranges::count(names_of_kind(kind), name) == 0) {
    return std::nullopt;
  }
  if (report.kinds.empty() && kind == ElementKind::triangle) {
    return find_value_of(name, report);
  }
  const auto found = std::ranges::find(report.kinds, kind, &KindQuality::kind);
  const std::optional<double> value = find_value_of(name, found == report.kinds.end() ? KindQuality{} : *found);
  return value && found == report.kinds.end() ? not_known : value;
}

std::optional<double> find_value(std::string_view name, const QualityReport& report,
                                 const std::optional<QuadraticQuality>& quadratic) {
  if (name == "triangles") {
    return static_cast<double>(report.triangles);
  }
  if (name == "quadrilaterals") {
    return static_cast<double>(report.quadrilaterals);
  }
  if (name == invalid_quadratic) {
    return quadratic ? static_cast<double>(quadratic->invalid) : 0;
  }
  for (const auto& [prefix, kind] : kinds) {
    if (name.starts_with(prefix)) {
      return find_value_of(name.substr(prefix.size()), report, kind);
    }
  }
  if (name == size_ratio_info.name) {
    return report.size_ratio ? report.size_ratio->max : not_known;
  }
  for (const auto& [prefix, statistic] : statistics) {
    if (name.starts_with(prefix) && name.substr(prefix.size()) == size_ratio_info.name) {
      return report.size_ratio ? *report.size_ratio.*statistic : not_known;
    }
  }
  return find_value_of(name, report);
}

bool holds(double value, Comparison comparison, double bound) {
  switch (comparison) {
    case Comparison::at_least:
      return value >= bound;
    case Comparison::at_most:
      return value <= bound;
    case Comparison::above:
      return value > bound;
    case Comparison::below:
      return value < bound;
    case Comparison::equal:
      break;
  }
  return value == bound;
}

bool is_count(double value) {
  return value == std::trunc(value) && std::abs(value) < 1e15;
}

/// Counts in full, never as 1e+07; other numbers as short as their value allows.
std::string number(double value) {
  if (is_count(value)) {
    return fmt::format("{:.0f}", value);
  }
  std::string text;
  append_number(text, value);
  return text;
}

}  // namespace

std::vector<std::string> gate_names() {
  std::vector<std::string> names{"triangles",
                                 "quadrilaterals",
                                 "inverted",
                                 "degenerate",
                                 std::string(invalid_quadratic),
                                 std::string(crossings),
                                 std::string(overlaps),
                                 std::string(info(Metric::min_angle).name),
                                 std::string(info(Metric::max_angle).name),
                                 std::string(size_ratio_info.name)};
  std::vector<std::string_view> metrics;
  std::ranges::transform(metrics_of_any_kind(), std::back_inserter(metrics), &MetricInfo::name);
  metrics.push_back(size_ratio_info.name);
  std::ranges::move(statistics_of(metrics), std::back_inserter(names));
  for (const auto& [prefix, kind] : kinds) {
    for (const std::string& name : names_of_kind(kind)) {
      names.emplace_back(prefix).append(name);
    }
  }
  return names;
}

double gate_value(std::string_view name, const QualityReport& report, const std::optional<QuadraticQuality>& quadratic,
                  const DeformedStep* step) {
  if (name == crossings || name == overlaps) {
    return step == nullptr ? std::numeric_limits<double>::quiet_NaN()
                           : static_cast<double>(name == crossings ? step->crossings : step->overlaps);
  }
  if (const auto value = find_value(name, report, quadratic)) {
    return *value;
  }
  const std::string prefixes = list_text(statistics, [](const auto& statistic) { return statistic.first; });
  throw std::invalid_argument(fmt::format(
      "unknown metric '{}'; valid are triangles, quadrilaterals, inverted, degenerate, {}, {}, {}, min_angle, "
      "max_angle, {}, and one of {} before one of {}, {}; 'triangle.' or 'quadrilateral.' before inverted, degenerate, "
      "an angle or a metric takes those alone{}",
      name, invalid_quadratic, crossings, overlaps, size_ratio_info.name, prefixes,
      list_text(metrics_of_any_kind(), [](const MetricInfo* metric) { return metric->name; }), size_ratio_info.name,
      did_you_mean(name, gate_names())));
}

bool needs_size_ratio(const Gate& gate) {
  return std::string_view(gate.name).ends_with(size_ratio_info.name);
}

Gate parse_gate(std::string_view text) {
  const std::size_t begin = text.find_first_of("<>=");
  const std::size_t end = std::min(text.size(), text.find_first_not_of("<>=", begin));
  if (begin == std::string_view::npos) {
    throw std::invalid_argument(fmt::format("expected NAME>=VALUE (or {}), got '{}'", valid_texts<Comparison>(), text));
  }
  Gate gate;
  gate.name = trimmed(text.substr(0, begin));
  gate_value(gate.name, {});
  gate.comparison = parse_enum<Comparison>(text.substr(begin, end - begin));
  const std::string_view bound = trimmed(text.substr(end));
  const auto value = parse_number<double>(bound);
  if (!value || !std::isfinite(*value)) {
    throw std::invalid_argument(fmt::format("expected a number after '{}' in '{}'", to_string(gate.comparison), text));
  }
  gate.bound = *value;
  return gate;
}

GateOutcome check_gate(const Gate& gate, const QualityReport& report, const std::optional<QuadraticQuality>& quadratic,
                       const DeformedStep* step) {
  if (needs_size_ratio(gate) && !report.size_ratio) {
    throw std::invalid_argument(fmt::format(
        "gate {}: the report has no {}, which takes a while to find; PipelineOptions::size_ratio = true asks for it",
        gate_text(gate), size_ratio_info.name));
  }
  const double value = gate_value(gate.name, report, quadratic, step);
  return {gate, value, holds(value, gate.comparison, gate.bound)};
}

bool GateOutcome::is_worse_than(const GateOutcome& other) const {
  if (std::isnan(value) || std::isnan(other.value)) {
    return std::isnan(value) && !std::isnan(other.value);
  }
  switch (gate.comparison) {
    case Comparison::at_least:
    case Comparison::above:
      return value < other.value;
    case Comparison::at_most:
    case Comparison::below:
      return value > other.value;
    case Comparison::equal:
      break;
  }
  return std::abs(value - gate.bound) > std::abs(other.value - gate.bound);
}

std::string gate_text(const Gate& gate) {
  return fmt::format("{} {} {}", gate.name, to_string(gate.comparison), number(gate.bound));
}

std::string gate_value_text(const GateOutcome& outcome) {
  if (std::isnan(outcome.value)) {
    return "not defined";
  }
  // Rounded, it must neither meet the bound nor pass it.
  const std::string rounded = fmt::format("{:.4g}", outcome.value);
  const double shown = parse_number<double>(rounded).value();
  const bool says_the_same =
      shown != outcome.gate.bound && holds(shown, outcome.gate.comparison, outcome.gate.bound) == outcome.passed;
  return is_count(outcome.value) || !says_the_same ? number(outcome.value) : rounded;
}

std::string gate_failure(const GateOutcome& outcome) {
  const bool is_of_followers = outcome.gate.name == crossings || outcome.gate.name == overlaps;
  return fmt::format("gate failed: {}, is {}{}", gate_text(outcome.gate), gate_value_text(outcome),
                     !std::isnan(outcome.value) ? ""
                     : is_of_followers          ? " here: trismooth deform alone counts them"
                                                : " for this mesh: none of its elements has it; leave the gate out");
}

}  // namespace trismooth
