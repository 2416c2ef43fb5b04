// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <span>
#include <string>

namespace trismooth::mpi {

/// A kind of error that other ranks throw as what it is.
struct ErrorKind {
  bool (*includes)(const std::exception& error);
  std::string (*message_of)(const std::exception& error);     ///< what they are told
  std::exception_ptr (*made_of)(const std::string& message);  ///< the error that they throw
};

/// That of a type which is made from its message. Local.
template <class Error>
constexpr ErrorKind error_kind() {
  return {[](const std::exception& error) { return dynamic_cast<const Error*>(&error) != nullptr; },
          [](const std::exception& error) { return std::string(error.what()); },
          [](const std::string& message) { return std::make_exception_ptr(Error(message)); }};
}

/// How errors of one rank reach the others, which throw them as the first kind that includes them, or where none does
/// as std::runtime_error.
struct ErrorKinds {
  std::span<const ErrorKind> kinds;
  bool names_rank = false;  ///< "rank 3: " stands in front of messages, where there are several
};

/// Those of the library: std::invalid_argument, MeshError, DeviceError and std::logic_error, with the rank's number.
/// Local.
const ErrorKinds& library_errors();

}  // namespace trismooth::mpi
