// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace trismooth {

/// The tags that a file gives its nodes or elements, in the file's order, and which one has a tag. Tags that count on
/// take no memory, others 24 bytes each. No choice of tags makes a look-up slow.
class MshTags {
 public:
  /// The next `count` have tags that count on from `first`.
  void add_run(std::int64_t first, std::size_t count);
  /// The next have these.
  void add(std::span<const std::int64_t> tags);

  /// To be called behind the last add(). Where a tag was given twice: the place of the later one. Complexity: linear
  /// where tags ascend, else n log n.
  std::optional<std::size_t> finish();

  /// Gives memory back: find() takes logarithmic time from now on.
  void drop_table() { table_ = {}; }
  /// Behind finish(); 0 where there are none.
  std::int64_t largest() const;
  /// The tags, in the order in which they were added. Behind finish().
  std::vector<std::int64_t> listed() const;

  /// How many there are.
  std::size_t size() const { return count_; }
  /// The place of the one with that tag, or -1. Behind finish(). Constant time where tags are dense, else logarithmic.
  std::int64_t find(std::int64_t tag) const {
    if (const std::optional<Run> run = only_run()) {
      const std::uint64_t behind = static_cast<std::uint64_t>(tag) - static_cast<std::uint64_t>(run->first);
      return behind < run->count ? static_cast<std::int64_t>(behind) : -1;
    }
    return find_among_runs(tag);
  }

  /// Tags that count on.
  struct Run {
    std::int64_t first;
    std::uint64_t count;
    std::uint64_t place;  ///< of the first
  };

  /// All tags, where they count on: the place of each is how far it is behind the first.
  std::optional<Run> only_run() const { return runs_.size() == 1 ? std::optional(runs_[0]) : std::nullopt; }

 private:
  std::int64_t find_among_runs(std::int64_t tag) const;
  void make_table();

  std::vector<Run> runs_;  ///< by tag, behind finish()
  std::size_t count_ = 0;
  std::vector<std::int32_t> table_;  ///< places by tag from that of the first run on, where that takes little memory
};

}  // namespace trismooth
