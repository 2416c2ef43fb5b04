// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/msh/msh_tags.h"

#include <algorithm>

namespace trismooth {

void MshTags::add_run(std::int64_t first, std::size_t count) {
  if (count == 0) {
    return;
  }
  const bool goes_on = !runs_.empty() && static_cast<std::uint64_t>(first) ==
                                             static_cast<std::uint64_t>(runs_.back().first) + runs_.back().count;
  if (goes_on) {
    runs_.back().count += count;
  } else {
    runs_.push_back({first, count, count_});
  }
  count_ += count;
}

void MshTags::add(std::span<const std::int64_t> tags) {
  for (std::size_t begin = 0; begin < tags.size();) {
    std::size_t end = begin + 1;
    while (end < tags.size() && tags[end] - 1 == tags[end - 1]) {
      ++end;
    }
    add_run(tags[begin], end - begin);
    begin = end;
  }
}

std::optional<std::size_t> MshTags::finish() {
  if (!std::ranges::is_sorted(runs_, {}, &Run::first)) {
    std::ranges::sort(runs_, [](const Run& a, const Run& b) {
      return a.first < b.first || (a.first == b.first && a.place < b.place);
    });
  }
  for (std::size_t i = 1; i < runs_.size(); ++i) {
    const Run& before = runs_[i - 1];
    const std::uint64_t between = static_cast<std::uint64_t>(runs_[i].first) - static_cast<std::uint64_t>(before.first);
    if (between < before.count) {
      return std::max(before.place + between, runs_[i].place);
    }
  }
  make_table();
  return std::nullopt;
}

void MshTags::make_table() {
  constexpr std::uint64_t most_places_a_tag = 4;
  if (runs_.size() < 2) {
    return;
  }
  const std::uint64_t span = static_cast<std::uint64_t>(runs_.back().first) -
                             static_cast<std::uint64_t>(runs_.front().first) + runs_.back().count;
  if (span > most_places_a_tag * count_) {
    return;
  }
  table_.assign(span, -1);
  for (const Run& run : runs_) {
    const std::uint64_t begin = static_cast<std::uint64_t>(run.first - runs_.front().first);
    for (std::uint64_t i = 0; i < run.count; ++i) {
      table_[begin + i] = static_cast<std::int32_t>(run.place + i);
    }
  }
}

std::int64_t MshTags::largest() const {
  return runs_.empty() ? 0 : runs_.back().first + static_cast<std::int64_t>(runs_.back().count - 1);
}

std::vector<std::int64_t> MshTags::listed() const {
  std::vector<std::int64_t> tags(count_);
  for (const Run& run : runs_) {
    for (std::uint64_t i = 0; i < run.count; ++i) {
      tags[run.place + i] = run.first + static_cast<std::int64_t>(i);
    }
  }
  return tags;
}

std::int64_t MshTags::find_among_runs(std::int64_t tag) const {
  if (runs_.empty() || tag < runs_.front().first) {
    return -1;
  }
  if (!table_.empty()) {
    const auto at = static_cast<std::uint64_t>(tag - runs_.front().first);
    return at < table_.size() ? table_[at] : -1;
  }
  const auto behind = std::upper_bound(runs_.begin(), runs_.end(), tag,
                                       [](std::int64_t wanted, const Run& run) { return wanted < run.first; });
  const Run& run = *(behind - 1);
  const auto within = static_cast<std::uint64_t>(tag - run.first);
  return within < run.count ? static_cast<std::int64_t>(run.place + within) : -1;
}

}  // namespace trismooth
