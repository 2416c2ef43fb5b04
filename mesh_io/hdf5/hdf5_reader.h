// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/data_array.h"

namespace trismooth {

class Hdf5Child;
enum class Hdf5Request : std::uint8_t;

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

/// Where the numbers of a dataset stand in the file, one after the other as they are.
struct Hdf5Place {
  std::uint64_t begin = 0;  ///< byte offset; they end before the file does
  bool is_big_endian = false;
};

/// An HDF5 file in memory, to be read. Objects are named by their paths ("/Mesh/0/geometry"), whose names must lead to
/// groups and datasets of the file itself. Groups may form circles: who descends counts the steps. What is read is
/// checked against the bytes there are before memory is asked for; whatever is wrong, and names that are missing, is a
/// ReadError that names the file and the object. Any thread may call it, one at a time is served.
///
/// The library itself reads beyond its memory in some damaged files. So it runs in a child of this process, which
/// answers questions (Hdf5Child); where it breaks off that is a ReadError. What a child says counts as what a file
/// says: it is held to the bytes there are. Numbers that stand in the file as they are are taken from there without it.
class Hdf5Reader {
 public:
  /// `bytes` are read where they are, and outlive the object; `file` names them in messages. Begins a child, which ends
  /// with the object.
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
  /// Nothing where the dataset holds no numbers, or they are packed, or lie apart.
  std::optional<Hdf5Place> place_of(const std::string& dataset) const;
  /// All numbers of a dataset, row by row, as T: double, float, or a whole number. What is beyond a whole number's
  /// range comes as its largest or smallest; fractions are not read as whole numbers.
  template <class T>
  std::vector<T> read(const std::string& dataset) const;
  /// All numbers of a dataset in their own type, under the name and with the components that are given; these divide
  /// their number.
  DataArray read_array(const std::string& dataset, std::string name, std::size_t components) const;
  /// Reads numbers of a part of a dataset, row by row, as numbers of `type` into `values`, which has room for them:
  /// `begin` and `counts` have a number for each extent. As read(), but values that were never written are what the
  /// file has in their place: whoever calls it has summed up what all datasets declare.
  void read_part(const std::string& dataset, std::span<const std::size_t> begin, std::span<const std::size_t> counts,
                 ScalarType type, void* values) const;
  /// All values of a dataset as they are in the file, of any type whose values have one size: lists of characters, say.
  std::string read_bytes(const std::string& dataset) const;
  /// All values of a dataset of single characters, never written ones as in read_part().
  std::string read_characters(const std::string& dataset) const;
  /// All texts of a dataset, without the zeros and blanks that fill them up.
  std::vector<std::string> read_texts(const std::string& dataset) const;

  std::vector<std::string> attribute_names(const std::string& object) const;
  bool has_attribute(const std::string& object, const std::string& name) const;
  Hdf5Shape attribute_shape(const std::string& object, const std::string& name) const;
  /// As read() and read_texts().
  template <class T>
  std::vector<T> read_attribute(const std::string& object, const std::string& name) const;
  std::vector<std::string> read_attribute_texts(const std::string& object, const std::string& name) const;
  /// What an attribute of lists of references to objects has first in each list; 0 where a list is empty.
  std::vector<std::uint64_t> read_attribute_references(const std::string& object, const std::string& name) const;
  /// The reference to an object, as such attributes have it.
  std::uint64_t reference_to(const std::string& object) const;

 private:
  /// The object, and the name of an attribute of it.
  using Name = std::pair<std::string, std::optional<std::string>>;
  /// What the child once said of a dataset or attribute; it is held to that.
  struct Description {
    Hdf5Shape shape;
    std::uint64_t value_size = 0;  ///< bytes
    std::optional<Hdf5Place> place;
  };

  [[noreturn]] void fail(const Name& name, const std::string& message) const;
  /// All that follow are called with the mutex held. Sends a request, with `more` numbers; what `receive` returns of
  /// the answer.
  template <class Receive>
  auto ask(Hdf5Request request, ScalarType type, const Name& name, const Receive& receive,
           std::span<const std::size_t> more = {}) const;
  /// What `take` returns of the message that is the answer.
  template <class Take>
  auto ask(Hdf5Request request, const Name& name, const Take& take) const;
  const Description& describe(const Name& name) const;
  template <class T>
  std::vector<T> read_numbers(const Name& name) const;
  /// All values of one size, by that request.
  std::string read_values(Hdf5Request request, const Name& name) const;
  std::vector<std::string> read_list(Hdf5Request request, const Name& name) const;
  std::vector<std::string> read_texts(const Name& name) const;

  std::filesystem::path file_;
  std::string_view bytes_;
  std::uint64_t most_;  ///< bytes that an answer may have
  mutable std::mutex mutex_;
  std::unique_ptr<Hdf5Child> child_;
  mutable std::map<Name, Description> descriptions_;
};

}  // namespace trismooth
