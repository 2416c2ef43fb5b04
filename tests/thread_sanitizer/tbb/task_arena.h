// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What the project uses of TBB, made of nothing but threads of the standard library, for the build with the thread
// sanitizer alone (preset tsan). TBB's own library is not instrumented: the sanitizer cannot see what it orders, and
// would report everything that one loop writes and the next one reads. Here it sees all there is, and nothing that is
// not: parts of one loop are ordered by nothing.

#include <algorithm>
#include <thread>

namespace tbb {

namespace this_task_arena {

inline thread_local int concurrency = 0;  ///< of the arena that this thread is in; 0: of none

inline int max_concurrency() {
  return concurrency > 0 ? concurrency : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace this_task_arena

class task_arena {
 public:
  explicit task_arena(int threads) : threads_(threads) {}
  void initialize(int threads) { threads_ = threads; }

  template <class Function>
  auto execute(Function&& function) {
    const Entered entered(threads_);
    return function();
  }

 private:
  struct Entered {
    explicit Entered(int threads) { this_task_arena::concurrency = threads; }
    Entered(const Entered&) = delete;
    Entered& operator=(const Entered&) = delete;
    ~Entered() { this_task_arena::concurrency = outside; }

    int outside = this_task_arena::concurrency;
  };

  int threads_;
};

}  // namespace tbb
