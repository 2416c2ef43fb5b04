// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "trismooth/pipeline/gates.h"
#include "trismooth/pipeline/pipeline.h"

namespace trismooth {

/// What a run was asked for and did, as HTML tables of its page: the steps of a mesh that follows its boundary, the
/// gates, the options of a smoothing, what became of it, the comparison of two meshes, the times.
std::string html_steps_table(const DeformationResult& deformation);
std::string html_gates_table(const std::vector<GateOutcome>& gates);
std::string html_options_table(const PipelineOptions& options, const SmoothingResult& smoothing, Topology topology);
/// Of a mesh that was smoothed.
std::string html_outcome_table(const PipelineResult& result);
/// Of meshes that were compared.
std::string html_comparison_table(const PipelineResult& result);
std::string html_timings_table(const PipelineTimings& timings);

}  // namespace trismooth
