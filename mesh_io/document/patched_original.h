// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>
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

/// Throws WriteError, of a format that holds no arrays by name, where some are to be added, and where the document does
/// not have as many points as the file that was read had `things`.
void require_same_points(const std::filesystem::path& path, const MeshDocument& document, std::size_t count,
                         std::string_view things, std::span<const DataArray> added_point_arrays,
                         std::span<const DataArray> added_cell_arrays);

/// Writes `bytes` with what the document has at these sites, each of which stands wholly behind the one before.
void write_sites(const std::filesystem::path& path, std::string_view bytes, std::span<const NumberSites> sites,
                 const MeshDocument& document, Workers& workers);

/// The values that the columns of `sites` have in the document: coordinates, and point arrays, which are copied to
/// `copies` as numbers of double. Columns of arrays that the document has not, or not as numbers of floating point,
/// stay as they are. Both must outlive the result.
std::vector<ColumnValues> column_values(const NumberSites& sites, const MeshDocument& document,
                                        std::vector<std::vector<double>>& copies);

}  // namespace trismooth
