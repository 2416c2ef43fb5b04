// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/text/quality_table.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "catch.h"

namespace trismooth::quality_table_test {

/// A strip of triangles whose upper side is shifted by `shear`: the larger, the worse.
QualityReport strip_report(double shear, int triangle_pairs = 1000) {
  std::vector<Point2<double>> points;
  std::vector<Triangle> triangles;
  for (int i = 0; i <= triangle_pairs; ++i) {
    const double x = i;
    points.push_back({x, 0});
    points.push_back({x + shear + 0.0001 * i, 0.8});
  }
  for (int i = 0; i < triangle_pairs; ++i) {
    triangles.push_back({2 * i, 2 * i + 2, 2 * i + 1});
    triangles.push_back({2 * i + 2, 2 * i + 3, 2 * i + 1});
  }
  return quality_report({points, triangles, {}, 0});
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  return lines;
}

/// The words of the first line that begins with `label`.
std::vector<std::string> words_after(const std::string& text, const std::string& label) {
  for (const std::string& line : lines_of(text)) {
    if (line.starts_with(label + " ")) {
      std::istringstream stream(line.substr(label.size()));
      std::vector<std::string> words;
      for (std::string word; stream >> word;) {
        words.push_back(word);
      }
      return words;
    }
  }
  return {};
}

/// The words of the line behind the first one that begins with `label`.
std::vector<std::string> words_below(const std::string& text, const std::string& label) {
  const std::size_t begin = text.find('\n', text.find("\n" + label + " ") + 1) + 1;
  std::istringstream stream(text.substr(begin, text.find('\n', begin) - begin));
  return {std::istream_iterator<std::string>(stream), {}};
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_CASE("a table shows every metric once, in plain ASCII within 80 columns") {
  const QualityReport before = strip_report(2.5);
  const QualityReport after = strip_report(0.4);
  for (const std::string& table : {format_table(before), format_table(before, &after)}) {
    for (const MetricInfo& metric : all_metrics()) {
      CAPTURE(std::string(metric.name));
      CHECK(words_after(table, std::string(metric.name)).size() >= 5);
    }
    CHECK(table.back() == '\n');
    CHECK(std::all_of(table.begin(), table.end(), [](char c) { return c == '\n' || (c >= ' ' && c <= '~'); }));
    for (const std::string& line : lines_of(table)) {
      CAPTURE(line);
      CHECK(line.size() <= 80);
      CHECK((line.empty() || line.back() != ' '));
    }
  }
}

TEST_CASE("values stand as they are in the report") {
  QualityReport report = strip_report(0.4);
  report.triangles = 1234567;
  report.inverted = 12;
  report[Metric::shape] = {-0.25, 0.5, 0.75, 0.125, 0.5};
  report[Metric::area] = {1.25e-8, 2.5e12, std::numeric_limits<double>::infinity(), std::nan(""), 1};
  const std::string table = format_table(report);
  CHECK(words_after(table, "triangles") == std::vector<std::string>{"1,234,567"});
  CHECK(words_after(table, "inverted") == std::vector<std::string>{"12"});
  CHECK(words_after(table, "shape").front() == "-0.25000");
  CHECK(words_after(table, "shape")[4] == "50.00");
  CHECK(words_after(table, "area") ==
        std::vector<std::string>{"1.25e-08", "2.50e+12", "inf", "-", "100", "%", ">=", "0"});
}

TEST_CASE("a change of the worst element is never hidden by rounding") {
  const QualityReport before = strip_report(0.4);
  QualityReport after = before;
  for (const double step : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15}) {
    CAPTURE(step);
    after[Metric::shape].min = before[Metric::shape].min + step;
    after[Metric::max_angle].max = before[Metric::max_angle].max + 1000 * step;
    const std::string table = format_table(before, &after);
    const auto changed_by = [&](const std::string& metric) {
      const std::vector<std::string> words = words_below(table, metric);
      return std::stod(words[words.size() - 2]);
    };
    CHECK(changed_by("shape") == Approx(after[Metric::shape].min - before[Metric::shape].min).epsilon(0.06));
    CHECK(changed_by("max_angle") ==
          Approx(after[Metric::max_angle].max - before[Metric::max_angle].max).epsilon(0.06));
    CHECK(words_below(table, "shape").back() == "better");
    CHECK(words_below(table, "max_angle").back() == "worse");
  }
}

TEST_CASE("the short table has digits for a change down to 1e-9, and judges a smaller one as it shows it") {
  const QualityReport before = strip_report(0.4);
  QualityReport after = before;
  for (const double step : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15}) {
    CAPTURE(step);
    after[Metric::shape].min = before[Metric::shape].min + step;
    const std::vector<std::string> words = words_after(format_summary(before, after), "shape");
    const bool is_shown = words[0] != words[1];
    CHECK(is_shown == (step >= 1e-9));
    CHECK(words.back() == (is_shown ? "better" : "same"));
  }
}

