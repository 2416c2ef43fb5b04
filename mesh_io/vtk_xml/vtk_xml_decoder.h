// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/bytes/memory_block.h"
#include "trismooth/mesh_io/data_array.h"
#include "trismooth/mesh_io/vtk_xml/encoding/encoded_bytes.h"
#include "trismooth/mesh_io/vtk_xml/encoding/vtk_xml_uncompressor.h"
#include "trismooth/mesh_io/vtk_xml/vtk_xml_array_places.h"
#include "trismooth/mesh_io/vtk_xml/vtk_xml_header.h"
#include "trismooth/mesh_io/xml/xml_tree.h"

namespace trismooth {

/// Decodes the arrays of a file of VTK's XML formats: text, base64 or raw bytes, inline or appended, compressed or
/// not, in either byte order. Everything that the file declares is checked against the bytes at hand before memory is
/// taken: what is allocated stays within a small multiple of what was decoded. VTK's own reader stops the program,
/// reads past the end or returns garbage on many malformed files; this takes its place.
class VtkXmlDecoder {
 public:
  /// What to do with numbers behind those that were asked for. VTK drops them.
  enum class Surplus : bool { noted, refused };

  /// `bytes`, the whole file, `workers` and `losses` must outlive the decoder. What of an array is not read gives a
  /// sentence in `losses`.
  VtkXmlDecoder(std::filesystem::path path, std::string_view bytes, const VtkXmlHeader& header,
                const FileWorkers& workers, std::vector<std::string>& losses);
  ~VtkXmlDecoder();
  VtkXmlDecoder(const VtkXmlDecoder&) = delete;
  VtkXmlDecoder& operator=(const VtkXmlDecoder&) = delete;

  /// Appends the numbers of the array element, of that type, to `numbers` in this machine's byte order: the first
  /// `count`, of which none may be missing; all where `count` is empty. Throws ReadError.
  void read_numbers(const XmlElement& array, ScalarType type, std::optional<std::uint64_t> count, MemoryBlock& numbers,
                    Surplus surplus = Surplus::noted);

  /// Appends one byte, 0 or 1, for each of the first `count` bits of an array of bits. Throws ReadError.
  void read_bits(const XmlElement& array, std::uint64_t count, MemoryBlock& bits);

  /// Appends the first `count` strings of an array of strings. Throws ReadError.
  void read_strings(const XmlElement& array, std::uint64_t count, std::vector<std::string>& strings);

  /// For an array that should hold nothing, since the file declares no rows for it: fails where it holds something, as
  /// a part of the mesh would be lost. What is in appended data is looked at by check_empty_arrays().
  void expect_empty(const XmlElement& array);

  /// To be called after everything was read. An array without rows may have the offset of another one: some programs
  /// write nothing for it.
  void check_empty_arrays();

  /// True where the first array that was read from base64 has its size encoded apart from its numbers, as MFEM writes
  /// it.
  bool has_sizes_apart() const { return sizes_apart_.value_or(false); }

 private:
  void read_bytes(const XmlElement& array, std::size_t word_size, std::optional<std::uint64_t> expected,
                  MemoryBlock& bytes, Surplus surplus = Surplus::noted);
  /// Says whether the array has more than was expected; it is all in `bytes`.
  bool read_plain(const XmlElement& array, EncodedBytes& source, std::size_t word_size,
                  std::optional<std::uint64_t> expected, MemoryBlock& bytes);
  void take_surplus(const XmlElement& array, const char* place, Surplus surplus, std::string_view what);

  template <class T>
  bool read_plain_numbers(std::string_view& text, std::uint64_t count, MemoryBlock& numbers);
  template <class T>
  void read_text_numbers(const XmlElement& array, std::optional<std::uint64_t> count, MemoryBlock& numbers,
                         Surplus surplus);

  VtkXmlArrayPlaces places_;
  FileWorkers workers_;
  std::optional<VtkXmlUncompressor> uncompressor_;  ///< where the file states a compressor
  std::vector<std::string>& losses_;
  std::optional<bool> sizes_apart_;
  std::uint64_t appended_used_ = 0;
  std::set<std::uint64_t> offsets_read_;              ///< of arrays in the appended data
  std::vector<const XmlElement*> empty_in_appended_;  ///< those that expect_empty() got
};

}  // namespace trismooth
