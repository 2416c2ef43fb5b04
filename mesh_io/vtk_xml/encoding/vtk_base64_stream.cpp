// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_xml/encoding/vtk_base64_stream.h"

#include <algorithm>
#include <ostream>
#include <string_view>
#include <utility>

#include "trismooth/mesh_io/vtk_xml/encoding/base64.h"

namespace trismooth {

namespace {

/// Whole groups, so that blocks can be encoded by themselves.
std::size_t bytes_of_block(const FileWorkers& workers) {
  const std::size_t characters = std::min(workers.part_bytes, FileWorkers::default_part_bytes);
  return base64_group_bytes * std::max(std::size_t{1}, characters / base64_group_characters);
}

}  // namespace

VtkBase64Stream::VtkBase64Stream(const FileWorkers& workers, Apart apart)
    : block_bytes_(bytes_of_block(workers)),
      // With one thread no more than stays in its cache.
      most_gathered_(block_bytes_ * (workers.workers.count() == 1 ? 1 : 4 * workers.workers.count())),
      apart_(apart),
      blocks_([this](std::string_view text) { Stream->write(text.data(), static_cast<std::streamsize>(text.size())); },
              workers) {}

vtkSmartPointer<VtkBase64Stream> VtkBase64Stream::make(const FileWorkers& workers, Apart apart) {
  auto* const stream = new VtkBase64Stream(workers, apart);
  stream->InitializeObjectBase();
  return vtkSmartPointer<VtkBase64Stream>::Take(stream);
}

int VtkBase64Stream::StartWriting() {
  is_first_ = true;
  gathered_.truncate(0);
  return vtkBase64OutputStream::StartWriting();
}

int VtkBase64Stream::Write(const void* data, std::size_t length) {
  const auto* bytes = static_cast<const std::byte*>(data);
  while (length > 0) {
    const std::size_t taken = std::min(length, most_gathered_ - gathered_.size());
    gathered_.append(bytes, taken);
    bytes += taken;
    length -= taken;
    if (gathered_.size() == most_gathered_) {
      encode();
    }
  }
  if (std::exchange(is_first_, false) && apart_ == Apart::first) {
    encode();
  }
  return Stream->fail() ? 0 : 1;
}

int VtkBase64Stream::EndWriting() {
  encode();
  return Stream->fail() ? 0 : 1;
}

/// Encodes what is gathered: whole groups, or a run's end.
void VtkBase64Stream::encode() {
  const std::size_t size = gathered_.size();
  blocks_.write((size + block_bytes_ - 1) / block_bytes_, [this, size](std::size_t block, MemoryBlock& text) {
    const std::size_t begin = block * block_bytes_;
    append_base64(gathered_.data() + begin, std::min(block_bytes_, size - begin), text);
  });
  gathered_.truncate(0);
}

}  // namespace trismooth
