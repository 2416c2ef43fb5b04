// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mpi/communicator.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>

#include "trismooth/base/machine/out_of_memory.h"
#include "trismooth/base/machine/workers.h"

namespace trismooth::mpi {

namespace {

constexpr int exchange_tag = 7301;

void check(int code, const char* call) {
  if (code == MPI_SUCCESS) {
    return;
  }
  std::string text(MPI_MAX_ERROR_STRING, '\0');
  int length = 0;
  MPI_Error_string(code, text.data(), &length);
  text.resize(static_cast<std::size_t>(length));
  throw std::runtime_error(std::string(call) + ": " + text);
}

void join_sums(void* in, void* inout, int* count, MPI_Datatype* /*type*/) {
  for (int i = 0; i < *count; ++i) {
    static_cast<PartSums*>(inout)[i].join(static_cast<const PartSums*>(in)[i]);
  }
}

/// An error on its way to other ranks: of the kind of this number, the next one where none of them includes it.
struct Failure {
  static constexpr int of_memory = -1;  ///< a kind that needs no message: there may be no memory for one

  int kind = 0;
  std::string message;
};

Failure failure_of(const std::exception_ptr& error, std::span<const ErrorKind> kinds) {
  try {
    std::rethrow_exception(error);
  } catch (const std::exception& e) {
    if (dynamic_cast<const std::bad_alloc*>(&e) != nullptr) {
      return {Failure::of_memory, {}};
    }
    const auto kind = std::ranges::find_if(kinds, [&](const ErrorKind& known) { return known.includes(e); });
    return {static_cast<int>(kind - kinds.begin()), kind != kinds.end() ? kind->message_of(e) : e.what()};
  } catch (...) {
    return {static_cast<int>(kinds.size()), "an exception that is no std::exception"};
  }
}

/// Whose memory was used up, or else `rank`.
int rank_of_memory(const std::exception_ptr& error, int rank) {
  try {
    std::rethrow_exception(error);
  } catch (const OutOfMemory& known) {
    return known.rank();
  } catch (...) {
    return rank;
  }
}

std::exception_ptr error_of(const Failure& failure, std::span<const ErrorKind> kinds) {
  return failure.kind < static_cast<int>(kinds.size())
             ? kinds[static_cast<std::size_t>(failure.kind)].made_of(failure.message)
             : std::make_exception_ptr(std::runtime_error(failure.message));
}

int narrow(std::int64_t count) {
  if (count > std::numeric_limits<int>::max()) {
    throw std::length_error("more than MPI can send in one message");
  }
  return static_cast<int>(count);
}

}  // namespace

int say_failure(int rank) {
  try {
    const Failure failure = failure_of(std::current_exception(), {});
    std::cerr << "trismooth: rank " << rank << ": "
              << (failure.kind == Failure::of_memory ? "out of memory" : failure.message.c_str()) << '\n';
  } catch (...) {
    std::fputs("trismooth: a rank has failed, and has no memory left to say why\n", stderr);
  }
  return EXIT_FAILURE;
}

void end_all(MPI_Comm communicator, int exit_code) {
  // A launcher that is told to end all may forget what it has not passed on yet.
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  MPI_Abort(communicator, exit_code);
  std::terminate();
}

Communicator::Communicator(MPI_Comm caller, LastWords last_words) : last_words_(last_words) {
  int is_initialised = 0;
  int is_finalised = 0;
  MPI_Initialized(&is_initialised);
  MPI_Finalized(&is_finalised);
  if (is_initialised == 0 || is_finalised != 0) {
    throw std::logic_error("MPI has to be initialised before a mesh in parts is smoothed, and not finalised");
  }
  check(MPI_Comm_dup(caller, &communicator_), "MPI_Comm_dup");
  // Who misses a message would wait for it.
  check(MPI_Comm_set_errhandler(communicator_, MPI_ERRORS_ARE_FATAL), "MPI_Comm_set_errhandler");
  check(MPI_Comm_rank(communicator_, &rank_), "MPI_Comm_rank");
  check(MPI_Comm_size(communicator_, &size_), "MPI_Comm_size");
  MPI_Comm machine = MPI_COMM_NULL;
  check(MPI_Comm_split_type(communicator_, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &machine),
        "MPI_Comm_split_type");
  check(MPI_Comm_size(machine, &ranks_of_machine_), "MPI_Comm_size");
  check(MPI_Comm_rank(machine, &place_on_machine_), "MPI_Comm_rank");
  MPI_Comm_free(&machine);
  check(MPI_Type_contiguous(static_cast<int>(sizeof(PartSums)), MPI_BYTE, &sums_type_), "MPI_Type_contiguous");
  check(MPI_Type_commit(&sums_type_), "MPI_Type_commit");
  check(MPI_Op_create(&join_sums, 1, &join_), "MPI_Op_create");
}

Communicator::~Communicator() {
  int is_finalised = 0;
  MPI_Finalized(&is_finalised);
  if (is_finalised != 0) {
    return;
  }
  MPI_Op_free(&join_);
  MPI_Type_free(&sums_type_);
  MPI_Comm_free(&communicator_);
}

int Communicator::threads(int asked) const {
  return asked > 0 ? asked : std::max(1, Workers(0).count() / ranks_of_machine_);
}

PartSums Communicator::joined(PartSums own) const {
  check(MPI_Allreduce(MPI_IN_PLACE, &own, 1, sums_type_, join_, communicator_), "MPI_Allreduce");
  return own;
}

std::int64_t Communicator::sum(std::int64_t own) const {
  check(MPI_Allreduce(MPI_IN_PLACE, &own, 1, MPI_INT64_T, MPI_SUM, communicator_), "MPI_Allreduce");
  return own;
}

void Communicator::sum(std::span<std::int64_t> own) const {
  const auto count = static_cast<int>(own.size());
  check(MPI_Allreduce(MPI_IN_PLACE, own.data(), count, MPI_INT64_T, MPI_SUM, communicator_), "MPI_Allreduce");
}

std::int64_t Communicator::largest(std::int64_t own) const {
  check(MPI_Allreduce(MPI_IN_PLACE, &own, 1, MPI_INT64_T, MPI_MAX, communicator_), "MPI_Allreduce");
  return own;
}

std::int64_t Communicator::sum_before(std::int64_t own) const {
  std::int64_t before = 0;
  check(MPI_Exscan(&own, &before, 1, MPI_INT64_T, MPI_SUM, communicator_), "MPI_Exscan");
  return rank_ == 0 ? 0 : before;
}

void Communicator::on_all(const std::function<void()>& work, const ErrorKinds& errors) const {
  std::exception_ptr error;
  try {
    work();
  } catch (...) {
    error = std::current_exception();
  }
  int failed = error ? rank_ : size_;
  check(MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MIN, communicator_), "MPI_Allreduce");
  if (failed == size_) {
    return;
  }
  Failure failure;
  if (failed == rank_) {
    failure = failure_of(error, errors.kinds);
    if (errors.names_rank && size_ > 1) {
      failure.message = "rank " + std::to_string(rank_) + ": " + failure.message;
    }
  }
  check(MPI_Bcast(&failure.kind, 1, MPI_INT, failed, communicator_), "MPI_Bcast");
  if (failure.kind == Failure::of_memory) {
    // Of an error that has been agreed on before it is known whose memory it was.
    int whose = failed == rank_ ? rank_of_memory(error, rank_) : failed;
    check(MPI_Bcast(&whose, 1, MPI_INT, failed, communicator_), "MPI_Bcast");
    throw KnownToAll(size_ > 1 ? std::make_exception_ptr(OutOfMemory(whose))
                               : std::make_exception_ptr(std::bad_alloc()));
  }
  int length = static_cast<int>(failure.message.size());
  check(MPI_Bcast(&length, 1, MPI_INT, failed, communicator_), "MPI_Bcast");
  failure.message.resize(static_cast<std::size_t>(length));
  check(MPI_Bcast(failure.message.data(), length, MPI_CHAR, failed, communicator_), "MPI_Bcast");
  throw KnownToAll(error_of(failure, errors.kinds));
}

