// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/paper/bench_command.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "trismooth/base/machine/worker_threads.h"
#include "trismooth/base/text/list_text.h"
#include "trismooth/base/text/printable_text.h"
#include "trismooth/mesh_io/bytes/output_file.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/paper/experiment.h"
#include "trismooth/paper/experiment_report.h"
#include "trismooth/paper/progress_text.h"
#include "trismooth/pipeline/cli/backend_choice.h"
#include "trismooth/pipeline/cli/messages.h"
#include "trismooth/pipeline/cli/option_parsing.h"
#include "trismooth/pipeline/cli/output_attempts.h"
#include "trismooth/pipeline/cli/subcommands.h"
#include "trismooth/pipeline/cli/terminal_line.h"
#include "trismooth/pipeline/generate/random_mesh.h"
#include "trismooth/pipeline/report/report_format.h"
#include "trismooth/smoothing/errors.h"

namespace trismooth {

namespace {

constexpr int most_runs = 1000;

struct BenchSettings {
  experiments::ExperimentOptions experiment;
  BackendChoice backend = BackendChoice::automatic;
  std::vector<std::filesystem::path> reports;
};

using BenchReportWriter = std::string (*)(const experiments::ExperimentReport&);

BenchReportWriter bench_writer_of(const std::filesystem::path& path) {
  static constexpr std::array<ReportFormat<BenchReportWriter>, 3> formats{
      {{".json", &experiments::json_of}, {".csv", &experiments::csv_of}, {".html", &experiments::page_of}}};
  return writer_for<BenchReportWriter>(path, formats);
}

std::int64_t parse_size(std::string_view text) {
  return parse_count(text, least_random_mesh_vertices, max_random_mesh_vertices);
}

/// Every value counts once.
template <class Value>
std::vector<Value> without_repeats(const std::vector<Value>& values) {
  std::vector<Value> distinct;
  for (const Value& value : values) {
    if (std::ranges::find(distinct, value) == distinct.end()) {
      distinct.push_back(value);
    }
  }
  return distinct;
}

double parse_seconds(const std::string& text) {
  const double seconds = parse_finite(text);
  if (seconds <= 0) {
    throw std::invalid_argument("expected a number above 0, got '" + text + "'");
  }
  return seconds;
}

/// Why what runs on a device is left out, or nothing. Throws DeviceError where the user insists on a device.
std::string why_no_device(BackendChoice choice, const CudaSupport& cuda) {
  if (choice == BackendChoice::cpu) {
    return "left out by --backend cpu";
  }
  if (cuda.backend == nullptr) {
    if (choice == BackendChoice::cuda) {
      throw DeviceError("this build has no CUDA; --backend auto measures the CPU versions");
    }
    return {};
  }
  std::string problem = cuda.problem();
  if (choice == BackendChoice::cuda && !problem.empty()) {
    throw DeviceError(problem + "; --backend auto measures the CPU versions");
  }
  return problem;
}

std::string now_text() {
  const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(now));
}

/// As it would be typed: with the program's name alone, so that reports hold no path of the machine.
std::string command_text(const BenchSettings& settings) {
  const experiments::ExperimentOptions& options = settings.experiment;
  const std::string versions = list_text(
      options.versions, [](experiments::Version version) { return to_string(version); }, ",");
  std::string text =
      fmt::format("trismooth bench --sizes {} --versions {} --precision {} --runs {} --seconds {} --seed {}",
                  fmt::join(options.sizes, ","), versions, to_string(options.precision), options.runs, options.seconds,
                  options.seed);
  if (options.threads > 0) {
    text += fmt::format(" --threads {}", options.threads);
  }
  if (settings.backend != BackendChoice::automatic) {
    text += fmt::format(" --backend {}", to_string(settings.backend));
  }
  return text;
}

experiments::ExperimentResult run_watched(experiments::ExperimentOptions options, const CudaSupport& cuda,
                                          const CommandEnvironment& environment) {
  std::optional<TerminalLine> line;
  if (environment.terminal.stream != nullptr) {
    line.emplace(environment.terminal);
    options.progress = [&line, runs = options.runs](const experiments::ExperimentProgress& progress) {
      // Between long runs the line must say what goes on now; between short ones it may lag.
      TerminalLine::Pieces pieces = experiments::progress_pieces(progress, runs);
      progress.run == 0 ? line->draw(std::move(pieces)) : line->draw_now_and_then(std::move(pieces));
    };
  }
  return experiments::run_experiment(options, cuda);
}

/// The tables, and all reports that can be written; answers whether those are all. Throws WriteError in the end where
/// the tables could not be printed.
bool write_results(const experiments::ExperimentReport& report, const std::vector<std::filesystem::path>& paths,
                   const CommandEnvironment& environment) {
  std::exception_ptr not_printed;
  try {
    print_results(environment.out, experiments::text_of(report));
  } catch (const WriteError&) {
    not_printed = std::current_exception();
  }
  bool all = true;
  for (const std::filesystem::path& path : paths) {
    if (could_write(path, environment.err, [&] { write_report_text(path, bench_writer_of(path)(report)); })) {
      environment.out << "report: " << printable(path.string()) << '\n' << std::flush;
    } else {
      all = false;
    }
  }
  if (not_printed) {
    std::rethrow_exception(not_printed);
  }
  return all;
}

ExitCode run_bench(BenchSettings settings, const CommandEnvironment& environment) {
  const CudaSupport cuda = environment.cuda();
  settings.experiment.no_device_reason = why_no_device(settings.backend, cuda);
  for (const std::filesystem::path& path : settings.reports) {
    const OutputFile attempt(path);  // a folder that is not there is told before the work, not after it
  }
  const experiments::ExperimentReport report =
      experiments::make_report(run_watched(settings.experiment, cuda, environment), command_text(settings), now_text(),
                               cuda.backend != nullptr ? cuda.lines() : std::string{});
  if (!write_results(report, settings.reports, environment)) {
    return ExitCode::not_written;
  }
  if (!report.result.same_bits()) {
    print_error(environment.err, "runs that must give the same bits did not; please report this");
    return ExitCode::gate_failed;
  }
  if (report.result.any_lack_of(experiments::Lack::working_device)) {
    print_error(environment.err, "the device failed; the remarks say where");
    return ExitCode::device_error;
  }
  if (report.result.any_lack_of(experiments::Lack::memory)) {
    print_error(environment.err, "not enough memory; the remarks say where");
    return ExitCode::bad_input;
  }
  return ExitCode::done;
}

}  // namespace

