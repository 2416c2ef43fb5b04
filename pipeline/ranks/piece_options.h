#pragma once

#include <string_view>

#include "trismooth/pipeline/pipeline.h"

namespace trismooth {

/// The option that needs the whole mesh on one rank; empty where none does.
std::string_view what_needs_whole_mesh(const PipelineOptions& options);

/// Throws std::invalid_argument, naming the first, for options that a mesh in pieces does not have, or not without
/// PipelineOptions::gather, and for an output that is none for it. Throws WriteError for one of no known format.
void require_piece_options(const PipelineOptions& options);

}  // namespace trismooth
