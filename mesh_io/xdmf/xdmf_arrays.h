// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "trismooth/mesh_io/data_array.h"
#include "trismooth/mesh_io/document/free_names.h"
#include "trismooth/mesh_io/document/member_budget.h"

namespace trismooth {

/// Arrays of all points, or of all cells, whose rows come from several grids. Rows that no grid has are 0 in arrays of
/// whole numbers, else no number (NaN).
class XdmfArrays {
 public:
  /// `array`: its rows are those that `rows` numbers, of the part `part` of the mesh; empty where they are all rows
  /// from the first on. The array of its name, type and components gets them, or a new one where that has rows of the
  /// part already.
  void add(DataArray array, std::size_t part, std::vector<std::int32_t> rows);

  /// The arrays, for `rows` rows. Throws ReadError where a small file would make much of them.
  std::vector<DataArray> take(std::size_t rows, MemberBudget& budget);

 private:
  struct Piece {
    DataArray array;
    std::vector<std::int32_t> rows;
  };

  struct Joined {
    std::vector<Piece> pieces;
    std::set<std::size_t> parts;
  };

  std::vector<Joined> arrays_;
  std::map<std::string, std::size_t> latest_;  ///< by name, type and components
};

}  // namespace trismooth
