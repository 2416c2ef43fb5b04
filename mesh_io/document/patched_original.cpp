// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/patched_original.h"

#include <algorithm>
#include <utility>

#include "trismooth/mesh_io/errors.h"

namespace trismooth {

namespace {

class PatchedOriginal : public OriginalFile {
 public:
  PatchedOriginal(FileBytes bytes, std::vector<NumberSites> sites)
      : bytes_(std::move(bytes)), sites_(std::move(sites)), vertex_count_(count_vertices(sites_.front())) {}

  void write(const std::filesystem::path& path, const MeshDocument& document,
             std::span<const DataArray> added_point_arrays, std::span<const DataArray> added_cell_arrays,
             Workers& workers) const override {
    require_same_points(path, document, vertex_count_, "vertices", added_point_arrays, added_cell_arrays);
    write_sites(path, bytes_, sites_, document, workers);
  }

  bool keeps_values_of(std::string_view point_array) const override {
    return std::ranges::any_of(sites_,
                               [point_array](const NumberSites& sites) { return sites.has_values_of(point_array); });
  }

 private:
  static std::size_t count_vertices(const NumberSites& sites) {
    return sites.vertices.empty() ? sites.size()
                                  : static_cast<std::size_t>(*std::ranges::max_element(sites.vertices)) + 1;
  }

  FileBytes bytes_;
  std::vector<NumberSites> sites_;
  std::size_t vertex_count_;
};

}  // namespace

void require_same_points(const std::filesystem::path& path, const MeshDocument& document, std::size_t count,
                         std::string_view things, std::span<const DataArray> added_point_arrays,
                         std::span<const DataArray> added_cell_arrays) {
  if (!added_point_arrays.empty() || !added_cell_arrays.empty()) {
    throw WriteError(path, "the format holds no named arrays, none can be added");
  }
  if (document.point_count() != count) {
    throw WriteError(path, "the file that was read has " + std::to_string(count) + " " + std::string(things) +
                               ", the mesh to write has " + std::to_string(document.point_count()));
  }
}

void write_sites(const std::filesystem::path& path, std::string_view bytes, std::span<const NumberSites> sites,
                 const MeshDocument& document, Workers& workers) {
  std::vector<std::vector<double>> copies;
  std::vector<PatchedSites> lists;
  lists.reserve(sites.size());
  for (const NumberSites& list : sites) {
    lists.push_back({list, column_values(list, document, copies)});
  }
  write_patched(path, bytes, lists, {}, FileWorkers(workers));
}

std::vector<ColumnValues> column_values(const NumberSites& sites, const MeshDocument& document,
                                        std::vector<std::vector<double>>& copies) {
  std::vector<ColumnValues> values;
  for (const SiteColumn& column : sites.columns) {
    if (column.array.empty()) {
      values.push_back({document.points.data() + (document.points.empty() ? 0 : column.component), 3});
      continue;
    }
    const DataArray* const array = find_array(document.point_arrays, column.array);
    const bool is_real = array != nullptr && column.component < array->components &&
                         (array->type == ScalarType::float32 || array->type == ScalarType::float64);
    if (!is_real) {
      values.emplace_back();
      continue;
    }
    std::vector<double>& copy = copies.emplace_back(array->rows());
    for (std::size_t row = 0; row < copy.size(); ++row) {
      copy[row] = array->value(row, column.component);
    }
    values.push_back({copy.data(), 1});
  }
  return values;
}

std::shared_ptr<const OriginalFile> make_patched_original(FileBytes bytes, std::vector<NumberSites> sites) {
  return std::make_shared<PatchedOriginal>(std::move(bytes), std::move(sites));
}

std::shared_ptr<const OriginalFile> make_patched_original(FileBytes bytes, NumberSites sites) {
  std::vector<NumberSites> one;
  one.push_back(std::move(sites));
  return make_patched_original(std::move(bytes), std::move(one));
}

}  // namespace trismooth