TEST_CASE("the verdict compares the worst value and the mean") {
  const QualityReport before = strip_report(0.4);
  QualityReport after = before;
  const auto verdict = [&](Metric metric, const std::string& name, double min, double mean, double max) {
    after[metric].min = before[metric].min + min;
    after[metric].mean = before[metric].mean + mean;
    after[metric].max = before[metric].max + max;
    return words_below(format_table(before, &after), name).back();
  };
  CHECK(verdict(Metric::min_angle, "min_angle", 0, 0, 0) == "same");
  CHECK(verdict(Metric::min_angle, "min_angle", 1, 0, 0) == "better");
  CHECK(verdict(Metric::min_angle, "min_angle", 0, 1, 0) == "better");
  CHECK(verdict(Metric::min_angle, "min_angle", -1, 0, 0) == "worse");
  CHECK(verdict(Metric::min_angle, "min_angle", -1, 1, 0) == "mixed");
  CHECK(verdict(Metric::min_angle, "min_angle", 0, 0, -1) == "same");
  CHECK(verdict(Metric::min_angle, "min_angle", 0, -2e-9, 0) == "same");  // no table shows it
  CHECK(verdict(Metric::edge_ratio, "edge_ratio", 0, 0, 1) == "worse");
  CHECK(verdict(Metric::edge_ratio, "edge_ratio", 0, -0.01, -0.01) == "better");
}

TEST_CASE("100 per cent is said of all triangles only") {
  QualityReport report = strip_report(0.4);
  report[Metric::shape].acceptable_fraction = 0.9999999;
  report[Metric::min_angle].acceptable_fraction = 1e-9;
  report[Metric::max_angle].acceptable_fraction = 0;
  const std::string table = format_table(report);
  CHECK(words_after(table, "shape")[4] == "99.99");
  CHECK(words_after(table, "min_angle")[4] == "0.01");
  CHECK(words_after(table, "max_angle")[4] == "0");
}

TEST_CASE("the histogram shows every triangle, and a mark where there is at least one") {
  QualityReport report = strip_report(0.4);
  report.shape_histogram = {};
  report.shape_histogram[3] = 1;
  report.shape_histogram[19] = 1000000;
  report.inverted = 0;
  const std::string table = format_table(report);
  CHECK(words_after(table, "0.15 to 0.20") == std::vector<std::string>{"1", "."});
  CHECK(words_after(table, "0.50 to 0.55") == std::vector<std::string>{"0"});
  CHECK(words_after(table, "0.95 to 1.00") == std::vector<std::string>{"1,000,000", std::string(55, '#')});
  CHECK_FALSE(contains(table, "0.10 to 0.15"));
  CHECK_FALSE(contains(table, "below 0"));
  report.inverted = 500000;
  CHECK(words_after(format_table(report), "below 0") == std::vector<std::string>{"500,000", std::string(28, '#')});
}

