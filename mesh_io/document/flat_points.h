// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// For formats that hold x and y alone: throws WriteError unless all points of the document have one z, to within 1e-6
/// of their extent along x and y. `format` is the format's name in the message. Complexity: linear.
void require_flat_points(const std::filesystem::path& path, std::string_view format, const MeshDocument& document);

/// The sentence on z of points that are flat, or of any others, at most one: "SU2 holds x and y only: z, 2.5, is not
/// written". None where z is 0 everywhere.
std::vector<std::string> describe_lost_z(std::string_view format, const MeshDocument& document);

}  // namespace trismooth
