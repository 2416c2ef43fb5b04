#pragma once

#include <vector>

#include "support/accepted_files.h"

/// The part of accepted_files.h that is FreeFem's format.
namespace accepted_files {

void add_freefem(std::vector<AcceptedFile>& files);

}  // namespace accepted_files
