// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "trismooth/paper/experiment_report.h"

#include "catch.h"
#include "sample_experiment.h"

using trismooth::experiments::make_report;
using trismooth::experiments::text_of;

namespace {

std::string text_with(const sample::Times& times) {
  return text_of(
      make_report(sample::experiment({1'000, 100'000}, times), "trismooth bench", "2026-01-02 03:04 UTC", ""));
}

bool has(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

/// The line that begins so, with single blanks.
std::string line(const std::string& text, const std::string& beginning, const std::string& after = "") {
  std::istringstream lines(text.substr(after.empty() ? 0 : text.find(after)));
  for (std::string one; std::getline(lines, one);) {
    std::string words;
    std::istringstream stream(one);
    for (std::string word; stream >> word;) {
      words += (words.empty() ? "" : " ") + word;
    }
    if (words.rfind(beginning, 0) == 0) {
      return words;
    }
  }
  return {};
}

}  // namespace

TEST_CASE("a mesh's table has every case with topology, transfer, smoothing, all together, sweeps and speedups") {
  const std::string text = text_with(&sample::regular_time);
  CHECK(line(text, "serial CPU A", "1K:") == "serial CPU A 80.0 (70.0-90.0) 80.2 (70.2-90.2)");
  CHECK(line(text, "GPU-SoA A", "1K:") == "GPU-SoA A 20.0 (17.5-22.5) 20.8 (18.2-23.2)");
  CHECK(line(text, "CDP-AoS B unordered", "1K:") == "CDP-AoS B unordered 4.00 (3.50-4.50) 4.75 (4.25-5.25)");
  CHECK(line(text, "resident B", "100K:") == "resident B 25.0 (21.9-28.1) 25.8 (22.6-28.9)");
  const std::string rest = text.substr(text.find("times faster"));
  CHECK(line(rest, "serial CPU A") == "serial CPU A 100 0.250 - 1.00 1.00");
  CHECK(line(rest, "GPU-SoA A") == "GPU-SoA A 100 0.250 0.500 4.00 3.87");
  CHECK(line(rest, "CDP-AoS B unordered") == "CDP-AoS B unordered 80 (75-85) 0.250 0.500 10.0 8.47");
  CHECK(line(rest.substr(rest.find("times faster", 1)), "resident B") == "resident B 50 0.250 0.500 160 155");
}

TEST_CASE("the paper's tables have the paper's own figures below those measured") {
  const std::string text = text_with(&sample::regular_time);
  CHECK(line(text, "1K here", "Table 1:") == "1K here 80.0 16.0 20.0 5.00 4.00");
  CHECK(line(text, "spread", "Table 1:") == "spread 70.0-90.0 14.0-18.0 17.5-22.5 3.89-6.43 3.11-5.14");
  CHECK(line(text, "paper", "Table 1:") == "paper 218 16.0 18.8 13.63 11.60");
  CHECK(line(text, "paper 26021", "Table 4:") == "paper 26021 750.2 801.7 34.69 32.46");
  CHECK(has(text, "Beyond the paper\n\nGPU version, Form B, in colour order\n"));
  CHECK(has(text, "GeForce GT640"));
}

TEST_CASE("every claim is there with its verdict and what it rests on") {
  const std::string text = text_with(&sample::regular_time);
  CHECK(has(text,
            "1. The GPU implementation is up to 44 times faster than the serial CPU version.\n   -> does not hold"));
  CHECK(has(text,
            "4. The version with CUDA dynamic parallelism is slightly faster than the one\n   without.\n   -> holds"));
}

TEST_CASE("without a device the text has the CPU's rows, and says what needs one") {
  const std::string text = text_with(&sample::cpu_time);
  CHECK(has(text, "GPU:        none used\n"));
  CHECK(line(text, "GPU-AoS").empty());
  CHECK(line(text, "1K here", "Table 3:") == "1K here 80.0 - - - -");
  CHECK_FALSE(has(text, "Beyond the paper"));
  CHECK(has(text, "Not measured, for they need a CUDA device: GPU-AoS"));
}

TEST_CASE("what was not asked for leaves no empty headings") {
  const auto text_of_versions = [](const std::vector<sample::Version>& versions) {
    return text_of(make_report(sample::experiment({1'000}, &sample::cpu_time, versions), "", "", ""));
  };
  CHECK_FALSE(has(text_of_versions({sample::Version::cpu}), "The paper's tables"));
  CHECK_FALSE(has(text_of_versions({sample::Version::resident}), "Beyond the paper"));
  CHECK_FALSE(has(text_of_versions({sample::Version::gpu}), "topology"));
}

TEST_CASE("no line has more than 80 columns, however long it takes, and the text is ASCII and ends in a line feed") {
  const auto slow_time = [](std::int64_t vertices, const sample::Case& what) {
    const sample::Spread fast = *sample::regular_time(vertices, what);
    return std::optional(sample::Spread(fast.median * 90, fast.least * 90, fast.most * 90));
  };
  for (const std::string& text :
       {text_with(&sample::regular_time), text_with(slow_time), text_with(&sample::cpu_time)}) {
    CHECK(text.back() == '\n');
    CHECK(std::ranges::all_of(text, [](char c) { return c == '\n' || (c >= ' ' && c <= '~'); }));
    std::istringstream lines(text);
    for (std::string one; std::getline(lines, one);) {
      CAPTURE(one);
      CHECK(one.size() <= 80);
      CHECK((one.empty() || one.back() != ' '));
    }
  }
}
