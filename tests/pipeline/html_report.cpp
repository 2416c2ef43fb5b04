// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/report/html_report.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/pipeline/report/html_text.h"
#include "trismooth/pipeline/report/svg_charts.h"

#include "catch.h"
#include "sample_run.h"
#include "support/parsed_page.h"

namespace trismooth::html_report_test {

using pages::parse;
using pages::Parsed;

TEST_CASE("text is escaped for content and for attributes") {
  CHECK(escape_html("a < b && \"c\" > 'd'") == "a &lt; b &amp;&amp; &quot;c&quot; &gt; &#39;d&#39;");
  CHECK(escape_html("gr\xc3\xb6\xc3\x9f"
                    "e") ==
        "gr\xc3\xb6\xc3\x9f"
        "e");
  CHECK(escape_html(std::string("a\0b\x1b", 4)) ==
        "a\xef\xbf\xbd"
        "b\xef\xbf\xbd");
  // Control characters of two bytes, what turns the direction of the text around it, and bytes that are no UTF-8.
  for (const std::string bad :
       {"\xc2\x85", "\xe2\x80\xae", "\xe2\x81\xa6", "\xff", "\x7f", "\r", "\xef\xbf\xbe", "\xef\xbf\xbf"}) {
    CHECK(escape_html("a" + bad + "b") ==
          "a\xef\xbf\xbd"
          "b");
  }
}

TEST_CASE("the list of the worst elements says which of them no smoothing can change") {
  const auto count = [](const std::string& page) {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = page.find("all corners fixed", at)) != std::string::npos; ++at) {
      ++found;
    }
    return found;
  };
  trismooth::PipelineResult result = sample::result();
  CHECK(count(html_report(sample::options(), result)) == 2);
  result.before.worst[1].all_fixed = result.after->worst[1].all_fixed = false;
  CHECK(count(html_report(sample::options(), result)) == 0);
}

TEST_CASE("the list of the worst elements names their regions where there are two or more") {
  trismooth::PipelineResult result = sample::result();
  result.region_names = {"<steel> core", "air"};
  result.regions_before = result.regions_after = {{.triangles = 10}, {.triangles = 10}};
  result.before.worst = {{17, 0.1, {1.5, -2.5}, false, 1}};
  result.after->worst = {{4, 0.2, {3.25, 4.0}, true, 0}};
  const std::string page = html_report(sample::options(), result);
  const std::size_t table = page.find("<h2>Worst elements</h2>");
  REQUIRE(table != std::string::npos);
  const std::size_t of_first = page.find("1.5, -2.5", table);
  CHECK(page.find("<th>region</th>", table) < of_first);
  CHECK(page.find(">air<", of_first) < page.find("<h3>after</h3>", table));
  CHECK(page.find(">&lt;steel&gt; core<", page.find("3.25, 4", table)) != std::string::npos);
  result.region_names = {"air"};
  result.regions_before = result.regions_after = {};
  result.before.worst[0].region = result.after->worst[0].region = -1;
  CHECK(html_report(sample::options(), result).find("<th>region</th>", table) == std::string::npos);
}

TEST_CASE("the report of a smoothing is well-formed and has all its parts") {
  const Parsed page = parse(html_report(sample::options(), sample::result()));
  REQUIRE(page.error.empty());
  CHECK(page.count("figure") == 2);
  CHECK(page.count("title") >= 1);
  for (const char* words : {"plate.vtk", "out.vtk", "Smallest shape", "Worst elements", "Convergence", "Options",
                            "Time", "equiangle_skew", "0123456789abcdef", "fixed_point", "61 of 80 free vertices moved",
                            "0.5 to 2.25", "6 not valid before or after"}) {
    CAPTURE(words);
    CHECK(page.says(words));
  }
}

TEST_CASE("the report of a run on a device says how it ran, and whether another run gives the same") {
  auto result = sample::cuda_result();
  result.smoothing->backend_note = "a <b>note</b>";
  const Parsed page = parse(html_report(sample::cuda_options(), result));
  REQUIRE(page.error.empty());
  for (const char* words : {"cuda", "A <fast> GPU", "cdp", "soa", "unordered", "14 by the host, 120 by the device",
                            "1.50 MiB", "Not reproducible: ", "a <b>note</b>"}) {
    CAPTURE(words);
    CHECK(page.says(words));
  }
  const Parsed on_cpu = parse(html_report(sample::options(), sample::result()));
  for (const char* words : {"Not reproducible", "launches", "why this backend"}) {
    CAPTURE(words);
    CHECK_FALSE(on_cpu.says(words));
  }
}

