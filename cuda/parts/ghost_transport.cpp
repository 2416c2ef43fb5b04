// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/parts/ghost_transport.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <mutex>
#include <random>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/base/splitmix64.h"
#include "trismooth/cuda/parts/nccl.h"
#include "trismooth/cuda/runtime/check.h"

namespace trismooth::cuda {

namespace {

/// A stream beside the one of the sweeps, and the events with which the two wait for each other.
class SideStream {
 public:
  SideStream() {
    TRISMOOTH_CUDA_CHECK(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking));
    TRISMOOTH_CUDA_CHECK(cudaEventCreateWithFlags(&event_, cudaEventDisableTiming));
  }
  SideStream(const SideStream&) = delete;
  SideStream& operator=(const SideStream&) = delete;
  ~SideStream() {
    cudaEventDestroy(event_);
    cudaStreamDestroy(stream_);
  }

  cudaStream_t get() const { return stream_; }
  /// What is queued here waits for what has been queued there.
  void wait_for(cudaStream_t other) const { wait(stream_, other); }
  /// The other way round.
  void hold_up(cudaStream_t other) const { wait(other, stream_); }

 private:
  void wait(cudaStream_t waiting, cudaStream_t awaited) const {
    TRISMOOTH_CUDA_CHECK(cudaEventRecord(event_, awaited));
    TRISMOOTH_CUDA_CHECK(cudaStreamWaitEvent(waiting, event_, 0));
  }

  cudaStream_t stream_ = nullptr;
  cudaEvent_t event_ = nullptr;
};

/// Brings what the first part has to all of them: the others add zeros to it.
template <class V>
V of_first_part(const MeshPart& part, const V& own) {
  using Words = std::array<std::int64_t, sizeof(V) / sizeof(std::int64_t)>;
  auto words = part.number == 0 ? std::bit_cast<Words>(own) : Words{};
  for (std::size_t first = 0; first < words.size(); first += PartSums{}.sums.size()) {
    PartSums sums;
    std::copy_n(words.begin() + static_cast<std::ptrdiff_t>(first), sums.sums.size(), sums.sums.begin());
    part.messenger->join(sums);
    std::ranges::copy(sums.sums, words.begin() + static_cast<std::ptrdiff_t>(first));
  }
  return std::bit_cast<V>(words);
}

int current_device() {
  int device = 0;
  TRISMOOTH_CUDA_CHECK(cudaGetDevice(&device));
  return device;
}

/// A number for the current device, the same in all processes, and another one for every other device, of whichever
/// machine.
std::uint64_t identity_of_device() {
  cudaDeviceProp properties{};
  TRISMOOTH_CUDA_CHECK(cudaGetDeviceProperties(&properties, current_device()));
  std::uint64_t identity = 0;
  for (const char byte : properties.uuid.bytes) {
    identity = splitmix64(identity + static_cast<unsigned char>(byte));
  }
  return identity;
}

/// Whether two parts have the same device, which NCCL refuses.
bool share_a_device(const MeshPart& part) {
  std::vector<std::uint64_t> devices(static_cast<std::size_t>(part.count));
  devices[static_cast<std::size_t>(part.number)] = identity_of_device();
  constexpr std::size_t at_a_time = PartSums{}.sums.size();
  for (std::size_t first = 0; first < devices.size(); first += at_a_time) {
    const std::size_t count = std::min(at_a_time, devices.size() - first);
    PartSums sums;
    std::copy_n(devices.begin() + static_cast<std::ptrdiff_t>(first), count, sums.sums.begin());
    part.messenger->join(sums);
    std::copy_n(sums.sums.begin(), count, devices.begin() + static_cast<std::ptrdiff_t>(first));
  }
  std::ranges::sort(devices);
  return std::ranges::adjacent_find(devices) != devices.end();
}

/// Which processes, and which of their devices, are the parts, in which order: the same number for all of them, and for
/// no others.
std::uint64_t group_of(const MeshPart& part) {
  static const std::uint64_t process =
      (static_cast<std::uint64_t>(std::random_device()()) << 32U) ^ std::random_device()();
  PartSums sums;
  sums.sums[0] = static_cast<std::int64_t>(splitmix64(splitmix64(process + static_cast<std::uint64_t>(part.number)) +
                                                      static_cast<std::uint64_t>(current_device())));
  part.messenger->join(sums);
  return static_cast<std::uint64_t>(sums.sums[0]);
}

/// What the first part invites the others with. NCCL listens for them from then on, with a socket and a thread that
/// stay.
struct Invitation {
  nccl::UniqueId id{};
  std::int64_t error = 0;  ///< of NCCL, which all throw
};

/// NCCL's communicator of these parts. It takes NCCL about a second to make one: it is kept for all plans, to the end
/// of the process. Plans that are used in the same order on all parts, as they have to be, may share it.
nccl::Communicator communicator_of(const nccl::Library& library, const MeshPart& part) {
  static std::mutex looking;
  static std::map<std::pair<std::uint64_t, int>, nccl::Communicator> made;  // by group and part
  const std::pair key(group_of(part), part.number);
  const auto known = [&]() -> nccl::Communicator {
    const std::lock_guard lock(looking);
    const auto place = made.find(key);
    return place == made.end() ? nullptr : place->second;
  };
  nccl::Communicator communicator = known();
  // Where it failed on some of them they all make another one.
  PartSums lacking;
  lacking.sums[0] = communicator == nullptr ? 1 : 0;
  part.messenger->join(lacking);
  if (lacking.sums[0] == 0) {
    return communicator;
  }
  Invitation invitation;
  if (part.number == 0) {
    invitation.error = library.get_unique_id(&invitation.id);
  }
  invitation = of_first_part(part, invitation);
  library.check(static_cast<int>(invitation.error), "ncclGetUniqueId");
  // It waits for the other parts, which may be threads of this process: they must not wait for a lock meanwhile.
  library.check(library.comm_init_rank(&communicator, part.count, invitation.id, part.number), "ncclCommInitRank");
  const std::lock_guard lock(looking);
  made.insert_or_assign(key, communicator);
  return communicator;
}

/// From device to device.
class NcclTransport final : public GhostTransport {
 public:
  NcclTransport(const nccl::Library& library, const MeshPart& part)
      : library_(library), communicator_(communicator_of(library, part)) {}

