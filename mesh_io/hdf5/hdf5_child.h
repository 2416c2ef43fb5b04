// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include <sys/types.h>

#include "trismooth/mesh_io/hdf5/hdf5_message.h"

namespace trismooth {

/// The child's end of the connection to its parent.
class Hdf5Channel {
 public:
  explicit Hdf5Channel(int socket) : socket_(socket) {}

  /// The next request, or nothing where the parent asks for no more.
  std::optional<std::string> next();
  void answer(std::string_view payload) const { send(false, payload); }
  /// Answers with a sentence in place of what was asked for.
  void refuse(std::string_view sentence) const { send(true, sentence); }

 private:
  void send(bool is_refusal, std::string_view payload) const;

  int socket_;
};

/// A child that has said no: its sentence.
struct Hdf5Refusal : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A process in which HDF5's library may break off, read beyond its memory or never come to an end: it sees the memory
/// of this one as it was when it began, and opens no file. What comes from it is held for hostile.
class Hdf5Child {
 public:
  /// What a child may use before it counts as one that never comes to an end.
  struct Limits {
    std::uint64_t seconds;  ///< of a processor for all answers; for one answer ten times as many by the clock
    std::uint64_t memory;   ///< bytes, beyond those that this process has
  };
  /// Those for a file of so many bytes.
  static Limits limits_of(std::uint64_t file_bytes);

  /// In the child, whose only thread is a copy of this one, calls `serve`, and ends it. Whatever `serve` uses outlives
  /// the call. Throws Hdf5ChildLost where no process can be made.
  Hdf5Child(const Limits& limits, const std::function<void(Hdf5Channel&)>& serve);
  Hdf5Child(const Hdf5Child&) = delete;
  Hdf5Child& operator=(const Hdf5Child&) = delete;
  /// The child is gone then.
  ~Hdf5Child();

  /// Sends a request. As all that follow, throws Hdf5ChildLost where the child is gone, or stays silent for too long.
  void ask(std::string_view request);
  /// The size of the answer, which is to be received whole. Throws Hdf5Refusal.
  std::uint64_t answer_size();
  void receive(void* to, std::size_t size);
  /// An answer of at most so many bytes; memory grows with what comes.
  std::string answer(std::uint64_t most);
  /// Ends a child that is gone, or says what cannot be, and throws Hdf5ChildLost.
  [[noreturn]] void lose();

 private:
  void wait_for(short events);
  std::optional<int> end();

  int socket_ = -1;
  pid_t process_ = -1;
  std::uint64_t patience_;  ///< seconds of silence
};

}  // namespace trismooth
