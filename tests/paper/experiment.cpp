// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/paper/experiment.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "trismooth/pipeline/coordinates_hash.h"
#include "trismooth/pipeline/generate/random_mesh.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/fake_backend.h"

using trismooth::CudaSupport;
using trismooth::Form;
using trismooth::Order;
using trismooth::Spread;
using trismooth::experiments::Case;
using trismooth::experiments::ExperimentOptions;
using trismooth::experiments::ExperimentProgress;
using trismooth::experiments::ExperimentResult;
using trismooth::experiments::Lack;
using trismooth::experiments::Measurement;
using trismooth::experiments::Row;
using trismooth::experiments::run_experiment;
using trismooth::experiments::Version;

namespace {

ExperimentOptions small() {
  ExperimentOptions options;
  options.sizes = {60, 200};
  options.runs = 2;
  return options;
}

CudaSupport device(const fakes::FakeBackend& backend) {
  return {&backend, true, [] { return std::string(); }, [] { return std::string(); }};
}

void check_order(const Spread& spread) {
  CHECK(spread.least >= 0);
  CHECK(spread.least <= spread.median);
  CHECK(spread.median <= spread.most);
}

}  // namespace

TEST_CASE("every case is measured on every mesh where there is a device") {
  const fakes::FakeBackend backend;
  const ExperimentResult result = run_experiment(small(), device(backend));
  REQUIRE(result.rows.size() == 36);
  CHECK(result.meshes.size() == 2);
  CHECK(result.meshes[1].vertices == 200);
  for (const Row& row : result.rows) {
    CAPTURE(row.vertices, name_of(row.what), form_of(row.what));
    CHECK(row.missing_reason.empty());
    CHECK(row.lack == Lack::nothing);
    REQUIRE(row.measured);
    const Measurement& measured = *row.measured;
    CHECK(measured.runs == 2);
    for (const Spread& spread :
         {measured.topology, measured.transfer, measured.smoothing, measured.together, measured.sweeps}) {
      check_order(spread);
    }
    CHECK(measured.smoothing.least > 0);
    CHECK(measured.together.most >= measured.smoothing.most);
    CHECK(measured.sweeps.least >= 1);
  }
  CHECK(result.same_bits());
  CHECK_FALSE(result.any_lack_of(Lack::working_device));
  // One run to warm up and two that count, of fourteen cases on two meshes.
  CHECK(backend.smoothed == 3 * 14 * 2);
}

TEST_CASE("what is measured is the smoothing of the generated mesh in single precision") {
  ExperimentOptions options = small();
  options.seed = 5;
  const ExperimentResult result = run_experiment(options, {});
  for (const Form form : {Form::swap, Form::in_place}) {
    const trismooth::RandomMesh mesh = trismooth::random_delaunay_mesh(200, 5);
    std::vector<double> xy(flat_points(mesh).begin(), flat_points(mesh).end());
    trismooth::SmoothingOptions smoothing;
    smoothing.form = form;
    smoothing.precision = trismooth::Precision::single_precision;
    const auto expected = trismooth::smooth(trismooth::xy_points(xy), flat_triangles(mesh), {}, smoothing);
    for (const Version version : {Version::serial, Version::cpu}) {
      const Measurement* const measured = result.find(200, {version, form});
      REQUIRE(measured != nullptr);
      CHECK(measured->sweeps.median == static_cast<double>(expected.sweeps));
      CHECK(measured->stop_reason == expected.stop_reason);
      CHECK(measured->coordinates_hash == trismooth::hash_text(trismooth::planar_coordinates_hash(xy)));
    }
  }
}

TEST_CASE("the serial version evaluates every vertex in every sweep, the optimised one fewer") {
  const ExperimentResult result = run_experiment(small(), {});
  const Measurement* const serial = result.find(200, {Version::serial, Form::swap});
  const Measurement* const optimised = result.find(200, {Version::cpu, Form::swap});
  CHECK(serial->vertex_updates == serial->free_vertices * static_cast<std::int64_t>(serial->sweeps.median));
  CHECK(optimised->vertex_updates < serial->vertex_updates);
  CHECK(serial->threads == 1);
}

TEST_CASE("without CUDA, a device or dynamic parallelism the cases that need it say so, and the others run") {
  const fakes::FakeBackend backend;
  ExperimentOptions no_device = small();
  no_device.no_device_reason = "cudaErrorNoDevice from a test";
  CudaSupport no_cdp = device(backend);
  no_cdp.has_cdp = false;
  const auto check = [](const ExperimentResult& result, const std::set<Version>& missing, const std::string& reason) {
    for (const Row& row : result.rows) {
      CAPTURE(name_of(row.what));
      CHECK(row.measured.has_value() == !missing.contains(row.what.version));
      CHECK(row.missing_reason == (missing.contains(row.what.version) ? reason : ""));
    }
    CHECK_FALSE(result.any_lack_of(Lack::working_device));
  };
  ExperimentOptions left_out = small();
  left_out.no_device_reason = "left out by a test";
  const std::set on_device{Version::gpu, Version::cdp, Version::resident};
  check(run_experiment(small(), {}), on_device, "this build has no CUDA");
  check(run_experiment(no_device, device(backend)), on_device, "cudaErrorNoDevice from a test");
  CHECK(backend.smoothed == 0);
  check(run_experiment(left_out, {}), on_device, "left out by a test");
  check(run_experiment(small(), no_cdp), {Version::cdp}, "this build has no dynamic parallelism");
}

