// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/xdmf/xdmf_original.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "trismooth/mesh_io/bytes/output_file.h"
#include "trismooth/mesh_io/document/number_sites.h"
#include "trismooth/mesh_io/document/patched_original.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/hdf5/hdf5_original.h"
#include "trismooth/mesh_io/xml/xml_names.h"

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
  explicit XdmfOriginal(XdmfSource source) : source_(std::move(source)) {}

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
    return source_.files[file].has_coordinates() || folder_of(path) != folder_of(source_.path);
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

  /// In the order of their places.
  static std::vector<NumberSites> apart(std::vector<NumberSites> sites, const std::filesystem::path& path) {
    if (!sort_apart(sites)) {
      throw WriteError(path, "of the file that was read, coordinates of several grids overlap, which are not changed");
    }
    return sites;
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
    std::vector<NumberSites> sites = apart(source_.coordinates, path);
    for (NumberSites& list : sites) {
      const auto behind =
          std::ranges::upper_bound(shifts, list.offset_of(0, 0), {}, [](const auto& shift) { return shift.first; });
      const std::ptrdiff_t shift = behind == shifts.begin() ? 0 : std::prev(behind)->second;
      for (std::uint64_t& offset : list.offsets) {
        offset += static_cast<std::uint64_t>(shift);
      }
    }
    std::string_view bytes = source_.bytes;
    if (!shifts.empty()) {
      renamed.append(bytes.substr(copied));
      bytes = renamed;
    }
    write_sites(path, bytes, sites, document, workers);
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
    const std::vector<NumberSites> sites = apart(heavy.coordinates, place);
    write_sites(place, *heavy.bytes, sites, document, workers);
#ifdef TRISMOOTH_HAS_HDF5
    if (!heavy.packed.empty()) {
      const FileBytes patched = sites.empty() ? FileBytes() : read_file_bytes(place, FileWorkers(workers));
      write_hdf5_columns(place, sites.empty() ? heavy.bytes->view() : patched.view(), heavy.packed, document);
    }
#endif
  }

  XdmfSource source_;
};

}  // namespace

std::shared_ptr<const OriginalFile> make_xdmf_original(XdmfSource source) {
  return std::make_shared<XdmfOriginal>(std::move(source));
}

}  // namespace trismooth
