// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "trismooth/pipeline/cuda_support.h"
#include "trismooth/pipeline/pipeline.h"
#include "trismooth/pipeline/report/terminal.h"

namespace CLI {  // NOLINT(readability-identifier-naming): as CLI11 calls it
class App;
}

namespace trismooth {

struct CommandEnvironment;
struct Subcommand;

/// A function that adds a command: see subcommands.h.
using AddSubcommand = Subcommand (*)(CLI::App& app, const CommandEnvironment& environment);

/// What a command line is connected to. Tests hand in streams, a run and a CUDA of their own.
struct CommandEnvironment {
  std::ostream& out;    ///< results
  std::ostream& err;    ///< messages
  Terminal terminal{};  ///< progress, on the stream of the messages
  std::function<PipelineResult(const PipelineOptions&)> run = &run_pipeline;
  std::function<CudaSupport()> cuda = &cuda_support;
  std::string command = {};  ///< what was typed, for reports; run_command_line() fills it
  /// The run is shared by the ranks of an MPI job.
  bool over_ranks = false;
  /// This is one of its ranks but the first: it takes part in the run and does nothing else.
  bool follows = false;
  std::string whose = {};  ///< what stands in front of errors: that rank, where it is one of those
  std::vector<AddSubcommand> more_commands = {};  ///< that the program has beside those of pipeline/cli
};

/// Runs the command line (argv[0] is the program's name) and answers its exit code, see exit_code.h. Never throws for
/// anything that the user or a file did: that becomes a message. All text goes out as printable_lines() shows it;
/// progress alone moves the cursor.
int run_command_line(int argc, const char* const* argv, const CommandEnvironment& environment);

/// Runs the program, once in a process, which it takes over: the standard streams (closed ones are opened), the signals
/// (end_on_interrupt(); SIGXFSZ is ignored), the handler for memory that is used up, and what VTK says.
/// `more_commands`: what CommandEnvironment::more_commands has.
int run_program(int argc, const char* const* argv, const std::vector<AddSubcommand>& more_commands);

}  // namespace trismooth
