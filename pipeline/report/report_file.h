// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "trismooth/mesh_io/bytes/file_content.h"
#include "trismooth/pipeline/pipeline.h"
#include "trismooth/pipeline/report/run_record.h"

namespace trismooth {

/// Checks that the path's extension names a report format, .json or .html (any case). Throws std::invalid_argument.
void require_report_extension(const std::filesystem::path& path);

/// Whether a report in the format that the path's extension names shows the mesh: PipelineOptions::picture is for it.
bool shows_mesh(const std::filesystem::path& path);

/// Writes the report of a run in the format that the path's extension names; it takes its place when it is committed.
/// Throws WriteError, std::invalid_argument for another extension.
WrittenAside write_report_aside(const std::filesystem::path& path, const PipelineOptions& options,
                                const PipelineResult& result, const RunRecord& record);

}  // namespace trismooth
