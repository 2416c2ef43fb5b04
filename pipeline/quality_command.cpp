#include <memory>

#include "trismooth/pipeline/mesh_run.h"
#include "trismooth/pipeline/option_parsing.h"
#include "trismooth/pipeline/subcommands.h"

namespace trismooth {

Subcommand add_quality_command(CLI::App& app, const CommandEnvironment& environment) {
  const auto settings = std::make_shared<MeshRunSettings>();
  CLI::App& command = *app.add_subcommand("quality", "Check a mesh and change nothing");
  add_parsed_option(command, "INPUT", "", "Mesh to read; its extension names the format",
                    [settings](const std::string& text) { settings->pipeline.input = text; })
      ->required();
  add_mesh_options(command, *settings);
  add_result_options(command, *settings);
  return {&command, [settings, &environment] { return run_on_mesh(*settings, environment); }};
}

}  // namespace trismooth
