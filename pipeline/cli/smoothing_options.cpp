// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/cli/smoothing_options.h"

#include <cstdint>

#include <fmt/format.h>

#include "trismooth/pipeline/cli/mesh_options.h"
#include "trismooth/pipeline/cli/option_parsing.h"

namespace trismooth {

void add_layers_option(CLI::App& command, SmoothingOptions& options, const std::string& kept) {
  add_enum_option(command, "--layers", options.layers,
                  "Layers of flat elements with angles near 90 degrees, at walls and in thin insulation. auto: " +
                      kept + "; keep: all that is flat in one direction is; smooth: moved as all others")
      ->group(option_group::smoothing);
}

void add_target_options(CLI::App& command, MeanRatioOptions& options, const std::string& usual_size_weight,
                        const std::string& usual_power) {
  add_parsed_option(
      command, "--size-weight", "X",
      "How much the sizes of elements count beside their shapes; 0: not at all [" + usual_size_weight + "]",
      [&options](const std::string& text) { options.size_weight = parse_finite(text, 0); })
      ->group(option_group::mean_ratio);
  add_parsed_option(
      command, "--power", "P",
      "Of 1/shape in the energy, 1 to 8; the higher, the more the worst elements count [" + usual_power + "]",
      [&options](const std::string& text) { options.power = static_cast<int>(parse_integer(text, 1, 8)); })
      ->group(option_group::mean_ratio);
  add_enum_option(command, "--target", options.target,
                  "Shapes to aim at; input-shape: as flat as the edges nearby are, for layers that are flat on purpose")
      ->group(option_group::mean_ratio);
}

void add_stop_options(CLI::App& command, SmoothingOptions& options) {
  add_parsed_option(
      command, "--max-sweeps", "N", fmt::format("At most N sweeps; 0: no limit [{}]", options.max_sweeps),
      [&options](const std::string& text) { options.max_sweeps = parse_integer(text, std::int64_t{0}, INT64_MAX); })
      ->group(option_group::stopping);
  add_parsed_option(command, "--tolerance", "X",
                    "Stop when no vertex moves by more than X of its edge length; 0: only when none moves [1e-6]",
                    [&options](const std::string& text) { options.tolerance = parse_finite(text, 0); })
      ->group(option_group::stopping);
  add_parsed_option(command, "--target-quality", "X", "Stop when the smallest shape of all elements reaches X [none]",
                    [&options](const std::string& text) { options.target_quality = parse_finite(text); })
      ->group(option_group::stopping);
}

}  // namespace trismooth
