// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "trismooth/mesh_io/data_array.h"
#include "trismooth/mesh_io/hdf5/hdf5_handle.h"

namespace trismooth {

/// An HDF5 file that is made. Objects are named by their paths. Throws WriteError, which names the file. The same calls
/// make the same bytes: no times are kept. (write_changed_hdf5() changes one that is there.)
class Hdf5Writer {
 public:
  /// A new file, in memory until close() writes it to `file`, a plain path of any kind.
  static Hdf5Writer make(const std::filesystem::path& file);
  Hdf5Writer(Hdf5Writer&&) = default;
  ~Hdf5Writer();

  /// Makes a group, and those above it. One that is there is left as it is.
  void make_group(const std::string& group);
  /// Makes a dataset in the order of this machine's bytes, and the groups above it. `values`: as many as `extents` say.
  template <class T>
  void write(const std::string& dataset, std::span<const std::uint64_t> extents, std::span<const T> values);
  /// The same of values of any type.
  void write(const std::string& dataset, std::span<const std::uint64_t> extents, ScalarType type,
             std::span<const std::byte> values);
  /// Makes a dataset of rows of `width` characters, one row a value, and the groups above it; `rows` are the characters
  /// of all.
  void write_rows(const std::string& dataset, std::size_t width, std::string_view rows);
  /// Gives an object an attribute: one number, an array, or a text, which is filled up with zeros to `size` bytes, or
  /// has its own length and a zero.
  template <class T>
  requires std::is_arithmetic_v<T>
  void set_attribute(const std::string& object, const std::string& name, T value);
  template <class T>
  void set_attribute(const std::string& object, const std::string& name, std::span<const T> values);
  void set_attribute(const std::string& object, const std::string& name, std::string_view text, std::size_t size = 0);

  /// To be called at the end: what was not written before is written now.
  void close();

 private:
  Hdf5Writer(std::filesystem::path file, Hdf5Handle handle);

  [[noreturn]] void fail(const std::string& object) const;
  void write(const std::string& dataset, std::span<const std::uint64_t> extents, hid_t type,
             std::span<const std::byte> values);
  void set_attribute(const std::string& object, const std::string& name, hid_t type, const Hdf5Handle& space,
                     const void* values);

  std::filesystem::path file_;
  Hdf5Handle handle_;
};

}  // namespace trismooth
