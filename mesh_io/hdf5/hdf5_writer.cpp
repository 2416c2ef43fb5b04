// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/hdf5/hdf5_writer.h"

#include <algorithm>
#include <atomic>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/bytes/buffered_writer.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

Hdf5Handle space_of(std::span<const std::uint64_t> extents) {
  if (extents.empty()) {
    return {H5Screate(H5S_SCALAR), &H5Sclose};
  }
  const std::vector<hsize_t> sizes(extents.begin(), extents.end());
  return {H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr), &H5Sclose};
}

/// Files of one name are one file to HDF5.
std::string name_in_memory() {
  static std::atomic<std::uint64_t> made{0};
  return "trismooth file " + std::to_string(made++);
}

Hdf5Handle groups_above() {
  Hdf5Handle properties(H5Pcreate(H5P_LINK_CREATE), &H5Pclose);
  H5Pset_create_intermediate_group(properties.get(), 1);
  return properties;
}

}  // namespace

Hdf5Writer::Hdf5Writer(std::filesystem::path file, Hdf5Handle handle)
    : file_(std::move(file)), handle_(std::move(handle)) {
  if (!handle_.is_valid()) {
    throw WriteError(file_, "cannot be opened by HDF5" + hdf5_reason());
  }
}

Hdf5Writer Hdf5Writer::make(const std::filesystem::path& file) {
  const Hdf5Lock lock;
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), &H5Pclose);
  H5Pset_fapl_core(access.get(), std::size_t{1} << 20, false);
  return {file, {H5Fcreate(name_in_memory().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get()), &H5Fclose}};
}

Hdf5Writer::~Hdf5Writer() {
  const Hdf5Lock lock;
  const Hdf5Handle closed = std::move(handle_);
}

void Hdf5Writer::fail(const std::string& object) const {
  throw WriteError(file_, quoted(std::string_view(object)) + " cannot be written" + hdf5_reason());
}

void Hdf5Writer::make_group(const std::string& group) {
  const Hdf5Lock lock;
  const Hdf5Handle above = groups_above();
  const Hdf5Handle there(H5Gopen2(handle_.get(), group.c_str(), H5P_DEFAULT), &H5Gclose);
  const Hdf5Handle made(
      there.is_valid() ? -1 : H5Gcreate2(handle_.get(), group.c_str(), above.get(), H5P_DEFAULT, H5P_DEFAULT),
      &H5Gclose);
  if (!there.is_valid() && !made.is_valid()) {
    fail(group);
  }
}

void Hdf5Writer::write(const std::string& dataset, std::span<const std::uint64_t> extents, ScalarType type,
                       std::span<const std::byte> values) {
  const Hdf5Lock lock;
  write(dataset, extents, hdf5_memory_type(type), values);
}

void Hdf5Writer::write_rows(const std::string& dataset, std::size_t width, std::string_view rows) {
  const Hdf5Lock lock;
  const hsize_t size = width;
  const Hdf5Handle row(H5Tarray_create2(H5T_NATIVE_INT8, 1, &size), &H5Tclose);
  const std::uint64_t count = rows.size() / width;
  write(dataset, {&count, 1}, row.get(), std::as_bytes(std::span(rows)));
}

void Hdf5Writer::write(const std::string& dataset, std::span<const std::uint64_t> extents, hid_t type,
                       std::span<const std::byte> values) {
  const Hdf5Handle above = groups_above();
  const Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), &H5Pclose);
  H5Pset_obj_track_times(properties.get(), false);
  const Hdf5Handle space = space_of(extents);
  const Hdf5Handle made(
      H5Dcreate2(handle_.get(), dataset.c_str(), type, space.get(), above.get(), properties.get(), H5P_DEFAULT),
      &H5Dclose);
  if (!made.is_valid() ||
      (!values.empty() && H5Dwrite(made.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)) {
    fail(dataset);
  }
}

template <class T>
void Hdf5Writer::write(const std::string& dataset, std::span<const std::uint64_t> extents, std::span<const T> values) {
  write(dataset, extents, scalar_type_of<T>(), std::as_bytes(values));
}

void Hdf5Writer::set_attribute(const std::string& object, const std::string& name, hid_t type, const Hdf5Handle& space,
                               const void* values) {
  const Hdf5Handle at(H5Oopen(handle_.get(), object.c_str(), H5P_DEFAULT), &H5Oclose);
  const Hdf5Handle made(
      at.is_valid() ? H5Acreate2(at.get(), name.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT) : -1, &H5Aclose);
  if (!made.is_valid() || H5Awrite(made.get(), type, values) < 0) {
    fail(object + ":" + name);
  }
}

template <class T>
requires std::is_arithmetic_v<T>
void Hdf5Writer::set_attribute(const std::string& object, const std::string& name, T value) {
  const Hdf5Lock lock;
  set_attribute(object, name, hdf5_memory_type(scalar_type_of<T>()), space_of({}), &value);
}

template <class T>
void Hdf5Writer::set_attribute(const std::string& object, const std::string& name, std::span<const T> values) {
  const Hdf5Lock lock;
  const std::uint64_t count = values.size();
  set_attribute(object, name, hdf5_memory_type(scalar_type_of<T>()), space_of({&count, 1}), values.data());
}

void Hdf5Writer::set_attribute(const std::string& object, const std::string& name, std::string_view text,
                               std::size_t size) {
  const Hdf5Lock lock;
  std::string filled(text);
  filled.resize(size == 0 ? text.size() + 1 : size, '\0');
  const Hdf5Handle type(H5Tcopy(H5T_C_S1), &H5Tclose);
  H5Tset_size(type.get(), filled.size());
  set_attribute(object, name, type.get(), space_of({}), filled.data());
}

void Hdf5Writer::close() {
  const Hdf5Lock lock;
  const ssize_t size =
      H5Fflush(handle_.get(), H5F_SCOPE_GLOBAL) < 0 ? -1 : H5Fget_file_image(handle_.get(), nullptr, 0);
  std::string image(static_cast<std::size_t>(std::max<ssize_t>(size, 0)), '\0');
  if (size <= 0 || H5Fget_file_image(handle_.get(), image.data(), image.size()) < 0) {
    throw WriteError(file_, "cannot be written by HDF5" + hdf5_reason());
  }
  BufferedWriter writer(file_);
  writer.write(image);
  writer.close();
  if (!handle_.close()) {
    throw WriteError(file_, "cannot be written by HDF5" + hdf5_reason());
  }
}

#define TRISMOOTH_HDF5_WRITE(T)                                                                         \
  template void Hdf5Writer::write(const std::string& dataset, std::span<const std::uint64_t> extents,   \
                                  std::span<const T> values);                                           \
  template void Hdf5Writer::set_attribute(const std::string& object, const std::string& name, T value); \
  template void Hdf5Writer::set_attribute(const std::string& object, const std::string& name,           \
                                          std::span<const T> values);
TRISMOOTH_HDF5_WRITE(std::int8_t)
TRISMOOTH_HDF5_WRITE(std::uint8_t)
TRISMOOTH_HDF5_WRITE(std::int32_t)
TRISMOOTH_HDF5_WRITE(std::int64_t)
TRISMOOTH_HDF5_WRITE(float)
TRISMOOTH_HDF5_WRITE(double)
#undef TRISMOOTH_HDF5_WRITE

}  // namespace trismooth
