// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace trismooth {

/// Copies a text but for what is passed over.
class MshExcerpt {
 public:
  explicit MshExcerpt(std::string_view bytes) : bytes_(bytes) {}

  /// Up to `offset`.
  void copy_until(std::size_t offset) {
    text_.append(bytes_.substr(done_, offset - done_));
    done_ = offset;
  }
  /// Goes on at `offset`.
  void pass(std::size_t offset, std::string_view replacement = {}) {
    text_.append(replacement);
    done_ = offset;
  }
  std::string finish() {
    copy_until(bytes_.size());
    return std::move(text_);
  }

 private:
  std::string_view bytes_;
  std::size_t done_ = 0;
  std::string text_;
};

}  // namespace trismooth
