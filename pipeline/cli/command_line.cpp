// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/cli/command_line.h"

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <new>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fcntl.h>
#include <unistd.h>

#include "trismooth/mesh_io/vtk_support.h"
#include "trismooth/pipeline/cli/exit_code.h"
#include "trismooth/pipeline/cli/failure.h"
#include "trismooth/pipeline/cli/help_formatter.h"
#include "trismooth/pipeline/cli/interrupt.h"
#include "trismooth/pipeline/cli/output_attempts.h"
#include "trismooth/pipeline/cli/printable_stream.h"
#include "trismooth/pipeline/cli/rank_job.h"
#include "trismooth/pipeline/cli/subcommands.h"
#include "trismooth/pipeline/cli/usage_message.h"
#include "trismooth/pipeline/shell_words.h"
#include "trismooth/version.h"

namespace trismooth {

namespace {

constexpr const char* description =
    "trismooth improves planar meshes of triangles and quadrilaterals for finite elements by Smart Laplacian smoothing "
    "and others. Boundaries and material interfaces stay where they are, no element gets worse than the worst one "
    "touched, and everything else in the file stays as it is.";

constexpr const char* help_footer =
    "Examples:\n"
    "  trismooth smooth plate.vtk smoother.vtk\n"
    "  trismooth smooth coast.vtu out.vtu --fixed-ids anchors.txt --report run.html\n"
    "  trismooth deform wing.vtu turned.vtu --displacement-file wing.csv\n"
    "  trismooth quality plate.vtk --require 'min_angle>=20' --require 'inverted==0'\n"
    "  trismooth compare plate.msh elsewhere.vtu --report changes.html\n"
    "\n"
    "'trismooth COMMAND --help' lists a command's options.\n"
    "\n"
    "Exit codes: 0 done; 1 a --require failed, or bench found other bits; 2 wrong\n"
    "usage; 3 the input cannot be used; 4 the output cannot be written; 5 CUDA error\n"
    "or no device; 130 cancelled.";

std::string help_hint(const CLI::App& app) {
  std::string command = app.get_name();
  for (const CLI::App* const subcommand : app.get_subcommands()) {
    command += " " + subcommand->get_name();
  }
  return "'" + command + " --help' shows what is possible";
}

ExitCode run_chosen(CLI::App& app, int argc, const char* const* argv, const CommandEnvironment& environment) {
  std::vector<Subcommand> subcommands{add_smooth_command(app, environment), add_deform_command(app, environment),
                                      add_quality_command(app, environment), add_compare_command(app, environment),
                                      add_generate_command(app, environment)};
  for (const AddSubcommand add : environment.more_commands) {
    subcommands.push_back(add(app, environment));
  }
  subcommands.push_back(add_info_command(app, environment));
  for (const Subcommand& subcommand : subcommands) {
    subcommand.app->group("Commands");
  }
  app.footer(help_footer);  // set last: commands would take it over
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    return static_cast<ExitCode>(app.exit(help_or_version, environment.out, environment.err));
  } catch (const CLI::ParseError& error) {
    throw std::invalid_argument(usage_message(app, error) + "; " + help_hint(app));
  }
  const auto chosen =
      std::ranges::find_if(subcommands, [](const Subcommand& subcommand) { return subcommand.app->parsed(); });
  // Whatever no run is shared of, rank 0 does alone.
  return environment.follows && !chosen->runs_pipeline ? ExitCode::done : chosen->run();
}

/// With the program's name alone, so that reports hold no path of the machine that nobody gave.
std::string typed_command(int argc, const char* const* argv) {
  std::vector<std::string> words{"trismooth"};
  words.insert(words.end(), argv + std::min(argc, 1), argv + argc);
  return shell_command(words);
}

/// A standard stream that whoever started the program has closed is opened so that using it fails all the same. Else
/// the first files opened got these numbers, and messages would go into them.
void reserve_standard_streams() {
  for (const auto& [stream, mode] :
       {std::pair(STDIN_FILENO, O_WRONLY), std::pair(STDOUT_FILENO, O_RDONLY), std::pair(STDERR_FILENO, O_RDONLY)}) {
    if (::fcntl(stream, F_GETFD) == -1) {
      // The lowest free number is the stream's: those below are open. Stays open until the program ends.
      [[maybe_unused]] const int reserved = ::open("/dev/null", mode);
    }
  }
}

// Memory for destructors and messages, given free when there is no more.
std::atomic<void*> memory_for_the_end{nullptr};

/// Where memory is used up, what is left must suffice to clean up and to say so: destructors that need some are
/// otherwise the end of the program without a word.
void reserve_memory_for_the_end() {
  constexpr std::size_t bytes = std::size_t{1} << 20;
  memory_for_the_end = std::malloc(bytes);
  std::set_new_handler([] {
    std::free(memory_for_the_end.exchange(nullptr));
    throw std::bad_alloc();
  });
}

int run_words(int argc, const char* const* argv, const CommandEnvironment& given) {
  PrintableStream out(given.out);
  PrintableStream err(given.err);
  const CommandEnvironment environment{
      out,           err,         given.terminal,     given.run, given.cuda, {}, given.over_ranks,
      given.follows, given.whose, given.more_commands};
  CLI::App app(description, "trismooth");
  app.set_version_flag("--version,-V", "trismooth " + std::string(version()), "Print the version and exit");
  app.set_help_flag("--help,-h", "Print this help and exit");
  app.formatter(std::make_shared<HelpFormatter>());
  app.require_subcommand(1);
  CommandEnvironment named = environment;
  ExitCode code = ExitCode::done;
  try {
    named.command = typed_command(argc, argv);
    code = run_chosen(app, argc, argv, named);
    flush_results(environment.out);
  } catch (...) {
    code = report_failure(environment.err, given.whose);
  }
  environment.err.flush();
  return static_cast<int>(code);
}

}  // namespace

