#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "trismooth/base/worker_threads.h"

namespace trismooth {

/// A number of threads to run loops on. No result of this project depends on the number: loops write to places of
/// their own, and sums go over fixed blocks in a fixed order.
class Workers {
 public:
  /// `threads` = 0: one for each core that the process may use. More threads than cores are really started,
  /// unless the system refuses them; then the loops have to do with fewer. Throws std::invalid_argument for a negative
  /// number and for more than most_threads().
  explicit Workers(int threads)
      : count_(allowed_threads(checked_threads(threads) > 0 ? threads : tbb::this_task_arena::max_concurrency())),
        arena_(count_) {
    if (count_ > tbb::this_task_arena::max_concurrency()) {
      limit_ = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, count_);
    }
  }

  int count() const { return count_; }

  /// Calls `function` where for_blocks() is cheapest: many loops inside one call need not enter the arena each.
  template <class Function>
  void run(Function&& function) {
    count_ == 1 ? function() : arena_.execute(std::forward<Function>(function));
  }

  /// For those who call TBB themselves in run(): the threads are there from then on. for_blocks() needs no call.
  void start() {
    const int allowed = start_worker_threads(count_);
    if (allowed < count_) {
      count_ = allowed;
      arena_.initialize(allowed);  // unless it is at work already
    }
  }

  /// Calls body(begin, end) on parts of [0, size) of no less than half of `grain` elements, in any order, on all
  /// threads; on the calling thread alone, in one part, where there is one thread or no more than `grain` elements.
  template <class Body>
  void for_blocks(std::int64_t size, std::int64_t grain, const Body& body) {
    if (size <= 0) {
      return;
    }
    if (count_ == 1 || size <= grain) {
      body(std::int64_t{0}, size);
      return;
    }
    start();
    arena_.execute([&] {
      tbb::parallel_for(tbb::blocked_range<std::int64_t>(0, size, grain),
                        [&](const auto& range) { body(range.begin(), range.end()); });
    });
  }

 private:
  int count_;
  std::unique_ptr<tbb::global_control> limit_;
  tbb::task_arena arena_;
};

}  // namespace trismooth
