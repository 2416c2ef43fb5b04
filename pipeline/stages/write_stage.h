// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/data_array.h"
#include "trismooth/mesh_io/mesh_output.h"

namespace trismooth {

struct RunState;

/// Writes the mesh to `path`, where it comes to be with the commit, with annotations where they are wanted and the
/// format takes them. What is lost is among the losses. Throws WriteError.
WrittenAside write_output(RunState& run, const std::filesystem::path& path, bool annotate);

/// The annotations of the mesh as it is now.
AddedArrays annotations_of(RunState& run);

/// The metrics that annotations show, of the mesh as it is now.
std::vector<DataArray> metrics_of_cells(RunState& run, std::string_view suffix = {});

}  // namespace trismooth
