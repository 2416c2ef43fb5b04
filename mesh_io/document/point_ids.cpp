// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/point_ids.h"

#include <algorithm>
#include <utility>

#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

PointIds::PointIds(const std::vector<std::int64_t>& ids) : size_(ids.size()) {
  if (ids.empty()) {
    return;
  }
  const auto unsigned_id = [](std::int64_t id) { return static_cast<std::uint64_t>(id); };
  for (std::size_t i = 1; i < ids.size() && is_consecutive_; ++i) {
    is_consecutive_ = unsigned_id(ids[i]) == unsigned_id(ids[i - 1]) + 1 && ids[i] > ids[i - 1];
  }
  const auto [lowest, highest] = std::ranges::minmax_element(ids);
  first_ = *lowest;
  if (is_consecutive_) {
    return;
  }
  constexpr std::uint64_t most_places_each = 4;
  const std::uint64_t span = unsigned_id(*highest) - unsigned_id(*lowest);
  if (span / most_places_each < ids.size()) {
    make_table(ids, span);
  } else {
    sort(ids);
  }
}

void PointIds::make_table(const std::vector<std::int64_t>& ids, std::uint64_t span) {
  table_.assign(static_cast<std::size_t>(span) + 1, -1);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    std::int32_t& point =
        table_[static_cast<std::size_t>(static_cast<std::uint64_t>(ids[i]) - static_cast<std::uint64_t>(first_))];
    if (point >= 0 && !first_repeated_) {
      first_repeated_ = i;
    }
    point = static_cast<std::int32_t>(i);
  }
}

void PointIds::sort(const std::vector<std::int64_t>& ids) {
  sorted_.reserve(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    sorted_.emplace_back(ids[i], static_cast<std::int32_t>(i));
  }
  std::sort(sorted_.begin(), sorted_.end());
  for (std::size_t i = 1; i < sorted_.size(); ++i) {
    if (sorted_[i].first == sorted_[i - 1].first) {
      const auto point = static_cast<std::size_t>(sorted_[i].second);
      first_repeated_ = first_repeated_ ? std::min(*first_repeated_, point) : point;
    }
  }
}

std::optional<std::int32_t> PointIds::find_other(std::int64_t id, std::uint64_t place) const {
  if (!table_.empty()) {
    const std::int32_t point = place < table_.size() ? table_[static_cast<std::size_t>(place)] : -1;
    return point >= 0 ? std::optional(point) : std::nullopt;
  }
  const auto found = std::lower_bound(
      sorted_.begin(), sorted_.end(), id,
      [](const std::pair<std::int64_t, std::int32_t>& pair, std::int64_t wanted) { return pair.first < wanted; });
  return found != sorted_.end() && found->first == id ? std::optional(found->second) : std::nullopt;
}

void set_point_labels(MeshDocument& document, std::vector<std::int64_t> labels) {
  if (labels.empty()) {
    return;
  }
  document.first_point_label = labels.front();
  // Labels are any numbers of 64 bits: a difference of neighbours may overflow, a comparison does not.
  const bool count_on = std::ranges::adjacent_find(labels, [](std::int64_t a, std::int64_t b) {
                          return b <= a || b - 1 != a;
                        }) == labels.end();
  document.point_labels = count_on ? std::vector<std::int64_t>() : std::move(labels);
}

}  // namespace trismooth
