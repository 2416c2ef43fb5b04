// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

#include "trismooth/pipeline/cli/mesh_run.h"

namespace trismooth {

/// --picture, and what it shows. `pictures` must outlive the parsing.
void add_picture_options(CLI::App& command, PictureSettings& pictures);

}  // namespace trismooth
