// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace trismooth {

struct MeshDocument;

/// The points behind the ids that a file gives them: any whole numbers, in any order. Finding one takes constant time
/// where the ids follow each other, as in nearly all files, or leave few out; else logarithmic time.
class PointIds {
 public:
  /// Point i has ids[i]. Complexity: linear where ids leave few out, else n log n.
  explicit PointIds(const std::vector<std::int64_t>& ids);

  /// The point, or nothing. Where points share an id, one of them.
  std::optional<std::int32_t> find(std::int64_t id) const {
    // Unsigned: ids before the first are far behind the last.
    const std::uint64_t place = static_cast<std::uint64_t>(id) - static_cast<std::uint64_t>(first_);
    if (is_consecutive_) {
      return place < size_ ? std::optional(static_cast<std::int32_t>(place)) : std::nullopt;
    }
    return find_other(id, place);
  }

  /// The first point whose id another one before it has too.
  std::optional<std::size_t> first_repeated() const { return first_repeated_; }

 private:
  std::optional<std::int32_t> find_other(std::int64_t id, std::uint64_t place) const;
  void make_table(const std::vector<std::int64_t>& ids, std::uint64_t span);
  void sort(const std::vector<std::int64_t>& ids);

  std::int64_t first_ = 0;  ///< the lowest
  std::size_t size_;
  bool is_consecutive_ = true;
  std::vector<std::int32_t> table_;                            ///< by id - first_, -1: none; where few are left out
  std::vector<std::pair<std::int64_t, std::int32_t>> sorted_;  ///< id and point, else
  std::optional<std::size_t> first_repeated_;
};

/// Gives the document's points these labels, one each: the numbers that its file gives them. Complexity: linear.
void set_point_labels(MeshDocument& document, std::vector<std::int64_t> labels);

}  // namespace trismooth
