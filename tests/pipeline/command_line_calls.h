// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "trismooth/paper/bench_command.h"
#include "trismooth/pipeline/cli/command_line.h"
#include "trismooth/pipeline/pipeline.h"

#include "sample_run.h"
#include "support/fake_backend.h"

/// Calls the command line with a pipeline of the tests.
namespace command_line_calls {

using trismooth::CudaSupport;
using trismooth::PipelineOptions;
using trismooth::PipelineResult;

using Words = std::vector<std::string>;
using Run = std::function<PipelineResult(const PipelineOptions&)>;

/// What a command line did.
struct Outcome {
  int code = 0;
  std::string out;
  std::string err;
  std::optional<PipelineOptions> options;  ///< what the pipeline was run with, if it was

  bool says(const std::string& words) const { return err.find(words) != std::string::npos; }
  /// Wherever lines are broken: names of scratch files may be long.
  bool shows(const std::string& words) const {
    std::string text = out;
    const std::string line_break = "\n            ";
    for (std::size_t at = text.find(line_break); at != std::string::npos; at = text.find(line_break, at)) {
      text.replace(at, line_break.size(), " ");
    }
    return text.find(words) != std::string::npos;
  }
};

/// Calls the command line with a pipeline that answers `run`, as in a build without CUDA unless `cuda` is another.
inline Outcome call(Words words, const Run& run, bool terminal = false, const CudaSupport& cuda = {}) {
  words.insert(words.begin(), "trismooth");
  std::vector<const char*> arguments;
  for (const std::string& word : words) {
    arguments.push_back(word.c_str());
  }
  Outcome outcome;
  std::ostringstream out;
  std::ostringstream err;
  const auto recorded = [&](const PipelineOptions& options) {
    outcome.options = options;
    return run(options);
  };
  trismooth::CommandEnvironment environment{out, err, {terminal ? &err : nullptr}, recorded, [&] { return cuda; }};
  environment.more_commands = {&trismooth::add_bench_command};
  outcome.code = trismooth::run_command_line(static_cast<int>(arguments.size()), arguments.data(), environment);
  outcome.out = out.str();
  outcome.err = err.str();
  return outcome;
}

inline Outcome call(const Words& words) {
  return call(words, [](const PipelineOptions& options) {
    return options.output ? sample::result() : sample::quality_result();
  });
}

inline Outcome smooth(Words more) {
  more.insert(more.begin(), {"smooth", "plate.vtk", "out.vtk"});
  return call(more);
}

/// trismooth deform, with the pipeline itself.
inline Outcome deform(Words words) {
  words.insert(words.begin(), "deform");
  return call(words, &trismooth::run_pipeline);
}

/// A build with CUDA on a machine where `problem` says why there is no device, or where there is one.
inline CudaSupport cuda_with(const fakes::FakeBackend& backend, const std::string& problem) {
  return {&backend, false, [problem] { return problem; }, [] { return "CUDA:       lines of a test\n"; }};
}

template <class Error>
Outcome call_failing_with(const Error& error) {
  return call({"smooth", "plate.vtk", "out.vtk"}, [&](const PipelineOptions&) -> PipelineResult {
    throw Error(error);  // NOLINT(bugprone-exception-copy-constructor-throws): there is memory
  });
}

}  // namespace command_line_calls
