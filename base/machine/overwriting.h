// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <future>
#include <memory>
#include <span>

namespace trismooth {

class Workers;

/// Memory that grows to what is asked for and is never cleared.
class ScratchBytes {
 public:
  /// `size` bytes of any content, valid until the next call. Throws std::bad_alloc.
  std::byte* get(std::size_t size);

 private:
  std::unique_ptr<std::byte[]> bytes_;
  std::size_t size_ = 0;
};

/// Copies bytes on all workers.
void copy_by_all(std::byte* to, const std::byte* from, std::size_t size, Workers& workers);

/// Memory of the caller while it is overwritten from front to back, in pieces. Unless done() is called in the end, the
/// memory gets back what it had: whatever is thrown on the way, the caller finds the old or the new, never a mixture.
class Overwriting {
 public:
  /// Keeps what is overwritten in `kept`, which outlives this as `workers` do. Null: it is not kept, and what has been
  /// overwritten stays so. Throws std::bad_alloc; then nothing has happened.
  Overwriting(std::span<std::byte> memory, ScratchBytes* kept, Workers& workers);
  Overwriting(const Overwriting&) = delete;
  Overwriting& operator=(const Overwriting&) = delete;
  ~Overwriting();

  std::span<std::byte> memory() const { return memory_; }
  /// Begins to keep all of it, on a thread of its own: for an owner who has time until the first piece comes. Until
  /// then nobody else uses the workers.
  void keep_meanwhile();
  /// The next `size` bytes are about to be overwritten by somebody else, who is at rest before this is destroyed.
  void give_away(std::size_t size);
  /// Overwrites the next `size` bytes, on all workers.
  void write(const std::byte* from, std::size_t size);
  /// All has been overwritten, and stays so.
  void done() { is_done_ = true; }

 private:
  std::span<std::byte> memory_;
  std::byte* kept_;
  Workers& workers_;
  std::size_t passed_ = 0;
  bool is_all_kept_ = false;
  bool is_done_ = false;
  std::future<void> keeping_;
};

}  // namespace trismooth
