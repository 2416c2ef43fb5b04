// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/pipeline/generate/random_mesh.h"

namespace trismooth {

/// The mesh as a document, in the plane z = 0.
MeshDocument document_of(const RandomMesh& mesh);

}  // namespace trismooth
