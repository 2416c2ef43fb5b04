// SPDX-License-Identifier: BSD-3-Clause
#include "support/xml_arrays.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <numeric>
#include <utility>

#include "trismooth/mesh_io/vtk_xml/encoding/encoded_bytes.h"
#include "trismooth/mesh_io/vtk_xml/encoding/vtk_compressor.h"

namespace accepted_files::vtk {

using trismooth::EncodedBytes;
using trismooth::VtkXmlCompressor;

namespace {

constexpr std::size_t most_payload = std::size_t{1} << 16;

bool has(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

VtkXmlCompressor compressor_of(std::string_view file) {
  return has(file, "vtkZLib")   ? VtkXmlCompressor::zlib
         : has(file, "vtkLZ4")  ? VtkXmlCompressor::lz4
         : has(file, "vtkLZMA") ? VtkXmlCompressor::lzma
                                : VtkXmlCompressor::none;
}

std::size_t encoded_length(std::size_t bytes, bool base64) {
  return base64 ? (bytes + 2) / 3 * 4 : bytes;
}

/// The value of the attribute `name` in `tag`; empty where there is none.
std::string_view attribute(std::string_view tag, std::string_view name) {
  const std::string pattern = " " + std::string(name) + "=\"";
  const std::size_t found = tag.find(pattern);
  if (found == std::string_view::npos) {
    return {};
  }
  const std::string_view value = tag.substr(found + pattern.size());
  return value.substr(0, value.find('"'));
}

std::optional<std::size_t> whole_number(std::string_view text) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return !text.empty() && error == std::errc() && end == text.data() + text.size() ? std::optional(number)
                                                                                   : std::nullopt;
}

/// Calls use(tag, its first byte, the byte behind it) for every start tag of an array.
template <class Use>
void for_all_array_tags(std::string_view file, const Use& use) {
  for (std::size_t begin = file.find("Array "); begin != std::string_view::npos;
       begin = file.find("Array ", begin + 1)) {
    const std::size_t end = file.find('>', begin);
    if (end != std::string_view::npos) {
      use(file.substr(begin, end - begin), begin, end + 1);
    }
  }
}

}  // namespace

std::string base64_of(std::string_view bytes) {
  constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      group = group << 8U | (j < count ? static_cast<unsigned char>(bytes[i + j]) : 0U);
    }
    for (std::size_t j = 0; j < 4; ++j) {
      text += j <= count ? alphabet[group >> (18 - 6 * j) & 63U] : '=';
    }
  }
  return text;
}

XmlArrays::XmlArrays(std::string file)
    : file_(std::move(file)),
      word_size_(has(file_, "\"UInt64\"") && has(file_, "header_type") ? 8 : 4),
      big_endian_(has(file_, "BigEndian")),
      compressor_(compressor_of(file_)) {
  find_inline();
  find_appended();
}

void XmlArrays::find_inline() {
  for_all_array_tags(file_, [&](std::string_view tag, std::size_t, std::size_t content) {
    const std::size_t begin = file_.find_first_not_of(" \t\r\n", content);
    const std::size_t end = file_.find('<', content);
    if (attribute(tag, "format") == "binary" && begin < end && end != std::string::npos) {
      if (auto array = decode(begin, end, true)) {
        arrays_.push_back(std::move(*array));
      }
    }
  });
}

void XmlArrays::find_appended() {
  const std::size_t section = file_.find("<AppendedData");
  const std::size_t mark = file_.find('_', std::min(section, file_.size()));
  const std::size_t end = file_.rfind("</AppendedData");
  if (mark == std::string::npos || end == std::string::npos || end < mark) {
    return;
  }
  appended_begin_ = mark + 1;
  const bool base64 = !has(std::string_view(file_).substr(section, mark - section), "\"raw\"");
  for_all_array_tags(std::string_view(file_).substr(0, section), [&](std::string_view tag, std::size_t, std::size_t) {
    const auto offset = whole_number(attribute(tag, "offset"));
    if (offset && *offset < end - appended_begin_) {
      if (auto array = decode(appended_begin_ + *offset, end, base64)) {
        array->appended = true;
        arrays_.push_back(std::move(*array));
      }
    }
  });
}

std::optional<std::string> XmlArrays::decode_run(std::size_t begin, std::size_t end, std::size_t count,
                                                 bool base64) const {
  if (begin > end || count > most_payload) {
    return std::nullopt;
  }
  std::string bytes(count, '\0');
  EncodedBytes source(std::string_view(file_).substr(begin, end - begin),
                      base64 ? EncodedBytes::Encoding::base64 : EncodedBytes::Encoding::raw);
  return source.read(reinterpret_cast<std::byte*>(bytes.data()), count) ? std::optional(bytes) : std::nullopt;
}

