#pragma once

#include "trismooth/pipeline/pipeline.h"

namespace trismooth {

/// Throws std::invalid_argument, naming the first, for options that a mesh in pieces does not have, or not yet.
void require_piece_options(const PipelineOptions& options);

}  // namespace trismooth
