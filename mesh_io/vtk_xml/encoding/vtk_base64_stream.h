// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include <vtkBase64OutputStream.h>
#include <vtkSmartPointer.h>

#include "trismooth/mesh_io/bytes/memory_block.h"
#include "trismooth/mesh_io/bytes/ordered_blocks.h"

namespace trismooth {

/// The stream through which VTK's writers write base64, with all workers: it gathers bytes between StartWriting() and
/// EndWriting(), a few blocks for each worker at a time, and encodes these together. The same bytes as VTK's.
class VtkBase64Stream final : public vtkBase64OutputStream {
 public:
  /// What of each run of bytes is encoded apart from the rest, with an end of its own: nothing, or what comes first, an
  /// array's size where VTK's writers use it.
  enum class Apart : bool { nothing, first };

  /// `workers` must outlive it.
  static vtkSmartPointer<VtkBase64Stream> make(const FileWorkers& workers, Apart apart);

  int StartWriting() override;
  int Write(const void* data, std::size_t length) override;
  int EndWriting() override;

 private:
  VtkBase64Stream(const FileWorkers& workers, Apart apart);

  void encode();

  std::size_t block_bytes_;
  std::size_t most_gathered_;
  Apart apart_;
  bool is_first_ = true;
  MemoryBlock gathered_;  ///< bytes not encoded yet
  OrderedBlocks blocks_;
};

}  // namespace trismooth
