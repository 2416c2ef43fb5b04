// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/data_array.h"
#include "trismooth/mesh_io/document/number_sites.h"
#include "trismooth/mesh_io/hdf5/hdf5_original.h"
#include "trismooth/mesh_io/xdmf/xdmf_paths.h"

namespace trismooth {

class Hdf5Reader;

/// A file beside an XDMF file that has numbers of it.
struct XdmfHeavyFile {
  std::string name;
  std::filesystem::path path;
  std::optional<FileBytes> bytes{};  ///< absent: nothing of it was read
  std::vector<NumberSites> coordinates{};
  std::vector<Hdf5Column> packed{};  ///< coordinates that HDF5 has in another form

  bool has_coordinates() const { return !coordinates.empty() || !packed.empty(); }
};

/// Where an XDMF file names a file beside it: the bytes [begin, end).
struct XdmfFileName {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::size_t file = 0;  ///< a place in the list of files
};

/// Where the numbers of a <DataItem> are.
struct XdmfItem {
  enum class Place : std::uint8_t { text, hdf5, binary };

  Place place = Place::text;
  std::size_t line = 0;
  std::vector<std::uint64_t> extents{};
  std::optional<ScalarType> type{};  ///< absent: no numbers
  std::size_t file = 0;              ///< of heavy data: a place in the list of files
  std::string dataset{};             ///< in HDF5
  std::uint64_t begin = 0;           ///< bytes of the text, or of the binary file
  std::uint64_t end = 0;             ///< of the text
  bool is_big_endian = false;        ///< in the binary file
  bool is_untyped = false;           ///< text that tells no type, which XDMF takes for real numbers
  std::string key{};                 ///< the same for the same numbers

  std::uint64_t count() const;
};

/// Finds and reads what the <DataItem>s of an XDMF file hold: in its text, in HDF5 and in binary files beside it. What
/// they declare is checked against the bytes there are. Throws ReadError.
class XdmfItems {
 public:
  /// All must outlive the object.
  XdmfItems(std::filesystem::path file, std::string_view bytes, const FileWorkers& workers, XdmfPaths& paths);
  XdmfItems(const XdmfItems&) = delete;
  XdmfItems& operator=(const XdmfItems&) = delete;
  ~XdmfItems();

  /// The file that this <DataItem>, or the one that it refers to, is kept in.
  XdmfItem find(const XmlElement& item);
  /// Of the one <DataItem> that an element is to have.
  XdmfItem only_item_of(const XmlElement& element);

  /// All numbers of an item as T: double or std::int64_t.
  template <class T>
  std::vector<T> read(const XdmfItem& item);
  /// All numbers of an item that is text, each as a coordinate that the file stores as `type`, and where they are.
  std::vector<double> read_coordinates(const XdmfItem& item, std::vector<std::uint64_t>& offsets);
  /// Where the coordinates of an item are, with the document's points from `first_point` on: of text at `offsets`.
  void keep_coordinates(const XdmfItem& item, std::vector<std::uint64_t> offsets, std::vector<SiteColumn> columns,
                        std::size_t first_point);
  /// The numbers of an item in their own type; `components` divide their number. Those of one item are shared.
  DataArray read_array(const XdmfItem& item, const std::string& name, std::size_t components);

  [[noreturn]] void fail(std::size_t line, const std::string& message) const;

  /// Notes where all <DataItem>s of the tree name files.
  void find_file_names(const XmlElement& element);

  const std::vector<XdmfFileName>& file_names() const { return names_; }
  /// The files with their coordinates, and those in the text, which are the caller's then.
  std::vector<XdmfHeavyFile> take_files();
  std::vector<NumberSites> take_coordinates() { return std::move(coordinates_); }

 private:
  std::string_view content_of(const XmlElement& item) const;
  std::size_t file_of(std::string_view name, std::size_t line);
  std::string_view bytes_of(std::size_t file, std::size_t line);
  const Hdf5Reader& reader_of(std::size_t file, std::size_t line);
  void describe_heavy(const XmlElement& element, XdmfItem& item);
  template <class T>
  std::vector<T> read_text(const XdmfItem& item, std::vector<std::uint64_t>* offsets);
  template <class T>
  std::vector<T> read_binary(const XdmfItem& item);

  std::filesystem::path file_;
  std::string_view bytes_;
  FileWorkers workers_;
  XdmfPaths& paths_;
  std::vector<NumberSites> coordinates_;  ///< in the text
  std::vector<XdmfHeavyFile> files_;
  std::vector<std::unique_ptr<Hdf5Reader>> readers_;  ///< of each file; null where there is none
  std::vector<std::uint64_t> left_;                   ///< bytes that may still be read of each file, unpacked
  std::vector<XdmfFileName> names_;
  std::map<std::string, DataArray, std::less<>> arrays_;
};

}  // namespace trismooth
