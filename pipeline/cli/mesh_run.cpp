// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/cli/mesh_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <new>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "trismooth/base/errors.h"
#include "trismooth/base/machine/out_of_memory.h"
#include "trismooth/mesh_io/bytes/memory_block.h"
#include "trismooth/mesh_io/bytes/output_file.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/mesh_io/parallel_file.h"
#include "trismooth/mesh_io/standard_streams.h"
#include "trismooth/pipeline/cli/format_option.h"
#include "trismooth/pipeline/cli/messages.h"
#include "trismooth/pipeline/cli/output_attempts.h"
#include "trismooth/pipeline/cli/progress_bar.h"
#include "trismooth/pipeline/report/labelled_line.h"
#include "trismooth/pipeline/report/region_table.h"
#include "trismooth/pipeline/report/report_file.h"
#include "trismooth/pipeline/report/report_format.h"
#include "trismooth/pipeline/report/text_report.h"
#include "trismooth/pipeline/report/timings.h"

namespace trismooth {

namespace {

std::string sweep_line(const SweepRecord& record) {
  std::string line = fmt::format("sweep {}: {} evaluated, {} moved, largest move {:.3g} edges", record.sweep,
                                 record.evaluated, record.moved, record.max_relative_move);
  if (!std::isnan(record.min_shape)) {
    line += fmt::format(", smallest shape {:.6g}", record.min_shape);
  }
  return wrapped(line, "", "  ");
}

std::string timings_line(const PipelineTimings& timings) {
  std::string line = "times:";
  for (const auto& [name, milliseconds] : timing_parts(timings)) {
    if (milliseconds > 0) {
      line += fmt::format(" {} {},", name, duration_text(milliseconds));
    }
  }
  return wrapped(line + fmt::format(" total {}", duration_text(timings.total)), "", "  ");
}

/// What is lost is said in full; of other notes there may be many.
void print_notes(const PipelineResult& result, Verbosity verbosity, std::ostream& err) {
  for (const std::string& loss : result.losses) {
    print_note(err, loss);
  }
  constexpr std::size_t most_notes = 5;
  const bool all = verbosity == Verbosity::verbose || result.notes.size() <= most_notes + 1;
  const std::size_t shown = all ? result.notes.size() : most_notes;
  for (std::size_t i = 0; i < shown; ++i) {
    print_note(err, result.notes[i]);
  }
  if (!all) {
    print_note(err, fmt::format("{} more notes; --verbose shows them", result.notes.size() - shown));
  }
}

/// Those that the steps of a series write; of other runs none.
std::vector<std::filesystem::path> meshes_of_series(const PipelineOptions& options) {
  std::vector<std::filesystem::path> meshes;
  if (options.deformation && options.deformation->is_series) {
    for (std::size_t step = 0; step < options.deformation->step_count(); ++step) {
      meshes.push_back(output_of_step(*options.output, step, options.deformation->step_count()));
    }
  }
  return meshes;
}

/// The files that a run reads and writes, but for what it leaves beside the mesh.
std::vector<std::filesystem::path> other_files(const PipelineOptions& options) {
  std::vector<std::filesystem::path> files{options.input};
  for (const auto& file : {options.written(), options.compared, options.fixed_ids}) {
    if (file) {
      files.push_back(*file);
    }
  }
  if (options.deformation) {
    std::ranges::copy(options.deformation->steps, std::back_inserter(files));
    std::ranges::copy(meshes_of_series(options), std::back_inserter(files));
  }
  return files;
}

/// A file that a run leaves beside the mesh, and the option that asks for it.
struct FileBeside {
  std::string_view option;
  std::filesystem::path path;
};

std::vector<FileBeside> files_beside(const MeshRunSettings& settings) {
  std::vector<FileBeside> files;
  for (const std::filesystem::path& report : settings.reports) {
    files.push_back({"--report", report});
  }
  for (const std::filesystem::path& picture : settings.pictures.files) {
    files.push_back({"--picture", picture});
  }
  return files;
}

std::invalid_argument refusal(const FileBeside& file, const std::string& reason) {
  return std::invalid_argument(std::string(file.option) + " " + file.path.string() + ": " + reason);
}

/// None may overwrite what is read or written in the same run, under whatever name.
void require_own_file(const FileBeside& file, const PipelineOptions& options) {
  std::error_code error;  // what does not exist is no other's file
  for (const std::filesystem::path& other : other_files(options)) {
    if (std::filesystem::equivalent(file.path, other, error)) {
      throw refusal(file, "is the same file as " + other.string());
    }
  }
}

/// Where a file is to be made, behind links that lead to what is not there yet. Empty where there is no such place:
/// making the file says so.
std::filesystem::path place_of(const std::filesystem::path& path) {
  constexpr int most_links = 40;
  std::error_code error;
  std::filesystem::path place = std::filesystem::absolute(path, error);
  for (int links = 0; links < most_links && std::filesystem::is_symlink(place, error); ++links) {
    place = place.parent_path() / std::filesystem::read_symlink(place, error);
  }
  place = std::filesystem::weakly_canonical(place, error);
  return error ? std::filesystem::path{} : place;
}

/// Nor another one of them, or a mesh of the run, which are not there yet.
void require_each_once(std::span<const FileBeside> files, const PipelineOptions& options) {
  std::vector<std::filesystem::path> meshes = meshes_of_series(options);
  if (const auto& mesh = options.written(); mesh && !is_standard_stream(*mesh)) {
    meshes.push_back(*mesh);
  }
  std::set<std::filesystem::path> places;
  for (const FileBeside& file : files) {
    const std::filesystem::path place = place_of(file.path);
    for (const std::filesystem::path& mesh : meshes) {
      if (!place.empty() && place == place_of(mesh)) {
        throw refusal(file, "is the same file as " + mesh.string());
      }
    }
    if (!place.empty() && !places.insert(place).second) {
      throw refusal(file, "is given twice");
    }
  }
}

/// No rank has all of a mesh in pieces, nor of a file that ranks read by ranges.
void require_whole_mesh_of_pictures(const MeshRunSettings& settings, bool is_in_pieces) {
  const PipelineOptions& options = settings.pipeline;
  if (!settings.pictures.files.empty() && !options.gather && (is_in_pieces || !options.written())) {
    throw std::invalid_argument(
        "--picture over MPI ranks takes the whole mesh, in the memory of rank 0: give --gather as well");
  }
}

/// Options for ranks and pieces that nothing comes of where there are none.
void warn_of_options_for_ranks(const MeshRunSettings& settings, bool over_ranks, std::ostream& err) {
  const PipelineOptions& options = settings.pipeline;
  std::vector<std::string_view> names;
  if (options.single) {
    names.emplace_back("--single");
  }
  if (options.gather) {
    names.emplace_back("--gather");
  }
  if (options.partition) {
    names.emplace_back("--partition");
  }
  if (!over_ranks && !names.empty()) {
    print_warning(err, fmt::format("{} has no effect: it is for runs over MPI ranks", fmt::join(names, ", ")));
  }
}

/// The mesh of a step may not overwrite what steps are made of; that of a single one may, as elsewhere, its input.
void require_own_meshes(const PipelineOptions& options) {
  if (!options.deformation) {
    return;
  }
  std::vector<std::filesystem::path> sources = options.deformation->steps;
  std::vector<std::filesystem::path> meshes = meshes_of_series(options);
  if (options.deformation->is_series) {
    sources.push_back(options.input);
  } else {
    meshes.push_back(*options.output);
  }
  for (const std::filesystem::path& mesh : meshes) {
    std::error_code error;  // what does not exist is no other's file
    if (std::ranges::any_of(sources, [&](const std::filesystem::path& source) {
          return std::filesystem::equivalent(mesh, source, error);
        })) {
      throw std::invalid_argument("the mesh of a step would take the place of " + mesh.string() +
                                  ", which the steps are made of; give OUTPUT another name");
    }
  }
}

/// A place where no file can be made is told before the work, not after it.
void try_outputs(const MeshRunSettings& settings, bool over_ranks) {
  const PipelineOptions& options = settings.pipeline;
  require_use_of_format(options.format, {options.input, options.compared, options.written()});
  const bool is_in_pieces =
      names_parallel_file(options.input) || (options.written() && names_parallel_file(*options.written()));
  if (!over_ranks || !is_in_pieces) {
    require_known_formats(options);
  }
  if (over_ranks) {
    require_whole_mesh_of_pictures(settings, is_in_pieces);
  }
  if (const auto& target = options.written(); target && !is_standard_stream(*target)) {
    const OutputFile attempt(*target);
  }
  require_own_meshes(options);
  for (const std::filesystem::path& step : options.deformation.value_or(Deformation{}).steps) {
    if (std::error_code error; !std::filesystem::exists(step, error)) {
      throw ReadError(step,
                      "is to have displacements of the boundary, and there is no such file; nothing has been written");
    }
  }
  const std::vector<FileBeside> beside = files_beside(settings);
  require_each_once(beside, options);
  for (const FileBeside& file : beside) {
    require_own_file(file, options);
    const OutputFile attempt(file.path);
  }
}

/// More than it takes to make a report.
std::size_t report_bytes(const PipelineResult& result) {
  constexpr std::size_t of_all = std::size_t{4} << 20;
  constexpr std::size_t of_a_sweep = 4096;
  constexpr std::size_t of_a_region = 8192;
  constexpr std::size_t of_a_shown_vertex = 400;
  const std::size_t shown = result.picture ? result.picture->before.size() : 0;
  return shown * of_a_shown_vertex + of_all + (result.smoothing ? result.smoothing->history.size() * of_a_sweep : 0) +
         result.regions_before.size() * of_a_region;
}

/// What is drawn is written beside the mesh, as a report is.
PictureFile draw(const std::filesystem::path& path, const MeshRunSettings& settings, const PipelineResult& result) {
  if (!result.picture) {
    throw WriteError(path, "there is no picture of a mesh that no process has as a whole; --gather has rank 0 draw it");
  }
  PictureFileOptions options = settings.pictures.shown;
  options.threads = settings.pipeline.smoothing.threads;
  constexpr std::size_t of_all = std::size_t{64} << 20;
  constexpr std::size_t of_an_element = 16;
  require_host_memory(of_all + of_an_element * result.picture->elements.list().size());
  return picture_file(path, *result.picture, options);
}

/// How a gate went; of several steps the one that is furthest from it tells.
GateOutcome outcome_of(const Gate& gate, const PipelineResult& result) {
  if (result.deformation) {
    std::optional<GateOutcome> worst;
    for (const DeformedStep& step : result.deformation->steps) {
      const GateOutcome outcome = check_gate(gate, step.quality, step.quadratic, &step);
      worst = !worst || outcome.is_worse_than(*worst) ? outcome : worst;
    }
    return worst.value();
  }
  return result.after ? check_gate(gate, *result.after, result.quadratic_after)
                      : check_gate(gate, result.before, result.quadratic_before);
}

/// What a run leaves beside the mesh: its reports and pictures, and the table on standard output. It is all there, or
/// nothing is.
class RunOutputs {
 public:
  RunOutputs(const MeshRunSettings& settings, const CommandEnvironment& environment)
      : settings_(settings),
        environment_(environment),
        record_{environment.command, date_text(std::chrono::system_clock::now()), {}} {}
  RunOutputs(const RunOutputs&) = delete;
  RunOutputs& operator=(const RunOutputs&) = delete;
  /// Where not everything came into its place the old files are there again.
  ~RunOutputs() {
    for (WrittenAside& file : files_) {
      file.take_back();
    }
  }

