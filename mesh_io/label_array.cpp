// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/label_array.h"

#include <algorithm>
#include <utility>

namespace trismooth {

LabelArray make_label_array(std::string name, std::span<const std::string_view> texts) {
  LabelArray array{std::move(name), std::vector<std::int32_t>(texts.size()), {}};
  std::vector<std::string_view> different(texts.begin(), texts.end());
  std::ranges::sort(different);
  different.erase(std::unique(different.begin(), different.end()), different.end());
  std::ranges::transform(texts, array.of_row.begin(), [&](std::string_view text) {
    return static_cast<std::int32_t>(std::ranges::lower_bound(different, text) - different.begin());
  });
  array.labels.assign(different.begin(), different.end());
  return array;
}

}  // namespace trismooth
