// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/machine/call_limit.h"

#include <utility>

namespace trismooth {

namespace {

thread_local CallLimit* in_force = nullptr;

}  // namespace

CallLimit::CallLimit(double seconds, std::function<bool()> cancel, Clock::time_point begin)
    : most_seconds_(seconds), cancel_(std::move(cancel)), begin_(begin), outer_(std::exchange(in_force, this)) {}

CallLimit::CallLimit(double seconds, CallLimit& whole)
    : most_seconds_(seconds), whole_(&whole), begin_(whole.begin_), outer_(std::exchange(in_force, this)) {}

CallLimit::~CallLimit() {
  in_force = outer_;
}

CallLimit::Hidden::Hidden() : hidden_(std::exchange(in_force, nullptr)) {}

CallLimit::Hidden::~Hidden() {
  in_force = hidden_;
}

CallLimit* CallLimit::current() noexcept {
  return in_force;
}

std::optional<CallEnd> CallLimit::end() {
  const Clock::time_point now = Clock::now();
  if (std::chrono::duration<double>(now - begin_).count() >= most_seconds_) {
    return CallEnd::time_is_up;
  }
  return is_cancelled(now) ? std::optional(CallEnd::cancelled) : std::nullopt;
}

bool CallLimit::is_cancelled(Clock::time_point now) {
  if (whole_ != nullptr) {
    return whole_->is_cancelled(now);
  }
  if (is_cancelled_.load(std::memory_order_relaxed)) {
    return true;
  }
  if (cancel_ && std::this_thread::get_id() == thread_ && now - asked_ >= between_questions) {
    ask(now);
  }
  return is_cancelled_.load(std::memory_order_relaxed);
}

void CallLimit::ask(Clock::time_point now) {
  const Hidden hidden;  // what the caller does meanwhile is not part of the call
  asked_ = now;
  if (cancel_()) {
    is_cancelled_.store(true, std::memory_order_relaxed);
  }
}

void CallLimit::check_unlifted() {
  if (const std::optional<CallEnd> over = end()) {
    throw CallEnded{*over};  // NOLINT(bugprone-std-exception-baseclass): who catches all errors is not to catch it
  }
}

}  // namespace trismooth
