// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/smoothing/guard/stored_image.h"

namespace trismooth {

struct MeshDocument;
struct RunState;

/// What the document's file will hold of a coordinate that was `before` and is to be `now`: `before` itself where they
/// are equal, or where what it can hold is not finite.
double stored_coordinate(const MeshDocument& document, double before, double now);

/// Whether the file will hold another mesh than its number type says: its numbers have few characters, of which it
/// holds the nearest; or nodes in the middle of sides follow these.
bool is_stored_otherwise(const RunState& run);

/// What the document's file will hold of the mesh's vertices. The run outlives it.
StoredImage stored_image(const RunState& run);

}  // namespace trismooth
