// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "trismooth/base/point2.h"
#include "trismooth/pipeline/picture/picture_sheet.h"
#include "trismooth/pipeline/picture/still_picture.h"

namespace trismooth {

/// Draws a line of text into a picture, in letters of 12 by 14 pixels: those of ASCII; others are shown as "?". What is
/// beyond the picture's rim is cut off.
void draw_text(StillPicture& picture, Point2<double> at, TextAnchor anchor, std::string_view text, Colour colour);

}  // namespace trismooth
