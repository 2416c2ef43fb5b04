// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace trismooth {

struct MeshRunSettings;

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

}  // namespace trismooth