int run_command_line(int argc, const char* const* argv, const CommandEnvironment& given) {
  try {
    return run_words(argc, argv, given);
  } catch (...) {
    return static_cast<int>(report_failure(given.err, given.whose));
  }
}

namespace {

int run_process(int argc, const char* const* argv, const std::vector<AddSubcommand>& more_commands) {
  reserve_memory_for_the_end();
  silence_libraries();
  reserve_standard_streams();
  // A file that gets larger than allowed (ulimit -f) is then an error like a full disk, not the end of the program.
  std::signal(SIGXFSZ, SIG_IGN);
  std::unique_ptr<RankJob> job = join_ranks(argc, argv);
  const bool follows = job != nullptr && job->rank() > 0;
  end_on_interrupt(follows ? InterruptWords::none : InterruptWords::said);
  Terminal terminal;
  if (::isatty(STDERR_FILENO) != 0 && !follows) {
    terminal = {&std::cerr, [] { return terminal_columns(STDERR_FILENO); }};
  }
  std::ostringstream unread;
  CommandEnvironment environment{follows ? static_cast<std::ostream&>(unread) : std::cout,
                                 follows ? static_cast<std::ostream&>(unread) : std::cerr, terminal};
  environment.more_commands = more_commands;
  if (job == nullptr) {
    return run_command_line(argc, argv, environment);
  }
  environment.run = [&job](const PipelineOptions& options) { return job->run(options); };
  environment.over_ranks = job->shares_work();
  environment.follows = follows;
  environment.whose = follows ? "rank " + std::to_string(job->rank()) + ": " : "";
  const int code = job->agreed(run_command_line(argc, argv, environment), unread);
  // Of ranks that end with an error, a launcher tells the others to end, which are about to.
  ignore_interrupts();
  job.reset();
  return code;
}

}  // namespace

int run_program(int argc, const char* const* argv, const std::vector<AddSubcommand>& more_commands) {
  try {
    return run_process(argc, argv, more_commands);
  } catch (...) {
    return static_cast<int>(report_failure(std::cerr, launched_rank()));
  }
}

}  // namespace trismooth
