// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/picture/png_text.h"

#include <new>
#include <stdexcept>

#include <png.h>

namespace trismooth {

std::string png_text(const StillPicture& picture) {
  if (picture.width < 1 || picture.height < 1) {
    throw std::invalid_argument("a picture has at least one pixel");
  }
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = PNG_FORMAT_RGB;
  image.flags = PNG_IMAGE_FLAG_FAST;  // without filters, which make pictures of few colours larger
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(image), '\0');
  png_alloc_size_t size = bytes.size();
  constexpr int as_it_is = 0;
  constexpr png_int_32 rows_follow_each_other = 0;
  if (png_image_write_to_memory(&image, bytes.data(), &size, as_it_is, picture.rgb.data(), rows_follow_each_other,
                                nullptr) == 0) {
    throw std::bad_alloc();  // of a sound picture nothing else fails
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace trismooth
