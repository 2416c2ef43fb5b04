// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/machine/worker_threads.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <limits>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include <pthread.h>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace trismooth {

namespace {

/// Starts threads and holds those that have come in loops of two, each within the one before, until all are there: so a
/// new thread is needed for each loop, and the calling thread is the one that starts it and gets the error.
class Starter {
 public:
  explicit Starter(int count) : count_(count) {
    add();
    release();
  }

  int started() const { return started_; }
  bool was_refused() const { return was_refused_; }

 private:
  void add() {
    if (started_ == count_) {
      return;
    }
    std::atomic<bool> came{false};
    bool entered = false;
    try {
      tbb::task_arena(2).execute([&] {
        tbb::parallel_for(tbb::blocked_range<int>(0, 2, 1), [&](const auto&) {
          if (std::this_thread::get_id() != caller_) {
            came = true;
            released_.wait(false);
          } else if (!std::exchange(entered, true)) {
            if (await(came)) {
              ++started_;
              add();
            }
            release();
          }
        });
      });
    } catch (...) {
      was_refused_ = true;  // what was started before is there all the same
    }
    release();
  }

  /// False where nobody comes: no refusal, but all of TBB's threads are at other work, or wait for this one.
  static bool await(const std::atomic<bool>& came) {
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::milliseconds(500);
    while (!came && std::chrono::steady_clock::now() < give_up) {
      std::this_thread::yield();
    }
    return came;
  }

  void release() {
    released_ = true;
    released_.notify_all();
  }

  const std::thread::id caller_ = std::this_thread::get_id();
  const int count_;
  int started_ = 1;
  bool was_refused_ = false;
  std::atomic<bool> released_{false};
};

/// What TBB can start.
int startable_threads() {
  constexpr std::size_t always = 256;
  const auto cores = static_cast<std::size_t>(std::thread::hardware_concurrency());
  return static_cast<int>(std::min(std::max(always, 2 * cores),
                                   tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism)));
}

std::atomic<int> most_allowed{std::numeric_limits<int>::max()};

std::atomic<bool> lost_threads{false};

}  // namespace

int most_threads() {
  constexpr unsigned always = 1024;
  return static_cast<int>(std::max(always, std::thread::hardware_concurrency()));
}

int checked_threads(int threads) {
  if (threads < 0 || threads > most_threads()) {
    throw std::invalid_argument("the number of threads must be from 0 (one for each core) to " +
                                std::to_string(most_threads()) + ", not " + std::to_string(threads));
  }
  return threads;
}

int start_worker_threads(int count) {
  static std::atomic<int> known{1};
  expect_fork();
  if (count > known) {
    static std::mutex mutex;
    static std::unique_ptr<tbb::global_control> limit;
    const std::lock_guard lock(mutex);
    if (count > known && limit == nullptr) {
      const Starter starter(std::min(count, startable_threads()));
      if (starter.was_refused()) {
        // Half of those that could be started: TBB takes another thread at times where one is about to fall asleep.
        most_allowed = 1 + (starter.started() - 1) / 2;
        limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                      static_cast<std::size_t>(most_allowed));
      }
      known = count;
    }
  }
  return allowed_threads(count);
}

void expect_fork() {
  // A thread that has just ended its part of a loop may have a lock of TBB's allocator, which the child would ask for
  // at its end. It has none after some microseconds, and long before it sleeps.
  static const int refused = pthread_atfork([] { std::this_thread::sleep_for(std::chrono::milliseconds(2)); }, nullptr,
                                            [] { lost_threads = true; });
  static_cast<void>(refused);  // for want of memory: a child may wait for ever then, as it would without this
}

bool has_lost_threads() {
  return lost_threads.load(std::memory_order_relaxed);
}

int allowed_threads(int count) {
  return std::min<int>(count, most_allowed);
}

}  // namespace trismooth
