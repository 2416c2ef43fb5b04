#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "trismooth/mesh_io/bytes/output_file.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/pipeline/cli/option_parsing.h"
#include "trismooth/pipeline/cli/subcommands.h"
#include "trismooth/pipeline/cli/terminal_line.h"
#include "trismooth/pipeline/generate/random_document.h"
#include "trismooth/pipeline/generate/random_mesh.h"
#include "trismooth/pipeline/report/labelled_line.h"

namespace trismooth {

namespace {

struct GenerateSettings {
  std::filesystem::path output;
  std::int64_t vertices = 0;
  std::uint64_t seed = 1;
  RandomMeshOptions options;
};

/// What cannot be a mesh file, or cannot be made, is told before the work, not after it.
void try_output(const std::filesystem::path& output) {
  output_format(output);
  const OutputFile attempt(output);
}

ExitCode generate(const GenerateSettings& settings, const CommandEnvironment& environment) {
  try_output(settings.output);
  std::optional<TerminalLine> line;
  const auto show = [&](std::string_view stage) {
    if (line) {
      line->draw({std::string(stage), " ..."});
    }
  };
  if (environment.terminal.stream != nullptr) {
    line.emplace(environment.terminal);
  }
  show("making the mesh");
  const RandomMesh mesh = random_delaunay_mesh(settings.vertices, settings.seed, settings.options);
  show("writing");
  write_mesh(settings.output, document_of(mesh));
  line.reset();
  environment.out << labelled_line("generated:", fmt::format("{} vertices, {} triangles, seed {}", mesh.points.size(),
                                                             mesh.triangles.size(), settings.seed))
                  << labelled_line("written:", settings.output.string());
  return ExitCode::done;
}

ExitCode run_generate(const GenerateSettings& settings, const CommandEnvironment& environment) {
  try {
    return generate(settings, environment);
  } catch (const std::bad_alloc&) {
    throw WriteError(settings.output, fmt::format("not enough memory to make a mesh of {} vertices; use a machine with "
                                                  "more, or fewer vertices",
                                                  settings.vertices));
  }
}

}  // namespace

Subcommand add_generate_command(CLI::App& app, const CommandEnvironment& environment) {
  const auto settings = std::make_shared<GenerateSettings>();
  CLI::App& command = *app.add_subcommand("generate", "Make a random Delaunay mesh of the unit square");
  add_parsed_option(command, "OUTPUT", "", "Mesh to write; its extension names the format",
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
  add_enum_option(
      command, "--boundary", settings->options.boundary,
      "random: the hull of the points, a few long edges, the paper's data; resolved: the square, with edges "
      "as long as those inside");
  return {&command, [settings, &environment] { return run_generate(*settings, environment); }};
}

}  // namespace trismooth
