// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/stages/staged_run.h"

#include <string>
#include <utility>

#include "trismooth/pipeline/stages/compare_stage.h"
#include "trismooth/pipeline/stages/warnings.h"
#include "trismooth/smoothing/result_text.h"

namespace trismooth {

namespace {

/// Adds the time from its beginning to its end, however that comes.
class StageTime {
 public:
  explicit StageTime(double& milliseconds) : milliseconds_(milliseconds) {}
  StageTime(const StageTime&) = delete;
  StageTime& operator=(const StageTime&) = delete;
  ~StageTime() { milliseconds_ += watch_.milliseconds(); }

 private:
  const Stopwatch watch_;
  double& milliseconds_;
};

}  // namespace

StagedRun::StagedRun(StagedMesh& mesh) : mesh_(mesh), run_(mesh.context()) {
  mesh_.together([this] {
    run_.options.smoothing.validate();
    run_.options.slide.validate();
    check_deformation(run_.options);
    check_comparison(run_.options);
  });
}

void StagedRun::begin(Stage stage) const {
  mesh_.together([&] {
    if (run_.options.stage_started && run_.options.stage_started(stage) == Progress::stop) {
      throw Cancelled();
    }
  });
}

template <class Body>
void StagedRun::timed(Stage stage, double& milliseconds, const Body& body) const {
  begin(stage);
  const StageTime time(milliseconds);
  body();
}

void StagedRun::read() {
  timed(Stage::read, run_.result.timings_ms.read, [this] { mesh_.read(); });
}

void StagedRun::check_and_smooth() {
  check();
  if (run_.options.output) {
    warn_before_smoothing(mesh_);
    smooth();
  }
}

void StagedRun::check() {
  PipelineTimings& timings = run_.result.timings_ms;
  timed(Stage::topology, timings.topology, [this] { mesh_.connect(); });
  timed(Stage::check_before, timings.check_before, [this] { check_before(); });
  warn_of_input(run_);
}

void StagedRun::check_before() {
  PipelineResult& result = run_.result;
  QualityOfMesh quality = mesh_.quality();
  result.before = std::move(quality.report);
  result.regions_before = std::move(quality.regions);
  result.quadratic_before = quality.quadratic;
  keep_picture();
}

void StagedRun::keep_picture() {
  if (run_.options.picture) {
    mesh_.keep_picture();
  }
}

void StagedRun::smooth() {
  begin(Stage::smooth);
  SmoothingResult smoothing = mesh_.smooth();
  PipelineTimings& timings = run_.result.timings_ms;
  timings.topology += smoothing.timings.prepare;
  timings.transfer_in += smoothing.timings.transfer_in;
  timings.untangle += smoothing.timings.untangle;
  timings.smooth += smoothing.timings.smooth;
  timings.transfer_out += smoothing.timings.transfer_out;
  timings.guard += smoothing.timings.commit;
  run_.warn(no_time_text(smoothing));
  // Rings had their layers held before there was a smoothing.
  smoothing.layers = run_.result.input.layers;
  run_.result.smoothing = std::move(smoothing);
  timed(Stage::check_after, timings.check_after, [this] { check_after(); });
}

void StagedRun::compare(const std::function<void()>& take_place) {
  timed(Stage::check_after, run_.result.timings_ms.check_after, [&] {
    take_place();
    check_after();
  });
}

void StagedRun::check_after() {
  PipelineResult& result = run_.result;
  QualityOfMesh quality = mesh_.quality();
  if (result.smoothing) {
    result.smoothing->inverted = quality.report.inverted;
    result.smoothing->degenerate = quality.report.degenerate;
  }
  result.after = std::move(quality.report);
  result.regions_after = std::move(quality.regions);
  result.quadratic_after = quality.quadratic;
  keep_picture();
  if (run_.options.deformation) {
    return;  // of all steps together it is said
  }
  if (run_.options.compared) {
    warn_of_comparison(run_);
    return;
  }
  for (std::string& warning : warnings_of_invalid(result)) {
    run_.warn(std::move(warning));
  }
  run_.note(note_of_missed_target(run_.options, result));
}

void StagedRun::write() {
  if (!run_.options.written()) {
    complete();
    return;
  }
  begin(Stage::write);
  const Stopwatch watch;
  mesh_.write([&]() -> const PipelineResult& {
    run_.result.timings_ms.write += watch.milliseconds();
    complete();
    return run_.result;
  });
}

void StagedRun::complete() {
  run_.result.timings_ms.total = watch_.milliseconds();
  run_.result.peak_memory_bytes = mesh_.peak_memory();
}

}  // namespace trismooth
