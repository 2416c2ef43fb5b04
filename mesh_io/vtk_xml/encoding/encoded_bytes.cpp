// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_xml/encoding/encoded_bytes.h"

#include <algorithm>
#include <cstring>

#include "trismooth/mesh_io/bytes/shared_blocks.h"
#include "trismooth/mesh_io/vtk_xml/encoding/base64.h"

namespace trismooth {

namespace {

bool is_space(char c) {
  return c == ' ' || c == '\n' || c == '\r' || c == '\t';
}

}  // namespace

std::size_t EncodedBytes::most_available() const {
  const std::size_t left = text_.size() - position_;
  return encoding_ == Encoding::raw ? left : left / 4 * 3 + (carried_end_ - carried_begin_);
}

bool EncodedBytes::decode_group(std::byte* bytes, std::size_t& count) {
  if (padded_) {
    return false;
  }
  std::array<std::uint8_t, 4> values{};
  std::size_t padding = 0;
  for (std::uint8_t& value : values) {
    while (position_ < text_.size() && is_space(text_[position_])) {
      ++position_;
    }
    if (position_ == text_.size()) {
      return false;
    }
    const char character = text_[position_++];
    if (character == '=') {
      ++padding;
      continue;
    }
    value = base64_value(character);
    if (value == not_base64 || padding != 0) {
      return false;
    }
  }
  if (padding > 2) {
    return false;
  }
  store_base64_group(bytes, values[0], values[1], values[2], values[3]);
  padded_ = padding != 0;
  count = 3 - padding;
  return true;
}

bool EncodedBytes::read(std::byte* bytes, std::size_t count) {
  if (count == 0) {
    return true;
  }
  if (encoding_ == Encoding::raw) {
    if (count > text_.size() - position_) {
      return false;
    }
    std::memcpy(bytes, text_.data() + position_, count);
    position_ += count;
    return true;
  }
  while (count > 0) {
    if (carried_begin_ < carried_end_) {
      const std::size_t taken = std::min(count, carried_end_ - carried_begin_);
      std::copy_n(carried_.data() + carried_begin_, taken, bytes);
      carried_begin_ += taken;
      bytes += taken;
      count -= taken;
      continue;
    }
    // Whole groups without white space or padding, which is nearly all there is.
    const std::size_t groups = padded_ ? 0 : std::min(count / 3, (text_.size() - position_) / 4);
    const std::size_t decoded = decode_base64_groups(text_.data() + position_, groups, bytes);
    bytes += 3 * decoded;
    count -= 3 * decoded;
    position_ += 4 * decoded;
    if (count > 0) {
      carried_begin_ = 0;
      if (!decode_group(carried_.data(), carried_end_)) {
        return false;
      }
    }
  }
  return true;
}

/// Decodes whole groups of four characters where they all are plain; the bytes that this gave.
std::size_t EncodedBytes::decode_groups(std::byte* bytes, std::size_t groups, const FileWorkers& workers) {
  const char* const text = text_.data() + position_;
  const bool plain = all_file_blocks(workers, groups, 4, [&](std::size_t begin, std::size_t end) {
    return decode_base64_groups(text + 4 * begin, end - begin, bytes + 3 * begin) == end - begin;
  });
  if (!plain) {
    return 0;
  }
  position_ += 4 * groups;
  return 3 * groups;
}

bool EncodedBytes::append_to(MemoryBlock& block, std::size_t count, const FileWorkers& workers) {
  if (encoding_ == Encoding::raw && count <= text_.size() - position_) {
    append_shared(block, text_.data() + position_, count, workers);
    position_ += count;
    return true;
  }
  block.reserve_more(count);
  std::byte* const bytes = block.extend(count);
  const std::size_t carried = std::min(count, carried_end_ - carried_begin_);
  if (encoding_ == Encoding::raw || padded_ || !read(bytes, carried)) {
    return read(bytes, count);
  }
  const std::size_t groups = std::min((count - carried) / 3, (text_.size() - position_) / 4);
  const std::size_t decoded = carried + decode_groups(bytes + carried, groups, workers);
  return read(bytes + decoded, count - decoded);
}

std::string_view EncodedBytes::view(std::size_t count) {
  const std::string_view bytes = text_.substr(position_, count);
  position_ += bytes.size();
  return bytes;
}

bool EncodedBytes::end_run() {
  padded_ = false;
  return carried_begin_ == carried_end_;
}

}  // namespace trismooth
