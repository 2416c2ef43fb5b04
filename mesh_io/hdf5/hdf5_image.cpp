// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/hdf5/hdf5_image.h"

#include <algorithm>
#include <cstddef>
#include <new>

namespace trismooth {

Hdf5Image::Hdf5Image(std::string_view bytes)
    // HDF5 asks for memory that could be written to, also where it reads alone.
    : bytes_(const_cast<char*>(bytes.data())),  // NOLINT(cppcoreguidelines-pro-type-const-cast)
      size_(bytes.size()) {}

void* Hdf5Image::grow(std::size_t size) {
  if (memory_ == nullptr) {
    return nullptr;
  }
  try {
    memory_->resize(std::max(memory_->size(), size));
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
  return bytes_ = memory_->data();
}

Hdf5Handle Hdf5Image::open() {
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), &H5Pclose);
  H5FD_file_image_callbacks_t callbacks{
      [](std::size_t, H5FD_file_image_op_t, void* image) -> void* { return static_cast<Hdf5Image*>(image)->bytes_; },
      [](void* to, const void*, std::size_t, H5FD_file_image_op_t, void*) { return to; },
      [](void*, std::size_t size, H5FD_file_image_op_t, void* image) {
        return static_cast<Hdf5Image*>(image)->grow(size);
      },
      [](void*, H5FD_file_image_op_t, void*) -> herr_t { return 0; },
      [](void* image) { return image; },
      [](void*) -> herr_t { return 0; },
      this};
  if (H5Pset_fapl_core(access.get(), std::size_t{1} << 16, false) < 0 ||
      H5Pset_file_image_callbacks(access.get(), &callbacks) < 0 || H5Pset_file_image(access.get(), bytes_, size_) < 0) {
    return {};
  }
  return {H5Fopen("trismooth bytes", memory_ == nullptr ? H5F_ACC_RDONLY : H5F_ACC_RDWR, access.get()), &H5Fclose};
}

}  // namespace trismooth
