// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "trismooth/paper/experiment.h"

namespace trismooth::experiments {

/// The paper's figures redrawn, each as one SVG element that stands alone (see log_chart.h), with the paper's own
/// figures faintly beside what was measured. Every version that was measured is in them. Empty where nothing was.

/// Figure 3: the running time of Forms A and B over the size, one panel a layout. Id "figure-3".
std::string forms_figure(const ExperimentResult& result);

/// Figure 4: the speedup of the versions over the serial CPU version in Form A, one panel a layout. Id "figure-4".
std::string speedup_figure(const ExperimentResult& result);

}  // namespace trismooth::experiments
