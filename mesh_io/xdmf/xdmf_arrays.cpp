// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/xdmf/xdmf_arrays.h"

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>

namespace trismooth {

void XdmfArrays::add(DataArray array, std::size_t part, std::vector<std::int32_t> rows) {
  const std::string key =
      std::to_string(static_cast<int>(array.type)) + " " + std::to_string(array.components) + " " + array.name;
  const auto [latest, is_new] = latest_.emplace(key, arrays_.size());
  if (is_new || arrays_[latest->second].parts.contains(part)) {
    latest->second = arrays_.size();
    arrays_.emplace_back();
  }
  Joined& joined = arrays_[latest->second];
  joined.parts.insert(part);
  joined.pieces.push_back({std::move(array), std::move(rows)});
}

std::vector<DataArray> XdmfArrays::take(std::size_t rows, MemberBudget& budget) {
  FreeNames names;
  std::vector<DataArray> arrays;
  for (Joined& joined : arrays_) {
    std::vector<Piece>& pieces = joined.pieces;
    Piece& first = pieces.front();
    const std::string name = names.claim(first.array.name);
    if (pieces.size() == 1 && first.rows.empty() && first.array.rows() == rows) {
      first.array.name = name;
      arrays.push_back(std::move(first.array));
      continue;
    }
    const std::size_t components = first.array.components;
    budget.spend(rows * components);
    arrays.push_back(visit_scalar_type(first.array.type, [&](auto number) {
      using T = decltype(number);
      std::vector<T> values(rows * components, std::is_floating_point_v<T> ? std::numeric_limits<T>::quiet_NaN() : T{});
      for (const Piece& piece : pieces) {
        const auto given = piece.array.as<T>();
        for (std::size_t i = 0; i < piece.array.rows(); ++i) {
          const std::size_t row = piece.rows.empty() ? i : static_cast<std::size_t>(piece.rows[i]);
          std::copy_n(given.begin() + static_cast<std::ptrdiff_t>(i * components), components,
                      values.begin() + static_cast<std::ptrdiff_t>(row * components));
        }
      }
      return make_data_array(name, components, std::move(values));
    }));
  }
  return arrays;
}

}  // namespace trismooth
