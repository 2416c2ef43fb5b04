// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include <CLI/CLI.hpp>

#include "trismooth/pipeline/cli/command_line.h"
#include "trismooth/pipeline/cli/exit_code.h"
#include "trismooth/pipeline/gates.h"

namespace trismooth {

/// How much a command says.
enum class Verbosity : std::uint8_t { quiet, normal, verbose };

/// What the commands that run the pipeline on a mesh (smooth, deform and quality) are told.
struct MeshRunSettings {
  PipelineOptions pipeline;
  std::vector<std::filesystem::path> reports;
  std::vector<Gate> gates;
  Verbosity verbosity = Verbosity::normal;
};

/// The groups that help lists these options in.
namespace option_group {
inline constexpr const char* constraints = "Regions and fixed vertices";
inline constexpr const char* coordinates = "Coordinates";
inline constexpr const char* smoothing = "Smoothing";
inline constexpr const char* mean_ratio = "Method mean-ratio";
inline constexpr const char* stopping = "Stopping";
inline constexpr const char* running = "Running";
inline constexpr const char* results = "Results";
}  // namespace option_group

/// The options that these commands share, in their groups. `settings` must outlive the parsing. Those of what is held
/// are among those of the mesh.
void add_hold_options(CLI::App& command, MeshRunSettings& settings);
void add_mesh_options(CLI::App& command, MeshRunSettings& settings);
void add_piece_options(CLI::App& command, MeshRunSettings& settings);
void add_result_options(CLI::App& command, MeshRunSettings& settings);
/// --annotate of a command that moves vertices, and what it shows.
void add_annotations_options(CLI::App& command, MeshRunSettings& settings);
void add_annotated_metrics_option(CLI::App& command, MeshRunSettings& settings);

/// Runs the pipeline with progress and cancellation, prints the result, writes the reports and checks the gates.
/// Throws what run_pipeline() throws, WriteError for a report.
ExitCode run_on_mesh(MeshRunSettings settings, const CommandEnvironment& environment);

}  // namespace trismooth
