// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_xml/vtk_xml_decoder.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "trismooth/mesh_io/bytes/native_order.h"
#include "trismooth/mesh_io/bytes/saturating_product.h"
#include "trismooth/mesh_io/text/plain_rows.h"
#include "trismooth/mesh_io/text/text_scanner.h"
#include "trismooth/mesh_io/vtk_xml/vtk_xml_text.h"

namespace trismooth {

namespace {

constexpr const char* unexpected_data = "holds data, but the file declares no rows for it";

}  // namespace

VtkXmlDecoder::VtkXmlDecoder(std::filesystem::path path, std::string_view bytes, const VtkXmlHeader& header,
                             const FileWorkers& workers, std::vector<std::string>& losses)
    : places_(std::move(path), bytes, header, workers), workers_(workers), losses_(losses) {
  if (header.encoding.compressor != VtkXmlCompressor::none) {
    uncompressor_.emplace(places_, workers_);
  }
}

VtkXmlDecoder::~VtkXmlDecoder() = default;

void VtkXmlDecoder::take_surplus(const XmlElement& array, const char* place, Surplus surplus, std::string_view what) {
  const std::string message = "holds more than the " + std::string(what);
  if (surplus == Surplus::refused) {
    places_.fail_at(array, place, message + " expected");
  }
  const std::string* const name = array.attribute("Name");
  losses_.push_back("the array " + (name == nullptr ? std::string() : trismooth::quoted(*name) + " ") + "in line " +
                    std::to_string(array.line) + " " + message + " that the file asks for; the rest is not kept");
}

bool VtkXmlDecoder::read_plain(const XmlElement& array, EncodedBytes& source, std::size_t word_size,
                               std::optional<std::uint64_t> expected, MemoryBlock& bytes) {
  const std::uint64_t size = places_.read_header_words(array, source, 1)[0];
  places_.check_size(array, size, word_size, expected);
  if (size > 0 && places_.mode_of(array) != VtkXmlMode::ascii) {
    const bool apart = source.is_behind_padding();
    sizes_apart_ = sizes_apart_.value_or(apart);
    if (apart) {
      source.end_run();
    }
  }
  if (size > source.most_available()) {
    places_.fail(array, "declares " + std::to_string(size) + " bytes of data, but has " +
                            std::to_string(source.most_available()) + " at most");
  }
  const bool complete = source.append_to(bytes, size, workers_);
  if (!complete || !source.end_run()) {
    places_.fail(array, "is not base64 of its " + std::to_string(size) + " bytes");
  }
  return expected && size > *expected;
}

void VtkXmlDecoder::read_bytes(const XmlElement& array, std::size_t word_size, std::optional<std::uint64_t> expected,
                               MemoryBlock& bytes, Surplus surplus) {
  const std::size_t begin = bytes.size();
  EncodedBytes source = places_.source_of(array);
  const bool more = uncompressor_ ? uncompressor_->read(array, source, word_size, expected, bytes)
                                  : read_plain(array, source, word_size, expected, bytes);
  if (more) {
    take_surplus(array, places_.text_of(array).data(), surplus, std::to_string(*expected / word_size) + " numbers");
    bytes.truncate(begin + *expected);
  }
  if (places_.mode_of(array) == VtkXmlMode::appended) {
    // Arrays that share appended data could make a small file fill the memory.
    offsets_read_.insert(places_.appended_offset_of(array));
    appended_used_ += source.used();
    if (appended_used_ > places_.appended_size()) {
      places_.fail(array, "overlaps another array in the appended data");
    }
  } else {
    std::string_view rest = source.rest();
    if (!take_xml_token(rest).empty()) {
      places_.fail(array, "holds more data than it declares");
    }
  }
  to_native_order(bytes.data() + begin, bytes.size() - begin, word_size, places_.encoding().big_endian, workers_);
}

void VtkXmlDecoder::expect_empty(const XmlElement& array) {
  const VtkXmlMode mode = places_.mode_of(array);
  if (mode == VtkXmlMode::appended) {
    empty_in_appended_.push_back(&array);
    return;
  }
  std::string_view text = places_.text_of(array);
  if (mode == VtkXmlMode::ascii) {
    if (!take_xml_token(text).empty()) {
      places_.fail(array, unexpected_data);
    }
    return;
  }
  // The first word is a number of bytes or of blocks.
  EncodedBytes source = places_.source_of(array);
  if (take_xml_token(text).empty()) {
    return;
  }
  const bool declares_data = places_.read_header_words(array, source, 1)[0] != 0;
  std::string_view rest = source.rest();
  // A compressed array of no blocks may go on with their size.
  if (declares_data || (!uncompressor_ && !take_xml_token(rest).empty())) {
    places_.fail(array, unexpected_data);
  }
}

void VtkXmlDecoder::check_empty_arrays() {
  for (const XmlElement* const array : empty_in_appended_) {
    EncodedBytes source = places_.source_of(*array);
    const bool shared = offsets_read_.contains(places_.appended_offset_of(*array));
    const std::size_t word_size = places_.encoding().wide_block_headers ? 8 : 4;
    if (!shared && source.most_available() >= word_size && places_.read_header_words(*array, source, 1)[0] != 0) {
      places_.fail(*array, unexpected_data);
    }
  }
}

/// Appends the first `count` numbers of the text, and passes them; false, and nothing done, where one is not plain.
template <class T>
bool VtkXmlDecoder::read_plain_numbers(std::string_view& text, std::uint64_t count, MemoryBlock& numbers) {
  const std::size_t size_before = numbers.size();
  auto* const values = reinterpret_cast<T*>(numbers.extend(count * sizeof(T)));
  PlainRows rows(text, workers_);
  const auto end = rows.read(0, count, 1, [values](PlainNumbers& plain, std::size_t first, std::size_t last) {
    return std::all_of(values + first, values + last, [&plain](T& value) { return plain.next(value); });
  });
  if (end) {
    text.remove_prefix(end->offset);
  } else {
    numbers.truncate(size_before);
  }
  return end.has_value();
}

template <class T>
void VtkXmlDecoder::read_text_numbers(const XmlElement& array, std::optional<std::uint64_t> count, MemoryBlock& numbers,
                                      Surplus surplus) {
  std::string_view text = places_.text_of(array);
  const std::uint64_t most = text.size() / 2 + 1;
  if (count && *count > most) {
    places_.fail(array, "should hold " + std::to_string(*count) + " numbers, but has room for " + std::to_string(most) +
                            " at most");
  }
  std::uint64_t read = 0;
  if (count) {
    numbers.reserve_more(*count * sizeof(T));
    read = read_plain_numbers<T>(text, *count, numbers) ? *count : 0;
  }
  for (std::string_view token = take_xml_token(text); !token.empty(); token = take_xml_token(text)) {
    const std::optional<T> value = parse_xml_number<T>(token);
    if (!value) {
      places_.fail_at(array, token.data(), "expected a number of its type, got " + trismooth::quoted(token));
    }
    if (count && read >= *count) {
      if (read == *count) {
        take_surplus(array, token.data(), surplus, std::to_string(read) + " numbers");
      }
      ++read;
      continue;
    }
    numbers.append(&*value, sizeof(T));
    ++read;
  }
  if (count && read < *count) {
    places_.fail(array, "holds " + std::to_string(read) + " numbers, expected " + std::to_string(*count));
  }
}

void VtkXmlDecoder::read_numbers(const XmlElement& array, ScalarType type, std::optional<std::uint64_t> count,
                                 MemoryBlock& numbers, Surplus surplus) {
  if (count == 0) {
    return expect_empty(array);
  }
  if (places_.mode_of(array) == VtkXmlMode::ascii) {
    visit_scalar_type(type, [&](auto zero) { read_text_numbers<decltype(zero)>(array, count, numbers, surplus); });
    return;
  }
  const std::size_t word_size = size_of(type);
  read_bytes(array, word_size, count ? std::optional(saturating_product(*count, word_size)) : std::nullopt, numbers,
             surplus);
}

void VtkXmlDecoder::read_bits(const XmlElement& array, std::uint64_t count, MemoryBlock& bits) {
  if (count == 0) {
    return expect_empty(array);
  }
  if (places_.mode_of(array) == VtkXmlMode::ascii) {
    const std::size_t begin = bits.size();
    read_text_numbers<std::uint8_t>(array, count, bits, Surplus::noted);
    if (std::any_of(bits.data() + begin, bits.data() + bits.size(), [](std::byte bit) { return bit > std::byte{1}; })) {
      places_.fail(array, "holds a number that is not a bit");
    }
    return;
  }
  MemoryBlock packed;
  read_bytes(array, 1, count / 8 + (count % 8 == 0 ? 0 : 1), packed);
  std::byte* const unpacked = bits.extend(count);
  for (std::size_t i = 0; i < count; ++i) {
    unpacked[i] = (packed.data()[i / 8] >> (7 - i % 8)) & std::byte{1};
  }
}

void VtkXmlDecoder::read_strings(const XmlElement& array, std::uint64_t count, std::vector<std::string>& strings) {
  if (count == 0) {
    return expect_empty(array);
  }
  MemoryBlock characters;
  if (places_.mode_of(array) == VtkXmlMode::ascii) {
    MemoryBlock codes;
    read_text_numbers<std::int16_t>(array, std::nullopt, codes, Surplus::noted);
    const std::size_t length = codes.size() / sizeof(std::int16_t);
    std::byte* const target = characters.extend(length);
    for (std::size_t i = 0; i < length; ++i) {
      std::int16_t code = 0;
      std::memcpy(&code, codes.data() + i * sizeof(code), sizeof(code));
      if (code < -128 || code > 255) {
        places_.fail(array, "holds the character code " + std::to_string(code));
      }
      target[i] = static_cast<std::byte>(code);
    }
  } else {
    read_bytes(array, 1, std::nullopt, characters);
  }
  const std::string_view all(reinterpret_cast<const char*>(characters.data()), characters.size());
  const auto found = static_cast<std::uint64_t>(std::ranges::count(all, '\0'));
  const std::size_t wanted = strings.size() + count;
  if (found < count || all.back() != '\0') {
    places_.fail(array, "holds " + std::to_string(found) + " strings, expected " + std::to_string(count));
  }
  if (found > count) {
    take_surplus(array, places_.text_of(array).data(), Surplus::noted, std::to_string(count) + " strings");
  }
  for (std::size_t begin = 0; strings.size() < wanted;) {
    const std::size_t end = all.find('\0', begin);
    strings.emplace_back(all.substr(begin, end - begin));
    begin = end + 1;
  }
}

}  // namespace trismooth
