// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/paper/experiment_report.h"

#include <algorithm>
#include <string>
#include <vector>

#include "catch.h"
#include "sample_experiment.h"

using sample::Case;
using sample::ExperimentResult;
using sample::Version;
using trismooth::experiments::ExperimentReport;
using trismooth::experiments::make_report;
using trismooth::experiments::remarks_on;
using trismooth::experiments::Row;

namespace {

ExperimentReport report_of(ExperimentResult result) {
  return make_report(std::move(result), "trismooth bench", "2026-01-02 03:04 UTC", "");
}

bool says(const std::vector<std::string>& remarks, const std::string& words) {
  return std::ranges::any_of(remarks,
                             [&](const std::string& remark) { return remark.find(words) != std::string::npos; });
}

}  // namespace

TEST_CASE("a report names the machine that was measured") {
  const ExperimentReport with = report_of(sample::experiment({1'000}, &sample::regular_time));
  CHECK(with.setting.gpu == "A <fast> GPU");
  CHECK(with.setting.threads == 4);
  CHECK_FALSE(with.setting.cpu.empty());
  CHECK(with.tables.size() == 8);
  CHECK(with.conclusions.size() == 4);
  CHECK(report_of(sample::experiment({1'000}, &sample::cpu_time)).setting.gpu.empty());
}

TEST_CASE("the remarks name each version that was not measured, once, and why") {
  const auto remarks = remarks_on(report_of(sample::experiment({1'000, 5'000}, &sample::cpu_time)));
  CHECK(says(remarks,
             "Not measured, for they need a CUDA device: GPU-AoS, GPU-SoA, CDP-AoS, CDP-SoA, resident "
             "(no device: for a <test>)."));
  CHECK_FALSE(says(remarks, "unordered"));
  CHECK_FALSE(says(remarks_on(report_of(sample::experiment({1'000}, &sample::regular_time))), "Not measured"));
}

TEST_CASE("the remarks name each case that failed, with its size") {
  ExperimentResult result = sample::experiment({1'000, 5'000}, &sample::regular_time);
  Row& row = result.rows.back();
  row.measured.reset();
  row.lack = trismooth::experiments::Lack::working_device;
  row.missing_reason = "cudaErrorMemoryAllocation";
  CHECK(says(remarks_on(report_of(result)), "Failed: 5K resident, Form B (cudaErrorMemoryAllocation)."));
  CHECK_FALSE(says(remarks_on(report_of(result)), "need a CUDA device"));
}

TEST_CASE("where nothing was measured the remarks say nothing of bits") {
  const auto remarks =
      remarks_on(report_of(sample::experiment({1'000}, &sample::cpu_time, {Version::gpu, Version::resident})));
  CHECK(remarks.size() == 1);
}

TEST_CASE("the remarks say whether the bits were the same, and that unordered ones differ") {
  ExperimentResult result = sample::experiment({1'000}, &sample::regular_time);
  CHECK(says(remarks_on(report_of(result)), "gave the same coordinates bit for bit"));
  CHECK(says(remarks_on(report_of(result)), "every run gives another result"));
  result.rows.back().measured->same_bits_as_first = false;
  CHECK(says(remarks_on(report_of(result)), "THESE GAVE OTHER BITS THAN THEY MUST: 1K resident, Form B."));
  CHECK_FALSE(says(remarks_on(report_of(result)), "gave the same coordinates"));
}

TEST_CASE("the remarks name what did not settle, what ran fewer times, and meshes of another size") {
  ExperimentResult result = sample::experiment({1'000}, &sample::regular_time);
  CHECK_FALSE(says(remarks_on(report_of(result)), "Never settled"));
  CHECK_FALSE(says(remarks_on(report_of(result)), "Fewer runs"));
  CHECK_FALSE(says(remarks_on(report_of(result)), "mirrored tiles"));
  result.rows[0].measured->stop_reason = trismooth::StopReason::sweep_limit;
  result.rows[1].measured->runs = 3;
  result.meshes[0].vertices = 1'024;
  const auto remarks = remarks_on(report_of(result));
  CHECK(says(remarks, "Never settled, 1000 sweeps are the limit: 1K serial CPU, Form A."));
  CHECK(says(remarks, "Fewer runs than 7, for want of time: 1K serial CPU, Form B (3)."));
  CHECK(says(remarks, "The mesh of 1K vertices is made of mirrored tiles and has 1,024."));
}
