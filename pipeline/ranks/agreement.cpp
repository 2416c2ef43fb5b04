#include "trismooth/pipeline/ranks/agreement.h"

#include <cstdint>
#include <new>
#include <stdexcept>
#include <string>

#include <mpi.h>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/pipeline/pipeline.h"
#include "trismooth/smoothing/errors.h"

namespace trismooth {

namespace {

enum class ErrorKind : std::uint8_t { read, write, mesh, device, invalid_argument, cancelled, out_of_memory, other };

struct Failure {
  ErrorKind kind = ErrorKind::other;
  std::string message;
};

Failure failure_of(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const ReadError& e) {
    return {ErrorKind::read, e.what()};
  } catch (const WriteError& e) {
    return {ErrorKind::write, e.what()};
  } catch (const MeshError& e) {
    return {ErrorKind::mesh, e.what()};
  } catch (const DeviceError& e) {
    return {ErrorKind::device, e.what()};
  } catch (const std::invalid_argument& e) {
    return {ErrorKind::invalid_argument, e.what()};
  } catch (const Cancelled& e) {
    return {ErrorKind::cancelled, e.what()};
  } catch (const std::bad_alloc&) {
    return {ErrorKind::out_of_memory, {}};
  } catch (const std::exception& e) {
    return {ErrorKind::other, e.what()};
  }
}

/// Of a file: its name stands in front of the message, which made it that way.
template <class Error>
std::exception_ptr of_file(const std::string& text) {
  const std::size_t colon = text.find(": ");
  return std::make_exception_ptr(colon == text.npos ? Error({}, text)
                                                    : Error(text.substr(0, colon), text.substr(colon + 2)));
}

std::exception_ptr error_of(const Failure& failure) {
  switch (failure.kind) {
    case ErrorKind::read:
      return of_file<ReadError>(failure.message);
    case ErrorKind::write:
      return of_file<WriteError>(failure.message);
    case ErrorKind::mesh:
      return std::make_exception_ptr(MeshError(failure.message));
    case ErrorKind::device:
      return std::make_exception_ptr(DeviceError(failure.message));
    case ErrorKind::invalid_argument:
      return std::make_exception_ptr(std::invalid_argument(failure.message));
    case ErrorKind::cancelled:
      return std::make_exception_ptr(Cancelled());
    case ErrorKind::out_of_memory:
      return std::make_exception_ptr(std::bad_alloc());
    case ErrorKind::other:
      break;
  }
  return std::make_exception_ptr(std::runtime_error(failure.message));
}

}  // namespace

void agree(const mpi::Communicator& ranks, const std::function<void()>& work) {
  std::exception_ptr error;
  try {
    work();
  } catch (...) {
    error = std::current_exception();
  }
  int failed = error ? ranks.rank() : ranks.size();
  MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MIN, ranks.handle());
  if (failed == ranks.size()) {
    return;
  }
  const Failure own = failed == ranks.rank() ? failure_of(error) : Failure{};
  auto kind = static_cast<int>(own.kind);
  auto length = static_cast<int>(own.message.size());
  MPI_Bcast(&kind, 1, MPI_INT, failed, ranks.handle());
  MPI_Bcast(&length, 1, MPI_INT, failed, ranks.handle());
  std::string message = own.message;
  message.resize(static_cast<std::size_t>(length));
  MPI_Bcast(message.data(), length, MPI_CHAR, failed, ranks.handle());
  throw mpi::KnownToAll{error_of({static_cast<ErrorKind>(kind), message})};
}

}  // namespace trismooth
