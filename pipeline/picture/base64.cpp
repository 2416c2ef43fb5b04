// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/picture/base64.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace trismooth {

std::string base64(std::string_view bytes) {
  static constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text((bytes.size() + 2) / 3 * 4, '=');
  char* to = text.data();
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return i + k < bytes.size() ? static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[i + k])) : 0U;
    };
    const std::uint32_t three = byte(0) << 16U | byte(1) << 8U | byte(2);
    const std::size_t made = std::min<std::size_t>(bytes.size() - i, 3) + 1;
    for (std::size_t k = 0; k < made; ++k) {
      to[k] = digits[three >> (18U - 6U * static_cast<unsigned>(k)) & 63U];
    }
    to += 4;
  }
  return text;
}

}  // namespace trismooth
