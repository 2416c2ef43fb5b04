#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/document/number_sites.h"
#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/mesh_io/su2/su2_elements.h"
#include "trismooth/mesh_io/text/plain_rows.h"

namespace trismooth {

/// Reads the points and the elements of an SU2 text, in parts, by all workers, where all points, and all elements, have
/// the same numbers behind them. Nothing where the text has anything unusual in it, or is broken: others read it then,
/// and say what is wrong.
class Su2PlainRows {
 public:
  /// `text` must outlive the object.
  Su2PlainRows(std::string_view text, const FileWorkers& workers) : rows_(text, workers) {}

  /// The points from number `first` on, which fill the document's points and the sites to their end; 1 or more. The
  /// columns of the sites are the dimension.
  std::optional<PlainRows::End> read_points(std::size_t offset, std::size_t first, MeshDocument& document,
                                            NumberSites& sites);

  /// What the indices of cells mean.
  struct Indices {
    std::int32_t first;  ///< the point of index 0
    std::int32_t count;
  };

  /// `count` elements, 1 or more, from `offset` on, where a line ends: behind the document's cells.
  std::optional<PlainRows::End> read_elements(std::size_t offset, std::size_t count, int dimension, Indices indices,
                                              CellList& cells);

 private:
  PlainRows rows_;
};

}  // namespace trismooth
