#pragma once

#include <memory>
#include <vector>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/document/number_sites.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// The original of a format that is written back byte by byte: `bytes`, the whole file, with the numbers at `sites`
/// replaced where they differ (see write_patched): coordinates, and values of the point arrays that columns name. Each
/// list of sites stands wholly behind the one before; the first has the coordinates. No arrays can be added: its
/// write() throws WriteError where some are to be, and where the document does not have one point for every vertex of
/// the coordinates' sites.
std::shared_ptr<const OriginalFile> make_patched_original(FileBytes bytes, NumberSites sites);
std::shared_ptr<const OriginalFile> make_patched_original(FileBytes bytes, std::vector<NumberSites> sites);

/// The values that the columns of `sites` have in the document: coordinates, and point arrays, which are copied to
/// `copies` as numbers of double. Columns of arrays that the document has not, or not as numbers of floating point,
/// stay as they are. Both must outlive the result.
std::vector<ColumnValues> column_values(const NumberSites& sites, const MeshDocument& document,
                                        std::vector<std::vector<double>>& copies);

}  // namespace trismooth
