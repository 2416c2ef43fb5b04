// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <vector>

#include "trismooth/mpi/communicator.h"

namespace trismooth {

/// What all ranks have to say, each text once, in order, on all ranks. Texts hold no zero. Collective.
std::vector<std::string> texts_of_all(const std::set<std::string>& own, const mpi::Communicator& ranks);

/// Puts those sentences in front of all that are not there already. Local.
void put_in_front(const std::vector<std::string>& sentences, std::vector<std::string>& all);

/// The bytes of the lowest rank that has any, on all ranks. Collective.
std::vector<char> first_bytes(const std::vector<char>& own, const mpi::Communicator& ranks);

}  // namespace trismooth
