// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/machine/block_line.h"

#include <algorithm>

namespace trismooth {

BlockLine::BlockLine(std::size_t count, std::size_t places, const Step& work, const Step& then)
    : places_(places), work_(work), then_(then), end_(count), ready_(std::min(count, places), 0) {}

void BlockLine::serve() {
  std::unique_lock lock(mutex_);
  while (next_ < end_) {
    const std::size_t block = next_++;
    // The block handed_on_ never waits, so there is always somebody who gets on.
    place_is_free_.wait(lock, [&] { return block - handed_on_ < places_ || block >= end_; });
    attempt(lock, work_, block);
    if (block < end_) {
      ready_[block % places_] = 1;
      hand_on(lock);
    }
  }
}

/// Hands on what is ready, unless somebody is at it, who looks for more before leaving.
void BlockLine::hand_on(std::unique_lock<std::mutex>& lock) {
  if (is_handing_on_) {
    return;
  }
  is_handing_on_ = true;
  while (handed_on_ < end_ && ready_[handed_on_ % places_] != 0) {
    ready_[handed_on_ % places_] = 0;
    attempt(lock, then_, handed_on_);
    if (handed_on_ < end_) {
      ++handed_on_;
      place_is_free_.notify_all();
    }
  }
  is_handing_on_ = false;
}

/// Takes the step without the lock, unless the block is behind one that failed; if it fails, it is the end.
void BlockLine::attempt(std::unique_lock<std::mutex>& lock, const Step& step, std::size_t block) {
  if (block >= end_) {
    return;
  }
  lock.unlock();
  std::exception_ptr failure;
  try {
    step(block, block % places_);
  } catch (...) {
    failure = std::current_exception();
  }
  lock.lock();
  if (failure && block < end_) {
    end_ = block;
    failure_ = failure;
    place_is_free_.notify_all();
  }
}

void BlockLine::rethrow() const {
  if (failure_) {
    std::rethrow_exception(failure_);
  }
}

}  // namespace trismooth
