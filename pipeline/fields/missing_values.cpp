// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/fields/missing_values.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include <fmt/format.h>

#include "trismooth/base/text/list_text.h"

namespace trismooth {

namespace {

/// The size of a number that programs write for none, from the least to the greatest that it is rounded to.
struct SizeOfNone {
  double low = 0;
  double high = 0;
};

/// Numbers are rounded to float32 on their way, which may be read back as float64.
constexpr double as_single = 1e-7;

/// Streams and "%g" write numbers of more digits with six.
constexpr double with_six_digits = 1e-5;

constexpr double least_size = 999;

/// Ascending.
std::vector<SizeOfNone> sizes_of_none() {
  std::vector<SizeOfNone> sizes;
  const auto add = [&sizes](std::initializer_list<double> values, double rounding) {
    for (const double value : values) {
      sizes.push_back({value * (1 - rounding), value * (1 + rounding)});
    }
  };
  add({32767, 32768, 65535}, as_single);
  add({2147483647, 2147483648, 4294967295, 0x1p63, 0x1p64, 0x1p127, 9.969209968386869e36,
       static_cast<double>(std::numeric_limits<float>::max())},
      with_six_digits);
  // As people shorten the last ones.
  add({1.7e38, 3.4e38, 3.402e38, 3.403e38, 1.7e308, 1.79e308, 1.797e308}, as_single);
  const double largest = std::numeric_limits<double>::max();
  sizes.push_back({largest * (1 - with_six_digits), largest});
  constexpr int most_nines = 10;
  double nines = 99;
  for (int digits = 3; digits <= most_nines; ++digits) {
    nines = 10 * nines + 9;
    for (const double fraction : {0.0, 0.25, 0.9, 0.99, 0.999}) {
      // Not up to the power of ten: 100000 is a number like others.
      const double below_power = std::nextafter(nines + 1, 0);
      const double size = nines + fraction;
      sizes.push_back({std::max(size * (1 - as_single), least_size), std::min(size * (1 + as_single), below_power)});
    }
  }
  constexpr int least_power = 10;
  constexpr int most_power = 38;
  double power = 1e10;
  for (int exponent = least_power; exponent <= most_power; ++exponent, power *= 10) {
    add({power}, as_single);
  }
  std::ranges::sort(sizes, {}, &SizeOfNone::high);
  return sizes;
}

/// The size that a number may be for none, or null.
const SizeOfNone* size_of_none(double value, const std::vector<SizeOfNone>& sizes) {
  const double size = std::abs(value);
  if (size < least_size || (value > 0 && size < least_size + 1)) {
    return nullptr;
  }
  const auto found = std::ranges::lower_bound(sizes, size, {}, &SizeOfNone::high);
  return found != sizes.end() && found->low <= size ? &*found : nullptr;
}

/// Calls visit(component, value) for each value.
template <class Visit>
void for_each_value(const DataArray& array, const Visit& visit) {
  const auto values = [&](auto numbers) {
    for (std::size_t first = 0; first < numbers.size(); first += array.components) {
      for (std::size_t component = 0; component < array.components; ++component) {
        visit(component, static_cast<double>(numbers[first + component]));
      }
    }
  };
  array.type == ScalarType::float32 ? values(array.as<float>()) : values(array.as<double>());
}

/// The least and the greatest of the values that are numbers like others.
struct ValueRange {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;

  bool stands_apart(double code) const {
    constexpr double apart = 0.1;
    const double room = apart * std::abs(code);
    return low <= high && (low - code >= room || code - high >= room);
  }
};

}  // namespace

MissingValues::MissingValues(const DataArray& array)
    : codes_(array.components), is_single_(array.type == ScalarType::float32) {
  const std::vector<SizeOfNone> sizes = sizes_of_none();
  std::vector<ValueRange> ranges(array.components);
  std::array<bool, 3> has{};  // -inf, inf, nan
  for_each_value(array, [&](std::size_t component, double value) {
    if (!std::isfinite(value)) {
      has.at(std::isnan(value) ? 2 : value > 0 ? 1 : 0) = true;
    } else if (const SizeOfNone* const size = size_of_none(value, sizes); size == nullptr) {
      ranges[component].low = std::min(ranges[component].low, value);
      ranges[component].high = std::max(ranges[component].high, value);
    } else {
      const Code code = value < 0 ? Code{-size->high, -size->low, value} : Code{size->low, size->high, value};
      std::vector<Code>& codes = codes_[component];
      const auto known = std::ranges::find_if(
          codes, [&code](const Code& other) { return other.low == code.low && other.high == code.high; });
      if (known == codes.end()) {
        codes.push_back(code);
      } else {
        known->met = std::min(known->met, value);
      }
    }
  });
  for (std::size_t component = 0; component < codes_.size(); ++component) {
    std::erase_if(codes_[component], [&](const Code& code) { return !ranges[component].stands_apart(code.met); });
    std::ranges::sort(codes_[component], {}, &Code::high);
  }
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr std::array none{-infinity, infinity, std::numeric_limits<double>::quiet_NaN()};
  for (std::size_t i = 0; i < none.size(); ++i) {
    if (has.at(i)) {
      infinite_.push_back(none.at(i));
    }
  }
}

bool MissingValues::is_missing(std::size_t component, double value) const {
  if (!std::isfinite(value)) {
    return true;
  }
  return std::ranges::any_of(codes_[component],
                             [value](const Code& code) { return code.low <= value && value <= code.high; });
}

std::string MissingValues::names() const {
  std::vector<double> values;
  for (const std::vector<Code>& codes : codes_) {
    for (const Code& code : codes) {
      values.push_back(code.met);
    }
  }
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  values.insert(values.end(), infinite_.begin(), infinite_.end());
  return list_text(values, [this](double value) {
    return is_single_ ? fmt::format("{}", static_cast<float>(value)) : fmt::format("{}", value);
  });
}

}  // namespace trismooth
