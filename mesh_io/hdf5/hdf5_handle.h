// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mutex>
#include <string>
#include <utility>

#include <hdf5.h>

#include "trismooth/mesh_io/data_array.h"
#include "trismooth/mesh_io/hdf5/hdf5_mutex.h"
#include "trismooth/mesh_io/scalar_type_of.h"

namespace trismooth {

/// While it is there this thread alone calls HDF5, which prints no errors. To be held around every call of the library,
/// and around the end of every handle.
class Hdf5Lock {
 public:
  Hdf5Lock();
  Hdf5Lock(const Hdf5Lock&) = delete;
  Hdf5Lock& operator=(const Hdf5Lock&) = delete;
  ~Hdf5Lock();

 private:
  std::lock_guard<std::recursive_mutex> lock_;
  H5E_auto2_t print_ = nullptr;  ///< as it was set, and is again afterwards
  void* print_data_ = nullptr;
};

/// Something of HDF5's that is to be closed: a file, an object, a type, a property list. Move-only.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);

  Hdf5Handle() = default;
  /// Owns `id`, where it is valid.
  Hdf5Handle(hid_t id, Close how) : id_(id), close_(how) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Hdf5Handle() {
    if (is_valid()) {
      close_(id_);
    }
  }

  bool is_valid() const { return id_ >= 0; }
  hid_t get() const { return id_; }
  /// Closes it now; whether that went well.
  bool close() { return close_(std::exchange(id_, -1)) >= 0; }

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

/// What HDF5 says of the call that has failed: ": " and the cause, or nothing.
std::string hdf5_reason();

/// HDF5's type of numbers in memory.
hid_t hdf5_memory_type(ScalarType type);

}  // namespace trismooth
