// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "trismooth/mesh_io/xml/xml_tree.h"

namespace trismooth {

/// The data sets of VTK's XML formats that are read and written here.
enum class VtkXmlKind : std::uint8_t { unstructured_grid, poly_data };

/// "UnstructuredGrid" or "PolyData".
std::string_view to_string(VtkXmlKind kind);

/// Where a file keeps its numbers: as text or base64 in the elements, or behind them in one section.
enum class VtkXmlMode : std::uint8_t { ascii, binary, appended };

enum class VtkXmlCompressor : std::uint8_t { none, zlib, lz4, lzma };

/// How a file of VTK's XML formats encodes its arrays. The defaults are those for new files.
struct VtkXmlEncoding {
  VtkXmlMode mode = VtkXmlMode::appended;  ///< of the points, where a file mixes them
  bool appended_base64 = false;            ///< the appended section is base64, not raw bytes
  VtkXmlCompressor compressor = VtkXmlCompressor::none;
  bool big_endian = false;
  bool wide_block_headers = true;  ///< UInt64 in front of the blocks, not UInt32
  bool sizes_apart = false;  ///< of base64 in the elements: the size of an array is encoded apart from its numbers
};

/// The facts that stand at the start of a file, and where its appended section lies.
struct VtkXmlHeader {
  VtkXmlEncoding encoding;
  std::size_t appended_begin = 0;  ///< first byte behind the '_'
  std::size_t appended_end = 0;    ///< that of "</AppendedData"; equal to the begin where there is no section
};

/// The header of a file of `kind`, whose bytes are `bytes` and whose elements are `head`. Its mode is the mode of the
/// first array among the points, else of the first array. Throws ReadError.
VtkXmlHeader read_vtk_xml_header(const std::filesystem::path& path, std::string_view bytes, const XmlHead& head,
                                 VtkXmlKind kind);

/// The attribute `format` of an array element; ascii where there is none. Throws ReadError.
VtkXmlMode vtk_xml_mode_of(const std::filesystem::path& path, const XmlElement& array);

}  // namespace trismooth