  /// Writes the files under other names, then prints the table. Throws WriteError.
  void prepare(const PipelineResult& result) {
    is_prepared_ = true;
    for (const Gate& gate : settings_.gates) {
      record_.gates.push_back(outcome_of(gate, result));
    }
    write_files(result);
    if (settings_.verbosity != Verbosity::quiet) {
      print_table(result);
    }
  }

  /// Puts the files in their places.
  void place() {
    for (WrittenAside& file : files_) {
      file.commit();
    }
  }

  /// The mesh is in its place, too.
  void keep() { files_.clear(); }

  bool is_prepared() const { return is_prepared_; }
  const std::vector<GateOutcome>& gates() const { return record_.gates; }

  bool has_reader() const { return has_reader_; }

 private:
  /// All that fail are told; the last one is thrown.
  void write_files(const PipelineResult& result) {
    for (const std::filesystem::path& report : settings_.reports) {
      write(report, [&] {
        require_host_memory(report_bytes(result));
        return write_report_aside(report, settings_.pipeline, result, record_);
      });
    }
    for (const std::filesystem::path& picture : settings_.pictures.files) {
      write(picture, [&] {
        const PictureFile drawn = draw(picture, settings_, result);
        if (!drawn.note.empty() && settings_.verbosity != Verbosity::quiet) {
          print_note(environment_.err, picture.string() + ": " + drawn.note);
        }
        return write_report_text_aside(picture, drawn.bytes);
      });
    }
    if (failure_) {
      throw WriteError(failure_->first, failure_->second);
    }
  }

