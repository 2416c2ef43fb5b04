// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/data_array.h"
#include "trismooth/mesh_io/document/number_sites.h"
#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/mesh_io/netcdf/netcdf4_file.h"
#include "trismooth/mesh_io/netcdf/netcdf_content.h"

namespace trismooth {

/// A netCDF file to read: a classic one by its bytes, a netCDF-4 file by HDF5. What it declares is within what
/// its size allows, so whoever reads values may make room for them.
class NetcdfFile {
 public:
  /// The bytes, and the workers, must outlive it. Throws ReadError.
  NetcdfFile(std::filesystem::path path, std::string_view bytes, const FileWorkers& workers);

  const std::filesystem::path& path() const { return path_; }
  const NetcdfContent& content() const { return content_; }
  bool is_classic() const { return netcdf4_ == nullptr; }

  /// The dimension's length, or nothing.
  std::optional<std::size_t> length_of(std::string_view dimension) const;
  /// The variable, or null.
  const NetcdfVariable* find(std::string_view variable) const;

  /// The values of a variable at these first indices (of a table {2} is the third row), in the file's order. T is
  /// int32, int64, float or double. Throws ReadError, also for text where T is no text, and for real numbers where T is
  /// whole.
  template <class T>
  std::vector<T> values(const NetcdfVariable& variable, std::span<const std::size_t> leading = {}) const;

  /// Reads values() into `values`, which has part_of().size of them.
  template <class T>
  void read(const NetcdfVariable& variable, std::span<const std::size_t> leading, std::span<T> values) const;

  /// The numbers of values() in the file's own type, float or double, as an array of that name.
  DataArray real_array(std::string name, const NetcdfVariable& variable, std::span<const std::size_t> leading) const;

  /// The texts of a variable of text, whose last dimension is their length: without what fills them up.
  std::vector<std::string> texts(const NetcdfVariable& variable) const;

  /// What values() reads.
  struct Part {
    std::vector<std::size_t> begin;
    std::vector<std::size_t> counts;
    std::size_t size = 1;  ///< values in all
  };
  Part part_of(const NetcdfVariable& variable, std::span<const std::size_t> leading) const;

  /// Classic files: where the values at these first indices, of which there is one at least where the variable has
  /// records, begin.
  static std::uint64_t offset_of(const NetcdfVariable& variable, std::span<const std::size_t> leading);

 private:
  [[noreturn]] void fail(const NetcdfVariable& variable, const std::string& message) const;
  template <class T>
  void read_classic(const NetcdfVariable& variable, std::uint64_t offset, std::span<T> values) const;

  std::filesystem::path path_;
  std::string_view bytes_;
  const FileWorkers& workers_;
  std::unique_ptr<const Netcdf4File> netcdf4_;
  NetcdfContent content_;
  std::map<std::string_view, const NetcdfVariable*> variables_;  ///< by their names
};

extern template void NetcdfFile::read(const NetcdfVariable&, std::span<const std::size_t>,
                                      std::span<std::int32_t>) const;
extern template std::vector<std::int32_t> NetcdfFile::values(const NetcdfVariable&, std::span<const std::size_t>) const;
extern template std::vector<std::int64_t> NetcdfFile::values(const NetcdfVariable&, std::span<const std::size_t>) const;
extern template std::vector<float> NetcdfFile::values(const NetcdfVariable&, std::span<const std::size_t>) const;
extern template std::vector<double> NetcdfFile::values(const NetcdfVariable&, std::span<const std::size_t>) const;

/// Values of the points that are written back: a coordinate, or a component of a point array, which a variable has in
/// one piece.
struct NetcdfSites {
  const NetcdfVariable* variable = nullptr;
  std::vector<std::size_t> leading;
  SiteColumn column;
};

/// The original of a document that was read from `file`: `bytes`, with the values at these sites in place of those that
/// differ. Of a classic file no other byte changes; a netCDF-4 file where nothing differs is written byte by byte, else
/// HDF5 overwrites the values in a copy. No two sites are the same value.
std::shared_ptr<const OriginalFile> make_netcdf_original(const NetcdfFile& file, FileBytes bytes,
                                                         std::vector<NetcdfSites> sites);

/// Adds a note on variables that are not read for they lack values, where there are any.
void add_note_of_incomplete(const NetcdfFile& file, MeshDocument& document);

}  // namespace trismooth
