#pragma once

#include <array>
#include <string>
#include <vector>

#include "trismooth/mesh_io/data_array.h"

namespace trismooth {

/// The values of a point array that stand for none: what is no finite number, and numbers that programs write in its
/// place (nines, as -9999 and -99999.9, of three digits only -999; powers of ten from 1e10 on; the largest numbers of
/// types; NetCDF's 9.97e36), where they stand apart from all others: beyond them by a tenth of their own size at least.
class MissingValues {
 public:
  /// Of an array of floating point. Complexity: linear in its values.
  explicit MissingValues(const DataArray& array);

  bool is_missing(double value) const;

  /// Whether one of three corners whose weights are above 0 has no value.
  bool has_any(const std::array<double, 3>& corners, const std::array<double, 3>& weights) const {
    bool any = false;
    for (std::size_t i = 0; i < 3; ++i) {
      any = any || (weights[i] > 0 && is_missing(corners[i]));
    }
    return any;
  }

  /// Those that the array has, for people: "-99999, nan".
  std::string names() const;

 private:
  std::vector<double> codes_;  ///< the finite ones, ascending
  bool has_infinite_ = false;  ///< not a number, or beyond all
};

}  // namespace trismooth
