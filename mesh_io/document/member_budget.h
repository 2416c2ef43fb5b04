// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>

namespace trismooth {

/// How many members the sets of a file may have in all: where sets are made of sets, or of groups, a small file can
/// state more than any memory holds. Many times as many as a mesh lists one by one in a file of its size.
class MemberBudget {
 public:
  /// Of the file at `path`, of so many bytes.
  MemberBudget(std::filesystem::path path, std::size_t bytes);

  /// To be called before so many members are added, or looked at. Throws ReadError where they are too many.
  void spend(std::size_t members);

 private:
  std::filesystem::path path_;
  std::size_t left_;
};

}  // namespace trismooth
