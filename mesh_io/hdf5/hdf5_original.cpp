// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/hdf5/hdf5_original.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "trismooth/mesh_io/bytes/buffered_writer.h"
#include "trismooth/mesh_io/document/patched_original.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/hdf5/hdf5_changes.h"
#include "trismooth/mesh_io/hdf5/hdf5_reader.h"

namespace trismooth {

namespace {

/// Those that were never written, in a file of few steps or points, as the file has them.
std::vector<double> all_values(const Hdf5Reader& reader, const std::string& dataset) {
  const std::vector<std::uint64_t> extents = reader.shape_of(dataset).extents;
  const std::vector<std::size_t> begin(extents.size());
  const std::vector<std::size_t> counts(extents.begin(), extents.end());
  std::vector<double> values(std::accumulate(counts.begin(), counts.end(), std::size_t{1}, std::multiplies<>()));
  reader.read_part(dataset, begin, counts, ScalarType::float64, values.data());
  return values;
}

/// Whether any value is another one now.
bool update(std::span<double> values, const NumberSites& numbers, const MeshDocument& document) {
  std::vector<std::vector<double>> copies;
  const std::vector<ColumnValues> columns = column_values(numbers, document, copies);
  bool any = false;
  for (std::size_t i = 0; i < columns.size() * numbers.size(); ++i) {
    const ColumnValues& column = columns[i % columns.size()];
    if (column.first == nullptr) {
      continue;
    }
    const double value = column.first[numbers.vertex_at(i / columns.size()) * column.stride];
    any = differs(values[i], value) || any;
    values[i] = differs(values[i], value) ? value : values[i];
  }
  return any;
}

class Hdf5Original : public OriginalFile {
 public:
  Hdf5Original(FileBytes bytes, std::size_t points, std::vector<Hdf5Column> columns)
      : bytes_(std::move(bytes)), points_(points), columns_(std::move(columns)) {}

  void write(const std::filesystem::path& path, const MeshDocument& document,
             std::span<const DataArray> added_point_arrays, std::span<const DataArray> added_cell_arrays,
             Workers& workers) const override {
    require_same_points(path, document, points_, "nodes", added_point_arrays, added_cell_arrays);
    std::vector<NumberSites> sites;
    for (const Hdf5Column& column : columns_) {
      sites.push_back(column.numbers);
    }
    if (std::ranges::none_of(columns_, &Hdf5Column::is_packed) && sort_apart(sites)) {
      write_sites(path, bytes_, sites, document, workers);
    } else {
      write_hdf5_columns(path, bytes_, columns_, document);
    }
  }

  bool keeps_values_of(std::string_view point_array) const override {
    return std::ranges::any_of(
        columns_, [point_array](const Hdf5Column& column) { return column.numbers.has_values_of(point_array); });
  }

 private:
  FileBytes bytes_;
  std::size_t points_;
  std::vector<Hdf5Column> columns_;
};

}  // namespace

Hdf5Column hdf5_column(const Hdf5Reader& reader, const std::string& dataset, std::size_t begin, std::size_t count,
                       std::vector<SiteColumn> columns, std::size_t first_point) {
  const ScalarType type = reader.shape_of(dataset).type.value();
  const std::optional<Hdf5Place> place = reader.place_of(dataset);
  const Hdf5Place from = place.value_or(Hdf5Place());
  Hdf5Column column{dataset, begin,
                    binary_sites(binary_encoding(from.is_big_endian), type, from.begin + begin * size_of(type), count,
                                 std::move(columns)),
                    !place};
  column.numbers.first_vertex = first_point;
  return column;
}

void write_hdf5_columns(const std::filesystem::path& path, std::string_view bytes, std::span<const Hdf5Column> columns,
                        const MeshDocument& document) {
  std::map<std::string_view, std::vector<const Hdf5Column*>> by_dataset;
  for (const Hdf5Column& column : columns) {
    by_dataset[column.dataset].push_back(&column);
  }
  Hdf5Values changed;
  try {
    const Hdf5Reader reader(path, bytes);
    for (const auto& [dataset, of_dataset] : by_dataset) {
      std::vector<double> values = all_values(reader, std::string(dataset));
      bool any = false;
      for (const Hdf5Column* const column : of_dataset) {
        const std::size_t count = column->numbers.columns.size() * column->numbers.size();
        if (count > values.size() || column->begin > values.size() - count) {
          throw ReadError(path, "another number of values");
        }
        any = update(std::span(values).subspan(column->begin, count), column->numbers, document) || any;
      }
      if (any) {
        changed.emplace(dataset, std::move(values));
      }
    }
  } catch (const ReadError&) {
    throw WriteError(path, "the file that was read is damaged: HDF5 has read it once, and not a second time");
  }
  if (!changed.empty()) {
    write_changed_hdf5(path, bytes, changed);
    return;
  }
  BufferedWriter writer(path);
  writer.write(bytes);
  writer.close();
}

std::shared_ptr<const OriginalFile> make_hdf5_original(FileBytes bytes, std::size_t points,
                                                       std::vector<Hdf5Column> columns) {
  return std::make_shared<Hdf5Original>(std::move(bytes), points, std::move(columns));
}

}  // namespace trismooth
