// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mpi/messenger.h"

#include <limits>
#include <stdexcept>
#include <utility>

namespace trismooth::mpi {

namespace {

constexpr int halo_tag = 7302;

int size_of(std::span<std::byte> bytes) {
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw std::length_error("more ghosts of one rank than a message of MPI has room for");
  }
  return static_cast<int>(bytes.size());
}

void check(int code) {
  if (code != MPI_SUCCESS) {
    throw std::runtime_error("MPI failed while ranks exchanged what vertices have in common");
  }
}

}  // namespace

Messenger::Messenger(std::shared_ptr<const Communicator> communicator) : communicator_(std::move(communicator)) {}

Messenger::~Messenger() = default;

void Messenger::start(std::span<const Message> sends, std::span<const Message> receives) {
  ++traffic_.exchanges;
  for (const Message& message : receives) {
    check(MPI_Irecv(message.bytes.data(), size_of(message.bytes), MPI_BYTE, message.part, halo_tag,
                    communicator_->handle(), &requests_.emplace_back()));
  }
  for (const Message& message : sends) {
    check(MPI_Isend(message.bytes.data(), size_of(message.bytes), MPI_BYTE, message.part, halo_tag,
                    communicator_->handle(), &requests_.emplace_back()));
    ++traffic_.messages;
    traffic_.bytes += size_of(message.bytes);
  }
}

void Messenger::finish() {
  check(MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE));
  requests_.clear();
}

void Messenger::join(PartSums& sums) {
  ++traffic_.joins;
  sums = communicator_->joined(sums);
}

}  // namespace trismooth::mpi
