// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/task_arena.h>

namespace tbb {

/// The range in parts of the grain, taken in turn by as many threads as the arena has. The first exception ends the
/// loop and is thrown again.
template <class T, class Body>
void parallel_for(const blocked_range<T>& range, const Body& body) {
  const T size = range.end() - range.begin();
  const T parts = std::max<T>(1, size / range.grainsize());
  std::atomic<T> next{0};
  std::mutex mutex;
  std::exception_ptr failure;
  const auto work = [&](int concurrency) {
    this_task_arena::concurrency = concurrency;
    // Relaxed: taking a part must not order what the parts do.
    for (T part = next.fetch_add(1, std::memory_order_relaxed); part < parts;
         part = next.fetch_add(1, std::memory_order_relaxed)) {
      try {
        body(blocked_range<T>(range.begin() + part * size / parts, range.begin() + (part + 1) * size / parts,
                              range.grainsize()));
      } catch (...) {
        const std::lock_guard lock(mutex);
        failure = failure ? failure : std::current_exception();
        next.store(parts, std::memory_order_relaxed);
      }
    }
  };
  const int concurrency = this_task_arena::max_concurrency();
  std::vector<std::thread> threads;
  for (T i = 1; i < std::min<T>(concurrency, parts); ++i) {
    threads.emplace_back(work, concurrency);
  }
  work(concurrency);
  for (std::thread& thread : threads) {
    thread.join();
  }
  if (failure) {
    std::rethrow_exception(failure);
  }
}

}  // namespace tbb
