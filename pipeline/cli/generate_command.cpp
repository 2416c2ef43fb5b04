// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/bytes/output_file.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_output.h"
#include "trismooth/mesh_io/standard_streams.h"
#include "trismooth/pipeline/cli/format_option.h"
#include "trismooth/pipeline/cli/option_parsing.h"
#include "trismooth/pipeline/cli/output_attempts.h"
#include "trismooth/pipeline/cli/subcommands.h"
#include "trismooth/pipeline/cli/terminal_line.h"
#include "trismooth/pipeline/generate/random_document.h"
#include "trismooth/pipeline/generate/random_mesh.h"
#include "trismooth/pipeline/report/labelled_line.h"

namespace trismooth {

namespace {

struct GenerateSettings {
  std::filesystem::path output;
  std::optional<FileFormat> format;
  std::int64_t vertices = 0;
  std::uint64_t seed = 1;
  bool quiet = false;
  RandomMeshOptions options;
};

/// What cannot be a mesh file, or cannot be made, is told before the work, not after it.
void try_output(const GenerateSettings& settings) {
  if (is_standard_stream(settings.output) && !settings.format) {
    throw std::invalid_argument("'-' has no extension to say what to write; --format NAME says it");
  }
  require_use_of_format(settings.format, {settings.output});
  output_format(settings.output, std::nullopt, settings.format);
  if (!is_standard_stream(settings.output)) {
    const OutputFile attempt(settings.output);
  }
}

ExitCode generate(const GenerateSettings& settings, const CommandEnvironment& environment) {
  try_output(settings);
  std::optional<TerminalLine> line;
  const auto show = [&](std::string_view stage) {
    if (line) {
      line->draw({std::string(stage), " ..."});
    }
  };
  if (environment.terminal.stream != nullptr && !settings.quiet) {
    line.emplace(environment.terminal);
  }
  show("making the mesh");
  const RandomMesh mesh = random_delaunay_mesh(settings.vertices, settings.seed, settings.options);
  show("writing");
  WrittenAside written = write_mesh_aside(settings.output, document_of(mesh), {}, FileOptions{1, settings.format});
  line.reset();
  bool has_reader = true;
  if (!settings.quiet) {
    std::ostream& results = is_standard_stream(settings.output) ? environment.err : environment.out;
    std::vector<std::filesystem::path> files = written.others(settings.output);
    files.insert(files.begin(), shown_output(settings.output));
    const std::string text =
        labelled_line("generated:", fmt::format("{} vertices, {} triangles, seed {}", mesh.points.size(),
                                                mesh.triangles.size(), settings.seed)) +
        labelled_line("written:", list_text(files, [](const std::filesystem::path& file) { return file.string(); }));
    has_reader = print_before_files(results, text);
  }
  written.commit();
  if (!has_reader) {
    end_without_reader();
  }
  return ExitCode::done;
}

ExitCode run_generate(const GenerateSettings& settings, const CommandEnvironment& environment) {
  try {
    return generate(settings, environment);
  } catch (const std::bad_alloc&) {
    throw WriteError(shown_output(settings.output),
                     fmt::format("not enough memory to make a mesh of {} vertices; use a machine with "
                                 "more, or fewer vertices",
                                 settings.vertices));
  }
}

}  // namespace

Subcommand add_generate_command(CLI::App& app, const CommandEnvironment& environment) {
  const auto settings = std::make_shared<GenerateSettings>();
  CLI::App& command = *app.add_subcommand("generate", "Make a random Delaunay mesh of the unit square");
  add_parsed_option(command, "OUTPUT", "", "Mesh to write, - for standard output; its extension names the format",
                    [settings](const std::string& text) { settings->output = text; })
      ->required();
  add_parsed_option(command, "--vertices", "N",
                    "Number of vertices, with K and M for thousands and millions, at least 4; points are uniformly "
                    "random",
                    [settings](const std::string& text) {
                      settings->vertices = parse_count(text, least_random_mesh_vertices, max_random_mesh_vertices);
                    })
      ->required();
  add_parsed_option(command, "--seed", "S", "Another seed gives another mesh, the same seed the same [1]",
                    [settings](const std::string& text) {
                      settings->seed = parse_integer(text, std::uint64_t{0}, std::numeric_limits<std::uint64_t>::max());
                    });
  add_format_option(command, settings->format);
  add_enum_option(
      command, "--boundary", settings->options.boundary,
      "random: the hull of the points, a few long edges, the paper's data; resolved: the square, with edges "
      "as long as those inside");
  command.add_flag("--quiet,-q", settings->quiet, "Print errors only");
  return {&command, [settings, &environment] { return run_generate(*settings, environment); }};
}

}  // namespace trismooth
