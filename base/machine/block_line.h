// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <vector>

namespace trismooth {

/// Blocks 0 to `count` - 1 that many threads work on and that are handed on one at a time, in their order. At most
/// `places` of them are on their way; see Workers::for_blocks_in_order() for what is promised of places and exceptions.
/// Nobody is kept for handing on: whoever ends the block whose turn it is does it, and goes on for those that are ready
/// behind it. So one thread by itself gets through, and nobody waits for a thread that has not come.
class BlockLine {
 public:
  using Step = std::function<void(std::size_t block, std::size_t place)>;

  /// `work` and `then` must outlive the line.
  BlockLine(std::size_t count, std::size_t places, const Step& work, const Step& then);

  /// Takes part until no block is left to begin: to be called once by each thread. Exceptions of the steps are kept.
  void serve();

  /// To be called when all have served: throws what the first block that failed has thrown, if any has.
  void rethrow() const;

 private:
  void hand_on(std::unique_lock<std::mutex>& lock);
  void attempt(std::unique_lock<std::mutex>& lock, const Step& step, std::size_t block);

  std::size_t places_;
  const Step& work_;
  const Step& then_;
  std::mutex mutex_;
  std::condition_variable place_is_free_;
  std::size_t end_;                  ///< blocks from here on are not to be done: the count, or the first that failed
  std::size_t next_ = 0;             ///< the block to begin
  std::size_t handed_on_ = 0;        ///< how many were
  bool is_handing_on_ = false;       ///< somebody is
  std::vector<std::uint8_t> ready_;  ///< at each place: its block waits to be handed on
  std::exception_ptr failure_;       ///< of the block `end_`
};

}  // namespace trismooth