TEST_CASE("the report says what untangling did") {
  const std::string page = html_report(sample::options(), sample::untangled_result(), sample::record());
  CHECK(page.find("4 after it, 3 in the result; 2 more have fixed vertices alone") != std::string::npos);
}

TEST_CASE("the report shows what steers the mean-ratio method where that ran, and else does not") {
  auto options = sample::options();
  CHECK_FALSE(parse(html_report(options, sample::result())).says("size weight"));
  options.smoothing.method = trismooth::Method::mean_ratio;
  CHECK(parse(html_report(options, sample::result())).says("by the mean shape"));
  options.smoothing.mean_ratio = {.size_weight = 0.375, .power = 7, .target = trismooth::TargetShape::input};
  options.size_array = "my <h>";
  auto result = sample::result();
  result.input.size_array = "My <H>";
  result.size_fit_before = trismooth::SizeFit{200, 3, 1.5};
  result.size_fit_after = trismooth::SizeFit{201, 2, 0.0625};
  const std::string html = html_report(options, result);
  const Parsed page = parse(html);
  REQUIRE(page.error.empty());
  for (const char* words : {"size weight", "0.375", "power", "target", "input-shape", "sizes by array", "my <h>",
                            "Sizes off those asked for", "0.0625", "by array My <H>"}) {
    CAPTURE(words);
    CHECK(page.says(words));
  }
  CHECK(html.find(">7</td>") != std::string::npos);
  CHECK_FALSE(page.says("by the mean shape"));
}

TEST_CASE("the report of a check is well-formed and speaks of no smoothing") {
  auto options = sample::options();
  options.output.reset();
  const Parsed page = parse(html_report(options, sample::quality_result()));
  REQUIRE(page.error.empty());
  CHECK(page.count("figure") == 1);
  CHECK_FALSE(page.says("Convergence"));
  CHECK_FALSE(page.says(", before"));
  CHECK_FALSE(page.says("Areas, after by before"));
}

TEST_CASE("the page fetches nothing and runs nothing") {
  const std::string html = html_report(sample::options(), sample::result());
  const Parsed page = parse(html);
  CHECK(page.links.empty());
  CHECK(page.count("script") == 0);
  CHECK(page.count("link") == 0);
  for (const char* fetch : {"url(", "@import", "http:", "https:"}) {
    CAPTURE(fetch);
    CHECK(html.find(fetch) == std::string::npos);
  }
}

TEST_CASE("names from the run cannot break out of the page") {
  auto options = sample::options();
  options.output = "</code><script>alert(1)</script>.vtk";
  options.fixed_array = "<i>array</i>";
  options.fixed_ids = "ids & \"more\".txt";
  auto result = sample::result();
  result.input.path = "\"><script>alert('x')</script>.vtk";
  result.input.region_array = "<b>region</b>";
  result.losses = {"the array <b>T</b> is not written"};
  const Parsed page = parse(html_report(options, result));
  REQUIRE(page.error.empty());
  CHECK(page.count("script") == 0);
  CHECK(page.count("b") == 0);
  CHECK(page.says("\"><script>alert('x')"));
  CHECK(page.says("<i>array</i>"));
  CHECK(page.says("a note with <b>markup</b> & an ampersand"));
  CHECK(page.says("the array <b>T</b> is not written"));
  CHECK(page.says("A <fast> processor"));
}

TEST_CASE("a mesh without triangles has a report, too") {
  auto result = sample::result();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  trismooth::QualityReport empty;
  empty.metrics.fill({nan, nan, nan, nan, nan});
  result.before = empty;
  result.after = empty;
  result.smoothing->history.clear();
  const Parsed page = parse(html_report(sample::options(), result));
  REQUIRE(page.error.empty());
  CHECK(page.says("The mesh has no triangles."));
}

TEST_CASE("values that are not finite leave the page well-formed") {
  auto result = sample::result();
  const double infinity = std::numeric_limits<double>::infinity();
  result.before.metrics.fill({-infinity, std::numeric_limits<double>::quiet_NaN(), infinity, infinity, 0});
  CHECK(parse(html_report(sample::options(), result)).error.empty());
}

TEST_CASE("inverted triangles are said and drawn") {
  auto result = sample::result();
  result.before.inverted = 9;
  result.after->inverted = 4;
  const Parsed page = parse(html_report(sample::options(), result));
  REQUIRE(page.error.empty());
  CHECK(page.says("4 of 210 triangles are still inverted."));
  CHECK(page.says("inverted, before: 9"));
  CHECK(page.says("inverted, after: 4"));
}

