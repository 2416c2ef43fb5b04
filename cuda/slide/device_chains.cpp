// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/slide/device_chains.h"

#include <cstring>
#include <span>
#include <vector>

#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/cuda/runtime/check.h"

namespace trismooth::cuda {

namespace {

/// Arrays one behind the other, each aligned for any type.
class Pieces {
 public:
  /// Where the array will begin.
  template <class T>
  std::size_t add(const std::vector<T>& values) {
    constexpr std::size_t alignment = 16;
    const std::size_t begin = (size_ + alignment - 1) / alignment * alignment;
    size_ = begin + values.size() * sizeof(T);
    return begin;
  }
  /// Makes room for what has been added.
  void lay_out() { bytes_.resize(size_); }
  template <class T>
  void write(std::size_t begin, const std::vector<T>& values) {
    if (!values.empty()) {
      std::memcpy(bytes_.data() + begin, values.data(), values.size() * sizeof(T));
    }
  }
  /// Writes what `changed` makes of each value.
  template <class T, class Change>
  void write(std::size_t begin, const std::vector<T>& values, const Change& changed) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      const T value = changed(values[i]);
      std::memcpy(bytes_.data() + begin + i * sizeof(T), &value, sizeof(T));
    }
  }
  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::size_t size_ = 0;
  BulkVector<std::byte> bytes_;
};

}  // namespace

DeviceSlideElements::DeviceSlideElements(Context& context, const SlideElements& packed)
    : begins(context, packed.begins), sides(context, packed.sides), held(context, packed.held) {}

DeviceChains::DeviceChains(Context& context, const SlideChains& chains, std::span<const std::int32_t> numbers,
                           DeviceSlideElements& elements)
    : context_(&context) {
  Pieces pieces;
  const std::size_t at_chains = pieces.add(chains.chains);
  const std::size_t at_knots = pieces.add(chains.knots);
  const std::size_t at_vertices = pieces.add(chains.vertices);
  const std::size_t at_fans = pieces.add(chains.fan_at);
  const std::size_t at_arcs = pieces.add(chains.arcs);
  const std::size_t at_bends = pieces.add(chains.bends);
  const std::size_t at_limits = pieces.add(chains.limits);
  const std::size_t at_allowed = pieces.add(chains.allowed);
  const std::size_t at_lengths = pieces.add(chains.lengths);
  const std::size_t at_sliders = pieces.add(chains.sliders);
  const std::size_t at_places = pieces.add(chains.places);
  pieces.lay_out();
  const auto number = [&](std::int32_t v) { return numbers[static_cast<std::size_t>(v)]; };
  pieces.write(at_chains, chains.chains);
  pieces.write(at_knots, chains.knots);
  pieces.write(at_vertices, chains.vertices, number);
  pieces.write(at_fans, chains.fan_at);
  pieces.write(at_arcs, chains.arcs);
  pieces.write(at_bends, chains.bends);
  pieces.write(at_limits, chains.limits);
  pieces.write(at_allowed, chains.allowed);
  pieces.write(at_lengths, chains.lengths);
  pieces.write(at_sliders, chains.sliders);
  pieces.write(at_places, chains.places);
  memory_ = DeviceBuffer<std::byte>(context, pieces.bytes());
  const auto at = [&]<class T>(std::size_t begin, const std::vector<T>& /*values*/) {
    return reinterpret_cast<T*>(memory_.data() + begin);
  };
  view_ = {at(at_chains, chains.chains),
           at(at_knots, chains.knots),
           at(at_vertices, chains.vertices),
           at(at_fans, chains.fan_at),
           at(at_arcs, chains.arcs),
           at(at_bends, chains.bends),
           at(at_limits, chains.limits),
           at(at_allowed, chains.allowed),
           at(at_lengths, chains.lengths),
           at(at_sliders, chains.sliders),
           elements.begins.data(),
           elements.sides.data(),
           chains.curve};
  places_ = {at(at_places, chains.places)};
}

void DeviceChains::download_places(std::span<SlidePlace> places) const {
  TRISMOOTH_CUDA_CHECK(
      cudaMemcpyAsync(places.data(), places_.places, places.size_bytes(), cudaMemcpyDeviceToHost, context_->stream()));
  context_->synchronize();
}

void DeviceChains::begin(const SlideChains& chains) {
  TRISMOOTH_CUDA_CHECK(cudaMemcpyAsync(places_.places, chains.places.data(), chains.places.size() * sizeof(SlidePlace),
                                       cudaMemcpyHostToDevice, context_->stream()));
}

}  // namespace trismooth::cuda
