#include "trismooth/mesh_io/vtk_xml/encoded_bytes.h"

#include <algorithm>
#include <cstring>

namespace trismooth {

namespace {

constexpr std::uint8_t not_base64 = 255;

constexpr std::array<std::uint8_t, 256> base64_values() {
  std::array<std::uint8_t, 256> values{};
  values.fill(not_base64);
  constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < alphabet.size(); ++i) {
    values[static_cast<unsigned char>(alphabet[i])] = static_cast<std::uint8_t>(i);
  }
  return values;
}

constexpr std::array<std::uint8_t, 256> base64_value_of = base64_values();

std::uint8_t base64_value_at(const char* character) {
  return base64_value_of[static_cast<unsigned char>(*character)];
}

void store(std::byte* bytes, std::uint8_t a, std::uint8_t b, std::uint8_t c, std::uint8_t d) {
  bytes[0] = static_cast<std::byte>((a << 2) | (b >> 4));
  bytes[1] = static_cast<std::byte>(((b & 15) << 4) | (c >> 2));
  bytes[2] = static_cast<std::byte>(((c & 3) << 6) | d);
}

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
    value = base64_value_at(&character);
    if (value == not_base64 || padding != 0) {
      return false;
    }
  }
  if (padding > 2) {
    return false;
  }
  store(bytes, values[0], values[1], values[2], values[3]);
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
    const char* text = text_.data() + position_;
    std::size_t groups = padded_ ? 0 : std::min(count / 3, (text_.size() - position_) / 4);
    while (groups > 0) {
      const std::uint8_t a = base64_value_at(text);
      const std::uint8_t b = base64_value_at(text + 1);
      const std::uint8_t c = base64_value_at(text + 2);
      const std::uint8_t d = base64_value_at(text + 3);
      if ((a | b | c | d) > 63) {
        break;
      }
      store(bytes, a, b, c, d);
      text += 4;
      bytes += 3;
      count -= 3;
      --groups;
    }
    position_ = static_cast<std::size_t>(text - text_.data());
    if (count > 0) {
      carried_begin_ = 0;
      if (!decode_group(carried_.data(), carried_end_)) {
        return false;
      }
    }
  }
  return true;
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
