// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/vtk_xml/vtk_xml_header.h"

namespace accepted_files::vtk {

std::string base64_of(std::string_view bytes);

/// Takes the encoded arrays of a VTU or VTP file apart and puts changed ones in their place, so that a changed number
/// is not a broken base64 or a broken zlib stream. Only as exact as that needs: what it does not understand it does not
/// find.
class XmlArrays {
 public:
  struct Array {
    std::size_t begin = 0;   ///< in the file
    std::size_t length = 0;  ///< encoded
    bool base64 = true;
    bool appended = false;
    bool apart = false;                 ///< the header is encoded by itself
    std::vector<std::uint64_t> header;  ///< as the file declares it
    std::string data;                   ///< behind the header, decoded, still compressed
  };

  explicit XmlArrays(std::string file);

  const std::vector<Array>& arrays() const { return arrays_; }
  /// Whether encoding takes long.
  bool is_slow() const { return compressor_ == trismooth::VtkXmlCompressor::lzma; }
  /// The numbers of the array; nothing where they cannot be uncompressed.
  std::optional<std::string> payload(const Array& array) const;
  /// The array with other numbers, its header as they need it.
  Array with_payload(const Array& array, const std::string& payload) const;
  /// The file with `changed` where `array` is; the offsets of arrays behind it follow.
  std::string with(const Array& array, const Array& changed) const;

 private:
  std::optional<Array> decode(std::size_t begin, std::size_t end, bool base64) const;
  std::optional<std::string> decode_run(std::size_t begin, std::size_t end, std::size_t count, bool base64) const;
  std::vector<std::uint64_t> words(const std::string& bytes) const;
  std::string bytes_of(const std::vector<std::uint64_t>& words) const;
  void find_inline();
  void find_appended();

  std::string file_;
  std::size_t word_size_;
  bool big_endian_;
  trismooth::VtkXmlCompressor compressor_;
  std::size_t appended_begin_ = 0;
  std::vector<Array> arrays_;
};

}  // namespace accepted_files::vtk