  void start(std::span<const Message> sends, std::span<const Message> receives, cudaStream_t stream) override {
    is_under_way_ = !sends.empty() || !receives.empty();
    if (!is_under_way_) {
      return;
    }
    side_.wait_for(stream);
    library_.check(library_.group_start(), "ncclGroupStart");
    for (const Message& message : sends) {
      library_.check(
          library_.send(message.bytes, message.size, nccl::Library::bytes, message.part, communicator_, side_.get()),
          "ncclSend");
    }
    for (const Message& message : receives) {
      library_.check(
          library_.receive(message.bytes, message.size, nccl::Library::bytes, message.part, communicator_, side_.get()),
          "ncclRecv");
    }
    library_.check(library_.group_end(), "ncclGroupEnd");
  }

  void finish(cudaStream_t stream) override {
    if (is_under_way_) {
      side_.hold_up(stream);
    }
  }

 private:
  const nccl::Library& library_;
  nccl::Communicator communicator_;
  SideStream side_;
  bool is_under_way_ = false;
};

/// By way of the host, and the messengers of its parts.
class HostTransport final : public GhostTransport {
 public:
  explicit HostTransport(const MeshPart& part) : messenger_(*part.messenger) {}
  ~HostTransport() override {
    cudaFreeHost(out_.bytes);
    cudaFreeHost(in_.bytes);
  }

  void start(std::span<const Message> sends, std::span<const Message> receives, cudaStream_t stream) override {
    sends_ = staged(sends, out_);
    receives_ = staged(receives, in_);
    receivers_.assign(receives.begin(), receives.end());
    side_.wait_for(stream);
    for (std::size_t i = 0; i < sends.size(); ++i) {
      TRISMOOTH_CUDA_CHECK(
          cudaMemcpyAsync(sends_[i].bytes.data(), sends[i].bytes, sends[i].size, cudaMemcpyDeviceToHost, side_.get()));
    }
  }

  void finish(cudaStream_t stream) override {
    TRISMOOTH_CUDA_CHECK(cudaStreamSynchronize(side_.get()));
    messenger_.start(sends_, receives_);
    messenger_.finish();
    for (std::size_t i = 0; i < receivers_.size(); ++i) {
      TRISMOOTH_CUDA_CHECK(cudaMemcpyAsync(receivers_[i].bytes, receives_[i].bytes.data(), receivers_[i].size,
                                           cudaMemcpyHostToDevice, side_.get()));
    }
    // The memory of the host is used again.
    TRISMOOTH_CUDA_CHECK(cudaStreamSynchronize(side_.get()));
    side_.hold_up(stream);
  }

 private:
  struct Pinned {
    std::byte* bytes = nullptr;
    std::size_t size = 0;
  };

  static std::vector<PartMessenger::Message> staged(std::span<const Message> messages, Pinned& memory) {
    std::size_t size = 0;
    for (const Message& message : messages) {
      size += message.size;
    }
    if (size > memory.size) {
      TRISMOOTH_CUDA_CHECK(cudaFreeHost(std::exchange(memory.bytes, nullptr)));
      void* bytes = nullptr;
      TRISMOOTH_CUDA_CHECK(cudaMallocHost(&bytes, size));
      memory = {static_cast<std::byte*>(bytes), size};
    }
    std::vector<PartMessenger::Message> staged;
    std::byte* place = memory.bytes;
    for (const Message& message : messages) {
      staged.push_back({message.part, {place, message.size}});
      place += message.size;
    }
    return staged;
  }

  PartMessenger& messenger_;
  SideStream side_;
  Pinned out_;
  Pinned in_;
  std::vector<PartMessenger::Message> sends_;
  std::vector<PartMessenger::Message> receives_;
  std::vector<Message> receivers_;
};

}  // namespace

std::unique_ptr<GhostTransport> make_ghost_transport(const MeshPart& part) {
  const nccl::Library* const library = nccl::library();
  const char* const wanted = std::getenv("TRISMOOTH_GHOSTS");
  const bool goes_by_host = wanted != nullptr && std::string_view(wanted) == "host";
  PartSums sums;
  sums.sums[0] = library == nullptr || part.count == 1 || goes_by_host ? 1 : 0;
  part.messenger->join(sums);
  if (sums.sums[0] > 0 || share_a_device(part)) {
    return std::make_unique<HostTransport>(part);
  }
  return std::make_unique<NcclTransport>(*library, part);
}

}  // namespace trismooth::cuda
