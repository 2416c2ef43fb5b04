// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace trismooth {

/// Numbers that several have and nobody changes: copies share them.
class SharedNumbers {
 public:
  /// None.
  SharedNumbers() = default;
  SharedNumbers(std::vector<std::int64_t> numbers) {  // NOLINT(google-explicit-constructor)
    auto owner = std::make_shared<const std::vector<std::int64_t>>(std::move(numbers));
    numbers_ = *owner;
    owner_ = std::move(owner);
  }
  /// `owner` keeps them alive.
  SharedNumbers(std::span<const std::int64_t> numbers, std::shared_ptr<const void> owner)
      : owner_(std::move(owner)), numbers_(numbers) {}

  const std::int64_t* begin() const { return numbers_.data(); }
  const std::int64_t* end() const { return numbers_.data() + numbers_.size(); }
  std::size_t size() const { return numbers_.size(); }
  bool empty() const { return numbers_.empty(); }
  std::int64_t operator[](std::size_t i) const { return numbers_[i]; }
  /// Keeps them alive.
  std::shared_ptr<const void> owner() const { return owner_; }

 private:
  std::shared_ptr<const void> owner_;
  std::span<const std::int64_t> numbers_;
};

}  // namespace trismooth
