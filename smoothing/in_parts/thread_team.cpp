// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/in_parts/thread_team.h"

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <mutex>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "trismooth/base/machine/call_limit.h"

namespace trismooth {

namespace {

/// What waiting ends with where another part has failed. Nobody outside sees it.
struct OtherPartFailed : std::runtime_error {
  OtherPartFailed() : std::runtime_error("another part of the mesh has failed") {}
};

}  // namespace

/// Where the threads leave messages for each other, and wait.
class ThreadTeam::Meeting {
 public:
  explicit Meeting(int parts)
      : count_(parts), mail_(static_cast<std::size_t>(parts) * static_cast<std::size_t>(parts)) {}

  int count() const { return count_; }

  void post(int from, std::span<const PartMessenger::Message> messages) {
    {
      const std::lock_guard lock(mutex_);
      for (const PartMessenger::Message& message : messages) {
        mail(from, message.part) = message.bytes;
      }
    }
    changed_.notify_all();
  }

  void take(int to, const PartMessenger::Message& message) {
    std::span<const std::byte>& place = mail(message.part, to);
    std::span<const std::byte> sent;
    {
      std::unique_lock lock(mutex_);
      wait(lock, [&] { return place.data() != nullptr; });
      sent = place;
    }
    // (The sender leaves it alone until it is taken.)
    std::memcpy(message.bytes.data(), sent.data(), sent.size());
    {
      const std::lock_guard lock(mutex_);
      place = {};
    }
    changed_.notify_all();
  }

  void wait_until_taken(int from, int to) {
    std::unique_lock lock(mutex_);
    wait(lock, [&] { return mail(from, to).data() == nullptr; });
  }

  void join(PartSums& sums) {
    std::unique_lock lock(mutex_);
    if (arrived_ == 0) {
      gathering_ = sums;
    } else {
      gathering_.join(sums);
    }
    if (++arrived_ == count_) {
      arrived_ = 0;
      joined_ = gathering_;
      ++round_;
      changed_.notify_all();
    } else {
      wait(lock, [this, round = round_] { return round_ != round; });
    }
    // (The next round ends when all have left this one.)
    sums = joined_;
  }

  /// Nobody waits for a part that has failed.
  void fail(std::exception_ptr error) {
    {
      const std::lock_guard lock(mutex_);
      first_error_ = first_error_ == nullptr ? std::move(error) : first_error_;
    }
    changed_.notify_all();
  }

  /// When all threads have ended: throws what has been thrown, and is as new.
  void end() {
    for (std::span<const std::byte>& place : mail_) {
      place = {};
    }
    arrived_ = 0;
    if (first_error_ != nullptr) {
      std::rethrow_exception(std::exchange(first_error_, nullptr));
    }
  }

 private:
  std::span<const std::byte>& mail(int from, int to) {
    return mail_[static_cast<std::size_t>(from) * static_cast<std::size_t>(count_) + static_cast<std::size_t>(to)];
  }

  /// What has happened counts, whoever has failed since then.
  template <class Condition>
  void wait(std::unique_lock<std::mutex>& lock, const Condition& condition) {
    changed_.wait(lock, [&] { return condition() || first_error_ != nullptr; });
    if (!condition()) {
      throw OtherPartFailed();
    }
  }

  int count_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::span<const std::byte>> mail_;  ///< from each part to each part; null: nothing
  int arrived_ = 0;
  std::uint64_t round_ = 0;
  PartSums gathering_;
  PartSums joined_;
  std::exception_ptr first_error_;
};

class ThreadTeam::Messenger final : public PartMessenger {
 public:
  Messenger(std::shared_ptr<Meeting> meeting, int part) : meeting_(std::move(meeting)), part_(part) {}

  void start(std::span<const Message> sends, std::span<const Message> receives) override {
    sends_.assign(sends.begin(), sends.end());
    receives_.assign(receives.begin(), receives.end());
    meeting_->post(part_, sends);
  }
  void finish() override {
    for (const Message& message : receives_) {
      meeting_->take(part_, message);
    }
    for (const Message& message : sends_) {
      meeting_->wait_until_taken(part_, message.part);
    }
  }
  void join(PartSums& sums) override { meeting_->join(sums); }

 private:
  std::shared_ptr<Meeting> meeting_;
  int part_;
  std::vector<Message> sends_;
  std::vector<Message> receives_;
};

ThreadTeam::ThreadTeam(int parts) {
  if (parts < 1) {
    throw std::invalid_argument("a mesh in " + std::to_string(parts) + " parts");
  }
  meeting_ = std::make_shared<Meeting>(parts);
}

ThreadTeam::~ThreadTeam() = default;

int ThreadTeam::count() const {
  return meeting_->count();
}

std::shared_ptr<PartMessenger> ThreadTeam::messenger(int part) const {
  return std::make_shared<Messenger>(meeting_, part);
}

void ThreadTeam::run(const std::function<void(int)>& task) {
  // One part alone must not leave the others waiting for it.
  const CallLimit::Hidden no_limit;
  const auto tried = [&](int part) {
    try {
      task(part);
    } catch (...) {
      meeting_->fail(std::current_exception());
    }
  };
  {
    std::vector<std::jthread> threads;
    try {
      for (int part = 1; part < count(); ++part) {
        threads.emplace_back(tried, part);
      }
    } catch (...) {
      // Those that have begun wait for others that never will.
      meeting_->fail(std::current_exception());
    }
    tried(0);
  }
  meeting_->end();
}

}  // namespace trismooth