TEST_CASE("a device that fails leaves the rest standing") {
  const fakes::FakeBackend backend(fakes::Failure::smooth);
  const ExperimentResult result = run_experiment(small(), device(backend));
  CHECK(result.any_lack_of(Lack::working_device));
  for (const Row& row : result.rows) {
    CHECK(row.measured.has_value() == !runs_on_device(row.what.version));
    CHECK((row.lack == Lack::working_device) == runs_on_device(row.what.version));
    CHECK((row.missing_reason.find("cudaErrorMemoryAllocation") != std::string::npos) ==
          runs_on_device(row.what.version));
  }
}

TEST_CASE("a lack of memory on the device's side of the work leaves the rest standing") {
  const fakes::FakeBackend backend(fakes::Failure::host_memory);
  const ExperimentResult result = run_experiment(small(), device(backend));
  CHECK(result.any_lack_of(Lack::memory));
  for (const Row& row : result.rows) {
    CHECK(row.measured.has_value() == !runs_on_device(row.what.version));
    CHECK(row.missing_reason == (runs_on_device(row.what.version) ? "not enough memory" : ""));
  }
}

TEST_CASE("where no case can run, no mesh is made") {
  ExperimentOptions options = small();
  options.versions = {Version::gpu};
  const ExperimentResult result = run_experiment(options, {});
  CHECK(result.meshes.empty());
  CHECK(result.rows.size() == 2 * 6);
}

TEST_CASE("a mesh without free vertices takes no time, and has no speedup") {
  const fakes::FakeBackend backend(fakes::Failure::no_time);
  ExperimentOptions options = small();
  options.sizes = {4};
  const ExperimentResult result = run_experiment(options, device(backend));
  const Case resident{Version::resident, Form::swap};
  REQUIRE(result.find(4, resident) != nullptr);
  CHECK(result.find(4, resident)->smoothing.most == 0);
  CHECK_FALSE(result.speedup(4, resident));
  CHECK(result.speedup_together(4, resident));
}

TEST_CASE("the serial version is as fast as itself") {
  const ExperimentResult result = run_experiment(small(), {});
  const Spread speedup = *result.speedup(60, {Version::serial, Form::swap});
  CHECK((speedup.least == 1 && speedup.median == 1 && speedup.most == 1));
}

TEST_CASE("the result does not hold on to who watched") {
  ExperimentOptions options = small();
  options.progress = [](const ExperimentProgress&) {};
  CHECK_FALSE(run_experiment(options, {}).options.progress);
}

TEST_CASE("other bits than those of the first case are noticed") {
  const fakes::FakeBackend backend(fakes::Failure::bits);
  const ExperimentResult result = run_experiment(small(), device(backend));
  CHECK_FALSE(result.same_bits());
  for (const Row& row : result.rows) {
    CHECK(row.measured->same_bits_again);
    CHECK(row.measured->same_bits_as_first ==
          (!runs_on_device(row.what.version) || row.what.order == Order::unordered));
  }
}

TEST_CASE("the unordered form may give any bits") {
  const fakes::FakeBackend backend(fakes::Failure::bits);
  ExperimentResult result = run_experiment(small(), device(backend));
  std::erase_if(result.rows, [](const Row& row) { return row.what.order == Order::colour; });
  CHECK(result.same_bits());
}

TEST_CASE("a case that takes long runs fewer times, but once at least") {
  ExperimentOptions options = small();
  options.versions = {Version::serial};
  options.runs = 1000;
  options.seconds = 1e-9;
  for (const Row& row : run_experiment(options, {}).rows) {
    CHECK(row.measured->runs == 1);
  }
}

TEST_CASE("speedups are relative to the serial version of the same form") {
  const ExperimentResult result = run_experiment(small(), {});
  const Measurement* const serial = result.find(60, {Version::serial, Form::in_place});
  const Measurement* const cpu = result.find(60, {Version::cpu, Form::in_place});
  CHECK(result.speedup(60, {Version::cpu, Form::in_place})->median == serial->smoothing.median / cpu->smoothing.median);
  CHECK(result.speedup_together(60, {Version::cpu, Form::in_place})->least ==
        serial->together.least / cpu->together.most);
  CHECK_FALSE(result.speedup(60, {Version::gpu, Form::swap}));
  CHECK_FALSE(result.speedup(61, {Version::cpu, Form::swap}));
  ExperimentOptions no_serial = small();
  no_serial.versions = {Version::cpu};
  CHECK_FALSE(run_experiment(no_serial, {}).speedup(60, {Version::cpu, Form::swap}));
}

TEST_CASE("the progress never goes back, names what runs and counts the runs") {
  const fakes::FakeBackend backend;
  ExperimentOptions options = small();
  std::vector<ExperimentProgress> seen;
  options.progress = [&](const ExperimentProgress& progress) { seen.push_back(progress); };
  run_experiment(options, device(backend));
  CHECK(seen.size() == 2 + 2 * 18 * 3);  // the meshes, and three runs of each case
  CHECK(seen.front().part == 0);
  CHECK(std::ranges::is_sorted(seen, {}, &ExperimentProgress::part));
  CHECK(seen.back().part < 1);
  CHECK(seen.back().part > 0.9);
  CHECK(seen.back().run == 2);
  CHECK(seen.back().what == "resident, Form B");
}

TEST_CASE("an experiment without sizes, versions, runs or time is refused") {
  const auto refused = [](const auto& change) {
    ExperimentOptions options = small();
    change(options);
    CHECK_THROWS_AS(run_experiment(options, {}), std::invalid_argument);
  };
  refused([](ExperimentOptions& options) { options.sizes.clear(); });
  refused([](ExperimentOptions& options) { options.sizes = {3}; });
  refused([](ExperimentOptions& options) { options.versions.clear(); });
  refused([](ExperimentOptions& options) { options.runs = 0; });
  refused([](ExperimentOptions& options) { options.seconds = 0; });
}
