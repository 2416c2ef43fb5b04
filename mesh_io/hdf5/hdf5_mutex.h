// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mutex>

namespace trismooth {

/// One for the whole process: the HDF5 library may be built for one thread at a time.
inline std::recursive_mutex& hdf5_mutex() {
  static std::recursive_mutex mutex;
  return mutex;
}

}  // namespace trismooth
