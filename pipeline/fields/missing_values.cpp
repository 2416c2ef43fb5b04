#include "trismooth/pipeline/fields/missing_values.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <fmt/format.h>

namespace trismooth {

namespace {

/// The sizes of numbers that programs write for none.
std::vector<double> sizes_of_none() {
  std::vector<double> sizes{32767,
                            32768,
                            2147483647,
                            2147483648,
                            9.969209968386869e36,
                            static_cast<double>(std::numeric_limits<float>::max()),
                            std::numeric_limits<double>::max()};
  constexpr int most_nines = 10;
  double nines = 99;
  for (int digits = 3; digits <= most_nines; ++digits) {
    nines = 10 * nines + 9;
    for (const double fraction : {0.0, 0.9, 0.99, 0.999}) {
      sizes.push_back(nines + fraction);
    }
  }
  constexpr int least_power = 10;
  constexpr int most_power = 38;
  double power = 1e10;
  for (int exponent = least_power; exponent <= most_power; ++exponent, power *= 10) {
    sizes.push_back(power);
  }
  std::ranges::sort(sizes);
  return sizes;
}

/// Whether a number is one of them, as the array's type holds it. (A power of ten of many digits is not exact.)
bool may_be_none(double value, const std::vector<double>& sizes, ScalarType type) {
  const double size = std::abs(value);
  constexpr double least = 999;
  if (size < least || (value > 0 && size < least + 1)) {
    return false;
  }
  const double digits = type == ScalarType::float32 ? 1e-7 : 1e-15;
  const auto found = std::ranges::lower_bound(sizes, size * (1 - digits));
  return found != sizes.end() && *found <= size * (1 + digits);
}

template <class Visit>
void for_each_value(const DataArray& array, const Visit& visit) {
  const auto values = [&](auto numbers) {
    for (const auto value : numbers) {
      visit(static_cast<double>(value));
    }
  };
  array.type == ScalarType::float32 ? values(array.as<float>()) : values(array.as<double>());
}

}  // namespace

MissingValues::MissingValues(const DataArray& array) {
  const std::vector<double> sizes = sizes_of_none();
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for_each_value(array, [&](double value) {
    if (!std::isfinite(value)) {
      has_infinite_ = true;
    } else if (!may_be_none(value, sizes, array.type)) {
      low = std::min(low, value);
      high = std::max(high, value);
    } else if (std::ranges::find(codes_, value) == codes_.end()) {
      codes_.push_back(value);
    }
  });
  std::erase_if(codes_, [&](double code) {
    constexpr double apart = 0.1;
    const double room = apart * std::abs(code);
    return low > high || (low - code < room && code - high < room);
  });
  std::ranges::sort(codes_);
}

bool MissingValues::is_missing(double value) const {
  return !std::isfinite(value) || (!codes_.empty() && std::ranges::binary_search(codes_, value));
}

std::string MissingValues::names() const {
  std::string text;
  for (const double code : codes_) {
    text += fmt::format("{}{}", text.empty() ? "" : ", ", code);
  }
  return has_infinite_ ? text + (text.empty() ? "nan" : ", nan") : text;
}

}  // namespace trismooth
