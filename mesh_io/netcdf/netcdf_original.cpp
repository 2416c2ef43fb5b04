// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <utility>

#include "trismooth/mesh_io/document/patched_original.h"
#include "trismooth/mesh_io/hdf5/hdf5_original.h"
#include "trismooth/mesh_io/netcdf/netcdf_file.h"

namespace trismooth {

std::shared_ptr<const OriginalFile> make_netcdf_original(const NetcdfFile& file, FileBytes bytes,
                                                         std::vector<NetcdfSites> sites) {
  if (!file.is_classic()) {
    std::size_t points = 0;
    std::vector<Hdf5Column> columns;
    for (NetcdfSites& site : sites) {
      const NetcdfVariable& variable = *site.variable;
      const std::size_t count = file.part_of(variable, site.leading).size;
      points = columns.empty() ? count : points;
      std::size_t row = 0;
      for (std::size_t i = 0; i < site.leading.size(); ++i) {
        row = row * variable.shape[i] + site.leading[i];
      }
      columns.push_back({variable.dataset, row * count, count, std::move(site.column)});
    }
    return make_hdf5_original(std::move(bytes), points, std::move(columns));
  }
  std::vector<NumberSites> lists;
  for (NetcdfSites& site : sites) {
    lists.push_back(binary_sites(NumberEncoding::big_endian,
                                 site.variable->type == NetcdfType::float32 ? ScalarType::float32 : ScalarType::float64,
                                 NetcdfFile::offset_of(*site.variable, site.leading), 1,
                                 file.part_of(*site.variable, site.leading).size, {std::move(site.column)}));
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
