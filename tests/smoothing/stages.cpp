// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/sweeps/stages.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "trismooth/smoothing/smooth.h"
#include "trismooth/smoothing/sweeps/sweep_control.h"

#include "catch.h"
#include "support/test_meshes.h"

using test_meshes::Mesh;
using trismooth::Evaluation;
using trismooth::Form;
using trismooth::Method;
using trismooth::Precision;
using trismooth::Progress;
using trismooth::SmoothingOptions;
using trismooth::SmoothingResult;
using trismooth::Stages;
using trismooth::StopReason;
using trismooth::SweepControl;
using trismooth::SweepRecord;

namespace stages_test {

constexpr Form forms[] = {Form::swap, Form::in_place};
constexpr Precision precisions[] = {Precision::double_precision, Precision::single_precision};

SmoothingOptions mean_ratio() {
  SmoothingOptions options;
  options.method = Method::mean_ratio;
  options.threads = 1;
  return options;
}

struct Run {
  std::vector<double> xy;
  SmoothingResult result;
};

Run smoothed(const Mesh& mesh, const SmoothingOptions& options) {
  Run run{mesh.xy(), {}};
  run.result = trismooth::smooth(trismooth::xy_points(run.xy), mesh.indices(), {}, options);
  return run;
}

/// Its first stage ends after ten sweeps.
Mesh near_mesh() {
  return test_meshes::shuffled(test_meshes::jittered_grid(40, 40, 0.3, 1), 2);
}

/// Far from what it will be, all of it: one half of the square holds few of the columns.
Mesh far_mesh() {
  Mesh mesh = test_meshes::jittered_grid(40, 40, 0, 3);
  for (auto& p : mesh.points) {
    p.x = p.x > 0 && p.x < 1 ? std::pow(p.x, 6) : p.x;
  }
  return mesh;
}

TEST_CASE("with sizes asked for a mesh has far to go from the start, and goes on while a quarter of it moves") {
  const std::vector<double> lengths(4, 1);
  SmoothingOptions options = mean_ratio();
  const double usual_gain = Stages(options, 1000).step<double>().least_gain;
  options.mean_ratio.target_lengths = lengths;
  Stages stages(options, 1000);
  CHECK(stages.step<double>().least_gain == Approx(usual_gain / 3));
  stages.next(251, false);
  CHECK_FALSE(stages.is_last());
  stages.next(250, false);
  CHECK(stages.is_last());
  CHECK(stages.step<double>().least_gain == Approx(usual_gain / 3));
  options.method = Method::smart;
  CHECK(Stages(options, 1000).is_last());
}

TEST_CASE("methods without stages have one that lasts to the stop, and no moves are few") {
  for (const Method method : {Method::smart, Method::laplacian, Method::weighted}) {
    SmoothingOptions options;
    options.method = method;
    const Stages stages(options, 100000);
    CHECK(stages.is_last());
    CHECK(stages.sweeps() == 0);
    CHECK(stages.few_moves() == 0);
  }
}

TEST_CASE("the first stage is ten sweeps of long steps and power 1; in the last a 64th of the vertices is few") {
  Stages stages(mean_ratio(), 1000);
  CHECK_FALSE(stages.is_last());
  CHECK(stages.sweeps() == 10);
  CHECK(stages.few_moves() == 0);
  CHECK(stages.step<double>().relaxation == 1.8);
  CHECK_FALSE(stages.step<double>().is_last);
  stages.next(875, false);
  CHECK(stages.is_last());
  CHECK(stages.sweeps() == 0);
  CHECK(stages.few_moves() == 15);
  CHECK(stages.step<double>().relaxation == 1.5);
  CHECK(stages.step<double>().least_gain == 3e-4);
  CHECK(stages.step<float>().least_gain == 3e-4F);
  CHECK(stages.step<double>().is_last);
}

TEST_CASE("where more than 7/8 still move it goes on for smaller gains, as long as more than a quarter do") {
  Stages stages(mean_ratio(), 1000);
  stages.next(876, false);
  CHECK_FALSE(stages.is_last());
  CHECK(stages.sweeps() == 10);
  CHECK(stages.step<double>().least_gain == 1e-4);
  CHECK(stages.step<double>().relaxation == 1.8);
  stages.next(251, false);
  CHECK_FALSE(stages.is_last());
  stages.next(250, false);
  CHECK(stages.is_last());
  CHECK(stages.step<double>().least_gain == 1e-4);
}

TEST_CASE("steps of form A are shorter than Newton's in every stage") {
  SmoothingOptions options = mean_ratio();
  options.form = Form::swap;
  Stages stages(options, 1000);
  CHECK(stages.step<double>().relaxation == 0.7);
  stages.next(0, true);
  CHECK(stages.is_last());
  CHECK(stages.step<double>().relaxation == 0.7);
}

TEST_CASE("a first stage that has settled is over, however many moved; without vertices to move there is none") {
  Stages stages(mean_ratio(), 1000);
  stages.next(1000, true);
  CHECK(stages.is_last());
  CHECK(stages.step<double>().least_gain == 3e-4);
  CHECK(Stages(mean_ratio(), 0).is_last());
}

/// A sweep in which so many vertices moved, farther than any tolerance.
trismooth::SweepTally<double> moved_in_sweep(std::int64_t moved) {
  return {1000, moved, false, 0.25};
}

constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();

TEST_CASE("a control that leads launches of many sweeps has itself asked at the end of a stage and at the limit") {
  SmoothingOptions options = mean_ratio();
  options.max_sweeps = 24;
  SmoothingResult result;
  SweepControl control(options, 1000, result);
  CHECK(control.begins_stage());
  CHECK(control.sweeps_until_asked(256, false) == 10);
  CHECK(control.sweeps_until_asked(4, false) == 4);
  for (std::int64_t sweep = 1; sweep < 10; ++sweep) {
    REQUIRE_FALSE(control.add(moved_in_sweep(900), not_measured, 0));
    CHECK_FALSE(control.begins_stage());
    CHECK(control.sweeps_until_asked(256, false) == 10 - sweep);
  }
  // The mesh has far to go: the first stage goes on.
  REQUIRE_FALSE(control.add(moved_in_sweep(900), not_measured, 0));
  CHECK(control.begins_stage());
  CHECK_FALSE(control.stages().is_last());
  CHECK(control.sweeps_until_asked(256, false) == 10);
  // A sweep that settles ends it before its time.
  CHECK(control.settles(trismooth::SweepTally<double>{}));
  REQUIRE_FALSE(control.add(trismooth::SweepTally<double>{}, not_measured, 0));
  CHECK(control.begins_stage());
  CHECK(control.stages().is_last());
  CHECK(control.sweeps_left() == 13);
  CHECK(control.sweeps_until_asked(256, false) == 13);
  REQUIRE_FALSE(control.add(moved_in_sweep(17), not_measured, 0));
  REQUIRE_FALSE(control.add(moved_in_sweep(16), not_measured, 0));
  // What goes to and fro does so up to the limit.
  bool is_over = false;
  while (!is_over) {
    is_over = control.add_again();
  }
  CHECK(result.stop_reason == StopReason::sweep_limit);
  CHECK(result.sweeps == 24);
  REQUIRE(result.history.size() == 24);
  CHECK(result.vertex_updates == 23 * 1000);
  for (std::size_t i = 0; i < result.history.size(); ++i) {
    CHECK(result.history[i].sweep == static_cast<std::int64_t>(i) + 1);
    CHECK(result.history[i].moved == (i < 10 ? 900 : (i == 10 ? 0 : 17 - static_cast<std::int64_t>((i + 1) % 2))));
  }
  CHECK(result.history[0].max_relative_move == 0.5);
}

TEST_CASE("where vertices slide a control has itself asked behind every fifth sweep of a stage and behind the last") {
  SmoothingOptions options = mean_ratio();
  options.method = Method::smart;
  options.max_sweeps = 12;
  SmoothingResult result;
  SweepControl control(options, 1000, result);
  for (const std::int64_t expected : {5, 4, 3, 2, 1, 5, 4, 3, 2, 1, 2}) {
    CHECK(control.sweeps_until_asked(256, true) == expected);
    CHECK(control.sweeps_until_asked(2, true) == std::min<std::int64_t>(2, expected));
    CHECK(control.slides_behind(expected, false));
    CHECK(control.slides_behind(1, false) == (expected == 1));
    CHECK(control.slides_behind(1, true));
    REQUIRE_FALSE(control.add(moved_in_sweep(1), not_measured, 0));
  }
  CHECK(control.slides_behind(1, false));
  CHECK(control.add(moved_in_sweep(1), not_measured, 0));
  CHECK(result.stop_reason == StopReason::sweep_limit);
}

TEST_CASE("sweeps end while there is time for what comes behind them: as known, or as long as three first sweeps") {
  for (const bool is_known : {false, true}) {
    SmoothingOptions options;
    options.time_limit_seconds = 99.9;
    trismooth::CallLimit call(options.time_limit_seconds, {});
    if (is_known) {
      call.keep_back(20);
    }
    SmoothingResult result;
    SweepControl control(options, 1000, result);
    REQUIRE_FALSE(control.is_over());
    double seconds = 10;
    while (!control.add(moved_in_sweep(900), not_measured, seconds)) {
      seconds += 5;
    }
    CHECK(seconds == (is_known ? 75 : 65));
    CHECK(result.stop_reason == StopReason::time_limit);
  }
}

TEST_CASE("sweeps are counted through the stages, and each begins with a sweep over all vertices") {
  for (const Form form : forms) {
    for (const Precision precision : precisions) {
      CAPTURE(form, precision);
      SmoothingOptions options = mean_ratio();
      options.form = form;
      options.precision = precision;
      const SmoothingResult result = smoothed(near_mesh(), options).result;
      REQUIRE(result.sweeps > 11);
      REQUIRE(result.sweeps == static_cast<std::int64_t>(result.history.size()));
      std::int64_t evaluated = 0;
      for (std::size_t i = 0; i < result.history.size(); ++i) {
        CHECK(result.history[i].sweep == static_cast<std::int64_t>(i) + 1);
        evaluated += result.history[i].evaluated;
      }
      CHECK(result.vertex_updates == evaluated);
      CHECK(result.history[0].evaluated == result.free_vertices);
      CHECK(result.history[10].evaluated == result.free_vertices);
      // The stop: few moved in the last sweep, and more in all sweeps of the last stage before.
      CHECK(result.stop_reason == StopReason::few_moves);
      CHECK(64 * result.history.back().moved <= result.free_vertices);
      CHECK(result.history.back().moved > 0);
      for (std::size_t i = 10; i + 1 < result.history.size(); ++i) {
        CHECK(64 * result.history[i].moved > result.free_vertices);
      }
    }
  }
}

TEST_CASE("a mesh that has far to go has a longer first stage") {
  const SmoothingResult result = smoothed(far_mesh(), mean_ratio()).result;
  REQUIRE(result.sweeps > 20);
  CHECK(8 * result.history[9].moved > 7 * result.free_vertices);
  CHECK(result.history[10].evaluated == result.free_vertices);
  CHECK(result.history[20].evaluated == result.free_vertices);
}

TEST_CASE("a first stage in which nothing moves, or nothing beyond the tolerance, is followed by the last") {
  // All triangles are alike: what every vertex is at its best in is no reason to move.
  const Mesh hexagons = [] {
    Mesh mesh = test_meshes::jittered_grid(9, 9, 0, 1);
    mesh.triangles.clear();
    for (std::int32_t j = 0; j < 8; ++j) {
      for (std::int32_t i = 0; i < 8; ++i) {
        const std::int32_t a = 9 * j + i;
        mesh.triangles.insert(mesh.triangles.end(), {{a, a + 1, a + 9}, {a + 1, a + 10, a + 9}});
      }
    }
    for (std::int32_t v = 0; v < 81; ++v) {
      const std::int32_t row = v / 9;
      const double i = v % 9;
      const double j = row;
      mesh.points[static_cast<std::size_t>(v)] = {i + j / 2, j * std::sqrt(0.75)};
    }
    return mesh;
  }();
  const SmoothingResult still = smoothed(hexagons, mean_ratio()).result;
  CHECK(still.stop_reason == StopReason::fixed_point);
  CHECK(still.sweeps == 2);
  CHECK(still.vertex_updates == 2 * still.free_vertices);
  CHECK(still.moved_vertices == 0);

  SmoothingOptions options = mean_ratio();
  options.tolerance = 10;
  const SmoothingResult within = smoothed(near_mesh(), options).result;
  CHECK(within.stop_reason == StopReason::tolerance);
  CHECK(within.sweeps == 2);
  CHECK(within.history[1].evaluated == within.free_vertices);
}

TEST_CASE("a sweep limit, a callback and a quality target stop in either stage, with the mesh of that sweep") {
  for (const Form form : forms) {
    for (const Precision precision : precisions) {
      SmoothingOptions options = mean_ratio();
      options.form = form;
      options.precision = precision;
      options.record_min_shape = true;
      const SmoothingResult all = smoothed(near_mesh(), options).result;
      // Inside the first stage, at its end, and in the last one.
      for (const std::int64_t last : {1, 4, 9, 10, 11}) {
        CAPTURE(form, precision, last);
        options.max_sweeps = last;
        const Run limited = smoothed(near_mesh(), options);
        CHECK(limited.result.stop_reason == StopReason::sweep_limit);
        CHECK(limited.result.sweeps == last);
        for (std::size_t i = 0; i < limited.result.history.size(); ++i) {
          CHECK(limited.result.history[i].moved == all.history[i].moved);
          CHECK(limited.result.history[i].min_shape == all.history[i].min_shape);
        }

        options.max_sweeps = 0;
        options.progress = [last](const SweepRecord& record) {
          return record.sweep == last ? Progress::stop : Progress::proceed;
        };
        const Run cancelled = smoothed(near_mesh(), options);
        CHECK(cancelled.result.stop_reason == StopReason::cancelled);
        CHECK(cancelled.result.sweeps == last);
        CHECK(cancelled.xy == limited.xy);
        options.progress = nullptr;

        options.target_quality = all.history[static_cast<std::size_t>(last) - 1].min_shape;
        const auto first = std::ranges::find_if(
            all.history, [&](const SweepRecord& record) { return record.min_shape >= *options.target_quality; });
        const Run reached = smoothed(near_mesh(), options);
        CHECK(reached.result.stop_reason == StopReason::quality_target);
        CHECK(reached.result.sweeps == first->sweep);
        if (first->sweep == last) {
          CHECK(reached.xy == limited.xy);
        }
        options.target_quality.reset();
      }
    }
  }
}

TEST_CASE("skipping what cannot move changes no bit in any stage") {
  for (const auto& mesh : {near_mesh(), far_mesh(), test_meshes::tangled(20, 4)}) {
    for (const Form form : forms) {
      for (const Precision precision : precisions) {
        CAPTURE(form, precision);
        SmoothingOptions options = mean_ratio();
        options.form = form;
        options.precision = precision;
        options.max_sweeps = 60;
        const Run changed = smoothed(mesh, options);
        options.evaluation = Evaluation::all;
        const Run all = smoothed(mesh, options);
        CHECK(changed.xy == all.xy);
        CHECK(changed.result.stop_reason == all.result.stop_reason);
        CHECK(all.result.vertex_updates == all.result.sweeps * all.result.free_vertices);
        CHECK(changed.result.vertex_updates < all.result.vertex_updates);
        REQUIRE(changed.result.history.size() == all.result.history.size());
        for (std::size_t i = 0; i < all.result.history.size(); ++i) {
          CHECK(changed.result.history[i].moved == all.result.history[i].moved);
          CHECK(changed.result.history[i].max_relative_move == all.result.history[i].max_relative_move);
        }
      }
    }
  }
}

}  // namespace stages_test
