#include "trismooth/pipeline/text_report.h"

#include <string>

#include "catch.h"
#include "sample_run.h"

using trismooth::duration_text;
using trismooth::text_report;

namespace {

bool says(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("the result of a smoothing says what was read, done and written") {
  const std::string text = text_report(sample::options(), sample::result());
  CAPTURE(text);
  CHECK(says(text, "plate.vtk: 120 vertices, 210 triangles, 5 other cells, 2 components"));
  CHECK(says(text, "3 by the cell array 'mat_id'"));
  CHECK(says(text, "40 fixed, 80 free"));
  CHECK(says(text, "smart, form b, double precision, cpu with 2 threads"));
  CHECK(says(text, "fixed_point after 3 sweeps"));
  CHECK(says(text, "61 vertices moved, 2 put back"));
  CHECK(says(text, "written:    out.vtk"));
  CHECK(text.back() == '\n');
}

TEST_CASE("the result of a run on a device says how it ran, and whether another run gives the same") {
  auto result = sample::cuda_result();
  const std::string text = text_report(sample::cuda_options(), result);
  CAPTURE(text);
  CHECK(says(text, "smart, form b, double precision, cuda\n"));
  CHECK(says(text,
             "device:     A <fast> GPU, cdp execution, soa layout; launches: 14 by the host, 120 by the device; "
             "1.50 MiB of its memory\n"));
  CHECK(says(text, "order:      unordered: "));
  CHECK(says(text, "another run gives another result"));
  result.smoothing->reproducible = true;
  result.smoothing->child_launches = 0;
  const std::string ordered = text_report(sample::options(), result);
  CAPTURE(ordered);
  CHECK(says(ordered, "resident execution, aos layout; launches: 14 by the host; "));
  CHECK_FALSE(says(ordered, "another run"));
}

TEST_CASE("why the CPU smoothed stands below who smoothed, where there is something to say") {
  auto result = sample::result();
  CHECK_FALSE(says(text_report(sample::options(), result), "device:"));
  result.smoothing->backend_note = "no CUDA device: cudaErrorNoDevice";
  CHECK(says(text_report(sample::options(), result),
             "cpu with 2 threads\n            no CUDA device: cudaErrorNoDevice\nstopped: "));
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
  CHECK(says(text_report(sample::options(), result), "40 of 120: 27 boundary, 11 interface ('mat_id')"));
  result.input.fixed_array = "anchors";
  result.input.fixed_array_vertices = 3;
  CHECK(says(text_report(sample::options(), result), "3 by the array 'anchors'"));
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
  CHECK(says(text_report(sample::options(), result), "1 inverted triangle remains (5 before)."));
  result.after->inverted = 2;
  CHECK(says(text_report(sample::options(), result), "2 inverted triangles remain (5 before)."));
}

TEST_CASE("an amount of memory has the digits that matter") {
  CHECK(trismooth::bytes_text(0) == "0.00 MiB");
  CHECK(trismooth::bytes_text(262144) == "0.25 MiB");
  CHECK(trismooth::bytes_text(std::int64_t{213} << 20) == "213 MiB");
  CHECK(trismooth::bytes_text((std::int64_t{139} << 30) + (std::int64_t{1} << 29)) == "139.5 GiB");
}

TEST_CASE("a time has the digits that matter") {
  CHECK(duration_text(0) == "0.00 ms");
  CHECK(duration_text(0.423) == "0.42 ms");
  CHECK(duration_text(12.7) == "13 ms");
  CHECK(duration_text(999.7) == "1.0 s");
  CHECK(duration_text(61234) == "61.2 s");
}
