// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <utility>

#include "trismooth/mesh_io/document/patched_original.h"
#include "trismooth/mesh_io/hdf5/hdf5_original.h"
#include "trismooth/mesh_io/netcdf/netcdf_file.h"

namespace trismooth {

std::shared_ptr<const OriginalFile> make_netcdf_original(const NetcdfFile& file, FileBytes bytes,
                                                         std::vector<NetcdfSites> sites) {
  std::size_t points = 0;
  std::vector<Hdf5Column> columns;
  std::vector<NumberSites> lists;
  for (NetcdfSites& site : sites) {
    const NetcdfVariable& variable = *site.variable;
    const std::size_t count = file.part_of(variable, site.leading).size;
    const std::uint64_t offset = NetcdfFile::offset_of(variable, site.leading);
    points = lists.empty() ? count : points;
    lists.push_back(binary_sites(binary_encoding(variable.is_big_endian),
                                 variable.type == NetcdfType::float32 ? ScalarType::float32 : ScalarType::float64,
                                 offset, count, {std::move(site.column)}));
    columns.push_back({variable.dataset, static_cast<std::size_t>(offset - variable.begin) / size_of(variable.type),
                       lists.back(), variable.is_packed});
  }
  if (!file.is_classic()) {
    return make_hdf5_original(std::move(bytes), points, std::move(columns));
  }
  if (lists.empty()) {
    NumberSites& none = lists.emplace_back();
    none.encoding = NumberEncoding::big_endian;
    none.even = EvenSites{};
  }
  std::ranges::sort(lists, {}, [](const NumberSites& list) { return list.even->begin; });
  return make_patched_original(std::move(bytes), std::move(lists));
}

}  // namespace trismooth
