// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/hdf5/hdf5_original.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include "trismooth/mesh_io/document/number_sites.h"
#include "trismooth/mesh_io/document/patched_original.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/hdf5/hdf5_changes.h"
#include "trismooth/mesh_io/hdf5/hdf5_reader.h"

namespace trismooth {

namespace {

/// What is no number stays so; a zero's sign counts.
bool differs(double stored, double value) {
  return !(std::isnan(stored) && std::isnan(value)) && (stored != value || std::signbit(stored) != std::signbit(value));
}

/// Those that were never written, in a file of few steps or points, as the file has them.
std::vector<double> all_values(const Hdf5Reader& reader, const std::string& dataset) {
  const std::vector<std::uint64_t> extents = reader.shape_of(dataset).extents;
  const std::vector<std::size_t> begin(extents.size());
  const std::vector<std::size_t> counts(extents.begin(), extents.end());
  std::vector<double> values(std::accumulate(counts.begin(), counts.end(), std::size_t{1}, std::multiplies<>()));
  reader.read_part(dataset, begin, counts, ScalarType::float64, values.data());
  return values;
}

class Hdf5Original : public OriginalFile {
 public:
  Hdf5Original(FileBytes bytes, std::size_t points, std::vector<Hdf5Column> columns)
      : bytes_(std::move(bytes)), points_(points) {
    for (Hdf5Column& column : columns) {
      columns_[column.dataset].push_back(std::move(column));
    }
  }

  void write(const std::filesystem::path& path, const MeshDocument& document,
             std::span<const DataArray> added_point_arrays, std::span<const DataArray> added_cell_arrays,
             Workers& workers) const override {
    require_same_points(path, document, points_, "nodes", added_point_arrays, added_cell_arrays);
    Hdf5Values changed;
    try {
      const Hdf5Reader reader(path, bytes_);
      if (write_in_place(path, reader, document, workers)) {
        return;
      }
      for (const auto& [dataset, columns] : columns_) {
        std::vector<double> values = all_values(reader, dataset);
        for (const Hdf5Column& column : columns) {
          if (column.count > 0 && column.begin + (column.count - 1) * column.step >= values.size()) {
            throw ReadError(path, "another number of values");
          }
        }
        if (update(values, columns, document)) {
          changed.emplace(dataset, std::move(values));
        }
      }
    } catch (const ReadError&) {
      throw WriteError(path, "the file that was read is damaged: HDF5 has read it once, and not a second time");
    }
    write_changed_hdf5(path, bytes_, changed);
  }

  bool keeps_values_of(std::string_view point_array) const override {
    return std::ranges::any_of(columns_, [point_array](const auto& of_dataset) {
      return std::ranges::any_of(of_dataset.second, [point_array](const Hdf5Column& column) {
        return !column.column.array.empty() && column.column.array == point_array;
      });
    });
  }

 private:
  /// False, and nothing is done, where not all numbers stand in the file as they are.
  bool write_in_place(const std::filesystem::path& path, const Hdf5Reader& reader, const MeshDocument& document,
                      Workers& workers) const {
    std::deque<NumberSites> sites;
    std::map<const NumberSites*, std::size_t> first_points;
    std::vector<const NumberSites*> order;
    for (const auto& [dataset, columns] : columns_) {
      for (const Hdf5Column& column : columns) {
        auto found = hdf5_sites(reader, dataset, column.begin, column.step, column.count, {column.column});
        if (!found) {
          return false;
        }
        sites.push_back(std::move(*found));
        order.push_back(&sites.back());
        first_points.emplace(order.back(), column.first_point);
      }
    }
    if (!sort_apart(order)) {
      return false;
    }
    std::vector<std::vector<double>> copies;
    std::vector<PatchedSites> lists;
    for (const NumberSites* const list : order) {
      lists.push_back({*list, column_values(*list, document, copies)});
      for (ColumnValues& values : lists.back().values) {
        values.first += values.first == nullptr ? 0 : first_points.at(list) * values.stride;
      }
    }
    write_patched(path, bytes_, lists, {}, FileWorkers(workers));
    return true;
  }

  /// Whether any value is another one now.
  static bool update(std::vector<double>& values, const std::vector<Hdf5Column>& columns,
                     const MeshDocument& document) {
    bool any = false;
    for (const Hdf5Column& column : columns) {
      const SiteColumn& site = column.column;
      const DataArray* const array = site.array.empty() ? nullptr : find_array(document.point_arrays, site.array);
      if (!site.array.empty() && (array == nullptr || site.component >= array->components)) {
        continue;
      }
      for (std::size_t i = 0; i < column.count; ++i) {
        const std::size_t point = column.first_point + i;
        const double value =
            array == nullptr ? document.points[3 * point + site.component] : array->value(point, site.component);
        double& stored = values[column.begin + i * column.step];
        if (differs(stored, value)) {
          stored = value;
          any = true;
        }
      }
    }
    return any;
  }

  FileBytes bytes_;
  std::size_t points_;
  std::map<std::string, std::vector<Hdf5Column>> columns_;  ///< by their dataset
};

}  // namespace

std::shared_ptr<const OriginalFile> make_hdf5_original(FileBytes bytes, std::size_t points,
                                                       std::vector<Hdf5Column> columns) {
  return std::make_shared<Hdf5Original>(std::move(bytes), points, std::move(columns));
}

}  // namespace trismooth
