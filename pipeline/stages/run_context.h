// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>

#include "trismooth/base/machine/workers.h"
#include "trismooth/pipeline/pipeline.h"

namespace trismooth {

/// What every run has, whoever has its mesh: what is asked for, and what has come of it so far.
struct RunContext {
  /// The options outlive it.
  explicit RunContext(const PipelineOptions& run_options)
      : options(run_options), workers(run_options.smoothing.threads) {}

  const PipelineOptions& options;
  Workers workers;
  PipelineResult result;

  /// Keeps the sentence; an empty one has nothing to say.
  void note(std::string sentence) {
    if (!sentence.empty()) {
      result.notes.push_back(std::move(sentence));
    }
  }
  /// Keeps the warning, and tells it at once to who wants to know; an empty one has nothing to say.
  void warn(std::string warning) {
    if (warning.empty()) {
      return;
    }
    result.warnings.push_back(std::move(warning));
    if (options.warned) {
      options.warned(result.warnings.back());
    }
  }
};

}  // namespace trismooth
