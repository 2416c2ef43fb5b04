// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/mesh_document.h"

#include "trismooth/base/machine/workers.h"

namespace trismooth {

bool OriginalFile::keeps_values_of(std::string_view /*point_array*/) const {
  return false;
}

void OriginalFile::write(const std::filesystem::path& path, const MeshDocument& document,
                         std::span<const DataArray> added_point_arrays,
                         std::span<const DataArray> added_cell_arrays) const {
  Workers alone(1);
  write(path, document, added_point_arrays, added_cell_arrays, alone);
}

}  // namespace trismooth
