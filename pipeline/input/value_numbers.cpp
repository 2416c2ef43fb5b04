// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/value_numbers.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <type_traits>
#include <utility>

#include "trismooth/base/text/digits.h"

namespace trismooth {

namespace {

template <class T>
bool is_nan(T value) {
  return std::isnan(static_cast<double>(value));
}

/// A total order of values: not-a-numbers last, all alike.
template <class T>
bool precedes(T a, T b) {
  return a < b || (!is_nan(a) && is_nan(b));
}

template <class T>
T stored_value(const DataArray& array, std::size_t row) {
  T value{};
  std::memcpy(&value, array.bytes.data() + row * sizeof(T), sizeof(T));
  return value;
}

/// Numbers `count` items by the values that `value_of` gives.
template <class ValueOf>
ValueNumbers number_items(std::size_t count, const ValueOf& value_of) {
  using T = std::invoke_result_t<ValueOf, std::size_t>;
  struct Start {
    T value;
    std::int32_t item;
  };
  // Files list the cells of a region one after the other: only the items where the value changes are sorted.
  std::vector<Start> starts;
  const auto same = [](T a, T b) { return !precedes(a, b) && !precedes(b, a); };
  for (std::size_t i = 0; i < count; ++i) {
    const T value = value_of(i);
    if (i == 0 || !same(value, value_of(i - 1))) {
      starts.push_back({value, static_cast<std::int32_t>(i)});
    }
  }
  std::vector<Start> values = starts;
  std::ranges::sort(values, [](const Start& a, const Start& b) {
    return precedes(a.value, b.value) || (!precedes(b.value, a.value) && a.item < b.item);
  });
  // Not std::ranges::unique, of which Clang 14 cannot read libstdc++'s.
  values.erase(
      std::unique(values.begin(), values.end(), [&](const Start& a, const Start& b) { return same(a.value, b.value); }),
      values.end());

  ValueNumbers numbers;
  numbers.of_item.resize(count);
  for (std::size_t s = 0; s < starts.size(); ++s) {
    const auto found = std::ranges::lower_bound(values, starts[s].value, precedes<T>, &Start::value);
    const std::size_t end = s + 1 < starts.size() ? static_cast<std::size_t>(starts[s + 1].item) : count;
    std::fill(numbers.of_item.begin() + starts[s].item, numbers.of_item.begin() + static_cast<std::ptrdiff_t>(end),
              static_cast<std::int32_t>(found - values.begin()));
  }
  numbers.example.resize(values.size());
  std::ranges::transform(values, numbers.example.begin(), &Start::item);
  return numbers;
}

}  // namespace

ValueNumbers number_values(const DataArray& array, std::span<const std::int32_t> rows) {
  return visit_scalar_type(array.type, [&](auto zero) {
    return number_items(rows.size(), [&](std::size_t item) {
      return stored_value<decltype(zero)>(array, static_cast<std::size_t>(rows[item]));
    });
  });
}

ValueNumbers number_pairs(const ValueNumbers& first, const ValueNumbers& second) {
  const std::int64_t width = second.count();
  return number_items(first.of_item.size(),
                      [&](std::size_t item) { return first.of_item[item] * width + second.of_item[item]; });
}

ValueNumbers join_copies(const ValueNumbers& numbers, std::span<const std::int32_t> copy_of) {
  const std::size_t count = numbers.of_item.size() - copy_of.size();
  std::vector<std::pair<std::int32_t, std::int32_t>> values;  // of items that have copies
  for (std::size_t i = 0; i < copy_of.size(); ++i) {
    values.emplace_back(copy_of[i], numbers.of_item[static_cast<std::size_t>(copy_of[i])]);
    values.emplace_back(copy_of[i], numbers.of_item[count + i]);
  }
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  std::vector<std::int32_t> joined(numbers.of_item.begin(),
                                   numbers.of_item.begin() + static_cast<std::ptrdiff_t>(count));
  std::map<std::vector<std::int32_t>, std::int32_t> sets;
  for (std::size_t begin = 0, end = 0; begin < values.size(); begin = end) {
    const std::int32_t item = values[begin].first;
    std::vector<std::int32_t> set;
    for (; end < values.size() && values[end].first == item; ++end) {
      set.push_back(values[end].second);
    }
    if (set.size() > 1) {
      const std::int32_t next = numbers.count() + static_cast<std::int32_t>(sets.size());
      joined[static_cast<std::size_t>(item)] = sets.try_emplace(std::move(set), next).first->second;
    }
  }
  return number_items(count, [&](std::size_t item) { return joined[item]; });
}

bool are_whole(const DataArray& array, std::span<const std::int32_t> rows, const ValueNumbers& numbers) {
  return std::ranges::all_of(numbers.example, [&](std::int32_t item) {
    const double value = array.value(static_cast<std::size_t>(rows[static_cast<std::size_t>(item)]));
    return std::isfinite(value) && value == std::floor(value);
  });
}

std::string value_text(const DataArray& array, std::size_t row) {
  return visit_scalar_type(array.type, [&](auto zero) {
    const auto value = stored_value<decltype(zero)>(array, row);
    if constexpr (std::is_integral_v<decltype(zero)>) {
      return std::to_string(value);
    } else {
      return is_nan(value) ? std::string("nan") : plain_text(value);
    }
  });
}

}  // namespace trismooth
