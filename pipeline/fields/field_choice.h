// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/pipeline/moving_fields.h"

namespace trismooth {

/// What the user said of the fields, and the point arrays that serve other ends.
struct FieldWishes {
  std::optional<Fields> fields;           ///< absent: as `patterns` and the document say
  std::span<const std::string> patterns;  ///< of names (see name_pattern.h); none: all that can be interpolated
  std::string_view fixed_array;           ///< the array that holds vertices, or empty
  std::string_view size_array;            ///< the point array of the sizes to aim at, or empty
};

/// The point arrays that follow the mesh.
struct FieldChoice {
  std::vector<std::size_t> arrays;  ///< ascending numbers among the document's
  std::vector<std::size_t> kept;    ///< those that stay (see stays_unasked())
  std::vector<std::string> notes;   ///< what the user should know, one sentence each
};

/// Whether a point array that says nothing of places stays as read though it could be interpolated, and the user has
/// said nothing of fields: one of floating point, but for annotations, the fixed array and the size array.
bool stays_unasked(std::string_view name, ScalarType type, const FieldWishes& wishes);

/// Chooses the point arrays that are interpolated where vertices move:
/// - none where the user wants fields kept;
/// - arrays that say something of places (MeshDocument::arrays_of_places);
/// - and, where the user asks for fields to be interpolated or names some: those that a pattern matches, or all.
/// Only arrays that can be interpolated count; where the user named another one, without a wildcard, a note says that
/// it is kept.
///
/// Throws std::invalid_argument for a pattern that matches no point array, naming those there are, and for patterns of
/// fields that are kept. Complexity: linear in the names.
FieldChoice choose_fields(const MeshDocument& document, const FieldWishes& wishes);

}  // namespace trismooth
