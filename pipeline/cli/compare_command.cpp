// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <string>

#include "trismooth/pipeline/cli/mesh_options.h"
#include "trismooth/pipeline/cli/mesh_run.h"
#include "trismooth/pipeline/cli/option_parsing.h"
#include "trismooth/pipeline/cli/subcommands.h"

namespace trismooth {

Subcommand add_compare_command(CLI::App& app, const CommandEnvironment& environment) {
  const auto settings = std::make_shared<MeshRunSettings>();
  PipelineOptions& options = settings->pipeline;
  CLI::App& command =
      *app.add_subcommand("compare", "Compare two meshes of the same elements: what moved, what got better or worse");
  add_parsed_option(command, "A", "",
                    "Mesh to compare with, as it was before; - for standard input. Regions, and what is held, are its "
                    "own",
                    [&options](const std::string& text) { options.input = text; })
      ->required();
  add_parsed_option(command, "B", "",
                    "The mesh after, of the same points and elements, in any format; - for standard input. Gates are "
                    "judged on it",
                    [&options](const std::string& text) { options.compared = text; })
      ->required();
  add_mesh_options(command, *settings);
  add_result_options(command, *settings);
  return {&command,
          [settings, &environment] { return run_alone(*settings, environment, "meshes are compared in one process"); }};
}

}  // namespace trismooth