TEST_CASE("degenerate triangles, gates, date and command line are said") {
  const Parsed page = parse(html_report(sample::options(), sample::result(), sample::record()));
  REQUIRE(page.error.empty());
  for (const char* words :
       {"6 triangles are without area.", "1 of 2 gates failed.", "min_shape >= 0.5", "0.35", "degenerate < 7", "passed",
        "failed", "2026-11-22T10:05:31+01:00", "trismooth smooth plate.vtk 'a <b>.vtk'"}) {
    CAPTURE(words);
    CHECK(page.says(words));
  }
  CHECK_FALSE(parse(html_report(sample::options(), sample::result())).says("gate"));
}

TEST_CASE("the histogram has a bar for every bin that is not empty") {
  trismooth::QualityReport report;
  report.triangles = 1000001;
  report.shape_histogram[3] = 1;
  report.shape_histogram[19] = 1000000;
  const Parsed chart = parse(trismooth::shape_histogram_svg(report, nullptr));
  REQUIRE(chart.error.empty());
  CHECK(chart.count("rect") == 2);
  CHECK(chart.says("0.15 to 0.20: 1"));
  CHECK(chart.says("0.95 to 1.00: 1,000,000"));
}

TEST_CASE("the histogram is logarithmic: one element is seen beside a million, and none is seen as none") {
  trismooth::QualityReport report;
  report.inverted = 1;
  for (std::size_t bin = 0; bin < 7; ++bin) {
    report.shape_histogram[bin] = static_cast<std::int64_t>(std::llround(std::pow(10, bin)));
  }
  const std::string svg = trismooth::shape_histogram_svg(report, nullptr);
  const std::regex bar_pattern(R"re(<rect [^>]* y="([\d.]+)"[^>]* height="([\d.]+)"><title>[^<]*: ([\d,]+)</title>)re");
  std::map<std::int64_t, double> heights;
  double bottom = 0;
  for (std::sregex_iterator bar(svg.begin(), svg.end(), bar_pattern), end; bar != end; ++bar) {
    std::string count = (*bar)[3];
    std::erase(count, ',');
    heights[std::stoll(count)] = std::stod((*bar)[2]);
    bottom = std::stod((*bar)[1]) + std::stod((*bar)[2]);
  }
  REQUIRE(heights.size() == 7);  // the bins without an element have no bar, the inverted one has that of 1
  CHECK(pages::count_of(svg, "<rect") == 8);
  CHECK(heights[1] >= 5);
  const double decade = heights[10] - heights[1];
  CHECK(decade > 15);
  for (std::int64_t count = 1; count < 1000000; count *= 10) {
    CHECK(std::abs(heights[10 * count] - heights[count] - decade) < 0.2);
  }
  // The axis says so: its labels stand at the heights of the bars of that many, and 0 at the foot of all.
  const std::regex label_pattern(R"re(<line class="grid"[^>]* y1="([\d.]+)"[^>]*/>\s*<text[^>]*>([\w.]+)</text>)re");
  std::map<std::string, double> labels;
  for (std::sregex_iterator label(svg.begin(), svg.end(), label_pattern), end; label != end; ++label) {
    labels[(*label)[2]] = bottom - std::stod((*label)[1]);
  }
  CHECK(labels["0"] == 0);
  for (const auto& [text, count] : {std::pair{"1", 1}, {"10", 10}, {"100", 100}, {"1K", 1000}, {"1M", 1000000}}) {
    CAPTURE(text);
    CHECK(std::abs(labels[text] - heights[count]) < 0.2);
  }
  CHECK(parse(svg).says("logarithmic"));
}

TEST_CASE("the convergence of any history can be drawn") {
  using History = std::vector<trismooth::SweepRecord>;
  History long_history;
  for (std::int64_t sweep = 1; sweep <= 100000; ++sweep) {
    long_history.push_back({sweep, 1000000, 2000000 / sweep, 0.1});
  }
  for (const History& history : {History{{1, 5, 0, 0}}, History{{1, 5, 1, 0.1}, {2, 1, 0, 0}}, long_history}) {
    CAPTURE(history.size());
    const std::string svg = trismooth::convergence_svg(history);
    const Parsed chart = parse(svg);
    CHECK(chart.error.empty());
    CHECK(chart.count("polyline") == 1);
    CHECK(svg.find("nan") == std::string::npos);
    CHECK(svg.find("inf") == std::string::npos);
    CHECK(svg.size() < 100000);
  }
}

}  // namespace trismooth::html_report_test
