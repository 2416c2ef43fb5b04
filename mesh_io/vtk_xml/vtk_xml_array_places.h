// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/vtk_xml/encoding/encoded_bytes.h"
#include "trismooth/mesh_io/vtk_xml/vtk_xml_header.h"
#include "trismooth/mesh_io/xml/xml_tree.h"

namespace trismooth {

/// Where the arrays of a file stand in its bytes, what their headers declare, and how errors name them.
class VtkXmlArrayPlaces {
 public:
  /// `bytes`, the whole file, and `workers` must outlive it.
  VtkXmlArrayPlaces(std::filesystem::path path, std::string_view bytes, const VtkXmlHeader& header,
                    const FileWorkers& workers);

  const VtkXmlEncoding& encoding() const { return header_.encoding; }
  std::uint64_t appended_size() const { return header_.appended_end - header_.appended_begin; }
  /// These throw ReadError for an array that does not say where it is.
  VtkXmlMode mode_of(const XmlElement& array) const;
  std::uint64_t appended_offset_of(const XmlElement& array) const;
  /// The bytes of an array that is not text, from its block header on.
  EncodedBytes source_of(const XmlElement& array) const;

  /// What stands in the element.
  std::string_view text_of(const XmlElement& array) const;

  /// The next `count` words of a block header. Throws ReadError where they are not there.
  std::vector<std::uint64_t> read_header_words(const XmlElement& array, EncodedBytes& source, std::size_t count) const;
  /// Throws ReadError where an array that declares `size` bytes has too few of them, or no whole numbers.
  void check_size(const XmlElement& array, std::uint64_t size, std::size_t word_size,
                  std::optional<std::uint64_t> expected) const;

  /// Throws ReadError that names the array, with the line of its element or of `place` in the bytes.
  [[noreturn]] void fail(const XmlElement& array, const std::string& message) const;
  [[noreturn]] void fail_at(const XmlElement& array, const char* place, const std::string& message) const;

 private:
  std::filesystem::path path_;
  std::string_view bytes_;
  VtkXmlHeader header_;
  FileWorkers workers_;
};

}  // namespace trismooth
