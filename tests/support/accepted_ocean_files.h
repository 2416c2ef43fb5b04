#pragma once

#include <vector>

#include "support/accepted_files.h"

namespace accepted_files {

/// Adds files of the formats of coasts and rivers: ADCIRC and 2dm.
void add_ocean_files(std::vector<AcceptedFile>& files);

}  // namespace accepted_files
