// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace trismooth::mpi {

/// Ids in ascending order, each there once: the place of an id is the number of what it names. Kept as stretches of ids
/// that follow each other, 12 bytes a stretch, since those of a rank's piece mostly do.
class AscendingIds {
 public:
  /// `id`: larger than all that are there.
  void push_back(std::int64_t id) {
    if (size_ == 0 || id != last_ + 1) {
      begins_.push_back(static_cast<std::int32_t>(size_));
      firsts_.push_back(id);
    }
    last_ = id;
    ++size_;
  }

  std::size_t size() const { return size_; }
  /// Complexity: logarithmic in the stretches.
  std::int64_t operator[](std::size_t place) const {
    const auto after = std::ranges::upper_bound(begins_, static_cast<std::int32_t>(place));
    const auto stretch = static_cast<std::size_t>(after - begins_.begin()) - 1;
    return firsts_[stretch] + static_cast<std::int64_t>(place) - begins_[stretch];
  }

  /// Walks over the ids.
  class Iterator {
   public:
    Iterator(const AscendingIds& ids, std::size_t place) : ids_(&ids), place_(place) { enter(); }

    std::int64_t operator*() const { return id_; }
    Iterator& operator++() {
      ++id_;
      if (++place_ == end_) {
        ++stretch_;
        enter();
      }
      return *this;
    }
    friend bool operator==(const Iterator& a, const Iterator& b) { return a.place_ == b.place_; }

   private:
    /// The stretch that is next.
    void enter() {
      if (place_ < ids_->size_) {
        id_ = ids_->firsts_[stretch_];
        end_ =
            stretch_ + 1 < ids_->begins_.size() ? static_cast<std::size_t>(ids_->begins_[stretch_ + 1]) : ids_->size_;
      }
    }

    const AscendingIds* ids_;
    std::size_t place_;
    std::size_t stretch_ = 0;
    std::size_t end_ = 0;  ///< of the stretch
    std::int64_t id_ = 0;
  };

  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, size_}; }

  /// All of them, one by one.
  std::vector<std::int64_t> listed() const {
    std::vector<std::int64_t> ids;
    ids.reserve(size_);
    for (const std::int64_t id : *this) {
      ids.push_back(id);
    }
    return ids;
  }

 private:
  std::vector<std::int32_t> begins_;  ///< the place where each stretch begins
  std::vector<std::int64_t> firsts_;  ///< the id there
  std::size_t size_ = 0;
  std::int64_t last_ = 0;
};

}  // namespace trismooth::mpi
