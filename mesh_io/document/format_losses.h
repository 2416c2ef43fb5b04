// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/document/cells/cell_groups.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// " is not written", or " are not written" of several: how sentences of what is lost end.
inline const char* not_written(std::size_t count) {
  return count == 1 ? " is not written" : " are not written";
}

/// The name of an array or a set, or "(no name)".
template <class Named>
std::string_view shown_name(const Named& named) {
  return named.name.empty() ? std::string_view("(no name)") : named.name;
}

/// The array of points and those of cells that a format does hold, by their names: as depths, as groups.
struct HeldArrays {
  std::optional<std::string_view> point{};
  GroupArrays cell{};
};

/// One sentence for every kind of array that the document has, naming the arrays: "OFF holds no cell arrays: region
/// is not written". For formats that hold no arrays but `held`; `format` is the format's name in the sentences.
std::vector<std::string> describe_lost_arrays(std::string_view format, const MeshDocument& document,
                                              const HeldArrays& held = {});

/// The last of them, of formats that hold point and cell arrays.
std::vector<std::string> describe_lost_field_arrays(std::string_view format, const MeshDocument& document);

/// The sentence for the names that values of the document's cell arrays have, at most one: "OFF holds no names of
/// values: those of region are not written". `held`: arrays whose names become those of groups.
std::vector<std::string> describe_lost_names(std::string_view format, const MeshDocument& document,
                                             const GroupArrays& held = {});

/// The sentence for the units that the document's arrays have, at most one: "XDMF holds no units: those of speed are
/// not written".
std::vector<std::string> describe_lost_units(std::string_view format, const MeshDocument& document);

/// The sentence for those of `arrays`, which a format writes as numbers of floating point, that these do not hold, at
/// most one: "MED holds whole numbers below 2^63: id is rounded".
std::vector<std::string> describe_rounded(std::string_view format, std::string_view holds,
                                          std::span<const DataArray* const> arrays);

/// The same of the arrays of whole numbers whose widened_type() is of floating point, but those that groups are from.
std::vector<std::string> describe_widened(std::string_view format, const MeshDocument& document,
                                          const GroupArrays& but);

/// One sentence for the document's sets of points and one for those of cells: "OFF holds no sets of points: inlet,
/// outlet are not written".
std::vector<std::string> describe_lost_sets(std::string_view format, const MeshDocument& document);

/// The sentence for a format that lists cells by type, in the order of `written_types`, where those of the document
/// come in another order, at most one: "Medit lists cells by their type: they are written in another order".
std::vector<std::string> describe_new_order(std::string_view format, std::span<const std::uint8_t> written_types,
                                            const CellList& cells);

/// The sentence for the cells whose type is not in `written_types`, at most one: "OFF holds faces only: 12 cells of
/// type line are not written". `holds` says what the format does hold ("faces").
std::vector<std::string> describe_lost_cells(std::string_view format, std::string_view holds,
                                             std::span<const std::uint8_t> written_types, const CellList& cells);

}  // namespace trismooth
