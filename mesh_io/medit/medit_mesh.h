// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/document/number_sites.h"
#include "trismooth/mesh_io/medit/medit_keywords.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// A mesh as the sections of a Medit file fill it, text or binary.
class MeditMesh {
 public:
  /// A section that lists vertices or cells, counted from 1.
  struct Set {
    const MeditKeyword* keyword;
    std::uint64_t place;  ///< of the first number, for messages
    std::vector<std::int64_t> numbers;
  };

  /// A number of a set that no vertex or cell has.
  struct WrongNumber {
    const Set* set;
    std::size_t index;        ///< in `numbers`
    std::size_t count;        ///< of the vertices or cells that there are
    std::string_view things;  ///< what these are
  };

  explicit MeditMesh(const FileWorkers& workers) : workers_(workers) {}

  MeshDocument document;
  NumberSites sites;                      ///< of the coordinates
  std::vector<std::int64_t> vertex_refs;  ///< one a vertex
  std::vector<std::int64_t> cell_refs;    ///< one a cell
  bool has_vertices = false;
  bool has_end = false;

  /// The coordinates that a vertex has in the file.
  void set_dimension(std::size_t dimension);
  std::size_t dimension() const { return dimension_; }

  /// False where there was a section of that keyword before and may be one only. (meshio writes as many sections of
  /// cells of a type as it has blocks of them.)
  bool begin_section(const MeditKeyword& keyword) {
    return begun_.insert(keyword.code).second || keyword.role == MeditRole::cells;
  }

  /// Makes room for the vertices.
  void resize_vertices(std::size_t count);
  /// Makes room for that many cells behind those that there are, with all but their vertices and references; returns
  /// the first of them.
  std::size_t append_cells(const MeditKeyword& keyword, std::size_t count);
  void add_set(Set set) { sets_.push_back(std::move(set)); }
  /// A section that is no part of a mesh.
  void add_other(std::string_view name);

  /// Completes the document when all sections are read, but for the original; nothing else is to be called then.
  /// The number that is wrong, if any is.
  std::optional<WrongNumber> finish();

 private:
  struct Section {
    std::uint8_t type;
    std::size_t first;
    std::size_t count;
  };

  /// The numbers of the cells of a type, in the order of the file.
  std::vector<std::size_t> cells_of_type(std::uint8_t type) const;
  std::optional<WrongNumber> make_set(const Set& set);

  FileWorkers workers_;
  std::size_t dimension_ = 0;
  std::set<std::int32_t> begun_;
  std::vector<Section> sections_;
  std::vector<Set> sets_;
  std::vector<std::string> others_;
};

}  // namespace trismooth
