// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "trismooth/pipeline/pipeline.h"
#include "trismooth/pipeline/report/run_record.h"

namespace trismooth {

/// The report of a run as one HTML page for people: the mesh, where the run has kept a picture of it
/// (PipelineOptions::picture), the quality before and after, the shape histogram, the convergence, the worst elements,
/// what was done and how long it took. The page needs no other file and no network, and prints well; the mesh alone
/// needs a script. It is well-formed XML, too; text from files is escaped.
std::string html_report(const PipelineOptions& options, const PipelineResult& result, const RunRecord& record = {});

}  // namespace trismooth