Subcommand add_bench_command(CLI::App& app, const CommandEnvironment& environment) {
  const auto settings = std::make_shared<BenchSettings>();
  experiments::ExperimentOptions& options = settings->experiment;
  CLI::App& command = *app.add_subcommand("bench", "Repeat the paper's experiments on this machine");
  add_parsed_option(
      command, "--sizes", "N,N,...",
      "Vertices of the meshes, with K and M for thousands and millions [1K,5K,10K,50K,100K, the paper's]",
      [&options](const std::string& text) { options.sizes = without_repeats(parse_list(text, &parse_size)); });
  add_enum_option(command, "--precision", options.precision, "Of the sweeps; single is the paper's");
  add_parsed_option(
      command, "--versions", "V,V,...",
      "Of " + valid_texts<experiments::Version>() +
          ": the paper's serial program, the CPU backend, the paper's GPU and CDP versions, the resident version [all]",
      [&options](const std::string& text) {
        options.versions = without_repeats(parse_list(text, &parse_choice<experiments::Version>));
      });
  add_parsed_option(command, "--runs", "N", "Runs of each, one more to warm up [7]",
                    [&options](const std::string& text) { options.runs = parse_integer(text, 1, most_runs); });
  add_parsed_option(command, "--seconds", "S", "Fewer runs where they would take longer together [20]",
                    [&options](const std::string& text) { options.seconds = parse_seconds(text); });
  add_parsed_option(command, "--seed", "S", "Of the random meshes [1]", [&options](const std::string& text) {
    options.seed = parse_integer(text, std::uint64_t{0}, std::numeric_limits<std::uint64_t>::max());
  });
  add_parsed_option(command, "--threads", "N", "Of the optimised CPU version [one a core]",
                    [&options](const std::string& text) { options.threads = parse_integer(text, 0, most_threads()); });
  add_enum_option(command, "--backend", settings->backend,
                  "auto: the versions for a GPU where there is one; cpu: without them; cuda: not without them");
  constexpr bool repeatable = true;
  add_parsed_option(
      command, "--report", "FILE", "Write a report: FILE.json, FILE.csv or FILE.html. Repeatable",
      [settings](const std::string& text) {
        bench_writer_of(text);
        settings->reports.emplace_back(text);
      },
      repeatable);
  return {&command, [settings, &environment] { return run_bench(*settings, environment); }};
}

}  // namespace trismooth
