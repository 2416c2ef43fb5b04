// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/document/number_sites.h"
#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/mesh_io/off/off_keyword.h"
#include "trismooth/mesh_io/text/plain_rows.h"

namespace trismooth {

/// Reads the vertices and the faces of an OFF text, in parts, by all workers, where all vertices, and all faces, have
/// equally many fields; faces may have any number of vertices. Nothing where the text has anything unusual in it, or is
/// broken: others read it then, and say what is wrong.
class OffPlainRows {
 public:
  /// `text` must outlive the object.
  OffPlainRows(std::string_view text, const FileWorkers& workers) : rows_(text, workers) {}

  /// `count` vertices, 1 or more, from `offset` on: coordinates to the points of the document, which have their size
  /// as the sites do; fields to point arrays.
  std::optional<PlainRows::End> read_vertices(std::size_t offset, std::size_t count, const OffKeyword& keyword,
                                              MeshDocument& document, NumberSites& sites);

  /// `count` faces, 1 or more, of `vertices` vertices, from `offset` on, where a line ends or begins: to the cells of
  /// the document, which has none so far, and a cell array of colours, if they have any.
  std::optional<PlainRows::End> read_faces(std::size_t offset, std::size_t count, std::size_t vertices,
                                           MeshDocument& document);

 private:
  PlainRows rows_;
};

}  // namespace trismooth
