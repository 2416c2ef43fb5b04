// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <thread>

namespace trismooth {

/// Why a call is over before it has done what it was called for.
enum class CallEnd : std::uint8_t {
  time_is_up,
  cancelled,  ///< by the caller
};

/// What leaves a call by then. No std::exception: only who set the limit catches it.
struct CallEnded {
  CallEnd end;
};

/// How long a call may take, and whether its caller still wants it: in force on the thread that made it, until it goes.
/// While it is, every loop of Workers that this thread begins looks at it block by block, and CallEnded leaves the
/// loop once it is over. What cannot be left half done lifts it first.
class CallLimit {
 public:
  using Clock = std::chrono::steady_clock;

  /// `seconds`: from `begin` on, may be infinite. `cancel`: asked on this thread, every few milliseconds; true: the
  /// call is over. Empty: nobody is asked. What it throws leaves the loop that asked.
  CallLimit(double seconds, std::function<bool()> cancel, Clock::time_point begin = Clock::now());
  /// Another limit of time for a part of the call of `whole`, from the beginning of that call. The caller is asked by
  /// `whole`, which remembers what he says. It is in force on this thread, and stays until this has gone.
  CallLimit(double seconds, CallLimit& whole);
  CallLimit(const CallLimit&) = delete;
  CallLimit& operator=(const CallLimit&) = delete;
  ~CallLimit();

  /// While it is there, the thread that made it has no limit. Goes on that thread.
  class Hidden {
   public:
    Hidden();
    Hidden(const Hidden&) = delete;
    Hidden& operator=(const Hidden&) = delete;
    ~Hidden();

   private:
    CallLimit* hidden_;
  };

  /// That of this thread, the innermost one; null: there is none, or it is hidden, as while its caller is
  /// asked.
  static CallLimit* current() noexcept;
  /// For loops that are not those of Workers: throws CallEnded where this thread's is over, unless it is lifted.
  static void look() {
    if (CallLimit* const limit = current()) {
      limit->check();
    }
  }
  /// Whether this thread's is over, lifted or not.
  static bool is_over() {
    CallLimit* const limit = current();
    return limit != nullptr && limit->end().has_value();
  }

  /// When this thread's began: now where there is none.
  static Clock::time_point begin_of_current() {
    const CallLimit* const limit = current();
    return limit != nullptr ? limit->begin_ : Clock::now();
  }
  /// Since it began.
  double seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }
  /// Why it is over, if it is. The caller is asked where this is the thread that it is in force on.
  std::optional<CallEnd> end();
  /// What comes behind the part of the call that goes on for as long as there is time takes about so many seconds.
  void keep_back(double seconds) { kept_back_ = seconds; }
  /// As much; none: nobody knows.
  std::optional<double> kept_back() const { return kept_back_; }
  /// Throws CallEnded where it is over, unless it is lifted. On any thread.
  void check() {
    if (!is_lifted_) {
      check_unlifted();
    }
  }

  /// From now on nothing is thrown: the call runs to an end of its own, as soon as it can.
  void lift() { is_lifted_ = true; }
  /// lift() of this thread's, if there is one.
  static void lift_current() {
    if (CallLimit* const limit = current()) {
      limit->lift();
    }
  }
  bool is_lifted() const { return is_lifted_; }

 private:
  static constexpr std::chrono::milliseconds between_questions{5};

  void check_unlifted();
  bool is_cancelled(Clock::time_point now);
  void ask(Clock::time_point now);

  double most_seconds_;
  CallLimit* whole_ = nullptr;
  std::function<bool()> cancel_;
  std::thread::id thread_ = std::this_thread::get_id();
  Clock::time_point begin_;
  Clock::time_point asked_ = begin_ - between_questions;
  std::atomic<bool> is_cancelled_{false};
  bool is_lifted_ = false;  ///< written between loops alone
  std::optional<double> kept_back_;
  CallLimit* outer_;
};

}  // namespace trismooth
