// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/report/json_report.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "trismooth/version.h"

#include "catch.h"
#include "sample_run.h"

namespace trismooth::json_report_test {

using Json = nlohmann::ordered_json;

std::vector<std::string> keys_of(const Json& object) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) {
    keys.push_back(key);
  }
  return keys;
}

using Keys = std::vector<std::string>;

TEST_CASE("the keys of the JSON report are those of the contract, in their order") {
  const Json report = Json::parse(json_report(sample::options(), sample::result(), sample::record()));
  CHECK(keys_of(report) == Keys{"trismooth",
                                "date",
                                "command",
                                "input",
                                "options",
                                "before",
                                "after",
                                "size_change",
                                "size_array",
                                "size_fit",
                                "fields",
                                "kept_fields",
                                "areas",
                                "deformation",
                                "comparison",
                                "gates",
                                "smoothing",
                                "coordinates_hash",
                                "uncommitted_hash",
                                "warnings",
                                "timings_ms",
                                "peak_memory_bytes"});
  CHECK(keys_of(report["size_change"]) == Keys{"elements", "left_out", "rms_log_ratio", "ratio_p1", "ratio_p99"});
  CHECK(keys_of(report["gates"][1]) == Keys{"gate", "name", "comparison", "bound", "value", "passed"});
  CHECK(keys_of(report["input"]) == Keys{"path",
                                         "format",
                                         "vertices",
                                         "triangles",
                                         "quadrilaterals",
                                         "other_cells",
                                         "lines",
                                         "quadratic_triangles",
                                         "quadratic_quadrilaterals",
                                         "middle_nodes",
                                         "regions",
                                         "region_array",
                                         "components",
                                         "fixed_vertices",
                                         "free_vertices",
                                         "merged_vertices",
                                         "reoriented_triangles",
                                         "region_arrays",
                                         "fixed_array",
                                         "fixed_array_vertices",
                                         "fixed_ids_vertices",
                                         "point_sets",
                                         "cell_sets",
                                         "line_groups",
                                         "held"});
  CHECK(keys_of(report["input"]["held"]) == Keys{"boundary", "interface", "non_manifold", "bow_tie", "other_cells",
                                                 "unused", "named", "layers", "several"});
  CHECK(keys_of(report["input"]["region_arrays"][0]) == Keys{"name", "reason", "values", "held_vertices"});
  const Keys options = keys_of(report["options"]);
  for (const char* key :
       {"other_outputs", "method",  "form",       "layout",    "backend",    "execution",      "order", "topology",
        "precision",     "threads", "max_sweeps", "tolerance", "time_limit", "target_quality", "guard", "size_weight",
        "power",         "target",  "size_array", "untangle",  "fields",     "field_arrays"}) {
    CAPTURE(key);
    CHECK(std::find(options.begin(), options.end(), key) != options.end());
  }
  for (const char* side : {"before", "after"}) {
    CHECK(keys_of(report[side]) == Keys{"triangles", "quadrilaterals", "inverted", "degenerate", "metrics", "kinds",
                                        "histogram", "worst", "regions", "quadratic"});
    CHECK(keys_of(report[side]["metrics"]) == Keys{"shape", "area", "min_angle", "max_angle", "aspect_ratio",
                                                   "radius_ratio", "edge_ratio", "condition", "scaled_jacobian",
                                                   "equiangle_skew"});
    CHECK(keys_of(report[side]["metrics"]["shape"]) == Keys{"min", "mean", "max", "stddev", "acceptable_fraction"});
    CHECK(report[side]["histogram"]["shape"].size() == 20);
    CHECK(keys_of(report[side]["worst"][0]) == Keys{"cell", "shape", "centroid", "region", "all_fixed"});
  }
  CHECK(keys_of(report["smoothing"]) == Keys{"sweeps", "stop_reason", "vertex_updates", "moved_vertices",
                                             "reverted_vertices", "device", "topology", "backend_note", "reproducible",
                                             "kernel_launches", "child_launches", "device_memory_bytes", "guard_rounds",
                                             "untangling", "sliding", "history"});
  CHECK(keys_of(report["smoothing"]["history"][0]) ==
        Keys{"sweep", "evaluated", "moved", "max_relative_move", "min_shape"});
  CHECK(keys_of(report["timings_ms"]) == Keys{"read", "topology", "check_before", "transfer_in", "untangle", "smooth",
                                              "transfer_out", "commit", "fields", "check_after", "write", "total"});
}

