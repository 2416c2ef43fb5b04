// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "trismooth/mesh_io/hdf5/hdf5_handle.h"

namespace trismooth {

/// The memory that a file of HDF5 is in. The library works there, and copies nothing: a file that is closed there is
/// whole, other than an image that HDF5 hands out of one that is open. It outlives the file's handles, and is not
/// moved.
class Hdf5Image {
 public:
  /// A file to read.
  explicit Hdf5Image(std::string_view bytes);
  /// A file to change: `memory`, which outlives the object, is longer than the file at times.
  explicit Hdf5Image(std::string* memory) : Hdf5Image(*memory) { memory_ = memory; }

  /// No valid handle where HDF5 takes it for none of its files.
  Hdf5Handle open();

 private:
  void* grow(std::size_t size);

  char* bytes_;
  std::size_t size_;
  std::string* memory_ = nullptr;
};

}  // namespace trismooth
