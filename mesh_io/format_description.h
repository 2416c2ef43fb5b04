// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "trismooth/mesh_io/file_format.h"

namespace trismooth {

/// What files of a format hold, where that is not the same for all.
struct FormatContent {
  bool arrays = false;              ///< of points and cells by name; annotations can be added to these
  bool names = false;               ///< of values and sets; or the codec's what_is_lost tells of these itself
  bool units = false;               ///< of arrays, where it has any
  bool quads = true;                ///< else each is written as two triangles
  bool collapsed_quads = true;      ///< quadrilaterals that repeat a corner
  bool curved_cells = true;         ///< with nodes in the middle of their sides
  bool eight_node_quads = true;     ///< among these: without a node in the centre
  bool strips = false;              ///< of triangles
  bool empty_groups = true;         ///< names of groups and sets without members, where it holds names
  bool cells_of_any_order = false;  ///< VTK's Lagrange and Bezier cells
};

/// What a format is called and what its files hold: said once, with its codec, and asked wherever formats are treated
/// alike.
struct FormatDescription {
  FileFormat format;
  std::string_view name;                       ///< in options, reports and JSON: "off"
  std::string_view title;                      ///< for people: "OFF"
  std::array<std::string_view, 4> extensions;  ///< in lower case, the usual one first; empty behind the last
  FormatContent holds{};
  std::optional<std::int64_t> first_point_label{};  ///< of files that number points without saying so: 0 or 1
  std::string_view library{};                       ///< that a build needs to read and write it; empty: none
};

}  // namespace trismooth
