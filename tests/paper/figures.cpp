// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/paper/figures.h"

#include <string>
#include <vector>

#include "catch.h"
#include "sample_experiment.h"
#include "support/parsed_page.h"

using pages::count_of;
using sample::ExperimentResult;
using sample::Version;
using trismooth::experiments::forms_figure;
using trismooth::experiments::speedup_figure;

TEST_CASE("the figure of forms has every version in both forms in each layout's panel, and the paper's") {
  const std::string figure = forms_figure(sample::experiment({1'000, 5'000}, &sample::regular_time));
  const pages::Parsed parsed = pages::parse(figure);
  CHECK(parsed.error.empty());
  CHECK(parsed.says("(a) AoS"));
  CHECK(parsed.says("(b) SoA"));
  for (const char* form : {"A", "B"}) {
    for (const char* version :
         {"serial CPU", "optimised CPU", "GPU version", "CDP version", "resident version", "paper: GPU version"}) {
      CAPTURE(version, form);
      CHECK(parsed.says(std::string(version) + ", Form " + form));
    }
  }
  // The tooltips hold the numbers: SoA takes longer on a device, and the CPU has one layout.
  CHECK(count_of(figure, "GPU version, Form A, 5K: 80.0 (70.0-90.0)") == 1);
  CHECK(count_of(figure, "GPU version, Form A, 5K: 100 (88-112)") == 1);
  CHECK(count_of(figure, "serial CPU, Form A, 5K: 400 (350-450)") == 2);
}

TEST_CASE("Form B of the paper's versions is its own, unordered") {
  const ExperimentResult result = sample::experiment({1'000}, [](std::int64_t size, const sample::Case& what) {
    return what.order == sample::Order::unordered ? sample::exactly(7) : *sample::regular_time(size, what);
  });
  CHECK(count_of(forms_figure(result), "GPU version, Form B, 1K: 7.00 (7.00-7.00)") == 2);
}

TEST_CASE("the figure of speedups has every version but the serial one, SoA first as in the paper") {
  const std::string figure = speedup_figure(sample::experiment({1'000, 5'000}, &sample::regular_time));
  const pages::Parsed parsed = pages::parse(figure);
  CHECK(parsed.error.empty());
  CHECK(figure.find("(a) SoA, Form A") < figure.find("(b) AoS, Form A"));
  CHECK_FALSE(parsed.says("serial CPU, 1K"));
  CHECK(count_of(figure, "CDP version, 5K: 10.0 (7.8-12.9)") == 1);
  CHECK(count_of(figure, "CDP version, 5K: 8.00 (6.22-10.29)") == 1);
  CHECK(count_of(figure, "paper: CDP version, 5K: 20.6") == 1);
}

TEST_CASE("what was not measured has no line, and sizes are in order whatever was asked for") {
  const std::string figure = forms_figure(sample::experiment({5'000, 1'000}, &sample::cpu_time));
  CHECK(count_of(figure, "resident version") == 0);
  CHECK(count_of(figure, "optimised CPU, Form A, 1K: 20.0") == 2);
  CHECK(figure.find("optimised CPU, Form A, 1K") < figure.find("optimised CPU, Form A, 5K"));
}

TEST_CASE("there is no figure where there is nothing to draw") {
  const ExperimentResult nothing =
      sample::experiment({1'000}, [](std::int64_t, const sample::Case&) { return std::optional<sample::Spread>{}; });
  CHECK(forms_figure(nothing).empty());
  CHECK(speedup_figure(nothing).empty());
}

TEST_CASE("a time of nothing has no place on a logarithmic axis, and leaves the rest standing") {
  const ExperimentResult result = sample::experiment({4, 1'000}, [](std::int64_t size, const sample::Case& what) {
    return size == 4 ? sample::exactly(0) : *sample::regular_time(size, what);
  });
  CHECK(count_of(forms_figure(result), ", 4: ") == 0);
  CHECK(count_of(forms_figure(result), "GPU version, Form A, 1K: ") > 0);
  CHECK(count_of(speedup_figure(result), ", 4: ") == 0);
}
