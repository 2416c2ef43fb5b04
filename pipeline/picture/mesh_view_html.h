// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "trismooth/pipeline/picture/mesh_picture.h"

namespace trismooth {

class Workers;

/// Adds to `html` a view of the mesh for a page, as HTML that is well-formed XML: it zooms and pans, colours the
/// elements by a metric, shows before and after, and tells of an element that is clicked. A page has one at most. It
/// needs no network, and WebGL 2: without it, without a script and on paper there is a still picture. A `button` of the
/// page with an attribute `data-element`, the number of an element, and `data-state`, "before" or "after", leads there.
/// Of more elements than `most` the page has a picture, and those around the worst ones. Complexity: linear.
void add_mesh_view(std::string& html, const MeshPicture& picture, Workers& workers, std::int64_t most = 2'000'000);

/// What a page with a view has in its style sheet.
std::string_view mesh_view_style();

}  // namespace trismooth
