#pragma once

#include <vector>

#include "support/accepted_files.h"

namespace accepted_files {

/// Meshes of Triangle, their two files in one text (see one_file_codec.h).
void add_triangle(std::vector<AcceptedFile>& files);

}  // namespace accepted_files