  template <class Write>
  void write(const std::filesystem::path& path, const Write& write_aside) {
    std::string reason;
    try {
      files_.push_back(write_aside());
      return;
    } catch (const WriteError& error) {
      reason = error.reason;
    } catch (const std::bad_alloc&) {
      reason = "cannot be written: not enough memory";
    }
    if (failure_) {
      print_error(environment_.err, WriteError(failure_->first, failure_->second).what());
    }
    failure_.emplace(path, reason + without_mesh());
  }

  /// What becomes of the mesh where these cannot be written.
  std::string without_mesh() const {
    const auto& mesh = settings_.pipeline.written();
    return mesh ? "; so " + shown_output(*mesh).string() + " is not written either" : "";
  }

  void print_table(const PipelineResult& result) {
    const PipelineOptions& options = settings_.pipeline;
    const bool is_verbose = settings_.verbosity == Verbosity::verbose;
    std::string text = text_report(options, result, is_verbose ? TextDetail::all : TextDetail::summary);
    if (is_verbose && (result.smoothing || result.region_names.size() > few_regions)) {
      text += region_table(result);
    }
    for (const std::filesystem::path& report : settings_.reports) {
      text += labelled_line("report:", report.string());
    }
    for (const std::filesystem::path& picture : settings_.pictures.files) {
      text += labelled_line("picture:", picture.string());
    }
    // A mesh on standard output has it for itself.
    const bool is_taken = options.written() && is_standard_stream(*options.written());
    try {
      has_reader_ = print_before_files(is_taken ? environment_.err : environment_.out, text);
    } catch (const WriteError& error) {
      throw WriteError("standard output", error.reason + without_mesh());
    }
  }

