// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace trismooth {

/// Several measurements of the same.
struct Spread {
  double median = 0;
  double least = 0;
  double most = 0;

  Spread() = default;
  /// Of one value or more; of an even number the median is the mean of the two in the middle.
  explicit Spread(std::vector<double> values);
  Spread(double median_value, double least_value, double most_value)
      : median(median_value), least(least_value), most(most_value) {}

  /// "3.42 (3.41-3.50)", in the digits that a time in milliseconds deserves.
  std::string text() const;
  /// "3.41-3.50", the least and the most in the same digits.
  std::string range_text() const;
};

/// How many times `one` is `other`. The bounds are the widest that the spreads of both allow.
Spread ratio(const Spread& one, const Spread& other);

/// A positive number in about three digits: "0.041", "0.412", "4.12", "41.2", "412", "41203".
std::string three_digits(double value);

}  // namespace trismooth
