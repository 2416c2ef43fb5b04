// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "trismooth/pipeline/cli/command_line.h"
#include "trismooth/pipeline/cli/exit_code.h"
#include "trismooth/pipeline/gates.h"
#include "trismooth/pipeline/picture/picture_file.h"

namespace trismooth {

/// How much a command says.
enum class Verbosity : std::uint8_t { quiet, normal, verbose };

/// The pictures that a run draws.
struct PictureSettings {
  std::vector<std::filesystem::path> files;
  PictureFileOptions shown;
  std::vector<std::string_view> effects;  ///< options that say what is shown: nothing comes of them without files
};

/// What the commands that run the pipeline on a mesh (smooth, deform, quality and compare) are told.
struct MeshRunSettings {
  PipelineOptions pipeline;
  std::vector<std::filesystem::path> reports;
  PictureSettings pictures;
  std::vector<Gate> gates;
  Verbosity verbosity = Verbosity::normal;
};

/// Runs the pipeline with progress and cancellation, prints the result, writes the reports and checks the gates.
/// Throws what run_pipeline() throws, WriteError for a report.
ExitCode run_on_mesh(MeshRunSettings settings, const CommandEnvironment& environment);

/// run_on_mesh() of what is not shared among ranks: of several the first one does it, and says so. `what`: "a mesh
/// follows its boundary in one process".
ExitCode run_alone(MeshRunSettings settings, const CommandEnvironment& environment, std::string_view what);

}  // namespace trismooth