TEST_CASE("reports with inverted triangles only, and with none at all") {
  QualityReport report = strip_report(0.4);
  report.shape_histogram = {};
  report.inverted = report.triangles;
  CHECK(words_after(format_table(report), "below 0").size() == 2);
  CHECK(format_table(QualityReport{}) == "triangles    0\ninverted     0\ndegenerate   0\n");
  const QualityReport empty;
  CHECK(contains(format_table(empty, &empty), "before"));
}

TEST_CASE("the worst elements are listed, and which of them no smoothing can change") {
  QualityReport before = strip_report(0.4);
  QualityReport after = before;
  before.worst = {{7, -0.5, {1, 2}}, {8, 0.25, {3, 4}}};
  after.worst = {{9, 0.125, {5, 6.5}}};
  const std::string table = format_table(before, &after);
  CHECK(contains(table, "7  -0.50000  (1, 2)\n"));
  CHECK(contains(table, "9  0.12500  (5, 6.5)\n"));
  CHECK(contains(table, "8   0.25000  (3, 4)\n"));
  CHECK_FALSE(contains(table, "all fixed"));
  after.worst[0].all_fixed = true;
  for (const std::string& marked : {format_table(before, &after), format_table(after)}) {
    CHECK(contains(marked, "9  0.12500  (5, 6.5)  all fixed\n"));
    CHECK(contains(marked, "all fixed: none of its corners may move, so no smoothing can change it\n"));
  }
  CHECK(contains(format_table(before, &after), "7  -0.50000  (1, 2)\n"));
  before.worst.clear();
  after.worst.clear();
  CHECK_FALSE(contains(format_table(before, &after), "centroid"));
}

TEST_CASE("the worst elements name their regions where names are told") {
  QualityReport report = strip_report(0.4);
  report.worst = {{7, 0.5, {1, 2}, true, 1}, {8, 0.75, {3, 4}, false, -1}, {9, 0.8, {5, 6}, false, 0}};
  const std::vector<std::string> names{"air", "steel"};
  const std::string table = format_table(report, nullptr, names);
  CHECK(contains(table, "element    shape  centroid  region\n"));
  CHECK(contains(table, "7  0.50000  (1, 2)    steel   all fixed\n"));
  CHECK(contains(table, "8  0.75000  (3, 4)\n"));
  CHECK(contains(table, "9  0.80000  (5, 6)    air\n"));
  CHECK_FALSE(contains(format_table(report), "steel"));
}

TEST_CASE("the summary has the worst value and the mean of shape and angles, and the inverted triangles") {
  QualityReport before = strip_report(2.5);
  QualityReport after = strip_report(0.4);
  before[Metric::shape].min = -0.25;
  after[Metric::shape].min = 0.125;
  before[Metric::shape].mean = 0.5;
  after[Metric::shape].mean = 0.75;
  before[Metric::max_angle] = {60, 70, 170, 1, 0.5};
  after[Metric::max_angle] = {60, 65, 160, 1, 0.5};
  before.inverted = 1234;
  const std::string summary = format_summary(before, after);
  using Words = std::vector<std::string>;
  CHECK(words_after(summary, "shape") == Words{"-0.25000", "0.12500", "0.50000", "0.75000", "better"});
  CHECK(words_after(summary, "max_angle") == Words{"170.000", "160.000", "70.000", "65.000", "better"});
  CHECK(words_after(summary, "inverted") == Words{"1,234", "0"});
  CHECK(lines_of(summary).size() == 6);
  before.degenerate = 5;
  CHECK(words_after(format_summary(before, after), "degenerate") == Words{"5", "0"});
  after[Metric::shape].min = before[Metric::shape].min + 1e-7;
  CHECK(words_after(format_summary(before, after), "shape")[0] !=
        words_after(format_summary(before, after), "shape")[1]);
}

TEST_CASE("a report prints itself as its table") {
  const QualityReport report = strip_report(0.4);
  std::ostringstream stream;
  stream << report;
  CHECK(stream.str() == format_table(report));
}

}  // namespace trismooth::quality_table_test
