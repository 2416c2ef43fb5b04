// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/cli/ticker.h"

#include <atomic>
#include <chrono>
#include <csignal>
#include <stdexcept>
#include <thread>

#include "catch.h"

namespace trismooth::ticker_test {

using namespace std::chrono_literals;

void wait_for(const std::atomic<int>& calls, int least) {
  while (calls < least) {
    std::this_thread::sleep_for(1ms);
  }
}

TEST_CASE("a ticker calls until it is gone, and not after that") {
  std::atomic<int> calls{0};
  {
    const Ticker ticker(1ms, [&] { ++calls; });
    wait_for(calls, 3);
  }
  const int at_end = calls;
  std::this_thread::sleep_for(5ms);
  CHECK(calls == at_end);
}

TEST_CASE("a ticker ends at once, however long its interval, and without a call") {
  std::atomic<int> calls{0};
  {
    const Ticker ticker(std::chrono::hours(100), [&] { ++calls; });
  }
  CHECK(calls == 0);
}

TEST_CASE("what a tick throws ends nothing") {
  std::atomic<int> calls{0};
  const Ticker ticker(1ms, [&] {
    ++calls;
    throw std::runtime_error("no memory for the text");
  });
  wait_for(calls, 2);
  CHECK(calls >= 2);
}

TEST_CASE("signals are left to the threads that work") {
  std::atomic<int> calls{0};
  std::atomic<bool> blocked{false};
  {
    const Ticker ticker(1ms, [&] {
      sigset_t mask;
      pthread_sigmask(SIG_BLOCK, nullptr, &mask);
      blocked = sigismember(&mask, SIGINT) == 1 && sigismember(&mask, SIGTERM) == 1;
      ++calls;
    });
    wait_for(calls, 1);
  }
  CHECK(blocked);
  sigset_t mine;
  pthread_sigmask(SIG_BLOCK, nullptr, &mine);
  CHECK(sigismember(&mine, SIGINT) == 0);
}

}  // namespace trismooth::ticker_test
