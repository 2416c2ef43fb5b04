// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/report/text_report.h"

#include <algorithm>
#include <sstream>
#include <string>

#include "trismooth/pipeline/stages/warnings.h"

#include "catch.h"
#include "sample_run.h"
#include "support/says.h"

namespace trismooth::text_report_test {

std::string text_report(const PipelineOptions& options, const PipelineResult& result) {
  return trismooth::text_report(options, result, TextDetail::summary);
}

std::string full_report(const PipelineOptions& options, const PipelineResult& result) {
  return trismooth::text_report(options, result, TextDetail::all);
}

TEST_CASE("the result of a smoothing says what was read, done and written") {
  const std::string text = text_report(sample::options(), sample::result());
  CAPTURE(text);
  CHECK(says(text, "input:      plate.vtk: 120 vertices, 210 triangles, 5 other cells, 2 components\n"));
  CHECK(says(text, "fixed:      40 of 120: 27 boundary, 11 interface ('mat_id'), 9 of other cells"));
  CHECK(says(text, "smoothing:  smart, form b, double precision, cpu with 2 threads: 24 ms\n"));
  CHECK(says(text, "result:     61 vertices moved in 3 sweeps, 2 put back; stopped by fixed point\n"));
  CHECK(says(text,
             "sizes:      0.5 to 2.25 times the area (98 % of elements), rms ln(A/A0) 0.125;\n"
             "            without 6 elements that were not valid before or after\n"));
  CHECK(says(text, "written:    out.vtk"));
  CHECK(text.back() == '\n');
}

TEST_CASE("of a call that was over before anybody was to sweep no number of threads is told") {
  auto result = sample::result();
  result.smoothing->threads = 0;
  CHECK(says(text_report(sample::options(), result), "smoothing:  smart, form b, double precision, cpu: 24 ms\n"));
}

TEST_CASE("all files that were written are told, of many the first") {
  auto result = sample::result();
  result.other_outputs = {"out.h5"};
  CHECK(says(text_report(sample::options(), result), "written:    out.vtk, out.h5\n"));
  result.other_outputs = {"0.vtu", "1.vtu", "2.vtu", "3.vtu", "4.vtu", "5.vtu", "6.vtu"};
  CHECK(says(text_report(sample::options(), result),
             "written:    out.vtk, 0.vtu, 1.vtu, 2.vtu, 3.vtu, 4.vtu and 2 more\n"));
}

TEST_CASE("values that stay where vertices moved are told once, with what moves them") {
  auto result = sample::result();
  result.kept_fields = {"T", "u"};
  CHECK(says(text_report(sample::options(), result),
             "fields:     'T', 'u' as read where vertices moved; --fields interpolate moves\n"));
  result.fields = {{"depth", 61}};
  CHECK(says(text_report(sample::options(), result),
             "fields:     'depth' interpolated at 61 vertices that moved\n"
             "            'T', 'u' as read where"));
  result.kept_fields = {"a", "b", "c", "d", "e", "f", "g"};
  CHECK(says(text_report(sample::options(), result), "'a', 'b', 'c', 'd', 'e' and 2 more as read"));
  result.smoothing->moved_vertices = 0;
  CHECK_FALSE(says(text_report(sample::options(), result), "as read"));
}

TEST_CASE("other cells that are all lines are called so") {
  auto result = sample::result();
  result.input.lines = result.input.other_cells;
  const std::string text = text_report(sample::options(), result);
  CHECK(says(text, "210 triangles, 5 lines, 2 components\n"));
  CHECK(says(text, "9 of lines"));
}

TEST_CASE("the summary is a line for each step and a table of what decides, all else is in the full text") {
  const std::string text = text_report(sample::options(), sample::result());
  const std::string full = full_report(sample::options(), sample::result());
  CAPTURE(text, full);
  CHECK(std::ranges::count(text, '\n') <= 18);
  for (const char* words : {"shape ", "min_angle ", "max_angle ", "inverted "}) {
    CHECK(says(text, words));
    CHECK(says(full, words));
  }
  for (const char* words : {"aspect_ratio", "0.95 to 1.00", "centroid", "put back where", "no vertex moved any more"}) {
    CAPTURE(words);
    CHECK_FALSE(says(text, words));
    CHECK(says(full, words));
  }
  CHECK(says(full_report(sample::options(), sample::result()), "7 triangles are listed clockwise"));
}

TEST_CASE("no line of a report is wider than 80 columns, however large its numbers, but where a name is") {
  auto options = sample::cuda_options();
  auto result = sample::cuda_result();
  result.input.vertices = result.input.triangles = result.input.other_cells = 2'147'483'647;
  result.input.components = 1'000'000;
  result.input.reoriented_triangles = 1'000'000'000;
  result.input.fixed_vertices = result.input.free_vertices = 1'000'000'000;
  result.smoothing->moved_vertices = result.smoothing->reverted_vertices = result.smoothing->sweeps = 2'000'000'000;
  result.smoothing->device = "A GPU with a name that is as long as the names of GPUs with much memory are";
  result.smoothing->backend_note = "cudaErrorInsufficientDriver (CUDA driver version is insufficient for CUDA runtime)";
  result.before.inverted = result.after->inverted = 700'000'000;
  result.size_change = trismooth::SizeChange{15'827'882, 700'000'000, 1.2345678e+300, 1.2345678e-300, 1.2345678e+300};
  result.size_fit_before = result.size_fit_after = trismooth::SizeFit{1, 2, 1.2345678e+300};
  result.input.size_array = "target edge length";
  for (auto* const report : {&result.before, &*result.after}) {
    report->triangles = 715'827'882;
    report->shape_histogram.fill(715'827'882);
    report->worst = {{715'827'881, -1.2345678e-300, {-1.2345678e-300, -1.2345678e-300}, true}};
    for (auto& metric : report->metrics) {
      metric = {-1.2345678e-300, 1.2345678e+300, 1.2345678e+300, 1.2345678e+300, 0.12345};
    }
  }
  result.after->metrics[0].min = 5e-324;
  for (const std::string& text : {text_report(options, result), full_report(options, result)}) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      CAPTURE(line);
      CHECK(line.size() <= 80);
    }
  }
}

