#pragma once

#include <exception>
#include <functional>
#include <utility>

#include "trismooth/mpi/communicator.h"

namespace trismooth {

/// Calls `work` on every rank, which is to do nothing collective. If it throws anywhere, this throws mpi::KnownToAll
/// everywhere, with the error of the lowest of these ranks, of the same type: as mpi::Communicator::on_all(), but for
/// errors of files as well, which name the file and need no rank.
void agree(const mpi::Communicator& ranks, const std::function<void()>& work);

/// Calls a collective function that throws the same on all ranks, if anything.
template <class Function>
auto known_to_all(const Function& function) {
  try {
    return function();
  } catch (const mpi::KnownToAll&) {
    throw;
  } catch (const std::exception&) {
    throw mpi::KnownToAll{std::current_exception()};
  }
}

}  // namespace trismooth