std::optional<XmlArrays::Array> XmlArrays::decode(std::size_t begin, std::size_t end, bool base64) const {
  const bool compressed = compressor_ != VtkXmlCompressor::none;
  const auto first = decode_run(begin, end, (compressed ? 3 : 1) * word_size_, base64);
  if (!first) {
    return std::nullopt;
  }
  Array array{.begin = begin,
              .length = 0,
              .base64 = base64,
              .appended = false,
              .apart = compressed,
              .header = words(*first),
              .data = {}};
  const std::size_t header_length = encoded_length(word_size_, base64);
  if (!compressed && base64 && begin + header_length < end && file_[begin + header_length - 1] == '=') {
    array.apart = array.header[0] > 0;
  }
  std::size_t data_begin = 0;  // within what is decoded
  std::size_t run_begin = begin;
  std::size_t data_size = array.header[0];
  if (compressed) {
    if (array.header[0] > most_payload / word_size_) {
      return std::nullopt;
    }
    const std::size_t header_bytes = (3 + array.header[0]) * word_size_;
    const auto header = decode_run(begin, end, header_bytes, base64);
    if (!header) {
      return std::nullopt;
    }
    array.header = words(*header);
    run_begin = begin + encoded_length(header_bytes, base64);
    data_size = 0;
    for (std::size_t i = 3; i < array.header.size(); ++i) {
      data_size += std::min<std::size_t>(array.header[i], most_payload);
    }
  } else if (array.apart) {
    run_begin = begin + header_length;
  } else {
    data_begin = word_size_;
  }
  const auto data = decode_run(run_begin, end, data_begin + std::min(data_size, most_payload), base64);
  if (!data) {
    return std::nullopt;
  }
  array.data = data->substr(data_begin);
  array.length = run_begin - begin + encoded_length(data->size(), base64);
  return array.begin + array.length <= end ? std::optional(array) : std::nullopt;
}

std::vector<std::uint64_t> XmlArrays::words(const std::string& bytes) const {
  std::vector<std::uint64_t> numbers(bytes.size() / word_size_);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    for (std::size_t j = 0; j < word_size_; ++j) {
      const std::size_t shift = 8 * (big_endian_ ? word_size_ - 1 - j : j);
      numbers[i] |= std::uint64_t{static_cast<unsigned char>(bytes[i * word_size_ + j])} << shift;
    }
  }
  return numbers;
}

std::string XmlArrays::bytes_of(const std::vector<std::uint64_t>& words) const {
  std::string bytes;
  for (const std::uint64_t word : words) {
    for (std::size_t j = 0; j < word_size_; ++j) {
      bytes += static_cast<char>(word >> 8 * (big_endian_ ? word_size_ - 1 - j : j) & 255U);
    }
  }
  return bytes;
}

std::optional<std::string> XmlArrays::payload(const Array& array) const {
  if (compressor_ == VtkXmlCompressor::none) {
    return array.data;
  }
  const auto compressor = trismooth::make_vtk_compressor(compressor_);
  const std::uint64_t blocks = array.header[0];
  std::string all;
  std::size_t position = 0;
  for (std::size_t block = 0; block < blocks; ++block) {
    const bool is_last = block + 1 == blocks;
    const std::uint64_t size = is_last && array.header[2] != 0 ? array.header[2] : array.header[1];
    const std::uint64_t compressed = array.header[3 + block];
    if (size > most_payload || compressed > array.data.size() - position) {
      return std::nullopt;
    }
    std::string bytes(size, '\0');
    if (compressor->Uncompress(reinterpret_cast<const unsigned char*>(array.data.data()) + position, compressed,
                               reinterpret_cast<unsigned char*>(bytes.data()), size) != size) {
      return std::nullopt;
    }
    all += bytes;
    position += compressed;
  }
  return all;
}

XmlArrays::Array XmlArrays::with_payload(const Array& array, const std::string& payload) const {
  Array changed = array;
  if (compressor_ == VtkXmlCompressor::none) {
    changed.header = {payload.size()};
    changed.data = payload;
    return changed;
  }
  const auto compressor = trismooth::make_vtk_compressor(compressor_);
  // LZMA's readers make room for the dictionary of the level.
  compressor->SetCompressionLevel(1);
  std::string compressed(compressor->GetMaximumCompressionSpace(payload.size()), '\0');
  compressed.resize(compressor->Compress(reinterpret_cast<const unsigned char*>(payload.data()), payload.size(),
                                         reinterpret_cast<unsigned char*>(compressed.data()), compressed.size()));
  changed.header = {1, payload.size(), 0, compressed.size()};
  changed.data = compressed;
  return changed;
}

std::string XmlArrays::with(const Array& array, const Array& changed) const {
  const std::string header = bytes_of(changed.header);
  const bool one_run = !array.apart;
  const std::string encoded = !array.base64 ? header + changed.data
                              : one_run     ? base64_of(header + changed.data)
                                            : base64_of(header) + base64_of(changed.data);
  std::string file = file_;
  file.replace(array.begin, array.length, encoded);
  if (!array.appended || encoded.size() == array.length) {
    return file;
  }
  // Attributes stand in front of the appended data: replacing them from the last to the first keeps places valid.
  std::vector<std::pair<std::size_t, std::string_view>> offsets;
  for_all_array_tags(std::string_view(file_).substr(0, appended_begin_),
                     [&](std::string_view tag, std::size_t begin, std::size_t) {
                       const std::string_view text = attribute(tag, "offset");
                       const auto offset = whole_number(text);
                       if (offset && *offset > array.begin - appended_begin_) {
                         offsets.emplace_back(begin + static_cast<std::size_t>(text.data() - tag.data()), text);
                       }
                     });
  std::reverse(offsets.begin(), offsets.end());
  for (const auto& [place, text] : offsets) {
    const std::size_t offset = *whole_number(text) + encoded.size() - array.length;
    file.replace(place, text.size(), std::to_string(offset));
  }
  return file;
}

}  // namespace accepted_files::vtk
