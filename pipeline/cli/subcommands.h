// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include <CLI/CLI.hpp>

#include "trismooth/pipeline/cli/command_line.h"
#include "trismooth/pipeline/cli/exit_code.h"

namespace trismooth {

/// One of the program's commands: how it is recognised, and what to do once the command line is parsed. `run` throws
/// the exceptions that report_failure() knows.
struct Subcommand {
  CLI::App* app = nullptr;
  std::function<ExitCode()> run;
  bool runs_pipeline = false;  ///< as CommandEnvironment::run does it
};

/// Each adds its command with its options to `app`; one source file a command. `environment` must outlive the result.
Subcommand add_smooth_command(CLI::App& app, const CommandEnvironment& environment);
Subcommand add_deform_command(CLI::App& app, const CommandEnvironment& environment);
Subcommand add_compare_command(CLI::App& app, const CommandEnvironment& environment);
Subcommand add_quality_command(CLI::App& app, const CommandEnvironment& environment);
Subcommand add_generate_command(CLI::App& app, const CommandEnvironment& environment);
Subcommand add_info_command(CLI::App& app, const CommandEnvironment& environment);

}  // namespace trismooth
