// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "trismooth/paper/experiment.h"

namespace trismooth::experiments {

/// "[#####---------] 41 %", "  100K: GPU-AoS, Form A", ", run 3 of 7": the pieces of a TerminalLine. ASCII.
std::vector<std::string> progress_pieces(const ExperimentProgress& progress, int runs);

}  // namespace trismooth::experiments
