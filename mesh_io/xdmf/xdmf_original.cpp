// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/xdmf/xdmf_original.h"

#include <algorithm>
#include <cctype>
#include <deque>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "trismooth/mesh_io/bytes/buffered_writer.h"
#include "trismooth/mesh_io/bytes/output_file.h"
#include "trismooth/mesh_io/document/number_sites.h"
#include "trismooth/mesh_io/document/patched_original.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/xml/xml_names.h"
#ifdef TRISMOOTH_HAS_HDF5
#include "trismooth/mesh_io/hdf5/hdf5_changes.h"
#include "trismooth/mesh_io/hdf5/hdf5_reader.h"
#endif

namespace trismooth {

namespace {

std::filesystem::path folder_of(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  const std::filesystem::path found = std::filesystem::canonical(folder, error);
  return error ? folder : found;
}

class XdmfOriginal : public OriginalFile {
 public:
  explicit XdmfOriginal(XdmfSource source) : source_(std::move(source)), has_coordinates_(source_.files.size()) {
    for (const XdmfCoordinates& coordinates : source_.coordinates) {
      if (coordinates.item.place != XdmfItem::Place::text) {
        has_coordinates_[coordinates.item.file] = true;
      }
    }
  }

  std::vector<std::filesystem::path> other_files(const std::filesystem::path& path) const override {
    const std::vector<std::string> names = names_beside(path);
    std::vector<std::filesystem::path> others;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (is_written(i, path)) {
        others.push_back(path.parent_path() / names[i]);
      }
    }
    return others;
  }

  void write(const std::filesystem::path& path, const MeshDocument& document,
             std::span<const DataArray> added_point_arrays, std::span<const DataArray> added_cell_arrays,
             Workers& workers) const override {
    require_same_points(path, document, source_.points, "points", added_point_arrays, added_cell_arrays);
    const std::filesystem::path name = OutputFile::name_of(path);
    const std::vector<std::string> names = names_beside(name);
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (is_written(i, name)) {
        write_heavy(i, OutputFile::place_of(name.parent_path() / names[i]), document, workers);
      }
    }
    write_text(path, names, document, workers);
  }

 private:
  bool is_written(std::size_t file, const std::filesystem::path& path) const {
    return has_coordinates_[file] || folder_of(path) != folder_of(source_.path);
  }

