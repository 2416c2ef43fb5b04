// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_xml/vtk_xml_array_places.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "trismooth/mesh_io/bytes/native_order.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/text/text_scanner.h"
#include "trismooth/mesh_io/vtk_xml/vtk_xml_text.h"

namespace trismooth {

VtkXmlArrayPlaces::VtkXmlArrayPlaces(std::filesystem::path path, std::string_view bytes, const VtkXmlHeader& header,
                                     const FileWorkers& workers)
    : path_(std::move(path)), bytes_(bytes), header_(header), workers_(workers) {}

VtkXmlMode VtkXmlArrayPlaces::mode_of(const XmlElement& array) const {
  return vtk_xml_mode_of(path_, array);
}

void VtkXmlArrayPlaces::fail(const XmlElement& array, const std::string& message) const {
  const std::string* const name = array.attribute("Name");
  throw ReadError(path_, array.line,
                  (name == nullptr ? "the array " : "array " + trismooth::quoted(*name) + " ") + message);
}

void VtkXmlArrayPlaces::fail_at(const XmlElement& array, const char* place, const std::string& message) const {
  XmlElement at = {.name = {}, .attributes = array.attributes, .children = {}, .text = {}};
  at.line = 1 + static_cast<std::size_t>(std::count(bytes_.data(), place, '\n'));
  fail(at, message);
}

std::string_view VtkXmlArrayPlaces::text_of(const XmlElement& array) const {
  return bytes_.substr(array.content_begin, array.content_end - array.content_begin);
}

std::uint64_t VtkXmlArrayPlaces::appended_offset_of(const XmlElement& array) const {
  if (header_.appended_begin == 0) {
    fail(array, "is in appended data, but there is no <AppendedData>");
  }
  const std::string* const text = array.attribute("offset");
  const auto offset = text == nullptr ? std::nullopt : parse_xml_count(*text);
  const std::uint64_t size = appended_size();
  if (!offset || *offset > size) {
    fail(array, "has offset " + (text == nullptr ? "(none)" : trismooth::quoted(*text)) + "; the appended data have " +
                    std::to_string(size) + " bytes");
  }
  return *offset;
}

EncodedBytes VtkXmlArrayPlaces::source_of(const XmlElement& array) const {
  if (mode_of(array) == VtkXmlMode::binary) {
    return {text_of(array), EncodedBytes::Encoding::base64};
  }
  const std::size_t begin = header_.appended_begin + appended_offset_of(array);
  return {bytes_.substr(begin, header_.appended_end - begin),
          header_.encoding.appended_base64 ? EncodedBytes::Encoding::base64 : EncodedBytes::Encoding::raw};
}

std::vector<std::uint64_t> VtkXmlArrayPlaces::read_header_words(const XmlElement& array, EncodedBytes& source,
                                                                std::size_t count) const {
  const std::size_t word_size = header_.encoding.wide_block_headers ? 8 : 4;
  if (count > source.most_available() / word_size) {
    fail(array, "ends within its block header");
  }
  std::vector<std::byte> bytes(count * word_size);
  if (!source.read(bytes.data(), bytes.size())) {
    fail(array, "has a block header that is cut off or not base64");
  }
  to_native_order(bytes.data(), bytes.size(), word_size, header_.encoding.big_endian, workers_);
  std::vector<std::uint64_t> words(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (word_size == 8) {
      std::memcpy(&words[i], bytes.data() + 8 * i, 8);
    } else {
      std::uint32_t word = 0;
      std::memcpy(&word, bytes.data() + 4 * i, 4);
      words[i] = word;
    }
  }
  return words;
}

void VtkXmlArrayPlaces::check_size(const XmlElement& array, std::uint64_t size, std::size_t word_size,
                                   std::optional<std::uint64_t> expected) const {
  if (expected && size < *expected) {
    fail(array, "declares " + std::to_string(size) + " bytes of data, expected " + std::to_string(*expected));
  }
  if (size % word_size != 0) {
    fail(array, "declares " + std::to_string(size) + " bytes of data, which is not a multiple of " +
                    std::to_string(word_size));
  }
}

}  // namespace trismooth
