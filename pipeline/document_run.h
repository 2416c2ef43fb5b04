// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/pipeline/pipeline.h"

namespace trismooth {

/// run_pipeline() of a mesh that is in memory already: all stages but reading. `options.input` names the mesh in
/// messages.
PipelineResult run_pipeline_on(MeshDocument document, const PipelineOptions& options);

/// smooth_document(), or check_document() where `options` have no output, that hands out the annotations as well, where
/// the options want any. `options.output` is not written; its format is that for which it is chosen what follows the
/// mesh.
PipelineResult run_on_document(MeshDocument& document, const PipelineOptions& options, AddedArrays& annotations);

}  // namespace trismooth
