// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_xml/encoding/vtk_compressor.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <utility>

#include <vtkLZ4DataCompressor.h>
#include <vtkLZMADataCompressor.h>
#include <vtkZLibDataCompressor.h>

namespace trismooth {

namespace {

/// One of VTK's compressors that looks ahead. They keep nothing between two blocks.
template <class Compressor>
class Ahead final : public Compressor {
 public:
  static vtkSmartPointer<vtkDataCompressor> make(std::vector<std::span<const std::byte>> arrays, Workers& workers) {
    auto* const compressor = new Ahead(std::move(arrays), workers);
    compressor->InitializeObjectBase();
    return vtkSmartPointer<vtkDataCompressor>::Take(compressor);
  }

 protected:
  std::size_t CompressBuffer(const unsigned char* data, std::size_t size, unsigned char* target,
                             std::size_t room) override {
    if (next_ == count_ || blocks_[next_].data != data || blocks_[next_].size != size) {
      compress_ahead(data, size);
    }
    if (next_ == count_) {
      return Compressor::CompressBuffer(data, size, target, room);
    }
    const Block& block = blocks_[next_++];
    if (block.compressed_size == 0 || block.compressed_size > room) {
      return Compressor::CompressBuffer(data, size, target, room);
    }
    std::memcpy(target, block.compressed.data(), block.compressed_size);
    return block.compressed_size;
  }

 private:
  struct Block {
    const unsigned char* data = nullptr;
    std::size_t size = 0;
    std::vector<unsigned char> compressed;
    std::size_t compressed_size = 0;
  };

  Ahead(std::vector<std::span<const std::byte>> arrays, Workers& workers)
      : arrays_(std::move(arrays)), workers_(workers) {}

  /// Bytes from `data` to the end of its array; 0 where it is in none.
  std::size_t bytes_from(const unsigned char* data) const {
    const auto at = reinterpret_cast<std::uintptr_t>(data);
    for (const std::span<const std::byte> array : arrays_) {
      const auto begin = reinterpret_cast<std::uintptr_t>(array.data());
      if (begin <= at && at < begin + array.size()) {
        return begin + array.size() - at;
      }
    }
    return 0;
  }

  /// Compresses the block and those behind it.
  void compress_ahead(const unsigned char* data, std::size_t size) {
    constexpr std::size_t blocks_a_worker = 8;
    next_ = 0;
    count_ = 0;
    std::size_t left = bytes_from(data);
    if (size == 0 || left <= size) {
      return;
    }
    blocks_.resize(blocks_a_worker * static_cast<std::size_t>(workers_.count()));
    for (; count_ < blocks_.size() && left > 0; ++count_) {
      blocks_[count_].data = data;
      blocks_[count_].size = std::min(size, left);
      data += blocks_[count_].size;
      left -= blocks_[count_].size;
    }
    workers_.for_blocks(static_cast<std::int64_t>(count_), 1, [this](std::int64_t first, std::int64_t last) {
      for (std::int64_t i = first; i < last; ++i) {
        Block& block = blocks_[static_cast<std::size_t>(i)];
        block.compressed.resize(this->GetMaximumCompressionSpace(block.size));
        block.compressed_size =
            Compressor::CompressBuffer(block.data, block.size, block.compressed.data(), block.compressed.size());
      }
    });
  }

  std::vector<std::span<const std::byte>> arrays_;
  Workers& workers_;
  std::vector<Block> blocks_;
  std::size_t count_ = 0;  ///< of the blocks that are compressed
  std::size_t next_ = 0;   ///< the one of them that is to be asked for
};

}  // namespace

vtkSmartPointer<vtkDataCompressor> make_vtk_compressor(VtkXmlCompressor compressor) {
  switch (compressor) {
    case VtkXmlCompressor::none:
      break;
    case VtkXmlCompressor::zlib:
      return vtkSmartPointer<vtkZLibDataCompressor>::New();
    case VtkXmlCompressor::lz4:
      return vtkSmartPointer<vtkLZ4DataCompressor>::New();
    case VtkXmlCompressor::lzma:
      return vtkSmartPointer<vtkLZMADataCompressor>::New();
  }
  return nullptr;
}

vtkSmartPointer<vtkDataCompressor> make_vtk_compressor(VtkXmlCompressor compressor,
                                                       std::vector<std::span<const std::byte>> arrays,
                                                       Workers& workers) {
  switch (compressor) {
    case VtkXmlCompressor::none:
      break;
    case VtkXmlCompressor::zlib:
      return Ahead<vtkZLibDataCompressor>::make(std::move(arrays), workers);
    case VtkXmlCompressor::lz4:
      return Ahead<vtkLZ4DataCompressor>::make(std::move(arrays), workers);
    case VtkXmlCompressor::lzma:
      return Ahead<vtkLZMADataCompressor>::make(std::move(arrays), workers);
  }
  return nullptr;
}

}  // namespace trismooth
