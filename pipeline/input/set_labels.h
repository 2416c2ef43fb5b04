// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// A value that a file gives points or cells in one of its arrays: a reference of Medit, a marker, a physical group.
struct SetLabel {
  std::string array;  ///< as the file calls it
  std::string value;  ///< one spelling of each number; or a name that the file has for it

  std::string name() const { return array + "=" + value; }
};

/// Adds the name of an array of points or cells that may give labels, where it is not there: it has one value a row and
/// is no annotation.
void add_label_array(std::vector<std::string>& names, const std::string& array, std::uint64_t components);

/// The names of the document's arrays that give labels, each once: those of points first.
std::vector<std::string> label_arrays(const MeshDocument& document);

/// The label that "ARRAY=VALUE" names, with the array of `arrays` that has that name, or else the first whose
/// plain_name() is the same; nothing where there is none.
std::optional<SetLabel> find_label(std::span<const std::string> arrays, std::string_view name);

/// One flag a point: 1 where the point has the label, or a cell that has it uses the point, be it a triangle, a line or
/// any other. A name counts for the cells of its dimension. Where groups of cells overlap, the cells of a group are all
/// of them, not those alone that the array has room for. `copies`: not 0 for cells that do not count; empty: all do.
/// Complexity: linear, and n log n in the changes of values from row to row.
std::vector<std::uint8_t> points_of_label(const MeshDocument& document, const SetLabel& label,
                                          std::span<const std::uint8_t> copies = {});

/// The lowest of the values that the document has in the array of points, of cells or both: more than
/// complain_of_value() lists, where there are more. Complexity: n log n.
std::vector<std::string> label_values(const MeshDocument& document, std::string_view array);

/// The error of a label that nothing has, which lists `values`, of one document or of several.
std::invalid_argument complain_of_value(const SetLabel& label, std::vector<std::string> values);

/// The names that the document has for values of arrays of cells, each once, in order: those of groups.
std::vector<std::string> names_of_values(const MeshDocument& document);

/// Whether a name stands for the value of that name without its array: where just one array has it. Numbers do not.
bool is_bare_label(std::string_view name, std::span<const SetLabel> meant);

/// The error of a name that neither a set has nor an array that gives labels: `names` are those of sets and of values.
/// It lists these, and says which labels are `meant` where these are known.
std::invalid_argument complain_of_set(const std::string& name, std::span<const std::string> names,
                                      std::span<const std::string> arrays, std::span<const SetLabel> meant);

}  // namespace trismooth
