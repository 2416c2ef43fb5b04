#pragma once

#include <vector>

#include "support/accepted_files.h"

namespace accepted_files {

/// Universal files: old and new data sets, groups, what other programs write around them.
void add_unv(std::vector<AcceptedFile>& files);

}  // namespace accepted_files
