// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/hdf5/hdf5_handle.h"

namespace trismooth {

Hdf5Lock::Hdf5Lock() : lock_(hdf5_mutex()) {
  // Damaged files leave something open in the library, which complains of it when it is closed as the program ends.
  [[maybe_unused]] static const herr_t stays_open = H5dont_atexit();
  H5Eget_auto2(H5E_DEFAULT, &print_, &print_data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Hdf5Lock::~Hdf5Lock() {
  H5Eset_auto2(H5E_DEFAULT, print_, print_data_);
}

std::string hdf5_reason() {
  std::string reason;
  const H5E_walk2_t take_first = [](unsigned, const H5E_error2_t* error, void* data) -> herr_t {
    auto& text = *static_cast<std::string*>(data);
    if (text.empty() && error->desc != nullptr && *error->desc != '\0') {
      text = std::string(": ") + error->desc;
    }
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_first, &reason);
  return reason;
}

hid_t hdf5_memory_type(ScalarType type) {
  switch (type) {
    case ScalarType::int8:
      return H5T_NATIVE_INT8;
    case ScalarType::uint8:
      return H5T_NATIVE_UINT8;
    case ScalarType::int16:
      return H5T_NATIVE_INT16;
    case ScalarType::uint16:
      return H5T_NATIVE_UINT16;
    case ScalarType::int32:
      return H5T_NATIVE_INT32;
    case ScalarType::uint32:
      return H5T_NATIVE_UINT32;
    case ScalarType::int64:
      return H5T_NATIVE_INT64;
    case ScalarType::uint64:
      return H5T_NATIVE_UINT64;
    case ScalarType::float32:
      return H5T_NATIVE_FLOAT;
    case ScalarType::float64:
      break;
  }
  return H5T_NATIVE_DOUBLE;
}

}  // namespace trismooth
