// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace trismooth {

/// Parameters of places on a curve or surface (u; u and v) as an affine map of the places, which plane surfaces and
/// straight lines have.
class MshAffineMap {
 public:
  /// The map that gives all these points (x, y, z) their parameters, `count` of each point, to rounding; nothing where
  /// there is none, or where points on one line leave open how it goes on beside it.
  static std::optional<MshAffineMap> find(std::span<const double> points, std::span<const double> parameters,
                                          std::size_t count);

  /// By how much parameter number `parameter` changes along the way.
  double change(std::array<double, 3> way, std::size_t parameter) const;

 private:
  std::vector<std::array<double, 3>> gradients_;  ///< of each parameter
};

}  // namespace trismooth
