// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/pipeline/picture/element_shades.h"
#include "trismooth/pipeline/picture/mesh_lines.h"
#include "trismooth/pipeline/picture/picture_sheet.h"
#include "trismooth/pipeline/picture/still_picture.h"

namespace trismooth {

/// A sheet as pixels. `shades` and `lines` are of the sheet's mesh, as it is on the sheet; `threads` as in
/// StillOptions. Complexity: linear in pixels, and in elements for each panel.
StillPicture draw_sheet(const ElementShades& shades, const MeshLines& lines, const PictureSheet& sheet, int threads);

}  // namespace trismooth
