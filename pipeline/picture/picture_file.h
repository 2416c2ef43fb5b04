// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "trismooth/base/box.h"
#include "trismooth/pipeline/picture/element_shades.h"
#include "trismooth/pipeline/picture/mesh_picture.h"

namespace trismooth {

/// What pictures in files show.
struct PictureFileOptions {
  PictureValue value;         ///< what elements are coloured by
  std::optional<Box> window;  ///< as people name places: longitudes and latitudes of a map; absent: all of the mesh
  int worst = 0;              ///< so many close-ups of the worst elements
  int threads = 0;            ///< 0: all
};

/// A picture as a file has it, and what is to be said of it.
struct PictureFile {
  std::string bytes;
  std::string note;  ///< may be empty
};

/// Checks that the path's extension names a format, .svg or .png (any case). Throws std::invalid_argument.
void require_picture_extension(const std::filesystem::path& path);

/// A window from its text, "x0,y0,x1,y1". Throws std::invalid_argument, also for an empty one.
Box picture_window(std::string_view text);

/// The picture of a mesh as it is now, in the format that the path's extension names. Throws std::invalid_argument for
/// another extension, and where the mesh has nothing of what is to be shown.
PictureFile picture_file(const std::filesystem::path& path, const MeshPicture& picture,
                         const PictureFileOptions& options);

}  // namespace trismooth
