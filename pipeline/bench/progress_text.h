#pragma once

#include <string>

#include "trismooth/pipeline/bench/experiment.h"

namespace trismooth::bench {

/// "[#####---------] 41 %  100K: GPU-AoS, Form A, run 3 of 7". ASCII.
std::string progress_text(const ExperimentProgress& progress, int runs);

}  // namespace trismooth::bench
