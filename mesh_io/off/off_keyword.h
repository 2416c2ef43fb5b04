// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace trismooth {

/// What follows the coordinates of an OFF vertex; views of one row of numbers, empty where the keyword has no such
/// part.
struct OffExtras {
  std::span<const double> normal;
  std::span<const double> colour;
  std::span<const double> texture;
};

/// The keyword that opens an OFF file, [ST][C][N][4][n]OFF: the fields of its vertices. As default the plain OFF.
/// Colours need not be declared (many programs write them under a plain OFF), nor need they be there where they are
/// (OpenMesh writes COFF for colours of faces alone).
struct OffKeyword {
  std::string_view text;  ///< as the file has it
  bool texture_coordinates = false;
  bool colours = false;
  bool normals = false;
  bool homogeneous = false;
  bool any_dimension = false;
  /// Geomview's order is normal, colour, texture coordinates. MeshLab writes NC and puts colours before normals.
  bool colours_first = false;

  /// False where the coordinates are not x, y, z.
  bool is_supported() const { return !homogeneous && !any_dimension; }

  /// The fewest numbers after the coordinates: those without a colour. Colours are three or four, the end of the line
  /// decides.
  std::size_t least_extras() const;
  bool allows_extras(std::size_t count) const;
  /// "3, 6 or 7 numbers" for messages.
  std::string describe_extras() const;
  std::string text_or_default() const;

  /// The parts of a row for which allows_extras().
  OffExtras split(std::span<const double> row) const;
};

/// The keyword at the start of `token`, if it starts with one: alone, or with digits glued to it ("OFF490"). It may be
/// in lower or mixed case, where n stands for normals; before an OFF in capitals it is the dimension.
std::optional<OffKeyword> parse_off_keyword(std::string_view token);

}  // namespace trismooth