  /// What the files are called beside the one at `path`: "out.h5" for the "in.h5" of "in.xdmf", "out_mesh.h5" for its
  /// "mesh.h5". Only where the file is written back to its own place they keep their names: what a file is called is
  /// the choice of whoever made it, and may be the name of something else in another folder.
  std::vector<std::string> names_beside(const std::filesystem::path& path) const {
    const std::string stem = path.stem().string();
    const std::string own = source_.path.stem().string();
    const bool is_in_place = path.filename() == source_.path.filename() && folder_of(path) == folder_of(source_.path);
    const auto keeps_name = [&](std::size_t i) { return is_in_place || !is_written(i, path); };
    std::set<std::string, std::less<>> taken;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < source_.files.size(); ++i) {
      names.push_back(source_.files[i].name);
      if (keeps_name(i)) {
        taken.insert(names[i]);
      }
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (keeps_name(i)) {
        continue;
      }
      const bool begins_so = names[i].starts_with(own) && names[i].size() > own.size() &&
                             std::isalpha(static_cast<unsigned char>(names[i][own.size()])) == 0;
      std::string wanted = begins_so ? stem + names[i].substr(own.size()) : stem + "_" + names[i];
      while (wanted == path.filename() || !taken.insert(wanted).second) {
        wanted.insert(stem.size(), "_");
      }
      names[i] = wanted;
    }
    return names;
  }

  /// The values that coordinates are to have.
  static std::vector<ColumnValues> values_of(const XdmfCoordinates& coordinates, const MeshDocument& document) {
    std::vector<ColumnValues> values;
    for (const std::uint8_t component : coordinates.components) {
      values.push_back({document.points.data() + 3 * coordinates.first_point + component, 3});
    }
    return values;
  }

  static std::vector<SiteColumn> columns_of(const XdmfCoordinates& coordinates) {
    std::vector<SiteColumn> columns;
    for (const std::uint8_t component : coordinates.components) {
      columns.push_back({.component = component});
    }
    return columns;
  }

  /// In the order of their places.
  std::vector<const XdmfCoordinates*> coordinates_at(XdmfItem::Place place, std::size_t file) const {
    std::vector<const XdmfCoordinates*> found;
    for (const XdmfCoordinates& one : source_.coordinates) {
      if (one.item.place == place && (place == XdmfItem::Place::text || one.item.file == file)) {
        found.push_back(&one);
      }
    }
    std::ranges::sort(found, {}, [](const XdmfCoordinates* one) { return one->item.begin; });
    return found;
  }

  void write_text(const std::filesystem::path& path, const std::vector<std::string>& names,
                  const MeshDocument& document, Workers& workers) const {
    std::string renamed;
    std::vector<std::pair<std::size_t, std::ptrdiff_t>> shifts;  // from that byte on
    std::size_t copied = 0;
    std::vector<XdmfFileName> places = source_.names;
    std::ranges::sort(places, {}, &XdmfFileName::begin);
    for (const XdmfFileName& place : places) {
      if (names[place.file] == source_.files[place.file].name) {
        continue;
      }
      renamed.append(source_.bytes.view().substr(copied, place.begin - copied))
          .append(escape_xml_attribute(names[place.file]));
      copied = place.end;
      shifts.emplace_back(copied, static_cast<std::ptrdiff_t>(renamed.size()) - static_cast<std::ptrdiff_t>(copied));
    }
    const std::vector<const XdmfCoordinates*> coordinates = coordinates_at(XdmfItem::Place::text, 0);
    std::vector<NumberSites> sites;
    for (const XdmfCoordinates* const one : coordinates) {
      const auto behind = std::ranges::upper_bound(shifts, one->item.begin, {}, [](const auto& s) { return s.first; });
      const std::ptrdiff_t shift = behind == shifts.begin() ? 0 : std::prev(behind)->second;
      NumberSites& list = sites.emplace_back();
      list.type = one->item.type.value_or(ScalarType::float64);
      list.columns = columns_of(*one);
      list.offsets = one->offsets;
      for (std::uint64_t& offset : list.offsets) {
        offset += static_cast<std::uint64_t>(shift);
      }
    }
    std::string_view bytes = source_.bytes;
    if (!shifts.empty()) {
      renamed.append(bytes.substr(copied));
      bytes = renamed;
    }
    std::vector<PatchedSites> lists;
    for (std::size_t i = 0; i < sites.size(); ++i) {
      lists.push_back({sites[i], values_of(*coordinates[i], document)});
    }
    write_patched(path, bytes, lists, {}, FileWorkers(workers));
  }

  void write_heavy(std::size_t file, const std::filesystem::path& place, const MeshDocument& document,
                   Workers& workers) const {
    const XdmfHeavyFile& heavy = source_.files[file];
    if (!heavy.bytes) {
      std::error_code error;
      if (!std::filesystem::copy_file(heavy.path, place, std::filesystem::copy_options::overwrite_existing, error)) {
        throw WriteError(place, "cannot be made a copy of " + heavy.path.string() + ": " + error.message());
      }
      return;
    }
    std::vector<const XdmfCoordinates*> placed = coordinates_at(XdmfItem::Place::binary, file);
    std::deque<NumberSites> sites;
    for (const XdmfCoordinates* const one : placed) {
      const XdmfItem& item = one->item;
      const std::size_t columns = one->components.size();
      sites.push_back(binary_sites(item.is_big_endian ? NumberEncoding::big_endian : NumberEncoding::little_endian,
                                   *item.type, item.begin, columns, static_cast<std::size_t>(item.count()) / columns,
                                   columns_of(*one)));
    }
    const std::vector<const XdmfCoordinates*> datasets = coordinates_at(XdmfItem::Place::hdf5, file);
    std::vector<const XdmfCoordinates*> packed;
#ifdef TRISMOOTH_HAS_HDF5
    if (!datasets.empty()) {
      const Hdf5Reader reader(heavy.path, heavy.bytes->view());
      for (const XdmfCoordinates* const one : datasets) {
        const std::size_t columns = one->components.size();
        auto found = hdf5_sites(reader, one->item.dataset, 0, columns,
                                static_cast<std::size_t>(one->item.count()) / columns, columns_of(*one));
        if (found) {
          sites.push_back(std::move(*found));
          placed.push_back(one);
        } else {
          packed.push_back(one);
        }
      }
    }
#endif
    write_placed(place, *heavy.bytes, sites, placed, document, workers);
#ifdef TRISMOOTH_HAS_HDF5
    if (!packed.empty()) {
      const FileBytes patched = placed.empty() ? FileBytes() : read_file_bytes(place, FileWorkers(workers));
      write_datasets(place, placed.empty() ? heavy.bytes->view() : patched.view(), packed, document);
    }
#endif
  }

  /// `sites`: of each of `coordinates`, of binary numbers.
  static void write_placed(const std::filesystem::path& path, std::string_view bytes,
                           const std::deque<NumberSites>& sites, std::span<const XdmfCoordinates* const> coordinates,
                           const MeshDocument& document, Workers& workers) {
    std::map<const NumberSites*, const XdmfCoordinates*> owners;
    std::vector<const NumberSites*> order;
    for (std::size_t i = 0; i < sites.size(); ++i) {
      owners.emplace(&sites[i], coordinates[i]);
      order.push_back(&sites[i]);
    }
    if (!sort_apart(order)) {
      throw WriteError(path, "of the file that was read, coordinates of several grids overlap, which are not changed");
    }
    std::vector<PatchedSites> lists;
    for (const NumberSites* const list : order) {
      lists.push_back({*list, values_of(*owners.at(list), document)});
    }
    write_patched(path, bytes, lists, {}, FileWorkers(workers));
  }

#ifdef TRISMOOTH_HAS_HDF5
  static void write_datasets(const std::filesystem::path& place, std::string_view bytes,
                             std::span<const XdmfCoordinates* const> datasets, const MeshDocument& document) {
    Hdf5Values changed;
    try {
      const Hdf5Reader reader(place, bytes);
      for (const XdmfCoordinates* const one : datasets) {
        std::vector<double> values = reader.read<double>(one->item.dataset);
        if (values.size() != one->item.count()) {
          throw ReadError(place, "another number of values");
        }
        const std::vector<ColumnValues> columns = values_of(*one, document);
        bool differs = false;
        for (std::size_t i = 0; i < values.size(); ++i) {
          const ColumnValues& column = columns[i % columns.size()];
          const double value = column.first[i / columns.size() * column.stride];
          differs = differs || value != values[i];
          values[i] = value == values[i] ? values[i] : value;
        }
        if (differs) {
          changed.insert_or_assign(one->item.dataset, std::move(values));
        }
      }
    } catch (const ReadError&) {
      throw WriteError(place, "the file that was read is damaged: HDF5 has read it once, and not a second time");
    }
    write_changed_hdf5(place, bytes, changed);
  }
#endif

  XdmfSource source_;
  std::vector<char> has_coordinates_;  ///< of each file
};

}  // namespace

std::shared_ptr<const OriginalFile> make_xdmf_original(XdmfSource source) {
  return std::make_shared<XdmfOriginal>(std::move(source));
}

}  // namespace trismooth
