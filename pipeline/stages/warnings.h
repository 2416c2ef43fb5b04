// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "trismooth/smoothing/method.h"

namespace trismooth {

class StagedMesh;
struct LocalFrame;
struct PipelineOptions;
struct PipelineResult;
struct RunContext;
struct SmoothingResult;

/// What the user should know of what was read: a file of vertices to hold that names none.
void warn_of_input(RunContext& run);

/// What the user should know before the smoothing: what single precision loses, options that the method takes no notice
/// of, a boundary that is too coarse, layers that are smoothed as all else. Collective where the mesh is in pieces.
void warn_before_smoothing(StagedMesh& mesh);

/// Empty where the method, and the way of sliding, take notice of all options.
std::string warning_of_options_without_effect(const PipelineOptions& options);

/// What is to be said of a result of that method in which elements are inverted, or triangles of six nodes not valid,
/// with the way out.
std::vector<std::string> warnings_of_invalid(const PipelineResult& result);

/// That the quality which was asked for was not reached; empty where it was, or none was asked for.
std::string note_of_missed_target(const PipelineOptions& options, const PipelineResult& result);

/// What is to be said of a mesh that has not followed its boundary as it should, with the way out.
std::vector<std::string> warnings_of_deformation(const PipelineResult& result);

/// Throws std::invalid_argument where the mesh is to follow its boundary, and something is asked for that it then does
/// not have.
void check_deformation(const PipelineOptions& options);

/// What to say where annotations of these names are in the output, made by an earlier run.
std::string note_of_dropped_annotations(std::span<const std::string> names);

/// After the smoothing: folds that the never-worse check put back, and sizes so far from those of the mesh that nothing
/// moved.
void warn_of_folds_put_back(RunContext& run, const SmoothingResult& smoothing);
void warn_of_sizes_out_of_reach(RunContext& run, const SmoothingResult& smoothing);

/// Whether the mesh got smaller, since a vertex came back from far away. The guard has judged it in the frame of the
/// input, so the report does too: in a frame of its own, elements would look worse of which the guard could see nothing
/// beside that vertex. Local.
bool has_shrunk(const LocalFrame& input, const LocalFrame& result);

/// Where it shrank so far that there may be such elements: with the way out. Local.
void warn_of_shrinking(RunContext& run, const LocalFrame& input, const LocalFrame& result);

}  // namespace trismooth