TEST_CASE("how sizes changed is told where vertices moved") {
  auto result = sample::result();
  result.size_change = trismooth::SizeChange{210, 0, 0.01, 0.9, 1.1};
  CHECK(says(text_report(sample::options(), result),
             "sizes:      0.9 to 1.1 times the area (98 % of elements), rms ln(A/A0) 0.01\n"));
  result.input.size_array = "h";
  result.size_fit_before = trismooth::SizeFit{210, 0, 1.23456};
  result.size_fit_after = trismooth::SizeFit{210, 0, 0.5};
  CHECK(says(text_report(sample::options(), result),
             "            off edge lengths 'h' of points: rms ln(A/A*) 1.23 before, 0.5 now\n"));
  result.size_change->triangles = 0;
  CHECK(says(text_report(sample::options(), result), "sizes:      no element was valid before and is now\n"));
  result.smoothing->moved_vertices = 0;
  CHECK_FALSE(says(text_report(sample::options(), result), "sizes:"));
  CHECK_FALSE(says(text_report(sample::options(), result), "off those"));
  CHECK_FALSE(says(text_report(sample::options(), sample::quality_result()), "sizes:"));
}

TEST_CASE("the result of a run on a device says how it ran, and whether another run gives the same") {
  auto result = sample::cuda_result();
  const std::string text = full_report(sample::cuda_options(), result);
  CAPTURE(text);
  CHECK(says(text, "smart, form b, double precision, cuda: 24 ms\n"));
  CHECK(says(text,
             "device:     A <fast> GPU, cdp execution, soa layout; launches: 14 by the host,\n"
             "            120 by the device; 1.50 MiB of its memory\n"));
  for (const std::string& any : {text, text_report(sample::cuda_options(), result)}) {
    CHECK(says(any, "order:      unordered: "));
    CHECK(says(any, "; another\n            run gives another result"));
  }
  result.smoothing->reproducible = true;
  result.smoothing->child_launches = 0;
  const std::string ordered = full_report(sample::options(), result);
  CAPTURE(ordered);
  CHECK(says(ordered, "resident execution, aos layout; launches: 14 by the\n            host; "));
  CHECK_FALSE(says(ordered, "another run"));
}

TEST_CASE("the text says what untangling did, and nothing where it was not asked for") {
  const std::string text = text_report(sample::options(), sample::untangled_result());
  CAPTURE(text);
  CHECK(says(text,
             "untangling: 12 triangles not valid before, 4 after it, 3 in the result; 2 more\n"
             "            have fixed vertices alone; 1 component turned over\n"));
  CHECK_FALSE(says(full_report(sample::options(), sample::result()), "untangling"));
  trismooth::PipelineResult nothing_inverted = sample::untangled_result();
  nothing_inverted.smoothing->untangling = trismooth::UntanglingResult{};
  CHECK_FALSE(says(text_report(sample::options(), nothing_inverted), "untangling"));
  CHECK(says(full_report(sample::options(), nothing_inverted), "untangling: every triangle was valid\n"));
}

