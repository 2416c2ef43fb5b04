// SPDX-License-Identifier: BSD-3-Clause
// A call that is over before it is done: by the clock, or by its caller.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <thread>
#include <vector>

#include "trismooth/smoothing/keep_never_worse.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/share_of_cases.h"
#include "support/tangled_meshes.h"
#include "support/test_meshes.h"

namespace trismooth::limits_test {

using test_meshes::Mesh;

const Mesh& grid() {
  static const Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(20, 20, 0.3, 1), 2);
  return mesh;
}

void require_ended_before_sweeps(const SmoothingResult& result, StopReason reason) {
  CHECK(result.stop_reason == reason);
  CHECK(result.sweeps == 0);
  CHECK(result.moved_vertices == 0);
  CHECK(result.history.empty());
  CHECK(result.inverted == -1);
  CHECK(result.degenerate == -1);
  CHECK(result.backend == "cpu");
}

TEST_CASE("a call without time, and one that nobody wants any more, leaves the points as they are and says so") {
  for (const Method method : values_of<Method>()) {
    for (const StopReason reason : {StopReason::time_limit, StopReason::cancelled}) {
      SmoothingOptions options;
      options.method = method;
      if (reason == StopReason::time_limit) {
        options.time_limit_seconds = 0;
      }
      bool is_wanted = true;
      options.cancel = [&is_wanted] { return !is_wanted; };
      SmoothingPlan made = plan(grid().vertex_count(), grid().indices(), options);
      is_wanted = reason == StopReason::time_limit;
      std::vector<double> xy = grid().xy();
      require_ended_before_sweeps(smooth(xy_points(xy), grid().indices(), options), reason);
      require_ended_before_sweeps(made.smooth(xy), reason);
      CHECK(xy == grid().xy());
    }
  }
}

TEST_CASE("a plan gets ready in its first call however short the time, so that later ones have it all") {
  const Mesh mesh = test_meshes::jittered_grid(200, 200, 0.3, 3);
  SmoothingOptions options;
  options.time_limit_seconds = 0;
  SmoothingPlan made = plan(mesh.vertex_count(), mesh.indices(), options);
  std::vector<double> xy = mesh.xy();
  require_ended_before_sweeps(made.smooth(xy), StopReason::time_limit);
  CHECK(xy == mesh.xy());
  const auto begin = std::chrono::steady_clock::now();
  made.smooth(xy);
  const auto second = std::chrono::steady_clock::now() - begin;
  SmoothingPlan patient = plan(mesh.vertex_count(), mesh.indices());
  CHECK(patient.smooth(xy).timings.prepare > std::chrono::duration<double, std::milli>(second).count());
}

TEST_CASE("triangles of six nodes have the limits of others") {
  const Mesh mesh{{{0, 0}, {2, 0}, {0, 2}, {1, 0}, {1, 1}, {0, 1}}, {{0, 1, 2}}};
  const std::vector<std::int32_t> nodes{0, 1, 2, 3, 4, 5};
  SmoothingOptions options;
  options.time_limit_seconds = 0;
  std::vector<double> xy = mesh.xy();
  require_ended_before_sweeps(smooth_quadratic(xy_points(xy), nodes, options), StopReason::time_limit);
  CHECK(xy == mesh.xy());
}

TEST_CASE("a plan that is cancelled while it is made throws, as it has nothing to give") {
  SmoothingOptions options;
  options.cancel = [] { return true; };
  CHECK_THROWS_AS(plan(grid().vertex_count(), grid().indices(), options), PlanCancelled);
  options.cancel = {};
  options.time_limit_seconds = 0;  // that is for its calls
  CHECK_NOTHROW(plan(grid().vertex_count(), grid().indices(), options));
}

TEST_CASE("what a caller throws when asked whether the call is still wanted reaches the caller, in every phase") {
  struct Interrupted : std::runtime_error {
    Interrupted() : std::runtime_error("interrupted") {}
  };
  const Mesh mesh = test_meshes::jittered_grid(150, 150, 0.45, 3);
  for (const std::int64_t questions : {1, 2, 3, 5, 8, 13}) {
    for (const int threads : {1, 2}) {
      SmoothingOptions options;
      options.threads = threads;
      options.tolerance = 0;
      std::int64_t asked = 0;
      options.cancel = [&] {
        if (++asked == questions) {
          throw Interrupted();
        }
        return false;
      };
      std::vector<double> xy = mesh.xy();
      try {
        smooth(xy_points(xy), mesh.indices(), options);
        CHECK(asked < questions);  // it was quicker
      } catch (const Interrupted&) {
        CHECK(xy == mesh.xy());
      }
    }
  }
}