TEST_CASE("the JSON report says what untangling did") {
  trismooth::PipelineOptions options = sample::options();
  options.smoothing.untangle = trismooth::Untangle::on;
  const Json report = Json::parse(json_report(options, sample::untangled_result()));
  CHECK(report["options"]["untangle"] == "on");
  CHECK(report["smoothing"]["untangling"] == Json{{"inverted_before", 12},
                                                  {"inverted_untangled", 4},
                                                  {"inverted_after", 3},
                                                  {"inverted_fixed", 2},
                                                  {"turned_components", 1}});
  CHECK(report["timings_ms"]["untangle"] == 10.5);
}

TEST_CASE("the JSON report has what steers the mean-ratio method, and null where another method ran") {
  auto options = sample::options();
  options.smoothing.mean_ratio = {.size_weight = 0.25, .power = 4, .target = trismooth::TargetShape::input};
  options.size_array = "h";
  const auto reported = [&] { return Json::parse(json_report(options, sample::result()))["options"]; };
  const Json of_smart = reported();
  for (const char* key : {"size_weight", "power", "target", "size_array"}) {
    CAPTURE(key);
    CHECK(of_smart[key].is_null());
  }
  options.smoothing.method = trismooth::Method::mean_ratio;
  const Json chosen = reported();
  CHECK(chosen["method"] == "mean-ratio");
  CHECK(chosen["size_weight"] == 0.25);
  CHECK(chosen["power"] == 4);
  CHECK(chosen["target"] == "input-shape");
  CHECK(chosen["size_array"] == "h");
  options.smoothing.mean_ratio = {};
  const Json defaults = reported();
  CHECK(defaults["size_weight"] == 1);
  CHECK(defaults["power"].is_null());
  CHECK(defaults["target"] == "uniform");
}

TEST_CASE("the JSON report says how far sizes are from those asked for") {
  auto result = sample::result();
  CHECK(Json::parse(json_report(sample::options(), result))["size_fit"].is_null());
  result.size_fit_before = trismooth::SizeFit{200, 3, 1.5};
  result.size_fit_after = trismooth::SizeFit{201, 2, 0.25};
  const Json fit = Json::parse(json_report(sample::options(), result))["size_fit"];
  CHECK(fit["before"] == Json{{"elements", 200}, {"left_out", 3}, {"rms_log_ratio", 1.5}});
  CHECK(fit["after"] == Json{{"elements", 201}, {"left_out", 2}, {"rms_log_ratio", 0.25}});
}

TEST_CASE("the JSON report says which array sizes were taken from, and what its values were read as") {
  auto result = sample::result();
  const auto reported = [&] { return Json::parse(json_report(sample::options(), result))["size_array"]; };
  CHECK(reported().is_null());
  result.input.size_array = "Edge length";
  CHECK(reported() == Json{{"name", "Edge length"}, {"values", "lengths_at_points"}});
  result.input.sizes_are_areas = true;
  CHECK(reported() == Json{{"name", "Edge length"}, {"values", "areas_of_cells"}});
}

