#include "trismooth/cuda/slide/device_chains.h"

#include <cstring>
#include <span>
#include <vector>

#include "trismooth/base/bulk_memory.h"
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
  /// The same of what `changed` makes of each value.
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

DeviceChains::DeviceChains(Context& context, const SlideChains& chains, std::span<const std::int32_t> numbers)
    : context_(&context) {
  Pieces pieces;
  const std::size_t at_chains = pieces.add(chains.chains);
  const std::size_t at_knots = pieces.add(chains.knots);
  const std::size_t at_vertices = pieces.add(chains.vertices);
  const std::size_t at_arcs = pieces.add(chains.arcs);
  const std::size_t at_bends = pieces.add(chains.bends);
  const std::size_t at_limits = pieces.add(chains.limits);
  const std::size_t at_allowed = pieces.add(chains.allowed);
  const std::size_t at_lengths = pieces.add(chains.lengths);
  const std::size_t at_sliders = pieces.add(chains.sliders);
  const std::size_t at_fans = pieces.add(chains.fans);
  const std::size_t at_sides = pieces.add(chains.sides);
  const std::size_t at_places = pieces.add(chains.places);
  const std::size_t at_triangles = pieces.add(chains.held_triangles);
  pieces.lay_out();
  const auto number = [&](std::int32_t v) { return numbers[static_cast<std::size_t>(v)]; };
  pieces.write(at_chains, chains.chains);
  pieces.write(at_knots, chains.knots);
  pieces.write(at_vertices, chains.vertices, number);
  pieces.write(at_arcs, chains.arcs);
  pieces.write(at_bends, chains.bends);
  pieces.write(at_limits, chains.limits);
  pieces.write(at_allowed, chains.allowed);
  pieces.write(at_lengths, chains.lengths);
  pieces.write(at_sliders, chains.sliders);
  pieces.write(at_fans, chains.fans);
  pieces.write(at_sides, chains.sides, [&](const FanSide& side) {
    return FanSide{number(side.from), number(side.to), side.from_is_unknown, side.to_is_unknown};
  });
  pieces.write(at_places, chains.places);
  pieces.write(at_triangles, chains.held_triangles, [&](const Triangle& t) {
    return Triangle{number(t[0]), number(t[1]), number(t[2])};
  });
  memory_ = DeviceBuffer<std::byte>(context, pieces.bytes());
  const auto at = [&]<class T>(std::size_t begin, const std::vector<T>& /*values*/) {
    return reinterpret_cast<T*>(memory_.data() + begin);
  };
  view_ = {at(at_chains, chains.chains),   at(at_knots, chains.knots),     at(at_vertices, chains.vertices),
           at(at_arcs, chains.arcs),       at(at_bends, chains.bends),     at(at_limits, chains.limits),
           at(at_allowed, chains.allowed), at(at_lengths, chains.lengths), at(at_sliders, chains.sliders),
           at(at_fans, chains.fans),       at(at_sides, chains.sides),     chains.curve};
  held_triangles_ = at(at_triangles, chains.held_triangles);
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
