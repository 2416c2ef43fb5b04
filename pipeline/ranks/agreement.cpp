// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/agreement.h"

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mpi/error_kinds.h"
#include "trismooth/pipeline/pipeline.h"
#include "trismooth/smoothing/errors.h"

namespace trismooth {

namespace {

constexpr char between = '\0';  // the name of a file and what is said of it

/// The file is all that stands before the message, and may have any character in its name.
mpi::ErrorKind write_error_kind() {
  mpi::ErrorKind kind = mpi::error_kind<std::runtime_error>();
  kind.includes = [](const std::exception& error) { return dynamic_cast<const WriteError*>(&error) != nullptr; };
  kind.message_of = [](const std::exception& error) {
    const std::string& reason = static_cast<const WriteError&>(error).reason;
    std::string text = error.what();
    const std::size_t colon = text.size() - reason.size() - 2;
    return text.substr(0, colon) + between + reason;
  };
  kind.made_of = [](const std::string& message) {
    const std::size_t end = message.find(between);
    return std::make_exception_ptr(WriteError(message.substr(0, end), message.substr(end + 1)));
  };
  return kind;
}

/// Of which nobody needs more than the text: that of the file and its line ends at a colon.
mpi::ErrorKind read_error_kind() {
  mpi::ErrorKind kind = mpi::error_kind<std::runtime_error>();
  kind.includes = [](const std::exception& error) { return dynamic_cast<const ReadError*>(&error) != nullptr; };
  kind.made_of = [](const std::string& message) {
    const std::size_t colon = message.find(": ");
    return std::make_exception_ptr(ReadError(message.substr(0, colon), message.substr(colon + 2)));
  };
  return kind;
}

/// It has no message of its own.
mpi::ErrorKind cancelled_kind() {
  mpi::ErrorKind kind = mpi::error_kind<std::runtime_error>();
  kind.includes = [](const std::exception& error) { return dynamic_cast<const Cancelled*>(&error) != nullptr; };
  kind.made_of = [](const std::string& /*message*/) { return std::make_exception_ptr(Cancelled()); };
  return kind;
}

}  // namespace

void agree(const mpi::Communicator& ranks, const std::function<void()>& work) {
  static const std::array kinds{read_error_kind(),
                                write_error_kind(),
                                mpi::error_kind<MeshError>(),
                                mpi::error_kind<DeviceError>(),
                                mpi::error_kind<std::invalid_argument>(),
                                cancelled_kind()};
  ranks.on_all(work, {kinds});
}

}  // namespace trismooth
