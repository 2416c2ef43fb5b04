// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "trismooth/mesh_io/data_array.h"

namespace trismooth {

/// The values of a point array that stand for none: what is no finite number, and numbers that programs write in its
/// place (nines, as -9999, -99999.9 and -999.25, of three digits only those below 0; powers of ten from 1e10 on; the
/// largest numbers of types, 2^127 and NetCDF's 9.97e36, also as they are written with six digits or held as float32),
/// where they stand apart from all others of their component: beyond them by a tenth of their own size at least.
class MissingValues {
 public:
  /// Of an array of floating point. Complexity: linear in its values.
  explicit MissingValues(const DataArray& array);

  bool is_missing(std::size_t component, double value) const;

  /// Whether one of three corners whose weights are above 0 has no value.
  bool has_any(std::size_t component, const std::array<double, 3>& corners,
               const std::array<double, 3>& weights) const {
    bool any = false;
    for (std::size_t i = 0; i < 3; ++i) {
      any = any || (weights[i] > 0 && is_missing(component, corners[i]));
    }
    return any;
  }

  /// Those that the array has, each once, for people: "-99999, nan".
  std::string names() const;

 private:
  /// A number that stands for none, as far from it as programs round it.
  struct Code {
    double low = 0;
    double high = 0;
    double met = 0;  ///< the least value of the array between the two
  };

  std::vector<std::vector<Code>> codes_;  ///< of each component, ascending
  std::vector<double> infinite_;          ///< values that are no finite numbers, each once
  bool is_single_ = false;
};

}  // namespace trismooth
