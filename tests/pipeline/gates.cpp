// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/gates.h"

#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>

#include "trismooth/pipeline/deformation.h"
#include "trismooth/quality/metrics.h"

#include "catch.h"
#include "support/scratch_folder.h"

namespace trismooth::gates_test {

/// A report whose numbers are all different.
QualityReport distinct_report() {
  QualityReport report;
  report.triangles = 12345678;
  report.inverted = 3;
  report.degenerate = 4;
  double value = 1;
  for (auto& metric : report.metrics) {
    metric = {value + 0.1, value + 0.2, value + 0.3, value + 0.4, value + 0.5};
    value += 1;
  }
  return report;
}

bool passes(const std::string& gate, const QualityReport& report) {
  return check_gate(parse_gate(gate), report).passed;
}

std::string refusal_of(const std::string& gate) {
  return message_of<std::invalid_argument>([&] { parse_gate(gate); });
}

TEST_CASE("a gate is a name, a comparison and a number, with or without blanks") {
  for (const char* text : {"min_shape>=0.3", "min_shape >= 0.3", "  min_shape\t>=0.3 "}) {
    CAPTURE(text);
    const auto gate = parse_gate(text);
    CHECK(gate.name == "min_shape");
    CHECK(gate.comparison == Comparison::at_least);
    CHECK(gate.bound == 0.3);
  }
  CHECK(parse_gate("inverted==0").comparison == Comparison::equal);
  CHECK(parse_gate("max_angle<120").comparison == Comparison::below);
  CHECK(parse_gate("max_angle<=120").comparison == Comparison::at_most);
  CHECK(parse_gate("min_shape>-1e-3").comparison == Comparison::above);
  CHECK(parse_gate("min_shape>-1e-3").bound == -1e-3);
}

TEST_CASE("gates of the size ratio want a report that has it, and know the largest by its own name") {
  QualityReport report;
  for (const std::string gate : {"size_ratio<=2", "mean_size_ratio<=2", "acceptable_size_ratio>=0"}) {
    CHECK(needs_size_ratio(parse_gate(gate)));
    CHECK(
        message_of<std::invalid_argument>([&] { passes(gate, report); })
            .ends_with("the report has no size_ratio, which takes a while to find; PipelineOptions::size_ratio = true "
                       "asks for it"));
  }
  CHECK_FALSE(needs_size_ratio(parse_gate("max_edge_ratio<=2")));
  report.size_ratio = trismooth::MetricSummary{1, 1.5, 2, 0.25, 0.75};
  CHECK(passes("size_ratio<=2", report));
  CHECK_FALSE(passes("size_ratio<2", report));
  CHECK(passes("mean_size_ratio==1.5", report));
  CHECK(passes("acceptable_size_ratio==0.75", report));
}

TEST_CASE("text that is no gate is refused with what is expected") {
  for (const char* text : {"", "min_shape", "min_shape 0.3", ">=0.3", "min_shape>=", "min_shape>=x", "min_shape>=0.3x",
                           "min_shape>=nan", "min_shape>=inf", "min_shape>=0,3", "min_shape=0.3", "min_shape=>0.3",
                           "min_shape>=>=0.3", "min_shape>=0.3>=0.2"}) {
    CAPTURE(text);
    CHECK_THROWS_AS(parse_gate(text), std::invalid_argument);
  }
  CHECK(refusal_of("min_shape=0.3").find(">=, <=, >, <, ==") != std::string::npos);
  CHECK(refusal_of("min_shape").find("NAME>=VALUE") != std::string::npos);
}

TEST_CASE("an unknown name is answered with the valid ones") {
  for (const char* name : {"shape", "min_", "min_shapes", "median_shape", "Min_shape", "acceptable"}) {
    CAPTURE(name);
    const std::string message = refusal_of(std::string(name) + ">=1");
    CHECK(message.find("'" + std::string(name) + "'") != std::string::npos);
    for (const auto& metric : trismooth::all_metrics()) {
      CHECK(message.find(std::string(metric.name)) != std::string::npos);
    }
    for (const char* part : {"inverted", "degenerate", "triangles", "invalid_quadratic", "min_", "mean_", "max_",
                             "stddev_", "acceptable_"}) {
      CHECK(message.find(part) != std::string::npos);
    }
  }
}

TEST_CASE("a mesh without quadratic triangles has none that are invalid") {
  CHECK(check_gate(parse_gate("invalid_quadratic==0"), distinct_report()).passed);
  CHECK_FALSE(check_gate(parse_gate("invalid_quadratic == 0"), distinct_report(),
                         trismooth::QuadraticQuality{.elements = 2, .invalid = 1, .min_jacobian = -1})
                  .passed);
}

TEST_CASE("every name gives the number it says") {
  const QualityReport report = distinct_report();
  CHECK(gate_value("triangles", report) == 12345678);
  CHECK(gate_value("inverted", report) == 3);
  CHECK(gate_value("degenerate", report) == 4);
  CHECK(gate_value("invalid_quadratic", report,
                   trismooth::QuadraticQuality{.elements = 10, .invalid = 6, .min_jacobian = 0.5}) == 6);
  trismooth::DeformedStep step;
  step.crossings = 2;
  step.overlaps = 5;
  CHECK(gate_value("crossings", report, std::nullopt, &step) == 2);
  CHECK(gate_value("overlaps", report, std::nullopt, &step) == 5);
  CHECK(std::isnan(gate_value("overlaps", report)));
  for (const auto& metric : trismooth::all_metrics()) {
    const std::string name(metric.name);
    CAPTURE(name);
    CHECK(gate_value("min_" + name, report) == report[metric.metric].min);
    CHECK(gate_value("mean_" + name, report) == report[metric.metric].mean);
    CHECK(gate_value("max_" + name, report) == report[metric.metric].max);
    CHECK(gate_value("stddev_" + name, report) == report[metric.metric].stddev);
    CHECK(gate_value("acceptable_" + name, report) == report[metric.metric].acceptable_fraction);
  }
}

TEST_CASE("min_angle and max_angle are the extreme angles of the mesh") {
  const QualityReport report = distinct_report();
  CHECK(gate_value("min_angle", report) == report[Metric::min_angle].min);
  CHECK(gate_value("max_angle", report) == report[Metric::max_angle].max);
}

TEST_CASE("the list of names is complete, without repeats, and every one is taken") {
  const auto names = gate_names();
  // Five figures of each of twelve metrics, and of the size ratio; of each kind alone of its metrics (triangles have no
  // skew and no taper, quadrilaterals no radius ratio), and four more.
  CHECK(names.size() == 10 + 5 * (12 + 1) + (5 * 10 + 4) + (5 * 11 + 4));
  CHECK(std::set<std::string>(names.begin(), names.end()).size() == names.size());
  for (const std::string& name : names) {
    CAPTURE(name);
    CHECK_NOTHROW(parse_gate(name + ">=0"));
  }
}

TEST_CASE("comparisons hold at the bound as they say") {
  QualityReport report;
  report.inverted = 2;
  for (const auto& [gate, expected] : {std::pair{"inverted>=2", true},
                                       {"inverted>=3", false},
                                       {"inverted<=2", true},
                                       {"inverted<=1", false},
                                       {"inverted>1", true},
                                       {"inverted>2", false},
                                       {"inverted<3", true},
                                       {"inverted<2", false},
                                       {"inverted==2", true},
                                       {"inverted==2.5", false}}) {
    CAPTURE(gate);
    CHECK(passes(gate, report) == expected);
  }
}

TEST_CASE("a failed gate says what was demanded and what is") {
  QualityReport report;
  report[Metric::shape].min = 0.21343;
  CHECK(gate_failure(check_gate(parse_gate("min_shape >= 0.3"), report)) == "gate failed: min_shape >= 0.3, is 0.2134");
  report.inverted = 12345678;
  CHECK(gate_failure(check_gate(parse_gate("inverted==0"), report)) == "gate failed: inverted == 0, is 12345678");
  report[Metric::shape].min = 0.29999999;
  CHECK(gate_failure(check_gate(parse_gate("min_shape>=0.3"), report)) ==
        "gate failed: min_shape >= 0.3, is 0.29999999");
  report[Metric::min_angle].min = 3.3237965228831334;
  CHECK(gate_failure(check_gate(parse_gate("min_angle>=3.32395"), report)) ==
        "gate failed: min_angle >= 3.32395, is 3.3237965228831334");
  report[Metric::condition].max = std::numeric_limits<double>::infinity();
  CHECK(gate_failure(check_gate(parse_gate("max_condition<5"), report)) == "gate failed: max_condition < 5, is inf");
}

TEST_CASE("the outcome of a gate has what was demanded, what is, and whether it passed") {
  QualityReport report;
  report.degenerate = 2;
  const auto outcome = check_gate(parse_gate("degenerate==0"), report);
  CHECK(outcome.gate.name == "degenerate");
  CHECK(outcome.value == 2);
  CHECK_FALSE(outcome.passed);
  CHECK(gate_text(outcome.gate) == "degenerate == 0");
  CHECK(gate_value_text(outcome) == "2");
  CHECK(check_gate(parse_gate("degenerate<=2"), report).passed);
}

TEST_CASE("a value that is not a number meets no gate") {
  QualityReport report;
  report[Metric::shape].min = std::numeric_limits<double>::quiet_NaN();
  for (const char* gate : {"min_shape>=0", "min_shape<=0", "min_shape>0", "min_shape<0", "min_shape==0"}) {
    CAPTURE(gate);
    const auto outcome = check_gate(parse_gate(gate), report);
    CHECK_FALSE(outcome.passed);
    CHECK(gate_failure(outcome).find("is not defined for this mesh") != std::string::npos);
  }
}

TEST_CASE("an infinite value is compared as such") {
  QualityReport report;
  report[Metric::aspect_ratio].max = std::numeric_limits<double>::infinity();
  CHECK_FALSE(passes("max_aspect_ratio<=100", report));
  CHECK(passes("max_aspect_ratio>=100", report));
}

}  // namespace trismooth::gates_test