/// True from a moment on.
struct From {
  std::chrono::steady_clock::time_point moment;

  bool operator()() const { return std::chrono::steady_clock::now() >= moment; }
};

TEST_CASE("cancelled at any time a call leaves a mesh that is nowhere worse, and its plan as if it had not been") {
  const std::array meshes{test_meshes::jittered_grid(120, 120, 0.45, 3), test_meshes::tangled(60, 4)};
  for (const Mesh& mesh : meshes) {
    const std::vector<double> before = mesh.xy();
    for (const Method method : values_of<Method>()) {
      SmoothingOptions options;
      options.method = method;
      options.max_sweeps = 30;
      std::vector<double> expected = mesh.xy();
      const auto begin = std::chrono::steady_clock::now();
      smooth(xy_points(expected), mesh.indices(), options);
      const auto whole = std::chrono::steady_clock::now() - begin;
      const auto moments = static_cast<int>(std::max<std::int64_t>(3, 12 * per_cent_of_cases() / 100));
      for (int moment = 0; moment < moments; ++moment) {
        From from{std::chrono::steady_clock::time_point::max()};
        options.cancel = [&from] { return from(); };
        SmoothingPlan made = plan(mesh.vertex_count(), mesh.indices(), options);
        from.moment = std::chrono::steady_clock::now() + whole * moment / moments;
        std::vector<double> xy = mesh.xy();
        const SmoothingResult result = made.smooth(xy);
        CAPTURE(method, moment, result.stop_reason, result.sweeps);
        // What has been kept once would be kept again.
        const KeptMoves kept = keep_never_worse(xy_points(before), xy_points(xy), mesh.indices());
        CHECK(kept.reverted.empty());
        from.moment = std::chrono::steady_clock::time_point::max();
        xy = mesh.xy();
        made.smooth(xy);
        CHECK(xy == expected);
      }
    }
  }
}

TEST_CASE("who has said once that nobody wants the call any more is not asked again, in whatever phase") {
  const Mesh mesh = test_meshes::tangled(12, 4);
  const auto questions_of = [&mesh](int last) {
    int questions = 0;
    SmoothingOptions options;
    options.threads = 1;
    options.untangle = Untangle::on;
    options.max_sweeps = 4;
    options.cancel = [&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(6));  // so that every look asks
      return ++questions == last;
    };
    std::vector<double> xy = mesh.xy();
    const SmoothingResult result = smooth(xy_points(xy), mesh.indices(), options);
    CHECK((result.stop_reason == StopReason::cancelled) == (questions == last));
    return questions;
  };
  const int all = questions_of(0);
  REQUIRE(all > 8);
  for (int last = 1; last <= all; last += std::max(1, all / 16)) {
    CAPTURE(last, all);
    CHECK(questions_of(last) <= last);
  }
}

TEST_CASE("a callback may smooth another mesh, which has the limits of its own options") {
  const Mesh other = test_meshes::jittered_grid(9, 9, 0.3, 5);
  std::vector<double> expected = other.xy();
  smooth(xy_points(expected), other.indices());
  const auto smooth_other = [&] {
    std::vector<double> xy = other.xy();
    smooth(xy_points(xy), other.indices());
    CHECK(xy == expected);
  };
  int asked = 0;
  int heard = 0;
  SmoothingOptions options;
  options.time_limit_seconds = 1000;
  options.cancel = [&] {
    ++asked;
    smooth_other();
    return false;
  };
  options.progress = [&](const SweepRecord&) {
    ++heard;
    smooth_other();
    return Progress::proceed;
  };
  std::vector<double> xy = grid().xy();
  smooth(xy_points(xy), grid().indices(), options);
  CHECK(asked > 0);
  CHECK(heard > 0);
}

}  // namespace trismooth::limits_test
