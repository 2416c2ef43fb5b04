#pragma once

#include <vector>

#include "support/accepted_files.h"

namespace accepted_files {

/// Decks of Nastran: all field formats, as solvers and preprocessors write them.
void add_nastran(std::vector<AcceptedFile>& files);

}  // namespace accepted_files
