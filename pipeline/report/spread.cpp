// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/report/spread.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include <fmt/format.h>

namespace trismooth {

namespace {

/// Decimals behind the point that leave three digits.
int decimals_of(double value) {
  const double size = std::abs(value);
  return size < 1 ? 3 : size < 10 ? 2 : size < 100 ? 1 : 0;
}

}  // namespace

Spread::Spread(std::vector<double> values) {
  if (values.empty()) {
    throw std::invalid_argument("a spread needs a value");
  }
  std::ranges::sort(values);
  const std::size_t middle = values.size() / 2;
  median = values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
  least = values.front();
  most = values.back();
}

std::string Spread::text() const {
  return fmt::format("{} ({})", three_digits(median), range_text());
}

std::string Spread::range_text() const {
  const int decimals = decimals_of(median);
  return fmt::format("{:.{}f}-{:.{}f}", least, decimals, most, decimals);
}

Spread ratio(const Spread& one, const Spread& other) {
  return {one.median / other.median, one.least / other.most, one.most / other.least};
}

std::string three_digits(double value) {
  return fmt::format("{:.{}f}", value, decimals_of(value));
}

}  // namespace trismooth
