// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/pipeline/cli/command_line.h"

namespace trismooth {

/// The command that repeats the paper's experiments. It needs subcommands.h.
Subcommand add_bench_command(CLI::App& app, const CommandEnvironment& environment);

}  // namespace trismooth
