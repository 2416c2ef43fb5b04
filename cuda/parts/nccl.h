// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include <cuda_runtime_api.h>

/// The few functions of NCCL that are used, from libnccl.so.2 of the machine: opened when they are needed, so that
/// programs run where there is none. (NCCL's ABI: nccl.h of version 2; what is declared here has not changed in it.)
namespace trismooth::cuda::nccl {

struct UniqueId {
  std::array<char, 128> internal;
};
using Communicator = struct ncclComm*;

struct Library {
  int (*get_unique_id)(UniqueId*);
  int (*comm_init_rank)(Communicator*, int ranks, UniqueId id, int rank);
  int (*group_start)();
  int (*group_end)();
  int (*send)(const void*, std::size_t count, int type, int peer, Communicator, cudaStream_t);
  int (*receive)(void*, std::size_t count, int type, int peer, Communicator, cudaStream_t);
  const char* (*error_string)(int);

  static constexpr int bytes = 0;  ///< ncclInt8

  /// Throws DeviceError for a code that is no success.
  void check(int code, const char* call) const;
};

/// Null where there is none.
const Library* library();

}  // namespace trismooth::cuda::nccl
