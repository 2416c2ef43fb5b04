// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/mesh_io/netcdf/netcdf_file.h"

namespace trismooth {

/// The property of blocks that says which are one region, by the id of the first of these, and its name in files.
inline constexpr const char* exodus_region_property = "eb_prop2";
inline constexpr std::string_view exodus_region_name = "region";

/// A block of elements, whose cells follow each other.
struct ExodusBlock {
  std::size_t number = 0;  ///< in names of variables, from 1
  std::string type;        ///< of its elements, as the file has it
  std::size_t first_element = 0;
  std::size_t elements = 0;
  std::size_t first_cell = 0;
  bool has_cells = true;  ///< a cell an element; else its elements are of faces, which are none of the document
};

/// The variables that are called that and a number, by their numbers.
std::vector<std::pair<std::size_t, const NetcdfVariable*>> numbered_variables(const NetcdfFile& file,
                                                                              std::string_view name);

/// The ids, and the names, of blocks or sets by their numbers: those that the file does not have are the numbers, and
/// empty. `ids` and `names` are the variables ("eb_prop1", "eb_names").
class ExodusNames {
 public:
  ExodusNames(const NetcdfFile& file, std::string_view ids, std::string_view names);

  /// The numbers, ascending, of those that have no variable of that name and number: no members.
  std::vector<std::size_t> without(const NetcdfFile& file, const std::string& variable) const;

  std::int64_t id(std::size_t number) const;
  std::string name(std::size_t number) const;
  /// The name, or "side set 3".
  std::string name_or(std::size_t number, std::string_view what) const;

 private:
  std::vector<std::int64_t> ids_;
  std::vector<std::string> names_;
};

/// Adds the cells of all blocks to the document, whose points are there, and a note on elements that are not known.
/// Throws ReadError.
std::vector<ExodusBlock> add_exodus_blocks(const NetcdfFile& file, std::size_t axes, const FileWorkers& workers,
                                           MeshDocument& document);

/// Adds regions, lines, sets of points and of cells: what blocks and sets say. `axes` are those of the coordinates.
/// Throws ReadError.
void add_exodus_sets(const NetcdfFile& file, const std::vector<ExodusBlock>& blocks, std::size_t axes,
                     MeshDocument& document);

}  // namespace trismooth
