// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/parts/nccl.h"

#include <optional>
#include <string>
#include <type_traits>

#include <dlfcn.h>

#include "trismooth/smoothing/errors.h"

namespace trismooth::cuda::nccl {

namespace {

std::optional<Library> opened() {
  void* const handle = dlopen("libnccl.so.2", RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    return std::nullopt;
  }
  Library library{};
  bool has_all = true;
  const auto find = [&](auto& function, const char* name) {
    void* const symbol = dlsym(handle, name);
    has_all = has_all && symbol != nullptr;
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(symbol);
  };
  find(library.get_unique_id, "ncclGetUniqueId");
  find(library.comm_init_rank, "ncclCommInitRank");
  find(library.group_start, "ncclGroupStart");
  find(library.group_end, "ncclGroupEnd");
  find(library.send, "ncclSend");
  find(library.receive, "ncclRecv");
  find(library.error_string, "ncclGetErrorString");
  return has_all ? std::optional(library) : std::nullopt;
}

}  // namespace

void Library::check(int code, const char* call) const {
  if (code != 0) {
    throw DeviceError(std::string("NCCL: ") + call + ": " + error_string(code));
  }
}

const Library* library() {
  static const std::optional<Library> found = opened();
  return found ? &*found : nullptr;
}

}  // namespace trismooth::cuda::nccl
