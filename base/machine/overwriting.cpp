// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/machine/overwriting.h"

#include <cstdint>
#include <cstring>
#include <system_error>

#include "trismooth/base/machine/workers.h"

namespace trismooth {

std::byte* ScratchBytes::get(std::size_t size) {
  if (size > size_) {
    size_ = 0;
    bytes_.reset();
    // Cleared memory would be touched by one thread before all threads do.
    bytes_ = std::make_unique_for_overwrite<std::byte[]>(size);
    size_ = size;
  }
  return bytes_.get();
}

void copy_by_all(std::byte* to, const std::byte* from, std::size_t size, Workers& workers) {
  constexpr std::int64_t grain = 1 << 17;
  workers.for_blocks(static_cast<std::int64_t>(size), grain, [&](std::int64_t begin, std::int64_t end) {
    std::memcpy(to + begin, from + begin, static_cast<std::size_t>(end - begin));
  });
}

Overwriting::Overwriting(std::span<std::byte> memory, ScratchBytes* kept, Workers& workers)
    : memory_(memory), kept_(kept == nullptr ? nullptr : kept->get(memory.size())), workers_(workers) {}

Overwriting::~Overwriting() {
  if (!is_done_ && kept_ != nullptr && passed_ > 0) {
    std::memcpy(memory_.data(), kept_, passed_);
  }
}

void Overwriting::keep_meanwhile() {
  if (kept_ == nullptr) {
    return;
  }
  try {
    keeping_ = std::async(std::launch::async, [this] { copy_by_all(kept_, memory_.data(), memory_.size(), workers_); });
  } catch (const std::system_error&) {
    // No thread to be had: piece by piece, then.
  }
}

void Overwriting::give_away(std::size_t size) {
  if (keeping_.valid()) {
    keeping_.get();
    is_all_kept_ = true;
  }
  if (kept_ != nullptr && !is_all_kept_) {
    copy_by_all(kept_ + passed_, memory_.data() + passed_, size, workers_);
  }
  passed_ += size;
}

void Overwriting::write(const std::byte* from, std::size_t size) {
  std::byte* const target = memory_.data() + passed_;
  give_away(size);
  copy_by_all(target, from, size, workers_);
}

}  // namespace trismooth
