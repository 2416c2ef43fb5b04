// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/hdf5/hdf5_handle.h"

#include "support/scratch_folder.h"

namespace test_support {

using trismooth::Hdf5Handle;
using trismooth::Hdf5Lock;

/// HDF5 files by the library's own calls, as small as it makes them.
class SmallHdf5 {
 public:
  /// How values lie in the file.
  enum class Layout { contiguous, compact, deflated, big_endian };

  SmallHdf5() {
    const Hdf5Lock lock;
    const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), &H5Pclose);
    H5Pset_libver_bounds(access.get(), H5F_LIBVER_V18, H5F_LIBVER_V18);
    // Nothing is set aside for later.
    H5Pset_meta_block_size(access.get(), 0);
    H5Pset_small_data_block_size(access.get(), 0);
    const Hdf5Handle properties(H5Pcreate(H5P_FILE_CREATE), &H5Pclose);
    // Groups keep nothing that is not asked for.
    H5Pset_link_phase_change(properties.get(), 64, 8);
    // (HDF5 does not open files that are in memory alone.)
    file_ = {H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, properties.get(), access.get()), &H5Fclose};
  }
  SmallHdf5(const SmallHdf5&) = delete;
  SmallHdf5& operator=(const SmallHdf5&) = delete;
  ~SmallHdf5() {
    const Hdf5Lock lock;
    file_ = Hdf5Handle();
  }

  hid_t id() const { return file_.get(); }

  void group(const std::string& path) {
    const Hdf5Lock lock;
    const Hdf5Handle properties(H5Pcreate(H5P_GROUP_CREATE), &H5Pclose);
    H5Pset_obj_track_times(properties.get(), 0);
    H5Pset_est_link_info(properties.get(), 1, 1);
    const Hdf5Handle made(H5Gcreate2(id(), path.c_str(), H5P_DEFAULT, properties.get(), H5P_DEFAULT), &H5Gclose);
  }

  template <class T>
  void values(const std::string& path, const std::vector<T>& all, Layout layout = Layout::contiguous,
              std::vector<hsize_t> extents = {}) {
    const Hdf5Lock lock;
    if (extents.empty()) {
      extents = {all.size()};
    }
    const hid_t memory = trismooth::hdf5_memory_type(trismooth::scalar_type_of<T>());
    const Hdf5Handle type(H5Tcopy(memory), &H5Tclose);
    H5Tset_order(type.get(), layout == Layout::big_endian ? H5T_ORDER_BE : H5T_ORDER_LE);
    const Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), &H5Pclose);
    H5Pset_obj_track_times(properties.get(), 0);
    if (layout == Layout::compact) {
      H5Pset_layout(properties.get(), H5D_COMPACT);
    } else if (layout == Layout::deflated) {
      H5Pset_chunk(properties.get(), static_cast<int>(extents.size()), extents.data());
      H5Pset_deflate(properties.get(), 9);
    }
    write(path, type.get(), memory, extents, properties, all.data());
  }

  /// Values of `width` characters each.
  void rows(const std::string& path, std::size_t width, std::string_view text) {
    const Hdf5Lock lock;
    const hsize_t size = width;
    const Hdf5Handle type(H5Tarray_create2(H5T_STD_I8LE, 1, &size), &H5Tclose);
    const Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), &H5Pclose);
    H5Pset_obj_track_times(properties.get(), 0);
    write(path, type.get(), type.get(), {text.size() / width}, properties, text.data());
  }

  template <class T>
  void attribute(const std::string& path, const std::string& name, T value) {
    const Hdf5Lock lock;
    add_attribute(path, name, trismooth::hdf5_memory_type(trismooth::scalar_type_of<T>()), &value);
  }

  template <class T>
  void attributes(const std::string& path, const std::string& name, const std::vector<T>& values) {
    const Hdf5Lock lock;
    add_attribute(path, name, trismooth::hdf5_memory_type(trismooth::scalar_type_of<T>()), values.data(),
                  values.size());
  }

  /// A dataset of values as they are in the file, or of none; one that grows has chunks.
  void dataset(const std::string& path, hid_t type, std::vector<hsize_t> extents, bool grows, std::string_view bytes) {
    const Hdf5Lock lock;
    std::vector<hsize_t> most = extents;
    const Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), &H5Pclose);
    H5Pset_obj_track_times(properties.get(), 0);
    if (grows) {
      most.front() = H5S_UNLIMITED;
      std::vector<hsize_t> chunk(extents);
      chunk.front() = 1;
      H5Pset_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data());
    }
    const Hdf5Handle space(extents.empty()
                               ? H5Screate(H5S_SCALAR)
                               : H5Screate_simple(static_cast<int>(extents.size()), extents.data(), most.data()),
                           &H5Sclose);
    const Hdf5Handle made(H5Dcreate2(id(), path.c_str(), type, space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT),
                          &H5Dclose);
    if (!bytes.empty()) {
      H5Dwrite(made.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data());
    }
  }

  /// An attribute of lists of one reference each.
  void references(const std::string& path, const std::string& name, const std::vector<std::string>& to) {
    const Hdf5Lock lock;
    std::vector<hobj_ref_t> all(to.size());
    std::vector<hvl_t> lists;
    for (std::size_t i = 0; i < to.size(); ++i) {
      H5Rcreate(&all[i], id(), to[i].c_str(), H5R_OBJECT, -1);
      lists.push_back({1, &all[i]});
    }
    const Hdf5Handle type(H5Tvlen_create(H5T_STD_REF_OBJ), &H5Tclose);
    add_attribute(path, name, type.get(), lists.data(), lists.size());
  }

  void text(const std::string& path, const std::string& name, std::string value, std::size_t size) {
    const Hdf5Lock lock;
    value.resize(size, '\0');
    const Hdf5Handle type(H5Tcopy(H5T_C_S1), &H5Tclose);
    H5Tset_size(type.get(), size);
    add_attribute(path, name, type.get(), value.data());
  }

  /// The whole file, which is to get nothing more.
  std::string bytes() {
    const Hdf5Lock lock;
    file_ = Hdf5Handle();
    return bytes_of(path_);
  }

 private:
  void write(const std::string& path, hid_t type, hid_t memory, const std::vector<hsize_t>& extents,
             const Hdf5Handle& properties, const void* all) {
    const Hdf5Handle space(H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr), &H5Sclose);
    const Hdf5Handle made(H5Dcreate2(id(), path.c_str(), type, space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT),
                          &H5Dclose);
    H5Dwrite(made.get(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, all);
  }

  /// So many values; 0: one that is no list.
  void add_attribute(const std::string& path, const std::string& name, hid_t type, const void* value,
                     hsize_t count = 0) {
    const Hdf5Handle space(count == 0 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr), &H5Sclose);
    const Hdf5Handle at(H5Oopen(id(), path.c_str(), H5P_DEFAULT), &H5Oclose);
    const Hdf5Handle made(H5Acreate2(at.get(), name.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT), &H5Aclose);
    H5Awrite(made.get(), type, value);
  }

  ScratchFolder folder_;
  std::filesystem::path path_ = folder_ / "small.h5";
  Hdf5Handle file_;
};

}  // namespace test_support
