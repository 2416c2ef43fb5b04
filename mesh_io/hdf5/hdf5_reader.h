// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/data_array.h"
#include "trismooth/mesh_io/hdf5/hdf5_handle.h"

namespace trismooth {

/// What a name in a group leads to. Links to elsewhere (soft, external) are not followed.
enum class Hdf5Kind { group, dataset, link, other };

struct Hdf5Member {
  std::string name;
  Hdf5Kind kind = Hdf5Kind::other;
};

/// What a dataset or an attribute holds.
struct Hdf5Shape {
  std::vector<std::uint64_t> extents;  ///< of its dimensions; empty: one value
  std::optional<ScalarType> type;      ///< absent where it holds something else than numbers
  bool is_text = false;

  /// Its values: the product of the extents.
  std::uint64_t count() const;
};

/// An HDF5 file in memory, to be read. Objects are named by their paths ("/Mesh/0/geometry"), whose names must lead to
/// groups and datasets of the file itself. Groups may form circles: who descends counts the steps. What is read is
/// checked against the bytes there are before memory is asked for; whatever is wrong, and names that are missing, is a
/// ReadError that names the file and the object. One thread at a time calls the library, whoever calls this.
class Hdf5Reader {
 public:
  /// `bytes` are read where they are, and outlive the object; `file` names them in messages.
  Hdf5Reader(std::filesystem::path file, std::string_view bytes);
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;
  ~Hdf5Reader();

  const std::filesystem::path& file() const { return file_; }

  /// What is in a group: in the order of creation where the file tells that, else by name.
  std::vector<Hdf5Member> members(const std::string& group) const;
  /// What the path leads to, or nothing.
  std::optional<Hdf5Kind> kind_of(const std::string& object) const;

  Hdf5Shape shape_of(const std::string& dataset) const;
  /// All numbers of a dataset, row by row, as T: double, float, or a whole number. What is beyond a whole number's
  /// range comes as its largest or smallest; fractions are not read as whole numbers.
  template <class T>
  std::vector<T> read(const std::string& dataset) const;
  /// All numbers of a dataset in their own type, under the name and with the components that are given; these divide
  /// their number.
  DataArray read_array(const std::string& dataset, std::string name, std::size_t components) const;
  /// All values of a dataset as they are in the file, of any type whose values have one size: lists of characters, say.
  std::string read_bytes(const std::string& dataset) const;
  /// All texts of a dataset, without the zeros and blanks that fill them up.
  std::vector<std::string> read_texts(const std::string& dataset) const;

  std::vector<std::string> attribute_names(const std::string& object) const;
  bool has_attribute(const std::string& object, const std::string& name) const;
  Hdf5Shape attribute_shape(const std::string& object, const std::string& name) const;
  /// As read() and read_texts().
  template <class T>
  std::vector<T> read_attribute(const std::string& object, const std::string& name) const;
  std::vector<std::string> read_attribute_texts(const std::string& object, const std::string& name) const;

 private:
  struct Source;

  [[noreturn]] void fail(const std::string& object, const std::string& message) const;
  /// Both to be called with the lock held.
  Hdf5Handle open(const std::string& object) const;
  Source open_dataset(const std::string& dataset) const;
  Source open_attribute(const std::string& object, const std::string& name) const;
  /// Throws unless `source` holds numbers that can be read as `type`, as many as the file's bytes allow.
  void require_numbers(const Source& source, ScalarType type) const;
  void require_bytes(const Source& source) const;
  void read_numbers(const Source& source, ScalarType type, void* values) const;
  std::vector<std::string> read_texts_of(const Source& source) const;

  std::filesystem::path file_;
  std::string_view bytes_;
  Hdf5Handle handle_;
};

/// Whether the bytes are an HDF5 file that has a group or dataset of that path. Opens the file, reads nothing else.
bool is_hdf5_with(std::string_view bytes, const std::string& object);

}  // namespace trismooth