TEST_CASE("the JSON report holds the run's values") {
  const Json report = Json::parse(json_report(sample::options(), sample::result()));
  CHECK(report["trismooth"] == std::string(trismooth::version()));
  CHECK(report["input"]["path"] == "plate.vtk");
  CHECK(report["input"]["format"] == "vtk");
  CHECK(report["input"]["vertices"] == 120);
  CHECK(report["input"]["triangles"] == 210);
  CHECK(report["input"]["other_cells"] == 5);
  CHECK(report["input"]["regions"] == 3);
  CHECK(report["input"]["region_array"] == "mat_id");
  CHECK(report["input"]["region_arrays"][0]["reason"] == "known_name");
  CHECK(report["input"]["region_arrays"][0]["held_vertices"] == 11);
  CHECK(report["input"]["held"]["boundary"] == 27);
  CHECK(report["input"]["held"]["several"] == 7);
  CHECK(report["input"]["fixed_array"].is_null());
  CHECK(report["input"]["components"] == 2);
  CHECK(report["input"]["fixed_vertices"] == 40);
  CHECK(report["input"]["free_vertices"] == 80);
  CHECK(report["input"]["reoriented_triangles"] == 7);
  CHECK(report["options"]["method"] == "smart");
  CHECK(report["options"]["form"] == "b");
  CHECK(report["options"]["backend"] == "cpu");
  CHECK(report["options"]["threads"] == 2);
  CHECK(report["options"]["tolerance"] == 1e-6);
  CHECK(report["before"]["metrics"]["area"]["mean"] == 1.2);
  CHECK(report["after"]["metrics"]["area"]["mean"] == 0.25 + 1 + 0.2);
  CHECK(report["after"]["histogram"]["shape"][19] == 20);
  CHECK(report["after"]["worst"][0]["cell"] == 17);
  CHECK(report["after"]["worst"][0]["centroid"] == Json::array({1.5, -2.5}));
  CHECK(report["after"]["worst"][0]["all_fixed"] == false);
  CHECK(report["after"]["worst"][1]["all_fixed"] == true);
  CHECK(report["size_change"]["elements"] == 204);
  CHECK(report["size_change"]["left_out"] == 6);
  CHECK(report["size_change"]["rms_log_ratio"] == 0.125);
  CHECK(report["size_change"]["ratio_p1"] == 0.5);
  CHECK(report["size_change"]["ratio_p99"] == 2.25);
  CHECK(report["smoothing"]["stop_reason"] == "fixed_point");
  CHECK(report["smoothing"]["backend_note"].is_null());
  CHECK(report["smoothing"]["reproducible"] == true);
  CHECK(report["smoothing"]["kernel_launches"] == 0);
  CHECK(report["smoothing"]["history"][1]["evaluated"] == 70);
  CHECK(report["smoothing"]["history"][1]["min_shape"] == 0.375);
  CHECK(report["coordinates_hash"] == "0123456789abcdef");
  CHECK(report["uncommitted_hash"] == "fedcba9876543210");
  CHECK(report["smoothing"]["untangling"].is_null());
  CHECK(report["options"]["untangle"] == "off");
  CHECK(report["timings_ms"]["read"] == 1.5);
  CHECK(report["timings_ms"]["write"] == 9.5);
  CHECK(report["timings_ms"]["total"] == 50);
  CHECK(report["peak_memory_bytes"] == 987654321);
}

TEST_CASE("the JSON report holds when and by what command, and how the gates went") {
  auto record = sample::record();
  record.gates.push_back({{"max_shape", trismooth::Comparison::equal, 1}, std::nan(""), false});
  const Json report = Json::parse(json_report(sample::options(), sample::result(), record));
  CHECK(report["date"] == "2026-11-22T10:05:31+01:00");
  CHECK(report["command"] == "trismooth smooth plate.vtk 'a <b>.vtk'");
  REQUIRE(report["gates"].size() == 3);
  CHECK(report["gates"][0]["gate"] == "min_shape >= 0.5");
  CHECK(report["gates"][0]["name"] == "min_shape");
  CHECK(report["gates"][0]["comparison"] == ">=");
  CHECK(report["gates"][0]["bound"] == 0.5);
  CHECK(report["gates"][0]["value"] == 0.35);
  CHECK(report["gates"][0]["passed"] == false);
  CHECK(report["gates"][1]["passed"] == true);
  CHECK(report["gates"][2]["value"].is_null());
  CHECK(report["before"]["degenerate"] == 6);
}

