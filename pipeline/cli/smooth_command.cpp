// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "trismooth/pipeline/cli/backend_choice.h"
#include "trismooth/pipeline/cli/mesh_options.h"
#include "trismooth/pipeline/cli/mesh_run.h"
#include "trismooth/pipeline/cli/option_parsing.h"
#include "trismooth/pipeline/cli/rank_job.h"
#include "trismooth/pipeline/cli/smoothing_options.h"
#include "trismooth/pipeline/cli/subcommands.h"
#include "trismooth/pipeline/cuda_or_cpu.h"
#include "trismooth/pipeline/cuda_support.h"

namespace trismooth {

/// Whether a step is done.
enum class Switch : std::uint8_t { on, off };

template <>
struct EnumText<Switch> {
  static constexpr std::string_view what = "setting";
  static constexpr std::array<std::pair<Switch, std::string_view>, 2> texts{{{Switch::on, "on"}, {Switch::off, "off"}}};
};

namespace {

struct SmoothSettings {
  MeshRunSettings run;
  BackendChoice backend = BackendChoice::automatic;
  std::vector<int> devices;  ///< by number; empty: the backend's choice
  Switch guard = Switch::on;
};

void add_algorithm_options(CLI::App& command, SmoothSettings& settings) {
  SmoothingOptions& options = settings.run.pipeline.smoothing;
  const char* const group = option_group::smoothing;
  add_enum_option(command, "--method", options.method, explained_texts<Method>())->group(group);
  add_enum_option(command, "--form", options.form,
                  "a: all moves from the positions before the sweep; b: moves see the neighbours already moved, which "
                  "needs fewer sweeps")
      ->group(group);
  add_enum_option(command, "--untangle", options.untangle,
                  "Before the sweeps, move vertices so that no element is inverted, where that can be done; auto: with "
                  "mean-ratio")
      ->group(group);
  add_enum_option(command, "--precision", options.precision, "Of the sweeps; checks are in double always")
      ->group(group);
  add_enum_option(command, "--guard", settings.guard,
                  "Put back moves that would leave an element invalid or below the worst of those touched")
      ->group(group);
}

void add_mean_ratio_options(CLI::App& command, PipelineOptions& pipeline) {
  add_target_options(command, pipeline.smoothing.mean_ratio, "1", "3 where the mean shape is 0.8 or more, else 2");
  add_parsed_option(command, "--size-array", "NAME",
                    "Array of the sizes to aim at, in place of those that elements have: edge lengths at points, or "
                    "areas of cells; only their relations count [none]",
                    [&pipeline](const std::string& text) { pipeline.size_array = text; })
      ->group(option_group::mean_ratio);
}

void add_slide_options(CLI::App& command, Sliding& slide) {
  const char* const group = "Sliding boundaries";
  add_enum_option(
      command, "--slide", slide.along,
      "Move vertices of boundaries and interfaces along them: on stretches that are straight to rounding, or "
      "also round bends, as far as --deviation allows")
      ->group(group);
  add_parsed_option(command, "--corner-angle", "DEGREES",
                    "A vertex where a line turns by more is a corner, which stays [30]",
                    [&slide](const std::string& text) { slide.corner_angle = parse_finite(text); })
      ->needs("--slide")
      ->group(group);
  add_parsed_option(
      command, "--deviation", "X",
      "With curves: how far a line may get from where it was, in edge lengths, 0 to 1; checked in the result [1e-3]",
      [&slide](const std::string& text) { slide.deviation = parse_finite(text); })
      ->needs("--slide")
      ->group(group);
  add_enum_option(command, "--curve", slide.curve,
                  "With curves: slide on the edges as they are, or on a smooth curve through their vertices")
      ->needs("--slide")
      ->group(group);
  command
      .add_flag("--slide-coincident", slide.coincident,
                "Vertices in the same place, as on the faces of a crack, slide together; else they stay")
      ->needs("--slide")
      ->group(group);
}

void add_time_limit_option(CLI::App& command, SmoothingOptions& options) {
  add_parsed_option(
      command, "--time-limit", "SECONDS",
      "Take no longer than this for the smoothing: sweeps end early enough for the never-worse check [none]",
      [&options](const std::string& text) { options.time_limit_seconds = parse_finite(text, 0); })
      ->group(option_group::stopping);
}

void add_device_options(CLI::App& command, SmoothSettings& settings) {
  SmoothingOptions& options = settings.run.pipeline.smoothing;
  add_enum_option(
      command, "--backend", settings.backend,
      fmt::format("Who runs the sweeps; auto: cuda, where this build has it, finds a device and {} vertices "
                  "or more are free; else cpu",
                  free_vertices_for_cuda))
      ->group(option_group::running);
  add_parsed_option(
      command, "--devices", "N,N,...",
      "CUDA devices to smooth on, by the numbers that `trismooth info` shows; several share the mesh out, and "
      "the result is the same. With --backend cuda, which may be left out [the first]",
      [&settings](const std::string& text) {
        settings.devices = parse_list(
            text, [](std::string_view number) { return parse_integer(number, 0, std::numeric_limits<int>::max()); });
      })
      ->group(option_group::running);
  add_parsed_option(
      command, "--partition", alternatives<Partition>(),
      "How the ranks of an MPI job share the mesh out; the result is the same. keep: as the pieces are, of "
      "one file ranges of it; bisect: halved again and again, across the longer side; metis: by METIS, "
      "where the build has it [keep, where there is a piece for each rank, else bisect]",
      [&settings](const std::string& text) {
        settings.run.pipeline.partition = parse_choice<Partition>(text);
        require_partition(*settings.run.pipeline.partition);
      })
      ->group(option_group::running);
  add_enum_option(command, "--topology", options.topology,
                  "Who finds the neighbours; the result is the same. auto: the GPU where it smooths, else OpenMesh "
                  "halfedges up to 16 million elements; host: the list of elements, in less time and memory")
      ->group(option_group::running);
  const char* const group = "Running on CUDA (the CPU accepts and ignores them, except soa, unordered)";
  add_enum_option(command, "--layout", options.layout,
                  "Of single-block and cdp: an array of structures, or a structure of arrays")
      ->group(group);
  add_enum_option(command, "--execution", options.execution,
                  "resident: by all of the GPU, the fastest; single-block, cdp: the paper's versions, by one block and "
                  "by CUDA dynamic parallelism, of smart and laplacian only")
      ->group(group);
  add_enum_option(command, "--order", options.order,
                  "Of form b; unordered, as the threads happen to run: the paper's, not reproducible, for single-block "
                  "and cdp only")
      ->group(group);
}

void add_field_options(CLI::App& command, PipelineOptions& options) {
  const char* const group = "Fields";
  add_parsed_option(command, "--fields", alternatives<Fields>(),
                    "Values at points where vertices move: keep them, or take those that the mesh had at the new place "
                    "[keep, but depths and the like are interpolated]",
                    [&options](const std::string& text) { options.fields = parse_choice<Fields>(text); })
      ->group(group);
  constexpr bool repeatable = true;
  add_parsed_option(
      command, "--field-array", "PATTERN",
      "Point arrays to interpolate, by name: * is any characters, ? is one. Repeatable [with --fields interpolate: "
      "all]",
      [&options](const std::string& text) { options.field_arrays.push_back(text); }, repeatable)
      ->group(group);
}

ExitCode run_smooth(SmoothSettings settings, const CommandEnvironment& environment) {
  PipelineOptions& options = settings.run.pipeline;
  options.smoothing.guard = settings.guard == Switch::on;
  options.smoothing.validate();
  options.slide.validate();
  const CudaSupport cuda = environment.cuda();
  const CudaOrCpu automatic(cuda);
  std::unique_ptr<Backend> on_devices;
  if (environment.over_ranks && !settings.devices.empty()) {
    throw std::invalid_argument("'--devices' is for one process: over MPI ranks each takes a device of its own");
  }
  if (environment.over_ranks) {
    choose_backend_of_ranks(settings.backend, cuda, options.smoothing);
  } else if (!settings.devices.empty()) {
    on_devices = choose_devices(settings.devices, settings.backend, cuda, options.smoothing);
  } else {
    choose_backend(settings.backend, cuda, automatic, options.smoothing);
  }
  return run_on_mesh(std::move(settings.run), environment);
}

}  // namespace

Subcommand add_smooth_command(CLI::App& app, const CommandEnvironment& environment) {
  const auto settings = std::make_shared<SmoothSettings>();
  PipelineOptions& options = settings->run.pipeline;
  CLI::App& command = *app.add_subcommand("smooth", "Check a mesh, smooth it, check it again and write it");
  add_parsed_option(command, "INPUT", "",
                    "Mesh to read, - for standard input; its extension and content show the format",
                    [&options](const std::string& text) { options.input = text; })
      ->required();
  add_parsed_option(command, "OUTPUT", "",
                    "Mesh to write, - for standard output; may be INPUT. An old file survives any failure",
                    [&options](const std::string& text) { options.output = text; })
      ->required();
  add_algorithm_options(command, *settings);
  add_layers_option(command, options.smoothing, "held");
  add_mean_ratio_options(command, options);
  add_slide_options(command, options.slide);
  add_stop_options(command, options.smoothing);
  add_time_limit_option(command, options.smoothing);
  add_mesh_options(command, settings->run);
  add_field_options(command, options);
  add_device_options(command, *settings);
  add_result_options(command, settings->run);
  add_piece_options(command, settings->run);
  add_annotations_options(command, settings->run);
  constexpr bool runs_pipeline = true;
  return {&command, [settings, &environment] { return run_smooth(*settings, environment); }, runs_pipeline};
}

}  // namespace trismooth