TEST_CASE("why the CPU smoothed stands below who smoothed, where there is something to say") {
  auto result = sample::result();
  CHECK_FALSE(says(text_report(sample::options(), result), "device:"));
  result.smoothing->backend_note = "no CUDA device: cudaErrorNoDevice";
  CHECK(says(text_report(sample::options(), result),
             "cpu with 2 threads: 24 ms\n            no CUDA device: cudaErrorNoDevice\nresult: "));
}

TEST_CASE("the result of a check speaks of no smoothing") {
  auto options = sample::options();
  options.output.reset();
  const std::string text = text_report(options, sample::quality_result());
  CAPTURE(text);
  CHECK(says(text, "120 vertices"));
  CHECK_FALSE(says(text, "smoothing:"));
  CHECK_FALSE(says(text, "written:"));
  CHECK_FALSE(says(text, "nothing"));
}

TEST_CASE("what holds vertices is named") {
  auto result = sample::result();
  result.input.fixed_array = "anchors";
  result.input.fixed_array_vertices = 13;
  result.input.fixed_ids = "ids.txt";
  result.input.fixed_ids_vertices = 2;
  for (const std::string& text : {text_report(sample::options(), result), full_report(sample::options(), result)}) {
    for (const char* words : {"fixed:      40 of 120: ", "27 boundary", "11 interface ('mat_id')", "13 by the array",
                              "'anchors'", "2 by the file ids.txt"}) {
      CAPTURE(words);
      CHECK(says(text, words));
    }
  }
}

TEST_CASE("a check shows the quality of a few regions, and leaves many to --verbose") {
  auto result = sample::quality_result();
  result.region_names.assign(2, "7");
  result.regions_before.assign(2, {105, 0, 0.25, 0.5, 30});
  CHECK(says(text_report(sample::options(), result), "mean shape"));
  result.region_names.assign(200, "7");
  result.regions_before.assign(200, {105, 0, 0.25, 0.5, 30});
  CHECK_FALSE(says(text_report(sample::options(), result), "mean shape"));
}

TEST_CASE("a mesh that cannot be improved is told plainly, with the reason") {
  auto result = sample::result();
  result.smoothing->moved_vertices = 0;
  result.smoothing->reverted_vertices = 0;
  CHECK(says(text_report(sample::options(), result), "nothing moved: no vertex could be improved"));
  result.smoothing->reverted_vertices = 3;
  CHECK(says(text_report(sample::options(), result), "was taken back"));
  result.smoothing->sweeps = 0;
  result.smoothing->stop_reason = StopReason::quality_target;
  CHECK(says(text_report(sample::options(), result), "nothing moved: the mesh has the target quality already"));
  result.smoothing->stop_reason = StopReason::time_limit;
  CHECK(says(text_report(sample::options(), result), "nothing moved: there was no time for a sweep"));
  result.input.free_vertices = 0;
  CHECK(says(text_report(sample::options(), result), "nothing to smooth: every vertex is fixed"));
  result.input.triangles = 0;
  CHECK(says(text_report(sample::options(), result), "nothing to smooth: the mesh has no triangles"));
}

TEST_CASE("inverted triangles that remain are told, and those that went, too") {
  auto result = sample::result();
  CHECK_FALSE(says(text_report(sample::options(), result), "inverted triangle"));
  result.before.inverted = 5;
  CHECK(says(text_report(sample::options(), result), "No inverted triangles remain (5 before)."));
  result.after->inverted = 1;
  const auto warning = [&] {
    const auto warnings = trismooth::warnings_of_invalid(result);
    REQUIRE(warnings.size() == 1);
    return warnings.front();
  };
  CHECK(says(warning(), "1 inverted triangle remains (5 before); --untangle on mends what"));
  result.after->inverted = 2;
  CHECK(says(warning(), "2 inverted triangles remain (5 before); --untangle on"));
  result.smoothing->untangling = trismooth::UntanglingResult{};
  CHECK(says(warning(), "2 inverted triangles remain (5 before); what held vertices fold"));
  result.smoothing->stop_reason = StopReason::time_limit;
  result.smoothing->sweeps = 0;
  CHECK(
      says(warning(), "2 inverted triangles remain (5 before); there was no time to mend them all: give --time-limit"));
  result.smoothing->untangling.reset();
  CHECK(
      says(warning(), "2 inverted triangles remain (5 before); there was no time to mend them all: give --time-limit"));
}

TEST_CASE("a time has the digits that matter") {
  CHECK(duration_text(0) == "0.00 ms");
  CHECK(duration_text(0.423) == "0.42 ms");
  CHECK(duration_text(12.7) == "13 ms");
  CHECK(duration_text(999.7) == "1.0 s");
  CHECK(duration_text(61234) == "61.2 s");
}

}  // namespace trismooth::text_report_test