TEST_CASE("the JSON report has the quality of every region, by its value in the file") {
  auto result = sample::result();
  CHECK(Json::parse(json_report(sample::options(), result, sample::record()))["before"]["regions"].empty());
  result.region_names = {"3", "steel"};
  result.regions_before = {{100, 2, -0.25, 0.5, 12}, {110, 0, 0.125, 0.75, 20}};
  result.regions_after = {{100, 0, 0.25, 0.625, 22}, {110, 0, 0.375, 0.875, 30}};
  const Json report = Json::parse(json_report(sample::options(), result, sample::record()));
  CHECK(report["before"]["regions"][0] ==
        Json::parse(R"({"region": "3", "triangles": 100, "quadrilaterals": 0, "inverted": 2,
      "shape": {"min": -0.25, "mean": 0.5}, "min_angle": {"min": 12.0}})"));
  CHECK(report["after"]["regions"][1] ==
        Json::parse(R"({"region": "steel", "triangles": 110, "quadrilaterals": 0, "inverted": 0,
      "shape": {"min": 0.375, "mean": 0.875}, "min_angle": {"min": 30.0}})"));
}

TEST_CASE("the JSON report of a run on a device says how it ran") {
  auto result = sample::cuda_result();
  result.smoothing->backend_note = "a \"note\"";
  const Json report = Json::parse(json_report(sample::cuda_options(), result));
  CHECK(report["options"]["backend"] == "cuda");
  CHECK(report["options"]["execution"] == "cdp");
  CHECK(report["options"]["layout"] == "soa");
  CHECK(report["options"]["order"] == "unordered");
  CHECK(report["options"]["topology"] == "device");
  CHECK(report["smoothing"]["device"] == "A <fast> GPU");
  CHECK(report["smoothing"]["backend_note"] == "a \"note\"");
  CHECK(report["smoothing"]["reproducible"] == false);
  CHECK(report["smoothing"]["kernel_launches"] == 14);
  CHECK(report["smoothing"]["child_launches"] == 120);
  CHECK(report["smoothing"]["device_memory_bytes"] == 1572864);
}

TEST_CASE("a run that only checked has no after, no smoothing and no output to hash") {
  const Json report = Json::parse(json_report(sample::options(), sample::quality_result()));
  CHECK(report["after"].is_null());
  CHECK(report["smoothing"].is_null());
  CHECK(report["size_change"].is_null());
  CHECK(report["coordinates_hash"].is_null());
  CHECK(report["uncommitted_hash"].is_null());
  CHECK(report["before"]["triangles"] == 210);
}

TEST_CASE("what was not recorded, not set or is not finite is null") {
  auto result = sample::result();
  result.before[trismooth::Metric::aspect_ratio].max = std::numeric_limits<double>::infinity();
  result.before[trismooth::Metric::aspect_ratio].stddev = std::numeric_limits<double>::quiet_NaN();
  result.input.region_array.clear();
  result.size_change->rms_log_ratio = std::numeric_limits<double>::infinity();
  const Json report = Json::parse(json_report(sample::options(), result));
  CHECK(report["size_change"]["rms_log_ratio"].is_null());
  CHECK(report["before"]["metrics"]["aspect_ratio"]["max"].is_null());
  CHECK(report["before"]["metrics"]["aspect_ratio"]["stddev"].is_null());
  CHECK(report["smoothing"]["history"][2]["min_shape"].is_null());
  CHECK(report["options"]["time_limit"].is_null());
  CHECK(report["options"]["target_quality"].is_null());
  CHECK(report["input"]["region_array"].is_null());
}

TEST_CASE("numbers in the JSON report read back to the same bits") {
  auto result = sample::result();
  const std::vector<double> values{0.1,  1.0 / 3, 1e-308, 5e-324, std::nextafter(1.0, 2.0), 123456789.123456789,
                                   -0.0, 1e300};
  for (const double value : values) {
    result.before[trismooth::Metric::area].mean = value;
    const Json report = Json::parse(json_report(sample::options(), result));
    const double back = report["before"]["metrics"]["area"]["mean"].get<double>();
    CAPTURE(value);
    CHECK(back == value);
    CHECK(std::signbit(back) == std::signbit(value));
  }
}

TEST_CASE("any file name makes valid JSON") {
  for (const char* name : {"a \"quoted\" \\ name.off", "tab\tand\nline.off", "\xff\xfe not utf-8.off",
                           "gr\xc3\xb6\xc3\x9f"
                           "e.off"}) {
    auto result = sample::result();
    result.input.path = name;
    CAPTURE(name);
    CHECK_NOTHROW(Json::parse(json_report(sample::options(), result)));
  }
}

}  // namespace trismooth::json_report_test
