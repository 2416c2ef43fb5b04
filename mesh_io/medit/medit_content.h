// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "trismooth/mesh_io/document/cells/cell_groups.h"
#include "trismooth/mesh_io/medit/medit_keywords.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// What Medit's format holds of a document from elsewhere.
struct MeditContent {
  /// The cells of a keyword.
  struct Section {
    const MeditKeyword* keyword;
    std::vector<std::size_t> cells;
  };

  /// Numbers of vertices or of cells of a section, from 1.
  struct Set {
    const MeditKeyword* keyword;
    std::vector<std::int64_t> numbers;
  };
  /// Where the document is from: cells of a Medit file are in its own order of vertices, of all types.
  enum class Source : bool { elsewhere, medit };

  /// `document` must outlive it.
  explicit MeditContent(const MeshDocument& document, Source source = Source::elsewhere);

  const MeshDocument& document;
  std::size_t dimension = 2;      ///< 2 where all points have z 0
  std::vector<Section> sections;  ///< those that have cells
  CellGroups groups;              ///< the references of cells
  const DataArray* vertex_refs;   ///< the references of vertices; null: 0
  std::vector<Set> sets;          ///< those that have numbers: corners, required vertices, ridges, required cells

  std::int64_t vertex_ref(std::size_t vertex) const;
  std::int64_t cell_ref(std::size_t cell) const;
  /// Whether all references are numbers of 32 bits.
  bool has_small_references() const;

  /// What is not held, one sentence each.
  std::vector<std::string> losses() const;
};

}  // namespace trismooth
