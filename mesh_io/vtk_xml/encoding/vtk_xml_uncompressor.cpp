// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_xml/encoding/vtk_xml_uncompressor.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <memory>

#include "trismooth/mesh_io/bytes/saturating_product.h"
#include "trismooth/mesh_io/vtk_xml/encoding/vtk_compressor.h"

namespace trismooth {

namespace {

/// No block gets larger than that many times its compressed size (and a little): a larger one is not even tried.
std::uint64_t most_expansion(VtkXmlCompressor compressor) {
  switch (compressor) {
    case VtkXmlCompressor::none:
      break;
    case VtkXmlCompressor::zlib:
      return 1032;
    case VtkXmlCompressor::lz4:
      return 255;
    case VtkXmlCompressor::lzma:
      return 16384;
  }
  return 1;
}

}  // namespace

VtkXmlUncompressor::VtkXmlUncompressor(const VtkXmlArrayPlaces& places, const FileWorkers& workers)
    : places_(places), workers_(workers), compressor_(make_vtk_compressor(places.encoding().compressor)) {
  messages_.watch(compressor_);
}

const unsigned char* VtkXmlUncompressor::compressed_block(const XmlElement& array, EncodedBytes& source,
                                                          std::uint64_t compressed_size) {
  if (compressed_size > source.most_available()) {
    places_.fail(array, "declares a compressed block of " + std::to_string(compressed_size) + " bytes, but has " +
                            std::to_string(source.most_available()) + " at most");
  }
  if (places_.mode_of(array) == VtkXmlMode::appended && !places_.encoding().appended_base64) {
    return reinterpret_cast<const unsigned char*>(source.view(compressed_size).data());
  }
  compressed_block_.resize(compressed_size);
  if (!source.read(reinterpret_cast<std::byte*>(compressed_block_.data()), compressed_size)) {
    places_.fail(array, "is cut off or not base64");
  }
  return compressed_block_.data();
}

void VtkXmlUncompressor::uncompress_block(const XmlElement& array, EncodedBytes& source, std::uint64_t compressed_size,
                                          std::uint64_t size, MemoryBlock& bytes) {
  // VTK's compressors take some sizes as int.
  constexpr std::uint64_t most = std::numeric_limits<int>::max();
  if (size > most || compressed_size > most) {
    places_.fail(array, "declares a compressed block of more than 2 GiB");
  }
  if (size > saturating_product(compressed_size, most_expansion(places_.encoding().compressor)) + 64) {
    places_.fail(array, "declares " + std::to_string(size) + " bytes in a compressed block of " +
                            std::to_string(compressed_size));
  }
  const unsigned char* const compressed = compressed_block(array, source, compressed_size);
  auto* const target = reinterpret_cast<unsigned char*>(bytes.extend(size));
  messages_.clear();
  if (size != 0 && (compressor_->Uncompress(compressed, compressed_size, target, size) != size ||
                    !messages_.first_error().empty())) {
    places_.fail(array, "holds a compressed block that is damaged");
  }
}

/// Uncompresses the first blocks, `wanted` at most, on all workers; how many those were. At the first one with anything
/// wrong in it, or before, it leaves off, and `source` stands there.
std::size_t VtkXmlUncompressor::uncompress_shared(EncodedBytes& source,
                                                  const std::vector<std::uint64_t>& compressed_sizes,
                                                  std::uint64_t block_size, std::uint64_t last_size, std::size_t wanted,
                                                  MemoryBlock& bytes) const {
  constexpr std::size_t blocks_a_worker = 8;  // at a time: no more memory is taken than what has been decoded asks for
  constexpr std::uint64_t most_block_bytes = std::uint64_t{1} << 24;  // more than any writer makes of one block
  if (workers_.part_bytes == FileWorkers::whole || workers_.part_bytes == FileWorkers::serial ||
      block_size > most_block_bytes || block_size == 0) {
    return 0;
  }
  struct Uncompressor {
    vtkSmartPointer<vtkDataCompressor> compressor;
    VtkMessages messages;
  };
  std::vector<std::unique_ptr<Uncompressor>> uncompressors;
  for (int i = 0; i < workers_.workers.count(); ++i) {
    uncompressors.push_back(std::make_unique<Uncompressor>());
    uncompressors.back()->compressor = make_vtk_compressor(places_.encoding().compressor);
    uncompressors.back()->messages.watch(uncompressors.back()->compressor);
  }
  for (std::size_t done = 0;;) {
    const std::size_t count = std::min(blocks_a_worker * uncompressors.size(), wanted - done);
    const EncodedBytes source_before = source;
    const std::size_t size_before = bytes.size();
    std::vector<std::size_t> compressed_begins{0};
    std::vector<std::size_t> begins{0};
    bool sound = true;
    for (std::size_t block = done; block < done + count && sound; ++block) {
      const std::uint64_t compressed_size = compressed_sizes[block];
      const std::uint64_t size = block + 1 == compressed_sizes.size() ? last_size : block_size;
      sound = compressed_size <= most_block_bytes &&
              compressed_size <= source.most_available() - compressed_begins.back() && size > 0 &&
              size <= saturating_product(compressed_size, most_expansion(places_.encoding().compressor)) + 64;
      compressed_begins.push_back(compressed_begins.back() + compressed_size);
      begins.push_back(begins.back() + size);
    }
    if (count == 0 || !sound) {
      return done;
    }
    MemoryBlock compressed;
    if (source.append_to(compressed, compressed_begins.back(), workers_)) {
      auto* const target = reinterpret_cast<unsigned char*>(bytes.extend(begins.back()));
      const auto* const from = reinterpret_cast<const unsigned char*>(compressed.data());
      std::atomic<std::size_t> next_block = 0;
      std::atomic<bool> failed = false;
      const auto uncompress = [&](Uncompressor& one) {
        for (std::size_t i = next_block++; i < count && !failed; i = next_block++) {
          const std::size_t size = begins[i + 1] - begins[i];
          one.messages.clear();
          if (one.compressor->Uncompress(from + compressed_begins[i], compressed_begins[i + 1] - compressed_begins[i],
                                         target + begins[i], size) != size ||
              !one.messages.first_error().empty()) {
            failed = true;
          }
        }
      };
      workers_.workers.for_blocks(static_cast<std::int64_t>(uncompressors.size()), 1,
                                  [&](std::int64_t first, std::int64_t last) {
                                    for (std::int64_t i = first; i < last; ++i) {
                                      uncompress(*uncompressors[static_cast<std::size_t>(i)]);
                                    }
                                  });
      if (!failed) {
        done += count;
        continue;
      }
    }
    bytes.truncate(size_before);
    source = source_before;
    return done;
  }
}

bool VtkXmlUncompressor::read(const XmlElement& array, EncodedBytes& source, std::size_t word_size,
                              std::optional<std::uint64_t> expected, MemoryBlock& bytes) {
  const std::vector<std::uint64_t> header = places_.read_header_words(array, source, 3);
  const std::uint64_t blocks = header[0];
  const std::uint64_t block_size = header[1];
  const std::uint64_t last_size = header[2] == 0 ? block_size : header[2];
  const std::vector<std::uint64_t> compressed_sizes = places_.read_header_words(array, source, blocks);
  if (!source.end_run()) {
    places_.fail(array, "has a block header that does not end where it should");
  }
  if (last_size > block_size) {
    places_.fail(array, "has a last block larger than the others");
  }
  const std::uint64_t whole_blocks = blocks == 0 ? 0 : saturating_product(blocks - 1, block_size);
  const std::uint64_t total = blocks == 0 ? 0 : whole_blocks + std::min(last_size, ~whole_blocks);
  places_.check_size(array, total, word_size, expected);
  const std::size_t begin = bytes.size();
  const std::uint64_t wanted = expected && block_size > 0 ? *expected / block_size : blocks;
  std::size_t block = uncompress_shared(source, compressed_sizes, block_size, last_size,
                                        static_cast<std::size_t>(std::min(wanted, blocks)), bytes);
  for (; block < blocks; ++block) {
    if (expected && bytes.size() - begin >= *expected) {
      compressed_block(array, source, compressed_sizes[block]);  // of what nobody asked for
      continue;
    }
    uncompress_block(array, source, compressed_sizes[block], block + 1 == blocks ? last_size : block_size, bytes);
  }
  if (!source.end_run()) {
    places_.fail(array, "has more compressed data than it declares");
  }
  return expected && total > *expected;
}

}  // namespace trismooth
