#pragma once

#include <vector>

#include "support/accepted_files.h"

/// The part of accepted_files.h that is Medit's format.
namespace accepted_files {

void add_medit(std::vector<AcceptedFile>& files);

}  // namespace accepted_files
