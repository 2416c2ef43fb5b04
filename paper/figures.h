// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "trismooth/paper/experiment.h"
#include "trismooth/paper/log_chart.h"

namespace trismooth::experiments {

/// The paper's figures redrawn, each as one SVG element that stands alone (see log_chart.h), with the paper's own
/// figures faintly beside what was measured. Every version that was measured is in them. Empty where nothing was.
/// In a column their ids end in "-narrow".

/// Figure 3: the running time of Forms A and B over the size, one panel a layout. Id "figure-3".
std::string forms_figure(const ExperimentResult& result, Arrangement arrangement = Arrangement::row);

/// Figure 4: the speedup of the versions over the serial CPU version in Form A, one panel a layout. Id "figure-4".
std::string speedup_figure(const ExperimentResult& result, Arrangement arrangement = Arrangement::row);

}  // namespace trismooth::experiments
