#pragma once

#include <vector>

#include "support/accepted_files.h"

namespace accepted_files {

/// The part of accepted_files.h that is Abaqus and CalculiX.
void add_inp(std::vector<AcceptedFile>& files);

}  // namespace accepted_files
