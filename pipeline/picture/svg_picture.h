// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "trismooth/pipeline/picture/element_shades.h"
#include "trismooth/pipeline/picture/mesh_lines.h"
#include "trismooth/pipeline/picture/picture_sheet.h"

namespace trismooth {

/// So many elements of a panel are drawn one by one; where there are more, all of them are one image of pixels.
inline constexpr std::size_t most_elements_of_svg = 200'000;

/// A sheet as SVG.
struct SvgPicture {
  std::string text;
  std::size_t elements_as_pixels = 0;  ///< of the main panel, where these are an image; else 0
};

/// Writes it. `shades` and `lines` are of the sheet's mesh, as it is on the sheet; `most_elements` of a panel are drawn
/// one by one; `threads` as in StillOptions. Names are escaped. The same mesh gives the same bytes.
SvgPicture svg_picture(const ElementShades& shades, const MeshLines& lines, const PictureSheet& sheet, int threads,
                       std::size_t most_elements = most_elements_of_svg);

}  // namespace trismooth
