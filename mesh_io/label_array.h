// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace trismooth {

/// A named array of texts of a mesh file, one for every row, as few different ones repeat: names of materials, say.
struct LabelArray {
  std::string name;
  std::vector<std::int32_t> of_row;  ///< per row: its place in `labels`
  std::vector<std::string> labels;   ///< ascending, each once
};

/// The array whose rows are `texts`. Complexity: n log n.
LabelArray make_label_array(std::string name, std::span<const std::string_view> texts);

}  // namespace trismooth
