// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "support/scratch_folder.h"

/// Work whose input has a size, and which is to grow no faster than that.
struct GrowthCase {
  std::string name;
  int size;  ///< that is measured, and four times that
  /// Makes the input of a size and answers the work on it, which alone is counted.
  std::function<std::function<void()>(int size, const ScratchFolder& folder)> prepare;
};

/// Files of every format through the program.
std::vector<GrowthCase> file_cases();

/// Files of the formats with groups and names: what they may have many of.
std::vector<GrowthCase> fem_file_cases();

/// Flat arrays through the library.
std::vector<GrowthCase> flat_array_cases();
