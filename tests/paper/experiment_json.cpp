// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include <nlohmann/json.hpp>

#include "trismooth/paper/experiment_report.h"

#include "catch.h"
#include "sample_experiment.h"

using Json = nlohmann::json;
using trismooth::experiments::json_of;
using trismooth::experiments::make_report;

namespace {

Json json_with(const sample::Times& times) {
  return Json::parse(json_of(make_report(sample::experiment({1'000, 100'000}, times), "trismooth bench --runs 7",
                                         "2026-01-02 03:04 UTC", "CUDA: one\ndevice: two\n")));
}

}  // namespace

TEST_CASE("the JSON says what was run, where and when") {
  const Json json = json_with(&sample::regular_time);
  CHECK(json["command"] == "trismooth bench --runs 7");
  CHECK(json["date"] == "2026-01-02 03:04 UTC");
  CHECK(json["machine"]["gpu"] == "A <fast> GPU");
  CHECK(json["machine"]["threads"] == 4);
  CHECK(json["machine"]["cuda"] == Json{"CUDA: one", "device: two"});
  CHECK(json["options"]["sizes"] == Json{1'000, 100'000});
  CHECK(json["options"]["versions"] == Json{"serial", "cpu", "gpu", "cdp", "resident"});
  CHECK(json["options"]["precision"] == "single");
  CHECK(json["meshes"][1]["triangles"] == 200'000);
  CHECK(json["same_bits"] == true);
}

TEST_CASE("the JSON has every case on every mesh") {
  const Json json = json_with(&sample::regular_time);
  REQUIRE(json["rows"].size() == 36);
  const Json& row = json["rows"][5];
  CHECK(row["version"] == "gpu");
  CHECK(row["layout"] == "soa");
  CHECK(row["form"] == "a");
  CHECK(row["order"] == "colour");
  CHECK(row["size"] == 1'000);
  CHECK(row["missing_reason"].is_null());
  CHECK(row["measured"]["smoothing_ms"] == Json{{"median", 20.0}, {"least", 17.5}, {"most", 22.5}});
  CHECK(row["measured"]["transfer_ms"]["median"] == 0.5);
  CHECK(row["measured"]["topology_ms"]["median"] == 0.25);
  CHECK(row["measured"]["together_ms"]["median"] == 20.75);
  CHECK(row["measured"]["sweeps"]["median"] == 100.0);
  CHECK(row["measured"]["stop_reason"] == "tolerance");
  CHECK(row["measured"]["coordinates_hash"] == "0123456789abcdef");
  CHECK(row["speedup"]["median"] == 4.0);
  CHECK(json["rows"][0]["layout"].is_null());
}

TEST_CASE("the JSON has the tables beside the paper's, and the conclusions with their comparisons") {
  const Json json = json_with(&sample::regular_time);
  REQUIRE(json["tables"].size() == 8);
  CHECK(json["tables"][2]["table"] == 3);
  CHECK(json["tables"][2]["rows"][1]["paper"]["aos_speedup"] == 44.76);
  CHECK(json["tables"][2]["rows"][1]["aos_speedup"]["median"] == 10.0);
  CHECK(json["tables"][6]["table"].is_null());
  REQUIRE(json["conclusions"].size() == 4);
  CHECK(json["conclusions"][0]["verdict"] == "does not hold");
  CHECK(json["conclusions"][2]["comparisons"][0]["sweeps"]["claimed_slower"]["median"] == 100.0);
  CHECK(json["conclusions"][1]["comparisons"][0]["claimed_slower"] ==
        Json{{"version", "gpu"}, {"layout", "soa"}, {"form", "a"}, {"order", "colour"}});
  CHECK(json["conclusions"][1]["comparisons"][0]["paper_factor"] == 18.8 / 16.0);
  CHECK(json["conclusions"][1]["comparisons"][0]["support"] == "within the spread");
}

TEST_CASE("what was not measured is null, with the reason") {
  const Json json = json_with(&sample::cpu_time);
  CHECK(json["machine"]["gpu"].is_null());
  CHECK(json["rows"][5]["measured"].is_null());
  CHECK(json["rows"][5]["missing_reason"] == "no device: for a <test>");
  CHECK(json["rows"][5]["speedup"].is_null());
  CHECK(json["tables"][0]["missing_reason"] == "no device: for a <test>");
  CHECK(json["tables"][0]["rows"][0]["aos_ms"].is_null());
  CHECK(json["conclusions"][1]["verdict"] == "not measured");
}
