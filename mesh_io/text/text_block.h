// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <charconv>
#include <cstddef>
#include <string_view>

#include "trismooth/mesh_io/bytes/memory_block.h"

namespace trismooth {

/// Appends text to a block of bytes.
class TextBlock {
 public:
  /// `bytes` must outlive it.
  explicit TextBlock(MemoryBlock& bytes) : bytes_(bytes) {}

  TextBlock& text(std::string_view text) {
    bytes_.append(text.data(), text.size());
    return *this;
  }

  TextBlock& text(char character) {
    *bytes_.extend(1) = static_cast<std::byte>(character);
    return *this;
  }

  /// The number's decimal digits; of a number of floating point the shortest text that reads back to the same value.
  template <class T>
  TextBlock& number(T value) {
    constexpr std::size_t most_digits = 32;
    const std::size_t size = bytes_.size();
    auto* const target = reinterpret_cast<char*>(bytes_.extend(most_digits));
    bytes_.truncate(size + static_cast<std::size_t>(std::to_chars(target, target + most_digits, value).ptr - target));
    return *this;
  }

 private:
  MemoryBlock& bytes_;
};

}  // namespace trismooth
