// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace trismooth {

/// Calls a function again and again from a thread of its own, which sleeps in between and gets no signals. Where no
/// thread can be had it does nothing.
class Ticker {
 public:
  /// The first call comes after one interval. What `tick` throws is lost, not the end of the program.
  Ticker(std::chrono::milliseconds interval, std::function<void()> tick);
  Ticker(const Ticker&) = delete;
  Ticker& operator=(const Ticker&) = delete;
  /// Waits for a call that is under way; afterwards there are no more.
  ~Ticker();

 private:
  void run(std::chrono::milliseconds interval);

  std::function<void()> tick_;
  std::mutex mutex_;
  std::condition_variable stopped_;
  bool stops_ = false;
  std::thread thread_;
};

}  // namespace trismooth
