// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "trismooth/mesh_io/file_format.h"
#include "trismooth/mesh_io/standard_streams.h"
#include "trismooth/pipeline/cli/mesh_options.h"
#include "trismooth/pipeline/cli/mesh_run.h"
#include "trismooth/pipeline/cli/option_parsing.h"
#include "trismooth/pipeline/cli/subcommands.h"

namespace trismooth {

namespace {

/// What is asked for is arrays: a file without them would be no answer.
void require_arrays(const std::filesystem::path& path) {
  if (path.string().starts_with('-') && !is_standard_stream(path)) {
    throw std::invalid_argument("takes the name of a file; '" + path.string() + "' is an option");
  }
  const auto format = format_of(path);
  if (!format || has_arrays(*format)) {
    return;  // an unknown extension is told where the file is to be made
  }
  std::string formats;
  for (const FileFormat other : all_formats()) {
    if (has_arrays(other) && is_available(other)) {
      formats.append(formats.empty() ? "" : ", ").append(extensions_of(other).front());
    }
  }
  throw std::invalid_argument("'" + path.string() + "' can hold no arrays; formats that do are " + formats);
}

}  // namespace

Subcommand add_quality_command(CLI::App& app, const CommandEnvironment& environment) {
  const auto settings = std::make_shared<MeshRunSettings>();
  CLI::App& command = *app.add_subcommand("quality", "Check a mesh and change nothing");
  add_parsed_option(command, "INPUT", "",
                    "Mesh to read, - for standard input; its extension and content show the format",
                    [settings](const std::string& text) { settings->pipeline.input = text; })
      ->required();
  add_mesh_options(command, *settings);
  add_result_options(command, *settings);
  add_piece_options(command, *settings);
  add_parsed_option(command, "--annotate", "OUT",
                    "Write the mesh with arrays that show what was found: trismooth:shape (cells) and trismooth:fixed "
                    "(points)",
                    [settings](const std::string& text) {
                      require_arrays(text);
                      settings->pipeline.annotated = text;
                    })
      ->group(option_group::results);
  add_annotated_metrics_option(command, *settings);
  constexpr bool runs_pipeline = true;
  return {&command, [settings, &environment] { return run_on_mesh(*settings, environment); }, runs_pipeline};
}

}  // namespace trismooth