  const MeshRunSettings& settings_;
  const CommandEnvironment& environment_;
  RunRecord record_;
  std::vector<WrittenAside> files_;
  std::optional<std::pair<std::filesystem::path, std::string>> failure_;  ///< the last one, and why
  bool is_prepared_ = false;
  bool has_reader_ = true;  ///< the standard output
};

/// Runs the pipeline while it shows the progress. `outputs` are there when the mesh is.
PipelineResult run_watched(PipelineOptions options, Verbosity verbosity, RunOutputs& outputs,
                           const CommandEnvironment& environment) {
  std::optional<ProgressBar> bar;
  if (environment.terminal.stream != nullptr && verbosity == Verbosity::normal) {
    bar.emplace(environment.terminal, options.smoothing.max_sweeps);
  }
  options.beside.prepare = [&](const PipelineResult& result) {
    bar.reset();
    outputs.prepare(result);
  };
  options.beside.place = [&] { outputs.place(); };
  options.stage_started = [&bar](Stage stage) {
    if (bar) {
      bar->stage_started(stage);
    }
    return Progress::proceed;
  };
  options.warned = [&](const std::string& warning) {
    if (verbosity == Verbosity::quiet) {
      return;
    }
    if (bar) {
      bar->erase();
    }
    print_warning(environment.err, warning);
  };
  options.smoothing.progress = [&](const SweepRecord& record) {
    if (bar) {
      bar->sweep_done(record);
    }
    if (verbosity == Verbosity::verbose) {
      environment.err << sweep_line(record);  // at once: another line must not come in between
    }
    return Progress::proceed;
  };
  try {
    return environment.run(options);
  } catch (const MeshError& error) {
    throw ReadError(shown_input(options.input), error.what());
  } catch (const std::bad_alloc& error) {
    throw ReadError(
        shown_input(options.input),
        whose_memory(error) +
            "not enough memory for this mesh; use a machine with more, fewer threads (--threads 1), or a smaller mesh");
  }
}

}  // namespace

ExitCode run_on_mesh(MeshRunSettings settings, const CommandEnvironment& environment) {
  PipelineOptions& options = settings.pipeline;
  const Verbosity verbosity = settings.verbosity;
  options.smoothing.record_min_shape = verbosity == Verbosity::verbose || options.smoothing.target_quality.has_value();

  // Every rank is to know it; a job says it only where it is asked to, and so does standard output.
  options.size_ratio =
      std::ranges::any_of(settings.gates, &needs_size_ratio) || (!environment.over_ranks && !settings.reports.empty());

  options.picture = !settings.pictures.files.empty() || std::ranges::any_of(settings.reports, &shows_mesh);

  if (environment.follows) {
    environment.run(options);
    return ExitCode::done;
  }
  try_outputs(settings, environment.over_ranks);
  if (verbosity != Verbosity::quiet) {
    warn_of_options_for_ranks(settings, environment.over_ranks, environment.err);
    if (settings.pictures.files.empty() && !settings.pictures.effects.empty()) {
      print_warning(environment.err, fmt::format("{} has no effect: it is for pictures, which --picture FILE asks for",
                                                 fmt::join(settings.pictures.effects, ", ")));
    }
  }
  RunOutputs outputs(settings, environment);
  const PipelineResult result = run_watched(options, verbosity, outputs, environment);
  if (!outputs.is_prepared()) {
    outputs.prepare(result);
    outputs.place();
  }
  outputs.keep();
  if (verbosity != Verbosity::quiet) {
    if (const auto& written = settings.pipeline.written(); written && is_standard_stream(*written)) {
      environment.err << labelled_line("written:", shown_output(*written).string());
    }
    print_notes(result, verbosity, environment.err);
  }
  if (verbosity == Verbosity::verbose) {
    environment.err << timings_line(result.timings_ms);
  }
  ExitCode code = ExitCode::done;
  for (const GateOutcome& outcome : outputs.gates()) {
    if (!outcome.passed) {
      environment.err << gate_failure(outcome) << '\n';
      code = ExitCode::gate_failed;
    }
  }
  if (!outputs.has_reader()) {
    end_without_reader();
  }
  return code;
}

ExitCode run_alone(MeshRunSettings settings, const CommandEnvironment& environment, std::string_view what) {
  if (!environment.over_ranks) {
    return run_on_mesh(std::move(settings), environment);
  }
  if (settings.verbosity != Verbosity::quiet) {
    print_note(environment.err, std::string(what) + ": rank 0 does it, with the whole mesh");
  }
  CommandEnvironment alone = environment;
  alone.over_ranks = false;
  alone.run = &run_pipeline;
  return run_on_mesh(std::move(settings), alone);
}

}  // namespace trismooth
