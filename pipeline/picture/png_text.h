// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "trismooth/pipeline/picture/still_picture.h"

namespace trismooth {

/// The bytes of a PNG file: 8 bits of red, green and blue, sRGB. The same picture gives the same bytes, with the same
/// libpng and zlib. Throws std::bad_alloc, std::invalid_argument for a picture without pixels.
std::string png_text(const StillPicture& picture);

}  // namespace trismooth
