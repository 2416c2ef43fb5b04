#pragma once

#include <vector>

#include "support/accepted_files.h"

namespace accepted_files {

/// Adds files of every dialect of SU2's meshes.
void add_su2(std::vector<AcceptedFile>& files);

}  // namespace accepted_files
