// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/bytes/memory_block.h"

namespace trismooth {

/// Reads bytes that stand in a text as base64 or as they are. White space within base64 is skipped. Every read says
/// whether the bytes were there; a false one leaves the reader unusable.
class EncodedBytes {
 public:
  enum class Encoding : std::uint8_t { raw, base64 };

  EncodedBytes(std::string_view text, Encoding encoding) : text_(text), encoding_(encoding) {}

  /// No more bytes than that can follow.
  std::size_t most_available() const;

  /// Copies the next `count` bytes to `bytes`.
  bool read(std::byte* bytes, std::size_t count);

  /// Copies the next `count` bytes to the end of `block`, by all workers. The block is that much longer then, in any
  /// case.
  bool append_to(MemoryBlock& block, std::size_t count, const FileWorkers& workers);

  /// The next `count` bytes where they stand, for raw bytes only.
  std::string_view view(std::size_t count);

  /// True where all bytes of a run of base64 were read that ended with '=': what follows was encoded by itself.
  bool is_behind_padding() const { return padded_ && carried_begin_ == carried_end_; }

  /// Ends a run of base64: what follows was encoded by itself. False where bytes of the run are left over.
  bool end_run();

  /// Characters used so far, and those not yet used.
  std::size_t used() const { return position_; }
  std::string_view rest() const { return text_.substr(position_); }

 private:
  std::size_t decode_groups(std::byte* bytes, std::size_t groups, const FileWorkers& workers);
  bool decode_group(std::byte* bytes, std::size_t& count);

  std::string_view text_;
  Encoding encoding_;
  std::size_t position_ = 0;
  std::array<std::byte, 3> carried_{};  // decoded bytes of the last group that were not asked for yet
  std::size_t carried_begin_ = 0;
  std::size_t carried_end_ = 0;
  bool padded_ = false;  // the run ended with '='
};

}  // namespace trismooth
