// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <vtkDataCompressor.h>
#include <vtkSmartPointer.h>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/bytes/memory_block.h"
#include "trismooth/mesh_io/vtk_xml/encoding/encoded_bytes.h"
#include "trismooth/mesh_io/vtk_xml/vtk_messages.h"
#include "trismooth/mesh_io/vtk_xml/vtk_xml_array_places.h"
#include "trismooth/mesh_io/xml/xml_tree.h"

namespace trismooth {

/// Reads arrays of a file whose arrays are compressed, which they are block by block.
class VtkXmlUncompressor {
 public:
  /// For a file that states a compressor. `places` and `workers` must outlive it.
  VtkXmlUncompressor(const VtkXmlArrayPlaces& places, const FileWorkers& workers);

  /// Appends the numbers of the array to `bytes`, in the file's byte order: as many blocks as `expected` bytes take, of
  /// which none may be missing; all where it is empty. True where the array has more bytes than expected. Throws
  /// ReadError.
  bool read(const XmlElement& array, EncodedBytes& source, std::size_t word_size, std::optional<std::uint64_t> expected,
            MemoryBlock& bytes);

 private:
  std::size_t uncompress_shared(EncodedBytes& source, const std::vector<std::uint64_t>& compressed_sizes,
                                std::uint64_t block_size, std::uint64_t last_size, std::size_t wanted,
                                MemoryBlock& bytes) const;
  const unsigned char* compressed_block(const XmlElement& array, EncodedBytes& source, std::uint64_t compressed_size);
  void uncompress_block(const XmlElement& array, EncodedBytes& source, std::uint64_t compressed_size,
                        std::uint64_t size, MemoryBlock& bytes);

  const VtkXmlArrayPlaces& places_;
  FileWorkers workers_;
  VtkMessages messages_;
  vtkSmartPointer<vtkDataCompressor> compressor_;
  std::vector<unsigned char> compressed_block_;
};

}  // namespace trismooth
