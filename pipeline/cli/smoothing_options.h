// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "trismooth/smoothing/options.h"

namespace trismooth {

/// The options of the commands that smooth (smooth and deform), in their groups. The options set outlive the parsing.
/// `kept`: what becomes of layers, in the help.
void add_layers_option(CLI::App& command, SmoothingOptions& options, const std::string& kept);
/// What mean-ratio aims at. `usual_...`: what help says of the defaults.
void add_target_options(CLI::App& command, MeanRatioOptions& options, const std::string& usual_size_weight,
                        const std::string& usual_power);
/// When the sweeps end; at most so many as the options have now, by default.
void add_stop_options(CLI::App& command, SmoothingOptions& options);

}  // namespace trismooth