std::vector<std::int64_t> Communicator::exchanged_counts(std::span<const std::int64_t> counts) const {
  std::vector<std::int64_t> received(counts.size());
  check(MPI_Alltoall(counts.data(), 1, MPI_INT64_T, received.data(), 1, MPI_INT64_T, communicator_), "MPI_Alltoall");
  return received;
}

void Communicator::exchange(std::span<const Buffer> sends, std::span<const Buffer> receives,
                            std::size_t item_size) const {
  MPI_Datatype item = MPI_DATATYPE_NULL;
  check(MPI_Type_contiguous(static_cast<int>(item_size), MPI_BYTE, &item), "MPI_Type_contiguous");
  check(MPI_Type_commit(&item), "MPI_Type_commit");
  std::vector<MPI_Request> requests;
  for (const Buffer& buffer : receives) {
    if (buffer.count > 0) {
      check(MPI_Irecv(buffer.first, narrow(buffer.count), item, buffer.rank, exchange_tag, communicator_,
                      &requests.emplace_back()),
            "MPI_Irecv");
    }
  }
  for (const Buffer& buffer : sends) {
    if (buffer.count > 0) {
      check(MPI_Isend(buffer.first, narrow(buffer.count), item, buffer.rank, exchange_tag, communicator_,
                      &requests.emplace_back()),
            "MPI_Isend");
    }
  }
  check(MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE), "MPI_Waitall");
  MPI_Type_free(&item);
}

std::shared_ptr<const Communicator> joined_ranks(MPI_Comm caller) {
  try {
    return std::make_shared<const Communicator>(caller);
  } catch (const std::bad_alloc&) {
    // The others wait for this rank to join them.
    int rank = 0;
    MPI_Comm_rank(caller, &rank);
    end_all(caller, say_failure(rank));
  }
}

}  // namespace trismooth::mpi
