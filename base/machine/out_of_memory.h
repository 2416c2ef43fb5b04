// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <new>
#include <stdexcept>
#include <string>

namespace trismooth {

/// Memory that one process of a job has lacked, thrown by all of them.
class OutOfMemory : public std::bad_alloc {
 public:
  explicit OutOfMemory(int rank) : message_("rank " + std::to_string(rank) + ": out of memory"), rank_(rank) {}

  const char* what() const noexcept override { return message_.what(); }
  int rank() const { return rank_; }

 private:
  std::runtime_error message_;  // which is copied without memory
  int rank_;
};

/// What stands in front of a message on it: "rank 3: ", or nothing where it is not known to be another process's.
inline std::string whose_memory(const std::bad_alloc& error) {
  const auto* const known = dynamic_cast<const OutOfMemory*>(&error);
  return known == nullptr ? "" : "rank " + std::to_string(known->rank()) + ": ";
}

}  // namespace trismooth
