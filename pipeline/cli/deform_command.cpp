// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "trismooth/mesh_io/parallel_file.h"
#include "trismooth/pipeline/cli/interrupt.h"
#include "trismooth/pipeline/cli/mesh_options.h"
#include "trismooth/pipeline/cli/mesh_run.h"
#include "trismooth/pipeline/cli/option_parsing.h"
#include "trismooth/pipeline/cli/smoothing_options.h"
#include "trismooth/pipeline/cli/subcommands.h"
#include "trismooth/smoothing/moving_mesh.h"

namespace trismooth {

namespace {

void add_displacement_options(CLI::App& command, Deformation& deformation) {
  const char* const group = "Where the boundary goes";
  add_parsed_option(command, "--displacement", "NAME",
                    "Point array of the displacements, vectors in the mesh's unit: of INPUT, or of the files below; or "
                    "the beginning of names of arrays of one number that end in x, y and perhaps z (disp_x, disp_y). "
                    "Those of vertices that are held are obeyed",
                    [&deformation](const std::string& text) { deformation.array = text; })
      ->group(group);
  CLI::Option* const file = add_parsed_option(
      command, "--displacement-file", "FILE",
      "A mesh on the same boundary that has the array, or a text (.csv, .txt) of lines VERTEX, DX, DY",
      [&deformation](const std::string& text) { deformation.steps = {text}; });
  file->group(group);
  command
      .add_option(
          "--steps",
          [&deformation](const CLI::results_t& files) {
            deformation.steps.assign(files.begin(), files.end());
            deformation.is_series = true;
            return true;
          },
          "Such a file for each step; OUTPUT gets the number of the step: out.vtu is out_1.vtu and on, out_001.vtu "
          "where there are hundreds. All displacements are from INPUT. Stands last")
      ->option_text("FILE...")
      ->expected(1, CLI::detail::expected_max_vector_size)
      ->allow_extra_args()
      ->excludes(file)
      ->group(group);
  command
      .add_flag("--displacement-labels", deformation.labels,
                "Vertices in texts are the numbers that the mesh file itself gives them [rows, which count from 0]")
      ->group(group);
  add_enum_option(
      command, "--start", deformation.start,
      "Where each step starts. reference: at INPUT, so that a step depends on its boundary alone; previous: "
      "at the last step, in less time, and the result depends on the path")
      ->group(group);
}

ExitCode run_deform(MeshRunSettings settings, const CommandEnvironment& environment) {
  const PipelineOptions& options = settings.pipeline;
  options.smoothing.validate();
  if (options.deformation->array.empty() && options.deformation->steps.empty()) {
    throw std::invalid_argument(
        "nothing says where the boundary goes: give --displacement NAME, --displacement-file FILE or --steps FILE...");
  }
  if (options.deformation->is_series) {
    // Asked now and then while a step is made.
    settings.pipeline.smoothing.cancel = [] {
      end_where_interrupted();
      return false;
    };
  }
  return run_alone(std::move(settings), environment, "a mesh follows its boundary in one process");
}

}  // namespace

Subcommand add_deform_command(CLI::App& app, const CommandEnvironment& environment) {
  const auto settings = std::make_shared<MeshRunSettings>();
  PipelineOptions& options = settings->pipeline;
  options.smoothing = moving_options();
  options.deformation.emplace();
  CLI::App& command = *app.add_subcommand("deform", "Have a mesh follow its boundary, which has moved, and write it");
  add_parsed_option(command, "INPUT", "",
                    "Mesh to start from, whose shapes and sizes are aimed at; - for standard input",
                    [&options](const std::string& text) { options.input = text; })
      ->required();
  add_parsed_option(command, "OUTPUT", "", "Mesh to write, - for standard output. An old file survives any failure",
                    [&options](const std::string& text) { options.output = text; })
      ->required();
  add_displacement_options(command, *options.deformation);
  add_layers_option(command, options.smoothing, "carried along as they are");
  add_target_options(command, options.smoothing.mean_ratio, "0.3", "8");
  add_stop_options(command, options.smoothing);
  add_hold_options(command, *settings);
  add_result_options(command, *settings);
  add_annotations_options(command, *settings);
  return {&command, [settings, &environment] { return run_deform(*settings, environment); }};
}

}  // namespace trismooth
