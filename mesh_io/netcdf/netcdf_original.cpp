// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <bit>
#include <utility>

#include "trismooth/mesh_io/bytes/buffered_writer.h"
#include "trismooth/mesh_io/document/patched_original.h"
#include "trismooth/mesh_io/netcdf/netcdf_file.h"

namespace trismooth {

namespace {

/// Sites of a netCDF-4 file.
struct LibrarySites {
  std::size_t variable = 0;
  NetcdfFile::Part part;
  bool is_float32 = false;
};

class LibraryOriginal : public OriginalFile {
 public:
  LibraryOriginal(FileBytes bytes, std::vector<LibrarySites> sites, std::vector<SiteColumn> columns)
      : bytes_(std::move(bytes)), sites_(std::move(sites)) {
    columns_.columns = std::move(columns);
  }

  void write(const std::filesystem::path& path, const MeshDocument& document,
             std::span<const DataArray> added_point_arrays, std::span<const DataArray> added_cell_arrays,
             Workers& /*workers*/) const override {
    require_same_points(path, document, sites_.empty() ? 0 : sites_.front().part.size, "nodes", added_point_arrays,
                        added_cell_arrays);
    BufferedWriter writer(path);
    writer.write(bytes_);
    writer.close();
    const std::vector<NetcdfOverwrite> changed = find_changed(path, document);
    if (!changed.empty()) {
      overwrite_netcdf(path, changed);
    }
  }

  bool keeps_values_of(std::string_view point_array) const override {
    return std::ranges::find(columns_.columns, point_array, &SiteColumn::array) != columns_.columns.end();
  }

 private:
  std::vector<NetcdfOverwrite> find_changed(const std::filesystem::path& path, const MeshDocument& document) const {
    std::vector<std::vector<double>> copies;
    const std::vector<ColumnValues> columns = column_values(columns_, document, copies);
    const NetcdfLibraryFile read(path, bytes_);
    std::vector<NetcdfOverwrite> changed;
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      const LibrarySites& sites = sites_[i];
      if (columns[i].first == nullptr) {
        continue;
      }
      std::vector<double> before(sites.part.size);
      read.read(sites.variable, sites.part.begin, sites.part.counts, std::span(before));
      std::vector<double> now = before;
      bool differs = false;
      for (std::size_t v = 0; v < now.size(); ++v) {
        const double value = columns[i].first[v * columns[i].stride];
        const double stored = sites.is_float32 ? double{static_cast<float>(value)} : value;
        // A zero's sign counts, and what is no number stays.
        if (std::bit_cast<std::uint64_t>(stored) != std::bit_cast<std::uint64_t>(before[v]) &&
            !(stored != stored && before[v] != before[v])) {
          now[v] = stored;
          differs = true;
        }
      }
      if (differs) {
        changed.push_back({sites.variable, sites.part.begin, sites.part.counts, std::move(now)});
      }
    }
    return changed;
  }

  FileBytes bytes_;
  std::vector<LibrarySites> sites_;
  NumberSites columns_;  ///< the columns alone
};

}  // namespace

std::shared_ptr<const OriginalFile> make_netcdf_original(const NetcdfFile& file, FileBytes bytes,
                                                         std::vector<NetcdfSites> sites) {
  if (!file.is_classic()) {
    std::vector<LibrarySites> of_library;
    std::vector<SiteColumn> columns;
    for (NetcdfSites& site : sites) {
      of_library.push_back({static_cast<std::size_t>(site.variable - file.content().variables.data()),
                            file.part_of(*site.variable, site.leading), site.variable->type == NetcdfType::float32});
      columns.push_back(std::move(site.column));
    }
    return std::make_shared<LibraryOriginal>(std::move(bytes), std::move(of_library), std::move(columns));
  }
  std::vector<NumberSites> lists;
  for (NetcdfSites& site : sites) {
    NumberSites& list = lists.emplace_back();
    list.encoding = NumberEncoding::big_endian;
    list.type = site.variable->type == NetcdfType::float32 ? ScalarType::float32 : ScalarType::float64;
    list.columns = {std::move(site.column)};
    list.even = EvenSites{NetcdfFile::offset_of(*site.variable, site.leading), size_of(list.type),
                          file.part_of(*site.variable, site.leading).size};
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
