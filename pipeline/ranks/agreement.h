// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "trismooth/mpi/communicator.h"

namespace trismooth {

/// Calls `work` on every rank, which is to do nothing collective. If it throws anywhere, this throws mpi::KnownToAll
/// everywhere, with the error of the lowest of these ranks, of the same type: as mpi::Communicator::on_all(), but for
/// errors of files as well, which name the file and need no rank. Collective.
void agree(const mpi::Communicator& ranks, const std::function<void()>& work);

}  // namespace trismooth
