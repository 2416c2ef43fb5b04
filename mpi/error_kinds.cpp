// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mpi/error_kinds.h"

#include <array>
#include <stdexcept>

#include "trismooth/smoothing/errors.h"

namespace trismooth::mpi {

const ErrorKinds& library_errors() {
  static constexpr std::array kinds{error_kind<std::invalid_argument>(), error_kind<MeshError>(),
                                    error_kind<DeviceError>(), error_kind<std::logic_error>()};
  static constexpr ErrorKinds errors{kinds, true};
  return errors;
}

}  // namespace trismooth::mpi
